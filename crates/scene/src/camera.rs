//! The camera: where the eye is and how it projects.

use durer_math::DVec3;

/// A camera at `position` that looks at the point `look_at`.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// The eye, in world space.
    pub position: DVec3,
    /// The point in the middle of the picture, in world space; only its direction from `position` counts.
    pub look_at: DVec3,
    /// The direction that shows upward in the picture; any direction but that of the view.
    pub up: DVec3,
    /// How space becomes picture.
    pub projection: Projection,
    /// A lens that sharpens one distance and blurs others; `None` for a pinhole, which sees all of it sharp.
    pub lens: Option<Lens>,
}

/// A thin lens: everything in one plane across the view is sharp, and what is nearer or further becomes a disc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lens {
    /// Radius of the aperture, in world units; with blades, that of the circle through its corners.
    pub radius: f64,
    /// What is sharp.
    pub focus: Focus,
    /// Number of the aperture's straight edges, at least 3; 0 for a round one.
    pub blades: u32,
    /// Turns the aperture about the view, counterclockwise as the eye sees it; at 0 one corner points up.
    pub rotation_degrees: f64,
}

/// Which plane across the view is sharp.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Focus {
    /// That through the point that the camera looks at.
    #[default]
    LookAt,
    /// That at this distance from the eye, along the view.
    Distance(f64),
    /// That through this point in world space, which is before the eye.
    Target(DVec3),
}

impl Camera {
    /// Distance of the plane that is sharp from the eye, along the view, if there is a lens.
    pub fn focus_distance(&self) -> Option<f64> {
        let along = |point: DVec3| (point - self.position).dot((self.look_at - self.position).normalize());
        self.lens.map(|lens| match lens.focus {
            Focus::LookAt => along(self.look_at),
            Focus::Distance(distance) => distance,
            Focus::Target(point) => along(point),
        })
    }
}

/// How space becomes picture. Pixels are square: the horizontal extent follows from the picture's aspect ratio.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// Perspective by the vertical angle of view.
    FieldOfView {
        /// The whole vertical angle, in degrees, between 0 and 180.
        degrees: f64,
    },
    /// Perspective by an image plane in front of the eye: the tangent of half the vertical angle of view is
    /// `half_height / distance`.
    ImagePlane {
        /// Distance of the plane from the eye.
        distance: f64,
        /// Half the height of the picture on that plane.
        half_height: f64,
    },
    /// Parallel projection.
    Orthographic {
        /// Height of the picture, in world units.
        height: f64,
    },
}

impl Default for Camera {
    /// At the origin, looking along -z with +y up, with a field of view of 50 degrees.
    fn default() -> Camera {
        Camera {
            position: DVec3::ZERO,
            look_at: DVec3::NEG_Z,
            up: DVec3::Y,
            projection: Projection::FieldOfView { degrees: 50.0 },
            lens: None,
        }
    }
}

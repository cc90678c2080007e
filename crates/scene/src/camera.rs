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
        }
    }
}

//! The camera, compiled: a point of the picture becomes a ray.

use durer_geometry::{Bounds, Ray};
use durer_math::{DVec2, DVec3, functions::tan};
use durer_scene as scene;

/// Makes the eye's rays.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Camera {
    /// The eye, or for parallel projection the middle of the plane that rays start from.
    position: DVec3,
    forward: DVec3,
    /// From the middle of the picture to its right and upper edges: on a plane at distance 1, or, for parallel
    /// projection, in the world.
    right: DVec3,
    up: DVec3,
    parallel: bool,
    /// From pixels to -1..1.
    scale: DVec2,
}

impl Camera {
    /// A camera for a picture of this size. Without a description it frames `bounds`.
    pub(crate) fn compile(described: Option<&scene::Camera>, bounds: Bounds, width: u32, height: u32) -> Camera {
        let aspect = f64::from(width) / f64::from(height);
        let framed;
        let camera = match described {
            Some(camera) => camera,
            None => {
                framed = frame(bounds, aspect);
                &framed
            }
        };
        let forward = (camera.look_at - camera.position).normalize();
        let right = forward.cross(camera.up).normalize();
        let up = right.cross(forward);
        let (half_height, parallel) = match camera.projection {
            scene::Projection::FieldOfView { degrees } => (tan((degrees * 0.5).to_radians()), false),
            scene::Projection::ImagePlane { distance, half_height } => (half_height / distance, false),
            scene::Projection::Orthographic { height } => (height * 0.5, true),
        };
        Camera {
            position: camera.position,
            forward,
            right: right * (half_height * aspect),
            up: up * half_height,
            parallel,
            scale: DVec2::new(2.0 / f64::from(width), 2.0 / f64::from(height)),
        }
    }

    /// The point that all rays start from, if there is one.
    pub(crate) fn eye(&self) -> Option<DVec3> {
        (!self.parallel).then_some(self.position)
    }

    /// A box around the points that rays start from.
    pub(crate) fn origins(&self) -> Bounds {
        if !self.parallel {
            return Bounds::of_points([self.position]);
        }
        // A little more than the picture, for the rounding of its corners.
        let (right, up) = (self.right * 1.001, self.up * 1.001);
        let corner = |x: f64, y: f64| self.position + right * x + up * y;
        Bounds::of_points([corner(-1.0, -1.0), corner(-1.0, 1.0), corner(1.0, -1.0), corner(1.0, 1.0)])
    }

    /// Where the ends of a line are seen: of the part of it that lies before the eye, in pieces along which things become no
    /// more than twice as large.
    pub(crate) fn project_pieces(&self, [a, b]: [DVec3; 2]) -> impl Iterator<Item = [Projected; 2]> {
        let depth = |point: DVec3| if self.parallel { 1.0 } else { (point - self.position).dot(self.forward) };
        let (near, far) = if depth(a) <= depth(b) { (a, b) } else { (b, a) };
        let (from, to) = (depth(near), depth(far));
        // Nearer to the eye than this, things are large.
        let nearest = from.max(1e-3 * to);
        let at = move |depth: f64| match to > from {
            true => (far + (near - far) * ((to - depth) / (to - from)), depth),
            false => (far, to),
        };
        let mut end = (to > 0.0).then_some(to);
        std::iter::from_fn(move || {
            let this = end?;
            let next = (this * 0.5).max(nearest);
            end = (next > nearest).then_some(next);
            // All of a line across the view is one piece.
            let ends = if to > from { [at(this), at(next)] } else { [(far, to), (near, from)] };
            Some(ends.map(|(point, depth)| self.project(point, depth)))
        })
    }

    fn project(&self, point: DVec3, depth: f64) -> Projected {
        let from_eye = point - self.position;
        let along = |axis: DVec3| from_eye.dot(axis) / (axis.length_squared() * depth);
        let at = DVec2::new(along(self.right) + 1.0, 1.0 - along(self.up)) / self.scale;
        let scale = 1.0 / (self.up.length() * depth * self.scale.y);
        Projected { at, scale, depth: from_eye.dot(self.forward) }
    }

    /// The ray through a point of the picture, in pixels from its upper left corner.
    #[inline]
    pub(crate) fn ray(&self, at: DVec2) -> Ray {
        let (x, y) = (at.x * self.scale.x - 1.0, 1.0 - at.y * self.scale.y);
        let across = self.right * x + self.up * y;
        if self.parallel {
            Ray { origin: self.position + across, direction: self.forward }
        } else {
            Ray { origin: self.position, direction: (self.forward + across).normalize() }
        }
    }
}

/// A point as the picture shows it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Projected {
    /// Where, in pixels from the upper left corner.
    pub(crate) at: DVec2,
    /// How many pixels long something of length 1 is there, across the view.
    pub(crate) scale: f64,
    /// How far away it is, along the view.
    pub(crate) depth: f64,
}

/// A view from the front, a little from the right and from above, that shows all of `bounds` and little else.
fn frame(bounds: Bounds, aspect: f64) -> scene::Camera {
    let degrees: f64 = 35.0;
    let half_tangent = tan((degrees * 0.5).to_radians()) * aspect.min(1.0);
    let (center, radius) = match bounds.is_empty() {
        true => (DVec3::ZERO, 2.0),
        false => (bounds.center(), bounds.size().length() * 0.5),
    };
    // The eye must not be where it looks at, also if what it sees is a point, or is far away for its size.
    let radius = radius.max(1e-9).max(1e-12 * center.abs().max_element());
    // The sphere around the bounds touches the edges of the view where its sine, not its tangent, is radius / distance.
    let distance = radius * (1.0 + 1.0 / (half_tangent * half_tangent)).sqrt();
    scene::Camera {
        position: center + DVec3::new(0.45, 0.4, 1.0).normalize() * distance,
        look_at: center,
        up: DVec3::Y,
        projection: scene::Projection::FieldOfView { degrees },
        lens: None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_near(a: DVec3, b: DVec3) {
        assert!((a - b).length() < 1e-12, "{a} != {b}");
    }

    #[test]
    fn the_seeds_image_plane_has_half_height_over_distance() {
        let described = scene::Camera {
            projection: scene::Projection::ImagePlane { distance: 12.5, half_height: 10.0 },
            ..scene::Camera::default()
        };
        let camera = Camera::compile(Some(&described), Bounds::EMPTY, 1920, 1080);
        assert_near(camera.ray(DVec2::new(960.0, 540.0)).direction, DVec3::NEG_Z);
        let corner = DVec3::new(-0.8 * 1920.0 / 1080.0, 0.8, -1.0).normalize();
        assert_near(camera.ray(DVec2::ZERO).direction, corner);
    }

    #[test]
    fn the_field_of_view_is_the_whole_vertical_angle() {
        let described = scene::Camera {
            position: DVec3::new(1.0, 2.0, 3.0),
            look_at: DVec3::new(11.0, 2.0, 3.0),
            projection: scene::Projection::FieldOfView { degrees: 90.0 },
            ..scene::Camera::default()
        };
        let camera = Camera::compile(Some(&described), Bounds::EMPTY, 200, 100);
        assert_near(camera.ray(DVec2::new(100.0, 0.0)).direction, DVec3::new(1.0, 1.0, 0.0).normalize());
        assert_near(camera.ray(DVec2::new(200.0, 50.0)).direction, DVec3::new(1.0, 0.0, 2.0).normalize());
    }

    #[test]
    fn parallel_rays_start_on_a_plane() {
        let described =
            scene::Camera { projection: scene::Projection::Orthographic { height: 4.0 }, ..scene::Camera::default() };
        let camera = Camera::compile(Some(&described), Bounds::EMPTY, 300, 100);
        let ray = camera.ray(DVec2::new(300.0, 100.0));
        assert_near(ray.origin, DVec3::new(6.0, -2.0, 0.0));
        assert_near(ray.direction, DVec3::NEG_Z);
        let Bounds { min, max } = camera.origins();
        assert!(min.x < -6.0 && max.x > 6.0 && min.y < -2.0 && max.y > 2.0 && max.y < 2.1);
    }

    #[test]
    fn points_are_seen_where_their_rays_go() {
        let perspective = scene::Camera { position: DVec3::new(1.0, 2.0, 5.0), ..scene::Camera::default() };
        let parallel =
            scene::Camera { projection: scene::Projection::Orthographic { height: 4.0 }, ..perspective.clone() };
        for described in [perspective.clone(), parallel] {
            let camera = Camera::compile(Some(&described), Bounds::EMPTY, 300, 200);
            for (x, y, t) in [(150.0, 100.0, 3.0), (0.0, 0.0, 1.0), (299.5, 17.25, 8.0)] {
                let at = DVec2::new(x, y);
                let ray = camera.ray(at);
                let near = [ray.at(t), ray.at(t) + camera.up.normalize() * 1e-3];
                let mut ends = camera.project_pieces(near).next().expect("it is before the eye");
                ends.sort_by(|a, b| (a.at - at).length().total_cmp(&(b.at - at).length()));
                let [seen, beside] = ends;
                assert!((seen.at - at).length() < 1e-9, "{seen:?}");
                assert!((seen.depth - t * ray.direction.dot(camera.forward)).abs() < 1e-9, "{seen:?}");
                assert!(((beside.at - at).length() - seen.scale * 1e-3).abs() < 1e-9, "{seen:?}");
            }
        }
        let camera = Camera::compile(Some(&perspective), Bounds::EMPTY, 300, 200);
        let behind = |t: f64| camera.position - camera.forward * t;
        assert!(camera.project_pieces([behind(1.0), behind(2.0)]).next().is_none());
        let side = camera.right.normalize();
        let line = [behind(-8.0) + side, behind(2.0) - side];
        let pieces: Vec<[Projected; 2]> = camera.project_pieces(line).collect();
        assert!(pieces.windows(2).all(|two| (two[0][1].at - two[1][0].at).length() < 1e-9), "one joins the other");
        assert!(pieces.iter().all(|[far, near]| near.scale <= 2.0001 * far.scale && near.depth > 0.0));
        assert!((pieces[0][0].depth - 8.0).abs() < 1e-9 && pieces[pieces.len() - 1][1].depth < 0.01);
    }

    #[test]
    fn an_undescribed_camera_of_a_point_has_a_direction() {
        for point in [DVec3::ZERO, DVec3::X * 1e12, DVec3::new(1e-9, -1e12, 7.0)] {
            let camera = Camera::compile(None, Bounds::of_points([point]), 4, 3);
            let direction = camera.ray(DVec2::new(1.0, 2.0)).direction;
            assert!((direction.length() - 1.0).abs() < 1e-12, "{direction}");
        }
    }

    #[test]
    fn an_undescribed_camera_sees_every_corner_of_the_bounds() {
        let bounds = Bounds { min: DVec3::new(-3.0, 10.0, 5.0), max: DVec3::new(4.0, 12.0, 6.0) };
        for (width, height) in [(640, 480), (100, 900), (900, 100)] {
            let camera = Camera::compile(None, bounds, width, height);
            for corner in 0..8 {
                let pick = |bit: usize, low: f64, high: f64| if corner >> bit & 1 == 0 { low } else { high };
                let p = DVec3::new(
                    pick(0, bounds.min.x, bounds.max.x),
                    pick(1, bounds.min.y, bounds.max.y),
                    pick(2, bounds.min.z, bounds.max.z),
                );
                let to = p - camera.position;
                let depth = to.dot(camera.forward);
                assert!(depth > 0.0);
                assert!((to.dot(camera.right) / depth).abs() <= camera.right.length_squared());
                assert!((to.dot(camera.up) / depth).abs() <= camera.up.length_squared());
            }
        }
    }
}

//! The camera, compiled: a point of the picture, and one of the lens if there is one, become a ray.

mod lens;

use self::lens::Lens;
pub(crate) use self::lens::concentric_disc;
use durer_geometry::{Bounds, LANES, Pinhole, Ray};
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
    /// `None` for a pinhole, which sees everything sharp.
    lens: Option<Lens>,
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
            lens: camera.lens.zip(camera.focus_distance()).filter(|(lens, _)| lens.radius > 0.0).map(
                |(lens, focus)| {
                    Lens::new((right, up), lens.radius, focus, lens.blades, lens.rotation_degrees.to_radians())
                },
            ),
        }
    }

    /// How far away a point is, along the view, as the distance of what is in focus is measured.
    pub(crate) fn depth_of(&self, point: DVec3) -> f64 {
        (point - self.position).dot(self.forward)
    }

    /// True if rays start from more than one point of a lens.
    pub(crate) fn has_lens(&self) -> bool {
        self.lens.is_some()
    }

    /// The point that all rays start from, if there is one.
    pub(crate) fn eye(&self) -> Option<DVec3> {
        (!self.parallel && self.lens.is_none()).then_some(self.position)
    }

    /// A box around the points that rays start from.
    pub(crate) fn origins(&self) -> Bounds {
        let reach = DVec3::splat(self.lens.map_or(0.0, |lens| lens.reach()));
        let Bounds { min, max } = self.origins_of_pinholes();
        Bounds { min: min - reach, max: max + reach }
    }

    fn origins_of_pinholes(&self) -> Bounds {
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

    /// The ray through a point of the picture, in pixels from its upper left corner, and the middle of the lens.
    #[inline]
    pub(crate) fn ray(&self, at: DVec2) -> Ray {
        let across = self.across(at);
        if self.parallel {
            Ray { origin: self.position + across, direction: self.forward }
        } else {
            Ray { origin: self.position, direction: (self.forward + across).normalize() }
        }
    }

    /// The ray through a point of the picture and one of the lens, which stands for a point of the unit square. Without a lens
    /// it is [`Camera::ray`].
    #[inline]
    pub(crate) fn ray_through_lens(&self, at: DVec2, on_lens: DVec2) -> Ray {
        let Some(lens) = &self.lens else { return self.ray(at) };
        let across = self.across(at);
        // What a point of the picture shows of the plane in focus is the same from all of the lens.
        let (start, in_focus) = match self.parallel {
            true => (self.position + across, self.forward * lens.focus),
            false => (self.position, (self.forward + across) * lens.focus),
        };
        let offset = lens.point(on_lens);
        Ray { origin: start + offset, direction: (in_focus - offset).normalize() }
    }

    /// How rays go that all start in one point, if they do.
    #[inline]
    pub(crate) fn pinhole(&self) -> Option<Pinhole> {
        let Camera { forward, right, up, .. } = *self;
        self.eye().map(|eye| Pinhole { eye, forward, right, up })
    }

    /// Where one to eight points of the picture are as `right` and `up` are measured: all of the one, then all of the other.
    /// The last is repeated.
    #[inline]
    pub(crate) fn on_screen(&self, points: &[DVec2]) -> [[f64; LANES]; 2] {
        let last = points.len().saturating_sub(1);
        let points: [DVec2; LANES] = match points.try_into() {
            Ok(points) => points,
            Err(_) => std::array::from_fn(|lane| points[lane.min(last)]),
        };
        [points.map(|at| at.x * self.scale.x - 1.0), points.map(|at| 1.0 - at.y * self.scale.y)]
    }

    /// From the middle of the picture to a point of it, as `right` and `up` are measured.
    #[inline]
    fn across(&self, at: DVec2) -> DVec3 {
        let (x, y) = (at.x * self.scale.x - 1.0, 1.0 - at.y * self.scale.y);
        self.right * x + self.up * y
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

    /// A camera with a lens of radius 0.5, in focus at 4, and the same as a pinhole.
    fn with_lens(projection: scene::Projection) -> (Camera, Camera) {
        let described = scene::Camera {
            position: DVec3::new(1.0, 2.0, 3.0),
            look_at: DVec3::new(-2.0, 1.0, 0.0),
            projection,
            ..scene::Camera::default()
        };
        let pinhole = Camera::compile(Some(&described), Bounds::EMPTY, 300, 200);
        let axes = (pinhole.right.normalize(), pinhole.up.normalize());
        (Camera { lens: Some(Lens::new(axes, 0.5, 4.0, 0, 0.0)), ..pinhole }, pinhole)
    }

    const PROJECTIONS: [scene::Projection; 2] =
        [scene::Projection::FieldOfView { degrees: 50.0 }, scene::Projection::Orthographic { height: 4.0 }];

    fn squares() -> impl Iterator<Item = DVec2> {
        (0..100).map(|k| DVec2::new(f64::from(k % 10) / 9.5, f64::from(k / 10) / 9.5))
    }

    #[test]
    fn rays_through_all_of_the_lens_meet_in_the_plane_in_focus() {
        for projection in PROJECTIONS {
            let (camera, pinhole) = with_lens(projection);
            for at in [DVec2::new(150.0, 100.0), DVec2::ZERO, DVec2::new(17.0, 180.0)] {
                let middle = pinhole.ray(at);
                assert_near(camera.ray(at).direction, middle.direction);
                let meeting = middle.at(4.0 / middle.direction.dot(camera.forward));
                let mut widest: f64 = 0.0;
                for square in squares() {
                    let ray = camera.ray_through_lens(at, square);
                    let offset = ray.origin - middle.origin;
                    assert!(offset.dot(camera.forward).abs() < 1e-12 && offset.length() <= 0.5 + 1e-12);
                    let Bounds { min, max } = camera.origins();
                    assert!(ray.origin.cmpge(min).all() && ray.origin.cmple(max).all(), "{projection:?}");
                    widest = widest.max(offset.length());
                    assert_near(ray.at((meeting - ray.origin).dot(ray.direction)), meeting);
                }
                assert!(widest > 0.4);
            }
        }
        let (camera, pinhole) = with_lens(PROJECTIONS[0]);
        assert_eq!((camera.eye(), camera.has_lens()), (None, true));
        let at = DVec2::new(3.0, 7.0);
        let (a, b) = (pinhole.ray(at), pinhole.ray_through_lens(at, DVec2::new(0.1, 0.9)));
        assert!(a.origin == b.origin && a.direction == b.direction && pinhole.eye().is_some());
    }

    /// A lens of focal length f and diameter A that is in focus at S shows a point at distance D as a disc of diameter
    /// A f |D - S| / (D (S - f)) on a sensor behind it at the distance of the sharp picture, S f / (S - f).
    #[test]
    fn points_out_of_focus_become_discs_as_the_formula_of_thin_lenses_says() {
        let (camera, _) = with_lens(scene::Projection::FieldOfView { degrees: 50.0 });
        let (diameter, in_focus, focal_length) = (1.0, 4.0, 0.7);
        for depth in [1.5, 3.0, 4.0, 9.0, 1e4] {
            let point = camera.position + (camera.forward + camera.right * 0.2 - camera.up * 0.3) * depth;
            let seen: Vec<DVec2> = squares()
                .map(|square| {
                    // Where the line from this point of the lens through the point goes through the plane in focus.
                    let on_lens = camera.position + camera.lens.expect("it has one").point(square);
                    let through = on_lens + (point - on_lens) * (in_focus / depth);
                    let at = camera.project(through, in_focus).at;
                    let ray = camera.ray_through_lens(at, square);
                    assert!((point - ray.at((point - ray.origin).dot(ray.direction))).length() < 1e-9 * depth);
                    at
                })
                .collect();
            let middle = camera.project(point, depth).at;
            let farthest = seen.iter().map(|at| (*at - middle).length()).fold(0.0, f64::max);
            let on_sensor = diameter * focal_length * (depth - in_focus).abs() / (depth * (in_focus - focal_length));
            let sensor_height = 2.0 * tan(25_f64.to_radians()) * in_focus * focal_length / (in_focus - focal_length);
            let expected = on_sensor / 2.0 / sensor_height * 200.0;
            assert!(
                farthest <= expected * 1.000_001 + 1e-9 && farthest >= expected * 0.97,
                "{depth}: {farthest} {expected}"
            );
        }
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

//! Aiming at shapes: points on them, chosen at random as seen from somewhere, with the density of their directions.
//!
//! Whatever a primitive consists of (triangles of a mesh, particles, the operands of a solid) is aimed at piece by piece. Each
//! piece is a form in a space of its own, where choosing is simple. An affine map M from there to the world turns a density p
//! of a direction d into p |M d|³ / |det M|, for unit d: so forms that are stretched or sheared need no code of their own.
//!
//! What hides its other side from whoever looks at it from outside is aimed at on the side that is seen.

pub(crate) mod ball;
mod capsule;
mod cuboid;
mod disc;
mod frustum;
mod rectangle;
#[cfg(test)]
mod tests;
mod torus;
mod triangle;

use crate::{Bounds, Surface};
use capsule::Capsule;
use cuboid::Cuboid;
use disc::Disc;
use durer_math::{DAffine3, DMat3, DVec2, DVec3};
pub(crate) use frustum::Frustum;
use rectangle::Rectangle;
use torus::Torus;
use triangle::Triangle;

/// A point on a shape, chosen as seen from somewhere.
#[derive(Clone, Copy, Debug)]
pub struct Aim {
    /// The surface there.
    pub surface: Surface,
    /// Which part of the primitive it is on.
    pub part: u32,
    /// From where it is seen to a place just before the surface; unit length.
    pub direction: DVec3,
    /// How far away that place is.
    pub distance: f64,
    /// Density of the direction, per solid angle.
    pub pdf: f64,
}

/// How large a piece of a primitive is, and where it faces.
#[derive(Clone, Copy, Debug)]
pub struct Extent {
    /// A box around it, in the world.
    pub bounds: Bounds,
    /// Its area, in the world; of curved pieces that are stretched unevenly, about that.
    pub area: f64,
    /// The unit normal, if it is flat.
    pub normal: Option<DVec3>,
    /// True if it has an inside, so that from outside only its outer side is seen.
    pub is_closed: bool,
}

/// Where the squares of distances differ by no more than this factor, densities per solid angle of points chosen by area differ
/// by its power of 1.5 at most, and surfaces that light falls on make as much of a difference. So it does without the work.
const FAR: f64 = 2.0;

/// A point chosen in the space of a form.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Chosen {
    pub(crate) point: DVec3,
    /// Which part of the form it is on.
    pub(crate) part: u32,
    /// Density of its direction, per solid angle, in that space.
    pub(crate) pdf: f64,
}

/// Which of its sides a form shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Shows {
    /// The outer ones to whoever is outside, and the inner ones to whoever is inside.
    OneSide,
    /// Both, to everyone.
    BothSides,
}

/// What can be aimed at, in its own space.
pub(crate) trait Target {
    /// A point chosen by two numbers from 0 to 1, as seen from `from`; `None` if it does not face there, or nothing does.
    fn sample(&self, from: DVec3, at: DVec2) -> Option<Chosen>;

    /// The density, per solid angle, with which [`Target::sample`] finds a point on a part.
    fn pdf(&self, from: DVec3, point: DVec3, part: u32) -> f64;
}

/// The forms.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Form {
    /// The unit ball.
    Ball(Shows),
    /// In the world itself.
    Triangle(Triangle),
    Rectangle(Rectangle),
    Disc(Disc),
    Frustum(Frustum),
    Cuboid(Cuboid),
    Torus(Torus),
    Capsule(Capsule),
}

/// A form in its place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Piece {
    form: Form,
    /// Where the origin of the form's space is.
    origin: DVec3,
    world_from_form: DMat3,
    form_from_world: DMat3,
    /// How many times larger volumes are in the world; `None` if the map keeps angles, and with them densities.
    volume: Option<f64>,
    /// What the form's parts are counted from.
    first_part: u32,
    area: f64,
}

/// The constructors take the map from canonical space to the world.
impl Piece {
    fn new(form: Form, map: &DAffine3, area: f64) -> Piece {
        let (origin, world_from_form) = (map.translation, map.matrix3);
        let (form_from_world, volume) = match square_if_even(&world_from_form) {
            Some(square) => (world_from_form.transpose() * (1.0 / square), None),
            None => (world_from_form.inverse(), Some(world_from_form.determinant().abs())),
        };
        Piece { form, origin, world_from_form, form_from_world, volume, first_part: 0, area }
    }

    /// The unit ball.
    pub(crate) fn ball(map: &DAffine3, shows: Shows) -> Piece {
        let [x, y, z] = stretches(&map.matrix3);
        let area = 4.0 * std::f64::consts::PI * ((x * x + y * y + z * z) / 3.0).sqrt();
        Piece::new(Form::Ball(shows), map, area)
    }

    /// A triangle with these corners in the world.
    pub(crate) fn triangle(corners: [DVec3; 3]) -> Piece {
        let triangle = Triangle::new(corners);
        let (origin, identity) = (DVec3::ZERO, DMat3::IDENTITY);
        let (form, area) = (Form::Triangle(triangle), triangle.area());
        Piece { form, origin, world_from_form: identity, form_from_world: identity, volume: None, first_part: 0, area }
    }

    /// The square from (0, 0, 0) to (1, 0, 1).
    pub(crate) fn rectangle(map: &DAffine3) -> Piece {
        let edges = [map.matrix3.x_axis, map.matrix3.z_axis];
        let normal = edges[0].cross(edges[1]);
        let lengths = edges.map(DVec3::length);
        let frame = DMat3::from_cols(edges[0] / lengths[0], normal.normalize_or_zero(), edges[1] / lengths[1]);
        let form = Form::Rectangle(Rectangle { lengths });
        Piece::new(form, &DAffine3::from_mat3_translation(frame, map.translation), normal.length())
    }

    /// The unit disc in the plane y = 0, with a hole.
    pub(crate) fn disc(map: &DAffine3, inner_radius: f64) -> Piece {
        let disc = Disc { inner_radius };
        Piece::new(Form::Disc(disc), map, disc.area() * stretches(&map.matrix3)[1])
    }

    /// The frustum about the y axis from y = 0 to y = 1 with the radii `[at base, at top]`. Part 0 is the side, 1 the base, 2
    /// the top.
    pub(crate) fn frustum(map: &DAffine3, radii: [f64; 2], open: bool, shows: Shows) -> Piece {
        let frustum = Frustum::new(radii, open, shows, stretches(&map.matrix3));
        Piece::new(Form::Frustum(frustum), map, frustum.area())
    }

    /// The cube from -1 to 1, with parts as the cuboid counts its faces.
    pub(crate) fn cuboid(map: &DAffine3, shows: Shows) -> Piece {
        let edges = [map.matrix3.x_axis, map.matrix3.y_axis, map.matrix3.z_axis];
        let lengths = edges.map(DVec3::length);
        let frame = DMat3::from_cols(edges[0] / lengths[0], edges[1] / lengths[1], edges[2] / lengths[2]);
        let form = Form::Cuboid(Cuboid { half: DVec3::from(lengths), shows });
        let area = 8.0 * stretches(&map.matrix3).into_iter().sum::<f64>();
        Piece::new(form, &DAffine3::from_mat3_translation(frame, map.translation), area)
    }

    /// The torus about the y axis with major radius 1.
    pub(crate) fn torus(map: &DAffine3, tube_radius: f64, shows: Shows) -> Piece {
        let [x, y, z] = stretches(&map.matrix3);
        let torus = Torus { tube_radius, shows };
        Piece::new(Form::Torus(torus), map, torus.area() * ((x * x + y * y + z * z) / 3.0).sqrt())
    }

    /// The capsule of radius 1 about the y axis, with the centers of its half balls at y = 0 and y = `length`.
    pub(crate) fn capsule(map: &DAffine3, length: f64) -> Piece {
        let [x, y, z] = stretches(&map.matrix3);
        let capsule = Capsule { length };
        Piece::new(Form::Capsule(capsule), map, capsule.area() * ((x * x + y * y + z * z) / 3.0).sqrt())
    }

    /// The same with other numbers for its parts.
    pub(crate) fn with_parts_from(self, first_part: u32) -> Piece {
        Piece { first_part: self.first_part + first_part, ..self }
    }

    pub(crate) fn first_part(&self) -> u32 {
        self.first_part
    }

    /// In the world; about that of curved forms that are stretched unevenly.
    pub(crate) fn area(&self) -> f64 {
        self.area
    }

    /// A box around it.
    pub(crate) fn bounds(&self) -> Bounds {
        let map = DAffine3::from_mat3_translation(self.world_from_form, self.origin);
        let bounds = match &self.form {
            Form::Ball(_) => Bounds { min: DVec3::NEG_ONE, max: DVec3::ONE },
            Form::Triangle(triangle) => return Bounds::of_points(triangle.corners()),
            Form::Rectangle(rectangle) => rectangle.bounds(),
            Form::Disc(_) => Bounds { min: DVec3::new(-1.0, 0.0, -1.0), max: DVec3::new(1.0, 0.0, 1.0) },
            Form::Frustum(frustum) => frustum.bounds(),
            Form::Cuboid(cuboid) => Bounds { min: -cuboid.half, max: cuboid.half },
            Form::Torus(torus) => torus.bounds(),
            Form::Capsule(capsule) => capsule.bounds(),
        };
        bounds.transformed(&map)
    }

    /// A point on it, if it is flat.
    pub(crate) fn middle_of_flat(&self) -> Option<DVec3> {
        let middle = match &self.form {
            Form::Triangle(triangle) => return Some(triangle.middle()),
            Form::Rectangle(Rectangle { lengths: [x, z] }) => DVec3::new(0.5 * x, 0.0, 0.5 * z),
            Form::Disc(_) => DVec3::ZERO,
            Form::Ball(_) | Form::Frustum(_) | Form::Cuboid(_) | Form::Torus(_) | Form::Capsule(_) => return None,
        };
        Some(self.origin + self.world_from_form * middle)
    }

    /// A point, on a part, in the world, with the density of its direction.
    pub(crate) fn sample(&self, from: DVec3, at: DVec2) -> Option<Chosen> {
        let from = self.in_form(from);
        let chosen = self.target().sample(from, at)?;
        let point = self.origin + self.world_from_form * chosen.point;
        let pdf = chosen.pdf * self.crowding(chosen.point - from);
        Some(Chosen { point, part: self.first_part + chosen.part, pdf })
    }

    /// The density, per solid angle, with which [`Piece::sample`] finds a point on a part.
    pub(crate) fn pdf(&self, from: DVec3, point: DVec3, part: u32) -> f64 {
        let (from, point) = (self.in_form(from), self.in_form(point));
        self.target().pdf(from, point, part - self.first_part) * self.crowding(point - from)
    }

    fn target(&self) -> &dyn Target {
        match &self.form {
            Form::Ball(shows) => shows,
            Form::Triangle(triangle) => triangle,
            Form::Rectangle(rectangle) => rectangle,
            Form::Disc(disc) => disc,
            Form::Frustum(frustum) => frustum,
            Form::Cuboid(cuboid) => cuboid,
            Form::Torus(torus) => torus,
            Form::Capsule(capsule) => capsule,
        }
    }

    fn in_form(&self, point: DVec3) -> DVec3 {
        self.form_from_world * (point - self.origin)
    }

    /// How much denser directions are in the world than in the form's space.
    fn crowding(&self, way: DVec3) -> f64 {
        let Some(volume) = self.volume else { return 1.0 };
        let stretch = (self.world_from_form * way).length() / way.length();
        stretch * stretch * stretch / volume
    }
}

/// The square of the factor by which a map stretches all lengths, if that is one.
fn square_if_even(map: &DMat3) -> Option<f64> {
    const SLACK: f64 = 1e-12;
    let [x, y, z] = [map.x_axis, map.y_axis, map.z_axis];
    let squares = [x, y, z].map(DVec3::length_squared);
    let slack = squares[0] * SLACK;
    let is_even = (squares[1] - squares[0]).abs() <= slack && (squares[2] - squares[0]).abs() <= slack;
    let turns = x.dot(y).abs() <= slack && y.dot(z).abs() <= slack && z.dot(x).abs() <= slack;
    (is_even && turns && squares[0] > 0.0).then_some(squares[0])
}

/// By how much a map stretches areas that are perpendicular to the three axes.
fn stretches(map: &DMat3) -> [f64; 3] {
    let (x, y, z) = (map.x_axis, map.y_axis, map.z_axis);
    [y.cross(z).length(), z.cross(x).length(), x.cross(y).length()]
}

/// A density per area, at a point with this unit normal, as one per solid angle seen from somewhere; 0 if seen edge-on.
fn per_solid_angle(per_area: f64, from: DVec3, point: DVec3, normal: DVec3) -> f64 {
    let way = from - point;
    let squared = way.length_squared();
    let height = way.dot(normal).abs();
    if height > 0.0 { per_area * squared * squared.sqrt() / height } else { 0.0 }
}

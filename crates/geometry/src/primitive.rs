//! A shape placed in the world, and the points on it from which new rays may start.

use crate::packet::{LANES, Packet, PacketHits};
use crate::shapes::{
    Shape, cone::Cone, cuboid::Cuboid, cylinder::Cylinder, disc::Disc, mesh::Mesh, particles::Particles, plane::Plane,
    rectangle::Rectangle, solid::Solid, sphere::Sphere, torus::Torus, triangle::Triangle,
};
use crate::slender::{Form, Slender};
use crate::{Bounds, Crossing, Ray, Work};
use durer_math::{DAffine3, DMat3, DVec2, DVec3, rotation_between};
use std::sync::Arc;

/// A shape in its canonical space. To add one, see CONTRIBUTING.md.
#[derive(Clone, Debug)]
enum Kind {
    Plane(Plane),
    Sphere(Sphere),
    Cuboid(Cuboid),
    Cylinder(Cylinder),
    Cone(Cone),
    Disc(Disc),
    Rectangle(Rectangle),
    Triangle(Triangle),
    Torus(Torus),
    Mesh(Arc<Mesh>),
    Particles(Arc<Particles>),
    Solid(Arc<Solid>),
}

/// Evaluates an expression for whatever shape it is: a call of a method of [`Shape`] on whatever shape it is.
macro_rules! each_kind {
    ($kind:expr, $shape:ident => $call:expr) => {
        match $kind {
            Kind::Plane($shape) => $call,
            Kind::Sphere($shape) => $call,
            Kind::Cuboid($shape) => $call,
            Kind::Cylinder($shape) => $call,
            Kind::Cone($shape) => $call,
            Kind::Disc($shape) => $call,
            Kind::Rectangle($shape) => $call,
            Kind::Triangle($shape) => $call,
            Kind::Torus($shape) => $call,
            Kind::Mesh(mesh) => {
                let $shape = &**mesh;
                $call
            }
            Kind::Particles(particles) => {
                let $shape = &**particles;
                $call
            }
            Kind::Solid(solid) => {
                let $shape = &**solid;
                $call
            }
        }
    };
}

/// More surfaces one behind the other than this are not looked at: what light is left then is nothing.
const MOST_CROSSINGS: u32 = 100_000;

mod flat;
pub(crate) mod operand;
mod pieces;
mod round;

pub use pieces::Aimable;
pub use round::Round;

/// A shape placed in the world by an affine map, which may scale, shear and mirror it.
#[derive(Clone, Debug)]
pub struct Primitive {
    kind: Kind,
    /// A bit for each class of rays that sees it; a query names the classes that it asks for.
    pub mask: u32,
    /// Where the origin of the canonical space is, in the world.
    origin: DVec3,
    world_from_shape: DMat3,
    shape_from_world: DMat3,
    /// For a flat shape its unit normal in the world and one over the stretch of it; the same everywhere on it.
    flat: Option<(DVec3, f64)>,
    /// A ball around it in the world: its middle, and the square of its radius, or a little more.
    ball: (DVec3, f64),
    /// Norms (greatest sum of a row) of the two matrices, for bounds on rounding errors.
    norms: [f64; 2],
    /// How far the two are from being inverse to each other: the norm of their product less the identity.
    residual: f64,
}

/// A point on a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface {
    /// The point, in world space, as near to the surface as numbers allow.
    pub point: DVec3,
    /// The outward normal, in world space, of unit length.
    pub normal: DVec3,
    /// How far from `point` along the normal one is surely on that side of the surface, whatever is rounded.
    pub offset: f64,
}

impl Surface {
    /// What goes on of a ray behind it.
    #[inline]
    pub fn onward(&self, ray: &Ray) -> Ray {
        let onward = self.offset.copysign(ray.direction.dot(self.normal));
        Ray { origin: self.point + self.normal * onward, direction: ray.direction }
    }
}

/// The constructors take measures in an object's space, and the map from there to the world.
impl Primitive {
    /// The infinite plane through `point`, facing `normal`.
    pub fn plane(point: DVec3, normal: DVec3, world_from_object: &DAffine3) -> Primitive {
        let frame = DAffine3::from_mat3_translation(rotation_between(DVec3::Y, normal.normalize()), point);
        Primitive::place(Kind::Plane(Plane {}), &(*world_from_object * frame))
    }

    /// A ball.
    pub fn sphere(center: DVec3, radius: f64, world_from_object: &DAffine3) -> Primitive {
        let frame = DAffine3::from_mat3_translation(DMat3::from_diagonal(DVec3::splat(radius)), center);
        Primitive::place(Kind::Sphere(Sphere {}), &(*world_from_object * frame))
    }

    /// A box along the object's axes.
    pub fn cuboid(min: DVec3, max: DVec3, world_from_object: &DAffine3) -> Primitive {
        let half = (max - min) * 0.5;
        let frame = DAffine3::from_mat3_translation(DMat3::from_diagonal(half), min + half);
        Primitive::place(Kind::Cuboid(Cuboid {}), &(*world_from_object * frame))
    }

    /// A cylinder between the middles of its ends; `open` ones have no caps.
    pub fn cylinder(base: DVec3, top: DVec3, radius: f64, open: bool, world_from_object: &DAffine3) -> Primitive {
        let half_axis = (top - base) * 0.5;
        let frame = axial_frame(half_axis, radius, base + half_axis);
        Primitive::place(Kind::Cylinder(Cylinder { open }), &(*world_from_object * frame))
    }

    /// A cone or frustum with the radii `[at base, at top]`; `open` ones have no caps.
    pub fn cone(base: DVec3, top: DVec3, radii: [f64; 2], open: bool, world_from_object: &DAffine3) -> Primitive {
        let largest = radii[0].max(radii[1]);
        let cone = Cone { base_radius: radii[0] / largest, top_radius: radii[1] / largest, open };
        Primitive::place(Kind::Cone(cone), &(*world_from_object * axial_frame(top - base, largest, base)))
    }

    /// A flat disc with the radii `[of the hole, of the rim]`.
    pub fn disc(center: DVec3, normal: DVec3, radii: [f64; 2], world_from_object: &DAffine3) -> Primitive {
        let disc = Disc { inner_radius: radii[0] / radii[1] };
        let frame = axial_frame(normal.normalize() * radii[1], radii[1], center);
        Primitive::place(Kind::Disc(disc), &(*world_from_object * frame))
    }

    /// The parallelogram at `corner` between two edges; it faces `edges[0] × edges[1]`.
    pub fn rectangle(corner: DVec3, edges: [DVec3; 2], world_from_object: &DAffine3) -> Primitive {
        let normal = edges[0].cross(edges[1]);
        // Any length serves; one like the edges' keeps the map well-conditioned.
        let normal = normal * (normal.length().sqrt() / normal.length());
        let frame = DAffine3::from_mat3_translation(DMat3::from_cols(edges[0], normal, edges[1]), corner);
        Primitive::place(Kind::Rectangle(Rectangle {}), &(*world_from_object * frame))
    }

    /// A triangle; it faces the side from which its vertices run counter-clockwise.
    pub fn triangle(vertices: [DVec3; 3], uvs: [DVec2; 3], world_from_object: &DAffine3) -> Primitive {
        let mut vertices = vertices.map(|v| world_from_object.transform_point3(v));
        let mut uvs = uvs;
        if world_from_object.matrix3.determinant() < 0.0 {
            // A mirrored triangle keeps its front side.
            vertices.swap(1, 2);
            uvs.swap(1, 2);
        }
        Primitive::place(Kind::Triangle(Triangle { vertices, uvs }), &DAffine3::IDENTITY)
    }

    /// A torus with the radii `[of the ring, of the tube]`.
    pub fn torus(center: DVec3, axis: DVec3, radii: [f64; 2], world_from_object: &DAffine3) -> Primitive {
        let torus = Torus { tube_radius: radii[1] / radii[0] };
        let frame = axial_frame(axis.normalize() * radii[0], radii[0], center);
        Primitive::place(Kind::Torus(torus), &(*world_from_object * frame))
    }

    /// A triangle mesh whose positions are relative to `origin`. Those who share a mesh share its tree.
    pub fn mesh(mesh: Arc<Mesh>, origin: DVec3, world_from_object: &DAffine3) -> Primitive {
        Primitive::place(Kind::Mesh(mesh), &(*world_from_object * DAffine3::from_translation(origin)))
    }

    /// Particles. Those who share them share their tree.
    pub fn particles(particles: Arc<Particles>, world_from_object: &DAffine3) -> Primitive {
        let frame = DAffine3::from_translation(particles.origin());
        Primitive::place(Kind::Particles(particles), &(*world_from_object * frame))
    }

    /// The same thing in the space of an object, placed in the world.
    pub fn placed(&self, world_from_object: &DAffine3) -> Primitive {
        let object_from_shape = DAffine3 { matrix3: self.world_from_shape, translation: self.origin };
        Primitive { mask: self.mask, ..Primitive::place(self.kind.clone(), &(*world_from_object * object_from_shape)) }
    }

    fn place(kind: Kind, world_from_shape: &DAffine3) -> Primitive {
        let world = world_from_shape.matrix3;
        // One step of Newton's iteration: cofactors alone lose digits where a map stretches unevenly.
        let rough = world.inverse();
        let inverse = rough + rough * (DMat3::IDENTITY - world * rough);
        let flat = match kind {
            Kind::Plane(_) | Kind::Disc(_) | Kind::Rectangle(_) => Some(outward_normal(&inverse, DVec3::Y)),
            Kind::Sphere(_)
            | Kind::Cuboid(_)
            | Kind::Cylinder(_)
            | Kind::Cone(_)
            | Kind::Triangle(_)
            | Kind::Torus(_)
            | Kind::Mesh(_)
            | Kind::Particles(_)
            | Kind::Solid(_) => None,
        };
        Primitive {
            ball: ball_around(&kind, world_from_shape),
            flat,
            kind,
            mask: u32::MAX,
            origin: world_from_shape.translation,
            world_from_shape: world,
            shape_from_world: inverse,
            norms: [row_norm(&world), row_norm(&inverse)],
            residual: row_norm(&(inverse * world - DMat3::IDENTITY)),
        }
    }
}

impl Primitive {
    /// A box around it in world space; infinite for a plane.
    pub fn bounds(&self) -> Bounds {
        let map = DAffine3 { matrix3: self.world_from_shape, translation: self.origin };
        match &self.kind {
            Kind::Plane(plane) => plane.bounds(),
            kind => each_kind!(kind, shape => shape.bounds()).transformed(&map),
        }
    }

    /// Calls `visit` with the things that this consists of: with each of particles (some of them more than once) and its
    /// number; and, with the number 0, with each triangle of a mesh, each shape of a solid, pieces of a ring, and with other
    /// shapes as a whole; with nothing if it is an infinite plane.
    pub fn each_slender(&self, visit: &mut dyn FnMut(Slender, u32)) {
        let (map, origin) = (&self.world_from_shape, self.origin);
        let mut place = |one: Slender, number: u32| visit(one.mapped(map, origin), number);
        let form = match &self.kind {
            Kind::Plane(_) => return,
            Kind::Particles(particles) => return particles.each_slender(&mut place),
            Kind::Mesh(mesh) => {
                let part = |corners| Slender { is_part: true, ..Slender::of_triangle(corners) };
                return mesh.each_triangle(|corners| place(part(corners), 0));
            }
            Kind::Solid(solid) => {
                return solid.shapes().for_each(|shape| shape.each_slender(&mut |one, _| place(one, 0)));
            }
            Kind::Torus(torus) => return Slender::each_of_ring(1.0, torus.tube_radius, &mut |one| place(one, 0)),
            Kind::Triangle(triangle) => return place(Slender::of_triangle(triangle.vertices), 0),
            Kind::Disc(Disc { inner_radius }) if *inner_radius > 0.0 => {
                let (middle, half_width) = (0.5 * (1.0 + inner_radius), 0.5 * (1.0 - inner_radius));
                return Slender::each_of_ring(middle, half_width, &mut |one| place(one, 0));
            }
            Kind::Sphere(_) => Form::Ball,
            Kind::Disc(_) => Form::Disc,
            Kind::Cylinder(_) | Kind::Cone(_) => Form::Rod,
            Kind::Cuboid(_) | Kind::Rectangle(_) => Form::Any,
        };
        visit(Slender::of_box(&each_kind!(&self.kind, shape => shape.bounds()), form, map, origin), 0);
    }

    /// About how many things [`Primitive::each_slender`] tells of, at most.
    pub fn thing_count(&self) -> usize {
        match &self.kind {
            Kind::Plane(_) => 0,
            Kind::Particles(particles) => particles.count(),
            Kind::Mesh(mesh) => mesh.triangle_count(),
            Kind::Solid(solid) => solid.shapes().map(Primitive::thing_count).sum(),
            Kind::Sphere(_)
            | Kind::Cuboid(_)
            | Kind::Cylinder(_)
            | Kind::Cone(_)
            | Kind::Disc(_)
            | Kind::Rectangle(_)
            | Kind::Triangle(_)
            | Kind::Torus(_) => 1,
        }
    }

    /// For an infinite plane, its normal (scaled as the map scales it) and a point on it.
    pub(crate) fn as_plane(&self) -> Option<[DVec3; 2]> {
        match self.kind {
            Kind::Plane(_) => Some([self.shape_from_world.row(1), self.origin]),
            Kind::Sphere(_)
            | Kind::Cuboid(_)
            | Kind::Cylinder(_)
            | Kind::Cone(_)
            | Kind::Disc(_)
            | Kind::Rectangle(_)
            | Kind::Triangle(_)
            | Kind::Torus(_)
            | Kind::Mesh(_)
            | Kind::Particles(_)
            | Kind::Solid(_) => None,
        }
    }

    /// Bytes that it shares with others: those of a mesh, of particles or of a solid.
    pub fn shared_memory(&self) -> usize {
        match &self.kind {
            Kind::Mesh(mesh) => mesh.memory(),
            Kind::Particles(particles) => particles.memory(),
            Kind::Solid(solid) => solid.memory(),
            _ => 0,
        }
    }

    /// For particles, the number of the one that a part belongs to.
    pub fn particle_of(&self, part: u32) -> Option<u32> {
        if let Kind::Particles(particles) = &self.kind { Some(particles.particle_of(part)) } else { None }
    }

    /// Which piece of it a part belongs to: a mesh is one piece, of others each face or particle is one.
    pub fn piece_of(&self, part: u32) -> u32 {
        match &self.kind {
            Kind::Mesh(_) => 0,
            Kind::Particles(particles) => particles.particle_of(part),
            Kind::Plane(_)
            | Kind::Sphere(_)
            | Kind::Cuboid(_)
            | Kind::Cylinder(_)
            | Kind::Cone(_)
            | Kind::Disc(_)
            | Kind::Rectangle(_)
            | Kind::Triangle(_)
            | Kind::Torus(_)
            | Kind::Solid(_) => part,
        }
    }

    /// The nearest crossing with 0 < t < `t_max`.
    #[inline]
    pub fn intersect(&self, ray: &Ray, t_max: f64) -> Option<Crossing> {
        // Mapped in each arm anew, so that the compiler drops the coordinates that a flat shape does not look at.
        each_kind!(&self.kind, shape => shape.intersect(&self.ray_in_shape(ray), t_max))
    }

    /// As [`Primitive::intersect`], adding what it took.
    pub fn intersect_watched(&self, ray: &Ray, t_max: f64, work: &mut Work) -> Option<Crossing> {
        each_kind!(&self.kind, shape => shape.intersect_watched(&self.ray_in_shape(ray), t_max, work))
    }

    /// True if there is a crossing with 0 < t < `t_max`.
    #[inline]
    pub fn meets(&self, ray: &Ray, t_max: f64) -> bool {
        each_kind!(&self.kind, shape => shape.meets(&self.ray_in_shape(ray), t_max))
    }

    /// As [`Primitive::intersect`] for the rays of a packet: hits nearer than those in `hits` take their places.
    pub(crate) fn intersect_packet(&self, packet: &Packet, hits: &mut PacketHits) {
        match &self.kind {
            Kind::Mesh(mesh) => mesh.intersect_packet(&self.packet_in_shape(packet), hits),
            _ => {
                for lane in 0..packet.count() {
                    if let Some(crossing) = self.intersect(&packet.ray(lane), hits.t[lane]) {
                        (hits.t[lane], hits.part[lane]) = (crossing.t, f64::from(crossing.part));
                    }
                }
            }
        }
    }

    /// As [`Primitive::meets`] for the rays of a packet, one bit each.
    pub(crate) fn meets_packet(&self, packet: &Packet, t_max: &[f64; LANES]) -> u32 {
        match &self.kind {
            Kind::Mesh(mesh) => mesh.meets_packet(&self.packet_in_shape(packet), t_max),
            _ => (0..packet.count())
                .fold(0, |met, lane| met | u32::from(self.meets(&packet.ray(lane), t_max[lane])) << lane),
        }
    }

    /// How often the ray crosses it with 0 < t < `t_max`.
    pub fn count_crossings(&self, ray: &Ray, t_max: f64) -> u32 {
        let (mut ray, mut t_max, most) = (*ray, t_max, self.most_crossings());
        for count in 0..most {
            let Some(crossing) = self.intersect(&ray, t_max) else { return count };
            if count + 1 < most {
                (ray, t_max) = (self.surface(&ray, &crossing).onward(&ray), t_max - crossing.t);
            }
        }
        most
    }

    /// Calls `visit` for one crossing with 0 < t < `t_max` after the other, from near to far, until it returns true; gives
    /// whether it did.
    ///
    /// `visit` gets the ray from the surface before, the crossing of that ray, and the surface there.
    pub fn each_crossing(
        &self,
        ray: &Ray,
        t_max: f64,
        mut visit: impl FnMut(&Ray, &Crossing, &Surface) -> bool,
    ) -> bool {
        let (mut ray, mut t_max) = (*ray, t_max);
        for _ in 0..self.most_crossings() {
            let Some(crossing) = self.intersect(&ray, t_max) else { return false };
            let surface = self.surface(&ray, &crossing);
            if visit(&ray, &crossing, &surface) {
                return true;
            }
            (ray, t_max) = (surface.onward(&ray), t_max - crossing.t);
        }
        false
    }

    /// A bound on how often a straight line crosses it, so that no loop over crossings runs on for ever.
    fn most_crossings(&self) -> u32 {
        match self.kind {
            Kind::Plane(_) | Kind::Disc(_) | Kind::Rectangle(_) | Kind::Triangle(_) => 1,
            Kind::Sphere(_) | Kind::Cuboid(_) | Kind::Cylinder(_) | Kind::Cone(_) => 2,
            Kind::Torus(_) => 4,
            Kind::Mesh(_) | Kind::Particles(_) | Kind::Solid(_) => MOST_CROSSINGS,
        }
    }

    /// The surface at a crossing of `ray`.
    #[inline]
    pub fn surface(&self, ray: &Ray, crossing: &Crossing) -> Surface {
        let near = ray.at(crossing.t);
        each_kind!(&self.kind, shape => self.surface_of(shape, near, crossing.part))
    }

    #[inline(always)]
    fn surface_of(&self, shape: &impl Shape, near: DVec3, part: u32) -> Surface {
        let (snapped, canonical_normal) = shape.surface(self.in_shape(near), part);
        let point = self.origin + self.world_from_shape * snapped;
        let (normal, per_stretch) = match self.flat {
            Some(known) => known,
            None => outward_normal(&self.shape_from_world, canonical_normal),
        };
        // How far the point may seem to be from the surface when a new ray's origin is mapped back to the canonical
        // space: the shape's own rounding, that of the inverse map, and that of applying the two maps (a few operations
        // of half an ulp each).
        let [world_norm, shape_norm] = self.norms;
        let reach = world_norm * largest(snapped) + largest(point) + largest(self.origin);
        let rounding = shape.rounding_at(snapped, canonical_normal, part);
        let doubt = rounding + self.residual * largest(snapped) + 16.0 * f64::EPSILON * shape_norm * reach;
        // A step of s along the world's unit normal is one of s · stretch along the canonical one.
        Surface { point, normal, offset: 4.0 * doubt * per_stretch }
    }

    /// Texture coordinates at a point of the surface.
    pub fn uv(&self, point: DVec3, part: u32) -> DVec2 {
        let point = self.in_shape(point);
        each_kind!(&self.kind, shape => shape.uv(point, part))
    }

    /// The unit normal that shading is to use at a point of the surface, in the world, if it is not the surface's own:
    /// interpolated between the vertices of a mesh. It may point to either side.
    pub fn shading_normal(&self, point: DVec3, part: u32) -> Option<DVec3> {
        let point = self.in_shape(point);
        let normal = match &self.kind {
            Kind::Mesh(mesh) => mesh.shading_normal(point, part)?,
            Kind::Solid(solid) => {
                let (shape, part) = solid.shape_of(part);
                shape.shading_normal(point, part)?
            }
            _ => return None,
        };
        let normal = self.shape_from_world.transpose() * normal;
        // Opposite normals may cancel out.
        normal.try_normalize()
    }

    /// From a point on a triangle of a mesh to the rounder surface that its normals tell of, on the side that `normal` points to;
    /// `None` if there is none, or it lies on the other side.
    pub fn lift(&self, point: DVec3, part: u32, normal: DVec3) -> Option<DVec3> {
        let Kind::Mesh(mesh) = &self.kind else { return None };
        let point = self.in_shape(point);
        let own = self.shape_from_world.transpose() * mesh.shading_normal(point, part)?;
        let lift = mesh.lift(point, part, own.dot(normal) < 0.0)?;
        Some(self.world_from_shape * lift).filter(|lift| lift.is_finite())
    }

    /// The weights of a triangle's three vertices at a point of it, if it is a mesh, or a solid that has the triangle from
    /// one.
    pub fn vertex_weights(&self, point: DVec3, part: u32) -> Option<[f64; 3]> {
        let point = self.in_shape(point);
        match &self.kind {
            Kind::Mesh(mesh) => Some(mesh.weights(point, part)),
            Kind::Solid(solid) => {
                let (shape, part) = solid.shape_of(part);
                shape.vertex_weights(point, part)
            }
            _ => None,
        }
    }

    /// True for a point inside; always false for what has no inside.
    pub fn contains(&self, point: DVec3) -> bool {
        let point = self.in_shape(point);
        each_kind!(&self.kind, shape => shape.contains(point))
    }

    /// The same arithmetic as for a single ray, lane by lane.
    #[inline(always)]
    fn packet_in_shape(&self, packet: &Packet) -> Packet {
        packet.map(|ray| self.ray_in_shape(&ray))
    }

    #[inline(always)]
    fn ray_in_shape(&self, ray: &Ray) -> Ray {
        Ray { origin: self.in_shape(ray.origin), direction: self.shape_from_world * ray.direction }
    }

    /// Subtracting first keeps small things far from the origin sharp.
    #[inline(always)]
    fn in_shape(&self, point: DVec3) -> DVec3 {
        self.shape_from_world * (point - self.origin)
    }
}

/// The world's unit normal for a unit normal in canonical space, and one over its stretch. Normals map by the inverse
/// transpose.
#[inline(always)]
fn outward_normal(shape_from_world: &DMat3, normal: DVec3) -> (DVec3, f64) {
    let outward = shape_from_world.transpose() * normal;
    let per_stretch = 1.0 / outward.length();
    (outward * per_stretch, per_stretch)
}

/// The frame whose y axis is `axis` (with its length) and whose other axes have length `radius`.
fn axial_frame(axis: DVec3, radius: f64, origin: DVec3) -> DAffine3 {
    let length = axis.length();
    let turn = rotation_between(DVec3::Y, axis / length);
    DAffine3::from_mat3_translation(turn * DMat3::from_diagonal(DVec3::new(radius, length, radius)), origin)
}

/// The middle of a ball around a shape, and the square of its radius, or a little more.
fn ball_around(kind: &Kind, world_from_shape: &DAffine3) -> (DVec3, f64) {
    let map = &world_from_shape.matrix3;
    let Bounds { min, max } = each_kind!(kind, shape => shape.bounds());
    let half = (max - min) * 0.5;
    let squared_radius = match kind {
        // The square of the greatest stretch is at most this product.
        Kind::Sphere(_) => row_norm(map) * row_norm(&map.transpose()),
        Kind::Plane(_)
        | Kind::Cuboid(_)
        | Kind::Cylinder(_)
        | Kind::Cone(_)
        | Kind::Disc(_)
        | Kind::Rectangle(_)
        | Kind::Triangle(_)
        | Kind::Torus(_)
        | Kind::Mesh(_)
        | Kind::Particles(_)
        | Kind::Solid(_) => {
            let corners = [(1.0, 1.0), (-1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)];
            let corners = corners.map(|(x, y)| (*map * (half * DVec3::new(x, y, 1.0))).length_squared());
            // Without end, or NaN, it reaches everywhere.
            corners.into_iter().fold(0.0, |most, squared| if squared <= most { most } else { squared })
        }
    };
    (world_from_shape.transform_point3((min + max) * 0.5), squared_radius * (1.0 + 1e-6))
}

fn row_norm(m: &DMat3) -> f64 {
    largest(m.x_axis.abs() + m.y_axis.abs() + m.z_axis.abs())
}

fn largest(v: DVec3) -> f64 {
    v.abs().max_element()
}

//! What of a primitive is aimed at, piece by piece.
//!
//! A piece is known by its element: the first of the parts that belong to it.

use super::{Kind, Primitive, Surface};
use crate::Ray;
use crate::sample::{Aim, Extent, Piece, Shows};
use crate::shapes::Shape;
use durer_math::{DAffine3, DMat3, DVec2, DVec3};

/// How far, relative to the distance, a point may seem to be from the crossing that it is.
const SAME: f64 = 1e-7;

/// An element of a primitive that is aimed at: what of that depends on neither eye nor chance.
#[derive(Clone, Copy, Debug)]
pub struct Aimable {
    piece: Piece,
    flat: Option<Flat>,
}

/// What all points of a flat element have in common, as [`Surface`] means it.
#[derive(Clone, Copy, Debug)]
struct Flat {
    normal: DVec3,
    offset: f64,
    /// Of its plane from the origin of the world, along the normal.
    height: f64,
}

impl Aimable {
    /// True if it is flat, and is seen from there from behind, where its normal does not point.
    #[inline]
    pub fn is_seen_from_behind(&self, from: DVec3) -> bool {
        self.flat.is_some_and(|flat| flat.normal.dot(from) < flat.height)
    }

    /// The density, per solid angle, with which [`Primitive::aim`] finds a point on a part of it, as seen from somewhere.
    pub fn pdf(&self, from: DVec3, point: DVec3, part: u32) -> f64 {
        let pdf = self.piece.pdf(from, point, part);
        if pdf > 0.0 && pdf.is_finite() { pdf } else { 0.0 }
    }
}

impl Primitive {
    /// Calls `visit` with each element: the triangles of a mesh, particles, those of a solid's operands, or 0 for all of
    /// another shape. What has no end has none.
    pub fn each_element(&self, visit: &mut dyn FnMut(u32)) {
        match &self.kind {
            Kind::Plane(_) => {}
            Kind::Mesh(mesh) => (0..mesh.triangle_count() as u32).for_each(visit),
            Kind::Particles(particles) => particles.each_element(visit),
            Kind::Solid(solid) => {
                for (shape, first) in solid.shapes().zip(solid.leaf_starts()) {
                    shape.each_element(&mut |element| visit(first + element));
                }
            }
            Kind::Sphere(_)
            | Kind::Cuboid(_)
            | Kind::Cylinder(_)
            | Kind::Cone(_)
            | Kind::Disc(_)
            | Kind::Rectangle(_)
            | Kind::Triangle(_)
            | Kind::Torus(_) => visit(0),
        }
    }

    /// The element that a part belongs to.
    pub fn element_of(&self, part: u32) -> u32 {
        match &self.kind {
            Kind::Mesh(_) => part,
            Kind::Particles(particles) => particles.element_of(part),
            Kind::Solid(solid) => {
                let (shape, own) = solid.shape_of(part);
                part - own + shape.element_of(own)
            }
            Kind::Plane(_)
            | Kind::Sphere(_)
            | Kind::Cuboid(_)
            | Kind::Cylinder(_)
            | Kind::Cone(_)
            | Kind::Disc(_)
            | Kind::Rectangle(_)
            | Kind::Triangle(_)
            | Kind::Torus(_) => 0,
        }
    }

    /// The size of an element; `None` if it has no area. Of a solid's operand, what is cut away counts, too.
    pub fn extent(&self, element: u32) -> Option<Extent> {
        let piece = self.piece(element)?;
        let (bounds, area) = (piece.bounds(), piece.area());
        if !(area > 0.0 && area.is_finite() && bounds.size().is_finite()) {
            return None;
        }
        let normal = piece.middle_of_flat().map(|middle| self.surface_near(middle, piece.first_part()).normal);
        Some(Extent { bounds, area, normal, is_closed: self.has_inside() })
    }

    /// An element to be aimed at; `None` if it has no end.
    pub fn aimable(&self, element: u32) -> Option<Aimable> {
        let piece = self.piece(element)?;
        let flat = self.flat.map(|(normal, _)| {
            // What is rounded grows with coordinates, so that it is most at a corner.
            let offset = |corner: DVec3| {
                let corner = self.origin + self.world_from_shape * corner;
                self.surface_near(corner, piece.first_part()).offset
            };
            let corners = each_kind!(&self.kind, shape => shape.bounds()).corners();
            Flat {
                normal,
                offset: corners.map(offset).into_iter().fold(0.0, f64::max),
                height: normal.dot(self.origin),
            }
        });
        Some(Aimable { piece, flat })
    }

    /// A point on one of its elements, chosen by two numbers from 0 to 1 as seen from somewhere; `None` if that one is not seen
    /// from there, or not there at all: of a solid, because it is cut away.
    pub fn aim(&self, target: &Aimable, from: DVec3, at: DVec2) -> Option<Aim> {
        let chosen = target.piece.sample(from, at)?;
        let surface = match target.flat {
            Some(Flat { normal, offset, height: _ }) => Surface { point: chosen.point, normal, offset },
            None => self.surface_near(chosen.point, chosen.part),
        };
        let side = surface.normal.dot(from - surface.point);
        // From a place on the surface itself there is nothing to see, but for rounding.
        if side.abs() <= 2.0 * surface.offset {
            return None;
        }
        let way = surface.point + surface.normal * surface.offset.copysign(side) - from;
        let distance = way.length();
        let aim = Aim { surface, part: chosen.part, direction: way / distance, distance, pdf: chosen.pdf };
        let is_usable = distance > 0.0 && distance.is_finite() && aim.pdf > 0.0 && aim.pdf.is_finite();
        (is_usable && self.is_met(from, &aim)).then_some(aim)
    }

    /// True if a ray crosses the surface where it is aimed. Only of solids is there less than what is aimed at; and of two
    /// operands that have a face in common, rays meet but one.
    fn is_met(&self, from: DVec3, aim: &Aim) -> bool {
        let Kind::Solid(_) = self.kind else { return true };
        let (ray, slack) =
            (Ray { origin: from, direction: aim.direction }, aim.distance * SAME + 8.0 * aim.surface.offset);
        let element = self.element_of(aim.part);
        self.each_crossing(&ray, aim.distance + 2.0 * slack, |_, crossing, surface| {
            self.element_of(crossing.part) == element && (surface.point - aim.surface.point).length() <= slack
        })
    }

    fn piece(&self, element: u32) -> Option<Piece> {
        self.piece_in(None, element, Shows::OneSide)
    }

    /// The piece of an element, placed by one more map.
    fn piece_in(&self, outer: Option<&DAffine3>, element: u32, shows: Shows) -> Option<Piece> {
        let map = DAffine3 { matrix3: self.world_from_shape, translation: self.origin };
        let map = outer.map_or(map, |outer| *outer * map);
        Some(match &self.kind {
            Kind::Plane(_) => return None,
            Kind::Sphere(_) => Piece::ball(&map, shows),
            Kind::Cuboid(_) => Piece::cuboid(&map, shows),
            Kind::Cylinder(cylinder) => {
                let from_base =
                    DAffine3::from_mat3_translation(DMat3::from_diagonal(DVec3::new(1.0, 2.0, 1.0)), DVec3::NEG_Y);
                Piece::frustum(&(map * from_base), [1.0, 1.0], cylinder.open, shows)
            }
            Kind::Cone(cone) => Piece::frustum(&map, [cone.base_radius, cone.top_radius], cone.open, shows),
            Kind::Disc(disc) => Piece::disc(&map, disc.inner_radius),
            Kind::Rectangle(_) => Piece::rectangle(&map),
            Kind::Triangle(triangle) => Piece::triangle(triangle.vertices.map(|v| map.transform_point3(v))),
            Kind::Torus(torus) => Piece::torus(&map, torus.tube_radius, shows),
            Kind::Mesh(mesh) => {
                let corners = mesh.corners(element).map(|corner| map.transform_point3(corner));
                Piece::triangle(corners).with_parts_from(element)
            }
            Kind::Particles(particles) => particles.piece(element, &map)?.with_parts_from(element),
            Kind::Solid(solid) => {
                let (shape, own) = solid.shape_of(element);
                // What is taken away is seen from within.
                let shows = if solid.is_flipped(element) { Shows::BothSides } else { shows };
                shape.piece_in(Some(&map), own, shows)?.with_parts_from(element - own)
            }
        })
    }

    /// True if it has an inside that its own surface hides.
    fn has_inside(&self) -> bool {
        match &self.kind {
            Kind::Sphere(_) | Kind::Cuboid(_) | Kind::Torus(_) | Kind::Solid(_) => true,
            Kind::Cylinder(cylinder) => !cylinder.open,
            Kind::Cone(cone) => !cone.open,
            Kind::Mesh(mesh) => mesh.is_closed(),
            Kind::Particles(particles) => particles.are_closed(),
            Kind::Plane(_) | Kind::Disc(_) | Kind::Rectangle(_) | Kind::Triangle(_) => false,
        }
    }
}

//! Casters: balls and cylinders of smooth glass, and balls and cylinders that are mirrors, which throw light of the sky in bright
//! lines and spots.
//!
//! Who looks for light at random, from where it falls, seldom hits on a small sun through a small ball. But light goes through what
//! is [round](Round) in a known way: to each direction from which it comes there are at most three rays from a point that leave the
//! ball there, and all of them can be [found](turn). So a path may aim at the sky through a caster as it does past it: the
//! direction is chosen as for any emitter, then a caster, and the rays that go there are followed.
//!
//! In the end each such ray has a density among those from its point: that of the direction of light, times the chance of the
//! caster, times the solid angle of directions that a solid angle of rays becomes. It can be told for rays that were found
//! otherwise, too, so both ways are weighed against each other (Veach 1997, §9), and a scene is as bright as without.
//!
//! A cylinder leaves alone the part of a direction that is along its axis, and what is across is turned by a circle, as if the
//! index were √(n² - w²) / √(1 - w²), where w is the part along.

mod turn;

use crate::background::Background;
use crate::compile::CompiledScene;
use crate::emitters::Receiver;
use crate::emitters::tree::{Cone, Faces, Item, LightTree, Node};
use arrayvec::ArrayVec;
use durer_geometry::{Bounds, Primitive, Round};
use durer_math::functions::{atan2, cos, sin};
use durer_math::{DVec2, DVec3, any_orthonormal_pair};
use durer_scene::Integrator;
use turn::{Angle, Circle, Inside, Turned};

/// The casters of a scene.
#[derive(Clone, Debug, Default)]
pub(crate) struct Casters {
    /// By the numbers of their primitives.
    list: Vec<Caster>,
    /// Of balls, and of cylinders; what they are called is their index in the list.
    trees: [LightTree; 2],
}

/// One of them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Caster {
    pub(crate) primitive: u32,
    round: Round,
    /// Its index of refraction, unless it is a mirror.
    ior: Option<f64>,
}

/// What light does there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Passage {
    /// It goes in and out again: of cylinders, through the side.
    Through,
    /// It is turned back from outside: of cylinders, by the side.
    Back,
    /// It goes in by one end of a cylinder and out by the other, and on its way is turned back by the side a few times or never.
    Along,
}

/// Light that is turned back more often in a cylinder is not looked for.
const MOST_TIMES: u32 = 3;

/// How light is thrown by what is round.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Form {
    Ball,
    Cylinder,
}

/// Balls that stand for less than this, over the square of their distance, are as likely as those that do: light that the guess
/// leaves out may be there.
const LEAST: f64 = 0.002;
/// Who is amidst of casters has some of them nearer than the size of their box tells: these count as so many times as bright. Found by
/// trial, with a thousand things under a sun; 4 and 30 are as good, and with 1 there was a fifth more noise.
const AMIDST: f64 = 8.0;
/// How often at most: with a floor under a thousand small beads, where little else takes time, less is better, and with a thousand
/// things of all kinds more would be, by little.
const EAGERNESS: f64 = 0.5;
/// Light that is found with this density or more, per solid angle, stands out: an even sky has a thirtieth of that.
const OUTSTANDING: f64 = 2.0;
/// Glass of less than this hardly bends light at all.
const LEAST_INDEX: f64 = 1.001;

impl Casters {
    /// Those of a scene that is complete but for them and the emitters; none where there is nothing to aim at through them.
    pub(crate) fn of(scene: &CompiledScene) -> Casters {
        let is_path = matches!(scene.settings.integrator, Integrator::Path(_));
        let has_map = matches!(scene.background, Background::Image(_));
        if !is_path || !has_map || scene.fog.is_some() {
            return Casters::default();
        }
        let caster = |(id, primitive): (u32, &Primitive)| {
            let looks = &scene.objects[id as usize].looks;
            let material = scene.material(id);
            if looks.details().is_some() || material.relief.is_some() || material.opacity.is_some() {
                return None;
            }
            let ior = match scene.scatterings[looks.material as usize].smooth_ior()? {
                Some(ior) if looks.is_medium && ior > LEAST_INDEX => Some(ior),
                Some(_) => return None,
                None => None,
            };
            Some(Caster { primitive: id, round: primitive.round()?, ior })
        };
        let list: Vec<Caster> = (0_u32..).zip(scene.world.primitives()).filter_map(caster).collect();
        Casters::new(list, |caster| scene.world.primitives()[caster.primitive as usize].bounds())
    }

    fn new(list: Vec<Caster>, bounds: impl Fn(&Caster) -> Bounds) -> Casters {
        let trees = [Form::Ball, Form::Cylinder].map(|form| {
            let items = (0_u32..).zip(&list).filter(|(_, caster)| caster.form() == form);
            let items = items.filter_map(|(id, caster)| caster.item(&bounds(caster), id)).collect();
            LightTree::build(items, list.len())
        });
        Casters { list, trees }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// The index of the one that a primitive is, if it is one.
    pub(crate) fn find(&self, primitive: u32) -> Option<u32> {
        let index = self.list.binary_search_by_key(&primitive, |caster| caster.primitive).ok()?;
        Some(index as u32)
    }

    pub(crate) fn get(&self, index: u32) -> &Caster {
        &self.list[index as usize]
    }

    /// Chooses one that might throw light from a direction to a receiver, and how: `pdf` is the density with which the direction
    /// was found. Often none, where that says that the sky is not much brighter there than elsewhere.
    pub(crate) fn choose(
        &self,
        receiver: &Receiver,
        (light, pdf): (DVec3, f64),
        choice: DVec2,
    ) -> Option<(u32, Passage)> {
        let worth = worth(pdf);
        if choice.y >= worth {
            return None;
        }
        let chances = self.chances(receiver, light);
        let (form, choice_of_caster) = match choice.x < chances[0] {
            true => (Form::Ball, choice.x / chances[0]),
            false if chances[1] > 0.0 => (Form::Cylinder, (choice.x - chances[0]) / chances[1]),
            false => return None,
        };
        let brightness = |node: &Node| form.brightness(node, receiver, light);
        let choice_of_caster = choice_of_caster.min(1.0_f64.next_down());
        let (index, _) = self.trees[form as usize].choose(brightness, choice_of_caster)?;
        let passage = match self.get(index).chance_of_through(receiver.point, light) {
            None => Passage::Along,
            Some(through) if choice.y / worth < through => Passage::Through,
            Some(_) => Passage::Back,
        };
        Some((index, passage))
    }

    /// The chance that this is chosen, if any is.
    fn chance(&self, receiver: &Receiver, light: DVec3, (index, passage): (u32, Passage)) -> f64 {
        let caster = self.get(index);
        let form = caster.form();
        let brightness = |node: &Node| form.brightness(node, receiver, light);
        let of_passage = match (caster.chance_of_through(receiver.point, light), passage) {
            (None, Passage::Along) => 1.0,
            (Some(through), Passage::Through) => through,
            (Some(through), Passage::Back) => 1.0 - through,
            (None, Passage::Through | Passage::Back) | (Some(_), Passage::Along) => return 0.0,
        };
        let of_form = self.chances(receiver, light)[form as usize];
        of_form * of_passage * self.trees[form as usize].chance(brightness, index)
    }

    /// How often a ball is chosen, and how often a cylinder.
    fn chances(&self, receiver: &Receiver, light: DVec3) -> [f64; 2] {
        let [ball, cylinder] = [Form::Ball, Form::Cylinder]
            .map(|form| self.trees[form as usize].most(|node| form.brightness(node, receiver, light)) > 0.0);
        match (ball, cylinder) {
            (true, true) => [0.5, 0.5],
            (ball, cylinder) => [f64::from(u8::from(ball)), f64::from(u8::from(cylinder))],
        }
    }

    /// The density with which a ray from a receiver is found by aiming at light through a caster, per solid angle: if it meets so
    /// many surfaces of it and leaves it in a direction that is found with the density `pdf`.
    pub(crate) fn density(
        &self,
        receiver: &Receiver,
        toward: DVec3,
        caster: (u32, Passage),
        surfaces: u32,
        (light, pdf): (DVec3, f64),
    ) -> f64 {
        let spread = self.get(caster.0).spread(receiver.point, toward, caster.1, surfaces);
        let Some(spread) = spread else { return 0.0 };
        let worth = worth(pdf);
        if worth > 0.0 { pdf * worth * spread * self.chance(receiver, light, caster) } else { 0.0 }
    }
}

/// How often it is worth while to look for light through casters that was found with this density: all the less often, the less
/// it stands out, for so much is found without.
fn worth(pdf: f64) -> f64 {
    EAGERNESS * (pdf / OUTSTANDING).min(1.0)
}

impl Form {
    /// About how much light from a direction those under a node throw to a receiver: never 0 where they throw any.
    fn brightness(self, node: &Node, receiver: &Receiver, light: DVec3) -> f64 {
        let (way, radius2) = node.way_from(receiver.point);
        let squared = way.length_squared();
        if squared <= radius2 {
            return AMIDST * node.intensity() / radius2.max(1e-60);
        }
        let nearness = 1.0 / squared.sqrt();
        let near = node.intensity() * nearness * nearness;
        let way = way * nearness;
        // The sine of the angle that a ball around the node fills, and more than any cosine can change within that.
        let blur = radius2.sqrt() * nearness;
        let facing = (way.dot(receiver.normal) + blur).min(1.0);
        if facing <= 0.0 {
            return 0.0;
        }
        match self {
            Form::Ball => {
                let [through, back] = shares(1.5, (way.dot(light) + blur).min(1.0));
                near * facing * (through + back).max(LEAST)
            }
            Form::Cylinder => {
                // What is along the axis stays the same; how far off may that be, of directions near to `way` and axes near to
                // this one?
                let Cone { axis, cosine, .. } = node.cone();
                let off = way - light;
                let chord = (2.0 - 2.0 * cosine).max(0.0).sqrt();
                // Half of the angle has no smaller sine than half of the chord.
                let slack = std::f64::consts::SQRT_2 * blur + chord * off.length() + 1e-3;
                if off.dot(axis).abs() <= slack || cosine <= -1.0 { near * facing } else { 0.0 }
            }
        }
    }
}

/// About how much light a ball throws through and back, over the square of its radius and per solid angle, from where its middle is
/// seen to that much beside the light: by the cosine.
fn shares(ior: f64, cosine: f64) -> [f64; 2] {
    let reflectance = (ior - 1.0) / (ior + 1.0);
    let f0 = reflectance * reflectance;
    // In the middle it is a lens; to the side it gets less, about like this.
    let lens = (1.0 - f0) * (1.0 - f0) / (4.0 * (1.0 - 1.0 / ior) * (1.0 - 1.0 / ior));
    let half = (0.5 * (1.0 + cosine)).clamp(0.0, 1.0);
    let fourth = half * half * half * half;
    let flat = 1.0 - (0.5 * (1.0 - cosine)).clamp(0.0, 1.0).sqrt();
    let flat2 = flat * flat;
    [lens * fourth * fourth, 0.25 * (f0 + (1.0 - f0) * flat2 * flat2 * flat)]
}

impl Caster {
    fn form(&self) -> Form {
        match self.round {
            Round::Ball { .. } => Form::Ball,
            Round::Cylinder { .. } => Form::Cylinder,
        }
    }

    /// As the tree sees it.
    fn item(&self, bounds: &Bounds, id: u32) -> Option<Item> {
        let (size, cone) = match self.round {
            Round::Ball { radius, .. } => (radius * radius, Cone::ALL),
            Round::Cylinder { axis, half_length, radius, .. } => {
                (radius * half_length.max(radius), Cone::of(axis, Faces::Both))
            }
        };
        Item::new(bounds, size, cone, id)
    }

    /// How often light is to go through, not back; `None` from where it can only go along.
    fn chance_of_through(&self, from: DVec3, light: DVec3) -> Option<f64> {
        let Some(ior) = self.ior else { return Some(0.0) };
        if let Round::Cylinder { center, axis, radius, .. } = self.round
            && flat(from - center, axis).length() < radius
        {
            return None;
        }
        let (Round::Ball { center, .. } | Round::Cylinder { center, .. }) = self.round;
        let way = (center - from).normalize_or_zero();
        let [through, back] = shares(ior, way.dot(light));
        Some((through / (through + back)).clamp(0.1, 0.9))
    }

    /// The directions from a point in which rays start that come by way of it from where the light is.
    pub(crate) fn rays(&self, from: DVec3, light: DVec3, passage: Passage) -> ArrayVec<DVec3, MOST_RAYS> {
        if passage == Passage::Along {
            return self.rays_along(from, light).unwrap_or_default();
        }
        let Some(plane) = self.plane(from, light, passage) else { return ArrayVec::new() };
        let across = plane.across(light);
        let end = Angle { sin: across.length() / plane.flatness, cos: plane.along.dot(light) / plane.flatness };
        let Some(across) = across.try_normalize() else { return ArrayVec::new() };
        let rays = plane.circle.rays(end).into_iter();
        let rays = rays.filter(|(_, turned)| self.is_within(&plane, turned, passage));
        rays.map(|(side, turned)| {
            plane.direction(across, Angle { sin: side * turned.start.sin, cos: turned.start.cos })
        })
        .collect()
    }

    /// The same for rays from one end of a cylinder to the other.
    fn rays_along(&self, from: DVec3, light: DVec3) -> Option<ArrayVec<DVec3, MOST_RAYS>> {
        let Round::Cylinder { half_length, radius, .. } = self.round else { return None };
        let ior = self.ior?;
        let plane = self.plane_inside(from, light)?;
        let (rise, flatness) = (plane.rise.abs(), plane.flatness);
        let before = plane.height.abs() - half_length;
        // From below it goes up.
        if before < 0.0 || plane.rise * plane.height > 0.0 {
            return None;
        }
        let across = plane.across(light);
        let end = atan2(across.length(), plane.along.dot(light));
        let across = across.try_normalize()?;
        // How far it goes across the axis before the end where it enters, and up to that where it leaves.
        let entering = before * flatness / rise;
        let leaving = entering + 2.0 * half_length * flatness / (ior * ior - flatness * flatness).sqrt();
        let mut rays = ArrayVec::new();
        for times in 0..=MOST_TIMES {
            for start in (Inside { q: plane.circle.q, times }).starts(end) {
                let start = Angle { sin: sin(start), cos: cos(start) };
                let half_chord = radius * Angle::of_sine(plane.circle.q * start.sin).cos;
                let first = radius * plane.circle.q * start.cos + half_chord;
                let met = if leaving < first { 0.0 } else { 1.0 + ((leaving - first) / (2.0 * half_chord)).floor() };
                if entering < first && met == f64::from(times) {
                    debug_assert!(!rays.is_full());
                    let _ = rays.try_push(plane.direction(across, start));
                }
            }
        }
        Some(rays)
    }

    /// The solid angle of directions that rays leave in per solid angle in which they start, around one, if it meets so many
    /// surfaces.
    fn spread(&self, from: DVec3, toward: DVec3, passage: Passage, surfaces: u32) -> Option<f64> {
        if passage == Passage::Along {
            let plane = self.plane_inside(from, toward)?;
            let inside = Inside { q: plane.circle.q, times: surfaces.checked_sub(2)? };
            return (inside.times <= MOST_TIMES).then(|| inside.rise(plane.angle(toward)).abs());
        }
        let plane = self.plane(from, toward, passage)?;
        let met = plane.angle(toward).sin / plane.circle.q;
        if met >= 1.0 {
            return None;
        }
        let turned = plane.circle.turn(Angle::of_sine(met));
        let spread = turned.spread(plane.circle.q);
        match self.round {
            Round::Cylinder { .. } => Some(spread),
            // All around the line to the middle.
            Round::Ball { .. } if turned.start.sin > 0.0 => Some(spread * (turned.end.sin / turned.start.sin).abs()),
            Round::Ball { .. } => Some(spread * spread),
        }
    }

    /// The plane in which light is turned, for rays that start at a point and start or end with the rise of this direction.
    fn plane(&self, from: DVec3, direction: DVec3, passage: Passage) -> Option<Plane> {
        let eta = match passage {
            Passage::Through => Some(self.ior?),
            Passage::Back => None,
            Passage::Along => return None,
        };
        match self.round {
            Round::Ball { center, radius } => {
                let way = center - from;
                let distance = way.length();
                let circle = Circle { q: radius / distance, eta };
                let along = way * (1.0 / distance);
                let axis = DVec3::ZERO;
                (distance > radius).then_some(Plane { axis, rise: 0.0, flatness: 1.0, height: 0.0, along, circle })
            }
            Round::Cylinder { radius, .. } => {
                let (distance, plane) = self.plane_across(from, direction)?;
                let Plane { rise, flatness, .. } = plane;
                if distance <= radius || flatness < 1e-6 {
                    return None;
                }
                let eta = eta.map(|eta| (eta * eta - rise * rise).max(0.0).sqrt() / flatness);
                Some(Plane { circle: Circle { q: radius / distance, eta }, ..plane })
            }
        }
    }

    /// The plane across a cylinder, for rays that start at a point that is not outside of its side.
    fn plane_inside(&self, from: DVec3, direction: DVec3) -> Option<Plane> {
        let Round::Cylinder { radius, .. } = self.round else { return None };
        let (distance, plane) = self.plane_across(from, direction)?;
        let circle = Circle { q: distance / radius, eta: None };
        let is_aslant = plane.flatness >= 1e-6 && plane.rise.abs() >= 1e-6;
        (distance < radius && is_aslant).then_some(Plane { circle, ..plane })
    }

    /// The plane across a cylinder, and how far its axis is from a point.
    fn plane_across(&self, from: DVec3, direction: DVec3) -> Option<(f64, Plane)> {
        let Round::Cylinder { center, axis, .. } = self.round else { return None };
        let height = (from - center).dot(axis);
        let way = flat(center - from, axis);
        let distance = way.length();
        // On the axis all ways are alike.
        let along = if distance > 0.0 { way * (1.0 / distance) } else { any_orthonormal_pair(axis).0 };
        let rise = direction.dot(axis);
        let flatness = (1.0 - rise * rise).max(0.0).sqrt();
        Some((distance, Plane { axis, rise, flatness, height, along, circle: Circle { q: 0.0, eta: None } }))
    }

    /// True if a ray comes and goes between the ends.
    fn is_within(&self, plane: &Plane, turned: &Turned, passage: Passage) -> bool {
        let Round::Cylinder { half_length, radius, .. } = self.round else { return true };
        let Circle { q, eta } = plane.circle;
        let comes = plane.height + plane.rise / plane.flatness * radius * (turned.start.cos / q - turned.met.cos);
        let goes = match (passage, eta) {
            (Passage::Through, Some(eta)) => {
                // Inside, the part along is n times as small, and so, in the plane, is that across over the circle's index.
                let inside = Angle::of_sine(turned.met.sin / eta).cos;
                comes + plane.rise / plane.flatness / eta * 2.0 * radius * inside
            }
            _ => comes,
        };
        comes.abs() < half_length && goes.abs() < half_length
    }
}

/// Where light is turned: the plane of a point and a ball's middle and the light, or that across a cylinder.
struct Plane {
    /// Of a cylinder.
    axis: DVec3,
    /// What of directions is along the axis …
    rise: f64,
    /// … and how much is left across.
    flatness: f64,
    /// Of the point, above the middle.
    height: f64,
    /// From the point to the middle; of unit length.
    along: DVec3,
    circle: Circle,
}

impl Plane {
    /// What of a direction is neither along the axis nor toward the middle.
    fn across(&self, direction: DVec3) -> DVec3 {
        let flat = flat(direction, self.axis);
        flat - self.along * flat.dot(self.along)
    }

    /// Between a direction and that to the middle, in the plane.
    fn angle(&self, direction: DVec3) -> Angle {
        let scale = 1.0 / self.flatness;
        Angle { sin: self.across(direction).length() * scale, cos: self.along.dot(direction) * scale }
    }

    /// The direction with this angle to the side of `across`.
    fn direction(&self, across: DVec3, angle: Angle) -> DVec3 {
        ((self.along * angle.cos + across * angle.sin) * self.flatness + self.axis * self.rise).normalize()
    }
}

/// What of a vector is across an axis.
fn flat(v: DVec3, axis: DVec3) -> DVec3 {
    v - axis * v.dot(axis)
}

/// The most rays by one caster.
const MOST_RAYS: usize = 16;

#[cfg(test)]
mod tests;

//! Shapes that give off light: aimed at element by element (see [`durer_geometry::Primitive::each_element`]).

use super::LightSample;
use super::tree::{Cone, Faces, Item};
use crate::compile::CompiledScene;
use crate::shading::Shading;
use durer_geometry::{Aim, Aimable, Crossing, Extent, Hit, Primitive, Ray};
use durer_math::{DVec2, DVec3, Rgb};
use durer_scene::{Emission, Paint, Sides};
use rayon::prelude::*;

/// More elements than this are not aimed at, which a path that meets them by chance makes up for.
const MOST: usize = 1 << 23;

/// All elements that give off light.
#[derive(Clone, Debug, Default)]
pub(crate) struct Shapes {
    /// In ascending order.
    elements: Vec<Element>,
    /// What can be known of each before it is aimed at; of none if they are more than [`MOST_READY`].
    ready: Vec<Option<Ready>>,
}

/// For more elements than this, what is known of them is found out anew each time they are aimed at: memory.
const MOST_READY: usize = 1 << 16;

/// What can be known of an element before it is aimed at.
#[derive(Clone, Copy, Debug)]
struct Ready {
    aimable: Aimable,
    /// Radiance and sides, if they are the same all over it.
    plain: Option<(Rgb, Sides)>,
}

/// Something that is aimed at as a whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Element {
    primitive: u32,
    element: u32,
}

impl Shapes {
    /// Those of a scene, and what the tree needs to know of each; ids are their indices.
    pub(super) fn of(scene: &CompiledScene) -> (Shapes, Vec<Item>) {
        let glows = |material: u32| scene.materials[material as usize].emission.is_some();
        let any_glows = (0..scene.materials.len() as u32).any(glows);
        let mut elements = Vec::new();
        if any_glows {
            for (id, primitive) in (0_u32..).zip(scene.world.primitives()) {
                let parts = scene.details(id).is_some();
                if !parts && !glows(scene.objects[id as usize].looks.material) {
                    continue;
                }
                primitive.each_element(&mut |element| {
                    let glows = emission_of(scene, id, element).is_some();
                    if glows && elements.len() < MOST {
                        elements.push(Element { primitive: id, element });
                    }
                });
            }
        }
        let item = |(id, element): (usize, &Element)| item(scene, element, id as u32);
        let items = elements.par_iter().enumerate().filter_map(item).collect();
        let ready = match elements.len() <= MOST_READY {
            true => elements.iter().map(|&element| Ready::of(scene, element)).collect(),
            false => Vec::new(),
        };
        (Shapes { elements, ready }, items)
    }

    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        self.elements.len()
    }

    /// The index of what was hit, if it is aimed at.
    pub(super) fn find(&self, scene: &CompiledScene, hit: &Hit) -> Option<u32> {
        if self.elements.is_empty() {
            return None;
        }
        let primitive = &scene.world.primitives()[hit.primitive as usize];
        let element = Element { primitive: hit.primitive, element: primitive.element_of(hit.crossing.part) };
        self.elements.binary_search(&element).ok().map(|index| index as u32)
    }

    /// A point on one of them, and what it gives off from there to a point; `None` if that is nothing.
    pub(crate) fn aim(&self, scene: &CompiledScene, index: usize, from: DVec3, at: DVec2) -> Option<LightSample> {
        let Element { primitive, .. } = self.elements[index];
        let Ready { aimable, plain } = match self.ready.get(index) {
            Some(ready) => ready.as_ref()?,
            None => &Ready::of(scene, self.elements[index])?,
        };
        let aim = scene.world.primitives()[primitive as usize].aim(aimable, from, at)?;
        let light = match plain {
            Some((light, sides)) if *sides == Sides::Both || aim.direction.dot(aim.surface.normal) < 0.0 => *light,
            Some(_) => return None,
            None => given_off(scene, primitive, &aim, from),
        };
        let Aim { direction, distance, pdf, .. } = aim;
        (!light.is_black()).then_some(LightSample { direction, distance, light, pdf, is_point: false, lamp: None })
    }

    /// The density, per solid angle, with which [`Shapes::aim`] finds a point on one of them.
    pub(super) fn pdf(&self, scene: &CompiledScene, index: usize, from: DVec3, point: DVec3, part: u32) -> f64 {
        match self.ready.get(index) {
            Some(ready) => ready.as_ref().map_or(0.0, |ready| ready.aimable.pdf(from, point, part)),
            None => Ready::of(scene, self.elements[index]).map_or(0.0, |ready| ready.aimable.pdf(from, point, part)),
        }
    }
}

impl Ready {
    fn of(scene: &CompiledScene, Element { primitive, element }: Element) -> Option<Ready> {
        let aimable = scene.world.primitives()[primitive as usize].aimable(element)?;
        let material = &scene.materials[scene.material_at(&hit_of(primitive, element)) as usize];
        let emission = material.emission?;
        let plain = match (emission.color, material.opacity) {
            (Paint::Color(color), None) => Some((color * emission.strength, emission.sides)),
            (Paint::Color(_) | Paint::Texture(_), _) => None,
        };
        Some(Ready { aimable, plain })
    }
}

/// What glows of a part, if anything does.
fn emission_of(scene: &CompiledScene, primitive: u32, part: u32) -> Option<Emission> {
    let hit = Hit { crossing: Crossing { t: 0.0, part }, primitive };
    scene.materials[scene.material_at(&hit) as usize].emission
}

/// The radiance from a point on a primitive to one that sees it; of what is but partly there, that part.
fn given_off(scene: &CompiledScene, primitive: u32, aim: &Aim, from: DVec3) -> Rgb {
    let hit = Hit { crossing: Crossing { t: aim.distance, part: aim.part }, primitive };
    let shading = Shading::at(scene, &Ray { origin: from, direction: aim.direction }, &hit);
    shading.opacity.map_or(shading.emission, |opacity| shading.emission * opacity)
}

/// What the tree needs to know; `None` for what has no area or no light.
fn item(scene: &CompiledScene, &Element { primitive, element }: &Element, id: u32) -> Option<Item> {
    let emission = emission_of(scene, primitive, element)?;
    let shape = &scene.world.primitives()[primitive as usize];
    let extent = shape.extent(element)?;
    let material = &scene.materials[scene.material_at(&hit_of(primitive, element)) as usize];
    let luminance = match (emission.color, material.opacity) {
        (Paint::Color(color), None) => f64::from((color * emission.strength).luminance()),
        _ => mean_luminance(scene, shape, &extent, primitive, element),
    };
    let faces = match (emission.sides, extent.is_closed) {
        (Sides::Front, _) => Faces::Front,
        (Sides::Both, true) => Faces::Closed,
        (Sides::Both, false) => Faces::Both,
    };
    // Of a convex body a quarter of the area is seen, in the mean; of a curved sheet, on both sides, half.
    let (cone, seen) = match (extent.normal, extent.is_closed) {
        (Some(normal), _) => (Cone::of(normal, faces), 1.0),
        (None, true) => (Cone { faces, ..Cone::ALL }, 0.25),
        (None, false) => (Cone { faces, ..Cone::ALL }, 0.5),
    };
    Item::new(&extent.bounds, luminance * extent.area * seen, cone, id)
}

fn hit_of(primitive: u32, part: u32) -> Hit {
    Hit { crossing: Crossing { t: 0.0, part }, primitive }
}

/// The mean of what is given off where textures decide, by a few looks from outside: two at what is flat, from both sides.
fn mean_luminance(scene: &CompiledScene, shape: &Primitive, extent: &Extent, primitive: u32, element: u32) -> f64 {
    const AWAY: f64 = 4.0;
    let Some(aimable) = shape.aimable(element) else { return 0.0 };
    let (middle, size) = (extent.bounds.center(), extent.bounds.size().length().max(f64::MIN_POSITIVE));
    let (flat, round);
    let (ways, looks): (&[DVec3], u32) = match extent.normal {
        Some(normal) => {
            flat = [normal, -normal];
            (&flat, 4)
        }
        None => {
            round = [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z];
            (&round, 8)
        }
    };
    let (mut sum, mut count) = (0.0, 0.0);
    for &way in ways {
        let from = middle + way * (AWAY * size);
        for look in 0..looks {
            // Points of Hammersley's.
            let across = (f64::from(look) + 0.5) / f64::from(looks);
            let up = (f64::from(look.reverse_bits()) + 0.5) / 4_294_967_296.0 + 0.5 / f64::from(looks);
            if let Some(aim) = shape.aim(&aimable, from, DVec2::new(across, up.min(0.999))) {
                sum += f64::from(given_off(scene, primitive, &aim, from).luminance());
                count += 1.0;
            }
        }
    }
    if count > 0.0 { sum / count } else { 0.0 }
}

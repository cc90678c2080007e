//! Shapes that give off light: aimed at element by element (see [`durer_geometry::Primitive::each_element`]).

mod textured;

use super::LightSample;
use super::tree::{Cone, Faces, Item};
use crate::compile::CompiledScene;
use crate::shading::Textured;
use durer_geometry::{Aim, Aimable, Crossing, Hit};
use durer_math::{DVec2, DVec3, Rgb};
use durer_scene::{Emission, Integrator, Paint, Sides};
use rayon::prelude::*;

/// More elements than this are not aimed at, which a path that meets them by chance makes up for.
const MOST: usize = 1 << 23;

/// All elements that give off light.
#[derive(Clone, Debug, Default)]
pub(crate) struct Shapes {
    /// In ascending order.
    elements: Vec<Element>,
    /// How many primitives they belong to.
    primitives: usize,
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
    /// Those of a scene, and what the tree needs to know of each; ids are their indices. `means` are the mean luminances that
    /// the emission of each material has all over its texture.
    pub(super) fn of(scene: &CompiledScene, means: &[f64]) -> (Shapes, Vec<Item>) {
        let glows = |material: u32| scene.materials[material as usize].emission.is_some();
        let any_glows = (0..scene.materials.len() as u32).any(glows);
        let mut elements = Vec::new();
        if any_glows {
            let hidden = may_be_hidden(scene);
            for (id, primitive) in (0_u32..).zip(scene.world.primitives()) {
                let parts = scene.details(id).is_some();
                if !parts && !glows(scene.objects[id as usize].looks.material) {
                    continue;
                }
                let is_medium = hidden && scene.objects[id as usize].looks.is_medium;
                primitive.each_element(&mut |element| {
                    let glows = emission_of(scene, id, element).is_some();
                    let is_hidden = is_medium && is_only_a_boundary(scene, id, element);
                    if glows && !is_hidden && elements.len() < MOST {
                        elements.push(Element { primitive: id, element });
                    }
                });
            }
        }
        let primitives = elements.chunk_by(|a, b| a.primitive == b.primitive).count();
        let is_uneven = |element: &&Element| even_light(scene, element).is_none();
        let looks = textured::looks(elements.par_iter().filter(is_uneven).count());
        let item = |(id, element): (usize, &Element)| item(scene, means, looks, element, id as u32);
        let items = elements.par_iter().enumerate().filter_map(item).collect();
        let ready = match elements.len() <= MOST_READY {
            true => elements.iter().map(|&element| Ready::of(scene, element)).collect(),
            false => Vec::new(),
        };
        (Shapes { elements, primitives, ready }, items)
    }

    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        self.elements.len()
    }

    /// How many objects they are parts of; a mesh is one.
    pub(crate) fn objects(&self) -> usize {
        self.primitives
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
        if matches!(plain, Some((_, Sides::Front))) && aimable.is_seen_from_behind(from) {
            return None;
        }
        let aim = scene.world.primitives()[primitive as usize].aim(aimable, from, at)?;
        let light = match plain {
            Some((light, sides)) if *sides == Sides::Both || aim.direction.dot(aim.surface.normal) < 0.0 => *light,
            Some(_) => return None,
            None => given_off(scene, primitive, &aim),
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
        let sides = emission_of(scene, primitive, element)?.sides;
        let plain = even_light(scene, &Element { primitive, element }).map(|light| (light, sides));
        Some(Ready { aimable, plain })
    }
}

/// True if boundaries of media may lie in other media that hide them: where they glow, who aims at them would have to know. So
/// they are found by chance. (Classic light goes by shapes alone.)
fn may_be_hidden(scene: &CompiledScene) -> bool {
    let media = scene.objects.iter().filter(|object| object.looks.is_medium);
    matches!(scene.settings.integrator, Integrator::Path { .. }) && media.take(2).count() > 1
}

fn is_only_a_boundary(scene: &CompiledScene, primitive: u32, part: u32) -> bool {
    scene.scatterings[scene.material_at(&hit_of(primitive, part)) as usize].is_only_a_boundary()
}

/// What glows of a part, if anything does.
fn emission_of(scene: &CompiledScene, primitive: u32, part: u32) -> Option<Emission> {
    let hit = Hit { crossing: Crossing { t: 0.0, part }, primitive };
    scene.materials[scene.material_at(&hit) as usize].emission
}

/// The radiance from a point on a primitive to one that sees it; of what is but partly there, that part.
fn given_off(scene: &CompiledScene, primitive: u32, aim: &Aim) -> Rgb {
    let hit = Hit { crossing: Crossing { t: aim.distance, part: aim.part }, primitive };
    let material = &scene.materials[scene.material_at(&hit) as usize];
    if !material.glows(aim.direction.dot(aim.surface.normal) < 0.0) {
        return Rgb::BLACK;
    }
    let object = &scene.objects[primitive as usize];
    let textured = Textured { scene, object, surface: &aim.surface, hit: &hit };
    let emission = textured.emission(material);
    material.opacity.map_or(emission, |opacity| emission * textured.opacity(opacity))
}

/// What an element gives off, if that is the same everywhere on it.
fn even_light(scene: &CompiledScene, &Element { primitive, element }: &Element) -> Option<Rgb> {
    let material = &scene.materials[scene.material_at(&hit_of(primitive, element)) as usize];
    match (material.emission?.color, material.opacity) {
        (Paint::Color(color), None) if !material.is_unlit => Some(color * material.emission?.strength),
        (Paint::Color(_) | Paint::Texture(_), _) => None,
    }
}

/// What the tree needs to know; `None` for what has no area or no light.
fn item(scene: &CompiledScene, means: &[f64], looks: u32, element: &Element, id: u32) -> Option<Item> {
    let Element { primitive, element: number } = *element;
    let emission = emission_of(scene, primitive, number)?;
    let extent = scene.world.primitives()[primitive as usize].extent(number)?;
    let luminance = match even_light(scene, element) {
        Some(light) => f64::from(light.luminance()),
        None => {
            let mean = means[scene.material_at(&hit_of(primitive, number)) as usize];
            textured::luminance(scene, element, &extent, mean, looks)
        }
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

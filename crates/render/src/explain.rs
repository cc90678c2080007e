//! Replays one pixel and writes down every ray of it.

mod recorder;

use crate::antialias::{Antialias, Rows, Splat};
use crate::compile::CompiledScene;
use crate::eye::{SceneEye, begin};
use crate::film::{Account, Part, PixelSums, Region, SampleRange, Sums};
use crate::filter_sampling::FilterSampling;
use crate::holes::Known;
use crate::integrators::{
    Integrator as AnyIntegrator, Together, ambient_occlusion::AmbientOcclusion, path::PathTracer, sharp::Sharp,
};
use crate::observer::{NotTraced, RayKind, Scattering, Sharing, Source, Way, Weighing};
use crate::passes::{Begun, block_of, edge_of_blocks};
use crate::reconstruct::{Reconstruction, color_of, normalize};
use crate::schedule::{RenderOptions, WithAntialias, pixel_alone, render, with_antialias};
use durer_math::{DVec2, DVec3, Rgb};
use durer_scene::{Integrator, MaterialId, PixelFilter};
use recorder::Recorder;

/// How a pixel got its colour: the sum of the colours of its kept samples, each times its weight, in this order; or their
/// mean.
#[derive(Clone, Debug, PartialEq)]
pub struct PixelExplanation {
    /// Column, from the left.
    pub x: u32,
    /// Row, from the top.
    pub y: u32,
    /// The pixel's colour, exactly as rendered.
    pub color: Rgb,
    /// The samples, in the order in which they are added up: those of other pixels, too, if the filter reaches them. Rays that
    /// only decided where an edge is are not among them.
    pub samples: Vec<SampleExplanation>,
    /// True if the integrator takes samples of its own: the color is their mean, which is computed exactly and rounded once.
    pub is_mean: bool,
}

/// One ray of the eye and all that came of it.
#[derive(Clone, Debug, PartialEq)]
pub struct SampleExplanation {
    /// Where it is, in pixels from the picture's upper left corner.
    pub at: DVec2,
    /// Its weight in the pixel; `None` if it does not count there: anti-aliasing threw it away, it is not
    /// finite, or it lies beyond the filter.
    pub weight: Option<f32>,
    /// The sum of all contributions, in the order of the tree: a ray's own, then those of its children.
    pub color: Rgb,
    /// The ray.
    pub ray: RayExplanation,
}

/// One ray: what it met and what it brought.
#[derive(Clone, Debug, PartialEq)]
pub struct RayExplanation {
    /// Why it was traced.
    pub kind: RayKind,
    /// 1 for the eye's ray.
    pub depth: u32,
    /// Where it starts, in world space.
    pub origin: DVec3,
    /// Where it goes; unit length.
    pub direction: DVec3,
    /// What light at its start counts; of light that is shared, what it would count if no other way found it.
    pub weight: Rgb,
    /// In what that counts.
    pub relative_to: RelativeTo,
    /// Of a split sample: the way that begins with this ray.
    pub way: Option<Way>,
    /// Surfaces that it went through a hole of before that, in order.
    pub holes: Vec<HoleExplanation>,
    /// What it met; `None` for the background.
    pub hit: Option<HitExplanation>,
    /// The lights, as seen from there.
    pub lights: Vec<LightExplanation>,
    /// Of a path: how it went on from there, once for each way into which it was split.
    pub turns: Vec<Turn>,
    /// If what it met is a junction, or could be one: what came of it. What [`RayKind::Connected`] rays met is one, but of that
    /// the pixel tells that found it.
    pub junction: Option<JunctionExplanation>,
    /// Of a [`RayKind::Connected`] ray: what it took from the junction that it met.
    pub reuse: Option<ReuseExplanation>,
    /// What it added to the sample, in order, weights included; nothing if it is relative to a junction.
    pub contributions: Vec<Contribution>,
    /// What it brought to the junction that it is relative to, in order, weights included: no part of the sample by itself.
    pub brought: Vec<Contribution>,
    /// Rays that the surface asked for but that were not traced.
    pub not_traced: Vec<(RayKind, Rgb, NotTraced)>,
    /// Rays that started where this one ended.
    pub children: Vec<RayExplanation>,
}

/// In what light counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RelativeTo {
    /// In the sample: weights are those of the whole path from the eye.
    Sample,
    /// In the light that arrives at the [junction](JunctionExplanation) from which the ray and those before it come: weights begin
    /// with 1 there.
    Junction,
}

/// How a path went on from a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turn {
    /// By which way of several; `None` if there is but one.
    pub way: Option<Way>,
    /// Where to. At a junction its weight is that of light to where the path came from, which others see otherwise.
    pub scattering: Scattering,
}

/// A surface from which all pixels of a block that see it may take light.
#[derive(Clone, Debug, PartialEq)]
pub enum JunctionExplanation {
    /// Light was looked for there, and this arrives.
    Found(Vec<ArrivalExplanation>),
    /// None was looked for, and the path ended: of a split sample the first way alone makes junctions.
    Left,
}

/// Light that arrives at a junction, where it is scattered to all that see that.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArrivalExplanation {
    /// What was aimed at; `None` if the rays that start there brought it.
    pub source: Option<Source>,
    /// Where it comes from; unit length.
    pub direction: DVec3,
    /// Radiance over the density of the direction, as far as it counts.
    pub light: Rgb,
    /// What it counts beside the other way to find it; `None` if rays brought it, of which each amount tells by itself.
    pub weighing: Option<Weighing>,
}

/// Light that is taken from a junction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReuseExplanation {
    /// The pixel whose path found the junction: column and row.
    pub pixel: (u32, u32),
    /// The sample of that pixel, from 0: the same as of this one.
    pub sample: usize,
    /// Light that leaves the junction to here.
    pub light: Rgb,
    /// What it counts beside the others who see the junction; `None` if only the path that found it takes light from there.
    pub sharing: Option<Sharing>,
}

/// Where a ray met a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HitExplanation {
    /// Index of the shape, counting the shapes of the scene file from 0, depth first, those of instances copy by copy.
    pub shape: usize,
    /// Which of the things that the shape consists of was hit.
    pub element: Element,
    /// Distance along the ray.
    pub distance: f64,
    /// The point, in world space.
    pub point: DVec3,
    /// The surface's outward unit normal.
    pub normal: DVec3,
    /// The unit normal of shading, on the side that the ray came from.
    pub shading_normal: DVec3,
    /// True if the ray came from the side that the normal points to.
    pub from_outside: bool,
    /// The surface's material, in the scene's list; `None` for the default material.
    pub material: Option<MaterialId>,
    /// The colour there.
    pub color: Rgb,
    /// How much of the surface is there: white unless its material has an opacity.
    pub opacity: Rgb,
}

/// Where a ray went through a hole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HoleExplanation {
    /// Index of the shape that has the hole.
    pub shape: usize,
    /// Which of the things that the shape consists of has it.
    pub element: Element,
    /// Distance along the ray.
    pub distance: f64,
}

/// One of the things that a shape consists of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Element {
    /// One of the surfaces of an exact shape: a face of a box, the side or a cap of a cylinder. Their order is the
    /// shape's own.
    Face(u32),
    /// A triangle of a mesh.
    Triangle {
        /// Counted from 0.
        index: u32,
        /// The weights of its three vertices at the point that was hit.
        weights: [f64; 3],
    },
    /// A particle.
    Particle {
        /// Counted from 0.
        index: u32,
    },
    /// One of the shapes that a solid is made of.
    Operand {
        /// Counted from 0, depth first.
        index: usize,
    },
}

/// A light as seen from a hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightExplanation {
    /// Index in the scene's list of lights.
    pub light: usize,
    /// How far away it is; `None` where it does not shine (outside of a spot's cone).
    pub distance: Option<f64>,
    /// Cosine between the normal and the direction to the light; not positive if the light is behind the surface.
    pub cosine: f64,
    /// What gets through to the point.
    pub visibility: Rgb,
}

/// An amount of light added to a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contribution {
    /// Where it comes from.
    pub source: Source,
    /// How much, all weights included.
    pub amount: Rgb,
    /// Of a path: what it counts beside the other way to find it; `None` where there is no other.
    pub weighing: Option<Weighing>,
}

/// Explains the pixel at column `x`, row `y`; `None` if it is outside of the picture.
pub fn explain(scene: &CompiledScene, x: u32, y: u32) -> Option<PixelExplanation> {
    let (width, height) = scene.picture_size();
    if x >= width || y >= height {
        return None;
    }
    match scene.settings.integrator {
        Integrator::Path(settings) => return explain_samples(scene, &PathTracer(settings), (x, y)),
        Integrator::AmbientOcclusion { distance } => {
            let distance = distance.unwrap_or(f64::INFINITY);
            return explain_samples(scene, &AmbientOcclusion { distance }, (x, y));
        }
        Integrator::Whitted | Integrator::Normals | Integrator::Depth | Integrator::Uv => {}
    }
    let (splats, integrator) = (with_antialias(scene, Samples { scene, x, y }), Sharp::of(scene));
    let explained = splats.iter().filter_map(|splat| {
        let mut recorder = Recorder::new(scene, 0, &[]);
        let (ray, sampler) = begin(scene, splat.at);
        let color = integrator.radiance(scene, &ray, Known::Nothing, &sampler, &mut recorder);
        let weight = (splat.weight != 0.0).then_some(splat.weight);
        Some(SampleExplanation { at: splat.at, weight, color, ray: recorder.ray? })
    });
    Some(PixelExplanation { x, y, color: color_of(&splats), samples: explained.collect(), is_mean: false })
}

/// Of integrators that take samples: all that the pixel has when it is rendered alone.
fn explain_samples<I: AnyIntegrator>(
    scene: &CompiledScene,
    integrator: &I,
    (x, y): (u32, u32),
) -> Option<PixelExplanation> {
    let options = RenderOptions { region: Some(Region { x, y, width: 1, height: 1 }), ..RenderOptions::default() };
    let film = render(scene, &options, &()).ok()?;
    let (color, taken) = (*film.pixels().first()?, film.sums()?.samples() as u32);
    let filter = FilterSampling::new(scene.settings.filter);
    let block = block_of((x, y), edge_of_blocks(integrator), scene.picture_size());
    let pixels: Vec<(u32, u32)> = block.pixel_places().collect();
    let explained = (0..taken).filter_map(|number| {
        let Begun { at, is_negative, .. } = Begun::new(scene, &filter, (x, y), number);
        let together = pixels.iter().map(|&pixel| {
            let Begun { ray, sampler, .. } = Begun::new(scene, &filter, pixel, number);
            let observer = (pixel == (x, y)).then(|| Recorder::new(scene, number as usize, &pixels));
            Together { ray, known: Known::Nothing, sampler, observer, light: Rgb::BLACK }
        });
        let mut together: Vec<Together<'_, Option<Recorder<'_>>>> = together.collect();
        integrator.radiances(scene, &mut together.iter_mut().collect::<Vec<_>>());
        let mut watched = together.into_iter().filter_map(|sample| sample.observer.map(|seen| (sample.light, seen)));
        let (color, seen) = watched.next()?;
        let weight = if is_negative { -1.0 } else { 1.0 } / taken as f32;
        Some(SampleExplanation { at, weight: color.is_finite().then_some(weight), color, ray: seen.ray? })
    });
    Some(PixelExplanation { x, y, color, samples: explained.collect(), is_mean: true })
}

/// Finds the samples of a pixel.
struct Samples<'s> {
    scene: &'s CompiledScene,
    x: u32,
    y: u32,
}

impl WithAntialias for Samples<'_> {
    type Output = Vec<Splat>;

    fn alone<A: Antialias>(self, antialias: &A) -> Vec<Splat> {
        let mut splats = pixel_alone(self.scene, antialias, self.x, self.y);
        if splats.iter().any(|splat| !splat.is_finite) {
            normalize(&mut splats);
        }
        splats
    }

    fn shared<R: Rows>(self, rows: R, filter: PixelFilter) -> Vec<Splat> {
        let Samples { scene, x, y } = self;
        let pixel = Region { x, y, width: 1, height: 1 };
        let mut reconstruction = Reconstruction::new(rows, filter, pixel, scene.picture_size());
        reconstruction.sample(&SceneEye::new(scene), pixel, &mut Account::default(), &|| false);
        let mut splats = Vec::new();
        reconstruction.splats(x, y, &mut splats);
        splats
    }
}

impl RayExplanation {
    /// Adds this ray's contributions and those of its children to a sum, in the order in which rendering does.
    pub fn sum(&self, start: Rgb) -> Rgb {
        let own = self.contributions.iter().fold(start, |sum, c| sum + c.amount);
        self.children.iter().fold(own, |sum, child| child.sum(sum))
    }
}

impl PixelExplanation {
    /// The pixel's colour, added up again from the contributions.
    pub fn sum(&self) -> Rgb {
        if self.is_mean {
            let mut exact = PixelSums::default();
            for (weight, sample) in self.samples.iter().filter_map(|sample| sample.weight.zip(Some(sample))) {
                // What is not finite has no weight.
                let _ = exact.add(sample.ray.sum(Rgb::BLACK), Rgb::BLACK, weight < 0.0);
            }
            let part = Part {
                region: Region { x: 0, y: 0, width: 1, height: 1 },
                samples: SampleRange { start: 0, end: self.samples.len() as u32 },
            };
            let mut sums = Sums::new(part, false);
            sums.add(0, &exact);
            return sums.mean(0);
        }
        let mut sum = Rgb::BLACK;
        for sample in &self.samples {
            if let Some(weight) = sample.weight {
                sum += sample.ray.sum(Rgb::BLACK) * weight;
            }
        }
        sum
    }
}

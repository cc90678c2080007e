//! The direct part of a film's light: the same samples once more, which end where the first surface gives light back. So a film
//! needs not carry it, and who does not ask for it pays nothing.

use super::{Pass, Sampling};
use crate::compile::CompiledScene;
use crate::film::{Film, Part, TILE};
use crate::filter_sampling::FilterSampling;
use crate::integrators::{self, cutout::Cutout, path::PathTracer};
use crate::schedule::{Progress, RenderError, RenderOptions, in_tiles, with_pool};
use durer_math::Rgb;
use durer_scene::Integrator;

/// From the eye to a surface, and from there to a light.
const SEGMENTS: u32 = 2;

/// The light of a film that came by one surface at most: what is seen of emitters and the background, and what the surfaces
/// that are seen give back of light which comes straight from there. The rest is indirect. A color for each pixel, row by
/// row; of the very samples that the film is of, so that the two parts add up.
///
/// `None` if the film is not one of a path tracer, or it cannot be told any more which samples it is of. Of the options the
/// threads count. If `progress` stops it, some pixels have less.
///
/// # Errors
///
/// The system refused to start the threads.
pub fn direct_light(
    scene: &CompiledScene,
    film: &Film,
    options: &RenderOptions,
    progress: &dyn Progress,
) -> Result<Option<Vec<Rgb>>, RenderError> {
    let Integrator::Path { max_depth, clamp } = scene.settings.integrator else { return Ok(None) };
    let tracer = PathTracer { max_depth: max_depth.min(SEGMENTS), clamp };
    let integrator = Cutout { integrator: &tracer, shown: scene.shown };
    same_samples_again((scene, &integrator), film, options, progress)
}

/// What another integrator makes of the very samples that a film is of: the means of its pixels, row by row.
pub(crate) fn same_samples_again<I: integrators::Integrator>(
    (scene, integrator): (&CompiledScene, &I),
    film: &Film,
    options: &RenderOptions,
    progress: &dyn Progress,
) -> Result<Option<Vec<Rgb>>, RenderError> {
    let Some(sums) = film.sums() else { return Ok(None) };
    let (Some(first), Some(passes)) = (sums.parts.first(), passes_of(film, &sums.parts, &sums.taken)) else {
        return Ok(None);
    };
    let mut again = Film::of_samples(film.region(), first.samples);
    let total = film.done();
    with_pool(options, || {
        for (part, pass) in passes {
            let filter = FilterSampling::new(scene.settings.filter);
            let sampling = Sampling { scene, integrator, filter, first: part.samples.start };
            let tiles = part.region.cells(TILE).filter(|&tile| pass.wants(tile)).collect();
            in_tiles(
                tiles,
                progress,
                &mut again,
                |tile| sampling.tile(tile, &pass),
                |again, tile| {
                    again.add(&tile);
                    progress.finished(again.done(), total);
                },
            );
        }
    })?;
    Ok(Some(again.pixels().to_vec()))
}

/// For each part of a film the samples that it has of its pixels. A film of one part has its first ones, as many as were
/// taken; one of several has all of each.
fn passes_of(film: &Film, parts: &[Part], taken: &[u32]) -> Option<Vec<(Part, Pass)>> {
    let (region, nothing) = (film.region(), vec![0; taken.len()]);
    let pass = |to: Vec<u32>| Pass { region, from: nothing.clone(), to, expected: 0 };
    if let &[part] = parts {
        return Some(vec![(part, pass(taken.to_vec()))]);
    }
    let mut counted = nothing.clone();
    let mut passes = Vec::new();
    for &part in parts {
        let mut to = nothing.clone();
        for (x, y) in part.region.pixel_places() {
            let pixel = region.index_of(x, y);
            to[pixel] = part.samples.count();
            counted[pixel] += part.samples.count();
        }
        passes.push((part, pass(to)));
    }
    (counted == taken).then_some(passes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compile::compile;
    use crate::film::SampleRange;
    use crate::schedule::render;
    use durer_math::DVec3;
    use durer_scene::{Background, Object, ObjectKind, PixelFilter, Scene, Shape};

    /// A white sky over a floor and a ball, 20 × 12 pixels.
    fn scene(max_depth: u32) -> CompiledScene {
        let ball = Object::new(ObjectKind::Shape(Shape::Sphere { center: DVec3::new(0.0, 0.0, -4.0), radius: 1.0 }));
        let floor = Object::new(ObjectKind::Shape(Shape::Plane { point: DVec3::NEG_Y, normal: DVec3::Y }));
        let mut scene = Scene {
            objects: vec![ball, floor],
            background: Background::Color(Rgb::WHITE),
            camera: Some(Default::default()),
            ..Scene::default()
        };
        (scene.picture.width, scene.picture.height) = (20, 12);
        scene.render.integrator = Integrator::Path { max_depth, clamp: None };
        scene.render.samples = 8;
        scene.render.filter = PixelFilter::Mitchell { radius: 2.0 };
        compile(&scene.check().unwrap())
    }

    fn options(samples: Option<SampleRange>) -> RenderOptions {
        RenderOptions { samples, ..RenderOptions::default() }
    }

    #[test]
    fn it_is_what_paths_of_two_segments_bring() {
        let film = render(&scene(16), &options(None), &()).unwrap();
        let direct = direct_light(&scene(16), &film, &options(None), &()).unwrap().unwrap();
        let short = render(&scene(2), &options(None), &()).unwrap();
        assert_eq!(direct, short.pixels());
        assert_eq!(direct_light(&scene(2), &short, &options(None), &()).unwrap().unwrap(), direct);
        let brighter = film.pixels().iter().zip(&direct).filter(|(all, direct)| all.g > direct.g + 0.01).count();
        assert!(brighter > 40, "a floor and a ball light each other: {brighter}");
    }

    #[test]
    fn it_is_of_the_samples_that_there_are() {
        let range = Some(SampleRange { start: 3, end: 7 });
        let film = render(&scene(16), &options(range), &()).unwrap();
        let short = render(&scene(2), &options(range), &()).unwrap();
        assert_eq!(direct_light(&scene(16), &film, &options(None), &()).unwrap().unwrap(), short.pixels());
    }
}

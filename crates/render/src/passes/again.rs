//! The samples of a film once more, for another integrator.

use super::{Pass, Sampling};
use crate::compile::CompiledScene;
use crate::film::{Film, Part, TILE};
use crate::filter_sampling::FilterSampling;
use crate::integrators::Integrator;
use crate::schedule::{Progress, RenderError, RenderOptions, in_tiles, with_pool};
use durer_math::Rgb;

/// What another integrator makes of the very samples that a film is of: the means of its pixels, row by row. `None` if it cannot
/// be told any more which samples those are. Of the options the threads count.
pub(crate) fn same_samples_again<I: Integrator>(
    (scene, integrator): (&CompiledScene, &I),
    film: &Film,
    options: &RenderOptions,
    progress: &dyn Progress,
) -> Result<Option<Vec<Rgb>>, RenderError> {
    let Some(sums) = film.sums() else { return Ok(None) };
    let (Some(first), Some(passes)) = (sums.parts.first(), passes_of(film, &sums.parts, &sums.taken)) else {
        return Ok(None);
    };
    let mut again = Film::of_samples(film.region(), first.samples, false);
    let total = film.done();
    with_pool(options, || {
        for (part, pass) in passes {
            let filter = FilterSampling::new(scene.settings.filter);
            let sampling = Sampling { scene, integrator, filter, first: part.samples.start, direct: false };
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
    use crate::integrators::path::PathTracer;
    use crate::schedule::render;
    use durer_math::DVec3;
    use durer_scene::{Background, Object, ObjectKind, PixelFilter, Scene, Shape};

    /// A white sky over a ball, 20 × 12 pixels.
    fn scene() -> CompiledScene {
        let ball = Object::new(ObjectKind::Shape(Shape::Sphere { center: DVec3::new(0.0, 0.0, -4.0), radius: 1.0 }));
        let mut scene = Scene {
            objects: vec![ball],
            background: Background::Color(Rgb::WHITE),
            camera: Some(Default::default()),
            ..Scene::default()
        };
        (scene.picture.width, scene.picture.height) = (20, 12);
        scene.render.integrator = durer_scene::Integrator::PATH;
        scene.render.samples = Some(8);
        scene.render.filter = PixelFilter::Mitchell { radius: 2.0 };
        compile(&scene.check().unwrap())
    }

    /// The same integrator makes the same film of them.
    #[test]
    fn they_are_the_very_samples() {
        let tracer = PathTracer { max_depth: 16, clamp: None };
        for samples in [None, Some(SampleRange { start: 3, end: 7 })] {
            let options = RenderOptions { samples, ..RenderOptions::default() };
            let film = render(&scene(), &options, &()).unwrap();
            let again = same_samples_again((&scene(), &tracer), &film, &RenderOptions::default(), &()).unwrap();
            assert_eq!(again.unwrap(), film.pixels());
        }
    }
}

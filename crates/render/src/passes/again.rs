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

/// For each part of a film the samples that it has of its pixels. Where a pixel is in one part only, it has the first ones of
/// that, as many as were taken: a goal for noise may have ended them. Where it is in several, it must have all of each, or it
/// cannot be told which it has.
fn passes_of<'a>(film: &Film, parts: &'a [Part], taken: &'a [u32]) -> Option<impl Iterator<Item = (Part, Pass)> + 'a> {
    let region = film.region();
    let pixels = move |part: &Part| part.region.pixel_places().map(move |(x, y)| region.index_of(x, y));
    let (mut number, mut most) = (vec![0_u32; taken.len()], vec![0_u32; taken.len()]);
    for part in parts {
        for pixel in pixels(part) {
            number[pixel] += 1;
            most[pixel] = most[pixel].saturating_add(part.samples.count());
        }
    }
    let can_be_told =
        |pixel: usize| if number[pixel] > 1 { taken[pixel] == most[pixel] } else { taken[pixel] <= most[pixel] };
    if !(0..taken.len()).all(can_be_told) {
        return None;
    }
    // One after the other, since there may be many.
    Some(parts.iter().map(move |part| {
        let to: Vec<u32> = pixels(part).map(|pixel| taken[pixel].min(part.samples.count())).collect();
        (*part, Pass { region: part.region, from: vec![0; to.len()], to, expected: 0 })
    }))
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
        let tracer = PathTracer(durer_scene::PathSettings::default());
        for samples in [None, Some(SampleRange { start: 3, end: 7 })] {
            let options = RenderOptions { samples, ..RenderOptions::default() };
            let film = render(&scene(), &options, &()).unwrap();
            let again = same_samples_again((&scene(), &tracer), &film, &RenderOptions::default(), &()).unwrap();
            assert_eq!(again.unwrap(), film.pixels());
        }
    }

    /// Films that noise ended, of parts of the picture that do not make a rectangle, are known still.
    #[test]
    fn merged_films_know_the_samples_of_each_part() {
        let tracer = PathTracer(durer_scene::PathSettings::default());
        let mut scene = scene();
        (scene.settings.noise, scene.settings.samples) = (Some(0.03), Some(200));
        let of = |x, y, width, height| {
            let region = Some(crate::film::Region { x, y, width, height });
            render(&scene, &RenderOptions { region, ..RenderOptions::default() }, &()).unwrap()
        };
        let merged = Film::merge(&[of(0, 0, 9, 12), of(9, 3, 11, 5)]).unwrap();
        let taken = &merged.sums().unwrap().taken;
        assert!(taken.iter().any(|&taken| taken > 64) && taken.contains(&0), "{taken:?}");
        let again = same_samples_again((&scene, &tracer), &merged, &RenderOptions::default(), &()).unwrap();
        assert_eq!(again.unwrap(), merged.pixels());
        let some = |start, end| {
            let samples = Some(SampleRange { start, end });
            render(&scene, &RenderOptions { samples, ..RenderOptions::default() }, &()).unwrap()
        };
        let merged = Film::merge(&[some(0, 2), some(5, 9)]).unwrap();
        let again = same_samples_again((&scene, &tracer), &merged, &RenderOptions::default(), &()).unwrap();
        assert_eq!(again.unwrap(), merged.pixels());
    }
}

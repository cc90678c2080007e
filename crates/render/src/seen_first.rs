//! What is seen first in each pixel: not light, but what compositing and denoising want to know of it. It follows from the
//! scene alone, by rays of the eye, so that no film needs to carry it.

use crate::compile::CompiledScene;
use crate::film::Region;
use crate::holes::Known;
use crate::integrators::first_surface::look_at_first_surface;
use crate::observer::Observer;
use crate::sampler::{Purpose, Sampler};
use crate::schedule::{Progress, RenderError, RenderOptions, in_tiles, region_of, with_pool};
use durer_math::{DVec2, DVec3, Rgb};

/// What is seen first in each pixel of a region, row by row. Surfaces that are there for less than half are not seen.
///
/// Means are of [`SeenFirst::SAMPLES`] rays, all over the pixel and the lens. What has no mean is that of the one ray through the middle of
/// the pixel and of the lens.
#[derive(Clone, Debug, PartialEq)]
pub struct SeenFirst {
    /// Which pixels.
    pub region: Region,
    /// The color of surfaces, from 0 to 1, in the mean; black for the background.
    pub albedo: Vec<Rgb>,
    /// The unit normal of shading, in world space and on the side that is seen, in the mean; 0 for the background.
    pub normal: Vec<[f32; 3]>,
    /// The part of the pixel where there is anything but background, from 0 to 1.
    pub coverage: Vec<f32>,
    /// How far away it is, along the view, in world units; infinite for the background.
    pub depth: Vec<f32>,
    /// Where it is, in world space; 0 for the background.
    pub position: Vec<[f32; 3]>,
    /// Its texture coordinates; 0 for the background.
    pub uv: Vec<[f32; 2]>,
    /// 0 for the background; else 1 more than the shape's index, counting the shapes of the scene file from 0, depth first,
    /// those of instances copy by copy.
    pub object_id: Vec<u32>,
    /// 0 for the background; else 1 more than the material's index in the scene's list, after which comes the default one.
    pub material_id: Vec<u32>,
}

/// One pixel.
#[derive(Clone, Copy, Default)]
struct Pixel {
    albedo: Rgb,
    normal: DVec3,
    coverage: f32,
    depth: f32,
    position: DVec3,
    uv: DVec2,
    object_id: u32,
    material_id: u32,
}

/// Finds out what is seen first. Of the options threads and region count. If `progress` stops it, some pixels are as empty as
/// the background.
///
/// # Errors
///
/// The region does not lie in the picture, or the system refused to start the threads.
pub fn seen_first(
    scene: &CompiledScene,
    options: &RenderOptions,
    progress: &dyn Progress,
) -> Result<SeenFirst, RenderError> {
    let region = region_of(scene, options)?;
    let mut seen = SeenFirst::nothing(region);
    let make = |tile: Region| (tile, tile.pixel_places().map(|pixel| look(scene, pixel)).collect());
    let mut finished = 0;
    with_pool(options, || {
        in_tiles(
            region.tiles().collect(),
            progress,
            &mut (&mut seen, &mut finished),
            make,
            |(seen, finished), made| {
                let (tile, pixels): (Region, Vec<Pixel>) = made;
                **finished += tile.pixels();
                tile.pixel_places().zip(pixels).for_each(|(place, pixel)| seen.put(place, &pixel));
                progress.finished(**finished, region.pixels());
            },
        );
    })?;
    Ok(seen)
}

fn look(scene: &CompiledScene, (x, y): (u32, u32)) -> Pixel {
    let corner = DVec2::new(f64::from(x), f64::from(y));
    let mut pixel = Pixel { depth: f32::INFINITY, ..Pixel::default() };
    let camera = &scene.camera;
    look_at_first_surface(scene, &camera.ray(corner + 0.5), Known::Nothing, &mut Silent, |first, _| {
        if let Some(first) = first {
            let point = first.shading.surface.point;
            pixel.depth = camera.depth_of(point) as f32;
            pixel.position = point;
            pixel.uv = scene.world.uv(point, &first.hit);
            pixel.object_id = first.hit.primitive.saturating_add(1);
            pixel.material_id = scene.material_at(&first.hit).saturating_add(1);
        }
        Rgb::BLACK
    });
    for number in 0..SeenFirst::SAMPLES {
        let sampler = Sampler::new(scene.settings.seed, (x, y), number);
        let at = corner + sampler.two(0, Purpose::Pixel);
        let ray = match camera.has_lens() {
            true => camera.ray_through_lens(at, sampler.two(0, Purpose::Lens)),
            false => camera.ray(at),
        };
        look_at_first_surface(scene, &ray, Known::Nothing, &mut Silent, |first, _| {
            if let Some(first) = first {
                pixel.albedo += first.shading.albedo(scene);
                pixel.normal += first.shading.normal();
                pixel.coverage += 1.0;
            }
            Rgb::BLACK
        });
    }
    pixel
}

/// Nobody watches.
struct Silent;

impl Observer for Silent {}

impl SeenFirst {
    /// How many rays a mean is of.
    pub const SAMPLES: u32 = 32;

    /// Of an empty scene.
    fn nothing(region: Region) -> SeenFirst {
        let length = region.width as usize * region.height as usize;
        SeenFirst {
            region,
            albedo: vec![Rgb::BLACK; length],
            normal: vec![[0.0; 3]; length],
            coverage: vec![0.0; length],
            depth: vec![f32::INFINITY; length],
            position: vec![[0.0; 3]; length],
            uv: vec![[0.0; 2]; length],
            object_id: vec![0; length],
            material_id: vec![0; length],
        }
    }

    fn put(&mut self, (x, y): (u32, u32), pixel: &Pixel) {
        let Region { x: left, y: top, width, .. } = self.region;
        let index = (y - top) as usize * width as usize + (x - left) as usize;
        let single = |v: DVec3| v.to_array().map(|c| c as f32);
        self.albedo[index] = pixel.albedo * (1.0 / Self::SAMPLES as f32);
        self.normal[index] = single(pixel.normal / f64::from(Self::SAMPLES));
        self.coverage[index] = pixel.coverage / Self::SAMPLES as f32;
        self.depth[index] = pixel.depth;
        self.position[index] = single(pixel.position);
        self.uv[index] = pixel.uv.to_array().map(|c| c as f32);
        self.object_id[index] = pixel.object_id;
        self.material_id[index] = pixel.material_id;
    }
}

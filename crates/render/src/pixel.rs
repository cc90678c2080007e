//! One pixel: rays where the anti-aliasing wants them, their colours summed.

use crate::antialias::{Antialias, Sample};
use crate::compile::CompiledScene;
use crate::integrators::Integrator;
use crate::observer::Observer;
use durer_math::{DVec2, Rgb};

/// A pixel's colour, and how many of its samples were not finite and count as black.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pixel {
    pub(crate) color: Rgb,
    pub(crate) bad_samples: u64,
}

/// Told about samples as well as about rays.
pub(crate) trait SampleObserver: Observer {
    fn sample_begins(&mut self, _at: DVec2) {}
    fn sample_kept(&mut self, _weight: f32, _sample: Sample) {}
}

impl SampleObserver for crate::observer::RayCounts {}

/// Renders the pixel at column `x`, row `y`.
#[inline]
pub(crate) fn render_pixel<I: Integrator, A: Antialias, O: SampleObserver>(
    scene: &CompiledScene,
    (integrator, antialias): (&I, &A),
    (x, y): (u32, u32),
    observer: &mut O,
) -> Pixel {
    let mut pixel = Pixel { color: Rgb::BLACK, bad_samples: 0 };
    let mut index = 0;
    let observer = std::cell::RefCell::new(observer);
    let take = |at: DVec2| {
        let mut observer = observer.borrow_mut();
        observer.sample_begins(at);
        let mut color = integrator.radiance(scene, &scene.camera.ray(at), *observer);
        if !color.is_finite() {
            pixel.bad_samples += 1;
            color = Rgb::BLACK;
        }
        index += 1;
        Sample { color, index: index - 1 }
    };
    antialias.pixel(DVec2::new(f64::from(x), f64::from(y)), take, |weight, sample| {
        pixel.color += sample.color * weight;
        observer.borrow_mut().sample_kept(weight, sample);
    });
    pixel
}

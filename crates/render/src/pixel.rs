//! One pixel: rays where the anti-aliasing wants them, their colours summed.

use crate::antialias::{Antialias, Sample, Samples};
use crate::compile::CompiledScene;
use crate::holes::Known;
use crate::integrators::Integrator;
use crate::observer::Observer;
use durer_geometry::Hit;
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

/// Renders the pixel at column `x`, row `y`. `first_hits` are those of the first rays that it takes, as many as are known.
#[inline]
pub(crate) fn render_pixel<I: Integrator, A: Antialias, O: SampleObserver>(
    scene: &CompiledScene,
    (integrator, antialias): (&I, &A),
    (x, y): (u32, u32),
    first_hits: &[Option<Hit>],
    observer: &mut O,
) -> Pixel {
    let pixel = Pixel { color: Rgb::BLACK, bad_samples: 0 };
    let mut gathered = Gathered { scene, integrator, observer, first_hits, taken: 0, pixel };
    antialias.pixel(DVec2::new(f64::from(x), f64::from(y)), &mut gathered);
    gathered.pixel
}

/// The samples of one pixel.
struct Gathered<'a, I, O> {
    scene: &'a CompiledScene,
    integrator: &'a I,
    observer: &'a mut O,
    first_hits: &'a [Option<Hit>],
    taken: u32,
    pixel: Pixel,
}

impl<I: Integrator, O: SampleObserver> Samples for Gathered<'_, I, O> {
    fn take(&mut self, at: DVec2) -> Sample {
        self.observer.sample_begins(at);
        let known = match (self.first_hits.get(self.taken as usize), &self.scene.eye_vantage) {
            (Some(&hit), _) => Known::Hit(hit),
            (None, Some(vantage)) => Known::Vantage(vantage),
            (None, None) => Known::Nothing,
        };
        let mut color = self.integrator.radiance(self.scene, &self.scene.camera.ray(at), known, self.observer);
        if !color.is_finite() {
            self.pixel.bad_samples += 1;
            color = Rgb::BLACK;
        }
        self.taken += 1;
        Sample { color, index: self.taken - 1 }
    }

    fn keep(&mut self, weight: f32, sample: Sample) {
        self.pixel.color += sample.color * weight;
        self.observer.sample_kept(weight, sample);
    }
}

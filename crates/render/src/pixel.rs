//! One pixel of its own: rays where the anti-aliasing wants them, their colours summed.

use crate::antialias::{Antialias, Sample, Samples};
use crate::compile::CompiledScene;
use crate::eye::begin;
use crate::film::Account;
use crate::first_hits::FirstRays;
use crate::holes::Known;
use crate::integrators::Integrator;
use crate::sampler::Sampler;
use durer_math::{DVec2, Rgb};

/// What has become of a pixel.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pixel {
    pub(crate) color: Rgb,
    pub(crate) depth: u8,
    /// True if a sample was not finite: such samples count as black here, and must be left out by other means.
    pub(crate) has_bad_samples: bool,
}

/// Renders the pixel at column `x`, row `y`. `first_rays` are the first that it takes, as many as are known.
#[inline]
pub(crate) fn render_pixel<I: Integrator, A: Antialias>(
    scene: &CompiledScene,
    (integrator, antialias): (&I, &A),
    (x, y): (u32, u32),
    first_rays: FirstRays<'_>,
    account: &mut Account,
) -> Pixel {
    let pixel = Pixel { color: Rgb::BLACK, depth: 0, has_bad_samples: false };
    let mut gathered = Gathered { scene, integrator, account, first_rays, taken: 0, pixel };
    antialias.pixel(DVec2::new(f64::from(x), f64::from(y)), &mut gathered);
    gathered.pixel
}

/// The samples of one pixel.
struct Gathered<'a, I> {
    scene: &'a CompiledScene,
    integrator: &'a I,
    account: &'a mut Account,
    first_rays: FirstRays<'a>,
    taken: u32,
    pixel: Pixel,
}

/// What arrives along the eye's ray through a point; `None` if that is not finite. Apart from what is done for every sample,
/// which then is little enough to stay in registers.
#[inline(never)]
fn trace(
    (scene, integrator): (&CompiledScene, &impl Integrator),
    at: DVec2,
    known: Option<Known<'_>>,
    account: &mut Account,
) -> Option<Rgb> {
    let known = match (known, &scene.eye_vantage) {
        (Some(known), _) => known,
        (None, Some(vantage)) => Known::Vantage(vantage),
        (None, None) => Known::Nothing,
    };
    let (ray, sampler) = match known.seen() {
        Some(seen) => (seen.ray(scene, at), Sampler::of_place(scene.settings.seed, at)),
        None => begin(scene, at),
    };
    let color = integrator.radiance(scene, &ray, known, &sampler, &mut account.rays);
    if !color.is_finite() {
        account.bad_sample(at);
        return None;
    }
    Some(color)
}

impl<I: Integrator> Samples for Gathered<'_, I> {
    #[inline(always)]
    fn take(&mut self, at: DVec2) -> Sample {
        let index = self.taken;
        self.taken += 1;
        let color = match self.first_rays.sum(index as usize) {
            Some(sum) => {
                let rays = &mut self.account.rays;
                (rays.eye, rays.shadow) = (rays.eye + 1, rays.shadow + sum.shadow_rays);
                sum.color
            }
            None => {
                let known = self.first_rays.known(index as usize);
                let color = trace((self.scene, self.integrator), at, known, self.account);
                self.pixel.has_bad_samples |= color.is_none();
                color.unwrap_or(Rgb::BLACK)
            }
        };
        Sample { color, index }
    }

    #[inline(always)]
    fn keep(&mut self, weight: f32, sample: Sample) {
        self.pixel.color += sample.color * weight;
    }

    fn divided(&mut self, depth: u32) {
        self.pixel.depth = self.pixel.depth.max(u8::try_from(depth).unwrap_or(u8::MAX));
    }
}

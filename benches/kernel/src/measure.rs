//! How a program is measured: which rays, in which order, by which clock.

use crate::print::Lines;
use crate::rays::{Ray, bounce};
use crate::scene::{PICTURE, Scene};
use rustix::time::{ClockId, clock_gettime};

/// What rays found.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Found {
    /// How many hit something.
    pub hits: usize,
    /// The sum of the distances of hits; 0 for rays that ask only whether there is one.
    pub sum: f64,
}

/// A measured run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Run {
    /// Processor time of one pass over the rays.
    pub seconds: f64,
    /// What it found.
    pub found: Found,
}

/// A scene as some crate holds it, ready for rays.
pub trait Kernel {
    /// The distance of the nearest hit.
    fn closest(&self, ray: &Ray) -> Option<f64>;

    /// True if something is nearer than `t_max`.
    fn any(&self, ray: &Ray, t_max: f32) -> bool;

    /// The number of the thing that is hit first.
    fn first(&self, ray: &Ray) -> Option<u32>;

    /// [`Kernel::closest`] of all rays.
    fn all_closest(&self, rays: &[Ray]) -> Found {
        let mut found = Found::default();
        for t in rays.iter().filter_map(|ray| self.closest(ray)) {
            found.hits += 1;
            found.sum += t;
        }
        found
    }

    /// [`Kernel::any`] of all rays.
    fn all_any(&self, rays: &[Ray], t_max: f32) -> Found {
        Found { hits: rays.iter().filter(|ray| self.any(ray, t_max)).count(), sum: 0.0 }
    }

    /// [`Kernel::all_closest`], eight rays at a time, if that can be.
    fn packets_closest(&self, _rays: &[Ray]) -> Option<Found> {
        None
    }

    /// [`Kernel::all_any`], eight rays at a time, if that can be.
    fn packets_any(&self, _rays: &[Ray], _t_max: f32) -> Option<Found> {
        None
    }
}

/// A run that takes longer than this is neither warmed up nor repeated.
const LONG: f64 = 2.0;

/// Measures all kinds of rays, each `repeats` times, and prints the medians; none if that is 0.
pub fn all(lines: Lines<'_>, scene: &Scene, kernel: &impl Kernel, repeats: usize) {
    if repeats == 0 {
        return;
    }
    let primary = scene.view.primary(PICTURE);
    let single = |rays: &[Ray]| Some(kernel.all_closest(rays));
    let packets = |rays: &[Ray]| kernel.packets_closest(rays);
    let measure = |name: &str, way: &str, rays: &[Ray], trace: &dyn Fn(&[Ray]) -> Option<Found>| {
        if let Some(run) = median_of(repeats, || trace(rays)) {
            lines.rays(name, way, rays.len(), &run);
        }
    };
    measure("primary", "single", &primary, &single);
    measure("primary", "packets", &primary, &packets);
    let (bounced, shadow) = secondary(scene, kernel, &primary);
    measure("bounce", "single", &bounced, &single);
    measure("bounce any", "single", &bounced, &|rays| Some(kernel.all_any(rays, f32::INFINITY)));
    measure("shadow", "single", &shadow, &|rays| Some(kernel.all_any(rays, 1.0)));
    measure("shadow", "packets", &shadow, &|rays| kernel.packets_any(rays, 1.0));
}

/// Bounced rays and shadow rays from where the primary rays hit.
fn secondary(scene: &Scene, kernel: &impl Kernel, primary: &[Ray]) -> (Vec<Ray>, Vec<Ray>) {
    let of = |(index, ray): (usize, &Ray)| {
        let point = scene.point(kernel.first(ray)?, ray);
        Some((bounce(index, point), scene.view.shadow(point)))
    };
    primary.iter().enumerate().filter_map(of).unzip()
}

/// The median time of `repeats` passes after one more to warm up; `None` if they give nothing.
pub fn median_of(repeats: usize, mut pass: impl FnMut() -> Option<Found>) -> Option<Run> {
    let mut timed = || {
        let start = processor_time();
        pass().map(|found| Run { seconds: processor_time() - start, found })
    };
    let first = timed()?;
    if first.seconds > LONG {
        return Some(first);
    }
    let mut runs: Vec<Run> = (0..repeats.max(1)).filter_map(|_| timed()).collect();
    runs.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
    runs.get(runs.len() / 2).copied()
}

/// Builds up to three times; gives the median time and the last result.
pub fn build<T>(repeats: usize, mut build: impl FnMut() -> T) -> (f64, T) {
    let mut seconds = Vec::new();
    loop {
        let start = processor_time();
        let built = build();
        seconds.push(processor_time() - start);
        if seconds.len() >= repeats.clamp(1, 3) || seconds[0] > LONG {
            seconds.sort_by(f64::total_cmp);
            return (seconds[seconds.len() / 2], built);
        }
    }
}

/// Seconds that all threads of this process have had of the processor so far.
pub fn processor_time() -> f64 {
    let time = clock_gettime(ClockId::ProcessCPUTime);
    time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9
}

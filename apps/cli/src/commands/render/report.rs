//! What there is to say about a render: one line for people, an object for programs.

use crate::exit::Failure;
use crate::numbers::{bytes, samples_a_pixel, short, thousands};
use crate::output;
use durer::imaging::FileFormat;
use durer::math::DVec2;
use durer::{BadSample, Film, RayCounts, Region, Sums};
use serde_json::json;
use std::ffi::OsString;
use std::path::PathBuf;

/// All that is known about a render.
pub(super) struct Report {
    scene: PathBuf,
    path: PathBuf,
    /// `None` for a film.
    format: Option<FileFormat>,
    region: Region,
    finished: u64,
    rays: RayCounts,
    /// Rays of an earlier run that this one goes on with.
    rays_before: u64,
    bad_samples: u64,
    first_bad_sample: Option<BadSample>,
    samples: Option<Samples>,
    bytes: usize,
    seconds: Seconds,
    /// What stopped it, if anything did.
    stopped_by: &'static str,
}

/// The samples of pixels.
#[derive(Clone, Copy)]
struct Samples {
    least: u32,
    most: u32,
    mean: f64,
    /// As many as a pixel was to have, at most.
    wanted: u32,
    /// As goals for noise measure it.
    noise: Option<f64>,
}

impl Samples {
    /// For the line at the end.
    fn text(&self) -> String {
        let count = samples_a_pixel(self.least, self.most);
        let noise = self.noise.map_or(String::new(), |noise| format!(", noise {}", short((noise * 1e4).round() / 1e4)));
        format!(", {count}{noise}")
    }

    fn of(sums: &Sums, noise: Option<f64>) -> Samples {
        let (least, most) = sums.least_and_most();
        let pixels = sums.taken.len();
        Samples {
            least,
            most,
            mean: sums.samples() as f64 / pixels as f64,
            wanted: sums.parts.iter().map(|part| part.samples.count()).max().unwrap_or(0),
            noise,
        }
    }
}

/// Seconds of wall time for each step.
#[derive(Clone, Copy, Default)]
pub(super) struct Seconds {
    pub(super) load: f64,
    pub(super) build: f64,
    pub(super) render: f64,
    pub(super) write: f64,
}

impl Report {
    /// What the film says.
    pub(super) fn new(scene: PathBuf, path: PathBuf, format: Option<FileFormat>, film: &Film, exposure: f32) -> Report {
        Report {
            scene,
            path,
            format,
            region: film.region(),
            finished: film.finished_pixels(),
            rays: film.rays(),
            rays_before: 0,
            bad_samples: film.bad_samples(),
            first_bad_sample: film.first_bad_sample(),
            samples: film.sums().map(|sums| Samples::of(sums, film.noise(exposure))),
            bytes: 0,
            seconds: Seconds::default(),
            stopped_by: "interrupted",
        }
    }

    /// With what stopped it, if anything did.
    pub(super) fn stopped_by(self, stopped_by: &'static str) -> Report {
        Report { stopped_by, ..self }
    }

    /// With the time that the steps took.
    pub(super) fn with_seconds(self, seconds: Seconds) -> Report {
        Report { seconds, ..self }
    }

    /// Goes on with a run that traced so many rays.
    pub(super) fn after(self, rays_before: u64) -> Report {
        Report { rays_before, ..self }
    }

    /// What the picture is called if it is not complete: `room.partial.png` in place of `room.png`.
    pub(super) fn name_of_part(&self) -> OsString {
        let mut name = self.path.file_stem().unwrap_or_default().to_owned();
        name.push(".partial.");
        name.push(self.path.extension().unwrap_or_default());
        name
    }

    /// The file that is written: that of the picture, or of a part.
    fn written_path(&self) -> PathBuf {
        if self.is_complete() { self.path.clone() } else { self.path.with_file_name(self.name_of_part()) }
    }

    /// What an interruption means for the picture.
    fn fate(&self) -> &'static str {
        if self.path.exists() { "is as it was" } else { "is not written" }
    }

    /// The file is written.
    pub(super) fn written(&mut self, bytes: usize, seconds: f64) {
        self.bytes = bytes;
        self.seconds.write = seconds;
    }

    /// True if every pixel is finished.
    pub(super) fn is_complete(&self) -> bool {
        self.finished == self.pixels()
    }

    pub(super) fn pixels(&self) -> u64 {
        u64::from(self.region.width) * u64::from(self.region.height)
    }

    /// `None` if no ray was traced, but the picture of a film made.
    fn mrays_per_second(&self) -> Option<f64> {
        let rays = self.rays.total().saturating_sub(self.rays_before);
        (rays > 0 && self.seconds.render > 0.0).then(|| rays as f64 / self.seconds.render / 1e6)
    }

    /// The line at the end.
    pub(super) fn tell(&self) {
        let Region { width, height, .. } = self.region;
        let RayCounts { eye, reflected, transmitted, shadow, cut_off } = self.rays;
        let Seconds { load, build, render, .. } = self.seconds;
        let cut_off = match cut_off {
            0 => String::new(),
            count => format!(" ({} more cut off as too deep)", thousands(count)),
        };
        let samples = self.samples.map_or(String::new(), |samples| samples.text());
        let work = match self.mrays_per_second() {
            Some(rate) => {
                format!(", {rate:.2} Mrays/s; load {load:.3} s, build {build:.3} s, render {render:.3} s")
            }
            None => String::new(),
        };
        output::note(&format!(
            "{}: {width} × {height} pixels, {}{samples}; {} eye ({} a pixel), {} reflected, {} transmitted, {} shadow rays{cut_off}{work}",
            self.written_path().display(),
            bytes(self.bytes as u64),
            thousands(eye),
            short((self.eye_rays_per_pixel() * 100.0).round() / 100.0),
            thousands(reflected),
            thousands(transmitted),
            thousands(shadow),
        ));
    }

    /// Of the pixels that are finished, or have samples.
    fn eye_rays_per_pixel(&self) -> f64 {
        let pixels = if self.samples.is_some() { self.pixels() } else { self.finished };
        self.rays.eye as f64 / pixels.max(1) as f64
    }

    /// Says which samples had no colour.
    pub(super) fn tell_bad_samples(&self) {
        let Some(BadSample { at }) = self.first_bad_sample else { return };
        let (x, y) = pixel_of(at);
        output::warning(&format!(
            "{} of the samples had no finite color and were left out, the first at {},{} in pixel {x},{y} \
             (see it with: durer explain {} --pixel {x},{y})",
            thousands(self.bad_samples),
            at.x,
            at.y,
            self.scene.display(),
        ));
    }

    /// Says that the picture is not complete.
    pub(super) fn tell_interrupted(&self) {
        if let Some(Samples { least, most, wanted, .. }) = self.samples {
            let taken = if least == most { least.to_string() } else { format!("{least} to {most}") };
            return output::note(&format!(
                "{}: {} has {taken} of {}; {} {}",
                self.stopped_by,
                self.written_path().display(),
                samples_a_pixel(wanted, wanted),
                self.path.display(),
                self.fate(),
            ));
        }
        let share = 100.0 * self.finished as f64 / self.pixels() as f64;
        output::note(&format!(
            "{}: {} has {} of {} pixels ({} %), the others are black; {} {}",
            self.stopped_by,
            self.written_path().display(),
            thousands(self.finished),
            thousands(self.pixels()),
            short((share * 10.0).floor() / 10.0),
            self.path.display(),
            self.fate(),
        ));
    }

    /// Says that there is no picture.
    pub(super) fn tell_nothing(&self) {
        let path = self.path.display();
        output::note(&format!("{} before any tile was finished: {path} {}", self.stopped_by, self.fate()));
    }

    /// Prints everything for programs.
    pub(super) fn print_json(&self) -> Result<(), Failure> {
        let Region { x, y, width, height } = self.region;
        let RayCounts { eye, reflected, transmitted, shadow, cut_off } = self.rays;
        let Seconds { load, build, render, write } = self.seconds;
        output::print_json(&json!({
            "scene": self.scene.to_string_lossy(),
            "output": self.written_path().to_string_lossy(),
            "format": self.format.map_or("film".to_owned(), |format| format.name().to_lowercase()),
            "bytes": self.bytes,
            "region": { "x": x, "y": y, "width": width, "height": height },
            "pixels": self.pixels(),
            "finished_pixels": self.finished,
            "complete": self.is_complete(),
            "rays": {
                "eye": eye, "reflected": reflected, "transmitted": transmitted, "shadow": shadow,
                "total": self.rays.total(), "cut_off": cut_off,
            },
            "eye_rays_per_pixel": self.eye_rays_per_pixel(),
            "samples": self.samples.map(|Samples { least, most, mean, wanted, noise }| {
                let a_second = self.mrays_per_second().map(|_| mean * self.pixels() as f64 / render.max(1e-9));
                json!({ "least": least, "most": most, "mean": mean, "wanted": wanted, "noise": noise, "per_second": a_second })
            }),
            "mrays_per_second": self.mrays_per_second(),
            "seconds": { "load": load, "build": build, "render": render, "write": write },
            "bad_samples": self.bad_samples,
            "first_bad_sample": self.first_bad_sample.map(|BadSample { at }| {
                let (x, y) = pixel_of(at);
                json!({ "pixel": [x, y], "at": [at.x, at.y] })
            }),
        }))
    }
}

/// The pixel that a sample lies in.
fn pixel_of(at: DVec2) -> (u32, u32) {
    (at.x as u32, at.y as u32)
}

//! What is computed, how much of it is sampled, and how light becomes a picture, in place of what the scene says.

use crate::commands::develop::{exposure, tone_mappings};
use clap::Args;
use durer::imaging::ToneMapping;
use durer::scene::{Integrator, PathSettings, Picture, RenderSettings};

/// Settings of light that win over those of the scene file.
#[derive(Args, Debug, Default)]
#[command(next_help_heading = "Instead of what the scene says")]
pub(crate) struct Light {
    /// What is computed: `whitted`, `path[:DEPTH[,CLAMP]]`, `ambient_occlusion[:DISTANCE]`, `normals`, `depth` or `uv`. What is
    /// not given of `path` stays as the file has it
    #[arg(long, value_name = "WHAT", value_parser = choice)]
    integrator: Option<Choice>,

    /// With `path`, so many neighboring pixels use each path: 1, or 4, 16 or 64, those of a block
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    reuse: Option<u32>,

    /// With `path`, so many paths go on from the first surface of each sample that spreads light, from 1 to 64
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    split: Option<u32>,

    /// Samples a pixel where light is sampled at random, from 1 to 1000000; at most if there is a noise or time to reach
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    samples: Option<u32>,

    /// Takes samples until the noise is below this everywhere: the standard error of a pixel over the root of its
    /// brightness, so that 0.02 is one in fifty in white
    #[arg(long, value_name = "PART", allow_negative_numbers = true)]
    noise: Option<f32>,

    /// Begins no samples after this many seconds
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true)]
    time: Option<f64>,

    /// Chooses the noise that is left: other numbers, other noise
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    seed: Option<u32>,

    /// Shadow rays of `whitted` to each light that has an area, at most 4096; with 0, what glows lights nothing
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    light_samples: Option<u32>,

    /// Makes a PNG or JPEG brighter by a factor of 2 for each 1
    #[arg(long, value_name = "STOPS", value_parser = exposure, allow_negative_numbers = true)]
    exposure: Option<f32>,

    /// How light above 1 is brought into a PNG or JPEG
    #[arg(long, value_name = "HOW", value_parser = tone_mappings())]
    tone_mapping: Option<String>,
}

impl Light {
    pub(super) fn change_render(&self, render: &mut RenderSettings) {
        render.integrator = self.integrator.map_or(render.integrator, |choice| choice.after(&render.integrator));
        if let Integrator::Path(path) = &mut render.integrator {
            path.reuse = self.reuse.unwrap_or(path.reuse);
            path.split = self.split.unwrap_or(path.split);
        }
        render.samples = self.samples.or(render.samples);
        render.noise = self.noise.or(render.noise);
        render.time = self.time.or(render.time);
        render.seed = self.seed.unwrap_or(render.seed);
        render.light_samples = self.light_samples.unwrap_or(render.light_samples);
    }

    pub(super) fn change_picture(&self, picture: &mut Picture) {
        picture.exposure = self.exposure.unwrap_or(picture.exposure);
        let word = self.tone_mapping.as_deref();
        let chosen = ToneMapping::ALL.into_iter().find(|mapping| word == Some(mapping.word()));
        picture.tone_mapping = chosen.unwrap_or(picture.tone_mapping);
    }

    /// The option that gives this field of the scene's settings; `None` if the file does.
    pub(super) fn name_of(&self, field: &str) -> Option<&'static str> {
        let (option, is_given) = match field {
            "integrator" => ("--integrator", self.integrator.is_some()),
            "samples" => ("--samples", self.samples.is_some()),
            "noise" => ("--noise", self.noise.is_some()),
            "time" => ("--time", self.time.is_some()),
            "seed" => ("--seed", self.seed.is_some()),
            "light_samples" => ("--light-samples", self.light_samples.is_some()),
            "exposure" => ("--exposure", self.exposure.is_some()),
            _ => return None,
        };
        is_given.then_some(option)
    }

    /// The option that gives this field of what is computed: `--integrator` gives no more of it than it says.
    pub(super) fn name_of_part(&self, field: &str) -> Option<&'static str> {
        let says = |numbers| self.integrator.is_some_and(|choice| choice.given >= numbers);
        let (option, is_given) = match field {
            "reuse" => ("--reuse", self.reuse.is_some()),
            "split" => ("--split", self.split.is_some()),
            "max_depth" | "distance" => ("--integrator", says(1)),
            "clamp" => ("--integrator", says(2)),
            _ => return None,
        };
        is_given.then_some(option)
    }

    /// The options that were given although they mean nothing to this integrator.
    pub(super) fn meaningless_to(&self, integrator: &Integrator) -> Vec<&'static str> {
        let of_samples =
            [("--samples", self.samples.is_some()), ("--noise", self.noise.is_some()), ("--time", self.time.is_some())];
        let of_whitted = [("--light-samples", self.light_samples.is_some())];
        let of_path = [("--reuse", self.reuse.is_some()), ("--split", self.split.is_some())];
        let given = |(option, is_given): (&'static str, bool)| is_given.then_some(option);
        let samples = of_samples.into_iter().filter(|_| !integrator.takes_samples()).filter_map(given);
        let whitted = of_whitted.into_iter().filter(|_| *integrator != Integrator::Whitted).filter_map(given);
        let is_path = matches!(integrator, Integrator::Path(_));
        let path = of_path.into_iter().filter(|_| !is_path).filter_map(given);
        samples.chain(whitted).chain(path).collect()
    }
}

/// An integrator as an option gives it.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Choice {
    integrator: Integrator,
    /// So many of its numbers were given.
    given: usize,
}

impl Choice {
    /// What it makes of the file's: of a path tracer, what is not given stays as it is.
    fn after(self, file: &Integrator) -> Integrator {
        match (self.integrator, *file) {
            (Integrator::Path(PathSettings { max_depth, clamp, .. }), Integrator::Path(path)) => match self.given {
                0 => Integrator::Path(path),
                1 => Integrator::Path(PathSettings { max_depth, ..path }),
                _ => Integrator::Path(PathSettings { max_depth, clamp, ..path }),
            },
            (chosen, _) => chosen,
        }
    }
}

fn choice(text: &str) -> Result<Choice, String> {
    let given = text.split_once(':').map_or(0, |(_, numbers)| numbers.split(',').count());
    Ok(Choice { integrator: integrator(text)?, given })
}

fn integrator(text: &str) -> Result<Integrator, String> {
    let wrong = || {
        "expected `whitted`, `path[:DEPTH[,CLAMP]]`, `ambient_occlusion[:DISTANCE]`, `normals`, `depth` or `uv`"
            .to_owned()
    };
    let (word, numbers) = match text.split_once(':') {
        Some((word, numbers)) => (word, numbers.split(',').collect::<Vec<_>>()),
        None => (text, Vec::new()),
    };
    match (word, &numbers[..]) {
        ("whitted", []) => Ok(Integrator::Whitted),
        ("path", []) => Ok(Integrator::PATH),
        ("path", [depth]) => {
            let max_depth = depth.parse().map_err(|_| wrong())?;
            Ok(Integrator::Path(PathSettings { max_depth, ..Default::default() }))
        }
        ("path", [depth, clamp]) => {
            let max_depth = depth.parse().map_err(|_| wrong())?;
            let clamp = Some(clamp.parse().map_err(|_| wrong())?);
            Ok(Integrator::Path(PathSettings { max_depth, clamp, ..Default::default() }))
        }
        ("ambient_occlusion" | "ambient-occlusion", []) => Ok(Integrator::AmbientOcclusion { distance: None }),
        ("ambient_occlusion" | "ambient-occlusion", [distance]) => {
            Ok(Integrator::AmbientOcclusion { distance: Some(distance.parse().map_err(|_| wrong())?) })
        }
        ("normals", []) => Ok(Integrator::Normals),
        ("depth", []) => Ok(Integrator::Depth),
        ("uv", []) => Ok(Integrator::Uv),
        _ => Err(wrong()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_given_of_a_path_tracer_stays() {
        let file = PathSettings { max_depth: 3, clamp: Some(2.0), split: 2, reuse: 16 };
        let after = |word: &str, file| choice(word).map(|choice| choice.after(&file));
        assert_eq!(after("path", Integrator::Path(file)), Ok(Integrator::Path(file)));
        let deeper = PathSettings { max_depth: 8, ..file };
        assert_eq!(after("path:8", Integrator::Path(file)), Ok(Integrator::Path(deeper)));
        let brighter = PathSettings { clamp: Some(5.0), ..deeper };
        assert_eq!(after("path:8,5", Integrator::Path(file)), Ok(Integrator::Path(brighter)));
        assert_eq!(after("whitted", Integrator::Path(file)), Ok(Integrator::Whitted));
        assert_eq!(after("path", Integrator::Whitted), Ok(Integrator::PATH));
    }

    #[test]
    fn integrators_are_read_as_scene_files_have_them() {
        let of = |word: &str| {
            let text = format!("render: {{integrator: {word}}}");
            let loaded = durer::load_str(&text, "test", &durer::NoAssets, &durer::Limits::default());
            loaded.expect("fine").scene.scene().render.integrator
        };
        for word in ["whitted", "path", "ambient_occlusion", "normals", "depth", "uv"] {
            assert_eq!(Ok(of(word)), integrator(word));
        }
        let path = PathSettings { max_depth: 32, ..Default::default() };
        assert_eq!(integrator("path:32"), Ok(Integrator::Path(path)));
        assert_eq!(integrator("path:32,10"), Ok(Integrator::Path(PathSettings { clamp: Some(10.0), ..path })));
        let near = Integrator::AmbientOcclusion { distance: Some(0.5) };
        assert_eq!(integrator("ambient_occlusion:0.5"), Ok(near));
        for wrong in ["", "paths", "path:", "path:x", "path:1,2,3", "uv:1", "whitted:3"] {
            assert!(integrator(wrong).is_err(), "{wrong}");
        }
    }
}

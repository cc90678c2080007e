//! Settings of the scene that the command line may change: they are laid over those of the file before it is checked.

mod light;

use crate::exit::Failure;
use crate::load::SceneArgs;
use crate::output;
use crate::progress::Show;
use clap::{Args, ValueEnum};
use durer::imaging::Transfer;
use durer::scene::{Antialias, Integrator, Picture, PixelFilter, Place, RenderSettings, Step, Trees};
use durer::{Loaded, Overlay};
use light::Light;

/// Settings that win over those of the scene file.
#[derive(Args, Debug, Default)]
#[command(next_help_heading = "Instead of what the scene says")]
pub(crate) struct Overrides {
    #[command(flatten)]
    size: Size,

    #[command(flatten)]
    light: Light,

    /// Longest chain of rays, from 1 (the eye's rays alone) to 100; with `path` the most surfaces that light may meet, up to
    /// 1000000
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    max_depth: Option<u32>,

    /// Rays in a pixel: `adaptive[:THRESHOLD[,DEPTH]]`, `none`, `grid:N` (N × N), `recursive[:THRESHOLD[,DEPTH]]`, or as
    /// POV-Ray does, `pov1[:THRESHOLD[,DEPTH]]` and `pov2[:THRESHOLD[,DEPTH]]`
    #[arg(long, value_name = "HOW", value_parser = antialias, allow_hyphen_values = true)]
    antialias: Option<Antialias>,

    /// How samples are weighed around the middle of a pixel: `box`, `tent`, `gaussian`, `mitchell` or `blackman_harris`,
    /// with `:RADIUS` in pixels
    #[arg(long, value_name = "HOW", value_parser = filter, allow_hyphen_values = true)]
    filter: Option<PixelFilter>,

    /// What the trees in which rays search are built for; the picture is the same
    #[arg(long, value_name = "PURPOSE")]
    trees: Option<TreesArg>,

    /// How light becomes the numbers of a PNG or JPEG
    #[arg(long, value_name = "CURVE")]
    transfer: Option<TransferArg>,
}

/// The size of the picture, in place of what the scene says.
#[derive(Args, Clone, Copy, Debug, Default)]
#[command(next_help_heading = "Instead of what the scene says")]
pub(crate) struct Size {
    /// Width in pixels, at most 65535; without --height the shape of the picture is kept
    #[arg(long, value_name = "PIXELS", allow_negative_numbers = true)]
    width: Option<u32>,

    /// Height in pixels, at most 65535; without --width the shape of the picture is kept
    #[arg(long, value_name = "PIXELS", allow_negative_numbers = true)]
    height: Option<u32>,
}

/// [`Transfer`] by its words in scene files.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum TransferArg {
    /// Encoded for screens
    Srgb,
    /// The numbers as they are
    Linear,
}

/// [`Trees`] by its words in scene files.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum TreesArg {
    /// A first look: built in the least time
    Preview,
    /// A picture with some rays a pixel
    Picture,
    /// Very many rays: built for the fastest search
    #[value(name = "many_rays", alias = "many-rays")]
    ManyRays,
}

impl Overlay for Overrides {
    fn lay_over(&self, picture: &mut Picture, render: &mut RenderSettings) {
        (picture.width, picture.height) = self.size.of(picture);
        self.light.change_render(render);
        self.light.change_picture(picture);
        match &mut render.integrator {
            Integrator::Path(path) => path.max_depth = self.max_depth.unwrap_or(path.max_depth),
            Integrator::Whitted
            | Integrator::AmbientOcclusion { .. }
            | Integrator::Normals
            | Integrator::Depth
            | Integrator::Uv => render.max_depth = self.max_depth.unwrap_or(render.max_depth),
        }
        render.antialias = self.antialias.unwrap_or(render.antialias);
        render.filter = self.filter.unwrap_or(render.filter);
        render.trees = match self.trees {
            Some(TreesArg::Preview) => Trees::Preview,
            Some(TreesArg::Picture) => Trees::Picture,
            Some(TreesArg::ManyRays) => Trees::ManyRays,
            None => render.trees,
        };
        picture.transfer = match self.transfer {
            Some(TransferArg::Srgb) => Transfer::Srgb,
            Some(TransferArg::Linear) => Transfer::Linear,
            None => picture.transfer,
        };
    }

    fn name_of(&self, place: &Place, render: &RenderSettings) -> Option<String> {
        let field = |at: usize| match place.steps.get(at) {
            Some(Step::Field(name)) => *name,
            Some(Step::Index(_) | Step::Material(_) | Step::Texture(_) | Step::Image(_)) | None => "",
        };
        let is_path = matches!(render.integrator, Integrator::Path { .. });
        let option = match (field(0), field(1)) {
            ("picture", at) => self.size.name_of(at).or_else(|| self.light.name_of(at)),
            ("render", "max_depth") => self.max_depth.filter(|_| !is_path).map(|_| "--max-depth"),
            ("render", "integrator") if field(3) == "max_depth" && self.max_depth.is_some() => Some("--max-depth"),
            ("render", "integrator") if !field(3).is_empty() => self.light.name_of_part(field(3)),
            ("render", "antialias") => self.antialias.map(|_| "--antialias"),
            ("render", "filter") => self.filter.map(|_| "--filter"),
            ("render", at) => self.light.name_of(at),
            _ => None,
        };
        option.map(str::to_owned)
    }
}

impl Overrides {
    /// Loads the scene with these settings in place of its own. Prints warnings, or what is wrong.
    pub(crate) fn load(&self, scene: &SceneArgs, show: Show) -> Result<Loaded, Failure> {
        let loaded = scene.load_under(self, show)?;
        self.tell_meaningless(&loaded.scene.scene().render.integrator);
        Ok(loaded)
    }

    /// Warns of options that change nothing.
    fn tell_meaningless(&self, integrator: &Integrator) {
        let mut options = self.light.meaningless_to(integrator);
        let shows_middles = matches!(integrator, Integrator::Uv);
        if self.antialias.is_some() && (integrator.takes_samples() || shows_middles) {
            options.push("--antialias");
        }
        if self.filter.is_some() && shows_middles {
            options.push("--filter");
        }
        if self.max_depth.is_some() && !matches!(integrator, Integrator::Path { .. } | Integrator::Whitted) {
            options.push("--max-depth");
        }
        for option in options {
            output::warning(&format!("{option} means nothing to `{}`, and is not followed", integrator.word()));
        }
    }
}

impl Size {
    fn of(&self, picture: &Picture) -> (u32, u32) {
        let scaled = |length: u32, by: u32, of: u32| {
            // A picture without any length has no shape to keep; the check says so of what is 0.
            if length == 0 || of == 0 {
                return length;
            }
            let rounded = (u64::from(length) * u64::from(by) + u64::from(of) / 2) / u64::from(of);
            u32::try_from(rounded).unwrap_or(u32::MAX).max(1)
        };
        match (self.width, self.height) {
            (Some(width), Some(height)) => (width, height),
            (Some(width), None) => (width, scaled(picture.height, width, picture.width)),
            (None, Some(height)) => (scaled(picture.width, height, picture.height), height),
            (None, None) => (picture.width, picture.height),
        }
    }

    /// What gives this field of the picture, or the picture as a whole if there is none; `None` if the file does.
    fn name_of(&self, field: &str) -> Option<&'static str> {
        match (field, self.width, self.height) {
            ("width", Some(_), _) => Some("--width"),
            ("width", None, Some(_)) => Some("--height, from which the width follows"),
            ("height", _, Some(_)) => Some("--height"),
            ("height", Some(_), None) => Some("--width, from which the height follows"),
            ("", Some(_), Some(_)) => Some("--width and --height"),
            ("", Some(_), None) => Some("--width"),
            ("", None, Some(_)) => Some("--height"),
            _ => None,
        }
    }
}

const ANTIALIAS: &str = "`adaptive[:THRESHOLD[,DEPTH]]`, `none`, `grid:N`, `recursive[:THRESHOLD[,DEPTH]]`, \
    `pov1[:THRESHOLD[,DEPTH]]` or `pov2[:THRESHOLD[,DEPTH]]`";

fn antialias(text: &str) -> Result<Antialias, String> {
    let wrong = || format!("expected {ANTIALIAS}");
    let (kind, numbers) = match text.split_once(':') {
        Some((kind, numbers)) => (kind, Some(numbers)),
        None => (text, None),
    };
    // What scene files take where these are not given.
    let two = |threshold, depth| two_numbers(numbers, (threshold, depth)).ok_or_else(wrong);
    match (kind, numbers) {
        ("none", None) => Ok(Antialias::None),
        ("grid", Some(n)) => Ok(Antialias::Grid { n: n.parse().map_err(|_| wrong())? }),
        ("adaptive", _) => two(0.03, 4).map(|(threshold, max_depth)| Antialias::Adaptive { threshold, max_depth }),
        ("recursive", _) => two(0.3, 5).map(|(threshold, max_depth)| Antialias::Recursive { threshold, max_depth }),
        ("pov1", _) => two(0.3, 3).map(|(threshold, depth)| Antialias::Pov1 { threshold, depth }),
        ("pov2", _) => two(0.3, 3).map(|(threshold, depth)| Antialias::Pov2 { threshold, depth }),
        _ => Err(wrong()),
    }
}

fn two_numbers(numbers: Option<&str>, (threshold, depth): (f32, u32)) -> Option<(f32, u32)> {
    let mut numbers = numbers.into_iter().flat_map(|numbers| numbers.split(','));
    let threshold = numbers.next().map_or(Some(threshold), |text| text.parse().ok())?;
    let depth = numbers.next().map_or(Some(depth), |text| text.parse().ok())?;
    numbers.next().is_none().then_some((threshold, depth))
}

fn filter(text: &str) -> Result<PixelFilter, String> {
    let wrong = || {
        "expected `box`, `tent[:RADIUS]`, `gaussian[:RADIUS[,SIGMA]]`, `mitchell[:RADIUS]` or `blackman_harris[:RADIUS]`"
            .to_owned()
    };
    let (kind, numbers) = match text.split_once(':') {
        Some((kind, numbers)) => (kind, numbers.split(',').map(str::parse).collect::<Result<Vec<f64>, _>>()),
        None => (text, Ok(Vec::new())),
    };
    let numbers = numbers.map_err(|_| wrong())?;
    // What scene files take where a radius is not given.
    match (kind, &numbers[..]) {
        ("box", []) => Ok(PixelFilter::Box),
        ("tent", []) => Ok(PixelFilter::Tent { radius: 1.0 }),
        ("tent", &[radius]) => Ok(PixelFilter::Tent { radius }),
        ("gaussian", []) => Ok(PixelFilter::Gaussian { radius: 1.5, sigma: 0.5 }),
        // The bell keeps its form, whatever its radius.
        ("gaussian", &[radius]) => Ok(PixelFilter::Gaussian { radius, sigma: radius / 3.0 }),
        ("gaussian", &[radius, sigma]) => Ok(PixelFilter::Gaussian { radius, sigma }),
        ("mitchell", []) => Ok(PixelFilter::Mitchell { radius: 2.0 }),
        ("mitchell", &[radius]) => Ok(PixelFilter::Mitchell { radius }),
        ("blackman_harris" | "blackman-harris", []) => Ok(PixelFilter::BlackmanHarris { radius: 1.5 }),
        ("blackman_harris" | "blackman-harris", &[radius]) => Ok(PixelFilter::BlackmanHarris { radius }),
        _ => Err(wrong()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn antialias_is_read() {
        let recursive = |threshold, max_depth| Ok(Antialias::Recursive { threshold, max_depth });
        assert_eq!(antialias("none"), Ok(Antialias::None));
        assert_eq!(antialias("grid:4"), Ok(Antialias::Grid { n: 4 }));
        assert_eq!(antialias("recursive"), recursive(0.3, 5));
        assert_eq!(antialias("recursive:0.1"), recursive(0.1, 5));
        assert_eq!(antialias("recursive:0.1,2"), recursive(0.1, 2));
        assert_eq!(antialias("adaptive"), Ok(Antialias::ADAPTIVE));
        assert_eq!(antialias("pov2:0.1,5"), Ok(Antialias::Pov2 { threshold: 0.1, depth: 5 }));
        for wrong in ["", "grid", "grid:x", "none:1", "recursive:", "recursive:1,2,3", "recursive:,2", "4"] {
            assert!(antialias(wrong).is_err(), "{wrong}");
        }
    }

    /// What is left out is what scene files take.
    #[test]
    fn settings_left_out_are_those_of_scene_files() {
        let of = |settings: &str| {
            let text = format!("render: {{{settings}}}");
            let loaded = durer::load_str(&text, "test", &durer::NoAssets, &durer::Limits::default());
            let render = loaded.expect("fine").scene.scene().render;
            (render.antialias, render.filter)
        };
        for word in ["adaptive", "recursive", "pov1", "pov2"] {
            assert_eq!(Ok(of(&format!("antialias: {word}")).0), antialias(word));
        }
        for word in ["box", "tent", "gaussian", "mitchell", "blackman_harris"] {
            assert_eq!(Ok(of(&format!("filter: {word}")).1), filter(word));
        }
        assert_eq!(filter("tent:2"), Ok(PixelFilter::Tent { radius: 2.0 }));
        for wrong in ["", "tent:", "box:1", "gauss", "tent:x", "tent:1,2", "gaussian:1,2,3"] {
            assert!(filter(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn one_length_keeps_the_shape() {
        let size = |width, height| Size { width, height }.of(&Picture::default());
        assert_eq!(size(None, None), (640, 480));
        assert_eq!(size(Some(320), None), (320, 240));
        assert_eq!(size(None, Some(96)), (128, 96));
        assert_eq!(size(Some(7), Some(9)), (7, 9));
        assert_eq!(size(Some(1), None), (1, 1));
        assert_eq!(size(None, Some(u32::MAX)), (u32::MAX, u32::MAX));
        // Nothing is made up for a side that a file gives as 0.
        let flat = Picture { width: 0, ..Picture::default() };
        assert_eq!(Size { width: None, height: Some(96) }.of(&flat), (0, 96));
        assert_eq!(Size { width: Some(96), height: None }.of(&flat), (96, 480));
    }
}

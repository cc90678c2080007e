//! `durer compare`: how two pictures differ.

use crate::exit::{Exit, Failure};
use crate::numbers::short;
use crate::{output, target};
use clap::Args;
use durer::imaging::{self, DecodeLimits, Difference, Image, Transfer, false_color};
use durer::{PictureFile, read_picture};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "\
Examples:
  durer compare before.png after.png
  durer compare before.png after.png --threshold 0.01 --diff difference.png

Pictures are compared as a screen shows them: clamped to black and white, sRGB-encoded,
numbers from 0 to 1. FLIP is the difference that the eye sees when it flips between the
two (Andersson et al. 2020).

Exit codes:
    0  the mean FLIP error is not above the threshold; with threshold 0, no pixel differs
    1  it is, or a pixel differs
    2  the pictures differ in size, or the command line is wrong
    4  a picture cannot be read or written";

/// Say how two pictures differ
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// One picture: PNG, JPEG, EXR, HDR or PFM
    a: PathBuf,

    /// The other one, of the same size
    b: PathBuf,

    /// Largest mean FLIP error that still counts as equal, from 0 (no pixel may differ) to 1
    #[arg(long, value_name = "X", default_value_t = 0.0, value_parser = threshold, allow_negative_numbers = true)]
    threshold: f64,

    /// Write the FLIP error of each pixel as a picture, from black (none) to pale yellow (1)
    #[arg(long, value_name = "FILE")]
    diff: Option<PathBuf>,

    /// Print the numbers as JSON
    #[arg(long)]
    json: bool,
}

fn threshold(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(value) if (0.0..=1.0).contains(&value) => Ok(value),
        Ok(_) | Err(_) => Err("expected a number from 0 to 1".to_owned()),
    }
}

/// Compares the pictures.
pub(crate) fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    let Arguments { a, b, diff, .. } = arguments;
    let format = diff.as_deref().map(target::format_of).transpose()?;
    let (a, b) = (read(a)?, read(b)?);
    let difference = imaging::compare(&a, &b).map_err(|error| Failure::usage(error.to_string()))?;
    if let (Some(path), Some(format)) = (diff, format) {
        PictureFile::create(path)?.write(&false_color(&difference.flip), &target::usual(format))?;
    }
    let within = is_within(&difference, arguments.threshold);
    match arguments.json {
        true => output::print_json(&json(&difference, arguments.threshold, within))?,
        false => output::print(&text(&difference, arguments.threshold, within))?,
    }
    Ok(if within { Exit::Fine } else { Exit::Different })
}

fn read(path: &Path) -> Result<Image, Failure> {
    target::is_picture(path)?;
    Ok(read_picture(path, &DecodeLimits::default())?.to_image(Transfer::Srgb))
}

fn is_within(difference: &Difference, threshold: f64) -> bool {
    difference.flip_mean <= threshold && (threshold > 0.0 || difference.differing_share == 0.0)
}

fn text(difference: &Difference, threshold: f64, within: bool) -> String {
    let Difference { max, max_at: (x, y), mean, rms, differing_share, flip_mean, .. } = difference;
    let verdict = match (within, threshold == 0.0) {
        (true, true) => "equal".to_owned(),
        (false, true) => "different".to_owned(),
        (true, false) => format!("within the threshold of {}", short(threshold)),
        (false, false) => format!("beyond the threshold of {}", short(threshold)),
    };
    let place = if *max > 0.0 { format!(" (of 255: {}) in pixel {x},{y}", short(max * 255.0)) } else { String::new() };
    format!(
        "maximum     {}{place}\nmean        {}\nRMS         {}\nFLIP mean   {}\ndiffering   {} % of the pixels\n{verdict}\n",
        short(*max),
        short(*mean),
        short(*rms),
        short(*flip_mean),
        short(differing_share * 100.0),
    )
}

fn json(difference: &Difference, threshold: f64, within: bool) -> Value {
    let Difference { max, max_at: (x, y), mean, rms, differing_share, flip_mean, .. } = difference;
    json!({
        "max": max,
        "max_at": [x, y],
        "mean": mean,
        "rms": rms,
        "flip_mean": flip_mean,
        "differing_share": differing_share,
        "threshold": threshold,
        "within": within,
    })
}

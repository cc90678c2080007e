//! The picture file that is to be written: its format, by the extension of its name, and the options of that format.

use crate::exit::Failure;
use crate::provenance;
use clap::{Args, ValueEnum};
use durer::imaging::{EncodeOptions, ExrSamples, FileFormat, PngDepth};
use std::path::Path;

/// Options of picture files.
#[derive(Args, Debug)]
#[command(next_help_heading = "The file")]
pub(crate) struct FileOptions {
    /// Bits of a component: 8 or 16 in PNG [default: 8], half or float in EXR [default: half]
    #[arg(long, value_name = "BITS")]
    bit_depth: Option<BitDepth>,

    /// Quality of JPEG, from 1 to 100 [default: 92]
    #[arg(long, value_name = "1-100", value_parser = clap::value_parser!(u8).range(1..=100), allow_negative_numbers = true)]
    quality: Option<u8>,
}

/// Precision of files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum BitDepth {
    /// 8 bits (PNG)
    #[value(name = "8")]
    Eight,
    /// 16 bits (PNG)
    #[value(name = "16")]
    Sixteen,
    /// Half-precision floating point (EXR)
    Half,
    /// Single-precision floating point (EXR)
    Float,
}

/// The format that a file's name stands for.
pub(crate) fn format_of(path: &Path) -> Result<FileFormat, Failure> {
    if path == Path::new("-") {
        return Err(Failure::usage("pictures cannot be written to standard output: give a file name in place of `-`"));
    }
    FileFormat::from_path(path).map_err(|error| Failure::usage(format!("{}: {error}", path.display())))
}

/// As [`format_of`], where a film could be written, too: messages name that.
pub(crate) fn format_or_film(path: &Path) -> Result<Option<FileFormat>, Failure> {
    if is_film(path) {
        return Ok(None);
    }
    let with_film = |failure| match failure {
        Failure::Message(exit, message) => {
            let known = "png, jpg, exr, hdr and pfm";
            Failure::Message(exit, message.replace(known, &format!("{known}, and film for `durer merge`")))
        }
        other @ (Failure::Told(_) | Failure::Arguments(_)) => other,
    };
    format_of(path).map(Some).map_err(with_film)
}

/// Fails if a file that is to be read as a picture holds a film, and says how to make a picture of it.
pub(crate) fn is_picture(path: &Path) -> Result<(), Failure> {
    if !crate::commands::info::film::is_one(path) {
        return Ok(());
    }
    let path = path.display();
    Err(Failure::file(format!(
        "{path} holds sums of samples, not a picture: make one of it with `durer merge {path} -o picture.exr`"
    )))
}

/// True if a file is to hold a film, with all that it takes to add samples to it: `part.film`.
pub(crate) fn is_film(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("film"))
}

/// The usual options of a format, and the name of the program.
pub(crate) fn usual(format: FileFormat) -> EncodeOptions {
    EncodeOptions { metadata: vec![provenance::software()], ..EncodeOptions::new(format) }
}

impl FileOptions {
    /// Fails if there is any option, for a file that is no picture.
    pub(crate) fn of_no_picture(&self) -> Result<(), Failure> {
        let option = self.bit_depth.map(|_| "--bit-depth").or(self.quality.map(|_| "--quality"));
        option.map_or(Ok(()), |option| Err(Failure::usage(format!("{option}: a film file has no such option"))))
    }

    /// How to encode in `format`; fails if an option belongs to another one.
    pub(crate) fn encode_options(&self, format: FileFormat) -> Result<EncodeOptions, Failure> {
        let mut options = usual(format);
        match (self.bit_depth, format) {
            (None, _) | (Some(BitDepth::Eight), FileFormat::Png | FileFormat::Jpeg) => {}
            (Some(BitDepth::Sixteen), FileFormat::Png) => options.png_depth = PngDepth::Sixteen,
            (Some(BitDepth::Half), FileFormat::Exr) => options.exr_samples = ExrSamples::Half,
            (Some(BitDepth::Float), FileFormat::Exr) => options.exr_samples = ExrSamples::Float,
            (Some(BitDepth::Float), FileFormat::Pfm) => {}
            (Some(_), FileFormat::Png | FileFormat::Jpeg | FileFormat::Exr | FileFormat::Hdr | FileFormat::Pfm) => {
                return Err(Failure::usage(bit_depth_message(format)));
            }
        }
        match (self.quality, format) {
            (None, _) => {}
            (Some(quality), FileFormat::Jpeg) => options.jpeg_quality = quality,
            (Some(_), FileFormat::Png) => return Err(Failure::usage("--quality is for JPEG; PNG is lossless")),
            (Some(_), FileFormat::Exr | FileFormat::Hdr | FileFormat::Pfm) => {
                return Err(Failure::usage(format!("--quality is for JPEG; {} has no such choice", format.name())));
            }
        }
        Ok(options)
    }
}

fn bit_depth_message(format: FileFormat) -> String {
    let known = match format {
        FileFormat::Png => "8 or 16",
        FileFormat::Jpeg => "8",
        FileFormat::Exr => "half or float",
        FileFormat::Hdr => "no choice",
        FileFormat::Pfm => "float",
    };
    format!("--bit-depth: {} has {known}", format.name())
}

/// True if two paths, of files that need not be there, lead to the same place.
pub(crate) fn same_place(a: &Path, b: &Path) -> bool {
    let folder = |path: &Path| {
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        folder.canonicalize().unwrap_or_else(|_| folder.to_owned())
    };
    a.file_name() == b.file_name() && folder(a) == folder(b)
}

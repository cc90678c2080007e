//! What a glTF file refers to by URI: data in the URI itself, or a file beside it.

use super::super::{ModelError, beside};
use super::value::Place;
use crate::native::tree::shorten;
use crate::{Assets, Limits};
use base64::Engine;
use base64::alphabet::STANDARD;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use std::cell::Cell;

/// Lenient where it does no harm: with or without padding.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &STANDARD,
    GeneralPurposeConfig::new()
        .with_decode_padding_mode(DecodePaddingMode::Indifferent)
        .with_decode_allow_trailing_bits(true),
);

/// The files that one glTF file refers to.
pub(super) struct Files<'a> {
    assets: &'a dyn Assets,
    /// The glTF file, as the scene says it.
    file: &'a str,
    /// How many more bytes all of them together may have.
    left: Cell<u64>,
}

impl<'a> Files<'a> {
    /// Those of the glTF file that the scene calls `file`.
    pub(super) fn of(file: &'a str, assets: &'a dyn Assets, limits: &Limits) -> Files<'a> {
        Files { assets, file, left: Cell::new(limits.max_total_bytes) }
    }

    /// The name by which the scene would call the file of a relative URI.
    pub(super) fn path(&self, uri: &str, place: Place) -> Result<String, ModelError> {
        let start = uri.split(['/', '?', '#']).next().unwrap_or_default();
        // One letter is a drive.
        if let Some((scheme, _)) = start.split_once(':').filter(|(scheme, _)| scheme.len() > 1) {
            let fault = place.fault(format!("`{}:` addresses are not followed", shorten(scheme)));
            return Err(fault.help("save what it leads to beside this file, and refer to that"));
        }
        match String::from_utf8(percent_decoded(uri.as_bytes())) {
            Ok(name) if !name.contains('\0') => Ok(beside(self.file, &name)),
            _ => Err(place.fault(format!("`{}` is not the name of a file", shorten(uri)))),
        }
    }

    /// The bytes that a URI stands for, at most `most` of them.
    pub(super) fn read(&self, uri: &str, most: u64, place: Place) -> Result<Vec<u8>, ModelError> {
        let bytes = match uri.get(..5) {
            Some(scheme) if scheme.eq_ignore_ascii_case("data:") => inline(&uri[5..], place)?,
            _ => self.read_file(&self.path(uri, place)?, most.min(self.left.get()), place)?,
        };
        self.left.set(self.left.get().saturating_sub(bytes.len() as u64));
        Ok(bytes)
    }

    fn read_file(&self, path: &str, most: u64, place: Place) -> Result<Vec<u8>, ModelError> {
        self.assets.read(path, most).map_err(|error| {
            let fault = place.fault(format!("cannot read `{}`: {error}", shorten(path)));
            ModelError { help: error.help(), ..fault }
        })
    }
}

/// The bytes of a data URI without its `data:`.
fn inline(uri: &str, place: Place) -> Result<Vec<u8>, ModelError> {
    let (kind, data) = uri.split_once(',').ok_or_else(|| place.fault("this data URI has no comma"))?;
    if !kind.to_ascii_lowercase().ends_with(";base64") {
        return Ok(percent_decoded(data.as_bytes()));
    }
    BASE64.decode(data).map_err(|error| place.fault(format!("this is not base64: {error}")))
}

/// `%41` becomes `A`; a percent sign that is not followed by two digits stays.
fn percent_decoded(text: &[u8]) -> Vec<u8> {
    let digit = |byte: u8| char::from(byte).to_digit(16);
    let mut decoded = Vec::with_capacity(text.len());
    let mut rest = text;
    while let Some((&first, after)) = rest.split_first() {
        rest = after;
        decoded.push(first);
        if first == b'%'
            && let [high, low, after @ ..] = after
            && let (Some(high), Some(low)) = (digit(*high), digit(*low))
        {
            decoded.pop();
            decoded.push((high * 16 + low) as u8);
            rest = after;
        }
    }
    decoded
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::NoAssets;

    #[test]
    fn percent_signs_are_decoded_once() {
        assert_eq!(percent_decoded(b"a%20b%2525%zz%4"), b"a b%25%zz%4");
    }

    #[test]
    fn paths_are_relative_to_the_file() {
        let files = |file| Files::of(file, &NoAssets, &Limits::default());
        let path = |file, uri| files(file).path(uri, Place::default()).map_err(|fault| fault.message);
        assert_eq!(path("models/a.gltf", "b%20c.bin").unwrap(), "models/b c.bin");
        assert_eq!(path("a.gltf", "textures/b:1.png").unwrap(), "textures/b:1.png");
        assert_eq!(path("a.gltf", "https://example.org/b.bin").unwrap_err(), "`https:` addresses are not followed");
        assert!(path("a.gltf", "%ff").unwrap_err().contains("not the name of a file"));
        assert!(path("a.gltf", "a%00b").unwrap_err().contains("not the name of a file"));
    }

    #[test]
    fn data_uris_are_decoded() {
        let files = Files::of("a.gltf", &NoAssets, &Limits::default());
        let read = |uri| files.read(uri, 0, Place::default()).map_err(|fault| fault.message);
        assert_eq!(read("data:application/octet-stream;base64,AAEC").unwrap(), [0, 1, 2]);
        assert_eq!(read("DATA:;base64,AAECAw").unwrap(), [0, 1, 2, 3]);
        assert_eq!(read("data:,a%00b").unwrap(), b"a\0b");
        assert!(read("data:;base64,A*==").unwrap_err().contains("not base64"));
        assert!(read("data:nothing").unwrap_err().contains("no comma"));
        assert!(read("file.bin").unwrap_err().contains("cannot read `file.bin`"));
    }
}

//! The lines of a material library.

use super::super::text::{Cursor, shown};
use super::super::warnings::Warnings;
use durer_math::Rgb;
use std::collections::BTreeMap;

/// A material as its library describes it.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Entry {
    /// `Kd`.
    pub(super) diffuse: Option<Rgb>,
    /// `Ka`.
    pub(super) ambient: Option<Rgb>,
    /// `Ks`.
    pub(super) specular: Option<Rgb>,
    /// `Ke`.
    pub(super) emission: Option<Rgb>,
    /// `Tf`, the color that transparent surfaces give to what is behind them.
    pub(super) filter: Option<Rgb>,
    /// `Ns`.
    pub(super) shininess: Option<f64>,
    /// `d`, which also stands for dissolve.
    pub(super) opacity: Option<f64>,
    /// `Tr`, which is 1 less `d`.
    pub(super) transparency: Option<f64>,
    /// `Ni`.
    pub(super) refraction_index: Option<f64>,
    /// `illum`, the number of the illumination model.
    pub(super) illumination: Option<u32>,
    /// `map_Kd`.
    pub(super) color_map: Option<Map>,
    /// `map_d`.
    pub(super) opacity_map: Option<Map>,
}

/// An image, and how it lies on the surface.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Map {
    pub(super) file: String,
    /// `-o`.
    pub(super) offset: [f64; 2],
    /// `-s`; neither is 0.
    pub(super) scale: [f64; 2],
    /// `-clamp on`.
    pub(super) is_clamped: bool,
}

/// Adds the materials of a library to those that are known; a name that comes again is a new material.
pub(super) fn parse(bytes: &[u8], entries: &mut BTreeMap<String, Entry>, warnings: &mut Warnings) {
    let mut cursor = Cursor::of_lines(bytes);
    let mut current: Option<(String, Entry)> = None;
    loop {
        let word = cursor.word();
        if word == b"newmtl" {
            entries.extend(current.take());
            current = Some((cursor.rest_of_line().into_owned(), Entry::default()));
        } else if let Some((_, entry)) = &mut current {
            statement(entry, word, &mut cursor, warnings);
        } else if !word.is_empty() {
            warnings.add("a material library says something before its first `newmtl`; it is left out");
        }
        if !cursor.next_line() {
            break;
        }
    }
    entries.extend(current);
}

fn statement(entry: &mut Entry, word: &[u8], cursor: &mut Cursor<'_>, warnings: &mut Warnings) {
    // Programs do not agree on capitals, but no two words differ only in them.
    let lower = word.to_ascii_lowercase();
    match lower.as_slice() {
        // Sharpness is that of reflections of images.
        b"" | b"sharpness" => {}
        b"kd" => read(&mut entry.diffuse, color(cursor), word, warnings),
        b"ka" => read(&mut entry.ambient, color(cursor), word, warnings),
        b"ks" => read(&mut entry.specular, color(cursor), word, warnings),
        b"ke" => read(&mut entry.emission, color(cursor), word, warnings),
        b"tf" => read(&mut entry.filter, color(cursor), word, warnings),
        b"ns" => read(&mut entry.shininess, within(cursor, 1e6), word, warnings),
        b"d" => {
            if cursor.clone().word() == b"-halo" {
                cursor.word();
                warnings.add("`d -halo` of materials is taken for `d`");
            }
            read(&mut entry.opacity, within(cursor, 1.0), word, warnings);
        }
        b"tr" => read(&mut entry.transparency, within(cursor, 1.0), word, warnings),
        b"ni" => read(&mut entry.refraction_index, within(cursor, 100.0), word, warnings),
        b"illum" => {
            let model = within(cursor, 10.0).map(|model| model as u32);
            read(&mut entry.illumination, model, word, warnings);
        }
        b"map_kd" => read(&mut entry.color_map, map(cursor, warnings), word, warnings),
        b"map_d" => read(&mut entry.opacity_map, map(cursor, warnings), word, warnings),
        // Nearly always the image of the color once more; and ambient light takes the surface's color in any case.
        b"map_ka" => {}
        _ => warnings.add(format!("`{}` of materials is left out", shown(word))),
    }
}

fn read<T>(field: &mut Option<T>, value: Option<T>, word: &[u8], warnings: &mut Warnings) {
    match value {
        Some(value) => *field = Some(value),
        None => warnings.add(format!("a `{}` of a material is no usable number; it is left out", shown(word))),
    }
}

/// A number from 0 to `most`.
fn within(cursor: &mut Cursor<'_>, most: f64) -> Option<f64> {
    cursor.number().filter(|number| (0.0..=most).contains(number))
}

/// Three numbers, or one for all three. They are taken for linear light: the format does not say what they are, and
/// offline renderers agree on this.
fn color(cursor: &mut Cursor<'_>) -> Option<Rgb> {
    const MOST: f64 = 1e6;
    let red = within(cursor, MOST)? as f32;
    if cursor.clone().word().is_empty() {
        return Some(Rgb::gray(red));
    }
    Some(Rgb::new(red, within(cursor, MOST)? as f32, within(cursor, MOST)? as f32))
}

/// Options, and the name of a file, which may have blanks in it.
fn map(cursor: &mut Cursor<'_>, warnings: &mut Warnings) -> Option<Map> {
    let mut map = Map { file: String::new(), offset: [0.0; 2], scale: [1.0; 2], is_clamped: false };
    loop {
        let mut ahead = cursor.clone();
        let option = ahead.word().to_ascii_lowercase();
        match option.as_slice() {
            b"-o" => map.offset = up_to_three(&mut ahead).map(|x| x.filter(|x| x.abs() <= 1e6).unwrap_or(0.0)),
            b"-s" => {
                let usable = |x: &f64| (1e-6..=1e6).contains(&x.abs());
                map.scale = up_to_three(&mut ahead).map(|x| x.filter(usable).unwrap_or(1.0));
            }
            b"-t" => _ = up_to_three(&mut ahead),
            b"-clamp" => map.is_clamped = ahead.word().eq_ignore_ascii_case(b"on"),
            b"-mm" => _ = (ahead.number(), ahead.number()),
            b"-blendu" | b"-blendv" | b"-cc" | b"-bm" | b"-texres" | b"-imfchan" | b"-boost" | b"-type" => {
                ahead.word();
            }
            _ => break,
        }
        if !matches!(option.as_slice(), b"-o" | b"-s" | b"-clamp") {
            warnings.add(format!("`{}` of images is left out", shown(&option)));
        }
        *cursor = ahead;
    }
    map.file = cursor.rest_of_line().trim_matches('"').to_owned();
    (!map.file.is_empty()).then_some(map)
}

/// From one to three numbers; the third is for textures in space, which images are not.
fn up_to_three(cursor: &mut Cursor<'_>) -> [Option<f64>; 2] {
    let numbers = [cursor.number(), cursor.number(), cursor.number()];
    [numbers[0], numbers[1]]
}

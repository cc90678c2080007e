//! Tables of numbers in files: a row for each thing, a column for each of its numbers.
//!
//! Whatever the format, what comes out is a [`Table`]. Its columns keep the precision of the file, so that no file takes
//! more than a few times its size; cells that hold no usable number are wrong only if someone asks for their column.

mod csv;
mod elements;
mod npy;
mod number;
mod xyz;

use crate::models::{FilePlace, ModelError};
use crate::{Limits, models};
use durer_imaging::linear_from_srgb;
use durer_math::{DVec3, Rgb};
use std::borrow::Cow;
use std::sync::Arc;

/// The most columns of a table.
const MOST_COLUMNS: usize = 1000;

/// What a data file holds.
#[derive(Clone, Debug, Default)]
pub(crate) struct Table {
    /// The columns, all of one length.
    pub(crate) columns: Vec<Column>,
    /// True if the names of the columns are those of the file; otherwise they have none.
    pub(crate) has_names: bool,
    /// What was left out, one sentence each.
    pub(crate) warnings: Vec<String>,
}

/// One number of each thing.
#[derive(Clone, Debug)]
pub(crate) struct Column {
    /// Its name in the file, or nothing.
    pub(crate) name: String,
    /// The numbers.
    pub(crate) numbers: Numbers,
    /// The first cell that holds no usable number.
    pub(crate) unusable: Option<Unusable>,
}

/// Numbers in the precision of the file.
#[derive(Clone, Debug)]
pub(crate) enum Numbers {
    /// Double precision, and whole numbers of more than 8 bits.
    F64(Vec<f64>),
    /// Single precision.
    F32(Vec<f32>),
    /// Bytes.
    U8(Vec<u8>),
}

/// A cell of a text file that holds no usable number.
#[derive(Clone, Debug)]
pub(crate) struct Unusable {
    /// Its line, from 1.
    pub(crate) line: usize,
    /// What stands there.
    pub(crate) text: String,
}

/// The kinds of file, by the endings of their names.
pub(crate) const ENDINGS: [&str; 7] = ["npy", "csv", "tsv", "txt", "dat", "ply", "xyz"];

/// The ending that says the kind of a data file, if it is one.
pub(crate) fn ending(file: &str) -> Option<&'static str> {
    let (_, ending) = file.rsplit_once('.')?;
    ENDINGS.into_iter().find(|known| ending.eq_ignore_ascii_case(known))
}

/// Reads the table in `bytes`; the ending of `file` tells the format.
///
/// # Errors
///
/// The first thing that is wrong with it.
pub(crate) fn read(file: &str, bytes: &[u8], limits: &Limits) -> Result<Table, ModelError> {
    match ending(file) {
        Some("npy") => npy::read(bytes),
        Some("xyz") => xyz::read(bytes),
        Some("ply") => models::ply::table(bytes, limits),
        Some(_) => csv::read(bytes),
        None => Err(ModelError::new("the ending of its name tells nothing")
            .help("data files end in .npy, .csv, .tsv, .txt, .dat, .ply or .xyz")),
    }
}

/// An error in a line, counted from 1.
fn wrong_in_line(line: usize, message: impl Into<String>) -> ModelError {
    ModelError::new(message).at(FilePlace::Line(line))
}

#[cfg(test)]
impl Numbers {
    fn len(&self) -> usize {
        match self {
            Numbers::F64(numbers) => numbers.len(),
            Numbers::F32(numbers) => numbers.len(),
            Numbers::U8(numbers) => numbers.len(),
        }
    }
}

impl Column {
    /// A column of a binary file.
    pub(crate) fn new(name: impl Into<String>, numbers: Numbers) -> Column {
        Column { name: name.into(), numbers, unusable: None }
    }
}

impl Table {
    /// How many things it tells of.
    #[cfg(test)]
    pub(crate) fn rows(&self) -> usize {
        self.columns.first().map_or(0, |column| column.numbers.len())
    }

    /// The column of this name, in any case.
    pub(crate) fn named(&self, name: &str) -> Option<usize> {
        if !self.has_names {
            return None;
        }
        let exact = self.columns.iter().position(|column| column.name == name);
        exact.or_else(|| self.columns.iter().position(|column| column.name.eq_ignore_ascii_case(name)))
    }

    /// The column that a scene file calls `word`: by its name, or by its number from 1.
    pub(crate) fn column(&self, word: &str) -> Option<usize> {
        let by_number = || word.parse::<usize>().ok()?.checked_sub(1).filter(|at| *at < self.columns.len());
        self.named(word).or_else(by_number)
    }

    /// Points from three columns.
    pub(crate) fn points(&self, columns: [usize; 3]) -> Result<Arc<[DVec3]>, ModelError> {
        let [x, y, z] = columns.map(|at| self.numbers(at));
        let (x, y, z) = (x?, y?, z?);
        Ok(x.iter().zip(&*y).zip(&*z).map(|((&x, &y), &z)| DVec3::new(x, y, z)).collect())
    }

    /// Single numbers.
    pub(crate) fn sizes(&self, column: usize) -> Result<Arc<[f64]>, ModelError> {
        Ok(self.numbers(column)?.into())
    }

    /// Linear colours from three columns. Bytes, and whole numbers of which one is above 1, go from 0 to 255 and are sRGB;
    /// all others are linear.
    pub(crate) fn colors(&self, columns: [usize; 3]) -> Result<Arc<[Rgb]>, ModelError> {
        let [r, g, b] = columns.map(|at| self.numbers(at));
        let channels = [r?, g?, b?];
        let of_bytes = self.are_bytes(columns) || count_up_to_255(&channels);
        if !of_bytes {
            let [r, g, b] = &channels;
            let color = |((r, g), b): ((&f64, &f64), &f64)| Rgb::new(*r as f32, *g as f32, *b as f32);
            return Ok(r.iter().zip(&**g).zip(&**b).map(color).collect());
        }
        for (at, channel) in columns.into_iter().zip(&channels) {
            if let Some(row) = channel.iter().position(|number| !(0.0..=255.0).contains(number)) {
                let message = format!("{}, row {}: {} is no color", self.called(at), row + 1, channel[row]);
                return Err(ModelError::new(message).help("whole numbers in colors go from 0 to 255"));
            }
        }
        let linear: Vec<f32> = (0..=255_u8).map(|v| linear_from_srgb(f32::from(v) / 255.0)).collect();
        let [r, g, b] = channels.map(|channel| channel.iter().map(|&v| linear[v as usize]).collect::<Vec<f32>>());
        Ok(r.iter().zip(&g).zip(&b).map(|((&r, &g), &b)| Rgb::new(r, g, b)).collect())
    }

    fn are_bytes(&self, columns: [usize; 3]) -> bool {
        columns.iter().all(|at| matches!(self.columns[*at].numbers, Numbers::U8(_)))
    }

    /// The numbers of a column, if all of them are usable.
    fn numbers(&self, at: usize) -> Result<Cow<'_, [f64]>, ModelError> {
        let column = &self.columns[at];
        if let Some(Unusable { line, text }) = &column.unusable {
            let found = match text.as_str() {
                "" => "nothing stands here".to_owned(),
                text if number::parse(text.as_bytes()).is_some() => format!("`{text}` is not finite"),
                text => format!("`{text}` is not a number"),
            };
            let error = wrong_in_line(*line, format!("{}: {found}", self.called(at)));
            let with_point = text.replacen(',', ".", 1);
            return Err(match text.contains(',') && number::parse(with_point.as_bytes()).is_some() {
                true => error.help("decimals are written with a point"),
                false => error,
            });
        }
        let numbers: Cow<'_, [f64]> = match &column.numbers {
            Numbers::F64(numbers) => Cow::Borrowed(numbers),
            Numbers::F32(numbers) => numbers.iter().map(|v| f64::from(*v)).collect(),
            Numbers::U8(numbers) => numbers.iter().map(|v| f64::from(*v)).collect(),
        };
        match numbers.iter().position(|number| !number.is_finite()) {
            None => Ok(numbers),
            Some(row) => {
                Err(ModelError::new(format!("{}, row {}: {} is not finite", self.called(at), row + 1, numbers[row])))
            }
        }
    }

    /// What messages call a column.
    fn called(&self, at: usize) -> String {
        match self.has_names {
            true => format!("column {} (`{}`)", at + 1, self.columns[at].name),
            false => format!("column {}", at + 1),
        }
    }
}

/// True for whole numbers of which one is above 1, as no linear colour is.
fn count_up_to_255(channels: &[Cow<'_, [f64]>; 3]) -> bool {
    let mut numbers = channels.iter().flat_map(|channel| channel.iter());
    numbers.clone().all(|number| number.fract() == 0.0) && numbers.any(|number| *number > 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(text: &str) -> Table {
        csv::read(text.as_bytes()).unwrap()
    }

    fn message<T>(result: Result<T, ModelError>) -> String {
        let ModelError { message, place, help } = result.err().unwrap();
        format!("{place:?} {message} ({})", help.unwrap_or_default())
    }

    #[test]
    fn columns_are_found_by_name_in_any_case_or_by_number() {
        let named = table("x,X,2\n");
        assert_eq!(
            (named.has_names, named.column("X"), named.column("2"), named.column("0")),
            (false, None, Some(1), None)
        );
        let named = table("x,X,b\n1,2,3\n");
        assert_eq!(named.column("X"), Some(1));
        assert_eq!(named.column("B"), Some(2));
        assert_eq!(named.column("3"), Some(2));
        assert_eq!(named.column("4"), None);
    }

    #[test]
    fn fractions_are_linear_and_whole_numbers_are_srgb() {
        let colors = |text| table(text).colors([0, 1, 2]).unwrap().to_vec();
        assert_eq!(colors("0.5,0.25,1\n"), [Rgb::new(0.5, 0.25, 1.0)]);
        assert_eq!(colors("0,1,0\n1,1,1\n"), [Rgb::new(0.0, 1.0, 0.0), Rgb::WHITE]);
        let bytes = colors("255,188,0\n1,1,1\n");
        assert!((bytes[0].g - 0.502_886).abs() < 1e-5 && bytes[0].r == 1.0, "{bytes:?}");
        assert!((bytes[1].r - 1.0 / 255.0 / 12.92).abs() < 1e-8, "{bytes:?}");
    }

    #[test]
    fn only_asked_for_columns_must_be_numbers() {
        let table = table("name,x\nfirst,1\nsecond,nan\n,inf\n");
        assert_eq!(message(table.sizes(0)), "Some(Line(2)) column 1 (`name`): `first` is not a number ()");
        assert_eq!(message(table.sizes(1)), "Some(Line(3)) column 2 (`x`): `nan` is not finite ()");
    }

    #[test]
    fn what_is_wrong_is_said_with_its_place() {
        assert_eq!(
            message(table("1;2,5\n").sizes(1)),
            "Some(Line(1)) column 2: `2,5` is not a number (decimals are written with a point)"
        );
        assert_eq!(message(table("1,\n").sizes(1)), "Some(Line(1)) column 2: nothing stands here ()");
        assert_eq!(
            message(table("0,0,0\n256,0,0").colors([0, 1, 2])),
            "None column 1, row 2: 256 is no color (whole numbers in colors go from 0 to 255)"
        );
        let infinite = Table {
            columns: vec![Column::new("a", Numbers::F32(vec![1.0, f32::INFINITY]))],
            has_names: true,
            ..Table::default()
        };
        assert_eq!(message(infinite.sizes(0)), "None column 1 (`a`), row 2: inf is not finite ()");
    }
}

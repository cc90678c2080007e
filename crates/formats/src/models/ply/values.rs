//! The numbers of a PLY file, one after the other, however they are written.
//!
//! Every type of number comes as double precision, which holds all of them exactly but 64-bit integers: one way through
//! the elements for all types is short, and fast enough to be hardly seen beside the disk.

use super::super::text::{Cursor, shown};
use super::super::{FilePlace, LOST, ModelError};
use super::header::{Element, NumberType};

/// Numbers to be read.
pub(super) trait Values {
    /// The next number, which the header says to be of this type.
    fn next(&mut self, kind: NumberType) -> Result<f64, Trouble>;

    /// Leaves out numbers.
    fn skip(&mut self, kind: NumberType, count: u64) -> Result<(), Trouble>;

    /// The byte at which the next number begins.
    fn at(&mut self) -> usize;

    /// Goes to a byte.
    fn go_to(&mut self, at: usize);

    /// The place of a byte.
    fn place(&self, at: usize) -> FilePlace;

    /// True if that many numbers may come yet.
    fn may_hold(&self, kind: NumberType, count: u64) -> bool;

    /// What stands there in place of a number.
    fn describe(&self) -> String;
}

/// Why there is no next number. Small, since it is looked at after each.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Trouble {
    /// The file ends.
    Ended,
    /// It is something else.
    NotANumber,
    /// It is the length of a list, but negative, or greater than the file can hold.
    NotALength(f64),
}

/// Numbers as text, with any space between.
pub(super) struct Ascii<'a> {
    pub(super) bytes: &'a [u8],
    pub(super) cursor: Cursor<'a>,
}

impl Values for Ascii<'_> {
    #[inline]
    fn next(&mut self, _: NumberType) -> Result<f64, Trouble> {
        match self.cursor.number_of_text() {
            Some(number) => Ok(number),
            None if self.cursor.is_at_end() => Err(Trouble::Ended),
            None => Err(Trouble::NotANumber),
        }
    }

    fn skip(&mut self, kind: NumberType, count: u64) -> Result<(), Trouble> {
        (0..count).try_for_each(|_| self.next(kind).map(|_| ()))
    }

    fn at(&mut self) -> usize {
        self.cursor.skip_space();
        self.cursor.at()
    }

    fn go_to(&mut self, at: usize) {
        self.cursor.go_to(at);
    }

    fn place(&self, at: usize) -> FilePlace {
        FilePlace::Line(Cursor::new(self.bytes, at).line())
    }

    fn may_hold(&self, _: NumberType, count: u64) -> bool {
        // A digit and a blank each, the last one without.
        count <= self.cursor.left() as u64 / 2 + 1
    }

    fn describe(&self) -> String {
        shown(self.cursor.clone().word_of_text())
    }
}

/// Numbers as bytes; the least significant first unless `BIG`.
pub(super) struct Binary<'a, const BIG: bool> {
    pub(super) bytes: &'a [u8],
    pub(super) at: usize,
}

impl<const BIG: bool> Binary<'_, BIG> {
    #[inline]
    fn take<const N: usize>(&mut self) -> Result<[u8; N], Trouble> {
        let rest = self.bytes.get(self.at..).unwrap_or_default();
        let mut taken = *rest.first_chunk::<N>().ok_or(Trouble::Ended)?;
        self.at += N;
        if BIG {
            taken.reverse();
        }
        Ok(taken)
    }
}

impl<const BIG: bool> Values for Binary<'_, BIG> {
    #[inline]
    fn next(&mut self, kind: NumberType) -> Result<f64, Trouble> {
        Ok(match kind {
            NumberType::I8 => i8::from_le_bytes(self.take()?).into(),
            NumberType::U8 => u8::from_le_bytes(self.take()?).into(),
            NumberType::I16 => i16::from_le_bytes(self.take()?).into(),
            NumberType::U16 => u16::from_le_bytes(self.take()?).into(),
            NumberType::I32 => i32::from_le_bytes(self.take()?).into(),
            NumberType::U32 => u32::from_le_bytes(self.take()?).into(),
            NumberType::I64 => i64::from_le_bytes(self.take()?) as f64,
            NumberType::U64 => u64::from_le_bytes(self.take()?) as f64,
            NumberType::F32 => f32::from_le_bytes(self.take()?).into(),
            NumberType::F64 => f64::from_le_bytes(self.take()?),
        })
    }

    fn skip(&mut self, kind: NumberType, count: u64) -> Result<(), Trouble> {
        if !self.may_hold(kind, count) {
            return Err(Trouble::Ended);
        }
        self.at += count as usize * kind.bytes();
        Ok(())
    }

    #[inline]
    fn at(&mut self) -> usize {
        self.at
    }

    fn go_to(&mut self, at: usize) {
        self.at = at;
    }

    fn place(&self, at: usize) -> FilePlace {
        FilePlace::Byte(at as u64)
    }

    #[inline]
    fn may_hold(&self, kind: NumberType, count: u64) -> bool {
        count <= ((self.bytes.len() - self.at) / kind.bytes()) as u64
    }

    fn describe(&self) -> String {
        String::new()
    }
}

/// The length of a list.
#[inline]
pub(super) fn length(values: &mut impl Values, length: NumberType, kind: NumberType) -> Result<u64, Trouble> {
    let count = values.next(length)?;
    // Only whole numbers come out of this as they went in.
    let whole = count as u64;
    if whole as f64 == count && values.may_hold(kind, whole) { Ok(whole) } else { Err(Trouble::NotALength(count)) }
}

/// Leaves out a whole element.
pub(super) fn skip(values: &mut impl Values, element: &Element) -> Result<(), ModelError> {
    // Without properties there is nothing to leave out, however often.
    let count = if element.properties.is_empty() { 0 } else { element.count };
    for index in 0..count {
        for property in &element.properties {
            let skipped = match property.length {
                None => values.skip(property.kind, 1),
                Some(kind) => length(values, kind, property.kind).and_then(|count| values.skip(property.kind, count)),
            };
            skipped.map_err(|trouble| error(values, trouble, element, index))?;
        }
    }
    Ok(())
}

/// The message for trouble with a thing of an element, counted from 0.
#[cold]
pub(super) fn error(values: &mut impl Values, trouble: Trouble, element: &Element, index: u64) -> ModelError {
    let Element { name, count, .. } = element;
    let which = format!("element `{}` {index}, of {count} counted from 0", shown(name.as_bytes()));
    let message = match trouble {
        Trouble::Ended => format!("the file ends within {which}"),
        Trouble::NotANumber => format!("expected a number of {which}, not `{}`", values.describe()),
        Trouble::NotALength(length) => format!("a list of {length} numbers is more than the file can hold, in {which}"),
    };
    let at = values.at();
    let error = ModelError::new(message).at(values.place(at));
    match trouble {
        Trouble::Ended => error.help(LOST),
        Trouble::NotANumber | Trouble::NotALength(_) => error,
    }
}

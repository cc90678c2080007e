//! NumPy's arrays in files (NEP 1): a header in Python's words, then the numbers as they lay in memory.

use super::{Column, MOST_COLUMNS, Numbers, Table};
use crate::models::ModelError;

const MAGIC: &[u8] = b"\x93NUMPY";

/// What the header says.
#[derive(Debug, PartialEq)]
struct Header<'a> {
    /// `<f8` and the like: byte order, kind, bytes.
    descr: &'a str,
    /// True if whole columns follow one another.
    fortran_order: bool,
    shape: Vec<u64>,
}

/// How the numbers lie in the file: row `i` of a column is at byte `first + i * step`.
#[derive(Clone, Copy)]
struct Layout {
    rows: usize,
    first: usize,
    step: usize,
}

pub(super) fn read(bytes: &[u8]) -> Result<Table, ModelError> {
    let (text, data) = split(bytes)?;
    let header = parse(text)?;
    let (rows, width) = match header.shape[..] {
        [rows] => (rows, 1),
        [rows, width] => (rows, width),
        _ => {
            let message = format!("its array has {} dimensions", header.shape.len());
            return Err(ModelError::new(message).help("durer reads arrays of shape (n,) and (n, columns)"));
        }
    };
    if width > MOST_COLUMNS as u64 {
        return Err(ModelError::new(format!("its array has {width} columns, more than {MOST_COLUMNS}")));
    }
    let size = item_size(header.descr)?;
    let promised = rows.checked_mul(width).and_then(|cells| cells.checked_mul(size as u64));
    if promised.is_none_or(|promised| promised > data.len() as u64) {
        let message = format!("the file ends too early: {} bytes of numbers cannot be {rows} × {width}", data.len());
        return Err(ModelError::new(message));
    }
    let (rows, width) = (rows as usize, width as usize);
    let layout = |column| match header.fortran_order {
        true => Layout { rows, first: column * rows * size, step: size },
        false => Layout { rows, first: column * size, step: width * size },
    };
    let columns = (0..width).map(|column| Column::new("", numbers(data, header.descr, layout(column))));
    Ok(Table { columns: columns.collect(), ..Table::default() })
}

/// The header's text, and the numbers.
fn split(bytes: &[u8]) -> Result<(&str, &[u8]), ModelError> {
    let early = || ModelError::new("the file ends within its header");
    let rest = bytes.strip_prefix(MAGIC).ok_or_else(|| ModelError::new("it does not begin as a .npy file does"))?;
    let [major, _minor, rest @ ..] = rest else { return Err(early()) };
    let (length, rest) = match (major, rest) {
        (1, [a, b, rest @ ..]) => (u32::from(u16::from_le_bytes([*a, *b])), rest),
        (2 | 3, [a, b, c, d, rest @ ..]) => (u32::from_le_bytes([*a, *b, *c, *d]), rest),
        (1..=3, _) => return Err(early()),
        _ => return Err(ModelError::new(format!("version {major} of the .npy format is not known"))),
    };
    let (text, data) = rest.split_at_checked(length as usize).ok_or_else(early)?;
    let text = std::str::from_utf8(text).map_err(|_| ModelError::new("its header is not text"))?;
    Ok((text, data))
}

/// The three entries of the dictionary in the header, in any order.
fn parse(text: &str) -> Result<Header<'_>, ModelError> {
    let damaged = || ModelError::new("its header cannot be understood");
    let entry = |key: &str| {
        let after = ["'", "\""].iter().find_map(|quote| text.split_once(&format!("{quote}{key}{quote}")))?.1;
        after.trim_start().strip_prefix(':').map(str::trim_start)
    };
    let descr = entry("descr").ok_or_else(damaged)?;
    if descr.starts_with('[') {
        let help = "save the fields in a plain array: `np.save(file, np.stack([a[\"x\"], a[\"y\"], …], axis=-1))`";
        return Err(ModelError::new("its array is structured: it has named fields").help(help));
    }
    let fortran_order = match entry("fortran_order").ok_or_else(damaged)? {
        word if word.starts_with("True") => true,
        word if word.starts_with("False") => false,
        _ => return Err(damaged()),
    };
    let shape = entry("shape").and_then(|shape| shape.strip_prefix('(')?.split_once(')')).ok_or_else(damaged)?.0;
    let sizes = shape.split(',').map(str::trim).filter(|size| !size.is_empty());
    let shape = sizes.map(|size| size.parse().map_err(|_| damaged())).collect::<Result<_, _>>()?;
    Ok(Header { descr: quoted(descr).ok_or_else(damaged)?, fortran_order, shape })
}

/// What stands between the quotes at the beginning.
fn quoted(text: &str) -> Option<&str> {
    let quote = text.chars().next().filter(|quote| matches!(quote, '\'' | '"'))?;
    text[1..].split_once(quote).map(|(inside, _)| inside)
}

/// Bytes of a number.
fn item_size(descr: &str) -> Result<usize, ModelError> {
    match descr.as_bytes() {
        [b'<' | b'>' | b'|' | b'=', b'f', size @ (b'4' | b'8')] => Ok(usize::from(size - b'0')),
        [b'<' | b'>' | b'|' | b'=', b'i' | b'u', size @ (b'1' | b'2' | b'4' | b'8')] => Ok(usize::from(size - b'0')),
        _ => {
            let shown: String = descr.chars().take(20).collect();
            let error = ModelError::new(format!("its numbers are of the type `{shown}`"));
            Err(error.help("durer reads whole numbers and floats of 4 and 8 bytes: save `a.astype(\"f4\")`"))
        }
    }
}

/// A column. The layout must lie within `data`.
fn numbers(data: &[u8], descr: &str, at: Layout) -> Numbers {
    macro_rules! read {
        ($type:ty, $make:expr) => {{
            let make = $make;
            let items = strided(data, at).map(|bytes: [u8; size_of::<$type>()]| match descr.as_bytes()[0] {
                b'>' => make(<$type>::from_be_bytes(bytes)),
                _ => make(<$type>::from_le_bytes(bytes)),
            });
            items.collect()
        }};
    }
    match &descr[1..] {
        "f4" => Numbers::F32(read!(f32, |v| v)),
        "f8" => Numbers::F64(read!(f64, |v| v)),
        "u1" => Numbers::U8(read!(u8, |v| v)),
        "i1" => Numbers::F64(read!(i8, f64::from)),
        "u2" => Numbers::F64(read!(u16, f64::from)),
        "i2" => Numbers::F64(read!(i16, f64::from)),
        "u4" => Numbers::F64(read!(u32, f64::from)),
        "i4" => Numbers::F64(read!(i32, f64::from)),
        "u8" => Numbers::F64(read!(u64, |v| v as f64)),
        _ => Numbers::F64(read!(i64, |v| v as f64)),
    }
}

/// The bytes of the numbers of a column.
fn strided<const N: usize>(data: &[u8], at: Layout) -> impl Iterator<Item = [u8; N]> {
    let from_first = data.get(at.first..).unwrap_or_default();
    let items = from_first.chunks(at.step.max(1)).filter_map(|chunk| chunk.first_chunk().copied());
    items.take(at.rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(version: u8, header: &str, data: &[u8]) -> Vec<u8> {
        let length = match version {
            1 => (header.len() as u16).to_le_bytes().to_vec(),
            _ => (header.len() as u32).to_le_bytes().to_vec(),
        };
        [MAGIC, &[version, 0], &length, header.as_bytes(), data].concat()
    }

    fn dictionary(descr: &str, fortran: &str, shape: &str) -> String {
        format!("{{'descr': '{descr}', 'fortran_order': {fortran}, 'shape': {shape}, }}      \n")
    }

    fn rows(bytes: &[u8]) -> Vec<Vec<f64>> {
        let table = read(bytes).unwrap();
        let cell = |column: &Column, row: usize| match &column.numbers {
            Numbers::F64(numbers) => numbers[row],
            Numbers::F32(numbers) => f64::from(numbers[row]),
            Numbers::U8(numbers) => f64::from(numbers[row]),
        };
        (0..table.rows()).map(|row| table.columns.iter().map(|column| cell(column, row)).collect()).collect()
    }

    #[test]
    fn every_type_and_order_of_bytes_is_read() {
        macro_rules! both {
            ($descr:literal, $type:ty) => {
                let numbers: Vec<$type> = vec![1 as $type, 2 as $type, 100 as $type];
                let expected = [vec![1.0], vec![2.0], vec![100.0]];
                let little: Vec<u8> = numbers.iter().flat_map(|v| v.to_le_bytes()).collect();
                let big: Vec<u8> = numbers.iter().flat_map(|v| v.to_be_bytes()).collect();
                assert_eq!(rows(&file(1, &dictionary(concat!("<", $descr), "False", "(3,)"), &little)), expected);
                assert_eq!(rows(&file(2, &dictionary(concat!(">", $descr), "True", "(3, 1)"), &big)), expected);
            };
        }
        both!("f4", f32);
        both!("f8", f64);
        both!("i1", i8);
        both!("i2", i16);
        both!("i4", i32);
        both!("i8", i64);
        both!("u1", u8);
        both!("u2", u16);
        both!("u4", u32);
        both!("u8", u64);
        let minus = file(3, &dictionary("|i1", "False", "(2,)"), &[255, 128]);
        assert_eq!(rows(&minus), [[-1.0], [-128.0]]);
    }

    #[test]
    fn rows_and_columns_in_both_orders() {
        let bytes: Vec<u8> = (1..=6).collect();
        let of = |fortran| rows(&file(1, &dictionary("|u1", fortran, "(2, 3)"), &bytes));
        assert_eq!(of("False"), [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]);
        assert_eq!(of("True"), [[1.0, 3.0, 5.0], [2.0, 4.0, 6.0]]);
        assert!(rows(&file(1, &dictionary("<f8", "False", "(0, 3)"), &[])).is_empty());
    }

    /// As `np.save` wrote it: `np.save(f, np.array([[1.5, -2.0]], dtype="<f4"))`, NumPy 2.
    #[test]
    fn a_file_by_numpy() {
        let header = "{'descr': '<f4', 'fortran_order': False, 'shape': (1, 2), }";
        let padded = format!("{header:117}\n");
        let bytes = [b"\x93NUMPY\x01\x00\x76\x00", padded.as_bytes(), b"\x00\x00\xc0\x3f\x00\x00\x00\xc0"].concat();
        assert_eq!((bytes.len(), rows(&bytes)), (128 + 8, vec![vec![1.5, -2.0]]));
    }

    #[test]
    fn whole_numbers_are_colours_up_to_255() {
        let bytes = file(1, &dictionary("<i2", "False", "(1, 3)"), &[255, 0, 0, 0, 0, 0]);
        assert_eq!(read(&bytes).unwrap().colors([0, 1, 2]).unwrap()[0], durer_math::Rgb::new(1.0, 0.0, 0.0));
        let dark = file(1, &dictionary("|u1", "False", "(1, 3)"), &[1, 1, 1]);
        assert!(read(&dark).unwrap().colors([0, 1, 2]).unwrap()[0].r < 0.001, "bytes are bytes, however few");
    }

    #[test]
    fn what_cannot_be_read_is_refused_in_plain_words() {
        let message = |bytes: &[u8]| read(bytes).map(|_| ()).unwrap_err().message;
        let of = |descr, shape| message(&file(1, &dictionary(descr, "False", shape), &[0; 16]));
        assert_eq!(message(b""), "it does not begin as a .npy file does");
        assert_eq!(message(b"\x93NUMPY\x01"), "the file ends within its header");
        assert_eq!(message(b"\x93NUMPY\x01\x00\xff\xff{"), "the file ends within its header");
        assert_eq!(message(b"\x93NUMPY\x09\x00\x00\x00"), "version 9 of the .npy format is not known");
        assert_eq!(
            message(&file(1, "{'descr': [('x', '<f4')], 'shape': (1,)}", &[])),
            "its array is structured: it has named fields"
        );
        assert_eq!(message(&file(1, "{}", &[])), "its header cannot be understood");
        assert_eq!(of("<c8", "(1,)"), "its numbers are of the type `<c8`");
        assert_eq!(of("", "(1,)"), "its numbers are of the type ``");
        assert_eq!(of("<f8", "(1, 1, 1)"), "its array has 3 dimensions");
        assert_eq!(of("<f8", "()"), "its array has 0 dimensions");
        assert_eq!(of("<f8", "(3,)"), "the file ends too early: 16 bytes of numbers cannot be 3 × 1");
        assert_eq!(
            of("<f8", "(18446744073709551615, 999)"),
            "the file ends too early: 16 bytes of numbers cannot be 18446744073709551615 × 999"
        );
        assert_eq!(of("<f8", "(1, 2000)"), "its array has 2000 columns, more than 1000");
        assert_eq!(of("<f8", "(99999999999999999999,)"), "its header cannot be understood");
        assert_eq!(of("<f8", "(-1,)"), "its header cannot be understood");
    }

    /// Every byte of a file changed in several ways, and the file cut everywhere.
    #[test]
    fn no_bytes_break_it() {
        let good = file(1, &dictionary("<f4", "False", "(2, 2)"), &[0; 16]);
        for at in 0..good.len() {
            let _ = read(&good[..at]);
            for byte in [0, 0xff, b'0', b'9', b'(', b'\'', b'['] {
                let mut bad = good.clone();
                bad[at] = byte;
                if let Ok(table) = read(&bad) {
                    assert!(table.rows() * table.columns.len() <= 16);
                }
            }
        }
    }
}

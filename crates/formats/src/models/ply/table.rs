//! The vertices of a PLY file as a table of numbers, for point clouds.

use super::super::ModelError;
use super::super::text::Cursor;
use super::header::{Element, Encoding, Header, NumberType};
use super::values::{Ascii, Binary, Values, error, length, skip};
use crate::Limits;
use crate::data::{Column, Numbers, Table};

/// The numbers of the vertices, one column for each property that is no list, in the precision that the file declares.
///
/// # Errors
///
/// The first thing that is wrong with the file up to the end of its vertices.
pub(crate) fn table(bytes: &[u8], limits: &Limits) -> Result<Table, ModelError> {
    // A column takes at most four times its part of the file, so the limit of the file is limit enough.
    let _ = limits;
    let header = Header::read(bytes)?;
    match header.encoding {
        Encoding::Ascii => read(&header, &mut Ascii { bytes, cursor: Cursor::new(bytes, header.end) }),
        Encoding::LittleEndian => read(&header, &mut Binary::<false> { bytes, at: header.end }),
        Encoding::BigEndian => read(&header, &mut Binary::<true> { bytes, at: header.end }),
    }
}

fn read(header: &Header, values: &mut impl Values) -> Result<Table, ModelError> {
    for element in &header.elements {
        if element.name == "vertex" {
            return read_vertices(element, values);
        }
        skip(values, element)?;
    }
    let error = ModelError::new("there is no element `vertex` in this file");
    Err(error.help("tables are read from the vertices of PLY files"))
}

fn read_vertices(element: &Element, values: &mut impl Values) -> Result<Table, ModelError> {
    // What the file holds was compared to its length with the header.
    let count = element.count as usize;
    let mut numbers: Vec<Numbers> = element.properties.iter().map(|property| room(property.kind, count)).collect();
    let rows = if element.properties.is_empty() { 0 } else { element.count };
    for index in 0..rows {
        for (property, numbers) in element.properties.iter().zip(&mut numbers) {
            let done = match property.length {
                Some(kind) => length(values, kind, property.kind).and_then(|count| values.skip(property.kind, count)),
                None => values.next(property.kind).map(|number| push(numbers, number)),
            };
            done.map_err(|trouble| error(values, trouble, element, index))?;
        }
    }
    let scalars = element.properties.iter().zip(numbers).filter(|(property, _)| property.length.is_none());
    let columns = scalars.map(|(property, numbers)| Column::new(property.name.clone(), numbers)).collect();
    Ok(Table { columns, has_names: true, warnings: Vec::new() })
}

fn room(kind: NumberType, count: usize) -> Numbers {
    match kind {
        NumberType::U8 => Numbers::U8(Vec::with_capacity(count)),
        NumberType::F32 => Numbers::F32(Vec::with_capacity(count)),
        _ => Numbers::F64(Vec::with_capacity(count)),
    }
}

#[inline]
fn push(numbers: &mut Numbers, number: f64) {
    match numbers {
        Numbers::U8(list) => list.push(number as u8),
        Numbers::F32(list) => list.push(number as f32),
        Numbers::F64(list) => list.push(number),
    }
}

//! The header of a PLY file: text that says what elements follow, and of what numbers each consists.

use super::super::text::{Cursor, shown};
use super::super::{FilePlace, LOST, ModelError};

/// What a PLY file says of itself.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Header {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element>,
    /// The byte behind the header.
    pub(super) end: usize,
}

/// How numbers are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Ascii,
    LittleEndian,
    BigEndian,
}

/// A list of things that are alike: vertices, faces …
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Element {
    pub(super) name: String,
    pub(super) count: u64,
    pub(super) properties: Vec<Property>,
    /// The line that declares it.
    pub(super) line: usize,
}

/// A number, or a list of numbers, that each thing of an element has.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Property {
    pub(super) name: String,
    /// For lists, the type of the length.
    pub(super) length: Option<NumberType>,
    pub(super) kind: NumberType,
}

/// The types of numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum NumberType {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    /// Not in the first description of the format, like the next, but written by some programs.
    I64,
    U64,
    F32,
    F64,
}

impl NumberType {
    fn of_word(word: &[u8]) -> Option<NumberType> {
        Some(match word {
            b"char" | b"int8" => NumberType::I8,
            b"uchar" | b"uint8" => NumberType::U8,
            b"short" | b"int16" => NumberType::I16,
            b"ushort" | b"uint16" => NumberType::U16,
            b"int" | b"int32" => NumberType::I32,
            b"uint" | b"uint32" => NumberType::U32,
            b"int64" | b"long" | b"longlong" => NumberType::I64,
            b"uint64" | b"ulong" | b"ulonglong" => NumberType::U64,
            b"float" | b"float32" => NumberType::F32,
            b"double" | b"float64" => NumberType::F64,
            _ => return None,
        })
    }

    /// Its size in binary files.
    #[inline]
    pub(super) fn bytes(self) -> usize {
        match self {
            NumberType::I8 | NumberType::U8 => 1,
            NumberType::I16 | NumberType::U16 => 2,
            NumberType::I32 | NumberType::U32 | NumberType::F32 => 4,
            NumberType::I64 | NumberType::U64 | NumberType::F64 => 8,
        }
    }

    /// The greatest number of a whole type: what full strength of a color is.
    pub(super) fn greatest(self) -> Option<f64> {
        match self {
            NumberType::I8 => Some(127.0),
            NumberType::U8 => Some(255.0),
            NumberType::I16 => Some(32767.0),
            NumberType::U16 => Some(65535.0),
            // Programs that write wide integers mean bytes.
            NumberType::I32 | NumberType::U32 | NumberType::I64 | NumberType::U64 => Some(255.0),
            NumberType::F32 | NumberType::F64 => None,
        }
    }
}

impl Element {
    /// The fewest bytes that one of it takes.
    pub(super) fn least_bytes(&self, encoding: Encoding) -> u64 {
        let bytes = |property: &Property| match encoding {
            // A digit and a blank.
            Encoding::Ascii => 2,
            Encoding::LittleEndian | Encoding::BigEndian => property.length.unwrap_or(property.kind).bytes() as u64,
        };
        self.properties.iter().map(bytes).sum()
    }

    /// The number that has one of these names, the first name that there is.
    pub(super) fn scalar(&self, names: &[&str]) -> Option<usize> {
        let mut found = names.iter().map(|name| self.properties.iter().position(|property| property.name == *name));
        found.find(Option::is_some).flatten().filter(|at| self.properties[*at].length.is_none())
    }

    /// The list that has one of these names.
    pub(super) fn list(&self, names: &[&str]) -> Option<usize> {
        let is_it = |property: &Property| property.length.is_some() && names.contains(&property.name.as_str());
        self.properties.iter().position(is_it)
    }
}

impl Header {
    /// Reads the header of a file.
    pub(super) fn read(bytes: &[u8]) -> Result<Header, ModelError> {
        let mut lines = Lines { bytes, at: 0, number: 0 };
        let first = lines.next()?;
        if first != b"ply" {
            let error = lines.error("a PLY file begins with a line `ply`");
            return Err(error.help("is it a file of another format, with a wrong ending?"));
        }
        let mut encoding = None;
        let mut elements: Vec<Element> = Vec::new();
        loop {
            let line = lines.next()?;
            let mut words = Cursor::new(line, 0);
            match words.word() {
                b"" | b"comment" | b"obj_info" => {}
                b"format" => encoding = Some(read_format(&mut words).map_err(|message| lines.error(message))?),
                b"element" => {
                    let element = read_element(&mut words, lines.number);
                    elements.push(element.map_err(|message| lines.error(message))?);
                }
                b"property" => {
                    let property = read_property(&mut words).map_err(|message| lines.error(message))?;
                    let element = elements.last_mut();
                    let element = element.ok_or_else(|| lines.error("a property must stand behind an element"))?;
                    element.properties.push(property);
                }
                b"end_header" => break,
                other => return Err(lines.error(format!("`{}` is no word of a PLY header", shown(other)))),
            }
        }
        let encoding = encoding.ok_or_else(|| lines.error("this header lacks a line with the format"))?;
        let header = Header { encoding, elements, end: lines.at };
        header.check_counts(bytes.len())?;
        Ok(header)
    }

    /// Refuses counts that the file cannot hold, before anything of that size is made.
    fn check_counts(&self, length: usize) -> Result<(), ModelError> {
        let mut left = (length - self.end) as u64;
        // The last number of a text needs no blank.
        left += u64::from(self.encoding == Encoding::Ascii);
        for element in &self.elements {
            let least = element.count.saturating_mul(element.least_bytes(self.encoding));
            if least > left {
                let Element { count, name, .. } = element;
                let message =
                    format!("this file is too short to hold {count} of the element `{}`", shown(name.as_bytes()));
                return Err(ModelError::new(message).at(FilePlace::Line(element.line)).help(LOST));
            }
            left -= least;
        }
        Ok(())
    }
}

fn read_format(words: &mut Cursor<'_>) -> Result<Encoding, String> {
    match words.word() {
        b"ascii" => Ok(Encoding::Ascii),
        b"binary_little_endian" => Ok(Encoding::LittleEndian),
        b"binary_big_endian" => Ok(Encoding::BigEndian),
        other => {
            Err(format!("the format must be ascii, binary_little_endian or binary_big_endian, not `{}`", shown(other)))
        }
    }
}

fn read_element(words: &mut Cursor<'_>, line: usize) -> Result<Element, String> {
    let name = String::from_utf8_lossy(words.word()).into_owned();
    let count = words.word();
    let number = std::str::from_utf8(count).ok().and_then(|count| count.parse().ok());
    match number {
        Some(count) if !name.is_empty() => Ok(Element { name, count, properties: Vec::new(), line }),
        _ => Err(format!("expected the name of an element and a count, not `{}`", shown(count))),
    }
}

fn read_property(words: &mut Cursor<'_>) -> Result<Property, String> {
    let of_word = |word| NumberType::of_word(word).ok_or_else(|| format!("`{}` is no type of numbers", shown(word)));
    let first = words.word();
    let (length, kind) = match first {
        b"list" => {
            let length = of_word(words.word())?;
            if matches!(length, NumberType::F32 | NumberType::F64) {
                return Err("the length of a list must be a whole number".to_owned());
            }
            (Some(length), of_word(words.word())?)
        }
        kind => (None, of_word(kind)?),
    };
    let name = words.word();
    if name.is_empty() {
        return Err("this property lacks a name".to_owned());
    }
    Ok(Property { name: String::from_utf8_lossy(name).into_owned(), length, kind })
}

/// The lines of a header, ended in any of the three ways.
struct Lines<'a> {
    bytes: &'a [u8],
    at: usize,
    /// That of the last line, from 1.
    number: usize,
}

impl<'a> Lines<'a> {
    fn next(&mut self) -> Result<&'a [u8], ModelError> {
        let rest = &self.bytes[self.at..];
        self.number += 1;
        let Some(length) = rest.iter().position(|byte| matches!(byte, b'\n' | b'\r')) else {
            return Err(self.error("the file ends within its header").help(LOST));
        };
        let is_pair = rest[length..].starts_with(b"\r\n");
        self.at += length + if is_pair { 2 } else { 1 };
        Ok(&rest[..length])
    }

    fn error(&self, message: impl Into<String>) -> ModelError {
        ModelError::new(message).at(FilePlace::Line(self.number))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_that_a_header_may_say_is_read() {
        for end in ["\n", "\r\n", "\r"] {
            let text = "ply\nformat binary_big_endian 1.0\ncomment made by hand\nobj_info x\nelement vertex 2\n\
                        property float32 x\nproperty list uint8 int vertex_indices\nend_header\n";
            let mut bytes = text.replace('\n', end).into_bytes();
            let length = bytes.len();
            // That these bytes look like ends of lines must not matter to the other kinds.
            bytes.extend([b'a'; 16]);
            let header = Header::read(&bytes).unwrap();
            assert_eq!((header.encoding, header.end, header.elements.len()), (Encoding::BigEndian, length, 1));
            let vertex = &header.elements[0];
            assert_eq!((vertex.count, vertex.line, vertex.least_bytes(Encoding::BigEndian)), (2, 5, 5));
            assert_eq!((vertex.scalar(&["y", "x"]), vertex.list(&["vertex_indices"])), (Some(0), Some(1)));
            assert_eq!((vertex.scalar(&["vertex_indices"]), vertex.list(&["x"])), (None, None));
        }
    }

    #[test]
    fn wrong_headers_say_why_and_where() {
        let cases = [
            ("plyx\n", 1, "begins with"),
            ("ply\n", 2, "ends within its header"),
            ("ply\nformat utf8 1.0\n", 2, "not `utf8`"),
            ("ply\nend_header\n", 2, "lacks a line with the format"),
            ("ply\nproperty float x\n", 2, "behind an element"),
            ("ply\nelement vertex -1\n", 2, "not `-1`"),
            ("ply\nelement vertex\n", 2, "a count"),
            ("ply\nelement v 1\nproperty real x\n", 3, "`real` is no type"),
            ("ply\nelement v 1\nproperty list float int x\n", 3, "must be a whole number"),
            ("ply\nelement v 1\nproperty int\n", 3, "lacks a name"),
            ("ply\nvertices 8\n", 2, "`vertices` is no word"),
            (
                "ply\nformat ascii 1.0\nelement v 99999999999999\nproperty int a\nend_header\n1\n",
                3,
                "too short to hold",
            ),
            ("ply\nformat binary_little_endian 1.0\nelement v 2\nproperty int a\nend_header\n1234567", 3, "too short"),
        ];
        for (text, line, why) in cases {
            let error = Header::read(text.as_bytes()).unwrap_err();
            assert_eq!(error.place, Some(FilePlace::Line(line)), "{text}: {error}");
            assert!(error.message.contains(why), "{text}: {error}");
        }
    }
}

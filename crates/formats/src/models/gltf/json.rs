//! The JSON of a glTF file, as a tree that takes little more memory than its text.
//!
//! serde_json reads the text; its own tree would take 72 bytes for a `0,` of two, and copy every data URI.

use super::super::{FilePlace, ModelError};
use serde::de::{DeserializeSeed, Deserializer, Error, MapAccess, SeqAccess, Visitor};
use std::borrow::Cow;
use std::cell::Cell;
use std::fmt;

/// A JSON value that borrows its text where it can.
#[derive(Debug, PartialEq)]
pub(super) enum Json<'a> {
    Null,
    Flag(bool),
    Number(f64),
    Text(Cow<'a, str>),
    List(Box<[Json<'a>]>),
    /// Sorted by name, each name once.
    Fields(Box<[(Cow<'a, str>, Json<'a>)]>),
}

/// Reads `text`, refusing more than `most` values in it. If it is part of a binary file, `starts` is where.
pub(super) fn parse(text: &[u8], starts: Option<u64>, most: usize) -> Result<Json<'_>, ModelError> {
    let mut from = serde_json::Deserializer::from_slice(text);
    let left = Cell::new(most);
    let json = Reader { left: &left }.deserialize(&mut from).and_then(|json| from.end().map(|()| json));
    json.map_err(|error| {
        let message = error.to_string();
        let message = message.rsplit_once(" at line ").map_or(message.as_str(), |(message, _)| message);
        let place = match starts {
            Some(starts) => FilePlace::Byte(starts + byte_of(text, error.line(), error.column())),
            None => FilePlace::Line(error.line().max(1)),
        };
        let fault = ModelError::new(format!("this is not the JSON of a glTF file: {message}"));
        fault.at(place).help("a .gltf file is JSON text, a .glb file begins with `glTF`")
    })
}

/// Where a line and column, both from 1, are in a text.
fn byte_of(text: &[u8], line: usize, column: usize) -> u64 {
    let before: usize = text.split_inclusive(|byte| *byte == b'\n').take(line.saturating_sub(1)).map(<[u8]>::len).sum();
    (before + column.saturating_sub(1)) as u64
}

/// Reads one value and all in it.
#[derive(Clone, Copy)]
struct Reader<'c> {
    /// How many more values may come.
    left: &'c Cell<usize>,
}

impl<'de> DeserializeSeed<'de> for Reader<'_> {
    type Value = Json<'de>;

    fn deserialize<D: Deserializer<'de>>(self, from: D) -> Result<Json<'de>, D::Error> {
        let Some(left) = self.left.get().checked_sub(1) else {
            return Err(D::Error::custom("it has more values than are allowed"));
        };
        self.left.set(left);
        from.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Reader<'_> {
    type Value = Json<'de>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a value")
    }
    fn visit_unit<E>(self) -> Result<Json<'de>, E> {
        Ok(Json::Null)
    }
    fn visit_bool<E>(self, flag: bool) -> Result<Json<'de>, E> {
        Ok(Json::Flag(flag))
    }
    fn visit_u64<E>(self, number: u64) -> Result<Json<'de>, E> {
        Ok(Json::Number(number as f64))
    }
    fn visit_i64<E>(self, number: i64) -> Result<Json<'de>, E> {
        Ok(Json::Number(number as f64))
    }
    fn visit_f64<E>(self, number: f64) -> Result<Json<'de>, E> {
        Ok(Json::Number(number))
    }
    fn visit_borrowed_str<E>(self, text: &'de str) -> Result<Json<'de>, E> {
        Ok(Json::Text(Cow::Borrowed(text)))
    }
    fn visit_str<E>(self, text: &str) -> Result<Json<'de>, E> {
        Ok(Json::Text(Cow::Owned(text.to_owned())))
    }
    fn visit_seq<A: SeqAccess<'de>>(self, mut from: A) -> Result<Json<'de>, A::Error> {
        let mut list = Vec::new();
        while let Some(one) = from.next_element_seed(self)? {
            list.push(one);
        }
        Ok(Json::List(list.into()))
    }
    fn visit_map<A: MapAccess<'de>>(self, mut from: A) -> Result<Json<'de>, A::Error> {
        let mut fields = Vec::new();
        while let Some(name) = from.next_key_seed(Name)? {
            fields.push((name, from.next_value_seed(self)?));
        }
        // The last of several fields with one name counts: the first, once the order is turned around.
        fields.reverse();
        fields.sort_by(|a, b| a.0.cmp(&b.0));
        fields.dedup_by(|a, b| a.0 == b.0);
        Ok(Json::Fields(fields.into()))
    }
}

/// Reads the name of a field.
struct Name;

impl<'de> DeserializeSeed<'de> for Name {
    type Value = Cow<'de, str>;

    fn deserialize<D: Deserializer<'de>>(self, from: D) -> Result<Cow<'de, str>, D::Error> {
        from.deserialize_str(self)
    }
}

impl<'de> Visitor<'de> for Name {
    type Value = Cow<'de, str>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the name of a field")
    }
    fn visit_borrowed_str<E>(self, text: &'de str) -> Result<Cow<'de, str>, E> {
        Ok(Cow::Borrowed(text))
    }
    fn visit_str<E>(self, text: &str) -> Result<Cow<'de, str>, E> {
        Ok(Cow::Owned(text.to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_of_equal_names_counts() {
        let json = parse(br#"{"b": 1, "a": 2, "b": 3}"#, None, 100).unwrap();
        let field = |name, number| (Cow::Borrowed(name), Json::Number(number));
        assert_eq!(json, Json::Fields([field("a", 2.0), field("b", 3.0)].into()));
    }

    #[test]
    fn text_is_borrowed_unless_it_has_escapes() {
        let json = parse(br#"["plain", "\u0041\n"]"#, None, 100).unwrap();
        let Json::List(list) = &json else { panic!("{json:?}") };
        assert!(matches!(&list[0], Json::Text(Cow::Borrowed("plain"))), "{list:?}");
        assert_eq!(list[1], Json::Text(Cow::Borrowed("A\n")));
        assert!(size_of::<Json<'_>>() <= 24);
    }

    #[test]
    fn limits_hold() {
        assert!(parse(b"[[], [], []]", None, 4).is_ok());
        assert!(parse(b"[[], [], []]", None, 3).unwrap_err().message.contains("more values than are allowed"));
        assert!(parse(&[b'['; 1_000_000], None, 10_000_000).unwrap_err().message.contains("recursion limit"));
    }

    #[test]
    fn faults_know_their_line_or_their_byte() {
        let text = b"{\n  \"a\": [1, ],\n}";
        let fault = parse(text, None, 100).unwrap_err();
        assert_eq!(fault.place, Some(FilePlace::Line(2)));
        assert!(!fault.message.contains(" at line "), "{}", fault.message);
        let fault = parse(text, Some(20), 100).unwrap_err();
        assert_eq!(fault.place, Some(FilePlace::Byte(20 + 2 + 11)));
    }
}

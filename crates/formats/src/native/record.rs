//! One definition for reading, writing, the JSON Schema and the reference page.
//!
//! `record!` defines the fields of a thing, `choice!` the kinds of a thing, each kind with its fields. A field is
//!
//! ```text
//! rust_field as "file_key": Type = default => "What it is."
//! ```
//!
//! where `as "file_key"` is left out if the names agree, and `= default` if the field must be given. A default may
//! use fields above it; then `same as "other"` after the description says so in the reference.

use super::decode::{Decoder, Fields};
use super::tree::Node;
use super::value::Value;
use super::write::{FieldsOut, Out, Writer};
use serde_json::Value as Json;
use std::rc::Rc;

/// A thing with fields.
pub(crate) trait Record: Sized {
    /// Reads all fields; the reader remembers what was wrong.
    fn read(from: &mut Fields<'_, '_, '_>) -> Self;
    /// Writes the fields that differ from their defaults.
    fn write(&self, out: &mut FieldsOut<'_, '_>);
    /// Describes the fields.
    fn about() -> Vec<FieldAbout>;
}

/// A thing of one of several kinds, each a word in files.
pub(crate) trait Choice: Sized {
    /// What it is called, without article.
    const NOUN: &'static str;
    /// The kinds: word and example.
    const WORDS: &'static [(&'static str, &'static str)];
    /// Reads the fields of the kind `word`; `None` if it is not one of the kinds.
    fn read(word: &str, from: &mut Fields<'_, '_, '_>) -> Option<Self>;
    /// The word of its kind.
    fn word(&self) -> &'static str;
    /// Writes the fields that differ from their defaults.
    fn write(&self, out: &mut FieldsOut<'_, '_>);
    /// Describes the kinds.
    fn kinds() -> Vec<KindAbout>;
}

/// What there is to say about a field.
pub(crate) struct FieldAbout {
    pub(crate) key: &'static str,
    pub(crate) about: &'static str,
    pub(crate) noun: String,
    pub(crate) schema: Json,
    pub(crate) default: DefaultAbout,
}

/// What there is to say about a field that is not given.
pub(crate) enum DefaultAbout {
    /// It must be given.
    Required,
    /// It has this value.
    Value(Out),
    /// It has the value of that other field.
    SameAs(&'static str),
}

/// What there is to say about one kind of a choice.
pub(crate) struct KindAbout {
    pub(crate) word: &'static str,
    pub(crate) about: &'static str,
    pub(crate) example: &'static str,
    pub(crate) fields: Vec<FieldAbout>,
}

impl FieldAbout {
    pub(crate) fn required<T: Value>(key: &'static str, about: &'static str) -> FieldAbout {
        FieldAbout { key, about, noun: T::noun(), schema: T::schema(), default: DefaultAbout::Required }
    }

    pub(crate) fn or<T: Value>(key: &'static str, about: &'static str, default: &T) -> FieldAbout {
        let default = DefaultAbout::Value(default.encode(&Writer::nowhere()));
        FieldAbout { default, ..FieldAbout::required::<T>(key, about) }
    }

    pub(crate) fn same_as<T: Value>(key: &'static str, about: &'static str, other: &'static str) -> FieldAbout {
        FieldAbout { default: DefaultAbout::SameAs(other), ..FieldAbout::required::<T>(key, about) }
    }
}

/// Reads a choice that has no fields beside those of its kinds.
pub(crate) fn decode_choice<C: Choice>(node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<C> {
    let words: Vec<&'static str> = C::WORDS.iter().map(|(word, _)| *word).collect();
    let mut fields = Fields::of_kind(node, cx, C::NOUN, &words)?;
    let word = fields.word();
    fields.set_example(example_of::<C>(word));
    let value = C::read(word, &mut fields);
    fields.finish();
    value
}

/// Reads a record from a mapping; `title` is what messages call it.
pub(crate) fn decode_record<R: Record>(title: &'static str, node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<R> {
    let mut fields = Fields::of_record(node, cx, title)?;
    let value = R::read(&mut fields);
    fields.finish();
    Some(value)
}

/// Writes a choice: a bare word if no field is worth writing.
pub(crate) fn encode_choice<C: Choice>(choice: &C, writer: &Writer<'_>) -> Out {
    let mut out = FieldsOut::new(writer);
    choice.write(&mut out);
    out.into_kind(choice.word())
}

/// Writes a record.
pub(crate) fn encode_record<R: Record>(record: &R, writer: &Writer<'_>) -> Out {
    let mut out = FieldsOut::new(writer);
    record.write(&mut out);
    out.into_fields()
}

/// The example of a kind.
pub(crate) fn example_of<C: Choice>(word: &str) -> &'static str {
    C::WORDS.iter().find(|(known, _)| *known == word).map_or("", |(_, example)| example)
}

/// The fields of one `struct` or variant: reading, writing, describing.
macro_rules! fields {
    (@key $field:ident) => { stringify!($field) };
    (@key $field:ident $key:literal) => { $key };

    (@take $from:ident, $key:expr) => { $from.required($key) };
    (@take $from:ident, $key:expr, $default:expr) => { $from.or($key, || $default) };

    (@put $out:ident, $key:expr, $value:expr) => { $out.required($key, $value) };
    (@put $out:ident, $key:expr, $value:expr, $default:expr) => { $out.or($key, $value, &$default) };

    (@tell $key:expr, $about:expr, $type:ty, [] []) => { FieldAbout::required::<$type>($key, $about) };
    (@tell $key:expr, $about:expr, $type:ty, [$default:expr] []) => { FieldAbout::or::<$type>($key, $about, &$default) };
    (@tell $key:expr, $about:expr, $type:ty, [$default:expr] [$same:literal]) => {
        FieldAbout::same_as::<$type>($key, $about, $same)
    };

    // The whole of a tuple variant is a record of its own.
    (@read $from:ident, [$($make:tt)*] ($inner:ty)) => { $($make)*(<$inner as Record>::read($from)) };
    (@write $value:ident, $out:ident, [$($make:tt)*] ($inner:ty)) => {
        #[allow(unreachable_patterns)] // the variant is known, but for types of one variant
        match $value { $($make)*(inner) => Record::write(inner, $out), _ => {} }
    };
    (@about ($inner:ty)) => { <$inner as Record>::about() };

    (@read $from:ident, [$($make:tt)*] { $($field:ident $(as $key:literal)? : $type:ty $(= $default:expr)?
        => $about:literal $(same as $same:literal)?;)* }) => {{
        $( let $field: $type = fields!(@take $from, fields!(@key $field $($key)?) $(, $default)?); )*
        $($make)* { $($field),* }
    }};
    (@write $value:ident, $out:ident, [$($make:tt)*] { $($field:ident $(as $key:literal)? : $type:ty $(= $default:expr)?
        => $about:literal $(same as $same:literal)?;)* }) => {
        #[allow(unreachable_patterns)] // the variant is known, but for types of one variant
        match $value {
            $($make)* { $($field),* } => {
                $( let $field: $type = $field.clone(); )*
                $( fields!(@put $out, fields!(@key $field $($key)?), &$field $(, $default)?); )*
            }
            _ => {}
        }
    };
    (@about { $($field:ident $(as $key:literal)? : $type:ty $(= $default:expr)?
        => $about:literal $(same as $same:literal)?;)* }) => {
        vec![$( fields!(@tell fields!(@key $field $($key)?), $about, $type, [$($default)?] [$($same)?]) ),*]
    };
}

/// Defines the fields of a struct.
macro_rules! record {
    ($name:ident $body:tt) => {
        impl Record for $name {
            #[allow(unused_variables)]
            fn read(from: &mut Fields<'_, '_, '_>) -> Self {
                fields!(@read from, [$name] $body)
            }
            #[allow(clippy::clone_on_copy)]
            fn write(&self, out: &mut FieldsOut<'_, '_>) {
                fields!(@write self, out, [$name] $body);
            }
            fn about() -> Vec<FieldAbout> {
                fields!(@about $body)
            }
        }
    };
}

/// Defines the kinds of an enum: `Variant "word": "What it is.", example "…", { fields }`.
macro_rules! choice {
    ($name:ident, $noun:literal; $($variant:ident $word:literal : $about:literal, example $example:literal, $body:tt)*) => {
        impl Choice for $name {
            const NOUN: &'static str = $noun;
            const WORDS: &'static [(&'static str, &'static str)] = &[$(($word, $example)),*];

            #[allow(unused_variables)]
            fn read(word: &str, from: &mut Fields<'_, '_, '_>) -> Option<Self> {
                Some(match word {
                    $( $word => fields!(@read from, [$name::$variant] $body), )*
                    _ => return None,
                })
            }
            fn word(&self) -> &'static str {
                match self { $( $name::$variant { .. } => $word, )* }
            }
            #[allow(unused_variables, clippy::clone_on_copy)]
            fn write(&self, out: &mut FieldsOut<'_, '_>) {
                match self { $( $name::$variant { .. } => { fields!(@write self, out, [$name::$variant] $body); } )* }
            }
            fn kinds() -> Vec<KindAbout> {
                vec![$( KindAbout { word: $word, about: $about, example: $example, fields: fields!(@about $body) } ),*]
            }
        }
    };
}

/// Lets fields have a choice as their type; the first argument after the type is the stand-in.
macro_rules! choice_value {
    ($name:ident, $stand_in:expr) => {
        impl Value for $name {
            fn noun() -> String {
                format!("{} {}", super::decode::article(<$name as Choice>::NOUN), <$name as Choice>::NOUN)
            }
            fn stand_in() -> Self {
                $stand_in
            }
            fn decode(node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<Self> {
                super::record::decode_choice(node, cx)
            }
            fn encode(&self, writer: &Writer<'_>) -> Out {
                super::record::encode_choice(self, writer)
            }
            fn schema() -> Json {
                super::schema::choice(&<$name as Choice>::kinds())
            }
        }
    };
}

/// Lets fields have a record as their type.
macro_rules! record_value {
    ($name:ident, $title:literal, $stand_in:expr) => {
        impl Value for $name {
            fn noun() -> String {
                $title.to_owned()
            }
            fn stand_in() -> Self {
                $stand_in
            }
            fn decode(node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<Self> {
                super::record::decode_record($title, node, cx)
            }
            fn encode(&self, writer: &Writer<'_>) -> Out {
                super::record::encode_record(self, writer)
            }
            fn schema() -> Json {
                super::schema::record(&<$name as Record>::about())
            }
        }
    };
}

pub(crate) use {choice, choice_value, fields, record, record_value};

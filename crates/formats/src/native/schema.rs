//! The JSON Schema of scene files, from the same definitions as the reader: editors complete and explain by it.

use super::colors;
use super::file::SceneFile;
use super::lights::Shine;
use super::lists;
use super::objects::Placing;
use super::record::{Choice, DefaultAbout, FieldAbout, KindAbout, Record};
use super::surfaces::{Common, Physical};
use super::textures;
use super::transform::{AxisAngle, STEPS};
use super::write::Out;
use durer_scene::{Classic, LightKind, Pattern};
use serde_json::{Map, Value as Json, json};

/// The JSON Schema (draft 2020-12) of scene files.
pub fn json_schema() -> Json {
    let mut schema = record(&SceneFile::about());
    schema["$schema"] = json!("https://json-schema.org/draft/2020-12/schema");
    schema["title"] = json!("durer scene");
    schema["description"] = json!("A scene for the ray tracer durer. Right-handed coordinates, +y up; colors linear.");
    schema["$defs"] = json!({
        "object": kinds_with(&super::objects::kinds(), &Placing::about(), "An object."),
        "light": kinds_with(&LightKind::kinds(), &Shine::about(), "A light."),
        "texture": kinds_with(&Pattern::kinds(), &textures::Placing::about(), "A texture."),
        "material": material(),
        "paint": {
            "description": "A color, the name of a texture, or a texture.",
            "anyOf": [{ "$ref": "#/$defs/color" }, { "type": "string" }, { "$ref": "#/$defs/texture" }],
        },
        "color": color(),
        "vector": {
            "description": "Three numbers [x, y, z].",
            "type": "array", "items": { "type": "number" }, "minItems": 3, "maxItems": 3,
        },
        "points": lists::list_schema(&json!({ "$ref": "#/$defs/vector" })),
        "numbers": lists::list_schema(&json!({ "type": "number" })),
        "colors": lists::list_schema(&json!({ "$ref": "#/$defs/color" })),
        "data": lists::file_schema(),
        "transform": {
            "description": "Steps, the first one first.",
            "anyOf": [{ "type": "array", "items": { "$ref": "#/$defs/step" } }, { "$ref": "#/$defs/step" }],
        },
        "step": step(),
    });
    schema
}

/// The schema of a record.
pub(super) fn record(fields: &[FieldAbout]) -> Json {
    let required: Vec<&str> =
        fields.iter().filter(|field| matches!(field.default, DefaultAbout::Required)).map(|field| field.key).collect();
    let properties: Map<String, Json> = fields.iter().map(|about| (about.key.to_owned(), field(about))).collect();
    let mut schema = json!({ "type": "object", "properties": properties, "additionalProperties": false });
    if !required.is_empty() {
        schema["required"] = json!(required);
    }
    schema
}

fn field(about: &FieldAbout) -> Json {
    let mut schema = about.schema.clone();
    schema["description"] = json!(about.about);
    match &about.default {
        DefaultAbout::Value(Out::Plain(_) | Out::List(_) | Out::Fields(_)) => {
            if let DefaultAbout::Value(value) = &about.default {
                schema["default"] = value.to_json();
            }
        }
        DefaultAbout::SameAs(other) => schema["description"] = json!(format!("{} Default: as `{other}`.", about.about)),
        DefaultAbout::Value(Out::Text(words)) => {
            schema["description"] = json!(format!("{} Default: {words}.", about.about));
        }
        DefaultAbout::Value(Out::Null) | DefaultAbout::Required => {}
    }
    schema
}

/// The schema of a choice: a word, or a mapping of exactly one kind.
pub(super) fn choice(kinds: &[KindAbout]) -> Json {
    kinds_with(kinds, &[], "")
}

fn kinds_with(kinds: &[KindAbout], common: &[FieldAbout], about: &str) -> Json {
    let needs_nothing =
        |kind: &&KindAbout| !kind.fields.iter().any(|field| matches!(field.default, DefaultAbout::Required));
    let words: Vec<Json> = kinds
        .iter()
        .filter(needs_nothing)
        .map(|kind| json!({ "const": kind.word, "description": kind.about }))
        .collect();
    let mut properties = Map::new();
    for kind in kinds.iter().filter(|kind| !kind.fields.is_empty()) {
        let mut fields = record(&kind.fields);
        if let (Some(own), Json::Object(more)) = (fields["properties"].as_object_mut(), &record(common)["properties"]) {
            own.extend(more.clone());
        }
        fields["description"] = json!(kind.about);
        fields["examples"] = json!([kind.example]);
        if needs_nothing(&kind) {
            fields["type"] = json!(["object", "null"]);
        }
        properties.insert(kind.word.to_owned(), fields);
    }
    let mut any: Vec<Json> = Vec::new();
    if !words.is_empty() {
        any.push(json!({ "oneOf": words }));
    }
    if !properties.is_empty() {
        any.push(json!({
            "type": "object", "properties": properties, "additionalProperties": false,
            "minProperties": 1, "maxProperties": 1,
        }));
    }
    match about {
        "" => json!({ "anyOf": any }),
        about => json!({ "description": about, "anyOf": any }),
    }
}

/// The fields of a classic material, or a mapping of exactly one kind.
fn material() -> Json {
    let mut kinds = kinds_with(&Physical::kinds(), &Common::about(), "A material.");
    let classic = record(&Classic::about().into_iter().chain(Common::about()).collect::<Vec<_>>());
    if let Some(any) = kinds["anyOf"].as_array_mut() {
        // No bare words: those are names.
        any.retain(|one| one.get("oneOf").is_none());
        any.insert(0, classic);
    }
    kinds
}

fn color() -> Json {
    let names: Vec<&str> = colors::NAMES.iter().map(|(name, _)| *name).collect();
    json!({
        "description": "A gray, linear [r, g, b], \"#rrggbb\", or a CSS name.",
        "anyOf": [
            { "type": "number" },
            { "type": "array", "items": { "type": "number" }, "minItems": 3, "maxItems": 3 },
            { "type": "string", "pattern": "^#([0-9a-fA-F]{3}|[0-9a-fA-F]{6})$" },
            { "enum": names },
        ],
    })
}

fn step() -> Json {
    let [translate, scale, rotate, matrix] = STEPS;
    let number = json!({ "type": "number" });
    let about_axis = |axis: &str| {
        let mut properties = Map::new();
        properties.insert(axis.to_owned(), json!({ "type": "number", "description": "The angle, in degrees." }));
        json!({ "type": "object", "properties": properties, "required": [axis], "additionalProperties": false })
    };
    let row = json!({ "type": "array", "items": number, "minItems": 4, "maxItems": 4 });
    json!({
        "type": "object", "minProperties": 1, "maxProperties": 1, "additionalProperties": false,
        "properties": {
            (translate.0): { "description": translate.1, "$ref": "#/$defs/vector" },
            (scale.0): { "description": scale.1, "anyOf": [number, { "$ref": "#/$defs/vector" }] },
            (rotate.0): {
                "description": rotate.1,
                "anyOf": [about_axis("x"), about_axis("y"), about_axis("z"), record(&AxisAngle::about())],
            },
            (matrix.0): { "description": matrix.1, "type": "array", "items": row, "minItems": 3, "maxItems": 4 },
        },
    })
}

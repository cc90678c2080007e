//! What to say to mistakes that people who come from other programs make.

use super::record::{Choice, FieldAbout, KindAbout, Record};
use super::suggest;
use super::surfaces::{Common, Physical};
use super::tree::{Entry, Node, shorten};
use crate::diagnostics::Complaint;
use durer_scene::{Classic, Integrator, PathSettings, Pattern, RenderSettings};

const STEPS: [&str; 4] = ["translate", "rotate", "scale", "matrix"];

/// Help for a line in which a colour such as `#ff0000` stands without quotes and is a comment.
pub(crate) fn unquoted_color(line: &str) -> Option<String> {
    let mut comments = line.match_indices(" #").map(|(at, _)| &line[at + 2..]);
    let digits = |rest: &str| rest.chars().take_while(char::is_ascii_hexdigit).count();
    let color = comments.find(|rest| {
        let count = digits(rest);
        let ends = rest[count..].chars().next().is_none_or(|next| !next.is_alphanumeric());
        matches!(count, 3 | 6) && ends
    })?;
    let color = &color[..digits(color)];
    Some(format!("` #` starts a comment: put the color in quotes: `\"#{color}\"`"))
}

/// Advice for text where a number should be.
pub(crate) fn number(node: &Node) -> Option<String> {
    let text = node.text()?;
    if node.is_not_finite() {
        return Some("numbers must be finite".to_owned());
    }
    let with_point = text.replacen(',', ".", 1);
    if text.matches(',').count() == 1 && with_point.parse::<f64>().is_ok() {
        return Some(format!("decimals are written with a point: `{}`", with_point.replace(' ', "")));
    }
    let start = text.trim_end_matches(|c: char| c.is_alphabetic() || c == '°' || c == '%' || c == ' ');
    if start.len() < text.len() && start.parse::<f64>().is_ok() {
        return Some(format!("write the number alone, without a unit: `{start}`"));
    }
    if node.is_quoted() && text.parse::<f64>().is_ok() {
        return Some("remove the quotes".to_owned());
    }
    text.contains(['*', '/', '(']).then(|| "scene files do not calculate: write the result".to_owned())
}

/// Help for a word that is not parted from what belongs to it as it should be: `sphere:{…}`, `sphere {…}`, `radius=1`.
pub(crate) fn glued(text: &str) -> Option<(&str, String)> {
    let text = text.trim();
    let (word, rest) = text.split_at(text.find(|c: char| !c.is_ascii_alphanumeric() && c != '_')?);
    let rest = rest.trim_start();
    if !word.starts_with(|c: char| c.is_ascii_alphabetic()) {
        return None;
    }
    let after = rest.get(1..).unwrap_or_default();
    let value = match after.trim_start().chars().next() {
        Some('{') => "{…}".to_owned(),
        Some('[') => "[…]".to_owned(),
        Some(_) => shorten(after.trim()),
        None => "…".to_owned(),
    };
    let help = match rest.chars().next()? {
        ':' if after.starts_with(|c: char| !c.is_whitespace()) => {
            format!("put a space after the colon: `{word}: {value}`")
        }
        '{' => format!("put a colon and a space after `{word}`: `{word}: {{…}}`"),
        '=' => format!("write `{word}: {value}`"),
        _ => return None,
    };
    Some((word, help))
}

/// Help for the name of a file in place of the fields of a kind that is read from files.
pub(crate) fn file_alone(word: &str, text: &str) -> Option<String> {
    let is_of_files = matches!(word, "image" | "mesh" | "import" | "spheres" | "cylinders" | "cones" | "capsules")
        && text.contains('.');
    is_of_files.then(|| format!("write `{word}: {{file: {}}}`", shorten(text)))
}

fn glued_to(text: &str, known: &[&str]) -> Option<String> {
    glued(text).filter(|(word, _)| known.contains(word)).map(|(_, help)| help)
}

/// Help for a field that `title` does not have.
pub(crate) fn unknown_field(title: &str, name: &str, value: &Node, known: &[&str]) -> String {
    if let Some(help) = glued_to(name, known) {
        return help;
    }
    if STEPS.contains(&name) && known.contains(&"transform") {
        let help = "put it under `transform:`, a list of steps";
        return match name {
            "rotate" => format!("{help}: `transform: [rotate: {{y: 45}}]`"),
            _ => format!("{help}: `transform: [translate: [0, 1, 0], scale: 2]`"),
        };
    }
    if title == "camera" && (name.starts_with("horizontal") || matches!(name, "hfov" | "fovx" | "xfov")) {
        return "`fov` is the vertical angle of view, in degrees".to_owned();
    }
    if matches!(name, "width" | "height" | "resolution") && matches!(title, "scene" | "camera" | "render") {
        return "the picture's size stands under `picture:`: `picture: {width: 640, height: 480}`".to_owned();
    }
    let is_around =
        matches!(title, "scene" | "picture" | "render") || Integrator::WORDS.iter().any(|(word, _)| *word == title);
    if let (true, Some(help)) = (is_around, field_of_path(name, Some(value))) {
        return help;
    }
    if name == "type" || name == "kind" {
        let kind = value.text().unwrap_or("sphere");
        return format!("the kind is written as the key: `- {}: {{…}}`", shorten(kind));
    }
    if title == "scene" && matches!(name, "sphere" | "plane" | "box" | "cylinder" | "cone" | "disc" | "torus") {
        return format!("put it under `objects:`, as a list item: `- {name}: {{…}}`");
    }
    if name == "texture" && known.contains(&"color") {
        return "a texture is given as `color`: `color: {checker: {…}}`, or the name of a texture".to_owned();
    }
    let holder = ["color", "texture"].into_iter().find(|field| known.contains(field));
    if let (Some(field), true) = (holder, Pattern::WORDS.iter().any(|(word, _)| *word == name)) {
        return format!("a texture is given as `{field}`: `{field}: {{{name}: {{…}}}}`");
    }
    if matches!(name, "color" | "colour" | "texture") && known.contains(&"material") {
        return "it is part of the material: `material: {color: …}`".to_owned();
    }
    if known.contains(&"material") && !known.contains(&"color") {
        let common = ["opacity", "emission", "normal_map", "bump"];
        let kinds = Physical::WORDS.iter().map(|(word, _)| *word);
        // What is near to a field of the thing itself is meant as that.
        let is_other = suggest::nearest(name, known.iter().copied()).is_none();
        if let Some(near) =
            suggest::nearest(name, common.into_iter().chain(kinds)).filter(|near| is_other || *near == name)
        {
            return format!("it is part of the material: `material: {{{near}: …}}`");
        }
    }
    if title == "material"
        && let Some(help) = field_of_kinds(name)
    {
        return help;
    }
    if Physical::WORDS.iter().any(|(word, _)| *word == title) && Classic::about().iter().any(|field| field.key == name)
    {
        let fields = suggest::list(known);
        return format!(
            "that is a field of classic materials, which have no `{title}:`; those of `{title}` are {fields}"
        );
    }
    suggest::did_you_mean(name, known, &format!("fields of `{title}`"))
}

/// Help for a field that classic materials do not have, but physical ones do.
fn field_of_kinds(name: &str) -> Option<String> {
    let kinds = Physical::kinds();
    let has = |kind: &&KindAbout| kind.fields.iter().any(|field| field.key == name);
    let words: Vec<&str> = kinds.iter().filter(has).map(|kind| kind.word).collect();
    let last = words.last()?;
    let list = suggest::list(&words);
    Some(format!("that is a field of {list}, of which one would be written `{last}: {{{name}: …}}`"))
}

/// Help for a field that the path tracer alone has.
fn field_of_path(name: &str, value: Option<&Node>) -> Option<String> {
    let has = |fields: Vec<FieldAbout>| fields.iter().any(|field| field.key == name);
    if !has(PathSettings::about()) || has(RenderSettings::about()) {
        return None;
    }
    let value = value.and_then(Node::text).filter(|text| !text.is_empty()).map_or("…".to_owned(), shorten);
    Some(format!("that is a field of `path`: `render: {{integrator: {{path: {{{name}: {value}}}}}}}`"))
}

/// The field of a material of this kind that was probably meant.
fn field_of_material(noun: &str, word: &str, written: &str) -> Option<&'static str> {
    let kind = Physical::kinds().into_iter().find(|kind| noun == "material" && kind.word == word)?;
    let fields = kind.fields.iter().chain(&Common::about()).map(|field| field.key).collect::<Vec<&'static str>>();
    suggest::nearest(written, fields)
}

/// Help for a kind that does not exist.
pub(crate) fn unknown_kind(word: &str, value: Option<&Node>, noun: &str, words: &[&str]) -> String {
    if let Some(help) = glued_to(word, words) {
        return help;
    }
    if (word == "type" || word == "kind") && value.is_some() {
        let kind = value.and_then(Node::text).unwrap_or("sphere");
        return format!("the kind is written as the key: `{}: {{…}}`", shorten(kind));
    }
    if noun == "light" && word == "ambient" {
        return "ambient light is a field of the scene: `ambient: 1`, beside `lights:`".to_owned();
    }
    if let ("integrator", Some(help)) = (noun, field_of_path(word, value)) {
        return help;
    }
    suggest::did_you_mean(word, words, &format!("kinds of {noun}"))
}

/// A mapping where one kind is expected has several keys.
pub(crate) fn several_kinds(first: &Entry, others: &[Entry], noun: &str, words: &[&str]) -> Complaint {
    let entries = || std::iter::once(first).chain(others);
    let name = |entry: &Entry| entry.0.text().unwrap_or_default().to_owned();
    if let Some((_, kind)) = entries().find(|entry| matches!(name(entry).as_str(), "type" | "kind")) {
        let word = shorten(kind.text().unwrap_or("sphere"));
        let complaint = Complaint::error(kind.span, format!("the kind of {noun} is not a field"));
        return complaint.help(format!("the kind is written as the key: `{word}: {{…}}`"));
    }
    let mut kinds = entries().filter(|entry| words.contains(&name(entry).as_str()));
    match (kinds.next(), kinds.next()) {
        (Some(kind), None) => {
            let word = name(kind);
            let stray = entries().find(|entry| name(entry) != word).unwrap_or(first);
            let written = name(stray);
            let message = format!("`{}` must stand in `{word}`, not beside it", shorten(&written));
            let meant = field_of_material(noun, &word, &written).unwrap_or(&written);
            let help = format!("indent it further than `{word}`, or write `{word}: {{{}: …}}`", shorten(meant));
            Complaint::error(stray.0.span, message).help(help).also(kind.0.span, "the kind")
        }
        (Some(kind), Some(second)) => {
            let message = format!("`{}` and `{}` in one {noun}", name(kind), name(second));
            let help = match noun {
                "object" | "light" => format!("begin the second {noun} with `- ` on a line of its own"),
                _ => format!("give one of the two: `{}` or `{}`", name(kind), name(second)),
            };
            Complaint::error(second.0.span, message).help(help).also(kind.0.span, "the first kind")
        }
        (None, _) => {
            let help = unknown_kind(&name(first), Some(&first.1), noun, words);
            Complaint::error(first.0.span, format!("unknown {noun} `{}`", shorten(&name(first)))).help(help)
        }
    }
}

//! Words for the façade's enums.

use crate::numbers::short;
use durer::{Element, NotTraced, RayKind, Source};
use serde_json::{Value, json};

/// In sentences.
pub(super) fn ray(kind: RayKind) -> &'static str {
    match kind {
        RayKind::Eye => "ray of the eye",
        RayKind::Reflected => "reflected ray",
        RayKind::Transmitted => "transmitted ray",
        RayKind::Connected => "ray to a point that a path of this block of pixels has met",
    }
}

/// In JSON.
pub(super) fn ray_key(kind: RayKind) -> &'static str {
    match kind {
        RayKind::Eye => "eye",
        RayKind::Reflected => "reflected",
        RayKind::Transmitted => "transmitted",
        RayKind::Connected => "connected",
    }
}

/// In sentences.
pub(super) fn source(source: Source) -> &'static str {
    match source {
        Source::Fog => "fog on the way",
        Source::Background => "background",
        Source::Emission => "light of its own",
        Source::Ambient => "ambient light",
        Source::Diffuse(_) => "diffuse",
        Source::Specular(_) => "highlight",
        Source::Light(_) => "light that was aimed at",
        Source::Reused => "light that was found there",
        Source::Shown => "what is shown of it",
    }
}

/// In JSON.
pub(super) fn source_key(source: Source) -> &'static str {
    match source {
        Source::Fog => "fog",
        Source::Background => "background",
        Source::Emission => "emission",
        Source::Ambient => "ambient",
        Source::Diffuse(_) => "diffuse",
        Source::Specular(_) => "specular",
        Source::Light(_) => "light",
        Source::Reused => "reused",
        Source::Shown => "shown",
    }
}

/// The light that a contribution comes from, if it is one.
pub(super) fn light_of(source: Source) -> Option<usize> {
    match source {
        Source::Diffuse(light) | Source::Specular(light) => Some(light),
        Source::Light(light) => light,
        Source::Fog | Source::Background | Source::Emission | Source::Ambient | Source::Reused | Source::Shown => None,
    }
}

/// In sentences, after the name of the shape; empty if the shape is but one thing.
pub(super) fn element(element: Element) -> String {
    match element {
        Element::Face(_) => String::new(),
        Element::Triangle { index, weights } => {
            let [a, b, c] = weights.map(|weight| short((weight * 1e4).round() / 1e4));
            format!(", triangle {index} ({a} {b} {c})")
        }
        Element::Particle { index } => format!(", particle {index}"),
        Element::Operand { index } => format!(", shape {index} of the solid"),
    }
}

/// In JSON.
pub(super) fn element_json(element: Element) -> Value {
    match element {
        Element::Face(index) => json!({ "face": index }),
        Element::Triangle { index, weights } => json!({ "triangle": index, "weights": weights }),
        Element::Particle { index } => json!({ "particle": index }),
        Element::Operand { index } => json!({ "operand": index }),
    }
}

/// In sentences.
pub(super) fn why_not(why: NotTraced) -> &'static str {
    match why {
        NotTraced::TooDeep => "deeper than max_depth",
        NotTraced::TooFaint => "too faint to count",
    }
}

/// In JSON.
pub(super) fn why_not_key(why: NotTraced) -> &'static str {
    match why {
        NotTraced::TooDeep => "too_deep",
        NotTraced::TooFaint => "too_faint",
    }
}

//! Words for the façade's enums.

use crate::numbers::short;
use durer::{Element, JunctionExplanation, NotTraced, RayKind, RelativeTo, Source, Way};
use serde_json::{Value, json};

/// In sentences.
pub(super) fn ray(kind: RayKind) -> &'static str {
    match kind {
        RayKind::Eye => "ray of the eye",
        RayKind::Reflected => "reflected ray",
        RayKind::Transmitted => "transmitted ray",
        RayKind::Connected => "ray to a junction",
        RayKind::Cast => "ray aimed through a caster",
    }
}

/// In JSON.
pub(super) fn ray_key(kind: RayKind) -> &'static str {
    match kind {
        RayKind::Eye => "eye",
        RayKind::Reflected => "reflected",
        RayKind::Transmitted => "transmitted",
        RayKind::Connected => "connected",
        RayKind::Cast => "cast",
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
        Source::Reused => "light that leaves it",
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

/// In sentences, after a weight; empty where it is that of all others.
pub(super) fn relative_to(relative_to: RelativeTo) -> &'static str {
    match relative_to {
        RelativeTo::Sample => "",
        RelativeTo::Junction => " relative to the junction",
    }
}

/// In JSON.
pub(super) fn relative_to_key(relative_to: RelativeTo) -> &'static str {
    match relative_to {
        RelativeTo::Sample => "sample",
        RelativeTo::Junction => "junction",
    }
}

/// In sentences.
pub(super) fn way(Way { number, of }: Way) -> String {
    format!("way {number} of {of}")
}

/// In sentences, of the surface that a ray met.
pub(super) fn junction(junction: &JunctionExplanation) -> &'static str {
    match junction {
        JunctionExplanation::Found(arrivals) if arrivals.iter().all(|arrival| arrival.light.is_black()) => {
            "a junction, at which no light arrives"
        }
        JunctionExplanation::Found(_) => {
            "a junction: what arrives is not added up here; all of the block that see it take light from it"
        }
        JunctionExplanation::Left => "ends here: the first way of each sample finds such light, for all of the block",
    }
}

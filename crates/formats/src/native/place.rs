//! From the place of a problem in a scene to the text that it came from.

use super::decode::Decoder;
use super::tree::{Node, NodeKind, Span};
use durer_scene::{Place, Step};
use std::rc::Rc;

/// The text of the value at `place`; if it is not written there (a default is in force), of what it belongs to.
pub(crate) fn span_of(place: &Place, root: &Rc<Node>, read: &Decoder<'_>) -> Span {
    let mut node: &Rc<Node> = root;
    let mut span = compact(node);
    for step in &place.steps {
        let next = match (step, &node.kind) {
            (Step::Field(name), _) => node.get(name).map(|(key, value)| (value, value_or_key(key, value))),
            (Step::Index(at), NodeKind::Sequence(items)) => items.get(*at).map(|item| (item, compact(item))),
            // A single step of a transform may stand without a list.
            (Step::Index(_), NodeKind::Mapping(_) | NodeKind::Scalar { .. }) => None,
            (Step::Material(id), _) => read.material_nodes.get(id.0 as usize).map(|node| (node, compact(node))),
            (Step::Texture(id), _) => read.texture_nodes.get(id.0 as usize).map(|node| (node, compact(node))),
            (Step::Image(id), _) => read.image_nodes.get(id.0 as usize).map(|node| (node, compact(node))),
        };
        match next {
            Some((deeper, there)) => (node, span) = (deeper, there),
            None if matches!(step, Step::Index(_)) => {}
            None => return span,
        }
    }
    span
}

/// All of the value at `place`, which is made of fields alone; `None` if none is written there.
pub(crate) fn whole_span_of(place: &Place, root: &Rc<Node>) -> Option<Span> {
    let deeper = |node: &Rc<Node>, step: &Step| match step {
        Step::Field(name) => node.get(name).map(|(_, value)| Rc::clone(value)),
        Step::Index(_) | Step::Material(_) | Step::Texture(_) | Step::Image(_) => None,
    };
    place.steps.iter().try_fold(Rc::clone(root), |node, step| deeper(&node, step)).map(|node| node.span)
}

/// The value, unless it is so large that its key says more.
fn value_or_key(key: &Node, value: &Node) -> Span {
    match &value.kind {
        NodeKind::Mapping(_) => key.span,
        NodeKind::Scalar { text, .. } if text.is_empty() => key.span,
        NodeKind::Scalar { .. } | NodeKind::Sequence(_) => compact(value),
    }
}

/// A scalar or list as a whole, a mapping by its first key.
fn compact(node: &Node) -> Span {
    match &node.kind {
        NodeKind::Mapping(entries) => entries.first().map_or(node.span, |(key, _)| key.span),
        NodeKind::Scalar { .. } | NodeKind::Sequence(_) => node.span,
    }
}

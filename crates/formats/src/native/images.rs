//! Image files: each is read once, through [`Assets`](crate::Assets).

use super::decode::Decoder;
use super::tree::{Node, shorten};
use crate::diagnostics::Complaint;
use durer_imaging::{Bitmap, DecodeLimits, decode};
use durer_scene::{Channels, ImageAsset, ImageId, Pattern};
use std::rc::Rc;
use std::sync::Arc;

/// The image of the file `name`, or `None` after complaining (at its first use only).
pub(super) fn load(name: &str, node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<ImageId> {
    if let Some(known) = cx.images.get(name) {
        // A file that could not be read has been complained about; any id will do.
        return Some(known.unwrap_or(ImageId(0)));
    }
    let bitmap = read(name, node, cx);
    let id = bitmap.map(|bitmap| enter(name, bitmap, node, cx));
    cx.images.insert(name.to_owned(), id);
    id
}

fn read(name: &str, node: &Node, cx: &mut Decoder<'_>) -> Option<Bitmap> {
    let bytes = match cx.assets.read(name, cx.limits.max_image_bytes) {
        Ok(bytes) => bytes,
        Err(error) => {
            let complaint = Complaint::error(node.span, format!("cannot read the image `{}`", shorten(name)));
            return cx.complain(complaint.label(error.to_string()).maybe_help(error.help()));
        }
    };
    let left = cx.limits.max_texels.saturating_sub(cx.texels);
    let limits = DecodeLimits { max_pixels: left, max_bytes: left.saturating_mul(16) };
    match decode(&bytes, &limits) {
        Ok(bitmap) => Some(bitmap),
        Err(error) => {
            let complaint = Complaint::error(node.span, format!("cannot use the image `{}`", shorten(name)));
            cx.complain(complaint.label(error.to_string()))
        }
    }
}

fn enter(name: &str, bitmap: Bitmap, node: &Rc<Node>, cx: &mut Decoder<'_>) -> ImageId {
    cx.texels += u64::from(bitmap.width) * u64::from(bitmap.height);
    cx.scene.images.push(ImageAsset { file: name.to_owned(), bitmap: Arc::new(bitmap) });
    cx.image_nodes.push(Rc::clone(node));
    ImageId(cx.scene.images.len() as u32 - 1)
}

/// Warns of images with transparent parts of which only the colors are shown. Those that models brought are theirs.
pub(super) fn warn_of_ignored_alpha(cx: &mut Decoder<'_>) {
    let used = |id: ImageId, channels: Channels| {
        let uses =
            |pattern: &Pattern| matches!(pattern, Pattern::Image(it) if it.image == id && it.channels == channels);
        cx.scene.textures.iter().any(|texture| uses(&texture.pattern))
    };
    let own = cx.images.iter().filter_map(|(name, id)| Some((name, (*id)?)));
    let with_alpha = own.filter(|(_, id)| cx.scene.images[id.0 as usize].bitmap.alpha.is_some());
    let ignored = with_alpha.filter(|(_, id)| used(*id, Channels::Color) && !used(*id, Channels::Alpha));
    let warn = |(name, id): (&String, ImageId)| {
        let message = format!("the image `{}` has transparent parts", shorten(name));
        let complaint = Complaint::warning(cx.image_nodes[id.0 as usize].span, message);
        let help = "for holes, show it in the material's `opacity` too, with `channels: alpha`";
        complaint.label("its alpha channel is ignored").help(help)
    };
    let warnings: Vec<Complaint> = ignored.map(warn).collect();
    for warning in warnings {
        let _: Option<()> = cx.complain(warning);
    }
}

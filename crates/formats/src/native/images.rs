//! Image files: each is read once, through [`Assets`](crate::Assets).

use super::decode::Decoder;
use super::tree::{Node, shorten};
use crate::diagnostics::Complaint;
use crate::limits::textures;
use durer_imaging::{Bitmap, decode};
use durer_scene::{Channels, ImageAsset, ImageId, ImageTexture, Pattern};
use std::rc::Rc;
use std::sync::Arc;

/// The image of the file `name`, or `None` after complaining (at its first use only).
pub(super) fn load(name: &str, node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<ImageId> {
    if let Some(known) = cx.images.get(name) {
        // A file that could not be read has been complained about; any id will do, and the check shall say nothing of it.
        if known.is_none() {
            cx.doubtful.push(node.span);
        }
        return Some(known.unwrap_or(ImageId(0)));
    }
    let bitmap = read(name, node, cx);
    let id = bitmap.map(|bitmap| enter(name, bitmap, node, cx));
    cx.images.insert(name.to_owned(), id);
    id
}

fn read(name: &str, node: &Node, cx: &mut Decoder<'_>) -> Option<Bitmap> {
    let bytes = match cx.assets.read(name, cx.limits.max_file_bytes) {
        Ok(bytes) => bytes,
        Err(error) => {
            let complaint = Complaint::error(node.span, format!("cannot read the image `{}`", shorten(name)));
            return cx.complain(complaint.label(error.to_string()).maybe_help(error.help()));
        }
    };
    let limits = textures::left(cx.limits, cx.texture_bytes);
    match decode(&bytes, &limits) {
        Ok(bitmap) => Some(bitmap),
        Err(error) => {
            let complaint = Complaint::error(node.span, format!("cannot use the image `{}`", shorten(name)));
            cx.complain(complaint.label(error.to_string()).maybe_help(textures::help(&error)))
        }
    }
}

fn enter(name: &str, bitmap: Bitmap, node: &Rc<Node>, cx: &mut Decoder<'_>) -> ImageId {
    cx.texture_bytes += bitmap.memory();
    cx.scene.images.push(ImageAsset { file: name.to_owned(), bitmap: Arc::new(bitmap) });
    cx.image_nodes.push(Rc::clone(node));
    ImageId(cx.scene.images.len() as u32 - 1)
}

/// Warns of images with transparent parts of which only the colors are shown. Those that models brought are theirs.
pub(super) fn warn_of_ignored_alpha(cx: &mut Decoder<'_>) {
    let mut shows_color = vec![false; cx.scene.images.len()];
    let mut shows_alpha = shows_color.clone();
    for texture in &cx.scene.textures {
        if let Pattern::Image(ImageTexture { image: ImageId(id), channels, .. }) = texture.pattern {
            let shows = if channels == Channels::Alpha { &mut shows_alpha } else { &mut shows_color };
            // An image that could not be read has a number, but no place.
            if let Some(shows) = shows.get_mut(id as usize) {
                *shows = true;
            }
        }
    }
    let mut warnings = Vec::new();
    for (name, id) in cx.images.iter().filter_map(|(name, id)| Some((name, id.as_ref()?.0 as usize))) {
        let has_alpha = cx.scene.images[id].bitmap.alpha.is_some();
        if has_alpha && shows_color[id] && !shows_alpha[id] {
            let message = format!("the image `{}` has transparent parts", shorten(name));
            let complaint = Complaint::warning(cx.image_nodes[id].span, message);
            let help = "for holes, show it in the material's `opacity` too, with `channels: alpha`";
            warnings.push(complaint.label("its alpha channel is ignored").help(help));
        }
    }
    for warning in warnings {
        let _: Option<()> = cx.complain(warning);
    }
}

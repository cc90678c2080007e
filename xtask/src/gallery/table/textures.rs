//! Textures.

use super::{Entry, FINE, Picture};

pub(super) const ENTRIES: &[Entry] = &[
    Entry {
        heading: "Textures",
        text: "All eight: above checker, stripes, rings and gradient; below image, noise, marble and wood.",
        pictures: &[Picture {
            name: "textures",
            caption: "eight balls with different textures",
            scene: "scenes/gallery/textures.yaml",
            ..FINE
        }],
    },
    Entry {
        heading: "An image on a shape",
        text: "A picture laid around a cylinder.",
        pictures: &[
            Picture { name: "texture-off", caption: "without", scene: "scenes/gallery/texture-off.yaml", ..FINE },
            Picture { name: "texture-on", caption: "with the image", scene: "scenes/gallery/texture-on.yaml", ..FINE },
        ],
    },
];

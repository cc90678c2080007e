//! Fog and sky.

use super::{Entry, FINE, Picture};

pub(super) const ENTRIES: &[Entry] = &[
    Entry {
        heading: "Fog",
        text: "An avenue in clear air, in fog that thickens evenly, and in fog with a beginning and an end.",
        pictures: &[
            Picture { name: "fog-off", caption: "none", scene: "scenes/gallery/fog-off.yaml", ..FINE },
            Picture {
                name: "fog-exponential",
                caption: "exponential",
                scene: "scenes/gallery/fog-exponential.yaml",
                ..FINE
            },
            Picture { name: "fog-linear", caption: "linear", scene: "scenes/gallery/fog-linear.yaml", ..FINE },
        ],
    },
    Entry {
        heading: "A sky",
        text: "A background that goes from one color at the bottom to another at the top.",
        pictures: &[Picture {
            name: "sky",
            caption: "a mirroring ball under an evening sky",
            scene: "scenes/gallery/sky.yaml",
            ..FINE
        }],
    },
];

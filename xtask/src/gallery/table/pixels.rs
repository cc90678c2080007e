//! From rays to pixels.

use super::{Entry, Picture, RENDERED};

pub(super) const ENTRIES: &[Entry] = &[
    Entry {
        heading: "Anti-aliasing",
        text: "One ray for each pixel leaves stairs on edges and breaks up fine patterns. A grid sends the same \
               number of rays everywhere, the recursive method more only where they differ.",
        pictures: &[
            Picture {
                name: "antialias-none",
                caption: "one ray a pixel",
                scene: "scenes/gallery/antialias.yaml",
                arguments: &["--antialias", "none"],
                ..RENDERED
            },
            Picture {
                name: "antialias-grid",
                caption: "a grid of 3 × 3",
                scene: "scenes/gallery/antialias.yaml",
                arguments: &["--antialias", "grid:3"],
                ..RENDERED
            },
            Picture {
                name: "antialias-recursive",
                caption: "recursive",
                scene: "scenes/gallery/antialias.yaml",
                arguments: &["--antialias", "recursive:0.1,4"],
                ..RENDERED
            },
        ],
    },
    Entry {
        heading: "Thinner than a pixel",
        text: "Wires down to a tenth of a pixel, specks of dust down to a fifth of one, and a fence far away. Under the \
               adaptive method, the default, each of them is looked for where it is; the others find what their rays happen \
               to meet. From left to right these took 38, 870, 88 and 850 thousand rays of the eye.",
        pictures: &[
            Picture {
                name: "thin-none",
                caption: "one ray a pixel",
                scene: "scenes/gallery/thin-things.yaml",
                arguments: &["--antialias", "none"],
                ..RENDERED
            },
            Picture {
                name: "thin-recursive",
                caption: "recursive",
                scene: "scenes/gallery/thin-things.yaml",
                arguments: &["--antialias", "recursive"],
                ..RENDERED
            },
            Picture {
                name: "thin-pov2",
                caption: "POV-Ray's method 2",
                scene: "scenes/gallery/thin-things.yaml",
                arguments: &["--antialias", "pov2"],
                ..RENDERED
            },
            Picture {
                name: "thin-adaptive",
                caption: "adaptive",
                scene: "scenes/gallery/thin-things.yaml",
                arguments: &["--antialias", "adaptive"],
                ..RENDERED
            },
        ],
    },
    Entry {
        heading: "Encoding",
        text: "Screens expect numbers encoded by the sRGB curve. The room's first version sent the linear numbers \
               to the screen as they were, which makes all but the brightest darker.",
        pictures: &[
            Picture {
                name: "room-srgb",
                caption: "`--transfer srgb`",
                scene: "scenes/room.yaml",
                arguments: &["--width", "320", "--antialias", "grid:4"],
                ..RENDERED
            },
            Picture {
                name: "room-linear",
                caption: "`--transfer linear`",
                scene: "scenes/room.yaml",
                arguments: &["--width", "320", "--antialias", "grid:4", "--transfer", "linear"],
                ..RENDERED
            },
        ],
    },
];

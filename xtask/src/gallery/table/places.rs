//! Where things stand, and from where they are seen.

use super::{Entry, FINE, Picture, RENDERED};

pub(super) const ENTRIES: &[Entry] = &[
    Entry {
        heading: "Transforms",
        text: "A ball is scaled to an ellipsoid, turned and moved; its texture goes with it.",
        pictures: &[
            Picture {
                name: "transform-before",
                caption: "before",
                scene: "scenes/gallery/transform-before.yaml",
                ..FINE
            },
            Picture {
                name: "transform-after",
                caption: "after scaling, turning and moving",
                scene: "scenes/gallery/transform-after.yaml",
                ..FINE
            },
        ],
    },
    Entry {
        heading: "Groups",
        text: "A chair is built once and used four times; its parts take their material from the group, unless the \
               group has another.",
        pictures: &[Picture {
            name: "groups",
            caption: "a round table and four chairs, one of them red",
            scene: "scenes/gallery/groups.yaml",
            ..FINE
        }],
    },
    Entry {
        heading: "A wood",
        text: "2800 firs in the mist, and the same view as a heatmap: the brighter a pixel, the more of the scene \
               was looked at to find what is there.",
        pictures: &[
            Picture { name: "wood", caption: "the wood", scene: "scenes/gallery/wood.yaml", ..FINE },
            Picture {
                name: "wood-heat",
                caption: "`durer heatmap`",
                command: "heatmap",
                scene: "scenes/gallery/wood.yaml",
                ..RENDERED
            },
        ],
    },
    Entry {
        heading: "Cameras",
        text: "Perspective and parallel projection.",
        pictures: &[
            Picture { name: "perspective", caption: "perspective", scene: "scenes/gallery/perspective.yaml", ..FINE },
            Picture {
                name: "orthographic",
                caption: "parallel projection",
                scene: "scenes/gallery/orthographic.yaml",
                ..FINE
            },
        ],
    },
];

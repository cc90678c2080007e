//! Lights.

use super::{Entry, FINE, Picture};

pub(super) const ENTRIES: &[Entry] = &[
    Entry {
        heading: "Lights and shadows",
        text: "Every lamp throws shadows; where those of two lamps overlap it is dark.",
        pictures: &[
            Picture { name: "lights-one", caption: "one lamp", scene: "scenes/gallery/lights-one.yaml", ..FINE },
            Picture { name: "lights-two", caption: "two lamps", scene: "scenes/gallery/lights-two.yaml", ..FINE },
        ],
    },
    Entry {
        heading: "Far and near lights",
        text: "The sun's shadows are parallel, those of a lamp point away from it.",
        pictures: &[
            Picture {
                name: "directional",
                caption: "directional light",
                scene: "scenes/gallery/directional.yaml",
                ..FINE
            },
            Picture { name: "point", caption: "a point light", scene: "scenes/gallery/point.yaml", ..FINE },
        ],
    },
    Entry {
        heading: "A spotlight",
        text: "A spotlight throws a round shadow of the middle ball on the back wall. Its edge is hard or soft.",
        pictures: &[
            Picture { name: "spot-off", caption: "off", scene: "scenes/gallery/spot-off.yaml", ..FINE },
            Picture { name: "spot-on", caption: "on", scene: "scenes/gallery/spot-on.yaml", ..FINE },
            Picture { name: "spot-soft", caption: "with a soft edge", scene: "scenes/gallery/spot-soft.yaml", ..FINE },
        ],
    },
    Entry {
        heading: "Falloff",
        text: "Light that stays as strong as it is, as in classic ray tracing, and light that weakens with the \
               square of the distance, as light does.",
        pictures: &[
            Picture {
                name: "falloff-none",
                caption: "`falloff: none`",
                scene: "scenes/gallery/falloff-none.yaml",
                ..FINE
            },
            Picture {
                name: "falloff-inverse-square",
                caption: "`falloff: inverse_square`",
                scene: "scenes/gallery/falloff-inverse-square.yaml",
                ..FINE
            },
        ],
    },
];

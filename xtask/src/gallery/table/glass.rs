//! Mirrors, and what light goes through.

use super::{Entry, FINE, Picture, RENDERED};

pub(super) const ENTRIES: &[Entry] = &[
    Entry {
        heading: "A mirror",
        text: "A plain sheet, and the same sheet reflecting 80 % of the light.",
        pictures: &[
            Picture { name: "mirror-off", caption: "off", scene: "scenes/gallery/mirror-off.yaml", ..FINE },
            Picture { name: "mirror-on", caption: "on", scene: "scenes/gallery/mirror-on.yaml", ..FINE },
        ],
    },
    Entry {
        heading: "Depth of recursion",
        text: "Two mirrors face each other; a ray is followed as often as `max_depth` says.",
        pictures: &[
            Picture {
                name: "mirrors-2",
                caption: "depth 2",
                scene: "scenes/gallery/mirrors.yaml",
                arguments: &["--max-depth", "2", "--antialias", "grid:4"],
                ..RENDERED
            },
            Picture {
                name: "mirrors-5",
                caption: "depth 5",
                scene: "scenes/gallery/mirrors.yaml",
                arguments: &["--max-depth", "5", "--antialias", "grid:4"],
                ..RENDERED
            },
            Picture { name: "mirrors-20", caption: "depth 20", scene: "scenes/gallery/mirrors.yaml", ..FINE },
        ],
    },
    Entry {
        heading: "Clear, refracting, glass",
        text: "A clear ball lets light go straight through; one with an index of refraction bends it; with \
               Fresnel's equations it mirrors, too, as glass does.",
        pictures: &[
            Picture { name: "clear", caption: "clear", scene: "scenes/gallery/clear.yaml", ..FINE },
            Picture { name: "refractive", caption: "refracting", scene: "scenes/gallery/refractive.yaml", ..FINE },
            Picture { name: "glass", caption: "glass", scene: "scenes/gallery/glass.yaml", ..FINE },
        ],
    },
    Entry {
        heading: "Lenses",
        text: "What two balls have in common makes larger; what they leave of a disc makes smaller.",
        pictures: &[
            Picture {
                name: "lens-convex",
                caption: "an intersection",
                scene: "scenes/gallery/lens-convex.yaml",
                ..FINE
            },
            Picture {
                name: "lens-concave",
                caption: "a difference",
                scene: "scenes/gallery/lens-concave.yaml",
                ..FINE
            },
        ],
    },
    Entry {
        heading: "Fresnel",
        text: "Water is clear where one looks down and a mirror where one looks along it.",
        pictures: &[
            Picture {
                name: "fresnel-off",
                caption: "without Fresnel's equations",
                scene: "scenes/gallery/fresnel-off.yaml",
                ..FINE
            },
            Picture { name: "fresnel-on", caption: "with them", scene: "scenes/gallery/fresnel-on.yaml", ..FINE },
        ],
    },
    Entry {
        heading: "Colored glass",
        text: "Glass takes color from light with distance (Beer–Lambert), so one material makes all five slabs, and \
               their shadows.",
        pictures: &[Picture {
            name: "colored-glass",
            caption: "five slabs of green glass of rising thickness, and two ruby balls",
            scene: "scenes/gallery/colored-glass.yaml",
            ..FINE
        }],
    },
    Entry {
        heading: "Glass in glass",
        text: "A solid glass ball, one with a bubble of air, one with a denser ball inside. Media nest without \
               tricks at their boundaries.",
        pictures: &[Picture {
            name: "bubble",
            caption: "three glass balls before a striped wall",
            scene: "scenes/gallery/bubble.yaml",
            ..FINE
        }],
    },
    Entry {
        heading: "Under water",
        text: "A glass ball and a bubble of air in a tank of water; and the eye inside of a ball of glass.",
        pictures: &[
            Picture {
                name: "aquarium",
                caption: "glass and air in water",
                scene: "scenes/gallery/aquarium.yaml",
                ..FINE
            },
            Picture {
                name: "inside-glass",
                caption: "the eye in glass",
                scene: "scenes/gallery/inside-glass.yaml",
                ..FINE
            },
        ],
    },
    Entry {
        heading: "Total internal reflection",
        text: "Under water, looking up: beyond 48.6° from straight up nothing gets through, and the surface mirrors \
               the pool.",
        pictures: &[Picture {
            name: "total-reflection",
            caption: "a tiled pool from below the surface",
            scene: "scenes/gallery/total-reflection.yaml",
            ..FINE
        }],
    },
];

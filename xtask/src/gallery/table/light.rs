//! Light as it is: path tracing.

use super::{Entry, Picture, RENDERED};

pub(super) const ENTRIES: &[Entry] = &[
    Entry {
        heading: "The room, lit",
        text: "The same walls and things as plaster, glass, gold and glaze, under lanterns that have a size. The mirror, the \
               colors that walls give each other and the light under the glass come by themselves.",
        pictures: &[Picture {
            name: "room-lit",
            caption: "a room with balls of glass, a golden ellipsoid and cones on a checkered table, in the light of lanterns",
            scene: "scenes/room-lit.yaml",
            arguments: &["--samples", "1600"],
            ..RENDERED
        }],
    },
    Entry {
        heading: "Soft light",
        text: "A goblet of wine, made of exact shapes cut from each other, gold, steel, lacquer, frosted glass and chalk under \
               a large light and a small one. The wine is a glass of lower priority: it fills what it overlaps.",
        pictures: &[Picture {
            name: "soft-light",
            caption: "a goblet of red wine between a golden ball, a steel drum, a red ring and a block of frosted glass",
            scene: "scenes/gallery/soft-light.yaml",
            arguments: &["--samples", "1600"],
            ..RENDERED
        }],
    },
    Entry {
        heading: "Light through glass",
        text: "Balls and cylinders gather the light of a sun in an environment map. It is aimed at through them, so that these lines \
               and spots become clean as soon as the rest.",
        pictures: &[Picture {
            name: "caustics",
            caption: "balls and cylinders of glass, gold and silver on a floor, with bright lines and spots in and beside their shadows",
            scene: "scenes/gallery/caustics.yaml",
            arguments: &["--samples", "1024"],
            ..RENDERED
        }],
    },
    Entry {
        heading: "The Cornell box",
        text: "With the numbers of Mitsuba's; a test compares blocks of pixels with a reference.",
        pictures: &[Picture {
            name: "cornell",
            caption: "two white boxes between a red and a green wall under a lamp",
            scene: "scenes/cornell.yaml",
            arguments: &["--width", "320", "--height", "320", "--samples", "256"],
            ..RENDERED
        }],
    },
    Entry {
        heading: "Two ways to find light",
        text: "Aiming at lamps finds what rough plates show of large ones badly, following the mirror finds small ones badly; \
               both together find all.",
        pictures: &[Picture {
            name: "veach",
            caption: "four balls of light of different sizes, mirrored in four plates from smooth to rough",
            scene: "scenes/gallery/veach.yaml",
            arguments: &["--samples", "256"],
            ..RENDERED
        }],
    },
];

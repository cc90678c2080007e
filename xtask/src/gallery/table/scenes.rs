//! Whole scenes.

use super::{Entry, Picture, RENDERED};

pub(super) const ENTRIES: &[Entry] = &[
    Entry {
        heading: "The room",
        text: "Where durer comes from, a student's ray tracer of years ago: planes, spheres, cylinders and cones, a \
               mirror, a clear and a refracting ball, an image on a cylinder, two lamps, a spotlight, and fog.",
        pictures: &[Picture {
            name: "room",
            caption: "a room with balls, cones and cylinders on a checkered table",
            scene: "scenes/room.yaml",
            arguments: &["--width", "640", "--antialias", "grid:4"],
            ..RENDERED
        }],
    },
    Entry {
        heading: "A still life",
        text: "After Dürer's engraving Melencolia I: the solid, the ball, the ladder, the hourglass, the dividers, \
               the magic square.",
        pictures: &[Picture {
            name: "melencolia",
            caption: "a marble solid, balls of stone, glass and brass, an hourglass and a ladder in a dark room",
            scene: "scenes/gallery/melencolia.yaml",
            ..RENDERED
        }],
    },
    Entry {
        heading: "Five lines",
        text: "Everything that a scene does not say has a default: camera, lights, sky and size of the picture.",
        pictures: &[Picture {
            name: "five-lines",
            caption: "a ball, a cone and a cylinder on a checkered floor",
            scene: "scenes/gallery/five-lines.yaml",
            arguments: &["--width", "480"],
            ..RENDERED
        }],
    },
];

//! What is in the gallery, in the order of the page. A new picture is one more entry here and a scene in `scenes/`.

/// One heading of the page: a picture, or two that differ in one thing.
pub(crate) struct Entry {
    pub(crate) heading: &'static str,
    /// One or two sentences.
    pub(crate) text: &'static str,
    /// One picture, or two to be shown side by side.
    pub(crate) pictures: &'static [Picture],
}

/// One picture.
pub(crate) struct Picture {
    /// Name of its file in docs/gallery, without extension.
    pub(crate) name: &'static str,
    /// What is to be seen, in a few words: stands above one of a pair, and for those who cannot see it.
    pub(crate) caption: &'static str,
    /// The scene, from the root of the repository.
    pub(crate) scene: &'static str,
    /// More for the command line.
    pub(crate) arguments: &'static [&'static str],
}

impl Picture {
    /// Name of its file.
    pub(crate) fn file(&self) -> String {
        format!("{}.png", self.name)
    }

    /// The command that makes it.
    pub(crate) fn command(&self) -> String {
        let words = ["durer", "render", self.scene, "-o"].into_iter().map(str::to_owned);
        let arguments = self.arguments.iter().map(|word| (*word).to_owned());
        words.chain([self.file()]).chain(arguments).collect::<Vec<_>>().join(" ")
    }
}

/// The gallery.
pub(crate) const ENTRIES: &[Entry] = &[
    Entry {
        heading: "The seed's room",
        text: "Where durer comes from: planes, spheres, cylinders and cones, a mirror, a clear and a refracting ball, \
               an image on a cylinder, two lamps, a spotlight, and fog.",
        pictures: &[Picture {
            name: "room",
            caption: "a room with balls, cones and cylinders on a checkered table",
            scene: "scenes/room.yaml",
            arguments: &["--width", "640", "--antialias", "grid:4"],
        }],
    },
    Entry {
        heading: "Five lines",
        text: "Everything that a scene does not say has a default: camera, lights, sky and size of the picture.",
        pictures: &[Picture {
            name: "five-lines",
            caption: "a ball, a cylinder and a cone on a checkered floor",
            scene: "scenes/gallery/five-lines.yaml",
            arguments: &[],
        }],
    },
    Entry {
        heading: "Anti-aliasing",
        text: "One ray for each pixel leaves stairs on edges and breaks up far checkers; the seed's recursive \
               anti-aliasing sends more rays only where they differ.",
        pictures: &[
            Picture {
                name: "antialias-none",
                caption: "one ray a pixel",
                scene: "scenes/gallery/antialias.yaml",
                arguments: &["--antialias", "none"],
            },
            Picture {
                name: "antialias-recursive",
                caption: "recursive anti-aliasing",
                scene: "scenes/gallery/antialias.yaml",
                arguments: &["--antialias", "recursive:0.1,4"],
            },
        ],
    },
];

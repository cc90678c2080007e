//! What is in the gallery, in the order of the page: a theme a file. A new picture is one more entry in one of them, and a
//! scene in `scenes/`.

mod air;
mod glass;
mod light;
mod lights;
mod pixels;
mod places;
mod scenes;
mod shapes;
mod textures;

/// One heading of the page: a picture, or some that differ in one thing.
pub(crate) struct Entry {
    pub(crate) heading: &'static str,
    /// One or two sentences.
    pub(crate) text: &'static str,
    /// One picture, or some to be shown side by side.
    pub(crate) pictures: &'static [Picture],
}

/// One picture.
pub(crate) struct Picture {
    /// Name of its file in docs/gallery, without extension.
    pub(crate) name: &'static str,
    /// What is to be seen, in a few words: stands above one of several, and for those who cannot see it.
    pub(crate) caption: &'static str,
    /// What of `durer` makes it: `render` or `heatmap`.
    pub(crate) command: &'static str,
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

    /// What one types to make it.
    pub(crate) fn command_line(&self) -> String {
        let words = ["durer", self.command, self.scene, "-o"].into_iter().map(str::to_owned);
        let arguments = self.arguments.iter().map(|word| (*word).to_owned());
        words.chain([self.file()]).chain(arguments).collect::<Vec<_>>().join(" ")
    }
}

/// What most pictures are: rendered as the scene says.
const RENDERED: Picture = Picture { name: "", caption: "", command: "render", scene: "", arguments: &[] };

/// With sixteen rays a pixel.
const FINE: Picture = Picture { arguments: &["--antialias", "grid:4"], ..RENDERED };

/// The gallery.
const THEMES: &[&[Entry]] = &[
    scenes::ENTRIES,
    light::ENTRIES,
    shapes::ENTRIES,
    textures::ENTRIES,
    places::ENTRIES,
    lights::ENTRIES,
    glass::ENTRIES,
    air::ENTRIES,
    pixels::ENTRIES,
];

/// All entries, in the order of the page.
pub(crate) fn entries() -> impl Iterator<Item = &'static Entry> {
    THEMES.iter().copied().flatten()
}

//! The page of the gallery.

use super::table::{Entry, Picture};

const HEAD: &str = "<!-- Made by `cargo xtask gallery` from xtask/src/gallery/table/: edit that. -->\n\n# Gallery\n\n\
    Every picture with the command that made it; run it in the root of the repository.\n";

/// The whole page.
pub(crate) fn markdown<'a>(entries: impl Iterator<Item = &'a Entry>) -> String {
    entries.fold(HEAD.to_owned(), |page, entry| page + &section(entry))
}

fn section(entry: &Entry) -> String {
    let pictures = match entry.pictures {
        [one] => image(one),
        several => table(several),
    };
    let commands: Vec<String> = entry.pictures.iter().map(Picture::command_line).collect();
    let Entry { heading, text, .. } = entry;
    format!("\n## {heading}\n\n{text}\n\n{pictures}\n\n```sh\n{}\n```\n", commands.join("\n"))
}

fn table(pictures: &[Picture]) -> String {
    let row = |cell: &dyn Fn(&Picture) -> String| {
        let cells: Vec<String> = pictures.iter().map(cell).collect();
        format!("| {} |", cells.join(" | "))
    };
    let captions = row(&|picture| picture.caption.to_owned());
    let rule = row(&|_| "---".to_owned());
    format!("{captions}\n{rule}\n{}", row(&image))
}

fn image(picture: &Picture) -> String {
    format!("![{}]({})", picture.caption, picture.file())
}

#[cfg(test)]
mod tests {
    use super::*;

    const ONE: Picture =
        Picture { name: "a", caption: "fog", command: "render", scene: "scenes/a.yaml", arguments: &["--width", "9"] };

    #[test]
    fn pairs_stand_side_by_side() {
        let entry = Entry {
            heading: "Fog",
            text: "On and off.",
            pictures: &[ONE, Picture { name: "b", command: "heatmap", ..ONE }],
        };
        let page = markdown([entry].iter());
        assert!(page.contains("| fog | fog |\n| --- | --- |\n| ![fog](a.png) | ![fog](b.png) |"), "{page}");
        assert!(page.contains("durer heatmap scenes/a.yaml -o b.png --width 9\n"), "{page}");
    }
}

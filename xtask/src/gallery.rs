//! `cargo xtask gallery`: renders the pictures of docs/gallery and writes the page that shows them.
//!
//! What is in the gallery stands in [`table`]; scenes are in `scenes/`. Pictures are stored with the best lossless
//! compression, for they stay in the repository.

mod page;
mod shrink;
mod table;

use crate::shell;
use std::path::Path;
use std::process::Command;
use table::Picture;

const FOLDER: &str = "docs/gallery";

/// No picture may be larger, in bytes.
const LARGEST: usize = 300_000;

/// Renders the pictures with these names, or all, and writes the page.
pub(crate) fn run(names: &[&str]) -> Result<(), String> {
    let known = || table::entries().flat_map(|entry| entry.pictures);
    if let Some(unknown) = names.iter().find(|name| known().all(|picture| picture.name != **name)) {
        return Err(format!("there is no picture `{unknown}` in xtask/src/gallery/table/"));
    }
    let durer = shell::build_durer()?;
    let mut failures = Vec::new();
    for picture in known().filter(|picture| names.is_empty() || names.contains(&picture.name)) {
        match render(&durer, picture) {
            Ok(bytes) => println!("{}: {} kB", picture.file(), bytes / 1000),
            Err(message) => failures.push(message),
        }
    }
    shell::write(&shell::root().join(FOLDER).join("README.md"), page::markdown(table::entries()))?;
    if failures.is_empty() { Ok(()) } else { Err(failures.join("\n")) }
}

/// Renders one picture and gives the size of its file.
fn render(durer: &Path, picture: &Picture) -> Result<usize, String> {
    let path = shell::root().join(FOLDER).join(picture.file());
    shell::write(&path, [])?;
    let mut command = Command::new(durer);
    command.args([picture.command, picture.scene, "--quiet", "--output"]).arg(&path).args(picture.arguments);
    let rendered = shell::output(command.current_dir(shell::root())).and_then(|_| shrink::shrink(&path));
    match rendered {
        Ok(bytes) if bytes <= LARGEST => Ok(bytes),
        Ok(bytes) => Err(format!("{}: {bytes} bytes are too many: at most {LARGEST}", path.display())),
        Err(message) => {
            // What is left is no picture.
            let _ = std::fs::remove_file(&path);
            Err(message)
        }
    }
}

//! The library in a few lines: renders the scene file named first into the picture file named second.
#![allow(clippy::print_stderr, reason = "an example program")]

use durer::imaging::{EncodeOptions, FileFormat};
use std::path::Path;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().collect();
    let [_, scene, picture] = arguments.as_slice() else { return Err("usage: render SCENE PICTURE".into()) };
    let loaded = durer::load_file(scene, &durer::LoadOptions::default())?;
    let film = durer::render(&durer::compile(&loaded.scene), &durer::RenderOptions::default(), &())?;
    let options = EncodeOptions {
        transfer: loaded.scene.scene().picture.transfer,
        ..EncodeOptions::new(FileFormat::from_path(Path::new(picture))?)
    };
    durer::PictureFile::create(Path::new(picture))?.write(&film.develop(), &options)?;
    Ok(())
}

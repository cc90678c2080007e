//! Scene files to scenes and back, with good messages.
//!
//! [`load_file`] and [`load_str`] read and check a scene and report everything that is wrong at once; [`to_yaml`]
//! writes one; [`json_schema`] and [`reference_markdown`] say what files may contain. All four come from one
//! definition of each field, in `native`.

mod assets;
mod data;
mod diagnostics;
mod models;
mod native;
mod sources;

pub use assets::memory::MemoryAssets;
pub use assets::{AssetError, Assets, FolderAssets, NoAssets};
pub use diagnostics::{Diagnostic, Diagnostics, Related, Severity};
pub use native::{json_schema, reference_markdown, to_yaml};
pub use sources::{Sources, scene_fingerprint};

use diagnostics::Complaint;
use durer_scene::CheckedScene;
use native::tree::Span;
use sources::Remembering;
use std::io::Read;
use std::path::{Path, PathBuf};

/// How much a scene file may ask for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Bytes of the file.
    pub max_bytes: u64,
    /// Lists in mappings in lists …; at most 200, whatever is set.
    pub max_nesting: usize,
    /// Values in the file, those of aliases counted at each use.
    pub max_values: usize,
    /// Pixels of all images together.
    pub max_texels: u64,
    /// Bytes of one image file.
    pub max_image_bytes: u64,
    /// Bytes of one model file, and of each of its parts.
    pub max_model_bytes: u64,
    /// Triangles of one model file.
    pub max_triangles: u64,
    /// Bytes of one file with a table of numbers.
    pub max_data_bytes: u64,
    /// Diagnostics that are reported; the rest is counted.
    pub max_diagnostics: usize,
}

impl Default for Limits {
    /// Enough for any scene by hand and most by program.
    fn default() -> Limits {
        Limits {
            max_bytes: 64 << 20,
            max_nesting: 200,
            max_values: 5_000_000,
            max_texels: 256_000_000,
            max_image_bytes: 256 << 20,
            max_model_bytes: 8 << 30,
            max_triangles: 400_000_000,
            max_data_bytes: 4 << 30,
            max_diagnostics: 50,
        }
    }
}

/// How to load a file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LoadOptions {
    /// Folders that images may come from, beside the scene's own.
    pub allowed_folders: Vec<PathBuf>,
    /// How much the file may ask for.
    pub limits: Limits,
}

/// A scene that can be rendered.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// The scene.
    pub scene: CheckedScene,
    /// What is worth a look in spite of that.
    pub warnings: Diagnostics,
    /// The files that it named.
    pub sources: Sources,
}

/// Reads and checks the scene file at `path`; files that it names are looked for in its folder. A model file, as its
/// ending tells, becomes a scene that shows the model.
///
/// # Errors
///
/// Everything that is wrong with the file.
pub fn load_file(path: impl AsRef<Path>, options: &LoadOptions) -> Result<Loaded, Diagnostics> {
    let path = path.as_ref();
    let name = path.display().to_string();
    let bytes = match models::is_model_name(&name) {
        true => assets::read_whole(path, options.limits.max_model_bytes).map_err(|error| error.to_string()),
        false => read(path, options.limits.max_bytes),
    };
    let bytes = bytes.map_err(|message| {
        let complaint = Complaint::error(Span::default(), format!("cannot read this file: {message}"));
        Diagnostics::new(vec![complaint], &name, "", 1)
    })?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let assets = FolderAssets::new(folder);
    let assets = options.allowed_folders.iter().fold(assets, FolderAssets::allow);
    load_bytes(&bytes, &name, &assets, &options.limits)
}

fn read(path: &Path, limit: u64) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    let file = std::fs::File::open(path).map_err(|error| error.to_string())?;
    // One byte more than allowed is enough to see that it is too many.
    let mut file = file.take(limit.saturating_add(1));
    file.read_to_end(&mut bytes).map_err(|error| error.to_string())?;
    Ok(bytes)
}

/// Reads and checks the scene in `bytes`, which messages call `name`; or a model, if the name ends as those of models do.
///
/// # Errors
///
/// Everything that is wrong with it; among it that a scene is not UTF-8.
pub fn load_bytes(bytes: &[u8], name: &str, assets: &dyn Assets, limits: &Limits) -> Result<Loaded, Diagnostics> {
    if models::is_model_name(name) {
        return models::load(bytes, name, assets, limits);
    }
    match std::str::from_utf8(bytes) {
        Ok(text) => load_str(text, name, assets, limits),
        Err(error) => {
            let end = bytes.len().min(error.valid_up_to() + 200);
            let shown = String::from_utf8_lossy(&bytes[..end]);
            let at = error.valid_up_to();
            let complaint = Complaint::error(Span::new(at, at + 3), "this file is not UTF-8 text");
            let complaint = complaint.help("save it as UTF-8");
            Err(Diagnostics::new(vec![complaint], name, &shown, 1))
        }
    }
}

/// Reads and checks the scene in `text`, which messages call `name`.
///
/// # Errors
///
/// Everything that is wrong with it.
pub fn load_str(text: &str, name: &str, assets: &dyn Assets, limits: &Limits) -> Result<Loaded, Diagnostics> {
    if text.len() as u64 > limits.max_bytes {
        let message = format!("this file is larger than {} bytes", limits.max_bytes);
        return Err(Diagnostics::new(vec![Complaint::error(Span::default(), message)], name, "", 1));
    }
    let assets = Remembering::new(assets);
    let (scene, complaints) = native::load(text, &assets, limits);
    let diagnostics = Diagnostics::new(complaints, name, text, limits.max_diagnostics);
    match scene {
        Some(scene) => Ok(Loaded { scene, warnings: diagnostics, sources: assets.into_sources() }),
        None => Err(diagnostics),
    }
}

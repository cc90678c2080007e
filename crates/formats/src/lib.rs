//! Scene files to scenes and back, with good messages.
//!
//! [`load_file`] and [`load_str`] read and check a scene and report everything that is wrong at once; [`to_yaml`]
//! writes one; [`json_schema`] and [`reference_markdown`] say what files may contain. All four come from one
//! definition of each field, in `native`.

mod assets;
mod data;
mod diagnostics;
mod limits;
mod models;
mod native;
mod overlay;
mod sources;

pub use assets::memory::MemoryAssets;
pub use assets::{AssetError, Assets, FolderAssets, NoAssets};
pub use diagnostics::{Diagnostic, Diagnostics, Related, Severity};
pub use limits::{Exceeded, Limit, Limits};
pub use native::{json_schema, reference_markdown, to_yaml};
pub use overlay::Overlay;
pub use sources::{Sources, scene_fingerprint};

use assets::Metered;
use diagnostics::Complaint;
use durer_math::Fingerprint;
use durer_scene::{CheckedScene, Picture, RenderSettings};
use native::tree::Span;
use sources::Remembering;
use std::path::{Path, PathBuf};

/// How to load a file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LoadOptions {
    /// Folders that files may come from, beside the scene's own.
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
    /// The settings of the file itself, under those that were laid over them.
    written: (Picture, RenderSettings),
}

impl Loaded {
    /// The [`scene_fingerprint`] of the scene as its file has it: without what was laid over it.
    pub fn fingerprint(&self) -> Fingerprint {
        sources::fingerprint(native::write(self.scene.scene(), self.written), &self.sources)
    }
}

/// Reads and checks the scene file at `path`; files that it names are looked for in its folder. A model file, as its
/// ending tells, becomes a scene that shows the model.
///
/// # Errors
///
/// Everything that is wrong with the file.
pub fn load_file(path: impl AsRef<Path>, options: &LoadOptions) -> Result<Loaded, Diagnostics> {
    load_file_under(path, options, &())
}

/// As [`load_file`], with settings that win over those of the file.
///
/// # Errors
///
/// Everything that is wrong with the file under these settings, and with them.
pub fn load_file_under(
    path: impl AsRef<Path>,
    options: &LoadOptions,
    overlay: &dyn Overlay,
) -> Result<Loaded, Diagnostics> {
    let path = path.as_ref();
    let name = path.display().to_string();
    let limit = if models::is_model_name(&name) { Limit::File } else { Limit::Scene };
    let bytes = assets::read_whole(path, options.limits.get(limit)).map_err(|error| {
        let error = error.with_limit(limit, &options.limits);
        let complaint = Complaint::error(Span::default(), format!("cannot read this file: {error}"));
        Diagnostics::new(vec![complaint.maybe_help(error.help())], &name, "", 1)
    })?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let assets = FolderAssets::new(folder);
    let assets = options.allowed_folders.iter().fold(assets, FolderAssets::allow);
    load(&bytes, &name, (&assets, &options.limits), overlay)
}

/// Reads and checks the scene in `bytes`, which messages call `name`; or a model, if the name ends as those of models do.
///
/// # Errors
///
/// Everything that is wrong with it; among it that a scene is not UTF-8.
pub fn load_bytes(bytes: &[u8], name: &str, assets: &dyn Assets, limits: &Limits) -> Result<Loaded, Diagnostics> {
    load(bytes, name, (assets, limits), &())
}

fn load(
    bytes: &[u8],
    name: &str,
    (assets, limits): (&dyn Assets, &Limits),
    overlay: &dyn Overlay,
) -> Result<Loaded, Diagnostics> {
    if models::is_model_name(name) {
        return models::load(bytes, name, (&Metered::new(assets, limits), limits), overlay);
    }
    match std::str::from_utf8(bytes) {
        Ok(text) => load_text(text, name, (assets, limits), overlay),
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
    load_text(text, name, (assets, limits), &())
}

fn load_text(
    text: &str,
    name: &str,
    (assets, limits): (&dyn Assets, &Limits),
    overlay: &dyn Overlay,
) -> Result<Loaded, Diagnostics> {
    if text.len() as u64 > limits.max_bytes {
        let exceeded = Exceeded { limit: Limit::Scene, asked: Some(text.len() as u64), allowed: limits.max_bytes };
        let complaint = Complaint::error(Span::default(), format!("this file is too large: {exceeded}"));
        return Err(Diagnostics::new(vec![complaint.help(exceeded.help())], name, "", 1));
    }
    let assets = Remembering::new(assets);
    let (scene, complaints) = native::load(text, (&Metered::new(&assets, limits), limits), overlay);
    let diagnostics = Diagnostics::new(complaints, name, text, limits.max_diagnostics);
    match scene {
        Some((scene, written)) => Ok(Loaded { scene, warnings: diagnostics, sources: assets.into_sources(), written }),
        None => Err(diagnostics),
    }
}

//! From the path of a scene to the scene, telling what is wrong on the way.

use crate::exit::{Exit, Failure};
use crate::output;
use crate::progress::{Phase, Show};
use clap::Args;
use durer::{CheckedScene, CompiledScene, Diagnostics, LoadOptions, Loaded};
use std::path::{Path, PathBuf};

/// Which scene, and what it may read.
#[derive(Args, Debug)]
pub(crate) struct SceneArgs {
    /// The scene file, or a model: glTF (glb, gltf), PLY, OBJ or STL
    #[arg(value_name = "SCENE")]
    pub(crate) path: PathBuf,

    /// Let the scene read files in this folder too, not only in its own (may be repeated)
    #[arg(long, value_name = "DIR")]
    allow_path: Vec<PathBuf>,
}

impl SceneArgs {
    /// The scene's file name without its folders.
    pub(crate) fn name(&self) -> String {
        self.path.file_name().unwrap_or_default().to_string_lossy().into_owned()
    }

    /// Loads the scene. Prints its warnings, or what is wrong with it.
    pub(crate) fn load(&self, show: Show) -> Result<CheckedScene, Failure> {
        match self.try_load(show)? {
            Ok(loaded) => {
                if !loaded.warnings.is_empty() {
                    tell(&loaded.warnings);
                }
                Ok(loaded.scene)
            }
            Err(diagnostics) => {
                tell(&diagnostics);
                Err(Failure::Told(Exit::Scene))
            }
        }
    }

    /// Loads the scene and prints nothing but progress.
    ///
    /// # Errors
    /// The outer one if the file cannot be read, the inner one if it is wrong.
    pub(crate) fn try_load(&self, show: Show) -> Result<Result<Loaded, Diagnostics>, Failure> {
        readable(&self.path)?;
        let _phase = Phase::begin("reading", &self.name(), show);
        Ok(durer::load_file(&self.path, &self.options()))
    }

    /// Makes a loaded scene ready for rays.
    pub(crate) fn compile(&self, scene: &CheckedScene, show: Show) -> CompiledScene {
        let _phase = Phase::begin("building", &self.name(), show);
        durer::compile(scene)
    }

    /// Makes its paths relative to another folder than this one.
    pub(crate) fn move_to(&mut self, folder: &Path) {
        self.path = folder.join(&self.path);
        self.allow_path.iter_mut().for_each(|path| *path = folder.join(&*path));
    }

    fn options(&self) -> LoadOptions {
        LoadOptions { allowed_folders: self.allow_path.clone(), ..LoadOptions::default() }
    }
}

/// Finds out whether a file can be opened, so that one that cannot has an exit code of its own.
fn readable(path: &Path) -> Result<(), Failure> {
    let cannot = |why: String| Failure::file(format!("cannot read {}: {why}", path.display()));
    if path == Path::new("-") {
        return Err(Failure::usage("scenes cannot be read from standard input: give a file in place of `-`"));
    }
    // Before it is opened, which may take forever if it is a pipe.
    match std::fs::metadata(path) {
        Ok(metadata) if metadata.is_dir() => return Err(cannot("it is a folder".to_owned())),
        Ok(metadata) if !metadata.is_file() => return Err(cannot("it is not a regular file".to_owned())),
        Ok(_) | Err(_) => {}
    }
    std::fs::File::open(path).map(drop).map_err(|error| cannot(error.to_string()))
}

fn tell(diagnostics: &Diagnostics) {
    output::note(&diagnostics.render(output::stderr_has_color()));
}

//! From the path of a scene to the scene, telling what is wrong on the way.

use crate::exit::{Exit, Failure};
use crate::output;
use crate::progress::{Phase, Show};
use clap::Args;
use durer::{
    CheckedScene, CompiledScene, Diagnostics, Exceeded, Limits, LoadOptions, Loaded, Overlay, Severity, SimdLevel,
};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Which scene, and what it may read.
#[derive(Args, Debug)]
pub(crate) struct SceneArgs {
    /// The scene file, or a model: glTF (glb, gltf), PLY, OBJ or STL
    #[arg(value_name = "SCENE")]
    pub(crate) path: PathBuf,

    /// Let the scene read files in this folder too, not only in its own (may be repeated)
    #[arg(long, value_name = "DIR")]
    allow_path: Vec<PathBuf>,

    /// How much the scene may ask for: `untrusted` for scenes of strangers, KEY=VALUE for single limits; the keys are
    /// time, memory, pixels, samples, primitives, textures, scene, file, files, values and nesting
    #[arg(long, value_name = "LIMITS", value_parser = limits, default_value = "")]
    limits: Limits,
}

impl SceneArgs {
    /// The scene's file name without its folders.
    pub(crate) fn name(&self) -> String {
        self.path.file_name().unwrap_or_default().to_string_lossy().into_owned()
    }

    /// Loads the scene as its file has it. Prints its warnings, or what is wrong with it.
    pub(crate) fn load(&self, show: Show) -> Result<Loaded, Failure> {
        self.load_under(&(), show)
    }

    /// Loads the scene with settings that win over those of its file. Prints its warnings, or what is wrong with either.
    pub(crate) fn load_under(&self, overlay: &dyn Overlay, show: Show) -> Result<Loaded, Failure> {
        match self.try_load(overlay, show)? {
            Ok(loaded) => {
                if !loaded.warnings.is_empty() {
                    tell(&loaded.warnings);
                }
                Ok(loaded)
            }
            Err(diagnostics) => {
                tell(&diagnostics);
                let mut errors = diagnostics.list.iter().filter(|one| one.severity == Severity::Error);
                let is_of_options = errors.all(|one| one.setting.is_some());
                Err(Failure::Told(if is_of_options { Exit::Usage } else { Exit::Scene }))
            }
        }
    }

    /// Loads the scene and prints nothing but progress.
    ///
    /// # Errors
    /// The outer one if the file cannot be read, the inner one if it is wrong.
    pub(crate) fn try_load(&self, overlay: &dyn Overlay, show: Show) -> Result<Result<Loaded, Diagnostics>, Failure> {
        readable(&self.path)?;
        let _phase = Phase::begin("reading", &self.name(), show);
        Ok(durer::load_file_under(&self.path, &self.options(), overlay))
    }

    /// Makes a loaded scene ready for rays, unless it asks for more than it may.
    pub(crate) fn compile(&self, scene: &CheckedScene, show: Show) -> Result<CompiledScene, Failure> {
        self.compile_for(scene, SimdLevel::best(), show)
    }

    /// As [`SceneArgs::compile`], for this instruction set.
    pub(crate) fn compile_for(
        &self,
        scene: &CheckedScene,
        simd: SimdLevel,
        show: Show,
    ) -> Result<CompiledScene, Failure> {
        self.admit(scene)?;
        let _phase = Phase::begin("building", &self.name(), show);
        Ok(durer::compile_for(scene, simd))
    }

    /// Finds out whether the scene asks for more than it may.
    pub(crate) fn admit(&self, scene: &CheckedScene) -> Result<(), Failure> {
        durer::admit(scene, &self.limits).map_err(|exceeded| {
            let line = |one: &Exceeded| format!("{one}\n  help: {}", one.help());
            let lines: Vec<String> = exceeded.iter().map(line).collect();
            Failure::Message(Exit::Scene, format!("{}: {}", self.path.display(), lines.join("\n       ")))
        })
    }

    /// How long the run may take.
    pub(crate) fn time_limit(&self) -> Option<Duration> {
        Some(self.limits.max_seconds).filter(|seconds| *seconds < u64::MAX).map(Duration::from_secs)
    }

    /// Makes its paths relative to another folder than this one.
    pub(crate) fn move_to(&mut self, folder: &Path) {
        self.path = folder.join(&self.path);
        self.allow_path.iter_mut().for_each(|path| *path = folder.join(&*path));
    }

    fn options(&self) -> LoadOptions {
        LoadOptions { allowed_folders: self.allow_path.clone(), limits: self.limits.clone() }
    }
}

fn limits(text: &str) -> Result<Limits, String> {
    if text.is_empty() { Ok(Limits::default()) } else { text.parse() }
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

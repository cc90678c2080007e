//! `durer check`: is a scene fine, and if not, where?

use crate::exit::{Exit, Failure};
use crate::interrupt::Interrupt;
use crate::labels::Shapes;
use crate::load::SceneArgs;
use crate::progress::Show;
use crate::{numbers, output};
use clap::Args;
use durer::Scene;
use serde_json::{Value, json};

const EXAMPLES: &str = "\
Examples:
  durer check room.yaml
  durer check room.yaml --json    for editors and scripts";

/// Say whether a scene is fine, or what is wrong with it and where
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    #[command(flatten)]
    scene: SceneArgs,

    /// Print what was found as JSON
    #[arg(long)]
    json: bool,
}

/// Checks the scene.
pub(crate) fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    Interrupt::after(arguments.scene.time_limit());
    if arguments.json {
        return run_json(&arguments.scene);
    }
    let scene = arguments.scene.load(Show::Progress)?.scene;
    arguments.scene.admit(&scene)?;
    output::print(&format!("{}: fine: {}\n", arguments.scene.path.display(), summary(scene.scene())))?;
    Ok(Exit::Fine)
}

fn run_json(arguments: &SceneArgs) -> Result<Exit, Failure> {
    let (diagnostics, fine) = match arguments.try_load(&(), Show::Progress)? {
        Ok(loaded) => {
            arguments.admit(&loaded.scene)?;
            (loaded.warnings.to_json(), true)
        }
        Err(diagnostics) => (diagnostics.to_json(), false),
    };
    let mut report = json!({ "fine": fine });
    if let (Value::Object(report), Value::Object(diagnostics)) = (&mut report, diagnostics) {
        report.extend(diagnostics);
    }
    output::print_json(&report)?;
    Ok(if fine { Exit::Fine } else { Exit::Scene })
}

/// `15 shapes, 3 lights, …`
fn summary(scene: &Scene) -> String {
    [
        numbers::count(Shapes::of(scene).len(), "shape"),
        numbers::count(scene.lights.len(), "light"),
        numbers::count(scene.materials.len(), "material"),
        numbers::count(scene.textures.len(), "texture"),
        numbers::count(scene.images.len(), "image"),
    ]
    .join(", ")
}

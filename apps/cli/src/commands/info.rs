//! `durer info`: what is in a scene, counted.

use crate::exit::{Exit, Failure};
use crate::load::SceneArgs;
use crate::numbers::{bytes, count, short, vector};
use crate::output;
use clap::Args;
use durer::imaging::Transfer;
use durer::math::DVec3;
use durer::scene::{Antialias, LightKind, Object, ObjectKind, Picture};
use durer::{Bounds, Scene};
use serde_json::{Value, json};

const EXAMPLES: &str = "\
Examples:
  durer info room.yaml
  durer info room.yaml --json";

/// Say what is in a scene: shapes, materials, images, lights, and how large it is
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    #[command(flatten)]
    scene: SceneArgs,

    /// Print the numbers as JSON
    #[arg(long)]
    json: bool,
}

/// Counts what is in the scene.
pub(crate) fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    let checked = arguments.scene.load()?;
    let compiled = durer::compile(&checked);
    let facts = Facts::of(checked.scene(), compiled.bounds(), compiled.geometry_memory());
    match arguments.json {
        true => output::print_json(&facts.json())?,
        false => output::print(&format!("{}\n{}", arguments.scene.path.display(), facts.text()))?,
    }
    Ok(Exit::Fine)
}

/// How many there are of each kind, in the order in which the kinds first appear.
#[derive(Default)]
struct Tally(Vec<(&'static str, usize)>);

impl Tally {
    fn of(words: impl IntoIterator<Item = &'static str>) -> Tally {
        let mut tally = Tally::default();
        words.into_iter().for_each(|word| tally.add(word));
        tally
    }

    fn add(&mut self, word: &'static str) {
        match self.0.iter_mut().find(|(known, _)| *known == word) {
            Some((_, count)) => *count += 1,
            None => self.0.push((word, 1)),
        }
    }

    fn total(&self) -> usize {
        self.0.iter().map(|(_, count)| count).sum()
    }

    fn text(&self, kind: fn(usize, &str) -> String) -> String {
        let kinds: Vec<String> = self.0.iter().map(|&(word, number)| kind(number, word)).collect();
        if kinds.is_empty() { "0".to_owned() } else { format!("{}: {}", self.total(), kinds.join(", ")) }
    }

    fn json(&self) -> Value {
        let kinds: serde_json::Map<String, Value> =
            self.0.iter().map(|(word, count)| ((*word).to_owned(), json!(count))).collect();
        json!({ "total": self.total(), "kinds": kinds })
    }
}

struct Facts<'s> {
    scene: &'s Scene,
    shapes: Tally,
    groups: usize,
    textures: Tally,
    lights: Tally,
    bounds: Option<Bounds>,
    memory: usize,
}

impl<'s> Facts<'s> {
    fn of(scene: &'s Scene, bounds: Bounds, memory: usize) -> Facts<'s> {
        let (mut shapes, mut groups) = (Tally::default(), 0);
        count_objects(&scene.objects, &mut shapes, &mut groups);
        Facts {
            scene,
            shapes,
            groups,
            textures: Tally::of(scene.textures.iter().map(|texture| texture.pattern.word())),
            lights: Tally::of(scene.lights.iter().map(|light| light_word(light.kind))),
            bounds: Some(bounds).filter(|bounds| !bounds.is_empty()),
            memory,
        }
    }

    fn text(&self) -> String {
        let named = self.scene.materials.iter().filter(|material| material.name.is_some()).count();
        let mut lines = vec![
            ("picture", picture_text(self.scene)),
            ("shapes", self.shapes.text(count)),
            ("groups", self.groups.to_string()),
            ("materials", format!("{}, {named} of them named", self.scene.materials.len())),
            ("textures", self.textures.text(adjective)),
            ("lights", self.lights.text(adjective)),
            ("bounds", bounds_text(self.bounds)),
            ("memory", format!("{} for the shapes and their search structures", bytes(self.memory as u64))),
        ];
        let images =
            self.scene.images.iter().map(|image| {
                ("image", format!("{}: {} × {} pixels", image.file, image.bitmap.width, image.bitmap.height))
            });
        lines.splice(5..5, images);
        lines.iter().map(|(title, text)| format!("  {title:<10} {text}\n")).collect()
    }

    fn json(&self) -> Value {
        let Picture { width, height, transfer } = self.scene.picture;
        let images: Vec<Value> = self
            .scene
            .images
            .iter()
            .map(|image| json!({ "file": image.file, "width": image.bitmap.width, "height": image.bitmap.height }))
            .collect();
        json!({
            "picture": { "width": width, "height": height, "transfer": transfer_word(transfer) },
            "max_depth": self.scene.render.max_depth,
            "antialias": antialias_text(self.scene.render.antialias),
            "shapes": self.shapes.json(),
            "groups": self.groups,
            "materials": self.scene.materials.len(),
            "textures": self.textures.json(),
            "images": images,
            "lights": self.lights.json(),
            "bounds": self.bounds.map(|b| json!({ "min": array(b.min), "max": array(b.max) })),
            "geometry_bytes": self.memory,
        })
    }
}

/// `2 point`, as in `2 point lights`.
fn adjective(number: usize, word: &str) -> String {
    format!("{number} {word}")
}

fn count_objects(objects: &[Object], shapes: &mut Tally, groups: &mut usize) {
    for object in objects {
        match &object.kind {
            ObjectKind::Shape(shape) => shapes.add(shape.word()),
            ObjectKind::Group(children) => {
                *groups += 1;
                count_objects(children, shapes, groups);
            }
            ObjectKind::Mesh(_)
            | ObjectKind::Particles(_)
            | ObjectKind::Instances(_)
            | ObjectKind::Import(_)
            | ObjectKind::Solid(_) => todo!(),
        }
    }
}

fn array(v: DVec3) -> [f64; 3] {
    [v.x, v.y, v.z]
}

fn bounds_text(bounds: Option<Bounds>) -> String {
    match bounds {
        Some(bounds) => {
            // Bounds are widened by what rounding may take away, which nobody wants to read.
            let grain = (bounds.size().length() * 1e-9).max(f64::MIN_POSITIVE);
            let rounded = |v: DVec3| vector((v / grain).round() * grain);
            format!("{} to {}, without infinite planes", rounded(bounds.min), rounded(bounds.max))
        }
        None => "nothing but infinite planes, or nothing at all".to_owned(),
    }
}

fn picture_text(scene: &Scene) -> String {
    let Picture { width, height, transfer } = scene.picture;
    let (transfer, antialias) = (transfer_word(transfer), antialias_text(scene.render.antialias));
    format!("{width} × {height} pixels, {transfer}, depth {}, antialias {antialias}", scene.render.max_depth)
}

fn transfer_word(transfer: Transfer) -> &'static str {
    match transfer {
        Transfer::Srgb => "srgb",
        Transfer::Linear => "linear",
    }
}

/// As `--antialias` takes it.
fn antialias_text(antialias: Antialias) -> String {
    match antialias {
        Antialias::None => "none".to_owned(),
        Antialias::Grid { n } => format!("grid:{n}"),
        Antialias::Recursive { threshold, max_depth } => {
            format!("recursive:{},{max_depth}", short(f64::from(threshold)))
        }
    }
}

fn light_word(kind: LightKind) -> &'static str {
    match kind {
        LightKind::Point { .. } => "point",
        LightKind::Spot { .. } => "spot",
        LightKind::Directional { .. } => "directional",
    }
}

//! `durer info`: what is in a scene, counted; or what a picture file says of itself.

pub(crate) mod film;
mod picture;

use crate::exit::{Exit, Failure};
use crate::interrupt::Interrupt;
use crate::load::SceneArgs;
use crate::numbers::{bytes, count, samples_a_pixel, thousands, vector};
use crate::output;
use crate::progress::Show;
use clap::Args;
use durer::imaging::{FileFormat, ToneMapping, Transfer};
use durer::math::DVec3;
use durer::scene::{
    Antialias, Integrator, LightKind, Object, ObjectKind, PathSettings, Picture, PixelFilter, RenderSettings,
};
use durer::{Bounds, CompiledScene, GeometryMemory, Scene};
use serde_json::{Value, json};

const EXAMPLES: &str = "\
Examples:
  durer info room.yaml
  durer info room.yaml --json
  durer info room.png                 size, samples, and which scene it shows
  durer info part.film                which part of which picture; of checkpoints, too";

/// Say what is in a scene: shapes, materials, images, lights, and how large it is; or in a picture
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    #[command(flatten)]
    scene: SceneArgs,

    /// Print the numbers as JSON
    #[arg(long)]
    json: bool,
}

/// Counts what is in the scene, or reads what the picture says.
pub(crate) fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    if film::is_one(&arguments.scene.path) {
        return film::run(&arguments.scene.path, arguments.json);
    }
    if FileFormat::from_path(&arguments.scene.path).is_ok() {
        return picture::run(&arguments.scene.path, arguments.json);
    }
    Interrupt::after(arguments.scene.time_limit());
    let checked = arguments.scene.load(Show::Progress)?.scene;
    let compiled = arguments.scene.compile(&checked, Show::Progress)?;
    let facts = Facts::of(checked.scene(), &compiled);
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
        words.into_iter().for_each(|word| tally.add(word, 1));
        tally
    }

    fn add(&mut self, word: &'static str, number: usize) {
        match self.0.iter_mut().find(|(known, _)| *known == word) {
            Some((_, count)) => *count += number,
            None => self.0.push((word, number)),
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
    objects: Objects,
    /// Shapes of all kinds, every copy counted.
    placed: usize,
    textures: Tally,
    lights: Tally,
    bounds: Option<Bounds>,
    memory: GeometryMemory,
}

/// The objects of a scene by kind, as the user described them: what is copied counts once.
#[derive(Default)]
struct Objects {
    shapes: Tally,
    groups: usize,
    meshes: usize,
    particles: Tally,
    /// Copies that instances make.
    copies: usize,
    imports: usize,
    solids: Tally,
}

impl<'s> Facts<'s> {
    fn of(scene: &'s Scene, compiled: &CompiledScene) -> Facts<'s> {
        let (mut objects, bounds) = (Objects::default(), compiled.bounds());
        objects.add(&scene.objects);
        Facts {
            scene,
            objects,
            placed: compiled.shape_count(),
            textures: Tally::of(scene.textures.iter().map(|texture| texture.pattern.word())),
            lights: Tally::of(scene.lights.iter().map(|light| light_word(light.kind))),
            bounds: Some(bounds).filter(|bounds| !bounds.is_empty()),
            memory: compiled.geometry_memory(),
        }
    }

    fn text(&self) -> String {
        let named = self.scene.materials.iter().filter(|material| material.name.is_some()).count();
        let mut lines = vec![("picture", picture_text(self.scene)), ("shapes", self.objects.shapes.text(count))];
        lines.extend(self.other_objects());
        lines.push(("groups", self.objects.groups.to_string()));
        lines.push(("materials", format!("{}, {named} of them named", self.scene.materials.len())));
        lines.push(("textures", self.textures.text(adjective)));
        lines.extend(self.scene.images.iter().map(|image| {
            ("image", format!("{}: {} × {} pixels", image.file, image.bitmap.width, image.bitmap.height))
        }));
        lines.push(("lights", self.lights.text(adjective)));
        lines.push(("bounds", bounds_text(self.bounds)));
        lines.push(("memory", self.memory_text()));
        lines.iter().map(|(title, text)| format!("  {title:<10} {text}\n")).collect()
    }

    /// A line for each kind of object that not every scene has.
    fn other_objects(&self) -> Vec<(&'static str, String)> {
        let Objects { meshes, particles, copies, imports, solids, .. } = &self.objects;
        let (triangles, placed) = (count(self.memory.triangles, "triangle"), count(self.placed, "shape"));
        let lines = [
            (*meshes, "meshes", format!("{meshes}, of {triangles}")),
            (particles.total(), "particles", particles.text(adjective)),
            (*imports, "imports", imports.to_string()),
            (solids.total(), "solids", solids.text(adjective)),
            (*copies, "instances", format!("{} copies, with which there are {placed}", thousands(*copies as u64))),
        ];
        lines.into_iter().filter(|(number, ..)| *number > 0).map(|(_, title, text)| (title, text)).collect()
    }

    fn memory_text(&self) -> String {
        let memory = &self.memory;
        let total = bytes(memory.total() as u64);
        let mut text = format!("{total} for the shapes and their search structures");
        for (held, number, what) in self.shares() {
            text += &format!(", {} a {what}", bytes_each(held, number));
        }
        text
    }

    /// What takes how many bytes for how many of what.
    fn shares(&self) -> Vec<(usize, usize, &'static str)> {
        let GeometryMemory { meshes, triangles, particles, particle_count, .. } = self.memory;
        let shares = [(meshes, triangles, "triangle"), (particles, particle_count, "particle")];
        shares.into_iter().filter(|(_, number, _)| *number > 0).collect()
    }

    fn json(&self) -> Value {
        let Picture { width, height, transfer, exposure, tone_mapping } = self.scene.picture;
        let render = &self.scene.render;
        let images: Vec<Value> = self
            .scene
            .images
            .iter()
            .map(|image| json!({ "file": image.file, "width": image.bitmap.width, "height": image.bitmap.height }))
            .collect();
        json!({
            "picture": { "width": width, "height": height, "transfer": transfer_word(transfer), "exposure": exposure, "tone_mapping": tone_mapping_word(tone_mapping) },
            "integrator": render.integrator.word(),
            "max_depth": match render.integrator {
                Integrator::Path(PathSettings { max_depth, .. }) => max_depth,
                Integrator::Whitted
                | Integrator::AmbientOcclusion { .. }
                | Integrator::Normals
                | Integrator::Depth
                | Integrator::Uv => render.max_depth,
            },
            "path": path_json(render.integrator),
            "samples": render.integrator.takes_samples().then(|| json!({
                "most": render.samples_a_pixel(), "noise": render.noise, "time": render.time, "seed": render.seed,
            })),
            "antialias": antialias_text(self.scene.render.antialias),
            "filter": filter_text(self.scene.render.filter),
            "shapes": self.objects.shapes.json(),
            "meshes": { "total": self.objects.meshes, "triangles": self.memory.triangles },
            "particles": self.objects.particles.json(),
            "imports": self.objects.imports,
            "solids": self.objects.solids.json(),
            "instances": self.objects.copies,
            "placed": self.placed,
            "groups": self.objects.groups,
            "materials": self.scene.materials.len(),
            "textures": self.textures.json(),
            "images": images,
            "lights": self.lights.json(),
            "bounds": self.bounds.map(|b| json!({ "min": array(b.min), "max": array(b.max) })),
            "geometry_bytes": self.memory.total(),
            "bytes_each": self.shares().iter().map(|&(held, number, what)| {
                (what.to_owned(), json!(held as f64 / number as f64))
            }).collect::<serde_json::Map<String, Value>>(),
        })
    }
}

/// `2 point`, as in `2 point lights`.
fn adjective(number: usize, word: &str) -> String {
    format!("{number} {word}")
}

/// `51.2 bytes`.
fn bytes_each(held: usize, number: usize) -> String {
    format!("{:.1} bytes", held as f64 / number as f64)
}

impl Objects {
    fn add(&mut self, objects: &[Object]) {
        for object in objects {
            match &object.kind {
                ObjectKind::Shape(shape) => self.shapes.add(shape.word(), 1),
                ObjectKind::Group(members) => {
                    self.groups += 1;
                    self.add(members);
                }
                ObjectKind::Mesh(_) => self.meshes += 1,
                ObjectKind::Particles(particles) => self.particles.add(particles.kind.word(), particles.kind.len()),
                ObjectKind::Instances(instances) => {
                    self.copies += instances.positions.values.len();
                    self.add(&instances.objects);
                }
                ObjectKind::Import(import) => {
                    self.imports += 1;
                    self.add(&import.objects);
                }
                ObjectKind::Solid(solid) => {
                    self.solids.add(solid.operation.word(), 1);
                    self.add(&solid.operands);
                }
            }
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
    let Picture { width, height, transfer, .. } = scene.picture;
    format!("{width} × {height} pixels, {}, {}", transfer_word(transfer), integrator_text(&scene.render))
}

/// What is computed, and those settings that mean something to it.
fn integrator_text(render: &RenderSettings) -> String {
    let (depth, antialias) = (render.max_depth, antialias_text(render.antialias));
    let filter = match render.filter {
        PixelFilter::Box => String::new(),
        filter => format!(", filter {}", filter_text(filter)),
    };
    let what = match render.integrator {
        Integrator::Whitted => format!("depth {depth}, antialias {antialias}"),
        sampled @ (Integrator::Path(_) | Integrator::AmbientOcclusion { .. }) => {
            format!("{}, {}", own_settings(sampled), samples_text(render))
        }
        Integrator::Normals | Integrator::Depth | Integrator::Uv => {
            format!("{}, antialias {antialias}", render.integrator.word())
        }
    };
    what + &filter
}

/// The word for what is computed, and its own settings as far as there is something to say.
fn own_settings(integrator: Integrator) -> String {
    match integrator {
        Integrator::Path(PathSettings { max_depth, clamp, split, reuse }) => {
            let clamp = clamp.map_or(String::new(), |clamp| format!(", clamp {clamp}"));
            let split = if split > 1 { format!(", split {split}") } else { String::new() };
            let reuse = if reuse > 1 { format!(", reuse {reuse}") } else { String::new() };
            format!("path, depth {max_depth}{clamp}{split}{reuse}")
        }
        Integrator::AmbientOcclusion { distance } => {
            let distance = distance.map_or(String::new(), |distance| format!(", distance {distance}"));
            format!("ambient_occlusion{distance}")
        }
        Integrator::Whitted | Integrator::Normals | Integrator::Depth | Integrator::Uv => integrator.word().to_owned(),
    }
}

/// All settings of the path tracer; null of others.
fn path_json(integrator: Integrator) -> Value {
    let Integrator::Path(PathSettings { max_depth, clamp, split, reuse }) = integrator else { return Value::Null };
    json!({ "max_depth": max_depth, "clamp": clamp, "split": split, "reuse": reuse })
}

/// How many samples a pixel takes, and what else ends them.
fn samples_text(render: &RenderSettings) -> String {
    let most = if render.noise.is_some() || render.time.is_some() { "at most " } else { "" };
    let noise = render.noise.map_or(String::new(), |noise| format!(", noise {noise}"));
    let time = render.time.map_or(String::new(), |time| format!(", time {time} s"));
    let samples = render.samples_a_pixel();
    format!("{most}{}{noise}{time}, seed {}", samples_a_pixel(samples, samples), render.seed)
}

/// The transfer curve, as scenes call it.
pub(crate) fn transfer_word(transfer: Transfer) -> &'static str {
    match transfer {
        Transfer::Srgb => "srgb",
        Transfer::Linear => "linear",
    }
}

/// The tone mapping, as scenes call it.
pub(crate) fn tone_mapping_word(tone_mapping: ToneMapping) -> &'static str {
    match tone_mapping {
        ToneMapping::None => "none",
        ToneMapping::Reinhard => "reinhard",
        ToneMapping::Aces => "aces",
        ToneMapping::Agx => "agx",
        ToneMapping::PbrNeutral => "pbr_neutral",
    }
}

/// As `--antialias` takes it, to the last digit.
pub(crate) fn antialias_text(antialias: Antialias) -> String {
    let with_two = |word: &str, threshold: f32, depth: u32| format!("{word}:{threshold},{depth}");
    match antialias {
        Antialias::None => "none".to_owned(),
        Antialias::Grid { n } => format!("grid:{n}"),
        Antialias::Recursive { threshold, max_depth } => with_two("recursive", threshold, max_depth),
        Antialias::Adaptive { threshold, max_depth } => with_two("adaptive", threshold, max_depth),
        Antialias::Pov1 { threshold, depth } => with_two("pov1", threshold, depth),
        Antialias::Pov2 { threshold, depth } => with_two("pov2", threshold, depth),
    }
}

/// As `--filter` takes it, to the last digit.
pub(crate) fn filter_text(filter: PixelFilter) -> String {
    match filter {
        PixelFilter::Box => "box".to_owned(),
        PixelFilter::Tent { radius } => format!("tent:{radius}"),
        PixelFilter::Gaussian { radius, sigma } => format!("gaussian:{radius},{sigma}"),
        PixelFilter::Mitchell { radius } => format!("mitchell:{radius}"),
        PixelFilter::BlackmanHarris { radius } => format!("blackman_harris:{radius}"),
    }
}

fn light_word(kind: LightKind) -> &'static str {
    match kind {
        LightKind::Point { .. } => "point",
        LightKind::Spot { .. } => "spot",
        LightKind::Directional { .. } => "directional",
    }
}

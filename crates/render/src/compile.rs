//! From a checked scene to flat arrays: what the integrators read.

mod contents;
mod imports;
mod looks;
mod particles;
mod shapes;
mod solids;
mod tree;

use crate::background::Background;
use crate::camera::Camera;
use crate::casters::Casters;
use crate::emitters::Emitters;
use crate::fog::Fog;
use crate::integrators::cutout::Shown;
use crate::lights::Light;
use crate::materials::Material;
use crate::surfaces::Scattering;
use crate::textures::Textures;
use crate::whitted_reading::Means;
use contents::Contents;
use durer_geometry::{Bounds, BuildFor, Hit, Plan, Primitive, SimdLevel, Vantage, World};
use durer_math::Rgb;
use durer_scene::{CheckedScene, Integrator, Picture, RenderSettings, Scene, Trees};
use imports::Brought;
use looks::Looks;
use rayon::prelude::*;
use tree::Tree;

pub(crate) use looks::{CLEAR, Colors, Details, OPAQUE, Origin, PlacedObject};

/// A scene ready for rays. Immutable; threads share it.
#[derive(Debug)]
pub struct CompiledScene {
    pub(crate) world: World,
    /// One for each primitive, in the same order: that of the shapes in the scene file, depth first, copy by copy.
    pub(crate) objects: Vec<PlacedObject>,
    /// What differs within primitives.
    details: Vec<Details>,
    /// Bytes of what instances share.
    shared: GeometryMemory,
    /// The scene's, and after them the default material.
    pub(crate) materials: Vec<Material>,
    /// What path tracing makes of them, in the same order.
    pub(crate) scatterings: Vec<Scattering>,
    pub(crate) textures: Textures,
    /// The scene's, and after them those that imported files bring.
    pub(crate) lights: Vec<Light>,
    /// All that gives light.
    pub(crate) emitters: Emitters,
    /// What throws light of the sky.
    pub(crate) casters: Casters,
    /// For each light that shines from a point, what is seen from there.
    pub(crate) light_vantages: Vec<Option<Vantage>>,
    pub(crate) camera: Camera,
    /// What is seen from the eye, unless the projection is parallel.
    pub(crate) eye_vantage: Option<Vantage>,
    pub(crate) background: Background,
    pub(crate) ambient: Rgb,
    pub(crate) fog: Option<Fog>,
    pub(crate) picture: Picture,
    /// How much of it the eye is shown.
    pub(crate) shown: Shown,
    pub(crate) settings: RenderSettings,
    /// Primitives filled with a medium that the eye's rays may start inside of.
    pub(crate) media_at_eye: Vec<u32>,
    /// True if some medium takes light away.
    pub(crate) attenuates: bool,
    /// True if some surface may have holes.
    pub(crate) has_holes: bool,
    /// True if radiance may change on straight ways: under path tracing, through holes in what bends light.
    pub(crate) stretches: bool,
}

/// Bytes that geometry takes, and for how much of what. What instances share is counted once.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct GeometryMemory {
    /// Of primitives, the tree over them, and what is known of each of them; without what is counted below.
    pub shapes: usize,
    /// Of the trees of meshes and the triangles in them.
    pub meshes: usize,
    /// Triangles of meshes.
    pub triangles: usize,
    /// Of particles and the trees over them.
    pub particles: usize,
    /// Number of particles.
    pub particle_count: usize,
    /// Of solids: what they are made of, without meshes.
    pub solids: usize,
}

impl GeometryMemory {
    /// All of it.
    pub fn total(&self) -> usize {
        self.shapes + self.meshes + self.particles + self.solids
    }
}

/// Makes a scene ready for rays: places every shape, builds the search structures. Uses the threads of the rayon pool that
/// it is called in (see [`with_threads`](crate::with_threads)); what it makes does not depend on their number.
pub fn compile(scene: &CheckedScene) -> CompiledScene {
    compile_for(scene, SimdLevel::best())
}

/// As [`compile`], but building and rendering will use this instruction set. It changes no pixel.
pub fn compile_for(scene: &CheckedScene, simd: SimdLevel) -> CompiledScene {
    let scene = scene.scene();
    let (materials, plan) = (materials(scene), Plan { purpose: purpose(scene.render.trees), simd });
    let contents = Contents::of(&scene.objects, plan);
    let tree = Tree::new(&scene.objects, &contents, &materials);
    let (mut primitives, mut objects): (Vec<Primitive>, Vec<PlacedObject>) = (Vec::new(), Vec::new());
    (0..tree.len()).into_par_iter().map(|index| tree.place(index)).unzip_into_vecs(&mut primitives, &mut objects);
    let mut shared = contents.memory();
    tree.add_memory(&mut shared);
    let details = tree.details;
    let world = World::build(primitives, plan);
    let brought = Brought::by(&scene.objects);
    let lights: Vec<Light> = scene.lights.iter().chain(&brought.lights).map(Light::compile).collect();
    let Picture { width, height, .. } = scene.picture;
    let camera = scene.camera.as_ref().or(brought.camera.as_ref());
    let camera = Camera::compile(camera, world.bounds(), width, height);
    let attenuates = |looks: &Looks| looks.is_medium && materials[looks.material as usize].attenuation.is_some();
    let is_path = matches!(scene.render.integrator, Integrator::Path { .. });
    let is_open_glass =
        |looks: &Looks| looks.is_medium && looks.has_holes && materials[looks.material as usize].ior.is_some();
    let mut compiled = CompiledScene {
        stretches: is_path && objects.iter().any(|object| is_open_glass(&object.looks)),
        attenuates: objects.iter().any(|object| attenuates(&object.looks)),
        has_holes: objects.iter().any(|object| object.looks.has_holes),
        media_at_eye: media_at_eye(&objects, &world, &camera),
        eye_vantage: camera.eye().and_then(|eye| world.vantage(eye, OPAQUE | CLEAR)),
        camera,
        emitters: Emitters::default(),
        casters: Casters::default(),
        light_vantages: vantages(&lights, &world),
        lights,
        world,
        objects,
        details,
        shared,
        textures: Textures::compile(scene),
        materials,
        scatterings: scatterings(scene),
        background: Background::compile(scene),
        ambient: scene.ambient,
        fog: scene.fog.as_ref().map(Fog::compile),
        picture: scene.picture,
        shown: Shown::Everything,
        settings: scene.render,
    };
    if looks_for_light(&scene.render) {
        compiled.emitters = Emitters::of(&compiled, &mean_emission(&compiled.materials, scene));
    }
    compiled.casters = Casters::of(&compiled);
    compiled
}

/// The mean luminance of the emission of each material, wherever its texture is taken from; the default material's is last.
fn mean_emission(materials: &[Material], scene: &Scene) -> Vec<f64> {
    let mut means = Means::of_light(scene);
    let mut mean = |emission: &durer_scene::Emission| {
        f64::from((means.of(emission.color) * emission.strength).luminance()).max(0.0)
    };
    materials.iter().map(|material| material.emission.as_ref().map_or(0.0, &mut mean)).collect()
}

/// True if there is use for knowing all that gives light.
fn looks_for_light(settings: &RenderSettings) -> bool {
    match settings.integrator {
        Integrator::Path { .. } => true,
        Integrator::Whitted => settings.light_samples > 0,
        Integrator::AmbientOcclusion { .. } | Integrator::Normals | Integrator::Depth | Integrator::Uv => false,
    }
}

fn purpose(trees: Trees) -> BuildFor {
    match trees {
        Trees::Preview => BuildFor::Preview,
        Trees::Picture => BuildFor::Picture,
        Trees::ManyRays => BuildFor::ManyRays,
    }
}

/// The scene's, and after them the default material.
fn materials(scene: &Scene) -> Vec<Material> {
    let default = durer_scene::Material::default();
    let (mut means, integrator) = (Means::new(scene), scene.render.integrator);
    let all = scene.materials.iter().chain([&default]);
    all.map(|material| Material::compile(material, &mut means, integrator)).collect()
}

/// What path tracing makes of the same.
fn scatterings(scene: &Scene) -> Vec<Scattering> {
    let default = durer_scene::Material::default();
    let all = scene.materials.iter().chain([&default]).map(|material| Scattering::compile(&material.kind));
    let all: Vec<Scattering> = all.collect();
    if let Integrator::Path { .. } = scene.render.integrator {
        all.iter().for_each(Scattering::prepare);
    }
    all
}

/// The media that may be around the origin of one of the eye's rays.
fn media_at_eye(objects: &[PlacedObject], world: &World, camera: &Camera) -> Vec<u32> {
    let origins = camera.origins();
    let may_be_around = |id: &u32| {
        let primitive = &world.primitives()[*id as usize];
        let Bounds { min, max } = primitive.bounds();
        let overlap = min.cmple(origins.max).all() && origins.min.cmple(max).all();
        overlap && camera.eye().is_none_or(|eye| primitive.contains(eye))
    };
    let media = (0..objects.len() as u32).filter(|&id| objects[id as usize].looks.is_medium);
    media.filter(may_be_around).collect()
}

/// Vantages take time and room to make; with more lights than this, only the first get one.
const MOST_VANTAGES: usize = 32;

fn vantages(lights: &[Light], world: &World) -> Vec<Option<Vantage>> {
    let made = lights.iter().take(MOST_VANTAGES).map(|light| world.vantage(light.position()?, OPAQUE));
    made.chain(std::iter::repeat_with(|| None)).take(lights.len()).collect()
}

impl CompiledScene {
    /// Leaves out the background where the eye sees it at first hand, not in mirrors, nor what it lights: for pictures with
    /// alpha, which [`coverage`](crate::coverage) gives.
    pub fn leave_out_background(&mut self) {
        self.shown = Shown::Things;
    }

    /// A box around all shapes but the infinite planes.
    pub fn bounds(&self) -> Bounds {
        self.world.bounds()
    }

    /// Bytes that geometry takes.
    pub fn geometry_memory(&self) -> GeometryMemory {
        let placed = |object: &PlacedObject| {
            size_of::<PlacedObject>() + object.object_from_world.as_deref().map_or(0, size_of_val)
        };
        let shapes = self.world.memory() + self.objects.iter().map(placed).sum::<usize>();
        GeometryMemory { shapes, ..self.shared }
    }

    /// The material of a primitive, or of what it is filled with.
    #[inline]
    pub(crate) fn material(&self, primitive: u32) -> &Material {
        &self.materials[self.objects[primitive as usize].looks.material as usize]
    }

    /// The index of the material at a hit.
    #[inline]
    pub(crate) fn material_at(&self, hit: &Hit) -> u32 {
        let of_part = self.details(hit.primitive).and_then(|details| details.material(hit.crossing.part));
        of_part.unwrap_or(self.objects[hit.primitive as usize].looks.material)
    }

    /// What differs within a primitive, if anything does.
    #[inline]
    pub(crate) fn details(&self, primitive: u32) -> Option<&Details> {
        Some(&self.details[self.objects[primitive as usize].looks.details()? as usize])
    }

    /// Which piece of a primitive was hit: within a piece, surfaces are smooth, or made to look so.
    pub(crate) fn piece_of(&self, hit: &Hit) -> u32 {
        match self.details(hit.primitive).filter(|details| details.is_solid()) {
            Some(details) => details.origin(hit.crossing.part).0 as u32,
            None => self.world.piece_of(hit),
        }
    }

    /// Number of shapes; every copy counts.
    pub fn shape_count(&self) -> usize {
        self.objects.len()
    }

    /// Width and height of the picture, in pixels.
    pub fn picture_size(&self) -> (u32, u32) {
        (self.picture.width, self.picture.height)
    }
}

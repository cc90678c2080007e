//! From a checked scene to flat arrays: what the integrators read.

use crate::camera::Camera;
use crate::fog::Fog;
use crate::lights::Light;
use crate::materials::Material;
use crate::textures::Textures;
use durer_geometry::{Bounds, Primitive, Vantage, World};
use durer_math::{DAffine3, DVec2, Rgb};
use durer_scene::{Background, CheckedScene, MaterialId, Object, ObjectKind, Picture, RenderSettings, Scene, Shape};

/// Seen by all rays that look for something opaque.
pub(crate) const OPAQUE: u32 = 1;
/// Seen by all rays that look for something that light may pass.
pub(crate) const CLEAR: u32 = 2;

/// A scene ready for rays. Immutable; threads share it.
#[derive(Debug)]
pub struct CompiledScene {
    pub(crate) world: World,
    /// One for each primitive, in the same order: that of the shapes in the scene file, depth first.
    pub(crate) objects: Vec<PlacedObject>,
    pub(crate) materials: Vec<Material>,
    pub(crate) textures: Textures,
    pub(crate) lights: Vec<Light>,
    /// For each light that shines from a point, what is seen from there.
    pub(crate) light_vantages: Vec<Option<Vantage>>,
    pub(crate) camera: Camera,
    /// What is seen from the eye, unless the projection is parallel.
    pub(crate) eye_vantage: Option<Vantage>,
    pub(crate) background: Background,
    pub(crate) ambient: Rgb,
    pub(crate) fog: Option<Fog>,
    pub(crate) picture: Picture,
    pub(crate) settings: RenderSettings,
    /// True if the eye's rays may start inside of a medium.
    pub(crate) eye_in_medium: bool,
    /// Primitives that are filled with a medium.
    pub(crate) media: Vec<u32>,
    /// True if some medium takes light away.
    pub(crate) attenuates: bool,
}

/// What shading needs to know of a primitive.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlacedObject {
    pub(crate) material: u32,
    /// True if it is filled with a medium: it has an inside, and what is there bends light or takes it away.
    pub(crate) is_medium: bool,
    /// From the world to the space in which the user described the shape; `None` where they are the same.
    pub(crate) object_from_world: Option<DAffine3>,
}

/// Makes a scene ready for rays: places every shape, builds the search structures.
pub fn compile(scene: &CheckedScene) -> CompiledScene {
    let scene = scene.scene();
    let mut compiler = Compiler::new(scene);
    for object in &scene.objects {
        compiler.add(object, &DAffine3::IDENTITY, None);
    }
    let Compiler { primitives, objects, materials, .. } = compiler;
    let media: Vec<u32> = (0..objects.len() as u32).filter(|&id| objects[id as usize].is_medium).collect();
    let attenuates = media.iter().any(|&id| materials[objects[id as usize].material as usize].attenuation.is_some());
    let world = World::build(primitives);
    let Picture { width, height, .. } = scene.picture;
    let camera = Camera::compile(scene.camera.as_ref(), world.bounds(), width, height);
    let lights: Vec<Light> = scene.lights.iter().map(Light::compile).collect();
    CompiledScene {
        eye_in_medium: match camera.eye() {
            Some(eye) => media.iter().any(|&id| world.primitives()[id as usize].contains(eye)),
            None => !media.is_empty(),
        },
        eye_vantage: camera.eye().and_then(|eye| world.vantage(eye)),
        camera,
        light_vantages: vantages(&lights, &world),
        lights,
        world,
        objects,
        materials,
        textures: Textures::compile(scene),
        background: scene.background,
        ambient: scene.ambient,
        fog: scene.fog.as_ref().map(Fog::compile),
        picture: scene.picture,
        settings: scene.render,
        media,
        attenuates,
    }
}

/// Vantages take time and room to make; with more lights than this, only the first get one.
const MOST_VANTAGES: usize = 32;

fn vantages(lights: &[Light], world: &World) -> Vec<Option<Vantage>> {
    let made = lights.iter().take(MOST_VANTAGES).map(|light| world.vantage(light.position()?));
    made.chain(std::iter::repeat_with(|| None)).take(lights.len()).collect()
}

impl CompiledScene {
    /// A box around all shapes but the infinite planes.
    pub fn bounds(&self) -> Bounds {
        self.world.bounds()
    }

    /// Bytes held by the shapes and their search structures.
    pub fn geometry_memory(&self) -> usize {
        self.world.memory() + size_of_val(self.objects.as_slice())
    }

    /// The material of a primitive.
    #[inline]
    pub(crate) fn material(&self, primitive: u32) -> &Material {
        &self.materials[self.objects[primitive as usize].material as usize]
    }

    /// Number of shapes.
    pub fn shape_count(&self) -> usize {
        self.objects.len()
    }

    /// Width and height of the picture, in pixels.
    pub fn picture_size(&self) -> (u32, u32) {
        (self.picture.width, self.picture.height)
    }
}

struct Compiler {
    primitives: Vec<Primitive>,
    objects: Vec<PlacedObject>,
    /// The scene's, and after them the default material.
    materials: Vec<Material>,
}

impl Compiler {
    fn new(scene: &Scene) -> Compiler {
        let default = durer_scene::Material::default();
        let materials = scene.materials.iter().chain([&default]).map(Material::compile).collect();
        Compiler { primitives: Vec::new(), objects: Vec::new(), materials }
    }

    fn add(&mut self, object: &Object, world_from_parent: &DAffine3, inherited: Option<MaterialId>) {
        let world_from_object = *world_from_parent * object.transform.to_affine();
        let material = object.material.or(inherited);
        match &object.kind {
            ObjectKind::Group(children) => {
                for child in children {
                    self.add(child, &world_from_object, material);
                }
            }
            ObjectKind::Mesh(_)
            | ObjectKind::Particles(_)
            | ObjectKind::Instances(_)
            | ObjectKind::Import(_)
            | ObjectKind::Solid(_) => todo!(),
            ObjectKind::Shape(shape) => {
                let material = material.map_or(self.materials.len() as u32 - 1, |id| id.0);
                let mut primitive = place(shape, &world_from_object);
                primitive.mask = if self.materials[material as usize].is_clear() { CLEAR } else { OPAQUE };
                self.primitives.push(primitive);
                let identity = world_from_object == DAffine3::IDENTITY;
                let object_from_world = (!identity).then(|| world_from_object.inverse());
                let is_medium = shape.is_closed() && self.materials[material as usize].fills_with_medium();
                self.objects.push(PlacedObject { material, is_medium, object_from_world });
            }
        }
    }
}

/// The shape as geometry knows it, in the world.
fn place(shape: &Shape, world: &DAffine3) -> Primitive {
    match *shape {
        Shape::Plane { point, normal } => Primitive::plane(point, normal, world),
        Shape::Sphere { center, radius } => Primitive::sphere(center, radius, world),
        Shape::Box { min, max } => Primitive::cuboid(min, max, world),
        Shape::Cylinder { base, top, radius, open } => Primitive::cylinder(base, top, radius, open, world),
        Shape::Cone { base, top, base_radius, top_radius, open } => {
            Primitive::cone(base, top, [base_radius, top_radius], open, world)
        }
        Shape::Disc { center, normal, radius, inner_radius } => {
            Primitive::disc(center, normal, [inner_radius, radius], world)
        }
        Shape::Rectangle { corner, edges } => Primitive::rectangle(corner, edges, world),
        Shape::Triangle { vertices, uvs } => {
            Primitive::triangle(vertices, uvs.unwrap_or([DVec2::ZERO, DVec2::X, DVec2::Y]), world)
        }
        Shape::Torus { center, axis, radius, tube_radius } => {
            Primitive::torus(center, axis, [radius, tube_radius], world)
        }
    }
}

//! What the user described: plain data, and the one check that every scene passes before it can be rendered.
//!
//! A [`Scene`] holds the user's words, resolved: names have become ids, defaults are filled in. It does no I/O, has no
//! trait objects and knows neither file syntax nor rendering. [`Scene::check`] is the only door to a [`CheckedScene`].

mod camera;
mod check;
mod count;
mod data;
mod light;
mod material;
mod mesh;
mod metals;
mod object;
mod particles;
mod settings;
mod texture;
mod transform;

pub use camera::{Camera, Focus, Lens, Projection};
pub use check::{CheckedScene, Place, Problem, Step};
pub use count::Primitives;
pub use data::{Data, DataFile, Instances, Sizes};
pub use light::{Falloff, Light, LightKind, Strength};
pub use material::{
    Attenuation, Bump, Classic, Conductor, Emission, Glass, Material, MaterialKind, Matte, Metal, Mirror, NormalMap,
    Plastic, Principled, Relief, Sides,
};
pub use mesh::{Import, Mesh, MeshData, MeshNormals, MeshPart};
pub use metals::{MetalName, reflectance};
pub use object::{Object, ObjectKind, Operation, Shape, Solid};
pub use particles::{ParticleKind, Particles};
pub use settings::{
    Antialias, Background, Environment, Fog, Integrator, PathSettings, Picture, PixelFilter, RenderSettings, Trees,
};
pub use texture::{
    Channels, Encoding, Filter, ImageAsset, ImageId, ImageTexture, Mapping, MaterialId, Paint, Pattern, Space, Texture,
    TextureId, Wrap,
};
pub use transform::{Transform, TransformStep};

use durer_math::Rgb;

/// Everything that a picture is made from. Right-handed coordinates, +y up; lengths in any one unit; colours linear.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Where the eye is; `None` frames all bounded objects.
    pub camera: Option<Camera>,
    /// Size and encoding of the picture.
    pub picture: Picture,
    /// How it is computed.
    pub render: RenderSettings,
    /// What rays that leave the scene see.
    pub background: Background,
    /// Ambient light, from everywhere: multiplies each material's ambient coefficient.
    pub ambient: Rgb,
    /// Fog, if any.
    pub fog: Option<Fog>,
    /// The lights.
    pub lights: Vec<Light>,
    /// The image files that textures refer to.
    pub images: Vec<ImageAsset>,
    /// All textures, named and inline.
    pub textures: Vec<Texture>,
    /// All materials, named and inline.
    pub materials: Vec<Material>,
    /// The objects, nested as the user nested them.
    pub objects: Vec<Object>,
}

impl Default for Scene {
    /// An empty scene: nothing in it but the default lights and background.
    fn default() -> Scene {
        Scene {
            camera: None,
            picture: Picture::default(),
            render: RenderSettings::default(),
            background: Background::default(),
            ambient: Rgb::WHITE,
            fog: None,
            lights: Light::default_lights(),
            images: Vec::new(),
            textures: Vec::new(),
            materials: Vec::new(),
            objects: Vec::new(),
        }
    }
}

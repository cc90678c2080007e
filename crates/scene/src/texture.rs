//! Textures: colour that varies over space or over a surface.

use crate::Transform;
use durer_imaging::Bitmap;
use durer_math::{DVec3, Rgb};
use std::sync::Arc;

/// Index into [`Scene::images`](crate::Scene::images).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ImageId(pub u32);

/// Index into [`Scene::textures`](crate::Scene::textures).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct TextureId(pub u32);

/// Index into [`Scene::materials`](crate::Scene::materials).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct MaterialId(pub u32);

/// One colour everywhere, or a texture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Paint {
    /// The same everywhere.
    Color(Rgb),
    /// Varies from point to point.
    Texture(TextureId),
}

/// An image file that textures show.
#[derive(Clone, Debug, PartialEq)]
pub struct ImageAsset {
    /// Where it came from, as the scene file says it.
    pub file: String,
    /// Its pixels, as stored in the file.
    pub bitmap: Arc<Bitmap>,
}

/// A pattern, placed in space.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// Its name in the scene file; `None` for one written inline.
    pub name: Option<String>,
    /// From the pattern's space to that of the object it is on (or to that of its uv).
    pub transform: Transform,
    /// The pattern.
    pub pattern: Pattern,
}

/// What a solid pattern's coordinates are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Space {
    /// The object's own space, before its transforms: the pattern is carved from a block and moves with the object.
    #[default]
    Object,
    /// The surface's uv coordinates, with z = 0.
    Uv,
}

/// The patterns. Lengths are in the pattern's own space.
#[derive(Clone, Debug, PartialEq)]
pub enum Pattern {
    /// Cubes of two alternating paints: the first where `floor(x/size) + floor(y/size) + floor(z/size)` is even.
    Checker {
        /// The two paints.
        colors: [Paint; 2],
        /// Edge of a cube.
        size: f64,
        /// Coordinates used.
        space: Space,
    },
    /// Slabs across `axis`, in turn one of the paints.
    Stripes {
        /// Two or more paints.
        colors: Vec<Paint>,
        /// Direction across the stripes (any length but zero).
        axis: DVec3,
        /// Thickness of one slab.
        width: f64,
        /// Coordinates used.
        space: Space,
    },
    /// Tubes around the y axis, in turn one of the paints.
    Rings {
        /// Two or more paints.
        colors: Vec<Paint>,
        /// Thickness of one tube.
        width: f64,
        /// Coordinates used; with [`Space::Uv`], rings around uv (0, 0).
        space: Space,
    },
    /// Paints blended into each other at equal steps along `axis`, from 0 to `length`.
    Gradient {
        /// Two or more paints.
        colors: Vec<Paint>,
        /// Direction of the gradient (any length but zero).
        axis: DVec3,
        /// From the first paint to the last.
        length: f64,
        /// What is beyond.
        wrap: Wrap,
        /// Coordinates used.
        space: Space,
    },
    /// A picture from a file.
    Image(ImageTexture),
    /// Blotches of fractal gradient noise, blended between two paints.
    Noise {
        /// At the least and the greatest values.
        colors: [Paint; 2],
        /// Size of the largest blotches.
        size: f64,
        /// How many scales of noise are added, each half the size and half the strength of the one before; 1 to 16.
        octaves: u32,
    },
    /// Veins across the x axis, bent by noise, blended between two paints.
    Marble {
        /// The stone and its veins.
        colors: [Paint; 2],
        /// Distance between veins.
        size: f64,
        /// How far the veins are bent, in multiples of their distance.
        turbulence: f64,
        /// Scales of noise, 1 to 16.
        octaves: u32,
    },
    /// Year rings around the y axis, bent by noise, blended between two paints.
    Wood {
        /// Early and late wood.
        colors: [Paint; 2],
        /// Distance between rings.
        size: f64,
        /// How far the rings are bent, in multiples of their distance.
        turbulence: f64,
        /// Scales of noise, 1 to 16.
        octaves: u32,
    },
}

/// How an image lies on things.
#[derive(Clone, Debug, PartialEq)]
pub struct ImageTexture {
    /// The image.
    pub image: ImageId,
    /// How a point becomes a place (s, t) on the image; (0, 0) is its lower left corner, (1, 1) its upper right.
    pub mapping: Mapping,
    /// What is beyond the image's edges.
    pub wrap: Wrap,
    /// What is between pixel centres.
    pub filter: Filter,
    /// What the file's numbers mean.
    pub encoding: Encoding,
    /// Which of its channels are shown.
    pub channels: Channels,
    /// Multiplies what the file says.
    pub tint: Rgb,
}

/// The channels of an image that are shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Channels {
    /// Its colours.
    #[default]
    Color,
    /// Its alpha channel, as gray from 0 to 1; 1 if it has none.
    Alpha,
    /// Its red, as gray.
    Red,
    /// Its green, as gray.
    Green,
    /// Its blue, as gray.
    Blue,
}

/// How a point becomes a place (s, t) on an image.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Mapping {
    /// The surface's own uv.
    #[default]
    Uv,
    /// Straight down the z axis: s = x, t = y, one image to a unit square.
    Planar,
    /// Around the origin: s = (atan2(z, x) + π) / 2π, t = asin(y / |p|) / π + 1/2.
    Spherical,
    /// Around the y axis: s = (atan2(z, x) + π) / 2π, t = (y + h) / 2h.
    Cylindrical {
        /// h: the image reaches from y = -h to y = h.
        half_height: f64,
    },
}

/// What is beyond the end of a pattern.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Wrap {
    /// The same again.
    #[default]
    Repeat,
    /// The colour of the edge.
    Clamp,
    /// The same mirrored, in turn.
    Mirror,
}

/// What is between pixel centres.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Filter {
    /// The colour of the nearest pixel.
    Nearest,
    /// Blended from the four around, in linear light.
    #[default]
    Bilinear,
}

/// What an image file's numbers mean.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Encoding {
    /// Colours encoded for screens, as photographs are.
    #[default]
    Srgb,
    /// Linear light, as measured data are.
    Linear,
}

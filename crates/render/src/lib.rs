//! From a checked scene to a picture: [`compile`] makes flat arrays of it, [`render`] fills a [`Film`].
//!
//! Sees no path, no name and no line number.

mod antialias;
mod background;
mod camera;
mod compile;
mod explain;
mod film;
mod fog;
mod integrators;
mod lights;
mod materials;
mod media;
mod observer;
mod pixel;
mod schedule;
mod shading;
mod textures;
mod visibility;

pub use compile::{CompiledScene, compile};
pub use durer_geometry::Bounds;
pub use explain::{
    Contribution, HitExplanation, LightExplanation, PixelExplanation, RayExplanation, SampleExplanation, explain,
};
pub use film::{Film, Region};
pub use observer::{NotTraced, RayCounts, RayKind, Source};
pub use schedule::{Progress, RenderError, RenderOptions, render};

//! From a checked scene to a picture: [`compile`] makes flat arrays of it, [`render`] fills a [`Film`].
//!
//! Sees no path, no name and no line number.

mod ahead;
mod antialias;
mod background;
#[allow(dead_code)] // until the path tracer is wired
mod bsdf;
mod camera;
mod compile;
#[allow(dead_code)]
mod emitters;
mod explain;
mod eye;
mod film;
mod first_hits;
mod fog;
#[allow(dead_code)]
mod frame;
mod heatmap;
mod holes;
#[allow(dead_code)]
mod integrators;
mod lights;
mod materials;
mod media;
mod memory;
mod observer;
mod pixel;
mod reconstruct;
#[allow(dead_code)]
mod sampler;
mod schedule;
mod shading;
mod textures;
mod visibility;

pub use compile::{CompiledScene, GeometryMemory, compile, compile_for};
pub use durer_geometry::{Bounds, SimdLevel};
pub use explain::{
    Contribution, Element, HitExplanation, HoleExplanation, LightExplanation, PixelExplanation, RayExplanation,
    SampleExplanation, explain,
};
pub use film::{BadSample, Film, FilmParts, Region};
pub use heatmap::{HeatMap, heatmap};
pub use memory::memory_needed;
pub use observer::{NotTraced, RayCounts, RayKind, Scattering, Source, Weighing};
pub use schedule::{Progress, RenderError, RenderOptions, render, render_on, with_threads};

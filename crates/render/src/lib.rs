//! From a checked scene to a picture: [`compile`] makes flat arrays of it, [`render`] fills a [`Film`].
//!
//! Sees no path, no name and no line number.

mod ahead;
mod antialias;
mod background;
mod bsdf;
mod camera;
mod casters;
mod compile;
#[allow(dead_code)]
mod emitters;
mod explain;
mod eye;
mod film;
mod filter_sampling;
mod first_hits;
mod fog;
mod frame;
mod heatmap;
mod holes;
mod integrators;
mod lanes;
mod lights;
mod materials;
mod media;
mod memory;
mod observer;
mod passes;
mod pixel;
mod reconstruct;
mod sampler;
mod schedule;
mod seen_first;
mod shading;
mod surfaces;
mod textures;
mod visibility;
mod whitted_reading;

pub use compile::{CompiledScene, GeometryMemory, compile, compile_for};
pub use durer_geometry::{Bounds, SimdLevel};
pub use explain::{
    ArrivalExplanation, Contribution, Element, HitExplanation, HoleExplanation, JunctionExplanation, LightExplanation,
    PixelExplanation, RayExplanation, RelativeTo, ReuseExplanation, SampleExplanation, Turn, explain,
};
pub use film::{BadSample, Calm, Film, FilmOutline, FilmParts, MergeError, Merging, Part, Region, SampleRange, Sums};
pub use heatmap::{HeatMap, heatmap};
pub use memory::memory_needed;
pub use observer::{NotTraced, RayCounts, RayKind, Scattering, Sharing, Source, Way, Weighing};
pub use schedule::{Progress, RenderError, RenderOptions, coverage, render, render_on, with_threads};
pub use seen_first::{SeenFirst, seen_first};

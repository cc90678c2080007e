//! durer: true pictures of geometry. A ray tracer with exact shapes, as a library.
//!
//! A picture is made by five values passed along one line; each arrow is a function here:
//!
//! ```text
//! bytes ─load─▶ Scene ─check─▶ CheckedScene ─compile─▶ CompiledScene ─render─▶ Film ─develop─▶ Image ─encode─▶ bytes
//! ```
//!
//! ```
//! let text = "objects: [sphere: {radius: 1, material: {color: tomato}}]";
//! let loaded = durer::load_str(text, "ball.yaml", &durer::NoAssets, &durer::Limits::default())?;
//! let film = durer::render(&durer::compile(&loaded.scene), &durer::RenderOptions::default(), &())?;
//! let image = film.develop();
//! assert_eq!((image.width, image.height), (640, 480));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod admit;
mod checkpoint;
mod files;
mod film_layers;
mod scene_hash;
mod whole;

pub use admit::admit;
pub use checkpoint::{
    Checkpoint, CheckpointError, CheckpointOutline, Origin, encode_checkpoint, read_checkpoint, read_checkpoint_outline,
};
pub use durer_formats::{
    AssetError, Assets, Diagnostic, Diagnostics, Exceeded, FolderAssets, Limit, Limits, LoadOptions, Loaded,
    MemoryAssets, NoAssets, Overlay, Related, Severity, Sources, json_schema, load_bytes, load_file, load_file_under,
    load_str, reference_markdown, scene_fingerprint, to_yaml,
};
pub use durer_imaging as imaging;
pub use durer_math as math;
pub use durer_render::{
    ArrivalExplanation, BadSample, Bounds, Calm, CompiledScene, Contribution, Element, Film, FilmOutline, FilmParts,
    GeometryMemory, HeatMap, HitExplanation, HoleExplanation, JunctionExplanation, LightExplanation, MergeError,
    Merging, NotTraced, Part, PixelExplanation, Progress, RayCounts, RayExplanation, RayKind, Region, RelativeTo,
    RenderError, RenderOptions, ReuseExplanation, SampleExplanation, SampleRange, Scattering, SeenFirst, Sharing,
    SimdLevel, Source, Sums, Turn, Way, Weighing, compile, compile_for, coverage, explain, heatmap, memory_needed,
    render, render_on, seen_first, with_threads,
};
pub use durer_scene as scene;
pub use durer_scene::{CheckedScene, Scene};
pub use files::{PictureFile, ReadError, WriteError, picture_facts, picture_layers, read_layers, read_picture};
pub use film_layers::{FilmLayer, film_layers};
pub use scene_hash::{SceneHash, SceneItem};
pub use whole::{temporary_beside, write_whole};

//! What it takes to find what the eye sees: for each pixel, how much of the search structures one ray of the eye goes
//! through.
//!
//! The ray is that of a picture without anti-aliasing, and the search the usual one of a single ray through the trees, of
//! which every step is counted. (Rendering has shorter ways for the eye's rays, in small scenes and for neighbors that go
//! together, which are left out here.)

use crate::antialias::{Antialias, Sample, Samples, grid::Grid};
use crate::compile::CompiledScene;
use crate::film::Region;
use crate::schedule::{Progress, RenderError, RenderOptions, in_tiles, region_of, with_pool};
use durer_geometry::Work;
use durer_math::{DVec2, Rgb};

/// What each pixel of a region took: rows from the top, pixels from the left.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct HeatMap {
    /// Part of the picture that this is.
    pub region: Region,
    /// Nodes of trees whose boxes were tested.
    pub nodes: Vec<u32>,
    /// Shapes, triangles and particles that were tested.
    pub primitives: Vec<u32>,
}

/// Counts what the eye's rays take. What `progress` stops is 0.
pub fn heatmap(
    scene: &CompiledScene,
    options: &RenderOptions,
    progress: &dyn Progress,
) -> Result<HeatMap, RenderError> {
    let region = region_of(scene, options)?;
    let nothing = vec![0; region.width as usize * region.height as usize];
    let mut gathered = (HeatMap { region, nodes: nothing.clone(), primitives: nothing }, 0);
    let put = |(map, finished): &mut (HeatMap, u64), (tile, counts): (Region, Vec<Work>)| {
        map.put(tile, &counts);
        *finished += tile.pixels();
        progress.finished(*finished, region.pixels());
    };
    with_pool(options, || {
        in_tiles(region.tiles().collect(), progress, &mut gathered, |tile| (tile, count(scene, tile)), put);
    })?;
    Ok(gathered.0)
}

/// One entry for each pixel, row by row.
fn count(scene: &CompiledScene, tile: Region) -> Vec<Work> {
    tile.pixel_places().map(|(x, y)| count_pixel(scene, DVec2::new(f64::from(x), f64::from(y)))).collect()
}

fn count_pixel(scene: &CompiledScene, corner: DVec2) -> Work {
    let mut counter = Counter { scene, work: Work::default() };
    Grid::new(1).pixel(corner, &mut counter);
    counter.work
}

/// Follows samples no further than to what they see first.
struct Counter<'a> {
    scene: &'a CompiledScene,
    work: Work,
}

impl Samples for Counter<'_> {
    fn take(&mut self, at: DVec2) -> Sample {
        let ray = self.scene.camera.ray(at);
        let _ = self.scene.world.closest_hit_watched(&ray, f64::INFINITY, u32::MAX, &mut self.work);
        Sample { color: Rgb::BLACK, index: 0 }
    }

    fn keep(&mut self, _weight: f32, _sample: Sample) {}

    fn divided(&mut self, _depth: u32) {}
}

impl HeatMap {
    fn put(&mut self, tile: Region, counts: &[Work]) {
        let narrow = |count: u64| u32::try_from(count).unwrap_or(u32::MAX);
        for (row, works) in counts.chunks(tile.width as usize).enumerate() {
            let y = (tile.y - self.region.y) as usize + row;
            let start = y * self.region.width as usize + (tile.x - self.region.x) as usize;
            for (at, work) in (start..).zip(works) {
                (self.nodes[at], self.primitives[at]) = (narrow(work.nodes), narrow(work.primitives));
            }
        }
    }
}

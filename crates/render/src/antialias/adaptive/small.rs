//! Things so small or thin in the picture that samples may miss them: known before a ray is traced, since it is known where
//! they are.

use super::super::lattice::UNIT;
use super::Cell;
use crate::camera::Projected;
use crate::compile::CompiledScene;
use crate::eye::{Look, thing};
use crate::film::Region;
use durer_geometry::Slender;
use durer_math::DVec2;

/// Thinner things are not looked for more closely: the samples are then so close to each other.
const MOST_LEVEL: u8 = 6;
/// Squares that a thing reaches into with less than this part of its radius may miss it.
const HEART: f64 = 0.45;
/// With more things than these in the scene, copies counted, none is looked for: they are too many to be known one by one.
pub(crate) const MOST_THINGS: u64 = 4_000_000;
/// Bytes that are held for one of them.
pub(crate) const SMALL_THING: u64 = size_of::<SmallThing>() as u64 + 8;
/// Rows in a bucket.
const BUCKET: u32 = 32;

/// A thing in the picture, in pixels.
#[derive(Clone, Copy, Debug)]
struct SmallThing {
    ends: [DVec2; 2],
    radius: f64,
    /// Its number, as [`Look::thing`] has it.
    number: u32,
    /// How far away its nearest point is.
    near: f32,
    /// True if it is found where one sample meets it: one is not enough for what may go on beside it, like a line.
    is_found_by_one: bool,
    /// How often pixels must be divided so that samples cannot all miss it.
    level: u8,
}

/// All of them, by the rows that they touch.
#[derive(Debug, Default)]
pub(crate) struct SmallThings {
    things: Vec<SmallThing>,
    buckets: Vec<Vec<u32>>,
}

/// Those of some pixels, pixel by pixel.
#[derive(Debug, Default)]
pub(crate) struct OfPixels {
    region: Option<Region>,
    /// Where those of each pixel start, and where the last ones end.
    starts: Vec<u32>,
    things: Vec<u32>,
}

impl SmallThings {
    /// Those of a scene.
    pub(crate) fn of(scene: &CompiledScene) -> SmallThings {
        let (width, height) = scene.picture_size();
        let primitives = scene.world.primitives();
        if primitives.iter().map(|primitive| primitive.thing_count() as u64).sum::<u64>() > MOST_THINGS {
            return SmallThings::default();
        }
        let mut things = Vec::new();
        for (primitive, index) in primitives.iter().zip(0..) {
            primitive.each_slender(&mut |slender, number| {
                for piece in scene.camera.project_pieces(slender.ends) {
                    let seen = SmallThing::seen(&slender, piece, (width, height));
                    let number = thing(index, number);
                    things.extend(seen.map(|seen| {
                        let is_found_by_one = slender.is_part || seen.is_found_by_one;
                        SmallThing { number, is_found_by_one, ..seen }
                    }));
                }
            });
        }
        SmallThings::sorted(things, height)
    }

    /// Those of a picture so high.
    fn sorted(things: Vec<SmallThing>, height: u32) -> SmallThings {
        let mut buckets = vec![Vec::new(); height.div_ceil(BUCKET) as usize];
        for (index, thing) in (0..).zip(&things) {
            let [first, last] = thing.rows(height);
            for bucket in first / BUCKET..=last / BUCKET {
                buckets[bucket as usize].push(index);
            }
        }
        SmallThings { things, buckets }
    }

    /// Discs in front of all else, all with the number 0: their middles and radii, in pixels.
    #[cfg(test)]
    pub(crate) fn discs(discs: impl IntoIterator<Item = (DVec2, f64)>, height: u32) -> SmallThings {
        let things = discs.into_iter().filter_map(|(at, radius)| SmallThing::new([at; 2], radius, radius, 0.4));
        SmallThings::sorted(things.collect(), height)
    }

    /// Sorts out which of them touch which pixels.
    pub(super) fn of_pixels(&self, region: Region) -> OfPixels {
        if self.things.is_empty() {
            return OfPixels::default();
        }
        let last = (region.y + region.height - 1) / BUCKET;
        let mut near: Vec<u32> =
            (region.y / BUCKET..=last).flat_map(|b| self.buckets[b as usize].iter().copied()).collect();
        near.sort_unstable();
        near.dedup();
        let mut touched: Vec<(u32, u32)> = Vec::new();
        for index in near {
            self.things[index as usize].each_pixel(region, |pixel| touched.push((pixel, index)));
        }
        touched.sort_unstable();
        let pixels = region.pixels() as usize;
        let mut starts = vec![0; pixels + 1];
        for &(pixel, _) in &touched {
            starts[pixel as usize + 1] += 1;
        }
        for pixel in 0..pixels {
            starts[pixel + 1] += starts[pixel];
        }
        OfPixels { region: Some(region), starts, things: touched.into_iter().map(|(_, index)| index).collect() }
    }

    /// How often the pixel must be divided where a cell is: until no small thing in it can be missed. One that is seen there
    /// is not missed, and one that is hidden behind all that is seen there, either.
    pub(super) fn depth_needed<'a>(
        &self,
        of_pixels: &OfPixels,
        cell: Cell,
        looks: impl FnOnce() -> [&'a Look; 5],
    ) -> u8 {
        let things = of_pixels.at(cell);
        if things.is_empty() {
            return 0;
        }
        let looks = looks();
        let missed = |thing: &&SmallThing| {
            let is_hidden = || looks.iter().all(|look| look.hides && look.depth <= thing.near);
            let is_seen = || thing.is_found_by_one && looks.iter().any(|look| look.thing == thing.number);
            thing.level > cell.level && thing.touches(cell) && !is_seen() && !is_hidden()
        };
        things
            .iter()
            .map(|&index| &self.things[index as usize])
            .filter(missed)
            .map(|thing| thing.level)
            .max()
            .unwrap_or(0)
    }
}

impl OfPixels {
    /// True if some touch the pixel where a cell is.
    pub(super) fn has_any(&self, cell: Cell) -> bool {
        !self.at(cell).is_empty()
    }

    fn at(&self, cell: Cell) -> &[u32] {
        let Some(region) = self.region else { return &[] };
        let (x, y) = cell.pixel();
        let pixel = ((y - region.y) * region.width + x - region.x) as usize;
        &self.things[self.starts[pixel] as usize..self.starts[pixel + 1] as usize]
    }
}

impl SmallThing {
    /// A piece of a thing, between two points of its line. `None` if it is out of the picture, too.
    fn seen(slender: &Slender, [a, b]: [Projected; 2], (width, height): (u32, u32)) -> Option<SmallThing> {
        let radius = slender.radius * a.scale.max(b.scale);
        let core = slender.core * a.scale.min(b.scale);
        let (min, max) = (a.at.min(b.at) - radius, a.at.max(b.at) + radius);
        let is_in_picture = max.x >= 0.0 && max.y >= 0.0 && min.x <= f64::from(width) && min.y <= f64::from(height);
        // Between its ends a line may come nearer to the eye, but not nearer than its depth. A little less, for the rounding.
        let near = (a.depth.min(b.depth) - slender.radius * 1.001) as f32;
        if is_in_picture { SmallThing::new([a.at, b.at], radius, core, near) } else { None }
    }

    /// `None` if it is so large that samples meet it.
    fn new(ends: [DVec2; 2], radius: f64, core: f64, near: f32) -> Option<SmallThing> {
        // Between corners and middles of pixels there is room for a circle of half a pixel. What is wide is met where it
        // is widest, though its outline may have thin parts.
        if radius > 1.0 || core >= 0.5 {
            return None;
        }
        let level = (0..MOST_LEVEL).find(|&level| 0.95 * core * f64::from(1_u32 << level) >= 0.5).unwrap_or(MOST_LEVEL);
        let is_found_by_one = (ends[1] - ends[0]).length() <= 2.0 * radius;
        Some(SmallThing { ends, radius, number: 0, near, is_found_by_one, level })
    }

    /// The first and the last row of pixels that it may touch.
    fn rows(&self, height: u32) -> [u32; 2] {
        let [a, b] = self.ends;
        let row = |y: f64| y.clamp(0.0, f64::from(height - 1)) as u32;
        [row(a.y.min(b.y) - self.radius), row(a.y.max(b.y) + self.radius)]
    }

    /// Calls `visit` with the pixels of a region that it may touch, counted row by row.
    fn each_pixel(&self, region: Region, mut visit: impl FnMut(u32)) {
        let [a, b] = self.ends;
        let [first, last] = self.rows(u32::MAX);
        let along = b - a;
        for row in first.max(region.y)..=last.min(region.y + region.height - 1) {
            // The part of the line from which the row can be reached.
            let (top, bottom) = (f64::from(row) - self.radius, f64::from(row + 1) + self.radius);
            let at = |y: f64| if along.y == 0.0 { 0.0 } else { ((y - a.y) / along.y).clamp(0.0, 1.0) };
            let [from, to] = if along.y == 0.0 { [0.0, 1.0] } else { [at(top), at(bottom)] };
            let (from, to) = (a.x + along.x * from, a.x + along.x * to);
            let column = |x: f64| x.clamp(0.0, f64::from(u32::MAX)) as u32;
            let (left, right) = (column(from.min(to) - self.radius), column(from.max(to) + self.radius));
            for x in left.max(region.x)..=right.min(region.x + region.width - 1) {
                visit((row - region.y) * region.width + x - region.x);
            }
        }
    }

    /// True if it reaches into a cell with more than its rim: what it has there beyond that is left to chance.
    fn touches(&self, cell: Cell) -> bool {
        let min = cell.place.point();
        let max = min + f64::from(cell.side()) / f64::from(UNIT);
        distance(self.ends, [min, max]) <= self.radius * HEART
    }
}

/// From a line to a square.
fn distance([a, b]: [DVec2; 2], [min, max]: [DVec2; 2]) -> f64 {
    let to_square = |point: DVec2| (point - point.clamp(min, max)).length();
    let corners = [min, DVec2::new(max.x, min.y), max, DVec2::new(min.x, max.y)];
    let along = b - a;
    let squared = along.length_squared();
    let to_line = |point: DVec2| {
        let t = if squared > 0.0 { ((point - a).dot(along) / squared).clamp(0.0, 1.0) } else { 0.0 };
        (a + along * t - point).length()
    };
    // A line that crosses the square has corners on both sides of it, and a point in it.
    let sides = corners.map(|corner| along.perp_dot(corner - a) > 0.0);
    let crosses = sides.contains(&true) && sides.contains(&false) && {
        let (low, high) = (a.min(b), a.max(b));
        low.cmple(max).all() && high.cmpge(min).all()
    };
    if crosses {
        0.0
    } else {
        corners.map(to_line).into_iter().chain([a, b].map(to_square)).fold(f64::INFINITY, f64::min)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The pixels of a region that things touch do not depend on the region.
    #[test]
    fn each_region_has_its_own_part_of_the_pixels() {
        let at = DVec2::new;
        let ends = [
            [at(3.2, 4.1); 2],
            [at(1.0, 30.0), at(30.0, 2.5)],
            [at(40.0, 7.5), at(2.0, 7.5)],
            [at(9.5, 41.0), at(9.0, -3.0)],
        ];
        let things = || ends.iter().filter_map(|&ends| SmallThing::new(ends, 0.3, 0.3, 1.0));
        let touched = |region: Region| -> Vec<(usize, u32, u32)> {
            let mut all = Vec::new();
            for (index, thing) in things().enumerate() {
                thing.each_pixel(region, |pixel| {
                    all.push((index, region.x + pixel % region.width, region.y + pixel / region.width));
                });
            }
            all.sort_unstable();
            all
        };
        let whole = touched(Region { x: 0, y: 0, width: 48, height: 48 });
        assert!(whole.iter().any(|&(index, ..)| index == 3));
        for (x, y, width, height) in [(0, 0, 48, 5), (10, 3, 7, 9), (0, 20, 48, 28), (3, 4, 1, 1)] {
            let is_in = |&(_, a, b): &(usize, u32, u32)| (x..x + width).contains(&a) && (y..y + height).contains(&b);
            let expected: Vec<_> = whole.iter().copied().filter(is_in).collect();
            assert_eq!(touched(Region { x, y, width, height }), expected);
        }
        // Along a line, every pixel that it crosses is among them.
        for step in 0..=400 {
            let point = ends[1][0].lerp(ends[1][1], f64::from(step) / 400.0);
            assert!(whole.contains(&(1, point.x as u32, point.y as u32)), "{point}");
        }
    }

    #[test]
    fn distances_from_lines_to_squares() {
        let at = DVec2::new;
        let unit = [DVec2::ZERO, DVec2::ONE];
        assert_eq!(distance([at(-1.0, 0.5), at(2.0, 0.6)], unit), 0.0, "it goes through");
        assert_eq!(distance([at(0.4, 0.5), at(0.6, 0.6)], unit), 0.0, "it lies within");
        assert_eq!(distance([at(0.5, -2.0), at(0.5, -0.25)], unit), 0.25, "it ends before");
        assert!((distance([at(2.0, 0.0), at(0.0, 2.0)], [DVec2::ZERO, at(0.5, 0.5)]) - 0.5_f64.sqrt()).abs() < 1e-12);
        assert!((distance([at(4.0, 5.0); 2], unit) - 5.0).abs() < 1e-12, "it is a point");
    }
}

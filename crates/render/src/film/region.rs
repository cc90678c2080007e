//! Rectangles of pixels, and how they are cut.

/// Edge of a tile, in pixels: small enough to share out evenly, large enough that sharing costs nothing.
pub(crate) const TILE: u32 = 32;

/// A rectangle of pixels within a picture. The default is empty.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Region {
    /// Left edge, in pixels from the picture's left.
    pub x: u32,
    /// Upper edge, in pixels from the picture's top.
    pub y: u32,
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
}

impl Region {
    /// The number of its pixels.
    pub fn pixels(&self) -> u64 {
        u64::from(self.width) * u64::from(self.height)
    }

    /// The number of tiles that it is cut into.
    pub fn tile_count(&self) -> u64 {
        u64::from(self.width.div_ceil(TILE)) * u64::from(self.height.div_ceil(TILE))
    }

    /// The columns and rows of its pixels, row by row.
    pub(crate) fn pixel_places(self) -> impl Iterator<Item = (u32, u32)> {
        (self.y..self.y + self.height).flat_map(move |y| (self.x..self.x + self.width).map(move |x| (x, y)))
    }

    /// With so many pixels more on all sides, as far as the picture goes.
    pub(crate) fn grown(self, by: u32, (width, height): (u32, u32)) -> Region {
        let (x, y) = (self.x.saturating_sub(by), self.y.saturating_sub(by));
        let right = self.x.saturating_add(self.width).saturating_add(by).min(width);
        let bottom = self.y.saturating_add(self.height).saturating_add(by).min(height);
        Region { x, y, width: right - x, height: bottom - y }
    }

    /// Cuts it into tiles, row by row.
    pub(crate) fn tiles(self) -> impl Iterator<Item = Region> {
        self.bands().flat_map(|band| {
            let starts = (0..band.width).step_by(TILE as usize);
            starts.map(move |d| Region { x: band.x + d, width: TILE.min(band.width - d), ..band })
        })
    }

    /// Cuts it into rows of tiles.
    pub(crate) fn bands(self) -> impl Iterator<Item = Region> {
        let starts = (0..self.height).step_by(TILE as usize);
        starts.map(move |d| Region { y: self.y + d, height: TILE.min(self.height - d), ..self })
    }

    /// Cuts it along the lines of a grid with cells of this edge, which begins at the picture's corner: row by row.
    pub(crate) fn cells(self, edge: u32) -> impl Iterator<Item = Region> {
        let pieces = move |from: u32, length: u32| {
            let end = from + length;
            let starts = std::iter::successors(Some(from), move |&at| Some((at / edge + 1).saturating_mul(edge)));
            starts
                .take_while(move |&at| at < end)
                .map(move |at| (at, (at / edge + 1).saturating_mul(edge).min(end) - at))
        };
        pieces(self.y, self.height).flat_map(move |(y, height)| {
            pieces(self.x, self.width).map(move |(x, width)| Region { x, y, width, height })
        })
    }

    /// The number of these cells.
    pub(crate) fn cell_count(self, edge: u32) -> u64 {
        let across = |from: u32, length: u32| u64::from((from + length.max(1) - 1) / edge + 1 - from / edge);
        across(self.x, self.width) * across(self.y, self.height)
    }

    /// True if it is not empty, and its pixels can be counted.
    pub(crate) fn is_somewhere(self) -> bool {
        self.x.checked_add(self.width).is_some() && self.y.checked_add(self.height).is_some() && self.pixels() > 0
    }

    /// True if this pixel is in it.
    pub(crate) fn contains(self, (x, y): (u32, u32)) -> bool {
        (self.x..self.x + self.width).contains(&x) && (self.y..self.y + self.height).contains(&y)
    }

    /// What both have; `None` if that is nothing.
    pub(crate) fn intersection(self, other: Region) -> Option<Region> {
        let (x, y) = (self.x.max(other.x), self.y.max(other.y));
        let right = (self.x + self.width).min(other.x + other.width);
        let bottom = (self.y + self.height).min(other.y + other.height);
        (x < right && y < bottom).then(|| Region { x, y, width: right - x, height: bottom - y })
    }

    /// The place of a pixel among its pixels, row by row.
    pub(crate) fn index_of(self, x: u32, y: u32) -> usize {
        (y - self.y) as usize * self.width as usize + (x - self.x) as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cover_once(region: Region, pieces: impl Iterator<Item = Region>) {
        let mut seen = vec![0; region.pixels() as usize];
        for (x, y) in pieces.flat_map(Region::pixel_places) {
            seen[region.index_of(x, y)] += 1;
        }
        assert!(seen.iter().all(|&n| n == 1));
    }

    #[test]
    fn tiles_and_cells_cover_a_region_once() {
        let region = Region { x: 5, y: 7, width: 70, height: 33 };
        cover_once(region, region.tiles());
        for edge in [8, 32, 100] {
            cover_once(region, region.cells(edge));
            assert!(region.cells(edge).all(|cell| cell.x / edge == (cell.x + cell.width - 1) / edge));
            assert_eq!(region.cells(edge).count() as u64, region.cell_count(edge));
        }
        let last = Region { x: u32::MAX - 40, y: u32::MAX - 3, width: 40, height: 3 };
        assert_eq!(last.cells(32).map(|cell| cell.pixels()).sum::<u64>(), last.pixels());
    }

    #[test]
    fn intersections_are_what_both_have() {
        let region = |x, y, width, height| Region { x, y, width, height };
        assert_eq!(region(0, 0, 5, 5).intersection(region(3, 2, 5, 5)), Some(region(3, 2, 2, 3)));
        assert_eq!(region(0, 0, 5, 5).intersection(region(5, 0, 5, 5)), None);
    }
}

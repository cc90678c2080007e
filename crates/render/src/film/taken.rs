//! Films that are not finished, taken for what they have: then they are finished films of these samples, and can be merged.

use super::sums::MOST_PARTS;
use super::{Film, Part, Region, SampleRange};

/// A run of pixels in a row with as many samples.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Run {
    x: u32,
    width: u32,
    taken: u32,
}

impl Film {
    /// The film as one of just the samples that it has, pixel by pixel, finished; nothing changes for one that is. `None` if it
    /// has none, or is of more pieces than a film can be of.
    #[must_use]
    pub fn of_what_it_has(mut self) -> Option<Film> {
        if self.is_complete() {
            return Some(self);
        }
        let region = self.region;
        let sums = self.sums.as_mut()?;
        let first = sums.parts.first()?.samples.start;
        sums.parts = pieces(region, &sums.taken, first)?;
        self.finish();
        Some(self)
    }
}

/// The parts of a film whose pixels have so many samples each, from the same one on; `None` if there are too many of them, or
/// none.
fn pieces(region: Region, taken: &[u32], first: u32) -> Option<Vec<Part>> {
    let mut pieces: Vec<Part> = Vec::new();
    // Those that reach down to the row before, with their runs.
    let mut open: Vec<(Run, usize)> = Vec::new();
    for (row, y) in taken.chunks(region.width as usize).zip(region.y..) {
        let mut next = Vec::new();
        for run in runs(row, region.x) {
            let index = match open.binary_search_by_key(&run.x, |(run, _)| run.x) {
                Ok(at) if open[at].0 == run => open[at].1,
                Ok(_) | Err(_) => {
                    let samples = SampleRange { start: first, end: first.checked_add(run.taken)? };
                    pieces.push(Part { region: Region { x: run.x, y, width: run.width, height: 0 }, samples });
                    pieces.len() - 1
                }
            };
            pieces[index].region.height += 1;
            next.push((run, index));
        }
        if pieces.len() > MOST_PARTS {
            return None;
        }
        open = next;
    }
    pieces.sort_by_key(Part::order);
    (!pieces.is_empty()).then_some(pieces)
}

/// The runs of a row that begins at `left`, without those that have nothing.
fn runs(row: &[u32], left: u32) -> impl Iterator<Item = Run> {
    let mut x = left;
    row.chunk_by(|a, b| a == b).filter_map(move |run| {
        let (start, width, taken) = (x, run.len() as u32, run[0]);
        x += width;
        (taken > 0).then_some(Run { x: start, width, taken })
    })
}

#[cfg(test)]
mod tests {
    use super::super::PixelSums;
    use super::*;
    use durer_math::Rgb;

    /// Of 40 × 12 pixels from 5,7, with as many samples each as is said, of which this is the number of the first.
    fn film(first: u32, taken: impl Fn(u32, u32) -> u32) -> Film {
        let region = Region { x: 5, y: 7, width: 40, height: 12 };
        let mut film = Film::of_samples(region, SampleRange { start: first, end: first + 100 }, false);
        let sums = film.sums.as_mut().unwrap();
        for (pixel, (x, y)) in region.pixel_places().enumerate() {
            let mut some = PixelSums::default();
            (0..taken(x, y)).for_each(|n| some.add(Rgb::gray((first + n) as f32), Rgb::BLACK, false).unwrap());
            sums.add(pixel, &some);
        }
        film
    }

    #[test]
    fn pieces_have_just_the_samples_that_there_are() {
        let counts: [fn(u32, u32) -> u32; 5] = [
            |_, _| 3,
            |x, y| if x < 20 && y < 11 { 8 } else { 4 },
            |x, y| if x % 7 == 0 { 0 } else { (x / 8 + y / 4) % 3 },
            |x, _| u32::from(x == 44),
            |x, y| if (x, y) == (5, 7) { 0 } else { 2 },
        ];
        for taken in counts {
            let had = film(6, taken).of_what_it_has().unwrap();
            let parts = &had.sums().unwrap().parts;
            assert!(had.is_complete() && had.outline().is_possible());
            for (x, y) in had.region().pixel_places() {
                let here = Region { x, y, width: 1, height: 1 };
                let of: Vec<SampleRange> = parts
                    .iter()
                    .filter(|part| part.region.intersection(here).is_some())
                    .map(|part| part.samples)
                    .collect();
                let expected = SampleRange { start: 6, end: 6 + taken(x, y) };
                assert_eq!(of, if expected.count() > 0 { vec![expected] } else { Vec::new() }, "{x},{y}");
            }
        }
        assert_eq!(film(0, |_, _| 3).of_what_it_has().unwrap().sums().unwrap().parts.len(), 1);
        assert_eq!(
            film(0, |x, y| if x < 20 && y < 11 { 8 } else { 4 }).of_what_it_has().unwrap().sums().unwrap().parts.len(),
            3
        );
        assert!(film(0, |_, _| 0).of_what_it_has().is_none());
    }

    /// What is merged is what was there, whatever is missing; and no sample is counted twice.
    #[test]
    fn unfinished_films_are_merged_for_what_they_have() {
        let first = film(0, |x, _| if x < 25 { 6 } else { 0 });
        let (second, overlapping) = (film(6, |_, y| y % 3), film(5, |_, _| 1));
        assert!(Film::merge(&[first.clone(), second.clone()]).is_err(), "as they are");
        let [first, second, overlapping] = [first, second, overlapping].map(|film| film.of_what_it_has().unwrap());
        let merged = Film::merge(&[second, first.clone()]).unwrap();
        for (pixel, (x, y)) in merged.region().pixel_places().enumerate() {
            let taken = if x < 25 { 6 } else { 0 } + y % 3;
            assert_eq!(merged.sums().unwrap().taken[pixel], taken, "{x},{y}");
        }
        assert!(!merged.gaps().0.is_empty());
        assert!(matches!(Film::merge(&[first, overlapping]), Err(crate::MergeError::Overlap { .. })));
    }
}

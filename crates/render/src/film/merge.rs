//! Films of parts of a picture, put together: other samples, other regions, or both.

use super::{Account, Film, Part, Region, SampleRange, Sums};

/// Why films cannot be put together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum MergeError {
    /// There is none.
    Nothing,
    /// The film with this index has no samples: its integrator takes none.
    NoSamples(usize),
    /// The film with this index is not finished.
    Unfinished(usize),
    /// The film with this index has the light of single surfaces apart, and another has not, or the other way around.
    OtherKind(usize),
    /// These two have samples of the same pixels with the same numbers.
    Overlap {
        /// The index of the one.
        first: usize,
        /// That of the other.
        second: usize,
        /// What both have.
        both: Part,
    },
    /// They are parts of so many pieces, or so far apart, that together they would be too large.
    TooScattered,
}

impl std::fmt::Display for MergeError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            MergeError::Nothing => write!(f, "there is no film"),
            MergeError::NoSamples(_) => write!(f, "its integrator takes no samples that could be added"),
            MergeError::Unfinished(_) => write!(f, "it is not finished"),
            MergeError::OtherKind(_) => write!(f, "it has other layers than the films before it"),
            MergeError::Overlap { both, .. } => write!(f, "both have {both}"),
            MergeError::TooScattered => write!(f, "they are too many pieces, or too far apart"),
        }
    }
}

impl std::error::Error for MergeError {}

/// What lies between films may take up so many times their own pixels.
const MOST_EMPTY: u64 = 16;
/// Pieces of which something is missing are not searched any further.
const MOST_PIECES: usize = 4096;

impl Film {
    /// Puts films of the same scene together; their order does not matter. The film that has all of their samples is, to the
    /// last bit, that of one run which took them all.
    ///
    /// # Errors
    ///
    /// One of them is no finished film of samples, or two have the same ones.
    pub fn merge(films: &[Film]) -> Result<Film, MergeError> {
        let sums: Vec<&Sums> = sums_of(films)?;
        let all: Vec<Part> = sums.iter().flat_map(|sums| &sums.parts).copied().collect();
        let of: Vec<usize> = sums.iter().enumerate().flat_map(|(film, sums)| vec![film; sums.parts.len()]).collect();
        if all.len() > super::sums::MOST_PARTS {
            return Err(MergeError::TooScattered);
        }
        for (index, part) in all.iter().enumerate() {
            let other = all[..index].iter().enumerate().find_map(|(at, other)| Some((at, part.both(other)?)));
            if let Some((at, both)) = other {
                return Err(MergeError::Overlap { first: of[at], second: of[index], both });
            }
        }
        let around = Part::around(&all).ok_or(MergeError::Nothing)?;
        let pixels: u64 = films.iter().map(|film| film.region.pixels()).sum();
        if around.region.pixels() > pixels.saturating_mul(MOST_EMPTY) {
            return Err(MergeError::TooScattered);
        }
        let mut merged = Film::new(around.region);
        let mut into = Sums::new(around, !sums[0].direct.is_empty());
        let mut account = Account::default();
        for (film, sums) in films.iter().zip(&sums) {
            account.add(&film.account);
            for (pixel, (x, y)) in film.region.pixel_places().enumerate() {
                into.add(around.region.index_of(x, y), &sums.of(pixel));
            }
        }
        into.parts = joined(all, around);
        merged.pixels = (0..into.taken.len()).map(|pixel| into.mean(pixel)).collect();
        merged.samples = into.samples();
        (merged.sums, merged.account) = (Some(into), account);
        merged.finished.fill(true);
        merged.finished_pixels = around.region.pixels();
        Ok(merged)
    }

    /// What a film of samples lacks of being one of all its samples of all its pixels, in pieces; the first of many.
    pub fn gaps(&self) -> Vec<Part> {
        let Some(sums) = &self.sums else { return Vec::new() };
        let Some(around) = Part::around(&sums.parts) else { return Vec::new() };
        let mut gaps = vec![Part { region: self.region, samples: around.samples }];
        for part in &sums.parts {
            gaps = gaps.iter().flat_map(|gap| gap.without(part)).take(MOST_PIECES).collect();
        }
        join(&mut gaps);
        gaps
    }
}

fn sums_of(films: &[Film]) -> Result<Vec<&Sums>, MergeError> {
    let mut all: Vec<&Sums> = Vec::with_capacity(films.len());
    for (index, film) in films.iter().enumerate() {
        let sums = film.sums.as_ref().ok_or(MergeError::NoSamples(index))?;
        if !film.is_complete() {
            return Err(MergeError::Unfinished(index));
        }
        if all.first().is_some_and(|first| first.direct.is_empty() != sums.direct.is_empty()) {
            return Err(MergeError::OtherKind(index));
        }
        all.push(sums);
    }
    if all.is_empty() { Err(MergeError::Nothing) } else { Ok(all) }
}

/// Parts in as few pieces as is easy: one, if nothing is missing.
fn joined(mut parts: Vec<Part>, around: Part) -> Vec<Part> {
    let amount = |part: &Part| u128::from(part.region.pixels()) * u128::from(part.samples.count());
    if parts.iter().map(amount).sum::<u128>() == amount(&around) {
        return vec![around];
    }
    join(&mut parts);
    parts
}

/// Joins what lies side by side or follows each other, and sorts.
fn join(parts: &mut Vec<Part>) {
    while let Some((a, b, both)) =
        (0..parts.len()).find_map(|a| (a + 1..parts.len()).find_map(|b| Some((a, b, parts[a].joined_with(&parts[b])?))))
    {
        parts.swap_remove(b);
        parts[a] = both;
    }
    parts.sort_by_key(Part::order);
}

impl Part {
    /// What both have.
    fn both(&self, other: &Part) -> Option<Part> {
        let (a, b) = (self.samples, other.samples);
        let samples = SampleRange { start: a.start.max(b.start), end: a.end.min(b.end) };
        let region = self.region.intersection(other.region)?;
        (samples.start < samples.end).then_some(Part { region, samples })
    }

    /// The smallest that has all of these.
    fn around(parts: &[Part]) -> Option<Part> {
        let least = |number: fn(&Part) -> u32| parts.iter().map(number).min();
        let most = |number: fn(&Part) -> u32| parts.iter().map(number).max();
        let (x, y) = (least(|part| part.region.x)?, least(|part| part.region.y)?);
        let right = most(|part| part.region.x + part.region.width)?;
        let bottom = most(|part| part.region.y + part.region.height)?;
        let samples = SampleRange { start: least(|part| part.samples.start)?, end: most(|part| part.samples.end)? };
        Some(Part { region: Region { x, y, width: right - x, height: bottom - y }, samples })
    }

    /// The two as one, if that is one.
    fn joined_with(&self, other: &Part) -> Option<Part> {
        let around = Part::around(&[*self, *other])?;
        let amount = |part: &Part| u128::from(part.region.pixels()) * u128::from(part.samples.count());
        (amount(&around) == amount(self) + amount(other)).then_some(around)
    }

    /// What is left of it without another, in pieces: above, below, left and right of the other, before it and after it.
    fn without(&self, other: &Part) -> Vec<Part> {
        let Some(both) = self.both(other) else { return vec![*self] };
        let (whole, hole) = (self.region, both.region);
        let (right, bottom) = (whole.x + whole.width, whole.y + whole.height);
        let (hole_right, hole_bottom) = (hole.x + hole.width, hole.y + hole.height);
        let region = |x: u32, y: u32, right: u32, bottom: u32| Region { x, y, width: right - x, height: bottom - y };
        let beside = [
            region(whole.x, whole.y, right, hole.y),
            region(whole.x, hole_bottom, right, bottom),
            region(whole.x, hole.y, hole.x, hole_bottom),
            region(hole_right, hole.y, right, hole_bottom),
        ];
        let samples = |start: u32, end: u32| SampleRange { start, end };
        let within = [samples(self.samples.start, both.samples.start), samples(both.samples.end, self.samples.end)];
        let beside = beside.map(|region| Part { region, samples: self.samples });
        let within = within.map(|samples| Part { region: hole, samples });
        let pieces = beside.into_iter().chain(within);
        pieces.filter(|piece| piece.region.pixels() > 0 && piece.samples.count() > 0).collect()
    }
}

impl std::fmt::Display for Part {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Part { region: Region { x, y, width, height }, samples: SampleRange { start, end } } = self;
        write!(f, "samples {start}..{end} of the pixels {x},{y},{width},{height}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn part(x: u32, y: u32, width: u32, height: u32, samples: std::ops::Range<u32>) -> Part {
        let samples = SampleRange { start: samples.start, end: samples.end };
        Part { region: Region { x, y, width, height }, samples }
    }

    #[test]
    fn what_is_left_and_what_is_taken_away_are_the_whole() {
        let whole = part(2, 3, 10, 8, 4..20);
        let holes =
            [part(0, 0, 100, 100, 0..100), part(4, 5, 2, 2, 6..9), part(2, 3, 10, 8, 0..5), part(0, 0, 3, 4, 10..30)];
        for hole in holes {
            let pieces = whole.without(&hole);
            let amount = |part: &Part| part.region.pixels() * u64::from(part.samples.count());
            let taken = whole.both(&hole).map_or(0, |both| amount(&both));
            assert_eq!(pieces.iter().map(amount).sum::<u64>() + taken, amount(&whole));
            for (at, piece) in pieces.iter().enumerate() {
                assert!(piece.both(&hole).is_none() && piece.both(&whole) == Some(*piece));
                assert!(pieces[..at].iter().all(|other| other.both(piece).is_none()));
            }
        }
        assert_eq!(whole.without(&part(0, 0, 2, 100, 0..100)), [whole]);
    }

    #[test]
    fn pieces_are_joined() {
        let mut pieces =
            vec![part(0, 4, 8, 4, 8..16), part(0, 0, 4, 4, 8..16), part(4, 0, 4, 4, 8..16), part(0, 0, 8, 8, 0..8)];
        join(&mut pieces);
        assert_eq!(pieces, [part(0, 0, 8, 8, 0..16)]);
        let apart = vec![part(0, 0, 4, 4, 0..8), part(6, 0, 4, 4, 0..8)];
        assert_eq!(joined(apart.clone(), Part::around(&apart).unwrap()), apart);
    }
}

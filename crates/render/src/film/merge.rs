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
    /// The film with this index is not that of its outline, or was added before.
    Another(usize),
    /// They are of more pieces than are put together at once.
    TooMany,
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
            MergeError::Another(_) => write!(f, "it is not what it says, or changed while it was read"),
            MergeError::TooMany => {
                write!(f, "they have more than {MOST_AT_ONCE} pieces; merge some of them first, those side by side")
            }
            MergeError::TooScattered => write!(f, "they are too many pieces, or too far apart"),
        }
    }
}

impl std::error::Error for MergeError {}

/// What lies between films may take up so many times their own pixels.
const MOST_EMPTY: u64 = 16;
/// More pieces are not put together at once, since each is compared with many others.
const MOST_AT_ONCE: usize = 1 << 16;
/// Pieces of which something is missing are not searched any further.
const MOST_PIECES: usize = 4096;

/// What must be known of a film before others are put to it; no pixel of it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct FilmOutline {
    /// Part of the picture that it is.
    pub region: Region,
    /// What it is of; nothing if its integrator takes no samples.
    pub parts: Vec<Part>,
    /// True if light that met one surface at most is known apart.
    pub direct: bool,
    /// True if it is finished.
    pub is_complete: bool,
}

impl FilmOutline {
    /// False if no film can have it.
    pub fn is_possible(&self) -> bool {
        self.region.is_somewhere() && (self.parts.is_empty() || super::sums::parts_fit(&self.parts, self.region))
    }
}

/// A film that others are put to, one after the other, so that not all of them need to be held at once.
#[derive(Clone, Debug)]
pub struct Merging {
    outlines: Vec<FilmOutline>,
    region: Region,
    sums: Sums,
    account: Account,
}

impl Merging {
    /// A film for those with these outlines. All that may keep them apart is found here.
    ///
    /// # Errors
    ///
    /// One of them is no finished film of samples, or two have the same ones.
    pub fn new(outlines: Vec<FilmOutline>) -> Result<Merging, MergeError> {
        can_be_merged(&outlines)?;
        let all: Vec<Part> = outlines.iter().flat_map(|film| &film.parts).copied().collect();
        let of: Vec<usize> = outlines.iter().enumerate().flat_map(|(at, film)| vec![at; film.parts.len()]).collect();
        if all.len() > MOST_AT_ONCE {
            return Err(MergeError::TooMany);
        }
        if let Some((first, second, both)) = first_overlap(&all) {
            return Err(MergeError::Overlap { first: of[first], second: of[second], both });
        }
        let around = Part::around(&all).ok_or(MergeError::Nothing)?;
        let pixels = outlines.iter().map(|film| film.region.pixels()).fold(0, u64::saturating_add);
        if around.region.pixels() > pixels.saturating_mul(MOST_EMPTY) {
            return Err(MergeError::TooScattered);
        }
        let parts = joined(all, around);
        if parts.len() > super::sums::MOST_PARTS {
            return Err(MergeError::TooScattered);
        }
        let direct = outlines.first().is_some_and(|film| film.direct);
        let sums = Sums { parts, ..Sums::new(around, direct) };
        Ok(Merging { outlines, region: around.region, sums, account: Account::default() })
    }

    /// Puts a film to it: that with this index among the outlines.
    ///
    /// # Errors
    ///
    /// It is not the film of this outline.
    pub fn add(&mut self, index: usize, film: &Film) -> Result<(), MergeError> {
        let (Some(outline), Some(sums)) = (self.outlines.get_mut(index), &film.sums) else {
            return Err(MergeError::Another(index));
        };
        if *outline != film.outline() {
            return Err(MergeError::Another(index));
        }
        // So that it is not put there twice.
        outline.parts.clear();
        self.account.add(&film.account);
        for (pixel, (x, y)) in film.region.pixel_places().enumerate() {
            // Pixels of which there is nothing may lie outside of all parts.
            let here = Region { x, y, width: 1, height: 1 };
            if self.region.intersection(here).is_none() {
                continue;
            }
            self.sums.add(self.region.index_of(x, y), &sums.of(pixel));
        }
        Ok(())
    }

    /// The film of all that were added.
    pub fn finish(self) -> Film {
        let Merging { region, sums, account, outlines: _ } = self;
        let mut merged = Film::new(region);
        merged.pixels = (0..sums.taken.len()).map(|pixel| sums.mean(pixel)).collect();
        merged.samples = sums.samples();
        (merged.sums, merged.account) = (Some(sums), account);
        merged.finished.fill(true);
        merged.finished_pixels = region.pixels();
        merged
    }
}

impl Film {
    /// Puts films of the same scene together; their order does not matter. The film that has all of their samples is, to the
    /// last bit, that of one run which took them all.
    ///
    /// # Errors
    ///
    /// One of them is no finished film of samples, or two have the same ones.
    pub fn merge(films: &[Film]) -> Result<Film, MergeError> {
        let mut merging = Merging::new(films.iter().map(Film::outline).collect())?;
        for (index, film) in films.iter().enumerate() {
            merging.add(index, film)?;
        }
        Ok(merging.finish())
    }

    /// What others must know of it to be put to it.
    pub fn outline(&self) -> FilmOutline {
        let (parts, direct) =
            self.sums.as_ref().map_or((Vec::new(), false), |sums| (sums.parts.clone(), !sums.direct.is_empty()));
        FilmOutline { region: self.region, parts, direct, is_complete: self.is_complete() }
    }

    /// The film as it is, if nothing more is to be added: what is not finished stays black, or has fewer samples.
    #[must_use]
    pub fn as_it_is(mut self) -> Film {
        self.finish();
        self
    }

    /// What a film of samples lacks of being one of all its samples of all its pixels, in pieces; and true if there may be
    /// more of them, too many to be searched.
    pub fn gaps(&self) -> (Vec<Part>, bool) {
        let Some(sums) = &self.sums else { return (Vec::new(), false) };
        let Some(around) = Part::around(&sums.parts) else { return (Vec::new(), false) };
        let mut gaps = vec![Part { region: self.region, samples: around.samples }];
        let mut is_cut = false;
        for part in &sums.parts {
            gaps = gaps.iter().flat_map(|gap| gap.without(part)).collect();
            is_cut |= gaps.len() > MOST_PIECES;
            gaps.truncate(MOST_PIECES);
        }
        join(&mut gaps);
        (gaps, is_cut)
    }
}

fn can_be_merged(films: &[FilmOutline]) -> Result<(), MergeError> {
    for (index, film) in films.iter().enumerate() {
        if film.parts.is_empty() {
            return Err(MergeError::NoSamples(index));
        }
        if !film.is_possible() {
            return Err(MergeError::Another(index));
        }
        if !film.is_complete {
            return Err(MergeError::Unfinished(index));
        }
        if film.direct != films[0].direct {
            return Err(MergeError::OtherKind(index));
        }
    }
    if films.is_empty() { Err(MergeError::Nothing) } else { Ok(()) }
}

/// The first part that has samples of one before it, and the first such: the index of this, its own, and what both have.
fn first_overlap(parts: &[Part]) -> Option<(usize, usize, Part)> {
    // In the order of their first samples: those that begin after the last sample of one are not compared with it.
    let mut sorted: Vec<usize> = (0..parts.len()).collect();
    sorted.sort_by_key(|&index| parts[index].samples.start);
    let mut first: Option<(usize, usize)> = None;
    for (at, &one) in sorted.iter().enumerate() {
        let end = parts[one].samples.end;
        let near = sorted[at + 1..].iter().take_while(|&&other| parts[other].samples.start < end);
        for &other in near.filter(|&&other| parts[one].both(&parts[other]).is_some()) {
            let pair = (one.max(other), one.min(other));
            first = Some(first.map_or(pair, |first| first.min(pair)));
        }
    }
    first.and_then(|(second, first)| Some((first, second, parts[first].both(&parts[second])?)))
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

/// Joins what lies side by side or follows each other, along one axis after the other until nothing more can be joined, and
/// sorts. The order of the pieces does not matter.
fn join(parts: &mut Vec<Part>) {
    loop {
        let before = parts.len();
        join_along(parts, |part| (part.samples, part.region.y, part.region.height, part.region.x));
        join_along(parts, |part| (part.samples, part.region.x, part.region.width, part.region.y));
        join_along(parts, |part| (part.region.x, part.region.y, part.region.width, part.region.height, part.samples));
        if parts.len() == before {
            break;
        }
    }
    parts.sort_by_key(Part::order);
}

/// Joins pieces that are next to each other when they are sorted so.
fn join_along<K: Ord>(parts: &mut Vec<Part>, key: impl Fn(&Part) -> K) {
    parts.sort_by_key(key);
    let mut joined: Vec<Part> = Vec::with_capacity(parts.len());
    for part in parts.drain(..) {
        match joined.last_mut().and_then(|last| Some((last.joined_with(&part)?, last))) {
            Some((both, last)) => *last = both,
            None => joined.push(part),
        }
    }
    *parts = joined;
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

    /// As many pieces as there may be are joined at once, and in any order to the same ones: it took n³ steps.
    #[test]
    fn thousands_of_pieces_are_joined_quickly() {
        let cells = |gap: u32| {
            let at = (0..64).flat_map(move |y| (0..32).map(move |x| (x, y)));
            let cells = at.flat_map(|(x, y)| [part(x, y, 1, 1, 0..8), part(x, y, 1, 1, 8..9)]);
            cells.filter(|cell| cell.region.x != gap).collect::<Vec<Part>>()
        };
        let mut pieces = cells(99);
        join(&mut pieces);
        assert_eq!(pieces, [part(0, 0, 32, 64, 0..9)]);
        let (mut pieces, mut reversed) = (cells(5), cells(5));
        reversed.reverse();
        join(&mut pieces);
        join(&mut reversed);
        assert_eq!(pieces, [part(0, 0, 5, 64, 0..9), part(6, 0, 26, 64, 0..9)]);
        assert_eq!(reversed, pieces);
    }

    /// What counts is how many pieces are left.
    #[test]
    fn more_films_are_merged_than_a_film_has_parts() {
        let outline =
            |part: Part| FilmOutline { region: part.region, parts: vec![part], direct: false, is_complete: true };
        let films = |step: u32| {
            (0..5000).map(|n| outline(part(n % 50 * step, n / 50, 1, 1, 3..5))).collect::<Vec<FilmOutline>>()
        };
        assert_eq!(Merging::new(films(1)).unwrap().sums.parts, [part(0, 0, 50, 100, 3..5)]);
        // Columns with one between them.
        assert_eq!(Merging::new(films(2)).unwrap().sums.parts.len(), 50);
        let many = (0..70_000).map(|n| outline(part(0, 0, 1, 1, n..n + 1))).collect();
        assert_eq!(Merging::new(many).unwrap_err(), MergeError::TooMany);
        let scattered = (0..5000).map(|n| outline(part(n % 50 * 2, n / 50 * 2, 1, 1, 3..5))).collect();
        assert_eq!(Merging::new(scattered).unwrap_err(), MergeError::TooScattered);
    }

    /// In whatever order they are looked through, as if each were compared with all before it.
    #[test]
    fn the_first_overlap_is_found() {
        let parts = [
            part(0, 0, 4, 4, 8..16),
            part(4, 0, 4, 4, 0..16),
            part(0, 0, 4, 4, 0..8),
            part(3, 3, 2, 2, 0..1),
            part(0, 0, 9, 9, 2..3),
        ];
        assert_eq!(first_overlap(&parts), Some((1, 3, part(4, 3, 1, 1, 0..1))));
        assert_eq!(first_overlap(&parts[..3]), None);
        assert_eq!(first_overlap(&[parts[4], parts[0], parts[1]]), Some((0, 2, part(4, 0, 4, 4, 2..3))));
    }

    #[test]
    fn a_film_that_is_not_that_of_its_outline_is_refused() {
        let samples = SampleRange { start: 0, end: 2 };
        let film = |x| {
            let mut film = Film::of_samples(Region { x, y: 0, width: 4, height: 4 }, samples, false);
            film.finish_samples();
            film
        };
        let mut merging = Merging::new(vec![film(0).outline(), film(4).outline()]).unwrap();
        assert_eq!(merging.add(0, &film(4)), Err(MergeError::Another(0)));
        assert_eq!(merging.add(1, &film(4)), Ok(()));
        assert_eq!(merging.add(1, &film(4)), Err(MergeError::Another(1)), "twice");
        assert_eq!(merging.add(2, &film(4)), Err(MergeError::Another(2)));
    }
}

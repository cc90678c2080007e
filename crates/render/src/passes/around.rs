//! The cells around a part of a picture, and those that its edges cut: what they are to say of noise, all of their samples must
//! say. They are taken beside the film, and are forgotten with the run; another run takes the same again.

use super::noise::{Noise, cells_around, pixels_of_cell};
use super::{Pass, Sampling, after};
use crate::film::{Calm, Film, Part, Region, SampleRange, Sums};
use crate::integrators::Integrator;
use crate::schedule::{Progress, each_in_parallel};

/// What must be known beside a film, for a goal for noise. Nothing is beside a whole picture.
pub(super) struct Around {
    cells: Vec<Beside>,
}

/// A cell that the film has not all pixels of.
struct Beside {
    /// Its column and row among the cells of the picture.
    place: (u32, u32),
    /// What of it is in the film.
    part: Option<Region>,
    region: Region,
    sums: Sums,
    calm: Calm,
}

impl Around {
    /// Nothing.
    pub(super) fn nothing() -> Around {
        Around { cells: Vec::new() }
    }

    /// Without samples as yet.
    pub(super) fn new(film: &Film, picture: (u32, u32)) -> Around {
        let cells = cells_around(film.region(), picture).pixel_places().filter_map(|place| {
            let region = pixels_of_cell(place, picture);
            let part = region.intersection(film.region());
            (part != Some(region)).then(|| {
                let samples = SampleRange { start: 0, end: u32::MAX };
                let sums = Sums::new(Part { region, samples }, false);
                Beside { place, part, region, sums, calm: Calm::default() }
            })
        });
        Around { cells: cells.collect() }
    }

    /// What is known of the cell in this column and row, if it is one of them.
    pub(super) fn calm(&self, place: (u32, u32)) -> Option<Calm> {
        // Row by row, as they were made.
        let key = |(column, row): (u32, u32)| (row, column);
        let at = self.cells.binary_search_by_key(&key(place), |cell| key(cell.place)).ok()?;
        Some(self.cells[at].calm)
    }

    /// Lets them follow the film: those that it has a part of have as many samples as that, the others as many as any cell
    /// of the film, unless they were calm before.
    pub(super) fn follow<I: Integrator>(
        &mut self,
        film: &Film,
        (noise, most): (Noise, u32),
        sampling: &Sampling<'_, I>,
        progress: &dyn Progress,
    ) {
        let Some(sums) = film.sums() else { return };
        let furthest = sums.least_and_most().1;
        each_in_parallel(&mut self.cells, |cell| {
            let wanted = match cell.part {
                Some(part) => part.pixel_places().map(|(x, y)| sums.taken[film.region().index_of(x, y)]).min(),
                None => Some(furthest),
            };
            let wanted = wanted.unwrap_or(0).min(most);
            while cell.taken() < wanted && (cell.part.is_some() || cell.calm.first == 0) && !progress.stop() {
                cell.take_more(sampling, noise, wanted);
            }
        });
    }
}

impl Beside {
    /// Samples of each of its pixels.
    fn taken(&self) -> u32 {
        self.sums.taken.first().copied().unwrap_or(u32::MAX)
    }

    /// One pass more.
    fn take_more<I: Integrator>(&mut self, sampling: &Sampling<'_, I>, noise: Noise, wanted: u32) {
        let length = self.sums.taken.len();
        let goal = after(self.taken()).min(wanted);
        let pass = Pass { region: self.region, from: self.sums.taken.clone(), to: vec![goal; length], expected: 0 };
        for (pixel, more) in sampling.tile(self.region, &pass).pixels.iter().enumerate() {
            self.sums.add(pixel, more);
        }
        self.calm = noise.judged(self.calm, &self.sums, goal, 0..length);
    }
}

//! What reading a file keeps account of: how much it may unfold to, and what was done only nearly.

use super::super::ModelError;
use super::value::Place;
use std::cell::{Cell, RefCell};

/// What a byte of a file may unfold to, in bytes of memory or steps of work. Honest files stay far below: a vertex
/// takes as much in memory as in the file, a node in its shortest form about thirty times as much.
const UNFOLDED: u64 = 64;
/// What even the smallest file may unfold to.
const ALWAYS: u64 = 64 << 20;

/// How much a file may unfold to. A few bytes of JSON can name the same data again and again, or data that are all
/// zeros and so not in the file.
pub(super) struct Budget {
    left: Cell<u64>,
    triangles: Cell<u64>,
}

impl Budget {
    /// That of a file of so many bytes.
    pub(super) fn of(bytes: usize, most_triangles: u64) -> Budget {
        let budget = Budget { left: Cell::new(ALWAYS), triangles: Cell::new(most_triangles) };
        budget.grow(bytes);
        budget
    }

    /// So many more bytes have been read.
    pub(super) fn grow(&self, bytes: usize) {
        self.left.set(self.left.get().saturating_add((bytes as u64).saturating_mul(UNFOLDED)));
    }

    /// To be asked before `count` things are made of `bytes` bytes each, or as much work is done.
    pub(super) fn spend(&self, count: usize, bytes: usize, place: Place) -> Result<(), ModelError> {
        let asked = (count as u64).saturating_mul(bytes as u64);
        match self.left.get().checked_sub(asked) {
            Some(left) => self.left.set(left),
            None => return Err(place.fault("with this, the file unfolds to much more than its size allows")),
        }
        Ok(())
    }

    /// To be told of triangles once they are there.
    pub(super) fn triangles(&self, count: usize, place: Place) -> Result<(), ModelError> {
        match self.triangles.get().checked_sub(count as u64) {
            Some(left) => self.triangles.set(left),
            None => {
                let fault = place.fault("with this, the file has more triangles than are allowed");
                return Err(fault.help("if you trust this scene, raise the limit: `--limits primitives=…`"));
            }
        }
        Ok(())
    }
}

/// What was left out or done only nearly.
#[derive(Default)]
pub(super) struct Notes {
    list: RefCell<Vec<Note>>,
}

struct Note {
    sentence: String,
    /// Where it happened first.
    place: Place,
    /// How often it happened.
    count: usize,
}

impl Notes {
    /// Notes what happened at a place, once for each sentence.
    pub(super) fn add(&self, sentence: &str, place: Place) {
        let mut list = self.list.borrow_mut();
        match list.iter_mut().find(|note| note.sentence == sentence) {
            Some(note) => note.count += 1,
            None => list.push(Note { sentence: sentence.to_owned(), place, count: 1 }),
        }
    }

    /// A sentence for each.
    pub(super) fn into_sentences(self) -> Vec<String> {
        let sentence = |note: Note| match (note.place.to_string().as_str(), note.count - 1) {
            ("", _) => note.sentence,
            (place, 0) => format!("{} ({place})", note.sentence),
            (place, more) => format!("{} ({place} and {more} more)", note.sentence),
        };
        self.list.into_inner().into_iter().map(sentence).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_may_unfold_to_a_multiple_of_its_size() {
        let budget = Budget::of(1, 10);
        let place = Place::default().field("meshes").index(3);
        assert_eq!(budget.spend((64 << 20) + 64, 1, place), Ok(()));
        let fault = budget.spend(1, 1, place).unwrap_err();
        assert!(fault.message.starts_with("meshes[3]: with this, the file unfolds"), "{}", fault.message);
        budget.grow(1);
        assert!(budget.spend(64, 1, place).is_ok() && budget.spend(usize::MAX, usize::MAX, place).is_err());
        assert!(budget.triangles(10, place).is_ok() && budget.triangles(1, place).is_err());
    }

    #[test]
    fn notes_are_counted() {
        let (notes, place) = (Notes::default(), Place::default());
        notes.add("one", place);
        notes.add("two", place.field("a").index(7));
        notes.add("three", place.field("b"));
        notes.add("two", place.field("a").index(9));
        assert_eq!(notes.into_sentences(), ["one", "two (a[7] and 1 more)", "three (b)"]);
    }
}

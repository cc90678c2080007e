//! Corners of faces to vertices: corners that name the same entries are one vertex.

/// Stands for an entry that a corner does not have.
pub(super) const ABSENT: u32 = u32::MAX;

/// How many vertices in one place are looked through. Where a file has more, as at the pole of a sphere whose every side
/// has texture coordinates of its own, some may come twice, which is harmless; a file in which all lie in one place
/// would take forever.
const LONGEST_SEARCH: usize = 32;

/// What a corner names: indices from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Corner {
    pub(super) place: u32,
    pub(super) uv: u32,
    pub(super) normal: u32,
}

/// Vertices in the order in which faces first use them.
///
/// Those in one place are a chain, the last one first. A hash table would look for them all over memory; chains lie
/// beside what the faces before have used.
#[derive(Debug, Default)]
pub(super) struct Corners {
    all: Vec<Corner>,
    /// For each vertex the one before in the same place.
    before: Vec<u32>,
    /// For each place its last vertex.
    last: Vec<u32>,
}

impl Corners {
    /// All vertices.
    pub(super) fn all(&self) -> &[Corner] {
        &self.all
    }

    /// One of them.
    #[inline]
    pub(super) fn get(&self, vertex: u32) -> Corner {
        self.all[vertex as usize]
    }

    /// The vertex of a corner, which may be new; `None` if there are too many for 32 bits.
    #[inline]
    pub(super) fn vertex(&mut self, corner: Corner) -> Option<u32> {
        let place = corner.place as usize;
        if place >= self.last.len() {
            self.last.resize(place + 1, ABSENT);
        }
        let mut vertex = self.last[place];
        for _ in 0..LONGEST_SEARCH {
            if vertex == ABSENT {
                break;
            }
            if self.all[vertex as usize] == corner {
                return Some(vertex);
            }
            vertex = self.before[vertex as usize];
        }
        let new = u32::try_from(self.all.len()).ok().filter(|new| *new != ABSENT)?;
        self.all.push(corner);
        self.before.push(self.last[place]);
        self.last[place] = new;
        Some(new)
    }
}

//! Vertices on their way into a [`MeshData`](durer_scene::MeshData): their places in the precision that they need, and which of them are one.

use durer_math::DVec3;

/// The largest coordinate, as for everything in a scene.
const LARGEST: f64 = 1e12;

/// Places of vertices, gathered one by one: in single precision as long as that holds all of them exactly, as most
/// files do, in double precision from the first on for which it does not.
#[derive(Clone, Debug, Default)]
pub(crate) struct Positions {
    narrow: Vec<[f32; 3]>,
    wide: Option<Vec<[f64; 3]>>,
}

/// Places as a mesh has them: offsets from an origin.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Placed {
    /// What the offsets are relative to.
    pub(crate) origin: DVec3,
    /// One for each vertex.
    pub(crate) positions: Vec<[f32; 3]>,
}

impl Positions {
    /// None yet, and room for this many.
    pub(crate) fn with_capacity(count: usize) -> Positions {
        Positions { narrow: Vec::with_capacity(count), wide: None }
    }

    /// Adds one.
    ///
    /// # Errors
    ///
    /// What is wrong with its coordinates.
    #[inline]
    pub(crate) fn push(&mut self, position: [f64; 3]) -> Result<(), String> {
        check_place(position)?;
        if let Some(wide) = &mut self.wide {
            wide.push(position);
            return Ok(());
        }
        let narrow = position.map(|x| x as f32);
        if narrow.map(f64::from) == position {
            self.narrow.push(narrow);
        } else {
            self.widen().push(position);
        }
        Ok(())
    }

    #[cold]
    fn widen(&mut self) -> &mut Vec<[f64; 3]> {
        let narrow = std::mem::take(&mut self.narrow);
        let mut wide = Vec::with_capacity(narrow.capacity());
        wide.extend(narrow.iter().map(|position| position.map(f64::from)));
        self.wide.insert(wide)
    }

    /// One of them.
    #[inline]
    pub(crate) fn get(&self, index: usize) -> DVec3 {
        match &self.wide {
            Some(wide) => DVec3::from_array(wide[index]),
            None => DVec3::from_array(self.narrow[index].map(f64::from)),
        }
    }

    /// All of them, relative to the point that loses least.
    ///
    /// That is the zero of the file, and nothing is lost, if all coordinates fit single precision as they are. Otherwise
    /// the middle of all is tried: offsets from there are smaller, so their rounding is finer, and a mesh far away
    /// stays sharp. The middle is rounded to single precision itself, so that adding it back is exact in double. Where it
    /// would gain less than two bits, zero is better: pieces of a thing that come in several files then round their
    /// common borders alike.
    pub(crate) fn place(self) -> Placed {
        let Some(wide) = self.wide else {
            return Placed { origin: DVec3::ZERO, positions: self.narrow };
        };
        let middle = middle(&wide);
        let origin = if loss(&wide, middle) < 0.25 * loss(&wide, DVec3::ZERO) { middle } else { DVec3::ZERO };
        let offset = |position: &[f64; 3]| (DVec3::from_array(*position) - origin).to_array().map(|x| x as f32);
        Placed { origin, positions: wide.iter().map(offset).collect() }
    }
}

/// Refuses coordinates that are no place in a scene.
///
/// # Errors
///
/// The place, and what is wrong with it.
#[inline]
pub(crate) fn check_place(position: [f64; 3]) -> Result<(), String> {
    // NaN is not less than anything.
    if position.iter().all(|x| x.abs() <= LARGEST) { Ok(()) } else { Err(complaint(position)) }
}

#[cold]
fn complaint([x, y, z]: [f64; 3]) -> String {
    if [x, y, z].iter().all(|x| x.is_finite()) {
        format!("({x:e}, {y:e}, {z:e}) is too far away: coordinates must be at most {LARGEST:e} in size")
    } else {
        format!("({x}, {y}, {z}) is no place: coordinates must be finite")
    }
}

/// The middle of the box around all places, in numbers that single precision holds.
fn middle(positions: &[[f64; 3]]) -> DVec3 {
    let all = || positions.iter().copied().map(DVec3::from_array);
    let low = all().fold(DVec3::INFINITY, DVec3::min);
    let high = all().fold(DVec3::NEG_INFINITY, DVec3::max);
    DVec3::from_array(((low + high) * 0.5).to_array().map(|x| f64::from(x as f32)))
}

/// By how much places may be off if they are kept relative to `origin`: the sum over all coordinates, since the greatest
/// loss says little where a few vertices are far from the rest.
fn loss(positions: &[[f64; 3]], origin: DVec3) -> f64 {
    let of_one = |x: f64, origin: f64| (x - (origin + f64::from((x - origin) as f32))).abs();
    positions.iter().map(|[x, y, z]| of_one(*x, origin.x) + of_one(*y, origin.y) + of_one(*z, origin.z)).sum()
}

/// Numbers distinct keys, which are the bits of places, in the order in which they first appear.
///
/// A hash table of our own, since the standard one guards against collisions made on purpose by a slow hash. This one
/// gives up a search that takes too long and calls the key new: such a file gets a vertex twice, which is harmless.
#[derive(Clone, Debug)]
pub(crate) struct Distinct<K> {
    keys: Vec<K>,
    /// Indices into `keys`, open addressing; at most half are taken.
    slots: Vec<u32>,
    /// Some of the last ones that were asked for, by the lowest bits of their hash. Triangles come beside those that share
    /// their corners, so most are found here, in the nearest memory.
    recent: Vec<u32>,
}

/// Three numbers that can be told apart.
pub(crate) trait Key: Copy + Eq {
    /// Bits as good as random, the same for equal keys.
    fn hash(self) -> u64;
}

const FREE: u32 = u32::MAX;
/// How many slots are searched: far more than come in a row by chance.
const LONGEST_SEARCH: usize = 256;
/// A power of two.
const RECENT: usize = 4096;
/// So many slots are enough for all numbers of 32 bits, if addresses have more.
const MOST_SLOTS: usize = 1 << if usize::BITS > 32 { 32 } else { 31 };

impl<K: Key> Distinct<K> {
    /// None yet, and room for this many.
    pub(crate) fn with_capacity(count: usize) -> Distinct<K> {
        let slots = (count.min(MOST_SLOTS / 2) * 2).next_power_of_two().max(64);
        Distinct { keys: Vec::with_capacity(count), slots: vec![FREE; slots], recent: vec![FREE; RECENT] }
    }

    /// All of them.
    pub(crate) fn keys(&self) -> &[K] {
        &self.keys
    }

    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        self.keys.len()
    }

    /// The number of this one, which may be new; `None` if there are too many for 32 bits.
    #[inline]
    pub(crate) fn number(&mut self, key: K) -> Option<u32> {
        let hash = key.hash();
        let near = hash as usize % RECENT;
        let recent = self.recent[near];
        if self.keys.get(recent as usize) == Some(&key) {
            return Some(recent);
        }
        let number = self.number_of_any(key, hash)?;
        self.recent[near] = number;
        Some(number)
    }

    fn number_of_any(&mut self, key: K, hash: u64) -> Option<u32> {
        if self.keys.len() * 2 >= self.slots.len() {
            self.grow();
        }
        let new = u32::try_from(self.keys.len()).ok().filter(|new| *new != FREE)?;
        if let Some(slot) = self.search(key, hash) {
            match self.slots[slot] {
                FREE => self.slots[slot] = new,
                known => return Some(known),
            }
        }
        self.keys.push(key);
        Some(new)
    }

    /// The slot that holds this key or is free for it.
    #[inline]
    fn search(&self, key: K, hash: u64) -> Option<usize> {
        let mask = self.slots.len() - 1;
        // Other bits than those that chose among the recent ones.
        let start = (hash >> 12) as usize;
        let mut slots = (0..LONGEST_SEARCH).map(|step| start.wrapping_add(step) & mask);
        slots.find(|slot| match self.slots[*slot] {
            FREE => true,
            known => self.keys[known as usize] == key,
        })
    }

    #[cold]
    fn grow(&mut self) {
        self.slots = vec![FREE; self.slots.len() * 2];
        for index in 0..self.keys.len() {
            let key = self.keys[index];
            if let Some(slot) = self.search(key, key.hash()) {
                self.slots[slot] = index as u32;
            }
        }
    }
}

impl Key for [u32; 3] {
    #[inline]
    fn hash(self) -> u64 {
        let [a, b, c] = self.map(u64::from);
        mixed(mixed(a | b << 32) ^ c)
    }
}

impl Key for [u64; 3] {
    #[inline]
    fn hash(self) -> u64 {
        let [a, b, c] = self;
        mixed(mixed(mixed(a) ^ b) ^ c)
    }
}

/// All bits depend on all: the product carries them upwards, the shifts bring them back down.
#[inline]
fn mixed(bits: u64) -> u64 {
    let bits = (bits ^ bits >> 32).wrapping_mul(0xd6e8_feb8_6659_fd93);
    (bits ^ bits >> 32).wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ bits >> 29
}

/// The bits of a place, the same for -0 as for 0.
#[inline]
pub(crate) fn bits_of(position: [f32; 3]) -> [u32; 3] {
    // -0 + 0 is 0.
    position.map(|x| (x + 0.0).to_bits())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn placed(all: &[[f64; 3]]) -> Placed {
        let mut positions = Positions::default();
        all.iter().for_each(|position| positions.push(*position).unwrap());
        all.iter().enumerate().for_each(|(at, place)| assert_eq!(positions.get(at).to_array(), *place));
        positions.place()
    }

    #[test]
    fn what_fits_single_precision_stays_as_it_is() {
        let far = placed(&[[1e6, 0.5, -0.0], [1e6 + 0.0625, 3.0, 4.0]]);
        assert_eq!(far, Placed { origin: DVec3::ZERO, positions: vec![[1e6, 0.5, 0.0], [1e6 + 0.0625, 3.0, 4.0]] });
    }

    #[test]
    fn far_away_meshes_stay_sharp() {
        let all = [[4_567_890.123_4, 12.0, -1.1], [4_567_891.234_5, 13.0, 7.7], [4_567_890.5, 12.25, 1.0 / 3.0]];
        let Placed { origin, positions } = placed(&all);
        assert!(origin.to_array().iter().all(|x| f64::from(*x as f32) == *x));
        for (exact, found) in all.iter().zip(&positions) {
            let found = origin + DVec3::from_array(found.map(f64::from));
            assert!((found - DVec3::from_array(*exact)).length() < 1e-6, "{found}");
        }
    }

    #[test]
    fn what_lies_around_zero_keeps_zero() {
        assert_eq!(placed(&[[0.1, 0.1, 0.1], [-0.1, -0.1, -0.1]]).origin, DVec3::ZERO);
        assert_eq!(placed(&[[0.1, 0.7, 0.1], [-0.5, -0.1, 0.4], [0.2, 0.3, 0.3]]).origin, DVec3::ZERO);
    }

    #[test]
    fn what_is_no_place_is_refused() {
        let mut positions = Positions::default();
        for wrong in [[f64::NAN, 0.0, 0.0], [0.0, f64::INFINITY, 0.0]] {
            assert!(positions.push(wrong).unwrap_err().contains("must be finite"));
        }
        assert!(positions.push([0.0, 0.0, 1e13]).unwrap_err().contains("too far"));
        assert!(positions.place().positions.is_empty());
    }

    #[test]
    fn distinct_triples_are_numbered_in_order() {
        let mut distinct = Distinct::<[u32; 3]>::with_capacity(0);
        for round in 0..2 {
            for i in 0..50_000_u32 {
                assert_eq!(distinct.number([i, i / 7, !i]), Some(i), "{round}");
            }
        }
        assert_eq!((distinct.len(), distinct.keys()[7]), (50_000, [7, 1, !7]));
    }

    #[test]
    fn minus_zero_is_zero() {
        assert_eq!(bits_of([-0.0, 1.0, 0.0]), bits_of([0.0, 1.0, -0.0]));
    }
}

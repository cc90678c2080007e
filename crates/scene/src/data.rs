//! Lists of numbers, long or short: written in the scene file, or taken from a file beside it.

use durer_math::DVec3;
use std::sync::Arc;

/// Values, and where they came from. Copies share them.
#[derive(Clone, Debug, PartialEq)]
pub struct Data<T> {
    /// The file that holds them; `None` if the scene file lists them itself.
    pub file: Option<DataFile>,
    /// The values.
    pub values: Arc<[T]>,
}

/// Columns of a table in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DataFile {
    /// The file, as the scene file says it.
    pub file: String,
    /// The names, or numbers from 1, of the columns that are used; empty for those that are usual for the field.
    pub columns: Vec<String>,
}

/// One size for all, or one for each.
#[derive(Clone, Debug, PartialEq)]
pub enum Sizes {
    /// The same for all.
    Same(f64),
    /// One for each.
    Each(Data<f64>),
}

impl<T> Data<T> {
    /// Values listed in the scene file itself.
    pub fn inline(values: impl Into<Arc<[T]>>) -> Data<T> {
        Data { file: None, values: values.into() }
    }
}

impl Sizes {
    /// That of the thing with this index.
    #[inline]
    pub fn get(&self, index: usize) -> f64 {
        match self {
            Sizes::Same(size) => *size,
            Sizes::Each(data) => data.values[index],
        }
    }
}

/// Copies of the same objects, each in a place of its own.
#[derive(Clone, Debug, PartialEq)]
pub struct Instances {
    /// What is copied.
    pub objects: Vec<crate::Object>,
    /// Where the origin of the copied objects comes to lie: one for each copy.
    pub positions: Data<DVec3>,
    /// How each copy is turned first: degrees about x, then about y, then about z.
    pub rotations: Option<Data<DVec3>>,
    /// How each copy is scaled, before all else.
    pub scales: Sizes,
    /// Materials of the copies, in turn; empty for that of the objects. They override the objects' own.
    pub materials: Vec<crate::MaterialId>,
}

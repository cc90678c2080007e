//! Accessors: lists of numbers or vectors in buffers, with gaps between them, in several encodings, patched here and there.
//!
//! Everything that a file says of its data is checked when an accessor is opened; reading an element cannot fail.

use super::super::ModelError;
use super::source::{Source, View};
use super::value::{Place, Value};

/// The most elements of an accessor that has no data and so is all zeros.
const MOST_ZEROS: usize = 100_000_000;

/// How a number is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Component {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

use Component::{F32, I8, I16, U8, U16, U32};

/// The encodings of positions, normals and texture coordinates, those of KHR_mesh_quantization among them.
pub(super) const MEASURES: &[Component] = &[F32, I8, U8, I16, U16];
/// The encodings of colors and weights.
pub(super) const FRACTIONS: &[Component] = &[F32, U8, U16];
/// The encodings of indices.
pub(super) const INDICES: &[Component] = &[U8, U16, U32];

impl Component {
    /// The encoding of a field's number.
    fn of(from: &Value<'_>) -> Result<Component, ModelError> {
        Ok(match from.required_whole("componentType")? {
            5120 => I8,
            5121 => U8,
            5122 => I16,
            5123 => U16,
            5125 => U32,
            5126 => F32,
            other => return Err(from.fault(format!("there is no component type {other}"))),
        })
    }

    fn size(self) -> usize {
        match self {
            I8 | U8 => 1,
            I16 | U16 => 2,
            U32 | F32 => 4,
        }
    }

    /// The number at the start of `bytes`, as a whole number or as what it is.
    fn number(self, bytes: &[u8]) -> f64 {
        let read = match self {
            I8 => bytes.first_chunk().map(|b| i8::from_le_bytes(*b).into()),
            U8 => bytes.first_chunk().map(|b| u8::from_le_bytes(*b).into()),
            I16 => bytes.first_chunk().map(|b| i16::from_le_bytes(*b).into()),
            U16 => bytes.first_chunk().map(|b| u16::from_le_bytes(*b).into()),
            U32 => bytes.first_chunk().map(|b| u32::from_le_bytes(*b).into()),
            F32 => bytes.first_chunk().map(|b| f32::from_le_bytes(*b).into()),
        };
        read.unwrap_or(0.0)
    }

    /// What a stored number means if it stands for a fraction.
    fn fraction(self, stored: f64) -> f64 {
        match self {
            I8 => (stored / 127.0).max(-1.0),
            U8 => stored / 255.0,
            I16 => (stored / 32767.0).max(-1.0),
            U16 => stored / 65535.0,
            U32 | F32 => stored,
        }
    }
}

/// An accessor whose data are there.
pub(super) struct Accessor<'s> {
    pub(super) place: Place,
    /// Number of elements.
    pub(super) count: usize,
    component: Component,
    /// Numbers of an element.
    pub(super) width: usize,
    normalized: bool,
    /// `None` for zeros.
    dense: Option<Elements<'s>>,
    sparse: Option<Sparse<'s>>,
}

/// Elements of one size, at equal distances.
#[derive(Clone, Copy)]
struct Elements<'s> {
    bytes: &'s [u8],
    stride: usize,
    size: usize,
}

/// Elements that take the place of others.
struct Sparse<'s> {
    /// Which, ascending.
    indices: Elements<'s>,
    index: Component,
    values: Elements<'s>,
}

impl<'s> Elements<'s> {
    /// `count` elements of `size` bytes from `offset` on, if they are within the view.
    fn within(
        view: View<'s>,
        offset: usize,
        (count, size): (usize, usize),
        place: Place,
    ) -> Result<Elements<'s>, ModelError> {
        let stride = view.stride.unwrap_or(size);
        if stride < size {
            let message = format!("a byteStride of {stride} is too small for elements of {size} bytes");
            return Err(view.place.fault(message));
        }
        let last = if count > 0 { size } else { 0 };
        let before_last = count.saturating_sub(1).checked_mul(stride);
        let end = before_last.and_then(|before| before.checked_add(last)?.checked_add(offset));
        match end.and_then(|end| view.bytes.get(offset..end)) {
            Some(bytes) => Ok(Elements { bytes, stride, size }),
            None => {
                let message = format!("its {count} elements reach beyond {}", view.place);
                Err(place.fault(format!("{message}, which has {} bytes", view.bytes.len())))
            }
        }
    }

    fn get(&self, index: usize) -> &'s [u8] {
        let start = index * self.stride;
        &self.bytes[start..start + self.size]
    }
}

impl<'s> Accessor<'s> {
    /// The accessor that a field refers to, if its elements have one of these widths and one of these encodings.
    pub(super) fn open<'a>(
        source: &'s Source<'a>,
        from: &Value<'a>,
        field: &'static str,
        widths: &[usize],
        components: &[Component],
    ) -> Result<Option<(usize, Accessor<'s>)>, ModelError> {
        let Some((index, value)) = source.referred(from, field, "accessors")? else { return Ok(None) };
        let accessor = Accessor::of(source, &value)?;
        if !widths.contains(&accessor.width) || !components.contains(&accessor.component) {
            let message = format!("its type or componentType is not one that {field} may have");
            return Err(value.fault(message));
        }
        Ok(Some((index, accessor)))
    }

    fn of<'a>(source: &'s Source<'a>, value: &Value<'a>) -> Result<Accessor<'s>, ModelError> {
        let (component, width, count) = (Component::of(value)?, width(value)?, value.required_whole("count")?);
        let size = component.size() * width;
        let dense = match source.view(value)? {
            Some(view) => {
                let offset = value.whole("byteOffset")?.unwrap_or(0);
                Some(Elements::within(view, offset, (count, size), value.place)?)
            }
            None if count > MOST_ZEROS => {
                return Err(value.fault(format!("{count} elements without data are too many")));
            }
            None => None,
        };
        let sparse = match value.object("sparse")? {
            Some(sparse) => Some(Sparse::of(source, &sparse, count, size)?),
            None => None,
        };
        let normalized = value.flag("normalized")?;
        Ok(Accessor { place: value.place, count, component, width, normalized, dense, sparse })
    }

    /// Takes whole numbers for fractions of the largest, whether the file says so or not.
    pub(super) fn into_fractions(self) -> Accessor<'s> {
        Accessor { normalized: true, ..self }
    }

    /// An element as it is meant; what is beyond its width is 0.
    pub(super) fn get<const N: usize>(&self, index: usize) -> [f64; N] {
        let bytes = self.stored(index);
        let mut element = [0.0; N];
        for (number, stored) in element.iter_mut().zip(bytes.chunks_exact(self.component.size())) {
            let stored = self.component.number(stored);
            *number = if self.normalized { self.component.fraction(stored) } else { stored };
        }
        element
    }

    /// An element in single precision, as it is stored if it is stored so.
    pub(super) fn get_single<const N: usize>(&self, index: usize) -> [f32; N] {
        self.get(index).map(|number| number as f32)
    }

    /// An element of whole numbers, as stored.
    pub(super) fn get_whole<const N: usize>(&self, index: usize) -> [u32; N] {
        let mut element = [0; N];
        for (number, stored) in element.iter_mut().zip(self.stored(index).chunks_exact(self.component.size())) {
            *number = self.component.number(stored) as u32;
        }
        element
    }

    /// The bytes of an element; none for zeros.
    fn stored(&self, index: usize) -> &'s [u8] {
        if let Some(sparse) = &self.sparse
            && let Some(bytes) = sparse.find(index)
        {
            return bytes;
        }
        self.dense.map_or(&[], |dense| dense.get(index))
    }
}

/// Numbers of an element.
fn width(accessor: &Value<'_>) -> Result<usize, ModelError> {
    Ok(match accessor.text("type")? {
        Some("SCALAR") => 1,
        Some("VEC2") => 2,
        Some("VEC3") => 3,
        Some("VEC4") => 4,
        // The smaller matrices have padding between their columns; nothing that we read has them.
        Some("MAT4") => 16,
        Some(_) => return Err(accessor.fault("its type is none that can be read")),
        None => return Err(accessor.fault("`type` is missing")),
    })
}

impl<'s> Sparse<'s> {
    /// The patches of an accessor with `count` elements of `size` bytes.
    fn of<'a>(source: &'s Source<'a>, sparse: &Value<'a>, count: usize, size: usize) -> Result<Sparse<'s>, ModelError> {
        let patches = sparse.required_whole("count")?;
        let part =
            |name: &'static str| sparse.object(name)?.ok_or_else(|| sparse.fault(format!("`{name}` is missing")));
        let elements = |part: &Value<'a>, size| {
            let view = source.view(part)?.ok_or_else(|| part.fault("`bufferView` is missing"))?;
            Elements::within(view, part.whole("byteOffset")?.unwrap_or(0), (patches, size), part.place)
        };
        let (of_indices, of_values) = (part("indices")?, part("values")?);
        let index = Component::of(&of_indices)?;
        if !INDICES.contains(&index) {
            return Err(of_indices.fault("its componentType is not one that indices may have"));
        }
        let sparse =
            Sparse { indices: elements(&of_indices, index.size())?, index, values: elements(&of_values, size)? };
        source.budget.spend(patches, 1, of_indices.place)?;
        sparse.check(patches, count, of_indices.place)?;
        Ok(sparse)
    }

    fn check(&self, patches: usize, count: usize, place: Place) -> Result<(), ModelError> {
        let mut least = 0;
        for patch in 0..patches {
            let index = self.index_of(patch);
            if index < least {
                return Err(place.fault(format!("the indices must ascend, but entry {patch} is {index}")));
            }
            if index >= count {
                return Err(place.fault(format!("entry {patch} is {index}, beyond the {count} elements")));
            }
            least = index + 1;
        }
        Ok(())
    }

    /// The index of an element that a patch takes the place of.
    fn index_of(&self, patch: usize) -> usize {
        self.index.number(self.indices.get(patch)) as usize
    }

    /// What takes the place of the element with this index.
    fn find(&self, index: usize) -> Option<&'s [u8]> {
        let (mut from, mut to) = (0, self.indices.bytes.len().div_ceil(self.indices.stride));
        while from < to {
            let middle = from + (to - from) / 2;
            match self.index_of(middle).cmp(&index) {
                std::cmp::Ordering::Less => from = middle + 1,
                std::cmp::Ordering::Greater => to = middle,
                std::cmp::Ordering::Equal => return Some(self.values.get(middle)),
            }
        }
        None
    }
}

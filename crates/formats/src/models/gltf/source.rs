//! The file as a whole: its lists, which refer to each other by index, and its buffers.

use super::super::ModelError;
use super::account::{Budget, Notes};
use super::container::Container;
use super::files::Files;
use super::value::{Place, Value};
use crate::{Assets, Limits};
use std::borrow::Cow;
use std::cell::OnceCell;

/// A glTF file being read.
pub(super) struct Source<'a> {
    pub(super) root: Value<'a>,
    /// The file, as the scene says it.
    pub(super) file: &'a str,
    pub(super) files: Files<'a>,
    pub(super) limits: &'a Limits,
    pub(super) budget: Budget,
    pub(super) notes: Notes,
    /// The chunk of a `.glb` file.
    binary: Option<&'a [u8]>,
    /// The buffers that have been asked for.
    buffers: Vec<OnceCell<Cow<'a, [u8]>>>,
}

/// A part of a buffer.
#[derive(Clone, Copy)]
pub(super) struct View<'s> {
    pub(super) bytes: &'s [u8],
    /// From one element to the next; `None` if they lie next to each other.
    pub(super) stride: Option<usize>,
    pub(super) place: Place,
}

impl<'a> Source<'a> {
    pub(super) fn new(
        root: Value<'a>,
        container: &Container<'a>,
        file: &'a str,
        assets: &'a dyn Assets,
        limits: &'a Limits,
    ) -> Result<Source<'a>, ModelError> {
        let mut buffers = Vec::new();
        buffers.resize_with(root.list("buffers")?.len(), OnceCell::new);
        let bytes = container.json.len() + container.binary.map_or(0, <[u8]>::len);
        Ok(Source {
            root,
            file,
            files: Files::of(file, assets, limits),
            limits,
            budget: Budget::of(bytes, limits.max_primitives),
            notes: Notes::default(),
            binary: container.binary,
            buffers,
        })
    }

    /// An element of one of the file's lists, which `from` refers to.
    pub(super) fn item(&self, list: &'static str, index: usize, from: Place) -> Result<Value<'a>, ModelError> {
        let there = self.root.list(list)?;
        there.object(index)?.ok_or_else(|| from.fault(format!("there is no {list}[{index}]")))
    }

    /// The element that a field refers to, and its index.
    pub(super) fn referred(
        &self,
        from: &Value<'a>,
        field: &'static str,
        list: &'static str,
    ) -> Result<Option<(usize, Value<'a>)>, ModelError> {
        let Some(index) = from.whole(field)? else { return Ok(None) };
        Ok(Some((index, self.item(list, index, from.place.field(field))?)))
    }

    /// The buffer view that the field `bufferView` refers to.
    pub(super) fn view(&self, from: &Value<'a>) -> Result<Option<View<'_>>, ModelError> {
        let Some((_, view)) = self.referred(from, "bufferView", "bufferViews")? else { return Ok(None) };
        let (start, length) = (view.whole("byteOffset")?.unwrap_or(0), view.required_whole("byteLength")?);
        let Some((index, buffer)) = self.referred(&view, "buffer", "buffers")? else {
            return Err(view.fault("`buffer` is missing"));
        };
        let all = self.buffer(index, &buffer)?;
        let range = start.checked_add(length).map(|end| start..end);
        match range.and_then(|range| all.get(range)) {
            Some(bytes) => Ok(Some(View { bytes, stride: view.whole("byteStride")?, place: view.place })),
            None => {
                let message = format!("{length} bytes from {start} on reach beyond buffers[{index}]");
                Err(view.fault(format!("{message}, which has {}", all.len())))
            }
        }
    }

    fn buffer(&self, index: usize, buffer: &Value<'a>) -> Result<&[u8], ModelError> {
        let Some(cell) = self.buffers.get(index) else { return Ok(&[]) };
        if let Some(bytes) = cell.get() {
            return Ok(bytes);
        }
        let bytes = self.load_buffer(index, buffer)?;
        Ok(cell.get_or_init(|| bytes))
    }

    fn load_buffer(&self, index: usize, buffer: &Value<'a>) -> Result<Cow<'a, [u8]>, ModelError> {
        let length = buffer.required_whole("byteLength")?;
        let mut bytes = match (buffer.text("uri")?, self.binary) {
            (Some(uri), _) => {
                let bytes = self.files.read(uri, self.limits.max_file_bytes, buffer.place)?;
                self.budget.grow(bytes.len());
                Cow::Owned(bytes)
            }
            (None, Some(binary)) if index == 0 => Cow::Borrowed(binary),
            (None, _) => return Err(buffer.fault("this buffer has no data: `uri` is missing")),
        };
        if bytes.len() < length {
            return Err(buffer.fault(format!("it should have {length} bytes, but has only {}", bytes.len())));
        }
        match &mut bytes {
            Cow::Borrowed(bytes) => *bytes = &bytes[..length],
            Cow::Owned(bytes) => bytes.truncate(length),
        }
        Ok(bytes)
    }
}

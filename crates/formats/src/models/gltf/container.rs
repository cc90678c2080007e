//! The two containers: JSON text by itself, and the chunks of a `.glb` file.

use super::super::{FilePlace, LOST, ModelError};

/// What a file is made of.
pub(super) struct Container<'a> {
    /// The text.
    pub(super) json: &'a [u8],
    /// Where it begins, if the file is binary.
    pub(super) json_starts: Option<u64>,
    /// The bytes that come with it.
    pub(super) binary: Option<&'a [u8]>,
}

const MAGIC: &[u8] = b"glTF";
/// Bytes of the header: magic, version, length.
const HEADER: usize = 12;
/// Bytes before each chunk: its length, its kind.
const CHUNK_HEADER: usize = 8;
const JSON: u32 = u32::from_le_bytes(*b"JSON");
const BINARY: u32 = u32::from_le_bytes(*b"BIN\0");

/// Divides a file into its parts; its first bytes tell which kind it is, since names lie.
pub(super) fn open(bytes: &[u8]) -> Result<Container<'_>, ModelError> {
    if bytes.starts_with(MAGIC) {
        return open_binary(bytes);
    }
    let json = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    Ok(Container { json, json_starts: None, binary: None })
}

fn open_binary(bytes: &[u8]) -> Result<Container<'_>, ModelError> {
    let (Some(version), Some(length)) = (number(bytes, 4), number(bytes, 8)) else {
        return Err(fault(bytes.len(), "the file ends within its header").help(LOST));
    };
    if version != 2 {
        let fault = fault(4, format!("this is glTF {version}; only 2.0 can be read"));
        return Err(fault.help("convert it to glTF 2.0 first, for example with Blender"));
    }
    let Some(bytes) = bytes.get(..length as usize) else {
        let message = format!("the header promises {length} bytes, but the file has only {}", bytes.len());
        return Err(fault(8, message));
    };
    let (kind, json, mut next) = chunk(bytes, HEADER)?;
    if kind != JSON {
        return Err(fault(HEADER + 4, "the first chunk is not JSON"));
    }
    // The padding is spaces; some write zeros.
    let json = &json[..json.iter().rposition(|byte| *byte != 0).map_or(0, |last| last + 1)];
    let mut binary = None;
    while binary.is_none() && next < bytes.len() {
        let (kind, data, after) = chunk(bytes, next)?;
        binary = (kind == BINARY).then_some(data);
        next = after;
    }
    Ok(Container { json, json_starts: Some((HEADER + CHUNK_HEADER) as u64), binary })
}

/// The kind and the bytes of the chunk at `start`, and where the next one starts.
fn chunk(bytes: &[u8], start: usize) -> Result<(u32, &[u8], usize), ModelError> {
    let (Some(length), Some(kind)) = (number(bytes, start), number(bytes, start + 4)) else {
        return Err(fault(start, "the file ends within the header of a chunk").help(LOST));
    };
    let data = &bytes[start + CHUNK_HEADER..];
    match data.get(..length as usize) {
        Some(data) => Ok((kind, data, start + CHUNK_HEADER + data.len())),
        None => {
            let message = format!("this chunk should have {length} bytes, but only {} follow", data.len());
            Err(fault(start, message).help(LOST))
        }
    }
}

/// The little-endian number at `at`.
fn number(bytes: &[u8], at: usize) -> Option<u32> {
    bytes.get(at..)?.first_chunk().map(|number| u32::from_le_bytes(*number))
}

fn fault(at: usize, message: impl Into<String>) -> ModelError {
    ModelError::new(message).at(FilePlace::Byte(at as u64))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A file of these chunks, whose header says it is `more` bytes longer than it is.
    fn binary(chunks: &[(&[u8; 4], &[u8])], more: i32) -> Vec<u8> {
        let mut body = Vec::new();
        for (kind, data) in chunks {
            body.extend_from_slice(&(data.len() as u32).to_le_bytes());
            body.extend_from_slice(*kind);
            body.extend_from_slice(data);
        }
        let length = (body.len() as i32 + 12 + more) as u32;
        [b"glTF".as_slice(), &2_u32.to_le_bytes(), &length.to_le_bytes(), &body].concat()
    }

    fn place_of_fault(bytes: &[u8]) -> Option<FilePlace> {
        open(bytes).err().and_then(|fault| fault.place)
    }

    #[test]
    fn chunks_are_found() {
        let file = binary(&[(b"JSON", b"{}\0\0"), (b"WHAT", b"1234"), (b"BIN\0", b"data")], 0);
        let container = open(&file).unwrap();
        assert_eq!((container.json, container.json_starts), (b"{}".as_slice(), Some(20)));
        assert_eq!(container.binary, Some(b"data".as_slice()));
        let file = binary(&[(b"JSON", b"{}  ")], 0);
        assert_eq!(open(&file).unwrap().binary, None);
        assert_eq!(open(b"\xef\xbb\xbf{}").unwrap().json, b"{}");
    }

    #[test]
    fn lies_are_found_where_they_are() {
        assert_eq!(place_of_fault(b"glTF\x02\0\0\0"), Some(FilePlace::Byte(8)));
        assert_eq!(place_of_fault(b"glTF\x01\0\0\0\x0c\0\0\0"), Some(FilePlace::Byte(4)));
        assert_eq!(place_of_fault(&binary(&[(b"JSON", b"{}  ")], 1)), Some(FilePlace::Byte(8)));
        assert_eq!(place_of_fault(&binary(&[(b"JSON", b"{}  ")], -1)), Some(FilePlace::Byte(12)));
        assert_eq!(place_of_fault(&binary(&[(b"JSON", b"{}  ")], -12)), Some(FilePlace::Byte(12)));
        assert_eq!(place_of_fault(&binary(&[(b"JSON", b"{}  ")], -16)), Some(FilePlace::Byte(12)));
        assert_eq!(place_of_fault(&binary(&[(b"BIN\0", b"{}  ")], 0)), Some(FilePlace::Byte(16)));
        let mut file = binary(&[(b"JSON", b"{}  "), (b"BIN\0", b"data")], 0);
        file[24] = 255;
        assert_eq!(place_of_fault(&file), Some(FilePlace::Byte(24)));
    }
}

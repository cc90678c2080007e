//! Makes glTF files.

use serde_json::{Value, json};

/// A file under construction: its JSON, and one buffer.
#[derive(Clone)]
pub(super) struct File {
    pub(super) json: Value,
    pub(super) data: Vec<u8>,
}

/// The numbers of component types.
pub(super) const I8: u32 = 5120;
pub(super) const U8: u32 = 5121;
pub(super) const I16: u32 = 5122;
pub(super) const U16: u32 = 5123;
pub(super) const U32: u32 = 5125;
pub(super) const F32: u32 = 5126;

impl File {
    /// A scene without nodes.
    pub(super) fn new() -> File {
        let json = json!({
            "asset": { "version": "2.0" },
            "scene": 0,
            "scenes": [{ "nodes": [] }],
            "nodes": [],
            "meshes": [],
            "accessors": [],
            "bufferViews": [],
        });
        File { json, data: Vec::new() }
    }

    /// Adds to one of the file's lists; gives the index.
    pub(super) fn push(&mut self, list: &str, value: Value) -> usize {
        if self.json[list].is_null() {
            self.json[list] = json!([]);
        }
        let list = self.json[list].as_array_mut().unwrap();
        list.push(value);
        list.len() - 1
    }

    /// Puts bytes into the buffer, with a view of them.
    pub(super) fn view(&mut self, bytes: &[u8]) -> usize {
        self.data.resize(self.data.len().next_multiple_of(4), 0);
        let view = json!({ "buffer": 0, "byteOffset": self.data.len(), "byteLength": bytes.len() });
        self.data.extend_from_slice(bytes);
        self.push("bufferViews", view)
    }

    /// Puts elements into the buffer, with an accessor of them.
    pub(super) fn accessor(&mut self, kind: &str, component: u32, count: usize, bytes: &[u8]) -> usize {
        let view = self.view(bytes);
        self.push("accessors", json!({ "bufferView": view, "componentType": component, "count": count, "type": kind }))
    }

    /// An accessor of numbers or vectors in single precision.
    pub(super) fn floats<const N: usize>(&mut self, elements: &[[f32; N]]) -> usize {
        let kind = match N {
            1 => "SCALAR",
            2 => "VEC2",
            3 => "VEC3",
            4 => "VEC4",
            _ => "MAT4",
        };
        let bytes: Vec<u8> = elements.iter().flatten().flat_map(|number| number.to_le_bytes()).collect();
        self.accessor(kind, F32, elements.len(), &bytes)
    }

    /// An accessor of indices of 16 bits.
    pub(super) fn indices(&mut self, indices: &[u16]) -> usize {
        let bytes: Vec<u8> = indices.iter().flat_map(|index| index.to_le_bytes()).collect();
        self.accessor("SCALAR", U16, indices.len(), &bytes)
    }

    /// Adds a node to the scene; gives its index.
    pub(super) fn node(&mut self, node: Value) -> usize {
        let index = self.push("nodes", node);
        self.json["scenes"][0]["nodes"].as_array_mut().unwrap().push(json!(index));
        index
    }

    /// Adds a mesh of one primitive, and a node that shows it; gives the mesh.
    pub(super) fn show(&mut self, primitive: Value) -> usize {
        let primitives = Value::Array(vec![primitive]);
        let mesh = self.push("meshes", json!({ "primitives": primitives }));
        self.node(json!({ "mesh": mesh }));
        mesh
    }

    /// Shows a triangle of this material; gives the mesh.
    pub(super) fn show_triangle(&mut self, material: Value) -> usize {
        let positions = self.floats(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
        let uvs = self.floats(&[[0.0, 0.0], [1.0, 0.0], [0.25, 0.75]]);
        let material = self.push("materials", material);
        self.show(json!({ "attributes": { "POSITION": positions, "TEXCOORD_0": uvs }, "material": material }))
    }

    /// Adds a texture that shows a picture of 8 bits a component; gives its index.
    pub(super) fn texture(&mut self, width: u32, pixels: &[[u8; 4]]) -> usize {
        let view = self.view(&png(width, pixels));
        let image = self.push("images", json!({ "bufferView": view, "mimeType": "image/png" }));
        self.push("textures", json!({ "source": image }))
    }

    /// The file as text, its buffer in a data URI.
    pub(super) fn text(&self) -> Vec<u8> {
        use base64::Engine;
        let data = base64::prelude::BASE64_STANDARD.encode(&self.data);
        let mut json = self.json.clone();
        let uri = format!("data:application/octet-stream;base64,{data}");
        if !self.data.is_empty() && json["buffers"].is_null() {
            json["buffers"] = json!([{ "byteLength": self.data.len(), "uri": uri }]);
        }
        json.to_string().into_bytes()
    }

    /// The file as chunks.
    pub(super) fn binary(&self) -> Vec<u8> {
        let mut json = self.json.clone();
        if !self.data.is_empty() && json["buffers"].is_null() {
            json["buffers"] = json!([{ "byteLength": self.data.len() }]);
        }
        let mut json = json.to_string().into_bytes();
        json.resize(json.len().next_multiple_of(4), b' ');
        let mut data = self.data.clone();
        data.resize(data.len().next_multiple_of(4), 0);
        let number = |length: usize| (length as u32).to_le_bytes();
        let mut bytes = [b"glTF".as_slice(), &number(2), &number(0)].concat();
        for (kind, chunk) in [(b"JSON", &json), (b"BIN\0", &data)] {
            bytes.extend_from_slice(&number(chunk.len()));
            bytes.extend_from_slice(kind);
            bytes.extend_from_slice(chunk);
        }
        let length = number(bytes.len());
        bytes[8..12].copy_from_slice(&length);
        bytes
    }
}

/// A PNG file of 8 bits a component with alpha, without compression.
pub(super) fn png(width: u32, pixels: &[[u8; 4]]) -> Vec<u8> {
    let height = pixels.len() as u32 / width;
    let row = |row: &[[u8; 4]]| [&[0], row.as_flattened()].concat();
    let raw: Vec<u8> = pixels.chunks(width as usize).flat_map(row).collect();
    let length = raw.len() as u16;
    let mut stream = vec![0x78, 0x01, 0x01];
    stream.extend_from_slice(&length.to_le_bytes());
    stream.extend_from_slice(&(!length).to_le_bytes());
    stream.extend_from_slice(&raw);
    let (mut a, mut b) = (1_u32, 0_u32);
    for byte in raw {
        a = (a + u32::from(byte)) % 65521;
        b = (b + a) % 65521;
    }
    stream.extend_from_slice(&(b << 16 | a).to_be_bytes());
    let header = [&width.to_be_bytes()[..], &height.to_be_bytes(), &[8, 6, 0, 0, 0]].concat();
    let mut file = b"\x89PNG\r\n\x1a\n".to_vec();
    for (kind, data) in [(b"IHDR", &header), (b"IDAT", &stream), (b"IEND", &Vec::new())] {
        file.extend_from_slice(&(data.len() as u32).to_be_bytes());
        let body = [kind, &data[..]].concat();
        file.extend_from_slice(&body);
        file.extend_from_slice(&crc(&body).to_be_bytes());
    }
    file
}

fn crc(bytes: &[u8]) -> u32 {
    let step = |crc: u32| if crc & 1 == 1 { crc >> 1 ^ 0xedb8_8320 } else { crc >> 1 };
    !bytes.iter().fold(!0, |crc: u32, byte| (0..8).fold(crc ^ u32::from(*byte), |crc, _| step(crc)))
}

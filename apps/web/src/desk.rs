//! What lies between calls: input, output, and the files that were brought.

use durer::{Limits, MemoryAssets, RenderOptions};
use std::sync::{Mutex, PoisonError};

static DESK: Mutex<Option<Desk>> = Mutex::new(None);

/// Calls `work` with what lies there.
pub(crate) fn with_desk<T>(work: impl FnOnce(&mut Desk) -> T) -> T {
    work(DESK.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert_default())
}

#[derive(Default)]
pub(crate) struct Desk {
    input: Vec<u8>,
    output: Vec<u8>,
    files: MemoryAssets,
}

impl Desk {
    /// Room for input.
    pub(crate) fn room(&mut self, length: usize) -> &mut [u8] {
        self.input = vec![0; length];
        &mut self.input
    }

    /// Adds a file from the input, which begins with its name.
    pub(crate) fn add_file(&mut self, name_length: usize) {
        let mut name = std::mem::take(&mut self.input);
        let content = name.split_off(name_length.min(name.len()));
        self.files.insert(&String::from_utf8_lossy(&name), content);
    }

    /// Puts out the fingerprint of the scene named by the input, or what is wrong with it; true if it is the fingerprint.
    pub(crate) fn fingerprint(&mut self, longer_side: u32) -> bool {
        let name = String::from_utf8_lossy(&std::mem::take(&mut self.input)).into_owned();
        let answer = self.render(&name, longer_side);
        let is_fine = answer.is_ok();
        self.output = answer.unwrap_or_else(|message| message).into_bytes();
        is_fine
    }

    pub(crate) fn output(&self) -> &[u8] {
        &self.output
    }

    fn render(&self, name: &str, longer_side: u32) -> Result<String, String> {
        let bytes = self.files.get(name).ok_or_else(|| format!("there is no file {name}"))?;
        let loaded = durer::load_bytes(bytes, name, &self.files, &Limits::default());
        let loaded = loaded.map_err(|diagnostics| diagnostics.render(false))?;
        let mut scene = loaded.scene.into_scene();
        scene.picture = scene.picture.with_longer_side(longer_side);
        let scene =
            scene.check().map_err(|problems| format!("{name} cannot be {longer_side} pixels large: {problems:?}"))?;
        let film = durer::render(&durer::compile(&scene), &RenderOptions::default(), &());
        Ok(film.map_err(|error| error.to_string())?.develop().fingerprint().to_string())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn put(desk: &mut Desk, name: &str, content: &str) {
        let whole = format!("{name}{content}");
        desk.room(whole.len()).copy_from_slice(whole.as_bytes());
        desk.add_file(name.len());
    }

    fn ask(desk: &mut Desk, name: &str) -> (bool, String) {
        desk.room(name.len()).copy_from_slice(name.as_bytes());
        (desk.fingerprint(16), String::from_utf8_lossy(desk.output()).into_owned())
    }

    #[test]
    fn a_scene_with_a_file_becomes_a_fingerprint_or_a_message() {
        let mut desk = Desk::default();
        put(&mut desk, "a.yaml", "objects: [mesh: {file: b.obj}]");
        let (is_fine, message) = ask(&mut desk, "a.yaml");
        assert!(!is_fine && message.contains("b.obj"), "{message}");
        put(&mut desk, "b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
        let (is_fine, first) = ask(&mut desk, "a.yaml");
        assert!(is_fine && first.len() == 32, "{first}");
        put(&mut desk, "b.obj", "v 0 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\n");
        let (is_fine, second) = ask(&mut desk, "a.yaml");
        assert!(is_fine && second != first, "{second}");
        assert_eq!(ask(&mut desk, "c.yaml"), (false, "there is no file c.yaml".to_owned()));
    }
}

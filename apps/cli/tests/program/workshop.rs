//! A folder of its own for each test, with scenes in it, and the program run there.

use durer::imaging::{DecodeLimits, Image, Transfer};
use std::path::PathBuf;
use std::process::{Command, Output};

/// A room with a mirror, glass, fog, a texture, two lights and a group: 24 × 16 pixels.
pub(crate) const ROOM: &str = r"
camera: {position: [0, 1, 6], look_at: [0, 0.5, 0]}
picture: {width: 24, height: 16}
render: {antialias: none}
fog: {exponential: {color: lightgray, distance: 50}}
background: {bottom: white, top: skyblue}
lights:
  - point: {position: [5, 6, 5], name: lamp}
  - spot: {position: [-3, 5, 2], target: [0, 0, 0], half_angle: 20}
materials:
  glass: {color: white, transparency: 0.8, ior: 1.5, fresnel: true, specular: 0.6}
objects:
  - plane: {name: floor, material: {color: {checker: {size: 0.5}}, reflection: 0.3}}
  - sphere: {center: [0, 1, 0], radius: 1, material: glass, name: ball}
  - group:
      material: {color: tomato}
      objects: [sphere: {center: [2, 1, -2], radius: 1}, box: {min: [-3, 0, -3], max: [-2, 1, -2]}]
";

/// A scene whose sphere has an impossible radius and a misspelt field.
pub(crate) const BAD: &str = "objects:\n  - sphere: {radius: -1}\n  - sphere: {radus: 2}\n";

/// A folder that is removed in the end.
pub(crate) struct Workshop(tempfile::TempDir);

/// What a run of the program gave.
pub(crate) struct Ran {
    /// The exit code; `None` if a signal ended it.
    pub(crate) code: Option<i32>,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

impl Workshop {
    /// A folder with `room.yaml` and `bad.yaml`.
    pub(crate) fn new() -> Workshop {
        let workshop = Workshop(tempfile::tempdir().unwrap());
        workshop.put("room.yaml", ROOM);
        workshop.put("bad.yaml", BAD);
        workshop
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub(crate) fn put(&self, name: &str, text: &str) {
        std::fs::write(self.path(name), text).unwrap();
    }

    pub(crate) fn bytes(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.path(name)).unwrap()
    }

    /// The picture in linear light.
    pub(crate) fn picture(&self, name: &str) -> Image {
        durer::read_picture(&self.path(name), &DecodeLimits::default()).unwrap().to_image(Transfer::Srgb)
    }

    /// Names of all files, sorted.
    pub(crate) fn names(&self) -> Vec<String> {
        let names = std::fs::read_dir(self.0.path()).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap());
        let mut names: Vec<String> = names.collect();
        names.sort();
        names
    }

    /// The program with these words, separated by blanks, in this folder.
    pub(crate) fn command(&self, words: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_durer"));
        command.args(words.split_whitespace()).current_dir(self.0.path());
        for variable in ["NO_COLOR", "CLICOLOR", "CLICOLOR_FORCE", "RAYON_NUM_THREADS"] {
            command.env_remove(variable);
        }
        command
    }

    /// Runs the program.
    pub(crate) fn run(&self, words: &str) -> Ran {
        self.command(words).output().unwrap().into()
    }

    /// Runs the program, which must end well.
    pub(crate) fn fine(&self, words: &str) -> Ran {
        let ran = self.run(words);
        assert_eq!(ran.code, Some(0), "durer {words}: {}", ran.stderr);
        ran
    }

    /// Runs the program, which must fail with this code and say this.
    pub(crate) fn fails(&self, words: &str, code: i32, message: &str) -> Ran {
        let ran = self.run(words);
        assert_eq!(ran.code, Some(code), "durer {words}: {}", ran.stderr);
        assert!(ran.stderr.contains(message), "durer {words}: expected `{message}` in:\n{}", ran.stderr);
        ran
    }
}

impl From<Output> for Ran {
    fn from(output: Output) -> Ran {
        Ran {
            code: output.status.code(),
            stdout: String::from_utf8(output.stdout).unwrap(),
            stderr: String::from_utf8(output.stderr).unwrap(),
        }
    }
}

impl Ran {
    pub(crate) fn json(&self) -> serde_json::Value {
        serde_json::from_str(&self.stdout).unwrap()
    }
}

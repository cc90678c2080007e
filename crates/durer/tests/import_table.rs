//! Who may import whom, and that no package slips out of the workspace's rules.

use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

/// For each package of ours, those of ours that it may name.
const MAY_IMPORT: [(&str, &[&str]); 11] = [
    ("durer-math", &[]),
    ("durer-imaging", &["durer-math"]),
    ("durer-geometry", &["durer-math"]),
    ("durer-scene", &["durer-math", "durer-imaging"]),
    ("durer-formats", &["durer-math", "durer-imaging", "durer-scene"]),
    ("durer-render", &["durer-math", "durer-imaging", "durer-geometry", "durer-scene"]),
    ("durer", &["durer-math", "durer-imaging", "durer-geometry", "durer-scene", "durer-formats", "durer-render"]),
    ("durer-cli", &["durer"]),
    ("durer-web", &["durer"]),
    ("durer-trials", &["durer"]),
    ("xtask", &["durer", "durer-trials"]),
];

/// What tests, and only tests, may import beside that: package and imported package.
const TESTS_MAY_IMPORT: [(&str, &str); 0] = [];

/// Files in which unsafe code is allowed; each place says why.
const UNSAFE_ALLOWED: [&str; 3] =
    ["apps/web/src/lib.rs", "crates/geometry/src/simd/memory.rs", "xtask/src/bench/measure.rs"];

fn root() -> PathBuf {
    [env!("CARGO_MANIFEST_DIR"), "..", ".."].iter().collect()
}

/// The workspace's packages, as cargo knows them.
fn packages() -> Vec<Value> {
    let output = Command::new(env!("CARGO"))
        .args(["metadata", "--no-deps", "--format-version", "1"])
        .current_dir(root())
        .output()
        .expect("cargo runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let metadata: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    metadata["packages"].as_array().expect("a list of packages").clone()
}

fn text(value: &Value) -> &str {
    value.as_str().expect("a string")
}

#[test]
fn every_package_imports_only_what_the_table_allows() {
    let table = BTreeMap::from(MAY_IMPORT);
    let packages = packages();
    let mut imports = 0;
    for package in &packages {
        let name = text(&package["name"]);
        let allowed = table.get(name).unwrap_or_else(|| panic!("{name} is missing in the table"));
        for dependency in package["dependencies"].as_array().expect("a list of dependencies") {
            let imported = text(&dependency["name"]);
            let for_tests = dependency["kind"].as_str() == Some("dev") && TESTS_MAY_IMPORT.contains(&(name, imported));
            if table.contains_key(imported) {
                assert!(allowed.contains(&imported) || for_tests, "{name} must not import {imported}");
                imports += 1;
            }
        }
    }
    let names: Vec<&str> = packages.iter().map(|package| text(&package["name"])).collect();
    for name in table.keys() {
        assert!(names.contains(name), "{name} is in the table but not in the workspace");
    }
    assert!(imports >= 16, "cargo told of {imports} imports only: has its format changed?");
}

#[test]
fn every_package_has_the_lints_of_the_workspace() {
    for package in packages() {
        let manifest = std::fs::read_to_string(text(&package["manifest_path"])).expect("a manifest");
        let lines: Vec<&str> = manifest.lines().map(str::trim).collect();
        let inherits = lines.windows(2).any(|pair| pair == ["[lints]", "workspace = true"]);
        assert!(inherits, "{} has no `[lints] workspace = true`", package["name"]);
    }
    let workspace = std::fs::read_to_string(root().join("Cargo.toml")).expect("the workspace's manifest");
    let denied = |level: &str| workspace.contains(&format!("unsafe_code = \"{level}\""));
    assert!(denied("deny") || denied("forbid"), "the workspace allows unsafe code");
}

#[test]
fn unsafe_code_is_allowed_only_where_the_list_says() {
    let mut found = Vec::new();
    for package in packages() {
        let folder = Path::new(text(&package["manifest_path"])).parent().expect("a folder").to_owned();
        visit(&folder, &mut |path, source| {
            // Put together here so that this file does not name it.
            let allows =
                ["allow", "expect", "warn"].iter().any(|level| source.contains(&format!("{level}(unsafe_code")));
            if allows {
                found.push(path.to_owned());
            }
        });
    }
    let root = root().canonicalize().expect("the workspace");
    let relative = |path: &PathBuf| {
        let path = path.canonicalize().expect("a source file");
        path.strip_prefix(&root).expect("a file of the workspace").to_string_lossy().replace('\\', "/")
    };
    for path in found.iter().map(relative) {
        assert!(UNSAFE_ALLOWED.contains(&path.as_str()), "{path} allows unsafe code");
    }
}

/// Calls `each` for every Rust source below a folder, but not for what was built.
fn visit(folder: &Path, each: &mut impl FnMut(&Path, &str)) {
    for entry in std::fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path()) {
        if entry.is_dir() && !entry.ends_with("target") {
            visit(&entry, each);
        } else if entry.extension().is_some_and(|extension| extension == "rs") {
            each(&entry, &std::fs::read_to_string(&entry).expect("UTF-8"));
        }
    }
}

//! What we ship loads: every scene, and every snippet of a scene in the documents.

use durer::{Limits, LoadOptions, NoAssets};
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn files(folder: &Path, extension: &str, found: &mut Vec<PathBuf>) {
    let mut entries: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            files(&path, extension, found);
        } else if path.extension().is_some_and(|e| e == extension) {
            found.push(path);
        }
    }
}

#[test]
fn every_scene_loads_without_a_warning_and_can_be_compiled() {
    let mut scenes = Vec::new();
    files(&root().join("scenes"), "yaml", &mut scenes);
    assert!(scenes.len() > 30, "{scenes:?}");
    for path in scenes {
        let loaded = durer::load_file(&path, &LoadOptions::default()).unwrap_or_else(|errors| panic!("{errors}"));
        assert!(loaded.warnings.is_empty(), "{}", loaded.warnings);
        durer::compile(&loaded.scene);
    }
}

/// The `yaml` blocks of a document, each with the line that it begins on. Blocks with images are left out: their files
/// are not there.
fn snippets(text: &str) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    let mut lines = text.lines().enumerate();
    while let Some((number, line)) = lines.next() {
        if line.trim() == "```yaml" {
            let block = lines.by_ref().map(|(_, line)| line).take_while(|line| line.trim() != "```");
            found.push((number + 2, block.collect::<Vec<_>>().join("\n")));
        }
    }
    found.retain(|(_, block)| !block.contains("file:"));
    found
}

#[test]
fn every_scene_in_readme_and_guide_loads() {
    let mut count = 0;
    for document in ["README.md", "docs/guide.md"] {
        let text = std::fs::read_to_string(root().join(document)).unwrap();
        for (line, block) in snippets(&text) {
            let name = format!("{document}:{line}");
            if let Err(errors) = durer::load_str(&block, &name, &NoAssets, &Limits::default()) {
                panic!("{errors}");
            }
            count += 1;
        }
    }
    assert!(count > 10, "only {count} snippets were found");
}

#[test]
fn the_guide_tells_the_limits() {
    let guide = std::fs::read_to_string(root().join("docs/guide.md")).unwrap();
    let (all, few) = (durer::Limits::default(), durer::Limits::untrusted());
    for limit in durer::Limit::ALL {
        let [starts, ends] = [
            format!("| `{}` |", limit.key()),
            format!("| {} | {} |", limit.shown(all.get(*limit)), limit.shown(few.get(*limit))),
        ];
        let told = guide.lines().any(|line| line.starts_with(&starts) && line.ends_with(&ends));
        assert!(told, "no row {starts} ... {ends}");
    }
}

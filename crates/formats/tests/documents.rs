//! The committed schema and reference page are those that the definitions give.

use durer_formats::{json_schema, reference_markdown};

#[track_caller]
fn assert_fresh(path: &str, text: &str) {
    let path = format!("{}/../../{path}", env!("CARGO_MANIFEST_DIR"));
    let committed = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(committed == text, "{path} is stale: renew it with `cargo xtask bless`");
}

#[test]
fn the_schema_is_fresh() {
    assert_fresh("docs/scene.schema.json", &(serde_json::to_string_pretty(&json_schema()).unwrap() + "\n"));
}

#[test]
fn the_reference_is_fresh() {
    assert_fresh("docs/reference.md", &reference_markdown());
}

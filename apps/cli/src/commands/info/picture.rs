//! `durer info` of a picture file: what it says of itself.

use crate::exit::{Exit, Failure};
use crate::output;
use durer::imaging::FileFacts;
use serde_json::{Value, json};
use std::path::Path;

/// Tells what the file's header says.
pub(super) fn run(path: &Path, as_json: bool) -> Result<Exit, Failure> {
    let facts = durer::picture_facts(path)?;
    match as_json {
        true => output::print_json(&json(&facts))?,
        false => output::print(&format!("{}\n{}", path.display(), text(&facts)))?,
    }
    Ok(Exit::Fine)
}

fn text(facts: &FileFacts) -> String {
    let size = format!("{} × {} pixels", facts.width, facts.height);
    let own = [("kind", facts.format.name()), ("size", &size), ("samples", &facts.samples)];
    let metadata = facts.metadata.iter().map(|(keyword, text)| (keyword.as_str(), text.as_str()));
    let lines: Vec<(&str, &str)> = own.into_iter().chain(metadata).collect();
    let width = lines.iter().map(|(title, _)| title.chars().count()).max().unwrap_or(0);
    // A picture may say anything, but not lead the terminal astray.
    let shown = |text: &str| text.replace(|c: char| c.is_control(), " ");
    lines.iter().map(|(title, text)| format!("  {:<width$} {}\n", shown(title), shown(text))).collect()
}

fn json(facts: &FileFacts) -> Value {
    let metadata: serde_json::Map<String, Value> =
        facts.metadata.iter().map(|(keyword, text)| (keyword.clone(), json!(text))).collect();
    json!({
        "format": facts.format.extension(),
        "width": facts.width,
        "height": facts.height,
        "samples": facts.samples,
        "metadata": metadata,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use durer::imaging::FileFormat;

    #[test]
    fn what_a_picture_says_cannot_move_the_cursor() {
        let facts = FileFacts {
            format: FileFormat::Png,
            width: 3,
            height: 2,
            samples: "gray, 8 bits".to_owned(),
            metadata: vec![("Comment".to_owned(), "a\x1b[2Jb\nc".to_owned())],
        };
        let expected = "  kind    PNG\n  size    3 × 2 pixels\n  samples gray, 8 bits\n  Comment a [2Jb c\n";
        assert_eq!(text(&facts), expected);
    }
}

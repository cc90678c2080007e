//! The report of `cargo xtask bench kernel`.

use super::build::{self, Programs};
use super::lines::{Found, Lines, Who};
use crate::bench::report::place;
use std::fmt::Write;

/// A column of the tables.
struct Column {
    head: &'static str,
    program: &'static str,
    /// The qualities of which the better counts. With one that begins with `user`, balls are geometry of the user's.
    variants: &'static [&'static str],
}

const DURER: Column = Column { head: "durer", program: "durer", variants: &["picture"] };
const MANY_RAYS: Column = Column { head: "durer, many rays", program: "durer", variants: &["many-rays"] };
const EMBREE: [Column; 3] = [
    Column { head: "Embree, medium", program: "Embree", variants: &["medium", "user medium"] },
    Column { head: "Embree, high", program: "Embree", variants: &["high", "user high"] },
    Column { head: "Embree, robust", program: "Embree", variants: &["robust", "user robust"] },
];
const CRATES: [Column; 2] = [
    Column { head: "obvhs, medium", program: "obvhs", variants: &["medium"] },
    Column { head: "bvh", program: "bvh", variants: &[""] },
];

/// Kinds of rays, whether they go in packets, and what they ask for.
const KINDS: [(&str, bool, &str); 6] = [
    ("primary", false, "primary, closest"),
    ("primary", true, "primary, closest, packets"),
    ("bounce", false, "bounce, closest"),
    ("bounce any", false, "bounce, any"),
    ("shadow", false, "shadow, any"),
    ("shadow", true, "shadow, any, packets"),
];

impl Column {
    fn is_of(&self, who: &Who, scene: &str) -> bool {
        who.scene == scene && who.program == self.program && self.variants.contains(&who.variant.as_str())
    }
}

/// A table's cell with a number, or a dash.
fn cell(value: Option<f64>, digits: usize) -> String {
    value.map_or_else(|| "–".to_owned(), |value| format!("{value:.digits$}"))
}

/// The whole report.
pub(super) fn markdown(lines: &Lines, rounds: usize, scenes: &[&str], programs: &Programs) -> Result<String, String> {
    let has_embree = programs.embree.is_some();
    let mut text = format!("# Rays a second\n\n{}\n{}.\n\n", place()?, versions(lines));
    if !has_embree {
        text += ABOUT_EMBREE;
    }
    text += &about(rounds);
    text += "\n## Millions of rays for each second of processor time\n\n";
    text += &rates(lines, scenes, has_embree);
    text += "\n## What the rays found\n\n";
    text += &findings(lines, scenes, has_embree);
    text += "\n## Building, one thread\n\n";
    text += &builds(lines, scenes);
    Ok(text)
}

const ABOUT_EMBREE: &str = "\
Embree is left out, for it was not found: install Embree 4 (a package of your system, such as libembree-dev, embree-devel
or embree, if its version is 4; or a release of github.com/RenderKit/embree). If pkg-config does not know it, name its
folders in `EMBREE_INC` (which holds `embree4/rtcore.h`) and `EMBREE_LIB`.

";

fn versions(lines: &Lines) -> String {
    let mut versions = vec![format!("durer {}", env!("CARGO_PKG_VERSION"))];
    if let Some(number) = lines.embree_version {
        versions.push(format!("Embree {}.{}.{}", number / 10_000, number / 100 % 100, number % 100));
    }
    versions.extend(["obvhs", "bvh"].map(|name| format!("{name} {}", build::version_of(name))));
    versions.join("; ")
}

fn about(rounds: usize) -> String {
    format!(
        "One thread. Medians of {rounds} rounds in which the programs ran in turn, each with one pass over about a million rays\n\
         of a kind after one more to warm up (unless that takes more than two seconds). Scenes and rays are the same to the\n\
         bit: a million triangles as hills, as a cave and at random in a cube, and a million balls. Secondary rays start where\n\
         a program's own primary rays hit. Packets are eight rays: in Embree with its flag for coherent rays, for shadows with\n\
         or without it, whichever is faster; balls are Embree's own points or geometry of the user's, whichever is faster.\n\
         durer computes in double precision, the others in single. durer lets no ray slip through between triangles, Embree\n\
         lets none if it is asked to be robust. The crates are built for this very processor; durer and Embree find out what\n\
         it can do. Ratios above 1: durer is faster.\n"
    )
}

fn columns(has_embree: bool) -> impl Iterator<Item = Column> {
    [DURER, MANY_RAYS].into_iter().chain(EMBREE.into_iter().filter(move |_| has_embree)).chain(CRATES)
}

fn rates(lines: &Lines, scenes: &[&str], has_embree: bool) -> String {
    let heads: Vec<&str> = columns(has_embree).map(|column| column.head).collect();
    let mut text = format!("| scene | rays | {} |", heads.join(" | "));
    text += if has_embree { " durer ÷ medium | durer ÷ high | durer ÷ robust |\n" } else { "\n" };
    text += &format!("|---|---|{}\n", "---:|".repeat(heads.len() + if has_embree { 3 } else { 0 }));
    for scene in scenes {
        for (kind, in_packets, name) in KINDS {
            let rate = |column: &Column| {
                lines.best_rate(kind, |who, way| column.is_of(who, scene) && way.starts_with("packets") == in_packets)
            };
            let cells: Vec<String> = columns(has_embree).map(|column| cell(rate(&column), 2)).collect();
            let _ = write!(text, "| {scene} | {name} | {} |", cells.join(" | "));
            if has_embree {
                let ours = rate(&DURER);
                let ratio = |theirs: &Column| cell(ours.zip(rate(theirs)).map(|(ours, theirs)| ours / theirs), 2);
                let ratios = EMBREE.each_ref().map(ratio);
                let _ = write!(text, " {} |", ratios.join(" | "));
            }
            text.push('\n');
        }
    }
    text
}

/// Hits of the first column, and how many more or less the others have.
fn findings(lines: &Lines, scenes: &[&str], has_embree: bool) -> String {
    let reference = if has_embree { &EMBREE[0] } else { &DURER };
    let others: Vec<Column> = columns(has_embree).filter(|column| column.head != reference.head).collect();
    let heads: String = others.iter().map(|column| format!(" {} |", column.head)).collect();
    let mut text = format!(
        "Rays of {head}, their hits and the sum of their distances; then how much these differ for the others. A few rays\n\
         along edges are told apart by the last bit, and secondary rays follow from them.\n\n\
         | scene | rays | {head} |{heads}\n|---|---|---:|{}\n",
        "---:|".repeat(others.len()),
        head = reference.head,
    );
    for scene in scenes {
        for (kind, in_packets, name) in KINDS {
            let found = |column: &Column| {
                lines.found(kind, |who, way| column.is_of(who, scene) && way.starts_with("packets") == in_packets)
            };
            let Some(base) = found(reference) else { continue };
            let difference =
                |column: &Column| found(column).map_or_else(|| "–".to_owned(), |found| differing(found, base));
            let cells: Vec<String> = others.iter().map(difference).collect();
            let distances = if base.distances > 0.0 { format!(" / {:.4}", base.distances) } else { String::new() };
            let base = format!("{} / {}{distances}", base.count, base.hits);
            let _ = writeln!(text, "| {scene} | {name} | {base} | {} |", cells.join(" | "));
        }
    }
    text
}

/// By how much something that was found differs. Rays that ask only whether there is a hit have no distances.
fn differing(found: Found, base: Found) -> String {
    let by = |value: u64, base: u64| value as i64 - base as i64;
    let counts = format!("{:+} / {:+}", by(found.count, base.count), by(found.hits, base.hits));
    if base.distances > 0.0 { format!("{counts} / {:+.4}", found.distances - base.distances) } else { counts }
}

fn builds(lines: &Lines, scenes: &[&str]) -> String {
    let mut text = "| scene | program | seconds | bytes a thing | with lists |\n|---|---|---:|---:|---:|\n".to_owned();
    for scene in scenes {
        let things = lines.things(scene).unwrap_or(1) as f64;
        for (who, build) in lines.builds(scene) {
            let variant = if who.variant.is_empty() { String::new() } else { format!(", {}", who.variant) };
            let (bytes, all) = (build.bytes / things, (build.bytes + build.list_bytes) / things);
            let _ =
                writeln!(text, "| {scene} | {}{variant} | {:.3} | {bytes:.1} | {all:.1} |", who.program, build.seconds);
        }
    }
    text + "\nLists are the corners and the triangles that they are joined to, where a program needs them beside its tree.\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    fn printed(program: &str, variant: &str, rate: f64, hits: u32) -> String {
        format!(
            r#"{{"program": "{program}", "variant": "{variant}", "scene": "soup", "measure": "scene", "count": 10, "hashes": ["1"]}}
{{"program": "{program}", "variant": "{variant}", "scene": "soup", "measure": "build", "seconds": 0.5, "bytes": 640, "list_bytes": 120}}
{{"program": "{program}", "variant": "{variant}", "scene": "soup", "measure": "rays", "rays": "bounce", "way": "single", "count": 100, "million_a_second": {rate}, "hits": {hits}, "distances": {hits}.5}}"#
        )
    }

    #[test]
    fn tables_have_ratios_differences_and_bytes() {
        let mut lines = Lines::default();
        lines.read(&printed("durer", "picture", 3.0, 7)).unwrap();
        lines.read(&printed("Embree", "medium", 2.0, 8)).unwrap();
        lines.read(&printed("Embree", "high", 4.0, 8)).unwrap();
        let table = rates(&lines, &["soup"], true);
        assert!(
            table.contains("| soup | bounce, closest | 3.00 | – | 2.00 | 4.00 | – | – | – | 1.50 | 0.75 | – |"),
            "{table}"
        );
        let table = findings(&lines, &["soup"], true);
        assert!(
            table.contains("| 100 / 8 / 8.5000 | +0 / -1 / -1.0000 | – | +0 / +0 / +0.0000 | – | – | – |"),
            "{table}"
        );
        let table = builds(&lines, &["soup"]);
        assert!(table.contains("| soup | Embree, medium | 0.500 | 64.0 | 76.0 |"), "{table}");
        let table = rates(&lines, &["soup"], false);
        assert!(table.contains("| soup | bounce, closest | 3.00 | – | – | – |\n"), "{table}");
    }
}

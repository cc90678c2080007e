//! Lists of numbers, often from files and by the million: the first entry that is wrong stands for all.

use super::Step;
use super::values::Checker;
use crate::{Data, Sizes};

/// A list of which no entry may have something wrong with it, as `wrong` says.
pub(super) fn each<T>(
    c: &mut Checker<'_>,
    name: &'static str,
    entries: &[T],
    wrong: impl Fn(&T) -> Option<String>,
) -> bool {
    match entries.iter().position(|entry| wrong(entry).is_some()) {
        None => true,
        Some(at) => {
            let message = wrong(&entries[at]).unwrap_or_default();
            entry(c, name, at, entries.len(), &message)
        }
    }
}

/// A problem with an entry; always false.
pub(super) fn entry(c: &mut Checker<'_>, name: &'static str, at: usize, of: usize, message: &str) -> bool {
    c.field(name, |c| c.at(Step::Index(at), |c| c.problem(format!("{message} (entry {} of {of})", at + 1))))
}

/// A list with an entry for each of `count` things, which are called `of`.
pub(super) fn length(c: &mut Checker<'_>, name: &'static str, found: usize, count: usize, of: &str) -> bool {
    let entries = if found == 1 { "1 entry".to_owned() } else { format!("{found} entries") };
    let things = match (count, of) {
        (1, "vertices") => "is 1 vertex".to_owned(),
        (1, of) => format!("is 1 {}", of.trim_end_matches('s')),
        _ => format!("are {count} {of}"),
    };
    c.require(found == count, name, format!("{name} has {entries}, but there {things}"))
}

/// One size for all of `count` things, or one for each.
pub(super) fn sizes(
    c: &mut Checker<'_>,
    name: &'static str,
    sizes: &Sizes,
    (count, of): (usize, &str),
    wrong: impl Fn(&str, f64) -> Option<String>,
) -> bool {
    match sizes {
        Sizes::Same(size) => wrong(name, *size).is_none_or(|message| c.require(false, name, message)),
        Sizes::Each(Data { values, .. }) => {
            length(c, name, values.len(), count, of) & each(c, name, values, |size| wrong(name, *size))
        }
    }
}

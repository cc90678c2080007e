//! The part of docs/performance.md that is measured.

use crate::shell;

/// The page.
pub(super) const PAGE: &str = "docs/performance.md";
/// The plot.
pub(super) const PLOT: &str = "docs/growth.svg";
/// The plot, as the page names it.
pub(super) const PLOT_BESIDE: &str = "growth.svg";

const BEGIN: &str = "<!-- What follows is written by `cargo xtask bench growth`. -->\n";
const END: &str = "<!-- What follows is written by hand. -->\n";

/// Puts a text between the two marks of the page.
pub(super) fn put(text: &str) -> Result<(), String> {
    let path = shell::root().join(PAGE);
    let page = std::fs::read_to_string(&path).map_err(|error| format!("{PAGE}: {error}"))?;
    shell::write(&path, with(&page, text).ok_or_else(|| format!("{PAGE}: the lines around the table are missing"))?)
}

fn with(page: &str, text: &str) -> Option<String> {
    let (before, rest) = page.split_once(BEGIN)?;
    let (_, after) = rest.split_once(END)?;
    Some(format!("{before}{BEGIN}\n{text}\n{END}{after}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_is_between_the_marks_changes() {
        let page = format!("a\n{BEGIN}old\n{END}b\n");
        assert_eq!(with(&page, "new\n").unwrap(), format!("a\n{BEGIN}\nnew\n\n{END}b\n"));
        assert_eq!(with("a\n", "new\n"), None);
    }

    #[test]
    fn the_page_has_its_marks() {
        let page = std::fs::read_to_string(shell::root().join(PAGE)).unwrap();
        assert!(with(&page, "").is_some());
    }
}

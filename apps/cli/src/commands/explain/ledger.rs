//! A page of text with a tree at the left and, for lines that add light, three columns of numbers at the right.

use crate::numbers::exact;
use durer::math::Rgb;

/// Where the numbers begin.
const TEXT_WIDTH: usize = 68;
/// Width of one column of numbers.
const NUMBER_WIDTH: usize = 14;
/// Beyond this many levels the tree is no longer indented further.
const LEVELS: usize = 8;

/// Lines, and the branches of the tree that pass the one being written.
#[derive(Default)]
pub(super) struct Ledger {
    text: String,
    branches: Vec<&'static str>,
}

impl Ledger {
    /// A line without numbers.
    pub(super) fn line(&mut self, text: &str) {
        let line = self.indentation() + text;
        self.text += line.trim_end();
        self.text.push('\n');
    }

    /// A line with an amount of light.
    pub(super) fn amount(&mut self, text: &str, amount: Rgb) {
        let mut line = self.indentation() + text;
        if line.chars().count() > TEXT_WIDTH {
            self.line(text);
            line = self.indentation();
        }
        let [r, g, b] = amount.to_array().map(exact);
        let padding = TEXT_WIDTH - line.chars().count().min(TEXT_WIDTH);
        let space = " ".repeat(padding);
        self.text += &format!("{line}{space}{r:>NUMBER_WIDTH$}{g:>NUMBER_WIDTH$}{b:>NUMBER_WIDTH$}\n");
    }

    /// A line with the titles of the columns.
    pub(super) fn heading(&mut self, text: &str) {
        let space = " ".repeat(TEXT_WIDTH.saturating_sub(text.chars().count()));
        self.text +=
            &format!("{text}{space}{:>NUMBER_WIDTH$}{:>NUMBER_WIDTH$}{:>NUMBER_WIDTH$}\n", "red", "green", "blue");
    }

    /// A rule above a sum.
    pub(super) fn rule(&mut self) {
        let line = format!("{:TEXT_WIDTH$}  {}", "", "─".repeat(3 * NUMBER_WIDTH - 2));
        self.text += &line;
        self.text.push('\n');
    }

    /// An empty line.
    pub(super) fn gap(&mut self) {
        self.text.push('\n');
    }

    /// Writes lines one level deeper, with this before each.
    pub(super) fn within(&mut self, branch: &'static str, write: impl FnOnce(&mut Ledger)) {
        self.branches.push(branch);
        write(self);
        self.branches.pop();
    }

    /// Writes a branch of the tree: its first line at the fork, the others behind it.
    pub(super) fn fork(&mut self, last: bool, write: impl FnOnce(&mut Ledger)) {
        let (fork, behind) = if last { ("└─ ", "   ") } else { ("├─ ", "│  ") };
        let start = self.text.len();
        self.branches.push(behind);
        let at = self.indentation().len() - behind.len();
        write(self);
        self.branches.pop();
        let first = start + at;
        if self.text.get(first..first + behind.len()) == Some(behind) {
            self.text.replace_range(first..first + behind.len(), fork);
        }
    }

    /// The text.
    pub(super) fn into_text(self) -> String {
        self.text
    }

    fn indentation(&self) -> String {
        let hidden = self.branches.len().saturating_sub(LEVELS);
        let mark = if hidden > 0 { "… " } else { "" };
        self.branches[hidden..].iter().fold(mark.to_owned(), |line, branch| line + branch)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_stand_in_columns() {
        let mut ledger = Ledger::default();
        ledger.within("│  ", |ledger| ledger.amount("fog", Rgb::new(0.1, 0.25, 1e-20)));
        ledger.amount(&"x".repeat(90), Rgb::WHITE);
        let text = ledger.into_text();
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines.len(), 3);
        for line in [lines[0], lines[2]] {
            assert_eq!(line.chars().count(), TEXT_WIDTH + 3 * NUMBER_WIDTH);
        }
        assert!(lines[0].starts_with("│  fog ") && lines[0].ends_with("0.1          0.25         1e-20"), "{text}");
    }
}

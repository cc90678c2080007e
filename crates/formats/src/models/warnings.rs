//! Warnings of one file: each said once, and not more than anyone would read.

use std::collections::BTreeSet;

/// Warnings beyond these are only counted.
const MOST: usize = 30;

/// What was left out or done only nearly.
#[derive(Clone, Debug, Default)]
pub(super) struct Warnings {
    list: Vec<String>,
    seen: BTreeSet<String>,
    omitted: usize,
}

impl Warnings {
    /// Adds a warning, unless it was said before.
    pub(super) fn add(&mut self, message: impl Into<String>) {
        let message = message.into();
        if self.seen.contains(&message) {
            return;
        }
        if self.list.len() == MOST {
            self.omitted += 1;
            return;
        }
        self.seen.insert(message.clone());
        self.list.push(message);
    }

    /// All of them.
    pub(super) fn into_list(mut self) -> Vec<String> {
        if self.omitted > 0 {
            self.list.push(format!("there are {} more warnings like these", self.omitted));
        }
        self.list
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_is_said_once_and_few_are_said() {
        let mut warnings = Warnings::default();
        for i in 0..100 {
            warnings.add(format!("no {}", i % 50));
        }
        let list = warnings.into_list();
        assert_eq!((list.len(), list[29].as_str()), (31, "no 29"));
        assert!(list[30].contains("more warnings"));
    }
}

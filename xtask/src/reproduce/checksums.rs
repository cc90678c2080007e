//! `scenes/checksums.toml`: what every scene must look like, to the last bit.

use super::{Fingerprints, LONGER_SIDE};
use crate::shell;
use durer::math::Fingerprint;
use std::collections::BTreeMap;

/// The file, from the root.
pub(super) const PATH: &str = "scenes/checksums.toml";

/// The fingerprints that films must have, by scene.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Checksums(pub(super) BTreeMap<String, Fingerprint>);

impl Checksums {
    /// What the file says.
    pub(super) fn read() -> Result<Checksums, String> {
        let text = std::fs::read_to_string(shell::root().join(PATH)).map_err(|error| format!("{PATH}: {error}"))?;
        Checksums::parse(&text)
    }

    fn parse(text: &str) -> Result<Checksums, String> {
        let entry = |line: &str| {
            let (name, digits) = line.strip_prefix('"')?.strip_suffix('"')?.split_once("\" = \"")?;
            Some((name.to_owned(), parse_fingerprint(digits)?))
        };
        let lines = text.lines().filter(|line| !line.is_empty() && !line.starts_with(['#', '[']));
        let entries = lines.map(|line| entry(line).ok_or_else(|| format!("{PATH}: cannot read `{line}`")));
        entries.collect::<Result<_, _>>().map(Checksums)
    }

    /// Writes the file.
    pub(super) fn write(&self) -> Result<(), String> {
        shell::write(&shell::root().join(PATH), self.text())
    }

    fn text(&self) -> String {
        let mut text = format!(
            "# What every scene must look like to the last bit, its longer side {LONGER_SIDE} pixels: the fingerprint of the \
             film.\n# Made by `cargo xtask reproduce --bless`; `cargo xtask reproduce` compares.\n\n[scenes]\n"
        );
        for (name, film) in &self.0 {
            text += &format!("\"{name}\" = \"{film}\"\n");
        }
        text
    }

    /// Fails unless these are the scenes that there are.
    pub(super) fn names_all(&self, scenes: &[String]) -> Result<(), String> {
        let unknown: Vec<&str> = scenes.iter().filter(|name| !self.0.contains_key(*name)).map(String::as_str).collect();
        let gone: Vec<&str> = self.0.keys().filter(|name| !scenes.contains(name)).map(String::as_str).collect();
        match (&unknown[..], &gone[..]) {
            ([], []) => Ok(()),
            _ => Err(format!(
                "{PATH} lacks [{}] and has [{}] beyond what there is: run `cargo xtask reproduce --bless`",
                unknown.join(", "),
                gone.join(", ")
            )),
        }
    }

    /// Fails if a film differs from what it must be, or is missing.
    pub(super) fn compare(&self, way: &str, films: &Fingerprints) -> Result<(), String> {
        let films: BTreeMap<&str, Fingerprint> = films.iter().map(|(name, film)| (name.as_str(), *film)).collect();
        let wrong = |(name, expected): (&String, &Fingerprint)| match films.get(name.as_str()) {
            Some(film) if film == expected => None,
            Some(film) => Some(format!("\n  {name}: {film} instead of {expected}")),
            None => Some(format!("\n  {name}: not rendered")),
        };
        let wrong: Vec<String> = self.0.iter().filter_map(wrong).collect();
        if wrong.is_empty() {
            println!("{way}: {} scenes, all as they must be", self.0.len());
            Ok(())
        } else {
            Err(format!("{way}: {} of {} scenes differ:{}", wrong.len(), self.0.len(), wrong.concat()))
        }
    }
}

/// A fingerprint from its 32 digits.
pub(super) fn parse_fingerprint(digits: &str) -> Option<Fingerprint> {
    let is_hex = digits.len() == 32 && digits.bytes().all(|byte| byte.is_ascii_hexdigit());
    is_hex.then(|| u128::from_str_radix(digits, 16).ok().map(Fingerprint)).flatten()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn some() -> Checksums {
        Checksums([("a.yaml", 1), ("b/c.yaml", u128::MAX)].map(|(name, n)| (name.to_owned(), Fingerprint(n))).into())
    }

    #[test]
    fn what_is_written_is_read() {
        assert_eq!(Checksums::parse(&some().text()), Ok(some()));
        assert!(Checksums::parse("\"a.yaml\" = \"12\"").is_err());
    }

    #[test]
    fn a_film_that_differs_or_is_missing_is_named() {
        let films =
            |second: u128| vec![("a.yaml".to_owned(), Fingerprint(1)), ("b/c.yaml".to_owned(), Fingerprint(second))];
        assert_eq!(some().compare("here", &films(u128::MAX)), Ok(()));
        let message = some().compare("here", &films(2)).unwrap_err();
        assert!(
            message.contains("1 of 2") && message.contains("b/c.yaml: 00000000000000000000000000000002"),
            "{message}"
        );
        assert!(some().compare("here", &films(2)[..1].to_vec()).unwrap_err().contains("b/c.yaml: not rendered"));
    }

    #[test]
    fn scenes_that_come_or_go_are_named() {
        let names = |all: &[&str]| all.iter().map(|&name| name.to_owned()).collect::<Vec<_>>();
        assert_eq!(some().names_all(&names(&["a.yaml", "b/c.yaml"])), Ok(()));
        assert!(some().names_all(&names(&["a.yaml"])).unwrap_err().contains("has [b/c.yaml]"));
        assert!(some().names_all(&names(&["a.yaml", "b/c.yaml", "d.yaml"])).unwrap_err().contains("lacks [d.yaml]"));
    }
}

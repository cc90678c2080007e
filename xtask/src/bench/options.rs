//! The options of benchmarks, such as `--rounds 5 --counts 1000,1000000`.

/// What was given.
#[derive(Debug)]
pub(crate) struct Options<'w> {
    given: Vec<(&'w str, &'w str)>,
}

impl<'w> Options<'w> {
    /// Pairs of an option that is known and its value.
    pub(crate) fn parse(words: &[&'w str], known: &[&str]) -> Result<Options<'w>, String> {
        let pair = |pair: &[&'w str]| match *pair {
            [option, value] if known.contains(&option) => Ok((option, value)),
            [option] if known.contains(&option) => Err(format!("{option}: a value is missing")),
            _ => Err(format!("unknown option `{}`: there are {}", pair[0], known.join(" and "))),
        };
        Ok(Options { given: words.chunks(2).map(pair).collect::<Result<_, _>>()? })
    }

    /// A number above 0.
    pub(crate) fn count(&self, option: &str, default: usize) -> Result<usize, String> {
        self.value(option).map_or(Ok(default), |value| above_zero(option, value))
    }

    /// Numbers above 0, with commas between them.
    pub(crate) fn counts(&self, option: &str, default: &[usize]) -> Result<Vec<usize>, String> {
        let listed = |value: &str| value.split(',').map(|value| above_zero(option, value)).collect();
        self.value(option).map_or(Ok(default.to_vec()), listed)
    }

    /// Some of the names that there are.
    pub(crate) fn names<'a>(&self, option: &str, all: &[&'a str]) -> Result<Vec<&'a str>, String> {
        let find = |name: &str| {
            let found = all.iter().copied().find(|known| *known == name);
            found.ok_or_else(|| format!("{option}: unknown `{name}`: there are {}", all.join(", ")))
        };
        self.value(option).map_or(Ok(all.to_vec()), |value| value.split(',').map(find).collect())
    }

    fn value(&self, option: &str) -> Option<&'w str> {
        self.given.iter().rev().find(|(given, _)| *given == option).map(|(_, value)| *value)
    }
}

fn above_zero(option: &str, value: &str) -> Result<usize, String> {
    let number = value.parse().ok().filter(|&number| number > 0);
    number.ok_or_else(|| format!("{option}: `{value}` is not a number above 0"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_are_read() {
        let options = Options::parse(&["--rounds", "3", "--counts", "1,20"], &["--rounds", "--counts"]).unwrap();
        assert_eq!(options.count("--rounds", 7), Ok(3));
        assert_eq!(options.counts("--counts", &[]), Ok(vec![1, 20]));
        assert_eq!(options.names("--scenes", &["a", "b"]), Ok(vec!["a", "b"]));
    }

    #[test]
    fn mistakes_are_told() {
        let wrong = |words: &[&'static str]| Options::parse(words, &["--rounds"]);
        assert!(wrong(&["--round", "3"]).unwrap_err().contains("unknown option `--round`"));
        assert!(wrong(&["--rounds"]).unwrap_err().contains("missing"));
        assert!(wrong(&["--rounds", "0"]).unwrap().count("--rounds", 1).unwrap_err().contains("above 0"));
        assert!(wrong(&["--rounds", "x"]).unwrap().names("--rounds", &["y"]).unwrap_err().contains("unknown `x`"));
    }
}

//! What the programs printed, gathered.

use crate::bench::report::median;
use serde_json::Value;
use std::collections::BTreeMap;

/// All that was printed, in the order in which it was.
#[derive(Debug, Default)]
pub(super) struct Lines {
    builds: Vec<(Who, Build)>,
    rays: Vec<(Who, Rays)>,
    /// The count of things and the hashes of each scene.
    scenes: BTreeMap<String, (usize, Value)>,
    /// As Embree counts: 40400 is 4.4.0.
    pub(super) embree_version: Option<u64>,
}

/// Which program measured which scene.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Who {
    pub(super) program: String,
    pub(super) variant: String,
    pub(super) scene: String,
}

/// The building of a tree.
#[derive(Clone, Copy, Debug)]
pub(super) struct Build {
    pub(super) seconds: f64,
    /// Bytes held.
    pub(super) bytes: f64,
    /// Bytes of lists that are needed beside.
    pub(super) list_bytes: f64,
}

/// Rays of one kind, sent in one way.
#[derive(Clone, Debug)]
pub(super) struct Rays {
    kind: String,
    way: String,
    million_a_second: f64,
    found: Found,
}

/// What rays found, the same in each round.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Found {
    pub(super) count: u64,
    pub(super) hits: u64,
    pub(super) distances: f64,
}

impl Lines {
    /// Adds what a program printed.
    pub(super) fn read(&mut self, printed: &str) -> Result<(), String> {
        printed.lines().try_for_each(|line| {
            let value: Value = serde_json::from_str(line).map_err(|error| format!("`{line}`: {error}"))?;
            self.add(&value).ok_or_else(|| format!("`{line}` is not understood"))?
        })
    }

    fn add(&mut self, line: &Value) -> Option<Result<(), String>> {
        let word = |name: &str| line[name].as_str().map(str::to_owned);
        let number = |name: &str| line[name].as_f64();
        let who = Who { program: word("program")?, variant: word("variant")?, scene: word("scene")? };
        match line["measure"].as_str()? {
            "scene" => return self.check(&who, line["count"].as_u64()? as usize, &line["hashes"]),
            "version" => self.embree_version = line["number"].as_u64(),
            "build" => {
                let (bytes, list_bytes) = (number("bytes")?, number("list_bytes")?);
                self.builds.push((who, Build { seconds: number("seconds")?, bytes, list_bytes }));
            }
            "rays" => {
                let (count, hits) = (line["count"].as_u64()?, line["hits"].as_u64()?);
                let found = Found { count, hits, distances: number("distances")? };
                let million_a_second = number("million_a_second")?;
                self.rays.push((who, Rays { kind: word("rays")?, way: word("way")?, million_a_second, found }));
            }
            _ => return None,
        }
        Some(Ok(()))
    }

    /// An error if another program has made another scene of this name.
    fn check(&mut self, who: &Who, count: usize, hashes: &Value) -> Option<Result<(), String>> {
        let known = self.scenes.entry(who.scene.clone()).or_insert_with(|| (count, hashes.clone()));
        if *known == (count, hashes.clone()) {
            return Some(Ok(()));
        }
        Some(Err(format!("{} has made another scene `{}`: {count} things, {hashes}", who.program, who.scene)))
    }

    /// How many things a scene has.
    pub(super) fn things(&self, scene: &str) -> Option<usize> {
        self.scenes.get(scene).map(|(count, _)| *count)
    }

    /// The median rate of a kind of rays by each variant and way that `wanted` says yes to; the best of them.
    pub(super) fn best_rate(&self, kind: &str, wanted: impl Fn(&Who, &str) -> bool) -> Option<f64> {
        let mut rates: Vec<((&str, &str), Vec<f64>)> = Vec::new();
        for (who, rays) in self.rays.iter().filter(|(who, rays)| rays.kind == kind && wanted(who, &rays.way)) {
            let key = (who.variant.as_str(), rays.way.as_str());
            match rates.iter_mut().find(|(known, _)| *known == key) {
                Some((_, values)) => values.push(rays.million_a_second),
                None => rates.push((key, vec![rays.million_a_second])),
            }
        }
        rates.into_iter().filter_map(|(_, values)| median(values)).reduce(f64::max)
    }

    /// What rays of a kind found, according to the first who is `wanted`.
    pub(super) fn found(&self, kind: &str, wanted: impl Fn(&Who, &str) -> bool) -> Option<Found> {
        let rays = self.rays.iter().find(|(who, rays)| rays.kind == kind && wanted(who, &rays.way));
        rays.map(|(_, rays)| rays.found)
    }

    /// Median build times on a scene, in the order in which programs ran.
    pub(super) fn builds(&self, scene: &str) -> Vec<(&Who, Build)> {
        let mut builds: Vec<(&Who, Build, Vec<f64>)> = Vec::new();
        for (who, build) in self.builds.iter().filter(|(who, _)| who.scene == scene) {
            match builds.iter_mut().find(|(known, ..)| *known == who) {
                Some((.., seconds)) => seconds.push(build.seconds),
                None => builds.push((who, *build, vec![build.seconds])),
            }
        }
        let with_median =
            |(who, build, seconds)| (who, Build { seconds: median(seconds).unwrap_or(f64::NAN), ..build });
        builds.into_iter().map(with_median).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rays(program: &str, way: &str, rate: f64) -> String {
        format!(
            r#"{{"program": "{program}", "variant": "", "scene": "soup", "measure": "rays", "rays": "primary", "way": "{way}", "count": 8, "million_a_second": {rate}, "hits": 3, "distances": 1.5}}"#
        )
    }

    #[test]
    fn the_better_median_counts() {
        let mut lines = Lines::default();
        for rate in [1.0, 5.0, 2.0] {
            lines.read(&rays("a", "packets", rate)).unwrap();
            lines.read(&rays("a", "packets, coherent", rate * 0.5)).unwrap();
            lines.read(&rays("b", "packets", 9.0)).unwrap();
        }
        let wanted = |who: &Who, _: &str| who.program == "a";
        assert_eq!(lines.best_rate("primary", wanted), Some(2.0));
        assert_eq!(lines.best_rate("shadow", wanted), None);
        assert_eq!(lines.found("primary", wanted), Some(Found { count: 8, hits: 3, distances: 1.5 }));
    }

    #[test]
    fn scenes_must_be_the_same() {
        let scene = |hash| {
            format!(
                r#"{{"program": "a", "variant": "", "scene": "soup", "measure": "scene", "count": 8, "hashes": ["{hash}"]}}"#
            )
        };
        let mut lines = Lines::default();
        lines.read(&format!("{}\n{}", scene("1"), scene("1"))).unwrap();
        assert_eq!(lines.things("soup"), Some(8));
        assert!(lines.read(&scene("2")).unwrap_err().contains("another scene"));
        assert!(lines.read("{}").unwrap_err().contains("not understood"));
    }
}

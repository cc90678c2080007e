//! What is not the same in two scenes, in words.

use durer::scene::{Integrator, PathSettings};
use durer::{SceneHash, SceneItem};

/// All of it.
pub(super) fn differences(before: &SceneHash, now: &SceneHash) -> String {
    in_words(before, now, |_| true)
}

/// The same, without what changes none of the samples, but only how many there are.
pub(crate) fn differences_of_samples(before: &SceneHash, now: &SceneHash) -> String {
    in_words(before, now, |item| item.changes_samples())
}

fn in_words(before: &SceneHash, now: &SceneHash, counts: fn(SceneItem<'_>) -> bool) -> String {
    let items = before.differences(now).into_iter().filter(|item| counts(*item));
    let words = items.flat_map(|item| match item {
        SceneItem::Scene => vec!["the scene".to_owned()],
        SceneItem::Setting("integrator") => of_integrators(before.integrator(), now.integrator()),
        SceneItem::Setting(name) => vec![format!("the setting `{name}`")],
        SceneItem::File(name) => vec![format!("`{name}`")],
    });
    words.collect::<Vec<_>>().join(", ")
}

/// Which of the settings that the integrator has, and both values.
fn of_integrators(before: Integrator, now: Integrator) -> Vec<String> {
    let word = now.word();
    if before.word() != word {
        return vec![format!("the setting `integrator` (`{word}` in place of `{}`)", before.word())];
    }
    let changed = settings(before).into_iter().zip(settings(now)).filter(|(before, now)| before != now);
    let words = changed
        .map(|((name, before), (_, now))| format!("the setting `{name}` of `{word}` ({now} in place of {before})"));
    let words: Vec<String> = words.collect();
    // Something is not the same, though a film that was tampered with does not say what.
    if words.is_empty() { vec!["the setting `integrator`".to_owned()] } else { words }
}

/// The settings of an integrator, by their names in scene files.
fn settings(integrator: Integrator) -> Vec<(&'static str, String)> {
    let none = || "none".to_owned();
    match integrator {
        Integrator::Path(PathSettings { max_depth, clamp, split, reuse }) => vec![
            ("max_depth", max_depth.to_string()),
            ("clamp", clamp.map_or_else(none, |clamp| clamp.to_string())),
            ("split", split.to_string()),
            ("reuse", reuse.to_string()),
        ],
        Integrator::AmbientOcclusion { distance } => {
            vec![("distance", distance.map_or_else(none, |distance| distance.to_string()))]
        }
        Integrator::Whitted | Integrator::Normals | Integrator::Depth | Integrator::Uv => Vec::new(),
    }
}

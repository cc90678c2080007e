//! Scenes at random render.

use durer_trials::scenes::{Temper, classic_scene, scene};
use durer_trials::{Dice, picture};

/// Renders scenes of this temper, one for each of so many seeds, and gives how many pass the check.
fn rendered(temper: Temper, seeds: u64) -> usize {
    let scenes = (0..seeds).filter_map(|seed| Some((seed, scene(&mut Dice::of_seed(seed), temper).check().ok()?)));
    let outcomes: Vec<_> = scenes.map(|(seed, scene)| (seed, picture(&scene))).collect();
    let wrong: Vec<_> = outcomes.iter().filter_map(|(seed, outcome)| Some((seed, outcome.as_ref().err()?))).collect();
    assert!(wrong.is_empty(), "{} of {} scenes: {wrong:#?}", wrong.len(), outcomes.len());
    outcomes.len()
}

#[test]
fn everyday_scenes_render() {
    assert!(rendered(Temper::Everyday, 300) > 280);
}

#[test]
fn extreme_scenes_render() {
    let rendered = rendered(Temper::Extreme, 2000);
    assert!(rendered > 1000, "only {rendered} pass the check");
}

/// Found among a hundred thousand others: vertex colors of triangles thinner than rounding, and rays that seemed to meet
/// boxes of nothing.
#[test]
fn scenes_that_were_wrong_once_render() {
    for seed in [11_574, 28_145, 46_025, 57_825] {
        let scene =
            classic_scene(&mut Dice::of_seed(seed), Temper::Extreme).check().expect("a scene that can be rendered");
        assert_eq!(picture(&scene).err(), None, "seed {seed}");
    }
}

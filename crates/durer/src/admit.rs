//! Whether a scene asks for more than it may, before anything is built of it.

use durer_formats::{Exceeded, Limit, Limits};
use durer_render::memory_needed;
use durer_scene::CheckedScene;

/// Finds out whether a scene keeps those limits that bound rendering: pixels, samples, primitives and memory. Loading has
/// kept those that bound files; the time is for the host to keep, by [`Progress::stop`](crate::Progress::stop).
///
/// ```
/// let limits = durer::Limits::untrusted();
/// let loaded = durer::load_str("picture: {width: 9000, height: 9000}", "found.yaml", &durer::NoAssets, &limits)?;
/// let exceeded = durer::admit(&loaded.scene, &limits).unwrap_err();
/// assert_eq!(exceeded[0].to_string(), "it asks for 81000000 pixels, but only 4000000 pixels are allowed");
/// # Ok::<(), durer::Diagnostics>(())
/// ```
///
/// # Errors
///
/// All limits that the scene exceeds.
pub fn admit(scene: &CheckedScene, limits: &Limits) -> Result<(), Vec<Exceeded>> {
    let scene = scene.scene();
    let asked = [
        (Limit::Pixels, scene.picture.pixels()),
        (Limit::Samples, scene.most_samples()),
        (Limit::Primitives, scene.primitives().total()),
        (Limit::Memory, memory_needed(scene)),
    ];
    let exceeded = asked.into_iter().filter_map(|(limit, asked)| {
        let allowed = limits.get(limit);
        (asked > allowed).then_some(Exceeded { limit, asked: Some(asked), allowed })
    });
    let exceeded: Vec<Exceeded> = exceeded.collect();
    if exceeded.is_empty() { Ok(()) } else { Err(exceeded) }
}

//! Settings from elsewhere than the file, such as a command line. They are laid over the file's before anything is checked, so
//! that what is checked is what will be rendered: neither does a setting that is replaced stand in the way, nor is a scene let
//! through that only the new ones make unusable.

use durer_scene::{Picture, Place, RenderSettings};

/// Settings that win over those of a file. `()` has none.
pub trait Overlay {
    /// Puts its settings in place of those of the file.
    fn lay_over(&self, picture: &mut Picture, render: &mut RenderSettings);

    /// What messages call the value at this place, such as `--width`, if it has come from here; `None` if it is the file's.
    /// `render` are the settings that have come of laying over.
    fn name_of(&self, place: &Place, render: &RenderSettings) -> Option<String>;
}

impl Overlay for () {
    fn lay_over(&self, _: &mut Picture, _: &mut RenderSettings) {}

    fn name_of(&self, _: &Place, _: &RenderSettings) -> Option<String> {
        None
    }
}

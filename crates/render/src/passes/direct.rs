//! Light that met one surface at most on its way to the eye, apart from the rest.

use crate::observer::{NotTraced, Observer, RayCounts, RayKind, Source};
use durer_geometry::Ray;
use durer_math::Rgb;

/// Counts rays, and adds up direct light.
#[derive(Default)]
pub(super) struct Direct {
    pub(super) rays: RayCounts,
    /// Of the last segment of the path.
    depth: u32,
    /// The direct light of the sample.
    pub(super) light: Rgb,
}

impl Observer for Direct {
    fn ray_begins(&mut self, kind: RayKind, depth: u32, ray: &Ray, weight: Rgb) {
        self.depth = depth;
        self.rays.ray_begins(kind, depth, ray, weight);
    }

    fn shadow_ray(&mut self) {
        self.rays.shadow_ray();
    }

    fn contribution(&mut self, source: Source, amount: Rgb) {
        if source.is_direct(self.depth) {
            self.light += amount;
        }
    }

    fn not_traced(&mut self, kind: RayKind, weight: Rgb, why: NotTraced) {
        self.rays.not_traced(kind, weight, why);
    }
}

//! From the particles of a scene to those of geometry.

use durer_geometry::{Particles, Plan};
use durer_scene::ParticleKind;

/// The particles as geometry knows them, in their object's space.
pub(super) fn build(particles: &durer_scene::Particles, plan: Plan) -> Particles {
    let count = particles.kind.len();
    match &particles.kind {
        ParticleKind::Spheres { centers, radii } => {
            Particles::spheres(count, plan, |index| (centers.values[index], radii.get(index)))
        }
        ParticleKind::Cylinders { bases, tops, radii, open } => Particles::frusta(count, *open, plan, |index| {
            ([bases.values[index], tops.values[index]], [radii.get(index); 2])
        }),
        ParticleKind::Cones { bases, tops, radii, top_radii, open } => Particles::frusta(count, *open, plan, |index| {
            ([bases.values[index], tops.values[index]], [radii.get(index), top_radii.get(index)])
        }),
        ParticleKind::Capsules { bases, tops, radii } => {
            Particles::capsules(count, plan, |index| ([bases.values[index], tops.values[index]], radii.get(index)))
        }
    }
}

/// True if they have an inside.
pub(super) fn are_closed(particles: &durer_scene::Particles) -> bool {
    match &particles.kind {
        ParticleKind::Spheres { .. } | ParticleKind::Capsules { .. } => true,
        ParticleKind::Cylinders { open, .. } | ParticleKind::Cones { open, .. } => !open,
    }
}

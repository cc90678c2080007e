//! Particles: usable places and sizes, and lists of one length.

use super::bounds::{are_apart, wrong_with_fraction, wrong_with_point, wrong_with_size, wrong_with_size_or_zero};
use super::lists::{each, entry, length, sizes};
use super::values::Checker;
use crate::{Data, ParticleKind, Particles};
use durer_math::DVec3;

pub(super) fn check(c: &mut Checker<'_>, particles: &Particles) {
    let count = particles.kind.len();
    if count > Particles::MOST {
        c.problem(format!("at most {} particles may be in one list", Particles::MOST));
    }
    let of = match &particles.kind {
        ParticleKind::Spheres { centers, radii } => {
            each(c, "centers", &centers.values, |point| wrong_with_point("centers", *point));
            sizes(c, "radius", radii, (count, "centers"), wrong_with_size);
            "centers"
        }
        ParticleKind::Cylinders { bases, tops, radii, open: _ } | ParticleKind::Capsules { bases, tops, radii } => {
            ends(c, bases, tops);
            sizes(c, "radius", radii, (count, "bases"), wrong_with_size);
            "bases"
        }
        ParticleKind::Cones { bases, tops, radii, top_radii, open: _ } => {
            ends(c, bases, tops);
            sizes(c, "radius", radii, (count, "bases"), wrong_with_size);
            sizes(c, "top_radius", top_radii, (count, "bases"), wrong_with_size_or_zero);
            "bases"
        }
    };
    if let Some(Data { values, .. }) = &particles.colors {
        length(c, "colors", values.len(), count, of);
        each(c, "colors", values, |color| wrong_with_fraction("colors", *color));
    }
}

fn ends(c: &mut Checker<'_>, bases: &Data<DVec3>, tops: &Data<DVec3>) {
    let (bases, tops) = (&bases.values, &tops.values);
    let fine = each(c, "bases", bases, |point| wrong_with_point("bases", *point))
        & each(c, "tops", tops, |point| wrong_with_point("tops", *point))
        & length(c, "tops", tops.len(), bases.len(), "bases");
    let together = bases.iter().zip(tops.iter()).position(|(base, top)| !are_apart(*base, *top));
    if let (true, Some(at)) = (fine, together) {
        entry(c, "tops", at, tops.len(), "a top must not be the same point as its base");
    }
}

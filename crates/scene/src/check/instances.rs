//! Instances: usable places, and not too many.

use super::Step;
use super::bounds::{wrong_with_factor, wrong_with_point};
use super::lists::{each, entry, length, sizes};
use super::objects::{DEEPEST, all, material};
use super::values::{Around, Checker};
use crate::{Data, Instances, Object, ObjectKind, Sizes};
use durer_math::{DAffine3, DVec3, rotation};

/// The most things that all instances together may place; particles in one set count as one.
const MOST_PLACED: u64 = 20_000_000;

pub(super) fn check(c: &mut Checker<'_>, instances: &Instances, around: Around, depth: usize) {
    let count = instances.positions.values.len();
    let places = self::places(c, &instances.positions, around);
    if let Some(Data { values, .. }) = &instances.rotations {
        length(c, "rotations", values.len(), count, "positions");
        let wrong = || Some("the angles of rotations must be at most 1e6 degrees".to_owned());
        each(
            c,
            "rotations",
            values,
            |turn| if turn.to_array().iter().all(|a| a.abs() <= 1e6) { None } else { wrong() },
        );
    }
    let scales = sizes(c, "scale", &instances.scales, (count, "positions"), wrong_with_factor);
    for (at, id) in instances.materials.iter().enumerate() {
        c.field("materials", |c| c.at(Step::Index(at), |c| material(c, Some(*id))));
    }
    let inside = if places && scales { inside(c, instances, around) } else { around };
    c.field("objects", |c| all(c, &instances.objects, inside, depth + 1));
}

/// The positions, in their own space and in the world.
fn places(c: &mut Checker<'_>, positions: &Data<DVec3>, around: Around) -> bool {
    let positions = &positions.values;
    if !each(c, "positions", positions, |point| wrong_with_point("positions", *point)) {
        return false;
    }
    let far = |point: &DVec3| wrong_with_point("positions", around.map.transform_point3(*point)).is_some();
    match positions.iter().position(far) {
        None => true,
        Some(at) => {
            let message = "positions, with the transforms around, are too far away";
            entry(c, "positions", at, positions.len(), message)
        }
    }
}

/// What the copied objects stand in.
fn inside(c: &mut Checker<'_>, instances: &Instances, around: Around) -> Around {
    let (least, most) = match &instances.scales {
        Sizes::Same(scale) => (*scale, *scale),
        Sizes::Each(data) => match data.values.split_first() {
            None => (1.0, 1.0),
            Some((first, others)) => {
                others.iter().fold((*first, *first), |(least, most), scale| (scale.min(least), scale.max(most)))
            }
        },
    };
    let first = |data: &Data<DVec3>| data.values.first().copied().unwrap_or_default();
    let turn = instances.rotations.as_ref().map_or(DVec3::ZERO, first);
    let about = |axis, degrees: f64| DAffine3::from_mat3(rotation(axis, degrees.to_radians()));
    let turned = about(DVec3::Z, turn.z) * about(DVec3::Y, turn.y) * about(DVec3::X, turn.x);
    let map = around.map * DAffine3::from_translation(first(&instances.positions)) * turned;
    let inside = Around { map, least: around.least * least, most: around.most * most };
    if inside.is_usable() {
        return inside;
    }
    let help = "together they may change no length by more than 1e9";
    c.field("scale", |c| c.problem_with_help("these sizes, with the transforms around, change lengths too much", help));
    around
}

/// That instances, and instances of instances, do not come to too many things.
pub(super) fn count(c: &mut Checker<'_>, objects: &[Object]) {
    let mut total = 0_u64;
    for (at, object) in objects.iter().enumerate() {
        total = total.saturating_add(placed(object, 0, 1));
        if total > MOST_PLACED {
            let message = format!("instances would place more than {} million things", MOST_PLACED / 1_000_000);
            c.at(Step::Index(at), |c| c.field(object.kind.word(), |c| c.problem(message)));
            return;
        }
    }
}

/// How many things instances place in an object; `alone` is 1 if the object itself is among those that are copied.
fn placed(object: &Object, alone: u64, depth: usize) -> u64 {
    let sum = |objects: &[Object], alone| {
        objects.iter().fold(0_u64, |sum, one| sum.saturating_add(placed(one, alone, depth + 1)))
    };
    match &object.kind {
        _ if depth > DEEPEST => 0,
        ObjectKind::Instances(copies) => sum(&copies.objects, 1).saturating_mul(copies.positions.values.len() as u64),
        ObjectKind::Group(members) => sum(members, alone),
        ObjectKind::Import(import) => sum(&import.objects, alone),
        ObjectKind::Solid(solid) => sum(&solid.operands, alone),
        ObjectKind::Shape(_) | ObjectKind::Mesh(_) | ObjectKind::Particles(_) => alone,
    }
}

//! The tree's choices against their probabilities, and against what they are made for.

use super::*;
use durer_math::functions::sin;

/// Numbers from 0 to 1 in no order.
fn number(seed: u32, index: u32) -> f64 {
    let mixed = sin(f64::from(seed) * 12.9898 + f64::from(index) * 78.233) * 43_758.545;
    mixed - mixed.floor()
}

fn vector(seed: u32, index: u32) -> DVec3 {
    DVec3::new(number(seed, index), number(seed + 1, index), number(seed + 2, index)) * 2.0 - 1.0
}

/// Emitters of all kinds, in no order.
fn items(count: u32) -> Vec<Item> {
    let item = |id: u32| {
        let (middle, size) = (vector(1, id) * 10.0, 0.3 * number(5, id));
        let axis = vector(7, id).normalize();
        let cone = match id % 6 {
            0 => Cone::of(axis, Faces::Front),
            1 => Cone::of(axis, Faces::Both),
            2 => Cone::ALL,
            3 => Cone::of_spot(axis, 0.95, 0.8),
            4 => Cone::of_spot(axis, 1.0, -0.9),
            _ => Cone { axis, cosine: 0.5, spread: 0.0, faces: Faces::Closed },
        };
        Item::new(&Bounds { min: middle, max: middle }.widened(size), 0.01 + number(11, id), cone, id)
    };
    (0..count).filter_map(item).collect()
}

fn receivers() -> impl Iterator<Item = Receiver> {
    (0..40).map(|index| Receiver {
        point: vector(21, index) * if index % 3 == 0 { 30.0 } else { 8.0 },
        normal: vector(24, index).normalize(),
        passes: index % 5 == 0,
    })
}

#[test]
fn probabilities_are_those_of_choices_and_sum_to_one() {
    for count in [1, 2, 3, 10, 300] {
        let tree = LightTree::build(items(count), count as usize);
        for receiver in receivers() {
            let mut chosen = vec![0_u32; count as usize];
            const TRIES: u32 = 20_000;
            let mut none = 0;
            for index in 0..TRIES {
                let Some((id, probability)) = tree.sample(&receiver, (f64::from(index) + 0.5) / f64::from(TRIES))
                else {
                    none += 1;
                    continue;
                };
                let again = tree.probability(&receiver, id);
                assert!((probability / again - 1.0).abs() < 1e-9, "{probability} is not {again}");
                chosen[id as usize] += 1;
            }
            assert!(none == 0 || none == TRIES || count > 3, "dead ends: {none}");
            let probabilities: Vec<f64> = (0..count).map(|id| tree.probability(&receiver, id)).collect();
            let sum: f64 = probabilities.iter().sum::<f64>() + f64::from(none) / f64::from(TRIES);
            assert!((sum - 1.0).abs() < 1e-3, "{sum} in all, of {count}");
            for (id, (&times, probability)) in chosen.iter().zip(probabilities).enumerate() {
                let found = f64::from(times) / f64::from(TRIES);
                assert!((found - probability).abs() < 2e-3, "{id}: {found}, not {probability}");
            }
        }
    }
}

/// What gives light to a receiver is never left out: not even what faces away but for a little, or lies mostly behind.
#[test]
fn who_gives_light_has_a_chance() {
    let all = items(400);
    let tree = LightTree::build(all.clone(), 400);
    for receiver in receivers() {
        for item in &all {
            let (min, max) = (DVec3::from(item.min.map(f64::from)), DVec3::from(item.max.map(f64::from)));
            for corner in 0..8 {
                let pick = |axis: usize| if corner >> axis & 1 == 0 { min[axis] } else { max[axis] };
                let way = DVec3::new(pick(0), pick(1), pick(2)) - receiver.point;
                let facing = way.dot(receiver.normal);
                let shines = match item.cone.faces {
                    _ if item.cone.cosine < 0.0 => true,
                    // A spot, up to its outer angle.
                    Faces::Front if item.cone.spread > 0.0 => -way.dot(item.cone.axis) > 0.801 * way.length(),
                    Faces::Front => -way.dot(item.cone.axis) > 1e-3 * way.length(),
                    Faces::Both | Faces::Closed => true,
                };
                if shines && (facing > 1e-3 || receiver.passes) {
                    assert!(tree.probability(&receiver, item.id) > 0.0, "{item:?} has no chance at {receiver:?}");
                }
            }
        }
    }
}

/// Of two equal lamps the one at a third of the distance is chosen nine times as often; none behind, none that faces away.
#[test]
fn choices_go_by_distance_and_by_sides() {
    let at =
        |middle: DVec3, cone: Cone, id: u32| Item::new(&Bounds { min: middle, max: middle }, 1.0, cone, id).unwrap();
    let receiver = Receiver { point: DVec3::ZERO, normal: DVec3::Y, passes: false };
    let near = |found: f64, expected: f64| assert!((found - expected).abs() < 0.01, "{found}, not {expected}");

    let lamps = vec![at(DVec3::Y, Cone::ALL, 0), at(DVec3::Y * 3.0, Cone::ALL, 1)];
    near(LightTree::build(lamps, 2).probability(&receiver, 0), 0.9);
    let lamps = vec![at(DVec3::Y, Cone::ALL, 0), at(DVec3::NEG_Y, Cone::ALL, 1)];
    near(LightTree::build(lamps, 2).probability(&receiver, 0), 1.0);
    let down = Cone::of(DVec3::NEG_Y, Faces::Front);
    let faces = |other: Faces| vec![at(DVec3::Y, down, 0), at(DVec3::Y, Cone::of(DVec3::Y, other), 1)];
    near(LightTree::build(faces(Faces::Front), 2).probability(&receiver, 0), 1.0);
    near(LightTree::build(faces(Faces::Both), 2).probability(&receiver, 0), 0.5);
}

/// A spot is not chosen where it does not shine, nor are many of them that shine elsewhere; all along its cone it is.
#[test]
fn spots_are_chosen_where_they_shine() {
    let at = |middle: DVec3, axis: DVec3, id: u32| {
        let cone = Cone::of_spot(axis.normalize(), 0.97, 0.94);
        Item::new(&Bounds { min: middle, max: middle }, 1.0, cone, id).unwrap()
    };
    // At every whole x, one that shines down and one that shines up, all at height 1.
    let lamps: Vec<Item> = (0..40)
        .map(|id| at(DVec3::new(f64::from(id / 2), 1.0, 0.0), DVec3::Y * f64::from(2 * (id % 2) as i32 - 1), id))
        .collect();
    let tree = LightTree::build(lamps, 40);
    for x in 0..20_u32 {
        let receiver = |aside: f64| Receiver {
            point: DVec3::new(f64::from(x) + aside, 0.0, 0.0),
            normal: DVec3::Y,
            passes: false,
        };
        let below = tree.probability(&receiver(0.1), 2 * x);
        // By distance alone it would be 0.16. What is left goes to the other half, in whose midst the receiver is.
        assert!(below > 0.35, "right below the lamp at {x}, where no other shines: {below}");
        // The cosine 0.94 is that of a slope of 0.363.
        assert!(tree.probability(&receiver(0.36), 2 * x) > 0.2);
        assert_eq!(tree.probability(&receiver(0.1), 2 * x + 1), 0.0);
    }
}

/// However many there are, and wherever: in one place, or in places that get closer and closer.
#[test]
fn trees_of_nasty_sets_are_sound() {
    let point =
        |x: f64, id: u32| Item::new(&Bounds { min: DVec3::X * x, max: DVec3::X * x }, 1.0, Cone::ALL, id).unwrap();
    let same: Vec<Item> = (0..1000).map(|id| point(1.0, id)).collect();
    let mut place = 1e17;
    let closer = (0..1000).map(|id| {
        place *= 0.8;
        point(place, id)
    });
    for items in [same, closer.collect(), Vec::new()] {
        let count = items.len() as u32;
        let tree = LightTree::build(items, count as usize);
        let receiver = Receiver { point: DVec3::Y, normal: DVec3::Y, passes: true };
        let sum: f64 = (0..count).map(|id| tree.probability(&receiver, id)).sum();
        assert!(count == 0 || (sum - 1.0).abs() < 1e-6, "{sum}");
    }
    assert!(Item::new(&Bounds { min: DVec3::NEG_INFINITY, max: DVec3::ONE }, 1.0, Cone::ALL, 0).is_none());
    assert!(Item::new(&Bounds { min: DVec3::ZERO, max: DVec3::ONE }, f64::NAN, Cone::ALL, 0).is_none());
}

/// A node takes 48 bytes, and a tree two of them for each emitter.
#[test]
fn trees_are_small_and_the_same_on_any_number_of_threads() {
    assert_eq!(size_of::<Node>(), 48);
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| LightTree::build(items(20_000), 20_000))
    };
    let (one, three) = (on(1), on(3));
    assert_eq!(one.nodes.len(), 2 * 20_000 - 1);
    assert_eq!(format!("{:?}", one.nodes), format!("{:?}", three.nodes));
}

/// A cone around two contains both.
#[test]
fn unions_of_cones_contain_both() {
    for index in 0..2000 {
        let cone = |seed: u32| Cone {
            axis: vector(seed, index).normalize(),
            cosine: if index % 7 == 0 { 1.0 } else { 2.0 * number(seed + 3, index) - 1.0 },
            spread: number(seed + 4, index),
            faces: Faces::Front,
        };
        let (a, b) = (cone(31), cone(41));
        let both = a.union(b);
        for one in [a, b] {
            assert!(both.spread <= one.spread);
            let direction = (vector(51, index) * 0.5 + one.axis).normalize();
            if direction.dot(one.axis) >= one.cosine {
                assert!(direction.dot(both.axis) >= both.cosine - 1e-12, "{one:?} in {both:?}");
            }
            assert!(one.axis.dot(both.axis) >= both.cosine - 1e-12);
        }
    }
}

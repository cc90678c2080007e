use super::*;
use durer_math::functions::{cos, sin};

/// A matrix of a rotation, so that nothing lies along an axis.
fn tilt(p: [f64; 2]) -> DVec3 {
    let [a, b] = [DVec3::new(2.0, -1.0, 2.0) / 3.0, DVec3::new(2.0, 2.0, -1.0) / 3.0];
    a * p[0] + b * p[1] + DVec3::new(5.0, -3.0, 11.0)
}

fn cut(corners: &[DVec3]) -> Vec<[usize; 3]> {
    let mut triangles = Vec::new();
    Triangulator::new(0).cut(corners, |triangle| triangles.push(triangle));
    triangles
}

fn double_area(corners: &[DVec3], [a, b, c]: [usize; 3]) -> DVec3 {
    (corners[b] - corners[a]).cross(corners[c] - corners[a])
}

/// Sizes of triangles add up to that of the polygon only if none overlap and none lie outside; so do their vector areas
/// whatever happens. The shoelace formula gives both in the plane.
#[track_caller]
fn assert_covers(flat: &[[f64; 2]]) {
    let shoelace: f64 = (0..flat.len())
        .map(|i| {
            let ([ax, ay], [bx, by]) = (flat[i], flat[(i + 1) % flat.len()]);
            ax * by - bx * ay
        })
        .sum();
    let backwards: Vec<[f64; 2]> = flat.iter().rev().copied().collect();
    let mirrored: Vec<[f64; 2]> = flat.iter().map(|[x, y]| [-x, *y]).collect();
    for (flat, sign) in [(flat, 1.0), (&backwards, -1.0), (&mirrored, -1.0)] {
        // All ways to turn it, and each corner first.
        for start in 0..flat.len().min(12) {
            let turned: Vec<[f64; 2]> = (0..flat.len()).map(|i| flat[(i + start) % flat.len()]).collect();
            for corners in [
                turned.iter().map(|p| tilt(*p)).collect::<Vec<DVec3>>(),
                turned.iter().map(|[x, y]| DVec3::new(*x, *y, 0.0)).collect(),
                turned.iter().map(|[x, y]| DVec3::new(7.0, *x, *y)).collect(),
                turned.iter().map(|[x, y]| DVec3::new(*y, -1.0, *x)).collect(),
            ] {
                let triangles = cut(&corners);
                assert_eq!(triangles.len(), flat.len() - 2);
                let sum = triangles.iter().map(|t| double_area(&corners, *t)).fold(DVec3::ZERO, |a, b| a + b);
                let sizes: f64 = triangles.iter().map(|t| double_area(&corners, *t).length()).sum();
                let tolerance = 1e-9 * shoelace.abs().max(1.0);
                assert!(
                    (sizes - shoelace.abs()).abs() < tolerance,
                    "{sizes}, not {shoelace}: {triangles:?} of {flat:?}"
                );
                assert!((sum.length() - shoelace.abs()).abs() < tolerance, "{sum}: {triangles:?}");
                let normal = newell(&corners);
                assert!(triangles.iter().all(|t| double_area(&corners, *t).dot(normal) >= -tolerance), "{sign}");
            }
        }
    }
}

#[test]
fn simple_polygons_are_covered_once() {
    let arrow = [[0.0, 0.0], [2.0, 1.0], [0.0, 2.0], [0.5, 1.0]];
    let chevron = [[0.0, 0.0], [1.0, 2.0], [2.0, 0.0], [2.0, 1.0], [1.0, 3.0], [0.0, 1.0]];
    let letter_e = [
        [0.0, 0.0],
        [3.0, 0.0],
        [3.0, 1.0],
        [1.0, 1.0],
        [1.0, 2.0],
        [3.0, 2.0],
        [3.0, 3.0],
        [1.0, 3.0],
        [1.0, 4.0],
        [3.0, 4.0],
        [3.0, 5.0],
        [0.0, 5.0],
    ];
    assert_covers(&[[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [0.0, 1.0]]);
    assert_covers(&arrow);
    assert_covers(&chevron);
    assert_covers(&letter_e);
    let star: Vec<[f64; 2]> = (0..22)
        .map(|i| {
            let (angle, radius) = (f64::from(i) * std::f64::consts::TAU / 22.0, if i % 2 == 0 { 3.0 } else { 0.4 });
            [radius * cos(angle), radius * sin(angle)]
        })
        .collect();
    assert_covers(&star);
}

#[test]
fn corners_on_one_line_and_in_one_place_do_no_harm() {
    assert_covers(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 2.0]]);
    assert_covers(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 1.0], [2.0, 2.0], [1.0, 2.0], [0.0, 2.0], [0.0, 1.0]]);
    assert_covers(&[[0.0, 0.0], [0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [2.0, 2.0], [2.0, 2.0], [1.0, 0.5]]);
    // A way out and back, and one inwards.
    assert_covers(&[[0.0, 0.0], [2.0, 0.0], [3.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]]);
    assert_covers(&[[0.0, 0.0], [4.0, 0.0], [4.0, 2.0], [2.0, 2.0], [2.0, 1.0], [2.0, 2.0], [0.0, 2.0]]);
}

#[test]
fn straight_corners_make_no_flat_triangles_where_they_need_not() {
    let square = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0], [0.0, 1.0]];
    let corners: Vec<DVec3> = square.iter().map(|p| tilt(*p)).collect();
    assert!(cut(&corners).iter().all(|t| double_area(&corners, *t).length() > 0.5));
}

#[test]
fn holes_reached_by_a_cut_stay_open() {
    // Outside counter-clockwise, the hole clockwise.
    let frame = [
        [0.0, 0.0],
        [5.0, 0.0],
        [5.0, 5.0],
        [0.0, 5.0],
        [0.0, 0.0],
        [1.0, 1.0],
        [1.0, 4.0],
        [4.0, 4.0],
        [4.0, 1.0],
        [1.0, 1.0],
    ];
    assert_covers(&frame);
    let two_holes = [
        [0.0, 0.0],
        [9.0, 0.0],
        [9.0, 4.0],
        [8.0, 3.0],
        [8.0, 1.0],
        [6.0, 1.0],
        [6.0, 3.0],
        [8.0, 3.0],
        [9.0, 4.0],
        [0.0, 4.0],
        [1.0, 3.0],
        [3.0, 3.0],
        [3.0, 1.0],
        [1.0, 1.0],
        [1.0, 3.0],
        [0.0, 4.0],
    ];
    assert_covers(&two_holes);
    // A hole that touches the outside.
    assert_covers(&[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0], [0.0, 0.0], [1.0, 2.0], [2.0, 1.0]]);
}

#[test]
fn random_star_shapes_are_covered_once() {
    let mut random = 7_u64;
    let mut next = move || {
        random ^= random << 13;
        random ^= random >> 7;
        random ^= random << 17;
        (random >> 11) as f64 / (1_u64 << 53) as f64
    };
    for count in 5..60 {
        // Radii by chance, on a coarse grid at times, so that corners come to lie on lines.
        let coarse = count % 3 == 0;
        let corners: Vec<[f64; 2]> = (0..count)
            .map(|i| {
                let angle = f64::from(i) * std::f64::consts::TAU / f64::from(count);
                let radius = if coarse { 1.0 + (next() * 3.0).floor() } else { 0.05 + next() };
                [radius * cos(angle), radius * sin(angle)]
            })
            .collect();
        assert_covers(&corners);
    }
}

#[test]
fn skylines_are_covered_once() {
    // Everything happens here: corners in one place, on one line, and houses of no height, where top and ground touch.
    let mut random = 11_u64;
    for count in 2..40 {
        let mut corners = Vec::new();
        for i in (0..count).rev() {
            random ^= random << 13;
            random ^= random >> 7;
            random ^= random << 17;
            let height = (random % 4) as f64;
            corners.extend([[f64::from(i) + 1.0, height], [f64::from(i), height]]);
        }
        corners.extend((0..=count).map(|i| [f64::from(i), 0.0]));
        assert_covers(&corners);
    }
}

#[test]
fn large_polygons_take_little_time() {
    // A comb: half of its corners are in the way of others.
    let teeth = 20_000;
    let mut comb: Vec<DVec3> = (0..teeth)
        .flat_map(|i| {
            let x = f64::from(i);
            [[x, 0.0], [x + 0.4, 9.0]]
        })
        .map(|[x, y]| DVec3::new(x, y, 0.0))
        .collect();
    comb.extend([DVec3::new(f64::from(teeth), -5.0, 0.0), DVec3::new(-1.0, -5.0, 0.0)]);
    comb.reverse();
    let mut triangulator = Triangulator::new(0);
    let mut sizes = 0.0;
    let patience = triangulator.patience;
    triangulator.cut(&comb, |t| sizes += double_area(&comb, t).length());
    let used = patience - triangulator.patience;
    assert!((sizes / newell(&comb).length() - 1.0).abs() < 1e-9);
    assert!(used < patience / 5, "{used} steps");
}

#[test]
fn a_crossed_polygon_takes_no_more_than_its_share_of_time() {
    let mut random = 3_u64;
    let corners: Vec<DVec3> = (0..3000)
        .map(|_| {
            random ^= random << 13;
            random ^= random >> 7;
            random ^= random << 17;
            DVec3::new((random & 1023) as f64, (random >> 20 & 1023) as f64, 0.0)
        })
        .collect();
    let mut triangulator = Triangulator { patience: 2_000_000, ..Triangulator::new(0) };
    for _ in 0..50 {
        let mut count = 0;
        triangulator.cut(&corners, |_| count += 1);
        assert_eq!(count, 2998);
    }
    assert!(triangulator.patience == 0 && triangulator.rushed > 40);
}

#[test]
fn nothing_to_cut() {
    assert!(cut(&[]).is_empty() && cut(&[DVec3::X; 2]).is_empty());
    assert_eq!(cut(&[DVec3::X; 7]).len(), 5);
    let line: Vec<DVec3> = (0..6).map(|i| DVec3::X * f64::from(i)).collect();
    assert_eq!(cut(&line).len(), 4);
}

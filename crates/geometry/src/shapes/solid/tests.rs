//! Closed forms, membership asked point by point, and what must stay true however operands touch.

use super::super::testing::{Known, Random};
use super::build::MOST_TOGETHER;
use super::*;
use durer_math::{DAffine3, DMat3, rotation};
use std::f64::consts::PI;

mod exact;
mod random;
mod touching;

const HERE: DAffine3 = DAffine3::IDENTITY;

fn vec(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}

fn ball(center: DVec3, radius: f64) -> Operand {
    Operand::Shape(Primitive::sphere(center, radius, &HERE))
}

fn block(min: DVec3, max: DVec3) -> Operand {
    Operand::Shape(Primitive::cuboid(min, max, &HERE))
}

fn rod(base: DVec3, top: DVec3, radius: f64) -> Operand {
    Operand::Shape(Primitive::cylinder(base, top, radius, false, &HERE))
}

fn half_space(point: DVec3, normal: DVec3) -> Operand {
    Operand::Shape(Primitive::plane(point, normal, &HERE))
}

fn union(operands: impl Into<Vec<Operand>>) -> Operand {
    Operand::Combined(Operation::Union, operands.into())
}

fn intersection(operands: impl Into<Vec<Operand>>) -> Operand {
    Operand::Combined(Operation::Intersection, operands.into())
}

fn difference(operands: impl Into<Vec<Operand>>) -> Operand {
    Operand::Combined(Operation::Difference, operands.into())
}

fn solid(operand: Operand) -> Primitive {
    Primitive::solid(operand, &HERE)
}

/// Whether the ray starts inside, and all crossings in order.
fn crossings(primitive: &Primitive, ray: &Ray) -> (bool, Vec<Crossing>) {
    let mut all = Vec::new();
    let starts_inside = primitive.crossings(ray, &mut |crossing| all.push(crossing));
    all.sort_by(|a, b| a.t.total_cmp(&b.t));
    (starts_inside, all)
}

/// The same of a solid, whose nearest crossing must be the first of all.
fn follow(solid: &Primitive, ray: &Ray) -> (bool, Vec<Crossing>) {
    let (starts_inside, all) = crossings(solid, ray);
    assert_eq!(solid.intersect(ray, f64::INFINITY), all.first().copied(), "{ray:?}");
    (starts_inside, all)
}

fn times(primitive: &Primitive, ray: &Ray) -> Vec<f64> {
    follow(primitive, ray).1.into_iter().map(|crossing| crossing.t).collect()
}

fn near(a: &[f64], b: &[f64], tolerance: f64) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() <= tolerance)
}

/// A ray from somewhere around a thing of size `reach` at `center` to a point of it; one in four exactly in a symmetric
/// position.
fn ray_at(center: DVec3, reach: f64, random: &mut Random) -> Ray {
    let mut lattice = || (random.in_cube() * 4.0).round() * 0.5;
    let (from, to) = (lattice() * 2.0, lattice());
    let symmetric = random.between(0.0, 4.0) < 1.0 && from != to;
    let (from, to) =
        if symmetric { (from, to) } else { (random.direction() * random.between(0.0, 6.0), random.in_cube()) };
    Ray { origin: center + from * reach, direction: (to - from).normalize() }
}

/// Membership, by the definition.
fn is_in(operand: &Operand, point: DVec3) -> bool {
    match operand {
        Operand::Shape(primitive) => primitive.contains(point),
        Operand::Combined(Operation::Union, operands) => operands.iter().any(|operand| is_in(operand, point)),
        Operand::Combined(Operation::Intersection, operands) => operands.iter().all(|operand| is_in(operand, point)),
        Operand::Combined(Operation::Difference, operands) => {
            is_in(&operands[0], point) && !operands[1..].iter().any(|operand| is_in(operand, point))
        }
    }
}

/// All shapes in an operand.
fn shapes(operand: &Operand) -> Vec<&Primitive> {
    match operand {
        Operand::Shape(primitive) => vec![primitive],
        Operand::Combined(_, operands) => operands.iter().flat_map(shapes).collect(),
    }
}

/// A map that turns, stretches unevenly, now and then mirrors, and moves.
fn random_map(random: &mut Random) -> DAffine3 {
    let mut stretch = || random.between(0.4, 1.6) * if random.between(0.0, 1.0) < 0.3 { -1.0 } else { 1.0 };
    let stretch = DMat3::from_diagonal(vec(stretch(), stretch(), stretch()));
    let turn = rotation(random.direction(), random.between(0.0, 6.0));
    DAffine3::from_mat3_translation(turn * stretch, random.in_cube())
}

fn random_shape(map: &DAffine3, random: &mut Random) -> Primitive {
    let (low, high) = (vec(0.0, -0.5, 0.0), vec(0.0, 0.5, 0.0));
    match random.between(0.0, 7.0) as u32 {
        0 => Primitive::sphere(DVec3::ZERO, 0.7, map),
        1 => Primitive::cuboid(DVec3::splat(-0.5), DVec3::splat(0.5), map),
        2 => Primitive::cylinder(low, high, 0.5, false, map),
        3 => Primitive::cone(low, high, [0.7, 0.0], false, map),
        4 => Primitive::cone(low, high, [0.3, 0.6], false, map),
        5 => Primitive::torus(DVec3::ZERO, DVec3::Y, [0.6, 0.25], map),
        _ => Primitive::plane(DVec3::ZERO, DVec3::Y, map),
    }
}

fn random_operand(depth: u32, random: &mut Random) -> Operand {
    if depth == 0 || random.between(0.0, 1.0) < 0.2 {
        let map = random_map(random);
        return Operand::Shape(random_shape(&map, random));
    }
    let count = random.between(1.0, 5.0) as usize;
    let operands: Vec<Operand> = (0..count).map(|_| random_operand(depth - 1, random)).collect();
    match random.between(0.0, 3.0) as u32 {
        0 => union(operands),
        1 => intersection(operands),
        _ => difference(operands),
    }
}

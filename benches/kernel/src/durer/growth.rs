//! How building and tracing grow with the number of things.

use crate::kernel::{Lists, packets_closest, wide};
use durer_bench_kernel::measure::{self, Found, Run};
use durer_bench_kernel::meshes;
use durer_bench_kernel::random::Random;
use durer_bench_kernel::rays::{INTO_CUBE, OVER_TERRAIN, Ray, View, bounce};
use durer_bench_kernel::scene::PICTURE;
use durer_bench_kernel::vector::Vector;
use durer_geometry::{BuildFor, Mesh, Particles, Primitive, World};
use durer_math::functions::cbrt;
use durer_math::{DAffine3, DMat3, DVec3, rotation};
use std::f64::consts::TAU;
use std::sync::Arc;

/// Squares along each edge of the six faces of the thing that is copied: 768 triangles.
const ROCK: usize = 8;

/// Measures so many things of a kind, and prints one line.
pub(crate) fn measure(kind: &str, count: usize, repeats: usize) -> Result<(), String> {
    match kind {
        "triangles" => {
            // Two triangles for each square.
            let side = (count as f64 / 2.0).sqrt().round().max(1.0) as usize + 1;
            let lists = Arc::new(Lists(meshes::terrain(side)));
            let triangles = lists.0.triangles.len();
            report(kind, triangles, repeats, OVER_TERRAIN, || {
                let mesh = Mesh::build(Arc::clone(&lists) as _, BuildFor::Picture);
                let bytes = mesh.memory();
                (vec![Primitive::mesh(Arc::new(mesh), DVec3::ZERO, &DAffine3::IDENTITY)], bytes)
            });
        }
        "spheres" => {
            let spheres = balls(count);
            report(kind, count, repeats, INTO_CUBE, || {
                let particles = Particles::spheres(count, BuildFor::Picture, |index| spheres[index]);
                let bytes = particles.memory();
                (vec![Primitive::particles(Arc::new(particles), &DAffine3::IDENTITY)], bytes)
            });
        }
        "instances" => {
            let (places, rock) = (places(count), Arc::new(Mesh::build(Arc::new(Lists(meshes::cave(ROCK))), BuildFor::Picture)));
            report(kind, count, repeats, INTO_CUBE, || {
                let copy = |place| Primitive::mesh(Arc::clone(&rock), DVec3::ZERO, place);
                (places.iter().map(copy).collect(), rock.memory())
            });
        }
        _ => return Err(format!("unknown kind `{kind}`: there are triangles, spheres and instances")),
    }
    Ok(())
}

/// Balls in the unit cube, so large that rays go about equally far between any number of them.
fn balls(count: usize) -> Vec<(DVec3, f64)> {
    let scale = cbrt(1e6 / count as f64);
    let ball = |[x, y, z, radius]: [f32; 4]| (DVec3::new(x.into(), y.into(), z.into()), f64::from(radius) * scale);
    meshes::spheres(count).into_iter().map(ball).collect()
}

/// Where copies lie: as the balls, each turned at random.
fn places(count: usize) -> Vec<DAffine3> {
    let mut random = Random(44);
    let place = |(center, radius): (DVec3, f64)| {
        let turn = rotation(DVec3::from(random.direction().0), TAU * random.unit());
        DAffine3::from_mat3_translation(turn * DMat3::from_diagonal(DVec3::splat(radius)), center)
    };
    balls(count).into_iter().map(place).collect()
}

/// Builds a world of primitives, given with the bytes that they share, and sends rays into it.
fn report(kind: &str, count: usize, repeats: usize, view: View, make: impl Fn() -> (Vec<Primitive>, usize)) {
    let (seconds, (world, shared)) = measure::build(repeats, || {
        let (primitives, shared) = make();
        (World::build(primitives, BuildFor::Picture), shared)
    });
    let bytes = world.memory() + shared;
    let primary = view.primary(PICTURE);
    let bounced = bounced(&world, &primary);
    let rate = |rays: &[Ray], trace: &dyn Fn(&[Ray]) -> Found| {
        let run = measure::median_of(repeats, || Some(trace(rays)));
        run.map_or(0.0, |Run { seconds, .. }| rays.len() as f64 / seconds * 1e-6)
    };
    println!(
        "{{\"kind\": \"{kind}\", \"count\": {count}, \"build_seconds\": {seconds}, \"bytes\": {bytes}, \
         \"primary\": {}, \"packets\": {}, \"bounce\": {}, \"bounced\": {}}}",
        rate(&primary, &|rays| closest(&world, rays)),
        rate(&primary, &|rays| packets_closest(&world, rays)),
        rate(&bounced, &|rays| closest(&world, rays)),
        bounced.len(),
    );
}

fn closest(world: &World, rays: &[Ray]) -> Found {
    let mut found = Found::default();
    for ray in rays {
        if let Some(hit) = world.closest_hit(&wide(ray), f64::INFINITY, u32::MAX, None) {
            found.hits += 1;
            found.sum += hit.crossing.t;
        }
    }
    found
}

/// A random ray from each place where one of these hits.
fn bounced(world: &World, rays: &[Ray]) -> Vec<Ray> {
    let of = |(index, ray): (usize, &Ray)| {
        let ray = wide(ray);
        let surface = world.surface(&ray, &world.closest_hit(&ray, f64::INFINITY, u32::MAX, None)?);
        let normal = if surface.normal.dot(ray.direction) > 0.0 { -surface.normal } else { surface.normal };
        Some(bounce(index, (Vector(surface.point.to_array()), Vector(normal.to_array()))))
    };
    rays.iter().enumerate().filter_map(of).collect()
}

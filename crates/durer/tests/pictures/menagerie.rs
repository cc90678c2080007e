//! One of everything in one scene: it is the same however it is rendered, and explained as it was rendered.

use crate::objects::{ball, copies, cube, instances, mesh, moved, part, particles, with, with_material};
use crate::support::{compile, explained, scene};
use durer::math::{DVec3, Rgb};
use durer::scene::{
    Antialias, Data, Instances, MaterialId, MeshData, Object, ObjectKind, Operation, ParticleKind, Scene, Sizes, Solid,
    TransformStep,
};
use durer::{CompiledScene, Film, Region, RenderOptions};

const TEXT: &str = "
camera: {position: [0.3, 2.5, 7], look_at: [0, 0.3, 0], fov: 45}
render: {light_samples: 2}
fog: {exponential: {color: lightgray, distance: 40}}
lights: [point: {position: [4, 6, 5]}, directional: {direction: [1, -2, -1], intensity: 0.4}]
materials:
  gold: {color: gold, specular: 0.6, reflection: 0.3}
  glass: {transparency: 0.9, ior: 1.5, fresnel: true, attenuation: {color: [0.6, 0.9, 0.8], distance: 1}}
  lamp: {color: white, emission: [0.5, 0.4, 0.1]}
  net: {color: navy, opacity: {checker: {size: 0.25, colors: [1, 0.2]}}}
  holes: {color: seagreen, opacity: {checker: {size: 0.3, colors: [1, 0]}}, reflection: 0.2}
  striped: {color: {stripes: {width: 0.2, axis: [1, 2, 0], colors: [white, tomato]}}}
objects:
  - plane: {point: [0, -1, 0], material: {color: {checker: {}}}}
  - sphere: {center: [-2, 0, -1], material: net}
  - cylinder: {base: [2, -1, -2], top: [2, 1, -2], radius: 0.6, open: true, material: holes}
  - sphere: {center: [0, 2, -1], radius: 0.4, material: glass}
";

fn at(object: Object, x: f64, y: f64, z: f64) -> Object {
    let turn = TransformStep::Rotate { axis: DVec3::new(1.0, 2.0, 0.5), degrees: 40.0 };
    let small = TransformStep::Scale(DVec3::new(0.6, 0.5, 0.6));
    moved(object, vec![small, turn, TransformStep::Translate(DVec3::new(x, y, z))])
}

fn bonds() -> ParticleKind {
    let bases = Data::inline(vec![DVec3::new(-3.0, 0.0, 0.0), DVec3::new(-3.0, 1.0, -1.0)]);
    let tops = Data::inline(vec![DVec3::new(-2.0, -0.5, 1.5), DVec3::new(0.0, 2.5, -2.0)]);
    ParticleKind::Capsules { bases, tops, radii: Sizes::Same(0.15) }
}

/// Some of which overlap.
fn bubbles() -> ParticleKind {
    let centers =
        (0..12).map(|i| DVec3::new(f64::from(i) * 0.35 - 2.0, 0.1 * f64::from(i % 3), 2.5)).collect::<Vec<_>>();
    ParticleKind::Spheres { centers: Data::inline(centers), radii: Sizes::Same(0.2) }
}

/// A ball of glass with a bite of gold.
fn lens() -> Object {
    let text = "objects: [box: {min: [-1, -1, -1], max: [0.4, 1, 1]}, sphere: {radius: 0.9}]";
    let [block, ball] = scene(text).objects.try_into().expect("two objects");
    let operands = vec![with_material(ball, 1), with_material(block, 0)];
    Object::new(ObjectKind::Solid(Solid { operation: Operation::Difference, operands }))
}

/// One of everything.
pub(crate) fn menagerie() -> Scene {
    let smooth = ball(12);
    let colored = MeshData {
        colors: smooth.positions.iter().map(|&[x, y, z]| Rgb::new(x, y, z).map(|c| 0.5 + 0.5 * c)).collect(),
        ..smooth.clone()
    };
    let die = cube([-1.0; 3], [1.0; 3]);
    let parts = vec![part(0, 4, Some(0)), part(4, 2, Some(1)), part(8, 3, Some(4))];
    let striped = with_material(mesh(colored.clone()), 5);
    let small = moved(striped, vec![TransformStep::Scale(DVec3::splat(0.2))]);
    let row = (0..8).map(|i| DVec3::new(f64::from(i) * 0.6 - 2.0, -0.7, 1.5)).collect();
    let row = Instances { materials: vec![MaterialId(5), MaterialId(1), MaterialId(4)], ..copies(vec![small], row) };
    let objects = [
        at(mesh(MeshData { parts, ..die.clone() }), -1.0, 0.2, 0.5),
        at(with_material(mesh(die), 1), 0.4, 0.0, 1.0),
        at(with_material(mesh(smooth), 1), 1.6, 0.1, 0.8),
        at(mesh(colored), 0.0, 1.0, -2.0),
        at(with_material(mesh(ball(6)), 2), -2.4, 1.5, -1.0),
        instances(row),
        with_material(particles(bonds(), Some(vec![Rgb::new(0.9, 0.8, 0.3), Rgb::new(0.2, 0.3, 0.9)])), 0),
        with_material(particles(bubbles(), None), 1),
        at(lens(), 2.4, 1.2, 0.2),
    ];
    with(scene(TEXT), objects)
}

fn small(antialias: Antialias) -> CompiledScene {
    let mut scene = menagerie();
    scene.render.antialias = antialias;
    (scene.picture.width, scene.picture.height) = (60, 45);
    compile(scene)
}

fn rendered(scene: &CompiledScene, threads: usize, region: Option<Region>) -> Film {
    durer::render(scene, &RenderOptions { threads: Some(threads), region, ..Default::default() }, &())
        .expect("a picture")
}

#[test]
fn explanations_add_up_to_the_picture() {
    for antialias in [Antialias::None, Antialias::Recursive { threshold: 0.2, max_depth: 1 }] {
        let scene = small(antialias);
        let image = rendered(&scene, 2, None).develop();
        let (mut holes, mut triangles) = (0, 0);
        for pixel in explained(&scene) {
            let rendered = image.pixel(pixel.x, pixel.y);
            assert_eq!((pixel.color, pixel.sum()), (rendered, rendered), "({}, {})", pixel.x, pixel.y);
            for sample in &pixel.samples {
                holes += sample.ray.holes.len();
                let element = sample.ray.hit.map(|hit| hit.element);
                triangles += usize::from(matches!(element, Some(durer::Element::Triangle { .. })));
            }
        }
        assert!(holes > 20 && triangles > 200, "{holes} holes, {triangles} triangles");
    }
}

#[test]
fn threads_and_regions_change_nothing() {
    let scene = small(Antialias::Grid { n: 2 });
    let one = rendered(&scene, 1, None);
    for threads in [2, 5] {
        assert!(rendered(&scene, threads, None) == one, "{threads} threads");
    }
    let compiled_by_three = durer::with_threads(Some(3), || small(Antialias::Grid { n: 2 })).expect("three threads");
    assert!(rendered(&compiled_by_three, 2, None) == one, "compiled by three threads");
    let whole = one.develop();
    let region = Region { x: 13, y: 7, width: 40, height: 35 };
    let part = rendered(&scene, 2, Some(region)).develop();
    for y in 0..35 {
        for x in 0..40 {
            assert_eq!(part.pixel(x, y), whole.pixel(13 + x, 7 + y));
        }
    }
}

#[test]
fn a_map_of_what_it_takes_is_the_same_for_all_threads_and_regions() {
    let scene = small(Antialias::Grid { n: 2 });
    let map = |threads, region| {
        durer::heatmap(&scene, &RenderOptions { threads: Some(threads), region, ..Default::default() }, &())
            .expect("a map")
    };
    let whole = map(1, None);
    assert!(map(3, None) == whole);
    assert_eq!(whole.nodes.len(), 60 * 45);
    let part = map(2, Some(Region { x: 59, y: 3, width: 1, height: 42 }));
    let column: Vec<u32> = (3..45).map(|y| whole.primitives[y * 60 + 59]).collect();
    assert_eq!(part.primitives, column);
    assert!(whole.primitives.iter().zip(&whole.nodes).all(|(primitives, _)| *primitives >= 4), "the plane, by fours");
}

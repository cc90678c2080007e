//! A mesh answers as its triangles do, tested one by one, at every instruction set, for rays alone and in packets.

use super::*;
use crate::SimdLevel;
use crate::shapes::testing::Random;

#[derive(Debug)]
struct Lists {
    positions: Vec<[f32; 3]>,
    triangles: Vec<[u32; 3]>,
}

impl MeshSource for Lists {
    fn positions(&self) -> &[[f32; 3]] {
        &self.positions
    }
    fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }
    fn normals(&self) -> &[[f32; 3]] {
        &[]
    }
    fn uvs(&self) -> &[[f32; 2]] {
        &[]
    }
    /// The tests ask about insides only where there are some.
    fn enclosed_volume(&self) -> Option<f64> {
        let corner = |vertex: u32| wide(self.positions[vertex as usize]);
        let sixfold = |&[a, b, c]: &[u32; 3]| corner(a).dot(corner(b).cross(corner(c)));
        Some(self.triangles.iter().map(sixfold).sum::<f64>() / 6.0)
    }
}

fn narrow(v: DVec3) -> [f32; 3] {
    v.to_array().map(|x| x as f32)
}

/// Loose triangles of all sizes, among them needles, points, and each fifth one twice.
fn soup(random: &mut Random, count: usize) -> Lists {
    let mut lists = Lists { positions: Vec::new(), triangles: Vec::new() };
    for i in 0..count {
        let first = lists.positions.len() as u32;
        let (center, size) = (random.in_cube(), random.power(-4.0, 0.0));
        let corner = |random: &mut Random| narrow(center + random.in_cube() * size);
        match i % 7 {
            0 => lists.positions.extend([narrow(center); 3]),
            1 => {
                let (a, b) = (corner(random), corner(random));
                lists.positions.extend([a, b, b.map(|x| x * (1.0 + f32::EPSILON))]);
            }
            _ => lists.positions.extend([corner(random), corner(random), corner(random)]),
        }
        lists.triangles.push([first, first + 1, first + 2]);
        if i % 5 == 0 {
            lists.triangles.push([first, first + 1, first + 2]);
        }
    }
    lists
}

/// A ball of triangles, dented so that it is not convex.
fn ball(rings: usize) -> Lists {
    let mut lists = Lists { positions: Vec::new(), triangles: Vec::new() };
    let columns = 2 * rings;
    for ring in 0..=rings {
        for column in 0..columns {
            let (a, b) = (ring as f64 / rings as f64 * 3.2 - 1.6, column as f64 * 0.77);
            // Any closed surface will do: the poles are where whole rings share a point.
            let wide = if ring == 0 || ring == rings { 0.0 } else { 1.0 - a * a / 3.0 };
            let angle = column as f64 / columns as f64 * std::f64::consts::TAU;
            let radius = wide * (1.0 + 0.2 * durer_math::functions::sin(b * 5.0));
            let (x, z) = (durer_math::functions::cos(angle), durer_math::functions::sin(angle));
            lists.positions.push(narrow(DVec3::new(x * radius, a, z * radius)));
        }
    }
    for ring in 0..rings {
        for column in 0..columns {
            let at = |ring: usize, column: usize| (ring * columns + column % columns) as u32;
            let (a, b) = (at(ring, column), at(ring, column + 1));
            let (c, d) = (at(ring + 1, column), at(ring + 1, column + 1));
            lists.triangles.extend([[a, c, b], [b, c, d]]);
        }
    }
    lists
}

fn by_hand(mesh: &Mesh, ray: &Ray, t_max: f64) -> Option<Crossing> {
    let mut best: Option<Crossing> = None;
    for part in 0..mesh.source.triangles().len() as u32 {
        if let Some(crossing) = mesh.triangle(part).intersect(ray, t_max)
            && best.is_none_or(|best| crossing.t < best.t)
        {
            best = Some(Crossing { t: crossing.t, part });
        }
    }
    best
}

/// Rays of all kinds: through the middle of things, at corners, along axes.
fn some_ray(random: &mut Random, mesh: &Mesh) -> Ray {
    let origin = random.in_cube() * random.between(0.0, 3.0);
    let positions = mesh.source.positions();
    let corner = wide(positions[random.between(0.0, positions.len() as f64) as usize]);
    let direction = match random.between(0.0, 4.0) as u32 {
        0 => corner - origin,
        1 => DVec3::AXES[random.between(0.0, 3.0) as usize],
        _ => random.direction(),
    };
    Ray { origin, direction }
}

#[test]
fn the_nearest_triangle_is_that_of_testing_all() {
    let mut random = Random(21);
    for count in [1, 2, 5, 9, 40, 700] {
        let lists: Arc<dyn MeshSource> = Arc::new(soup(&mut random, count));
        let built = |plan: Plan| Mesh::build(Arc::clone(&lists), plan);
        let of_levels = SimdLevel::available().into_iter().map(|level| built(level.into()));
        let of_purposes = [BuildFor::Preview, BuildFor::ManyRays].into_iter().map(|purpose| built(purpose.into()));
        let meshes: Vec<Mesh> = of_levels.chain(of_purposes).collect();
        for _ in 0..400 {
            let ray = some_ray(&mut random, &meshes[0]);
            let t_max = if random.between(0.0, 1.0) < 0.3 { random.between(0.1, 2.0) } else { f64::INFINITY };
            let expected = by_hand(&meshes[0], &ray, t_max);
            for mesh in &meshes {
                assert_eq!(mesh.intersect(&ray, t_max), expected);
                assert_eq!(mesh.meets(&ray, t_max), expected.is_some());
            }
        }
    }
}

#[test]
fn rays_in_a_packet_hit_what_they_hit_alone() {
    let mut random = Random(22);
    for count in [3, 60, 3000] {
        let lists: Arc<dyn MeshSource> = Arc::new(soup(&mut random, count));
        for level in SimdLevel::available() {
            let mesh = Mesh::build(Arc::clone(&lists), level.into());
            for _ in 0..300 {
                let first = some_ray(&mut random, &mesh);
                let spread = random.power(-4.0, 0.5);
                let near = |random: &mut Random| Ray {
                    origin: first.origin + random.in_cube() * (spread * 0.1),
                    direction: first.direction + random.in_cube() * spread,
                };
                let rays: Vec<Ray> = (0..1 + random.between(0.0, 8.0) as usize).map(|_| near(&mut random)).collect();
                let packet = Packet::new(&rays);
                let t_max = random.between(0.5, 4.0);
                let mut hits = PacketHits::before(t_max);
                mesh.intersect_packet(&packet, &mut hits);
                let met = mesh.meets_packet(&packet, &[t_max; LANES]);
                for (lane, ray) in rays.iter().enumerate() {
                    let alone = mesh.intersect(ray, t_max);
                    let part = hits.part[lane];
                    let together = (part >= 0.0).then_some(Crossing { t: hits.t[lane], part: part as u32 });
                    assert_eq!(together, alone);
                    assert_eq!(met >> lane & 1 == 1, alone.is_some());
                }
                assert_eq!(met >> rays.len(), 0);
            }
        }
    }
}

#[test]
fn no_ray_leaves_a_closed_mesh() {
    let mut random = Random(23);
    let mesh = Mesh::build(Arc::new(ball(24)), Plan::default());
    assert!(mesh.is_closed());
    for _ in 0..100_000 {
        let corner = |random: &mut Random| {
            let positions = mesh.source.positions();
            wide(positions[random.between(0.0, positions.len() as f64) as usize])
        };
        let origin = random.in_cube() * 0.2;
        // At a corner, or along the line between two, which crosses edges at their ends more often than chance would.
        let target = corner(&mut random);
        let ray = Ray { origin, direction: target - origin };
        assert!(mesh.intersect(&ray, f64::INFINITY).is_some(), "{ray:?} leaves");
    }
}

#[test]
fn inside_is_inside() {
    let mut random = Random(24);
    let mesh = Mesh::build(Arc::new(ball(16)), Plan::default());
    let mut inside = 0;
    for _ in 0..3000 {
        let point = random.in_cube() * 1.5;
        // The parity of crossings in another direction.
        let (mut ray, mut crossings) = (Ray { origin: point, direction: DVec3::new(-0.3, 0.1, 0.9) }, 0);
        while let Some(crossing) = mesh.intersect(&ray, f64::INFINITY) {
            ray.origin = ray.at(crossing.t + 1e-9);
            crossings += 1;
        }
        assert_eq!(mesh.contains(point), crossings % 2 == 1, "{point}");
        inside += u32::from(crossings % 2 == 1);
    }
    assert!((500..2500).contains(&inside));
}

#[test]
fn the_tree_is_the_same_for_any_number_of_threads() {
    let lists: Arc<dyn MeshSource> = Arc::new(soup(&mut Random(25), 60_000));
    let built: Vec<Mesh> = [1, 2, 5]
        .map(|threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
            pool.install(|| Mesh::build(Arc::clone(&lists), Plan::default()))
        })
        .into();
    for mesh in &built[1..] {
        assert!(mesh.bvh == built[0].bvh && mesh.blocks == built[0].blocks);
    }
}

#[test]
fn equal_centers_make_no_endless_tree() {
    let positions = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let mesh = Mesh::build(Arc::new(Lists { positions, triangles: vec![[0, 1, 2]; 5000] }), Plan::default());
    let ray = Ray { origin: DVec3::new(0.2, 0.2, 1.0), direction: DVec3::NEG_Z };
    assert_eq!(mesh.intersect(&ray, 2.0), Some(Crossing { t: 1.0, part: 0 }));
}

/// A flat square of triangles whose corners have whole coordinates, seen along its normal.
fn tiles(half: i32) -> Lists {
    let row = 2 * half + 1;
    let positions = (0..row * row).map(|i| [(i % row - half) as f32, (i / row - half) as f32, 2.0]).collect();
    let corner = |x: i32, y: i32| (y * row + x) as u32;
    let tile = |x: i32, y: i32| {
        let [a, b, c, d] = [corner(x, y), corner(x + 1, y), corner(x, y + 1), corner(x + 1, y + 1)];
        [[a, b, c], [c, b, d]]
    };
    let triangles = (0..2 * half).flat_map(|y| (0..2 * half).flat_map(move |x| tile(x, y))).collect();
    Lists { positions, triangles }
}

#[test]
fn rays_in_the_planes_between_boxes_meet_the_edges_there() {
    let lists: Arc<dyn MeshSource> = Arc::new(tiles(20));
    for level in SimdLevel::available() {
        let mesh = Mesh::build(Arc::clone(&lists), level.into());
        for (x, y) in (-19..20).flat_map(|x| (-19..20).map(move |y| (f64::from(x), f64::from(y)))) {
            for (sign, distance) in [(1.0, 2.0), (-1.0, 7.0)] {
                let origin = DVec3::new(x, y, if sign > 0.0 { 0.0 } else { 9.0 });
                for aside in [0.0, -0.0, 0.5] {
                    let ray = Ray { origin: origin + DVec3::X * aside, direction: DVec3::new(aside * 0.0, 0.0, sign) };
                    assert_eq!(mesh.intersect(&ray, 1e9).map(|hit| hit.t), Some(distance), "{ray:?}");
                    assert!(mesh.meets(&ray, 1e9), "{ray:?}");
                    let mut hits = PacketHits { t: [1e9; LANES], part: [-1.0; LANES] };
                    let packet = Packet::new(&[ray; 5]);
                    mesh.intersect_packet(&packet, &mut hits);
                    assert_eq!(hits.t[..5], [distance; 5], "{ray:?}");
                    assert_eq!(mesh.meets_packet(&packet, &[1e9; LANES]), 0b11111, "{ray:?}");
                }
            }
        }
    }
}

/// Cubes of triangles, each from its least to its greatest corner.
fn cubes(of: &[[f32; 2]]) -> Lists {
    let mut lists = Lists { positions: Vec::new(), triangles: Vec::new() };
    for &[low, high] in of {
        let first = lists.positions.len() as u32;
        lists
            .positions
            .extend((0..8).map(|corner| [0, 1, 2].map(|axis| if corner >> axis & 1 == 0 { low } else { high })));
        let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let halves = faces.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
        lists.triangles.extend(halves.map(|triangle| triangle.map(|corner| first + corner)));
    }
    lists
}

fn inside_out(lists: Lists) -> Lists {
    Lists { triangles: lists.triangles.iter().map(|&[a, b, c]| [a, c, b]).collect(), ..lists }
}

fn crossings_of(mesh: &Mesh, ray: &Ray) -> (bool, Vec<f64>) {
    let mut found = Vec::new();
    let starts_inside = mesh.crossings(ray, &mut |crossing| found.push(crossing.t));
    (starts_inside, found)
}

#[test]
fn bodies_of_one_mesh_that_overlap_are_one_whichever_way_they_face() {
    for lists in [cubes(&[[-1.0, 1.0], [0.0, 2.0]]), inside_out(cubes(&[[-1.0, 1.0], [0.0, 2.0]]))] {
        let mesh = Mesh::build(Arc::new(lists), Plan::default());
        assert!(mesh.is_closed());
        // Off the edges, along diagonals of faces, and through corners.
        for (origin, expected) in [
            (DVec3::new(-5.0, 0.5, 0.25), vec![4.0, 7.0]),
            (DVec3::new(-5.0, 0.5, 0.5), vec![4.0, 7.0]),
            (DVec3::new(-5.0, 1.0, 1.0), vec![5.0, 7.0]),
            (DVec3::new(-5.0, -0.5, -0.5), vec![4.0, 6.0]),
        ] {
            let ray = Ray { origin, direction: DVec3::X };
            assert_eq!(crossings_of(&mesh, &ray), (false, expected.clone()), "{ray:?}");
            let back = Ray { origin: origin + DVec3::X * 10.0, direction: DVec3::NEG_X };
            let expected: Vec<f64> = expected.iter().rev().map(|t| 10.0 - t).collect();
            assert_eq!(crossings_of(&mesh, &back).1.len(), expected.len(), "{back:?}");
        }
        let (surface, normal) = (DVec3::new(-1.0, 0.5, 0.25), DVec3::NEG_X);
        let hit = mesh.intersect(&Ray { origin: DVec3::new(-5.0, 0.5, 0.25), direction: DVec3::X }, 9.0);
        assert_eq!(hit.map(|hit| mesh.surface(surface, hit.part).1), Some(normal), "normals point outward");
        let mut random = Random(41);
        for _ in 0..2_000 {
            let point = random.in_cube() * 2.5;
            let within = |low: f64, high: f64| point.min_element() > low && point.max_element() < high;
            assert_eq!(mesh.contains(point), within(-1.0, 1.0) || within(0.0, 2.0), "{point}");
        }
    }
}

#[test]
fn rays_through_edges_and_corners_go_in_and_out_in_turn() {
    let lists = ball(12);
    let corners: Vec<DVec3> = lists.positions.iter().map(|&position| wide(position)).collect();
    let edges: Vec<[u32; 2]> = lists.triangles.iter().map(|&[a, b, _]| [a, b]).collect();
    let mesh = Mesh::build(Arc::new(lists), Plan::default());
    let mut random = Random(42);
    let mut met = 0;
    for i in 0..20_000 {
        let [a, b] = edges[i % edges.len()].map(|vertex| corners[vertex as usize]);
        let target = if i % 2 == 0 { a } else { (a + b) * 0.5 };
        let origin = if i % 3 == 0 { random.in_cube() * 0.05 } else { random.direction() * 6.0 };
        let ray = Ray { origin, direction: target - origin };
        let (starts_inside, found) = crossings_of(&mesh, &ray);
        assert_eq!(starts_inside, i % 3 == 0, "{ray:?}");
        assert_eq!(found.len() % 2 == 1, starts_inside, "{ray:?}: {found:?}");
        assert!(found.is_sorted());
        met += found.len();
    }
    assert!(met > 20_000, "the test must test something: {met}");
}

#[test]
fn blocks_know_how_many_triangles_they_have() {
    for count in 1..=4 {
        let block = Triangles::new((0..count).map(|id| (7 + id, [[id as f32; 3]; 3])));
        assert_eq!(block.count(), count as usize);
        assert_eq!(block.ids[..count as usize], [7, 8, 9, 10][..count as usize]);
    }
}

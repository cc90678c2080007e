//! What `explain` tells of a path adds up to the pixel, and what it tells of paths that are reused is what the theory says.

use crate::support::load;
use durer::math::Rgb;
use durer::{
    CompiledScene, HitExplanation, JunctionExplanation, PixelExplanation, RayExplanation, RayKind, RelativeTo,
    RenderOptions, ReuseExplanation, Sharing, Way,
};
use std::collections::BTreeMap;
use std::f64::consts::PI;

#[test]
fn paths_add_up_to_the_pixel_to_the_last_bit() {
    adds_up("path");
    adds_up("{path: {split: 3}}");
    for reused in ["reuse: 4", "reuse: 16", "reuse: 64", "reuse: 16, split: 2", "reuse: 16, clamp: 0.1"] {
        adds_up(&format!("{{path: {{{reused}}}}}"));
    }
}

fn adds_up(integrator: &str) {
    let text = "
        picture: {width: 9, height: 6}
        render: {integrator: INTEGRATOR, samples: 5, filter: mitchell}
        background: [0.2, 0.3, 0.4]
        objects:
          - plane: {material: {matte: {color: 0.5}}}
          - sphere: {center: [0, 1, 0], material: {glass: {ior: 1.5}}}
          - sphere: {center: [2, 3, 1], radius: 0.5, material: {matte: {color: black, emission: 9}}}";
    let scene = durer::compile(&load(&text.replace("INTEGRATOR", integrator)));
    let film = durer::render(&scene, &RenderOptions::default(), &()).unwrap();
    for y in 0..6 {
        for x in 0..9 {
            let explained = durer::explain(&scene, x, y).unwrap();
            let bits = |color: Rgb| color.to_array().map(f32::to_bits);
            assert_eq!(explained.samples.len(), 5);
            assert_eq!(bits(explained.color), bits(film.pixels()[(y * 9 + x) as usize]), "{x},{y}");
            assert_eq!(bits(explained.sum()), bits(explained.color), "{x},{y}");
        }
    }
}

const WIDTH: u32 = 8;
const SAMPLES: usize = 6;

/// 8 × 8 pixels of a scene.
fn scene(path: &str, rest: &str) -> CompiledScene {
    durer::compile(&load(&format!(
        "picture: {{width: {WIDTH}, height: {WIDTH}}}\n\
         render: {{integrator: {{path: {{max_depth: 6, {path}}}}}, samples: {SAMPLES}}}\n\
         background: black\nlights: []\n{rest}"
    )))
}

/// From inside of a ball of radius 2 that glows.
const BALL: &str = "camera: {position: [0.3, 0, 0], look_at: [0, 0.2, -1]}\n\
    objects: [sphere: {radius: 2, material: {matte: {color: 0.8, emission: 1}}}]\n";

/// A room with a lamp that shines up, and a box that hides some of it from some pixels.
fn room(material: &str) -> String {
    format!(
        "camera: {{position: [0, 0, 1.8], look_at: [0, -0.3, 0], fov: 60}}\n\
         objects:\n\
         - box: {{min: [-2, -1, -2], max: [2, 2, 2], material: {{matte: {{color: [0.8, 0.6, 0.5]}}}}}}\n\
         - box: {{min: [-0.5, -1, -0.5], max: [0.6, 0, 0.5], material: {{{material}}}}}\n\
         - rectangle: {{corner: [-1, 1.2, -1], edges: [[0, 0, 2], [2, 0, 0]], \
         material: {{matte: {{color: 0.5, emission: {{color: [8, 7, 5], sides: front}}}}}}}}\n"
    )
}

fn explained(scene: &CompiledScene) -> Vec<PixelExplanation> {
    let places = (0..WIDTH).flat_map(|y| (0..WIDTH).map(move |x| (x, y)));
    places.map(|(x, y)| durer::explain(scene, x, y).expect("it is in the picture")).collect()
}

/// All rays of a tree, each with the one that it comes from.
fn walk<'r>(
    ray: &'r RayExplanation,
    from: Option<&'r RayExplanation>,
    visit: &mut impl FnMut(&'r RayExplanation, Option<&'r RayExplanation>),
) {
    visit(ray, from);
    ray.children.iter().for_each(|child| walk(child, Some(ray), visit));
}

/// Light that one pixel takes from a junction: from where the ray starts.
struct Taken<'r> {
    ray: &'r RayExplanation,
    from: HitExplanation,
    /// What light counts that leaves the ray's start to the eye.
    throughput: Rgb,
    reuse: ReuseExplanation,
}

/// All light that was taken, by the number of the sample and the pixel that found it.
fn taken(pixels: &[PixelExplanation]) -> BTreeMap<(usize, (u32, u32)), Vec<Taken<'_>>> {
    let mut all: BTreeMap<_, Vec<Taken<'_>>> = BTreeMap::new();
    for (number, sample) in pixels.iter().flat_map(|pixel| pixel.samples.iter().enumerate()) {
        walk(&sample.ray, None, &mut |ray, from| {
            assert_eq!(ray.reuse.is_some(), ray.kind == RayKind::Connected);
            // Nothing is told twice: as part of the sample and of what arrives at a junction.
            let apart = if ray.relative_to == RelativeTo::Sample { &ray.brought } else { &ray.contributions };
            assert!(apart.is_empty(), "{ray:?}");
            let (Some(reuse), Some(from)) = (ray.reuse, from) else { return };
            assert_eq!(reuse.sample, number);
            let (from, throughput) = (from.hit.expect("it starts at a surface"), from.weight);
            all.entry((number, reuse.pixel)).or_default().push(Taken { ray, from, throughput, reuse });
        });
    }
    all
}

/// Junctions that pixels have found: the rays that met them.
fn found(pixels: &[PixelExplanation]) -> BTreeMap<(usize, (u32, u32)), &RayExplanation> {
    let mut all = BTreeMap::new();
    for pixel in pixels {
        for (number, sample) in pixel.samples.iter().enumerate() {
            walk(&sample.ray, None, &mut |ray, _| {
                if let Some(JunctionExplanation::Found(_)) = ray.junction {
                    assert!(all.insert((number, (pixel.x, pixel.y)), ray).is_none(), "a path has one junction");
                }
            });
        }
    }
    all
}

fn assert_near(found: f64, expected: f64, what: &str) {
    assert!((found - expected).abs() <= 2e-6 * expected.abs(), "{what}: {found}, not {expected}");
}

fn assert_colors(found: Rgb, expected: Rgb, what: &str) {
    for (found, expected) in found.to_array().into_iter().zip(expected.to_array()) {
        assert_near(f64::from(found), f64::from(expected), what);
    }
}

/// In a ball of radius R the form factor of any two points is 1/(4πR²), wherever they are: all pixels of a block find all junctions
/// as densely, and each counts as one of so many.
#[test]
fn in_a_ball_all_pixels_of_a_block_count_the_same() {
    for (reuse, views) in [(4, 4), (16, 16), (64, 64)] {
        let pixels = explained(&scene(&format!("reuse: {reuse}"), BALL));
        let all = taken(&pixels);
        assert_eq!(all.len(), SAMPLES * pixels.len());
        for Taken { ray, reuse, .. } in all.values().flatten() {
            let Sharing { density, sum, views: found, part } = reuse.sharing.expect("all see it");
            assert_eq!(found, views);
            assert_near(density, 1.0 / (16.0 * PI), "density");
            assert_near(sum, views as f64 / (16.0 * PI), "sum of densities");
            assert_near(part, 1.0 / views as f64, "weight");
            assert_colors(ray.weight, Rgb::gray(0.8), "weight of the ray");
            assert_colors(ray.contributions[0].amount, reuse.light * (0.8 / views as f32), "contribution");
        }
        assert!(all.values().all(|taken| taken.len() == views));
    }
}

/// Of matte things: densities are cos θ cos θ' / (π d²), what is added is throughput × albedo × density × light / sum, and what all
/// who see a junction count adds up to one, whether others see it or not.
#[test]
fn weights_are_those_of_the_balance_heuristic() {
    for path in ["reuse: 16", "reuse: 64, split: 2"] {
        let pixels = explained(&scene(path, &room("matte: {color: [0.3, 0.7, 0.2]}")));
        let (all, junctions) = (taken(&pixels), found(&pixels));
        let mut hidden = 0;
        for (place, all) in &all {
            let junction = junctions[place].hit.expect("it is a surface");
            for Taken { ray, from, throughput, reuse } in all {
                let hit = ray.hit.expect("it leads to a junction");
                assert_eq!((hit.shape, hit.material, hit.point), (junction.shape, junction.material, junction.point));
                let way = hit.point - ray.origin;
                let cosines = from.shading_normal.dot(ray.direction) * -hit.shading_normal.dot(ray.direction);
                let form_factor = cosines / (PI * way.length_squared());
                let Sharing { density, sum, part, .. } =
                    reuse.sharing.expect("plain things are seen by who finds them");
                assert_near(density, form_factor, "density");
                assert_near(part, density / sum, "weight");
                let expected = *throughput * from.color * reuse.light * ((form_factor / sum) as f32);
                let [contribution] = ray.contributions[..] else { panic!("one amount comes from a junction") };
                assert_colors(contribution.amount, expected, "contribution");
                assert_colors(contribution.amount, ray.weight * reuse.light * part as f32, "contribution by weight");
            }
            let sharing: Vec<Sharing> = all.iter().filter_map(|taken| taken.reuse.sharing).collect();
            assert!(sharing.iter().all(|one| (one.sum, one.views) == (sharing[0].sum, all.len())));
            assert_near(sharing.iter().map(|one| one.part).sum(), 1.0, "sum of weights");
            assert_near(sharing.iter().map(|one| one.density).sum(), sharing[0].sum, "sum of densities");
            hidden += usize::from(all.len() < if path == "reuse: 16" { 16 } else { 64 });
        }
        assert!(all.len() > 200 && hidden > 20, "{} junctions, {hidden} of them hidden from some", all.len());
    }
}

/// What leaves a matte junction is albedo / π times the cosines of what arrives, and what arrives by rays is what they brought,
/// over the density.
#[test]
fn behind_junctions_is_what_arrives_there() {
    let pixels = explained(&scene("reuse: 16", &room("matte: {color: [0.3, 0.7, 0.2]}")));
    let all = taken(&pixels);
    let mut by_rays = 0;
    for (place, ray) in found(&pixels) {
        let Some(JunctionExplanation::Found(arrivals)) = &ray.junction else { unreachable!("only those are found") };
        let hit = ray.hit.expect("it is a surface");
        let mut brought = Rgb::BLACK;
        for child in &ray.children {
            assert_eq!(child.weight, Rgb::WHITE);
            walk(child, None, &mut |ray, _| {
                assert_eq!(ray.relative_to, RelativeTo::Junction);
                assert!(ray.contributions.is_empty());
                ray.brought.iter().for_each(|one| brought += one.amount);
            });
        }
        let mut leaving = Rgb::BLACK;
        for arrival in arrivals {
            let cosine = arrival.direction.dot(hit.shading_normal);
            leaving += hit.color * arrival.light * ((cosine / PI) as f32);
            if arrival.source.is_none() {
                let density = ray.turns[0].scattering.pdf.expect("it is matte");
                assert_eq!(arrival.light, brought * (1.0 / density) as f32);
                by_rays += usize::from(!brought.is_black());
            }
        }
        match all.get(&place) {
            Some(taken) => taken.iter().for_each(|one| assert_colors(one.reuse.light, leaving, "light that leaves it")),
            None => assert!(leaving.is_black(), "nobody takes {leaving:?}"),
        }
    }
    assert!(by_rays > 50, "{by_rays}");
}

/// Where a junction has a smooth coat, a path may go on as in a mirror: that is the pixel's own, with its whole weight.
#[test]
fn mirrored_rays_from_junctions_count_in_the_sample() {
    let coated = room("glass: {}").replace("matte: {color: [0.8, 0.6, 0.5]}", "plastic: {color: 0.5, roughness: 0}");
    let mut mirrored = 0;
    for sample in explained(&scene("reuse: 16", &coated)).iter().flat_map(|pixel| &pixel.samples) {
        walk(&sample.ray, None, &mut |ray, _| {
            let (Some(_), [turn], [child]) = (&ray.junction, &ray.turns[..], &ray.children[..]) else { return };
            if turn.scattering.pdf.is_some() {
                return;
            }
            assert_eq!(child.relative_to, RelativeTo::Sample);
            assert_colors(child.weight, ray.weight * turn.scattering.weight, "weight behind a coat");
            mirrored += usize::from(!child.sum(Rgb::BLACK).is_black());
        });
        assert_eq!(sample.ray.sum(Rgb::BLACK), sample.color);
    }
    assert!(mirrored > 0);
}

/// What nothing but junctions and their rays is told of is told of no other ray.
#[test]
fn without_reuse_all_is_relative_to_the_sample() {
    for path in ["split: 1", "split: 3"] {
        for sample in explained(&scene(path, &room("glass: {}"))).iter().flat_map(|pixel| &pixel.samples) {
            walk(&sample.ray, None, &mut |ray, _| {
                assert!(ray.relative_to == RelativeTo::Sample && ray.brought.is_empty());
                assert!(ray.junction.is_none() && ray.reuse.is_none() && ray.kind != RayKind::Connected);
                assert!(path == "split: 3" || ray.way.is_none());
            });
        }
    }
}

/// Relief turns the normal of a junction for some who look: light that is sure for its own path alone counts by its weight there.
#[test]
fn light_of_ones_own_counts_in_full() {
    let steep = "matte: {color: 0.8, bump: {height: {noise: {size: 0.2}}, size: 0.6}}";
    let pixels = explained(&scene("reuse: 16", &room(steep)));
    let mut own = 0;
    for ((_, by), all) in taken(&pixels) {
        for Taken { ray, .. } in all.iter().filter(|taken| taken.reuse.sharing.is_none()) {
            assert_eq!(all.len(), 1, "nobody else has it");
            assert!(pixels.iter().any(|pixel| (pixel.x, pixel.y) == by && pixel.samples.iter().any(|sample| holds(&sample.ray, ray))));
            assert_eq!(ray.contributions[0].amount, ray.weight * ray.reuse.expect("it is reused").light);
            own += 1;
        }
    }
    assert!(own > 0);
}

fn holds(tree: &RayExplanation, ray: &RayExplanation) -> bool {
    std::ptr::eq(tree, ray) || tree.children.iter().any(|child| holds(child, ray))
}

/// Each of the ways of a split sample says which it is; where paths are reused the first makes junctions, and the others end there.
#[test]
fn ways_say_which_they_are() {
    for (path, is_reused) in [("split: 3", false), ("split: 3, reuse: 16", true)] {
        let (mut found, mut left) = (0, 0);
        for sample in explained(&scene(path, &room("mirror: {}"))).iter().flat_map(|pixel| &pixel.samples) {
            walk(&sample.ray, None, &mut |ray, from| {
                let ways: Vec<Way> = ray.turns.iter().filter_map(|turn| turn.way).collect();
                let is_split = !ways.is_empty();
                assert!(!is_split || ways == [1, 2, 3].map(|number| Way { number, of: 3 }), "{ways:?}");
                let begun = ray.children.iter().filter(|child| child.kind != RayKind::Connected);
                assert!(begun.clone().all(|child| child.way.is_some() == is_split));
                assert!(begun.clone().map(|child| child.way.map(|way| way.number)).is_sorted());
                let Some(junction) = &ray.junction else { return };
                // The ray starts where the sample was split: what could be a junction is the next surface.
                let way = ray.way.expect("it is one of three");
                assert!(from.is_some() && is_reused && ray.relative_to == RelativeTo::Sample);
                match junction {
                    JunctionExplanation::Found(_) => assert_eq!(way.number, 1),
                    JunctionExplanation::Left => assert!(way.number > 1 && ray.children.is_empty()),
                }
                *if *junction == JunctionExplanation::Left { &mut left } else { &mut found } += 1;
            });
        }
        assert!(if is_reused { found > 100 && left > found } else { found + left == 0 }, "{found} {left}");
    }
}

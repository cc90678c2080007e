//! Paths that several pixels make use of: the same light as without, and less noise.

use crate::support::{assert_same, assert_same_pixels, components, estimate, halves, load, pixel, render};
use durer::imaging::Image;
use durer::{CompiledScene, Film, Region, RenderOptions, SampleRange};

/// Ways to trace paths that all must find the same light.
const WAYS: [&str; 2] = ["reuse: 16", "reuse: 64, split: 2"];

/// A room with a lamp that shines up, so that most light comes by way of the walls; 13 × 11 pixels of it, in which blocks end
/// where they do not fit.
fn room(path: &str, samples: u32, seed: u32, things: &str) -> String {
    format!(
        "picture: {{width: 13, height: 11}}\n\
         render: {{integrator: {{path: {{{path}}}}}, samples: {samples}, seed: {seed}}}\n\
         background: black\nlights: []\n\
         camera: {{position: [0, 0, 1.8], look_at: [0, -0.3, 0], fov: 60}}\n\
         objects:\n\
         - box: {{min: [-2, -1, -2], max: [2, 2, 2], material: {{matte: {{color: [0.8, 0.6, 0.5]}}}}}}\n\
         - rectangle: {{corner: [-1, 1.2, -1], edges: [[0, 0, 2], [2, 0, 0]], \
         material: {{matte: {{color: 0.5, emission: {{color: [8, 7, 5], sides: front}}}}}}}}\n\
         {things}"
    )
}

/// Two kinds of things side by side, so that their edge goes through blocks.
fn beside(material: &str, more: &str) -> String {
    format!(
        "- sphere: {{center: [-0.5, -0.4, -0.3], radius: 0.6, material: {{{material}}}}}\n\
         - box: {{min: [-2, -0.99, -0.2], max: [2, -0.9, 2], material: {{{material}}}}}\n{more}"
    )
}

fn same_light(name: &str, things: &str) {
    same_light_by(48, name, things);
}

/// With so many samples of reused paths, and five times as many of others.
fn same_light_by(samples: u32, name: &str, things: &str) {
    let of = |path: &str, samples: u32| {
        let images: Vec<Image> =
            (1..=8).map(|seed| render(&room(&format!("max_depth: 5, {path}"), samples, seed, things))).collect();
        let image = |seed: u32| images[seed as usize - 1].clone();
        [estimate(image, halves), estimate(image, components)]
    };
    let [plain, plain_pixels] = of("reuse: 1", 5 * samples);
    for way in WAYS {
        let (name, [found, pixels]) = (format!("{name}, {way}"), of(way, samples));
        assert_same(&name, &plain, &found);
        assert_same_pixels(&name, &plain_pixels, &pixels);
    }
}

#[test]
fn matte_things() {
    same_light("Lambert", &beside("matte: {color: [0.2, 0.5, 0.9]}", ""));
    same_light("Oren and Nayar", &beside("matte: {color: 0.7, roughness: 0.8}", ""));
}

#[test]
fn rough_and_smooth_metal() {
    for roughness in [0.0, 0.15, 0.5, 0.9] {
        same_light(
            &format!("metal {roughness}"),
            &beside(&format!("metal: {{of: copper, roughness: {roughness}}}"), ""),
        );
    }
    same_light("brushed", &beside("metal: {of: gold, roughness: 0.6, anisotropy: 0.7}", ""));
}

/// Part of what is found from there is found by mirrored rays, which say nothing of how dense others are.
#[test]
fn coats() {
    for material in [
        "plastic: {color: [0.2, 0.5, 0.3], roughness: 0}",
        "plastic: {color: [0.2, 0.5, 0.3], roughness: 0.5}",
        "principled: {base_color: [0.2, 0.5, 0.3], roughness: 0.6, clearcoat: 1}",
        "principled: {base_color: [0.2, 0.5, 0.3], roughness: 0.5, metallic: 0.5, sheen_color: 0.8, sheen_roughness: 0.5}",
        "color: [0.2, 0.5, 0.3], specular: 0, reflection: 0.4",
        "color: [0.2, 0.5, 0.3], specular: 0.3, shininess: 20",
    ] {
        same_light(material, &beside(material, ""));
    }
}

/// What lets light through straight is passed by shadow rays of lamps, but hides one point from another.
#[test]
fn what_is_seen_through() {
    let sheet = |material: &str| {
        beside(
            "matte: {color: 0.7}",
            &format!(
                "- rectangle: {{corner: [0, -1, 0.3], edges: [[1.2, 0, 0.2], [0, 1.2, 0]], material: {{{material}}}}}"
            ),
        )
    };
    for material in [
        "color: [0.5, 0.7, 0.9], specular: 0, transparency: 0.5",
        "glass: {thin: true}",
        "matte: {color: 0.8, opacity: 0.5}",
        "color: [0.9, 0.5, 0.2], specular: 0, opacity: [1, 0.5, 0.1]",
        "matte: {color: 0.8, opacity: {checker: {colors: [0, 1], size: 0.2}}}",
    ] {
        same_light(material, &sheet(material));
    }
    // Much light comes from what is partly there in some colors.
    let ceiling = "- rectangle: {corner: [-1.8, 1.5, -1.8], edges: [[0, 0, 3.6], [3.6, 0, 0]], \
                   material: {color: white, specular: 0, opacity: [1, 0.6, 0.2]}}";
    same_light_by(96, "a ceiling that is partly there", &beside("matte: {color: 0.7}", ceiling));
}

/// After ways that end in glass, and where the eye is in glass itself.
#[test]
fn glass() {
    let ball = "- sphere: {center: [1.2, 0.1, -0.2], radius: 0.75, material: {glass: {}}}\n";
    // A pixel alone, which shares nothing that would make up for what it loses.
    let alone = |path: &str| {
        let text = room("", 1, 1, &beside("matte: {color: 0.7}", ball));
        let (_, rest) = text.split_once("background").expect("settings end there");
        pixel(&format!("{{path: {{max_depth: 4, {path}}}}}"), 65_536, &format!("background{rest}"))
    };
    let [(plain, plain_error), (reused, error)] = ["reuse: 1", "reuse: 16"].map(alone);
    let off = f64::from(reused.luminance() - plain.luminance()) / plain_error.hypot(error);
    assert!(
        off.abs() < 4.5 && error < 0.003 * f64::from(plain.luminance()),
        "{reused:?} in place of {plain:?} ± {error}"
    );
    same_light("a ball of glass", &beside("matte: {color: 0.7}", ball));
    let around = "- sphere: {center: [0, 0, 1.8], radius: 0.15, material: {glass: {ior: 1.2}}}\n";
    same_light("the eye in glass", &beside("matte: {color: 0.7}", around));
}

#[test]
fn fog() {
    let fog = "fog: {exponential: {color: 0.2, distance: 4}}\n";
    let of = |path: &str, samples: u32| {
        estimate(|seed| render(&(room(path, samples, seed, &beside("matte: {color: 0.7}", "")) + fog)), halves)
    };
    assert_same("fog", &of("reuse: 1", 256), &of("reuse: 16", 256));
}

/// Coarse meshes with smooth normals, on which rays start above the triangles, and relief.
#[test]
fn other_normals_than_the_surface_has() {
    let gem = |centre: [f64; 3], material: &str| {
        let at = |direction: [f64; 3]| {
            let [x, y, z] = [0, 1, 2].map(|axis| centre[axis] + 0.6 * direction[axis]);
            format!("[{x}, {y}, {z}]")
        };
        let corners = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]];
        let corners = corners.map(|corner| corner.map(f64::from));
        format!(
            "- mesh: {{vertices: [{}], vertex_normals: [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]], \
             triangles: [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]], \
             material: {{{material}}}}}\n",
            corners.map(at).join(", ")
        )
    };
    let relief = "matte: {color: 0.8, bump: {height: {checker: {colors: [0, 1], size: 0.3}}, size: 0.1}}";
    let waves = "matte: {color: 0.8, bump: {height: {noise: {size: 0.2}}, size: 0.1}}";
    for material in ["matte: {color: 0.8}", "metal: {of: copper, roughness: 0.6}", waves] {
        let two = gem([-0.6, -0.4, -0.2], material) + &gem([0.5, -0.4, -0.1], material);
        same_light(&format!("gems of {material}"), &two);
    }
    let steep = "matte: {color: 0.8, bump: {height: {noise: {size: 0.2}}, size: 0.6}}";
    for relief in [relief, waves, steep] {
        same_light(relief, &beside(relief, ""));
    }
}

/// Paths end where they do without.
#[test]
fn depths() {
    for depth in [2, 3] {
        let of = |path: &str, samples: u32| {
            let path = format!("max_depth: {depth}, {path}");
            // A lamp that shines down, so that there is some light in two steps.
            let things =
                beside("matte: {color: 0.7}", "- sphere: {center: [1, 0.5, 0], radius: 0.2, material: {emission: 20}}");
            estimate(|seed| render(&room(&path, samples, seed, &things)), halves)
        };
        let plain = of("reuse: 1", 256);
        for way in WAYS {
            assert_same(&format!("{depth} deep, {way}"), &plain, &of(way, 128));
        }
    }
}

/// In a glowing ball of albedo ρ there is L / (1 - ρ), with far less noise than without.
#[test]
fn a_glowing_ball() {
    let of = |path: &str| {
        let text = format!(
            "picture: {{width: 24, height: 24}}\n\
             render: {{integrator: {{path: {{max_depth: 1000, {path}}}}}, samples: 64}}\n\
             background: black\nlights: []\ncamera: {{position: [0.3, 0, 0], look_at: [0, 0.2, -1]}}\n\
             objects: [sphere: {{radius: 2, material: {{matte: {{color: 0.8, emission: 1}}}}}}]\n"
        );
        let off: Vec<f64> = render(&text).pixels.iter().map(|pixel| f64::from(pixel.g) - 5.0).collect();
        (off.iter().sum::<f64>() / 576.0, off.iter().map(|off| off * off).sum::<f64>() / 576.0)
    };
    let (_, plain) = of("reuse: 1");
    for (way, less) in [("reuse: 4", 0.5), ("reuse: 16", 0.2), ("reuse: 64", 0.1), ("reuse: 16, split: 2", 0.1)] {
        let (mean, squares) = of(way);
        assert!(mean.abs() < 0.02, "{way}: {mean} more than 5");
        assert!(squares < less * plain, "{way}: {squares}, without {plain}");
    }
}

/// A clamp takes light away, and no more than without.
#[test]
fn a_clamp_never_adds_light() {
    let mean = |path: &str| {
        let images = (1..=4).map(|seed| render(&room(path, 128, seed, &beside("matte: {color: 0.7}", ""))));
        images.map(|image| halves(&image).iter().sum::<f64>()).sum::<f64>()
    };
    let [all, plain, reused] = ["reuse: 16", "clamp: 0.3", "clamp: 0.3, reuse: 16"].map(mean);
    assert!(plain < 0.97 * all, "nothing is clamped: {plain} of {all}");
    assert!((0.99 * plain..1.003 * all).contains(&reused), "{plain} {reused} {all}");
}

fn compiled(path: &str, more: &str, things: &str) -> CompiledScene {
    let text = room(path, 6, 1, things).replace("samples: 6,", more);
    durer::compile(&load(&text))
}

fn film(scene: &CompiledScene, options: RenderOptions) -> Film {
    durer::render(scene, &options, &()).expect("it renders")
}

fn bits(film: &Film) -> Vec<[u32; 3]> {
    film.pixels().iter().map(|pixel| pixel.to_array().map(f32::to_bits)).collect()
}

/// Direct light is that of the pixel's own path.
#[test]
fn direct_light_is_the_same() {
    let things = beside("plastic: {color: 0.5}", "- sphere: {center: [1, 0, 0], radius: 0.2, material: {emission: 9}}");
    let of = |path: &str| {
        let film = film(&compiled(path, "samples: 6,", &things), RenderOptions { direct: true, ..Default::default() });
        let sums = film.sums().expect("it has samples");
        let direct = (0..13 * 11).map(|pixel| sums.direct_mean(pixel).expect("direct light is known").to_array());
        (direct.map(|color| color.map(f32::to_bits)).collect::<Vec<_>>(), bits(&film))
    };
    let plain = of("reuse: 1");
    for reused in ["reuse: 16", "reuse: 64"] {
        let reused = of(reused);
        assert!(plain.0 == reused.0 && plain.1 != reused.1);
    }
}

/// However many threads, whichever part of the picture, whichever samples: what is there is the same.
#[test]
fn parts_are_those_of_the_whole() {
    let things = beside("plastic: {color: 0.5}", "- sphere: {center: [0.5, 0, 0], radius: 0.3, material: {glass: {}}}");
    for path in ["reuse: 16", "reuse: 64, split: 2"] {
        for goal in ["samples: 6,", "samples: 200, noise: 0.03,"] {
            let scene = compiled(path, goal, &things);
            let whole = film(&scene, RenderOptions { threads: Some(1), ..Default::default() });
            assert_eq!(whole, film(&scene, RenderOptions { threads: Some(3), ..Default::default() }), "{path}, {goal}");
            let pixels = bits(&whole);
            for (x, y, width, height) in [(0, 0, 8, 8), (3, 2, 7, 9), (12, 10, 1, 1), (5, 0, 1, 11), (0, 7, 13, 3)] {
                let region = Some(Region { x, y, width, height });
                let part = bits(&film(&scene, RenderOptions { region, ..Default::default() }));
                for row in 0..height {
                    let (here, there) = ((row * width) as usize, ((y + row) * 13 + x) as usize);
                    let width = width as usize;
                    assert_eq!(part[here..here + width], pixels[there..there + width], "{path}, {goal}, {region:?}");
                }
            }
        }
        let scene = compiled(path, "samples: 6,", &things);
        let whole = film(&scene, RenderOptions::default());
        let of = |start, end| {
            film(&scene, RenderOptions { samples: Some(SampleRange { start, end }), ..Default::default() })
        };
        let merged = Film::merge(&[of(2, 6), of(0, 2)]).expect("they fit");
        assert_eq!(bits(&merged), bits(&whole), "{path}");
    }
}

/// Without the background the rest is as it was, by the same light.
#[test]
fn things_without_background() {
    let of = |path: &str, samples: u32| {
        let image = |seed: u32| {
            let text = format!(
                "picture: {{width: 13, height: 11}}\n\
                 render: {{integrator: {{path: {{{path}}}}}, samples: {samples}, seed: {seed}}}\n\
                 background: {{bottom: 0.2, top: [0.5, 0.8, 1]}}\nlights: []\n\
                 camera: {{position: [0, 1, 5], look_at: [0, 0.5, 0], fov: 45}}\n\
                 objects:\n  - box: {{min: [-1, -0.1, -1], max: [1, 0, 1], material: {{matte: {{color: 0.8}}}}}}\n  \
                 - sphere: {{center: [-0.4, 0.6, 0], radius: 0.6, material: {{matte: {{color: [0.9, 0.4, 0.2]}}}}}}\n  \
                 - sphere: {{center: [0.7, 0.5, 0.2], radius: 0.5, material: {{matte: {{color: 0.7}}}}}}\n"
            );
            let mut scene = durer::compile(&load(&text));
            scene.leave_out_background();
            film(&scene, RenderOptions::default()).develop()
        };
        estimate(image, halves)
    };
    let plain = of("reuse: 1", 256);
    for way in WAYS {
        assert_same(&format!("without background, {way}"), &plain, &of(way, 128));
    }
}

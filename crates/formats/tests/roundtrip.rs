//! What is written reads back as the same scene, to the bit.

use durer_formats::{Assets, Limits, NoAssets, load_str, to_yaml};
use durer_imaging::{DecodeLimits, ToneMapping, Transfer, decode};
use durer_math::{DVec2, DVec3, Rgb};
use durer_scene::*;
use proptest::collection::vec;
use proptest::prelude::*;
use std::sync::Arc;

#[path = "roundtrip/many.rs"]
mod many;

use many::{Files, PICTURE};

#[track_caller]
fn read(text: &str) -> Scene {
    match load_str(text, "written.yaml", &Files, &Limits::default()) {
        Ok(loaded) => loaded.scene.into_scene(),
        Err(diagnostics) => panic!("{diagnostics}\n{text}"),
    }
}

fn number() -> BoxedStrategy<f64> {
    prop_oneof![
        -9.0..9.0,
        (-20_i32..20).prop_map(f64::from),
        any::<f64>().prop_map(|x| if x.is_finite() { x % 1e11 } else { 0.5 })
    ]
    .boxed()
}

fn size() -> impl Strategy<Value = f64> {
    prop_oneof![1e-3..10.0, (1_u32..9).prop_map(f64::from)]
}

fn point() -> impl Strategy<Value = DVec3> {
    [number(), number(), number()].prop_map(DVec3::from_array)
}

fn direction() -> impl Strategy<Value = DVec3> {
    (0.1..9.0, number(), number()).prop_map(|(x, y, z)| DVec3::new(x, y, z))
}

fn part() -> impl Strategy<Value = f32> {
    prop_oneof![0_f32..=1.0, Just(0.0), Just(1.0), Just(0.5)]
}

fn color() -> BoxedStrategy<Rgb> {
    prop_oneof![[part(), part(), part()].prop_map(Rgb::from), part().prop_map(Rgb::gray)].boxed()
}

fn text() -> BoxedStrategy<String> {
    let odd = prop::sample::select(vec![
        "", "red", "3", "~", "null", "yes", "- a", "a: b", "#fff", "<<", "*a", "ä", " x ", "'\"",
    ]);
    prop_oneof![odd.prop_map(str::to_owned), vec(any::<char>(), 0..12).prop_map(|c| c.into_iter().collect())].boxed()
}

fn transform() -> BoxedStrategy<Transform> {
    let factor = || prop_oneof![0.5..2.0, -2.0..-0.5];
    let small = || -50.0..50.0;
    let step = prop_oneof![
        point().prop_map(|by| TransformStep::Translate(by % 1e3)),
        factor().prop_map(|by| TransformStep::Scale(DVec3::splat(by))),
        [factor(), factor(), factor()].prop_map(|by| TransformStep::Scale(by.into())),
        (prop::sample::select(vec![DVec3::X, DVec3::Y, DVec3::Z]), small())
            .prop_map(|(axis, degrees)| TransformStep::Rotate { axis, degrees }),
        (direction(), small()).prop_map(|(axis, degrees)| TransformStep::Rotate { axis, degrees }),
        [small(), small(), small()].prop_map(|[a, b, c]| TransformStep::Matrix([
            [1.0, a / 99.0, 0.0, a],
            [0.0, 2.0, b / 99.0, b],
            [0.0, 0.0, 1.5, c]
        ])),
    ];
    vec(step, 0..4).prop_map(|steps| Transform { steps }).boxed()
}

fn shape() -> BoxedStrategy<Shape> {
    let beside = |a: DVec3| if a.length() < 1e6 { a } else { a / 1e6 };
    let near = move || point().prop_map(beside);
    prop_oneof![
        (point(), direction()).prop_map(|(point, normal)| Shape::Plane { point, normal }),
        (point(), size()).prop_map(|(center, radius)| Shape::Sphere { center, radius }),
        (near(), [size(), size(), size()]).prop_map(|(min, by)| Shape::Box { min, max: min + DVec3::from_array(by) }),
        (near(), direction(), size(), any::<bool>()).prop_map(|(base, by, radius, open)| Shape::Cylinder {
            base,
            top: base + by,
            radius,
            open
        }),
        (near(), direction(), size(), size(), any::<bool>()).prop_map(|(base, by, base_radius, top_radius, open)| {
            Shape::Cone { base, top: base + by, base_radius, top_radius, open }
        }),
        (point(), direction(), size(), 0.0..0.9).prop_map(|(center, normal, radius, hole)| Shape::Disc {
            center,
            normal,
            radius,
            inner_radius: hole * radius
        }),
        (point(), size(), size())
            .prop_map(|(corner, a, b)| Shape::Rectangle { corner, edges: [DVec3::X * a, DVec3::new(a, b, 0.1)] }),
        (near(), size(), size(), any::<bool>()).prop_map(|(a, x, y, uvs)| Shape::Triangle {
            vertices: [a, a + DVec3::X * x, a + DVec3::Y * y],
            uvs: uvs.then_some([DVec2::ZERO, DVec2::new(x, 0.0), DVec2::new(0.0, y)]),
        }),
        (point(), direction(), size(), 0.1..0.9).prop_map(|(center, axis, radius, tube)| Shape::Torus {
            center,
            axis,
            radius,
            tube_radius: tube * radius
        }),
    ]
    .boxed()
}

/// An object of this kind, placed somehow.
fn object_of(kind: BoxedStrategy<ObjectKind>, materials: u32) -> BoxedStrategy<Object> {
    let material = prop::option::of((0..materials).prop_map(MaterialId));
    (prop::option::of(text()), material, transform(), kind)
        .prop_map(|(name, material, transform, kind)| Object { name, material, transform, kind })
        .boxed()
}

fn object(materials: u32) -> BoxedStrategy<Object> {
    let leaf = prop_oneof![
        4 => shape().prop_map(ObjectKind::Shape),
        1 => many::mesh(materials).prop_map(ObjectKind::Mesh),
        1 => many::particles().prop_map(ObjectKind::Particles),
        1 => many::solid(materials).prop_map(ObjectKind::Solid),
    ];
    let leaf = object_of(leaf.boxed(), materials);
    leaf.prop_recursive(3, 12, 4, move |inner| {
        let group = vec(inner.clone(), 0..4).prop_map(ObjectKind::Group);
        let copies = many::instances(inner.boxed(), materials).prop_map(ObjectKind::Instances);
        object_of(prop_oneof![2 => group, 1 => copies].boxed(), materials)
    })
    .boxed()
}

/// Only textures before this one, so that none is made of itself.
fn paint(before: u32) -> BoxedStrategy<Paint> {
    let texture =
        move |id: u32| if before > 0 { Paint::Texture(TextureId(id % before)) } else { Paint::Color(Rgb::WHITE) };
    prop_oneof![color().prop_map(Paint::Color), any::<u32>().prop_map(texture)].boxed()
}

fn pattern(before: u32) -> BoxedStrategy<Pattern> {
    let two = || [paint(before), paint(before)];
    let many = || vec(paint(before), 2..5);
    let space = || prop::sample::select(vec![Space::Object, Space::Uv]);
    let wrap = || prop::sample::select(vec![Wrap::Repeat, Wrap::Clamp, Wrap::Mirror]);
    let mapping = prop_oneof![
        prop::sample::select(vec![Mapping::Uv, Mapping::Planar, Mapping::Spherical]),
        size().prop_map(|half_height| Mapping::Cylindrical { half_height })
    ];
    let filter = prop::sample::select(vec![Filter::Nearest, Filter::Bilinear]);
    let encoding = prop::sample::select(vec![Encoding::Srgb, Encoding::Linear]);
    let channels = prop::sample::select(vec![Channels::Color, Channels::Alpha]);
    prop_oneof![
        (two(), size(), space()).prop_map(|(colors, size, space)| Pattern::Checker { colors, size, space }),
        (many(), direction(), size(), space()).prop_map(|(colors, axis, width, space)| Pattern::Stripes {
            colors,
            axis,
            width,
            space
        }),
        (many(), size(), space()).prop_map(|(colors, width, space)| Pattern::Rings { colors, width, space }),
        (many(), direction(), size(), wrap(), space())
            .prop_map(|(colors, axis, length, wrap, space)| Pattern::Gradient { colors, axis, length, wrap, space }),
        (mapping, wrap(), filter, encoding, channels, color()).prop_map(
            |(mapping, wrap, filter, encoding, channels, tint)| {
                Pattern::Image(ImageTexture { image: ImageId(0), mapping, wrap, filter, encoding, channels, tint })
            }
        ),
        (two(), size(), 1_u32..=16).prop_map(|(colors, size, octaves)| Pattern::Noise { colors, size, octaves }),
        (two(), size(), size(), 1_u32..=16).prop_map(|(colors, size, turbulence, octaves)| Pattern::Marble {
            colors,
            size,
            turbulence,
            octaves
        }),
        (two(), size(), size(), 1_u32..=16).prop_map(|(colors, size, turbulence, octaves)| Pattern::Wood {
            colors,
            size,
            turbulence,
            octaves
        }),
    ]
    .boxed()
}

fn attenuation() -> BoxedStrategy<Attenuation> {
    ([0.1_f32..1.0, 0.1_f32..1.0, 0.1_f32..1.0], size())
        .prop_map(|(color, distance)| Attenuation { color: color.into(), distance })
        .boxed()
}

fn classic() -> BoxedStrategy<MaterialKind> {
    let parts = (paint(3), part(), part(), color(), 0_f32..500.0);
    let clear = (color(), color(), prop::option::of(0.5..2.5), any::<bool>(), prop::option::of(attenuation()));
    (parts, clear)
        .prop_map(|((color, ambient, diffuse, specular, shininess), clear)| {
            let (reflection, transparency, ior, fresnel, attenuation) = clear;
            MaterialKind::Classic(Classic {
                color,
                ambient,
                diffuse,
                specular,
                shininess,
                reflection,
                transparency,
                ior,
                fresnel,
                attenuation,
            })
        })
        .boxed()
}

/// A number from 0 to 1, or a texture.
fn amount() -> BoxedStrategy<Paint> {
    prop_oneof![part().prop_map(|gray| Paint::Color(Rgb::gray(gray))), paint(3).prop_filter("no color", is_texture)]
        .boxed()
}

fn is_texture(paint: &Paint) -> bool {
    matches!(paint, Paint::Texture(_))
}

fn physical() -> BoxedStrategy<MaterialKind> {
    let metals = vec![MetalName::Aluminum, MetalName::Brass, MetalName::Gold, MetalName::Titanium];
    let conductor = prop_oneof![
        prop::sample::select(metals).prop_map(Conductor::Named),
        (1_f32..4.0, color()).prop_map(|(eta, k)| Conductor::Index { eta: Rgb::gray(eta), k }),
        paint(3).prop_map(Conductor::Reflectance),
    ];
    let glass = (1_f64..2.5, amount(), paint(3), prop::option::of(attenuation()), -3..3, any::<bool>());
    prop_oneof![
        (paint(3), amount()).prop_map(|(color, roughness)| MaterialKind::Matte(Matte { color, roughness })),
        (conductor, amount(), amount(), amount()).prop_map(|(conductor, roughness, anisotropy, rotation)| {
            MaterialKind::Metal(Metal { conductor, roughness, anisotropy, rotation })
        }),
        glass.prop_map(|(ior, roughness, color, attenuation, priority, thin)| {
            MaterialKind::Glass(Glass { ior, roughness, color, attenuation, priority, thin })
        }),
        (paint(3), 1_f64..2.5, amount()).prop_map(|(color, ior, roughness)| MaterialKind::Plastic(Plastic {
            color,
            ior,
            roughness
        })),
        paint(3).prop_map(|color| MaterialKind::Mirror(Mirror { color })),
        principled(),
    ]
    .boxed()
}

fn principled() -> BoxedStrategy<MaterialKind> {
    let base = (paint(3), amount(), amount(), 1_f64..2.5, amount(), paint(3));
    let clear = (amount(), any::<bool>(), prop::option::of(attenuation()));
    let above = (amount(), amount(), paint(3), amount(), amount(), amount());
    (base, clear, above)
        .prop_map(|(base, (transmission, thin, attenuation), above)| {
            let (base_color, metallic, roughness, ior, specular, specular_color) = base;
            let (clearcoat, clearcoat_roughness, sheen_color, sheen_roughness, anisotropy, anisotropy_rotation) = above;
            MaterialKind::Principled(Box::new(Principled {
                base_color,
                metallic,
                roughness,
                ior,
                specular,
                specular_color,
                transmission,
                thin,
                attenuation,
                clearcoat,
                clearcoat_roughness,
                sheen_color,
                sheen_roughness,
                anisotropy,
                anisotropy_rotation,
            }))
        })
        .boxed()
}

fn material() -> BoxedStrategy<Material> {
    let sides = prop::sample::select(vec![Sides::Both, Sides::Front]);
    let emission = (paint(3), prop_oneof![Just(1.0), 0_f32..9.0], sides)
        .prop_map(|(color, strength, sides)| Emission { color, strength, sides });
    let normal_map = (paint(3), prop_oneof![Just(1.0), part()])
        .prop_map(|(texture, strength)| Relief::NormalMap(NormalMap { texture, strength }));
    let bump = (paint(3), -1_f64..1.0).prop_map(|(height, size)| Relief::Bump(Bump { height, size }));
    let relief = prop::option::of(prop_oneof![normal_map, bump]);
    (prop_oneof![classic(), physical()], emission, paint(3), relief)
        .prop_map(|(kind, emission, opacity, relief)| Material { name: None, kind, emission, opacity, relief })
        .boxed()
}

fn light() -> BoxedStrategy<Light> {
    let falloff = || prop::sample::select(vec![Falloff::None, Falloff::InverseSquare]);
    let near = || point().prop_map(|p| p % 1e3);
    let radius = || prop_oneof![Just(0.0), size()];
    let kind = prop_oneof![
        (point(), falloff(), radius()).prop_map(|(position, falloff, radius)| LightKind::Point {
            position,
            falloff,
            radius
        }),
        (near(), direction(), 1.0..180.0, prop_oneof![Just(1.0), 0.0..1.0], falloff(), radius()).prop_map(
            |(position, by, edge, inner, falloff, radius)| LightKind::Spot {
                position,
                target: position + by,
                half_angle_degrees: edge,
                inner_half_angle_degrees: edge * inner,
                falloff,
                radius,
            }
        ),
        direction().prop_map(|direction| LightKind::Directional { direction }),
    ];
    (prop::option::of(text()), color(), 0_f32..9.0, 0..3, kind)
        .prop_map(|(name, color, amount, unit, kind)| {
            let physical = match kind {
                LightKind::Directional { .. } => Strength::Irradiance(amount),
                LightKind::Point { falloff: Falloff::None, .. } | LightKind::Spot { falloff: Falloff::None, .. } => {
                    Strength::Classic(amount)
                }
                LightKind::Point { .. } | LightKind::Spot { .. } if unit == 1 => Strength::Power(amount),
                LightKind::Point { .. } | LightKind::Spot { .. } => Strength::RadiantIntensity(amount),
            };
            let strength = if unit == 0 { Strength::Classic(amount) } else { physical };
            Light { name, color, strength, kind }
        })
        .boxed()
}

fn camera() -> BoxedStrategy<Camera> {
    let projection = prop_oneof![
        prop_oneof![Just(50.0), 5.0..170.0].prop_map(|degrees| Projection::FieldOfView { degrees }),
        (size(), size()).prop_map(|(distance, half_height)| Projection::ImagePlane { distance, half_height }),
        size().prop_map(|height| Projection::Orthographic { height }),
    ];
    let focus = prop_oneof![Just(Focus::LookAt), size().prop_map(Focus::Distance), Just(Focus::Target(DVec3::ZERO))];
    let blades = prop::sample::select(vec![0, 3, 7]);
    let lens = (size(), focus, blades, -90_f64..90.0).prop_map(|(radius, focus, blades, rotation_degrees)| Lens {
        radius,
        focus,
        blades,
        rotation_degrees,
    });
    (point().prop_map(|p| p % 1e3), size(), projection, prop::option::of(lens))
        .prop_map(|(position, ahead, projection, lens)| {
            let look_at = position + DVec3::new(0.5, 0.5, -ahead);
            // A point that is sharp is before the eye.
            let lens = lens.map(|lens| match lens.focus {
                Focus::Target(_) => Lens { focus: Focus::Target(position + (look_at - position) * 2.0), ..lens },
                Focus::LookAt | Focus::Distance(_) => lens,
            });
            Camera { position, look_at, up: DVec3::new(0.0, 1.0, 0.25), projection, lens }
        })
        .boxed()
}

fn settings() -> BoxedStrategy<Scene> {
    let antialias = prop_oneof![
        Just(Antialias::None),
        (1_u32..=64).prop_map(|n| Antialias::Grid { n }),
        (part(), 0_u32..=10).prop_map(|(threshold, max_depth)| Antialias::Recursive { threshold, max_depth }),
        (part(), 0_u32..=7).prop_map(|(threshold, max_depth)| Antialias::Adaptive { threshold, max_depth }),
        (part(), 1_u32..=9).prop_map(|(threshold, depth)| Antialias::Pov1 { threshold, depth }),
        (part(), 1_u32..=9).prop_map(|(threshold, depth)| Antialias::Pov2 { threshold, depth }),
    ];
    let transfer = prop::sample::select(vec![Transfer::Srgb, Transfer::Linear]);
    let tones =
        vec![ToneMapping::None, ToneMapping::Reinhard, ToneMapping::Aces, ToneMapping::Agx, ToneMapping::PbrNeutral];
    let picture = (1_u32..9999, 1_u32..9999, transfer, -9_f32..9.0, prop::sample::select(tones)).prop_map(
        |(width, height, transfer, exposure, tone_mapping)| Picture { width, height, transfer, exposure, tone_mapping },
    );
    let integrator = prop_oneof![
        Just(Integrator::Whitted),
        (1_u32..99, prop::option::of(1_f32..9.0), 1_u32..9, prop::sample::select(&PathSettings::REUSES)).prop_map(
            |(max_depth, clamp, split, reuse)| Integrator::Path(PathSettings { max_depth, clamp, split, reuse })
        ),
        prop::option::of(size()).prop_map(|distance| Integrator::AmbientOcclusion { distance }),
        Just(Integrator::Normals),
        Just(Integrator::Depth),
        Just(Integrator::Uv),
    ];
    let sampling = (
        prop::option::of(1_u32..999),
        prop::option::of(0.001_f32..0.5),
        prop::option::of(0.5..99.0),
        any::<u32>(),
        1_u32..64,
    );
    let trees = prop::sample::select(vec![Trees::Preview, Trees::Picture, Trees::ManyRays]);
    let radius = || 0.5..8.0;
    let filter = prop_oneof![
        Just(PixelFilter::Box),
        radius().prop_map(|radius| PixelFilter::Tent { radius }),
        (radius(), 0.1..8.0).prop_map(|(radius, sigma)| PixelFilter::Gaussian { radius, sigma }),
        radius().prop_map(|radius| PixelFilter::Mitchell { radius }),
        radius().prop_map(|radius| PixelFilter::BlackmanHarris { radius }),
    ];
    let render = (integrator, sampling, (1_u32..=20, part()), antialias, filter, trees).prop_map(
        |(integrator, sampling, (max_depth, min_weight), antialias, filter, trees)| {
            let (samples, noise, time, seed, light_samples) = sampling;
            RenderSettings {
                integrator,
                samples,
                noise,
                time,
                seed,
                light_samples,
                max_depth,
                min_weight,
                antialias,
                filter,
                trees,
            }
        },
    );
    let background = prop_oneof![
        color().prop_map(Background::Color),
        (color(), color()).prop_map(|(bottom, top)| Background::Gradient { bottom, top })
    ];
    let fog = prop_oneof![
        (color(), size()).prop_map(|(color, distance)| Fog::Exponential { color, distance }),
        (color(), size(), size()).prop_map(|(color, start, by)| Fog::Linear { color, start, end: start + by }),
    ];
    let lights = prop_oneof![Just(Light::default_lights()), vec(light(), 0..4)];
    (prop::option::of(camera()), picture, render, background, color(), prop::option::of(fog), lights)
        .prop_map(|(camera, picture, render, background, ambient, fog, lights)| Scene {
            camera,
            picture,
            render,
            background,
            ambient,
            fog,
            lights,
            ..Scene::default()
        })
        .boxed()
}

/// Scenes with three textures and three materials.
fn scene() -> BoxedStrategy<Scene> {
    let texture = |before| (transform(), pattern(before));
    let textures = (texture(0), texture(1), texture(2));
    let materials = [material(), material(), material()];
    (settings(), textures, materials, vec(object(3), 0..4), [text(), text(), text()])
        .prop_map(|(settings, (a, b, c), materials, objects, names)| {
            let uses_image = [&a, &b, &c].iter().any(|(_, pattern)| matches!(pattern, Pattern::Image(_)));
            let bitmap =
                || Arc::new(decode(&Files.read(PICTURE, u64::MAX).unwrap(), &DecodeLimits::default()).unwrap());
            let image = uses_image.then(|| ImageAsset { file: PICTURE.to_owned(), bitmap: bitmap() });
            let name = |at: usize| Some(if at == 0 { names[0].clone() } else { format!("{} {at}", names[at]) });
            let name = |at| name(at).map(|name| if name == "<<" { String::new() } else { name });
            let textures = [a, b, c].into_iter().enumerate();
            Scene {
                images: image.into_iter().collect(),
                textures: textures
                    .map(|(at, (transform, pattern))| Texture { name: name(at), transform, pattern })
                    .collect(),
                materials: materials.into_iter().enumerate().map(|(at, m)| Material { name: name(at), ..m }).collect(),
                objects,
                ..settings
            }
        })
        .boxed()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 256, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn named_scenes_come_back_equal(scene in scene()) {
        prop_assert!(scene.clone().check().is_ok(), "{:?}", scene.check());
        let text = to_yaml(&scene);
        prop_assert_eq!(read(&text), scene, "{}", text);
    }

    #[test]
    fn unnamed_scenes_come_back_stable(mut scene in scene(), keep in 0_usize..4) {
        scene.textures.iter_mut().skip(keep).for_each(|texture| texture.name = None);
        scene.materials.iter_mut().skip(keep).for_each(|material| material.name = None);
        let text = to_yaml(&scene);
        let once = read(&text);
        let again = to_yaml(&once);
        prop_assert_eq!(read(&again), once, "{}\n{}", text, again);
    }
}

#[test]
fn every_field_comes_back() {
    let scene = read(include_str!("every_field.yaml"));
    let text = to_yaml(&scene);
    assert_eq!(read(&text), scene, "{text}");
    assert!(text.lines().all(|line| line.len() <= 130), "{text}");
}

#[test]
fn empty_scenes_come_back() {
    assert_eq!(to_yaml(&Scene::default()), "{}\n");
    assert_eq!(read("{}"), Scene::default());
    let dark = Scene { lights: Vec::new(), ..Scene::default() };
    assert_eq!(read(&to_yaml(&dark)), dark);
}

#[test]
fn json_is_read() {
    let text = r#"{"objects": [{"sphere": {"radius": 2, "material": {"color": "\u0072ed"}}}]}"#;
    let loaded = load_str(text, "scene.json", &NoAssets, &Limits::default()).unwrap();
    assert_eq!(loaded.scene.scene().materials[0].as_classic().unwrap().color, Paint::Color(Rgb::new(1.0, 0.0, 0.0)));
}

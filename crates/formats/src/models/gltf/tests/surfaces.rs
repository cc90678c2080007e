//! Materials and textures.

use super::super::super::Model;
use super::build::File;
use super::{fault, only_mesh, read};
use durer_imaging::Texels;
use durer_math::{DVec3, Rgb};
use durer_scene::{
    Attenuation, Channels, Classic, Emission, Encoding, Filter, ImageTexture, Material, MaterialKind, Paint, Pattern,
    Principled, Relief, Scene, Texture, TextureId, Wrap,
};
use serde_json::{Value, json};

/// The scene of a triangle with this material.
#[track_caller]
fn scene_of(material: Value) -> Scene {
    let mut file = File::new();
    file.show_triangle(material);
    read(&file).scene
}

#[track_caller]
fn material_of(material: Value) -> Material {
    let mut scene = scene_of(material);
    assert_eq!(scene.materials.len(), 1);
    scene.materials.remove(0)
}

fn texture_of(scene: &Scene, paint: Paint) -> (&Texture, &ImageTexture) {
    let Paint::Texture(TextureId(id)) = paint else { panic!("{paint:?}") };
    let texture = &scene.textures[id as usize];
    let Pattern::Image(image) = &texture.pattern else { panic!("{texture:?}") };
    (texture, image)
}

fn near(a: Rgb, b: Rgb) -> bool {
    (a - b).map(f32::abs).max_component() < 1e-5
}

/// What a material says as glTF's own.
#[track_caller]
fn principled(material: &Material) -> &Principled {
    let MaterialKind::Principled(principled) = &material.kind else { panic!("{material:?}") };
    principled
}

fn gray(amount: f32) -> Paint {
    Paint::Color(Rgb::gray(amount))
}

#[test]
fn defaults_are_those_of_the_format() {
    let plain = material_of(json!({}));
    let white =
        Principled { base_color: gray(1.0), metallic: gray(1.0), roughness: gray(1.0), ..Principled::default() };
    assert_eq!(principled(&plain), &Principled { thin: true, ..white });
    assert_eq!((plain.emission, plain.opacity, plain.relief), (Emission::NONE, gray(1.0), None));
}

#[test]
fn numbers_come_as_they_are() {
    let material = material_of(json!({
        "pbrMetallicRoughness": { "baseColorFactor": [0.5, 0.25, 1, 1], "metallicFactor": 0.25, "roughnessFactor": 0.5 },
        "extensions": {
            "KHR_materials_ior": { "ior": 1.25 },
            "KHR_materials_specular": { "specularFactor": 0.5, "specularColorFactor": [1, 2, 100] },
            "KHR_materials_transmission": { "transmissionFactor": 0.75 },
            "KHR_materials_volume":
                { "thicknessFactor": 1, "attenuationColor": [0.5, 1, 0], "attenuationDistance": 2 },
            "KHR_materials_clearcoat": { "clearcoatFactor": 1, "clearcoatRoughnessFactor": 0.125 },
            "KHR_materials_sheen": { "sheenColorFactor": [0.5, 0, 1], "sheenRoughnessFactor": 0.375 },
            "KHR_materials_anisotropy":
                { "anisotropyStrength": 0.625, "anisotropyRotation": -std::f64::consts::FRAC_PI_2 },
        },
    }));
    let expected = Principled {
        base_color: Paint::Color(Rgb::new(0.5, 0.25, 1.0)),
        metallic: gray(0.25),
        roughness: gray(0.5),
        ior: 1.25,
        specular: gray(0.5),
        specular_color: Paint::Color(Rgb::new(1.0, 2.0, 100.0)),
        transmission: gray(0.75),
        thin: false,
        attenuation: Some(Attenuation { color: Rgb::new(0.5, 1.0, 1e-4), distance: 2.0 }),
        clearcoat: gray(1.0),
        clearcoat_roughness: gray(0.125),
        sheen_color: Paint::Color(Rgb::new(0.5, 0.0, 1.0)),
        sheen_roughness: gray(0.375),
        anisotropy: gray(0.625),
        // A quarter turn back is three quarters on.
        anisotropy_rotation: gray(0.75),
    };
    assert_eq!(principled(&material), &expected);
}

#[test]
fn without_thickness_there_is_no_inside() {
    let volume = |thickness: f64| {
        let volume = json!({ "thicknessFactor": thickness, "attenuationColor": [0.5, 1, 1], "attenuationDistance": 2 });
        let material = material_of(json!({ "extensions": {
            "KHR_materials_transmission": { "transmissionFactor": 1 },
            "KHR_materials_volume": volume,
        }}));
        (principled(&material).thin, principled(&material).attenuation.is_some())
    };
    assert_eq!((volume(0.0), volume(0.5)), ((true, false), (false, true)));
}

/// What is mirrored straight back, as far as a scene can say it.
fn straight_back(ior: f64) -> f32 {
    let material = material_of(json!({ "extensions": { "KHR_materials_ior": { "ior": ior } } }));
    let principled = principled(&material);
    let Paint::Color(color) = principled.specular_color else { panic!("{principled:?}") };
    let root = (principled.ior - 1.0) / (principled.ior + 1.0);
    (root * root) as f32 * color.r
}

#[test]
fn any_index_of_refraction_mirrors_as_much_as_it_should() {
    for (ior, expected) in [(1.0, 0.0), (1.5, 0.04), (10.0, 81.0 / 121.0), (19.0, 0.81), (0.0, 1.0)] {
        assert!((straight_back(ior) - expected).abs() < 1e-5, "{ior}: {}", straight_back(ior));
    }
}

#[test]
fn specular_and_glossiness() {
    let extension = json!({
        "diffuseFactor": [0.5, 0.5, 0.5, 1],
        "specularFactor": [1, 0.5, 0.25],
        "glossinessFactor": 0.5,
    });
    let material = material_of(json!({ "extensions": { "KHR_materials_pbrSpecularGlossiness": extension } }));
    let found = principled(&material);
    assert_eq!((found.base_color, found.metallic, found.roughness), (gray(0.5), gray(0.0), gray(0.5)));
    let Paint::Color(color) = found.specular_color else { panic!("{found:?}") };
    assert!(near(color * 0.04, Rgb::new(1.0, 0.5, 0.25)));
}

#[test]
fn unlit_materials_show_their_color() {
    let pbr = json!({ "baseColorFactor": [0.5, 0.25, 1, 1] });
    let unlit = material_of(json!({ "pbrMetallicRoughness": pbr, "extensions": { "KHR_materials_unlit": {} } }));
    let expected =
        Classic { color: Paint::Color(Rgb::new(0.5, 0.25, 1.0)), ambient: 1.0, diffuse: 0.0, ..Classic::default() };
    assert_eq!(unlit, Material::of(MaterialKind::Classic(expected)));
}

#[test]
fn emission() {
    let material = material_of(json!({
        "emissiveFactor": [1, 0.5, 0],
        "extensions": { "KHR_materials_emissive_strength": { "emissiveStrength": 8 } },
    }));
    let color = Paint::Color(Rgb::new(1.0, 0.5, 0.0));
    assert_eq!(material.emission, Emission { color, strength: 8.0, ..Emission::NONE });
}

#[test]
fn every_texture_is_read_from_its_channels() {
    let mut file = File::new();
    let image = file.texture(2, &[[0, 51, 255, 255], [0, 153, 255, 128]]);
    let texture = || json!({ "index": image });
    file.show_triangle(json!({
        "pbrMetallicRoughness": { "metallicRoughnessTexture": texture(), "metallicFactor": 0.5 },
        "emissiveFactor": [1, 1, 1],
        "emissiveTexture": texture(),
        "normalTexture": { "index": image, "scale": 0.5 },
        "extensions": {
            "KHR_materials_specular": { "specularTexture": texture(), "specularColorTexture": texture() },
            "KHR_materials_transmission": { "transmissionTexture": texture(), "transmissionFactor": 1 },
            "KHR_materials_clearcoat": {
                "clearcoatFactor": 1, "clearcoatTexture": texture(),
                "clearcoatRoughnessFactor": 0.25, "clearcoatRoughnessTexture": texture(),
            },
            "KHR_materials_sheen": {
                "sheenColorFactor": [1, 1, 1], "sheenColorTexture": texture(),
                "sheenRoughnessFactor": 1, "sheenRoughnessTexture": texture(),
            },
        },
    }));
    let Model { scene, warnings } = read(&file);
    assert_eq!((scene.images.len(), warnings.len()), (1, 0), "{warnings:?}");
    let material = &scene.materials[0];
    let shown = |paint| {
        let (_, image) = texture_of(&scene, paint);
        (image.channels, image.encoding, image.tint)
    };
    let number = |channels, tint| (channels, Encoding::Linear, Rgb::gray(tint));
    let found = principled(material);
    assert_eq!(shown(found.metallic), number(Channels::Blue, 0.5));
    assert_eq!(shown(found.roughness), number(Channels::Green, 1.0));
    assert_eq!(shown(found.specular), number(Channels::Alpha, 1.0));
    assert_eq!(shown(found.transmission), number(Channels::Red, 1.0));
    assert_eq!(shown(found.clearcoat), number(Channels::Red, 1.0));
    assert_eq!(shown(found.clearcoat_roughness), number(Channels::Green, 0.25));
    assert_eq!(shown(found.sheen_roughness), number(Channels::Alpha, 1.0));
    for color in [found.specular_color, found.sheen_color, material.emission.color] {
        assert_eq!(shown(color), (Channels::Color, Encoding::Srgb, Rgb::WHITE));
    }
    let Some(Relief::NormalMap(map)) = material.relief else { panic!("{:?}", material.relief) };
    assert_eq!((shown(map.texture), map.strength), (number(Channels::Color, 1.0), 0.5));
}

#[test]
fn what_is_not_used_is_said() {
    let mut file = File::new();
    let image = file.texture(1, &[[0, 51, 255, 255]]);
    let texture = || json!({ "index": image });
    file.show_triangle(json!({
        "occlusionTexture": texture(),
        "emissiveFactor": [1, 1, 1],
        "emissiveTexture": texture(),
        "normalTexture": { "index": image, "texCoord": 1 },
        "extensions": {
            "KHR_materials_volume": { "thicknessFactor": 1, "thicknessTexture": texture() },
            "KHR_materials_clearcoat": { "clearcoatFactor": 1, "clearcoatNormalTexture": texture() },
        },
    }));
    let warnings = read(&file).warnings;
    assert_eq!(warnings.len(), 4, "{warnings:?}");
    assert!(warnings.iter().all(|warning| warning.ends_with("(materials[0])")), "{warnings:?}");
}

/// Red and green are x and y of directions, blue the strength; the rotation comes on top.
#[test]
fn anisotropy_textures_turn() {
    let mut file = File::new();
    // Along x, along y, against x.
    let texture = file.texture(1, &[[255, 128, 255, 255], [128, 255, 51, 255], [0, 128, 0, 255]]);
    let turned = json!({ "anisotropyStrength": 0.5, "anisotropyRotation": std::f64::consts::FRAC_PI_2,
        "anisotropyTexture": { "index": texture } });
    file.show_triangle(json!({ "extensions": { "KHR_materials_anisotropy": turned } }));
    let model = read(&file);
    let material = principled(&model.scene.materials[0]);
    let (_, strength) = texture_of(&model.scene, material.anisotropy);
    assert_eq!((strength.channels, strength.tint), (Channels::Blue, Rgb::gray(0.5)));
    let (_, turned) = texture_of(&model.scene, material.anisotropy_rotation);
    assert_eq!(turned.filter, Filter::Nearest);
    let bitmap = &model.scene.images[turned.image.0 as usize].bitmap;
    let Texels::U16(turns) = &bitmap.texels else { panic!("{bitmap:?}") };
    for (found, expected) in turns.iter().zip([0.25, 0.5, 0.75]) {
        let found = f64::from(found[0]) / 65_535.0;
        assert!((found - expected).abs() < 1e-3, "{found}, not {expected}");
    }
    assert!(model.warnings.is_empty(), "{:?}", model.warnings);
}

#[test]
fn base_color_textures() {
    let mut file = File::new();
    let texture = file.texture(1, &[[255, 0, 0, 255], [0, 255, 0, 255]]);
    let sampler = json!({ "wrapS": 33071, "wrapT": 33071, "magFilter": 9728 });
    let sampler = file.push("samplers", sampler);
    file.json["textures"][texture]["sampler"] = json!(sampler);
    let pbr = json!({ "baseColorFactor": [1, 0.5, 0.5, 0.5], "baseColorTexture": { "index": texture } });
    file.show_triangle(json!({ "pbrMetallicRoughness": pbr }));
    let model = read(&file);
    let (texture, image) = texture_of(&model.scene, principled(&model.scene.materials[0]).base_color);
    assert_eq!((image.wrap, image.filter, image.encoding), (Wrap::Clamp, Filter::Nearest, Encoding::Srgb));
    assert_eq!((image.tint, image.channels), (Rgb::new(1.0, 0.5, 0.5), Channels::Color));
    assert!(texture.transform.steps.is_empty());
    assert_eq!(model.scene.images[0].file, "model.gltf#images[0]");
    // Opaque, whatever alpha says.
    assert_eq!(model.scene.materials[0].opacity, Paint::Color(Rgb::WHITE));
    assert!(model.warnings.is_empty());
}

#[test]
fn the_set_of_texture_coordinates_is_that_of_the_texture() {
    let mut file = File::new();
    let texture = file.texture(1, &[[255; 4]]);
    let mut material = json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": texture, "texCoord": 1 } } });
    file.show_triangle(material.clone());
    let second = file.floats(&[[0.5, 0.5], [0.25, 0.25], [0.0, 1.0]]);
    file.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] = json!(second);
    let expected = [[0.5, 0.5], [0.25, 0.75], [0.0, 0.0]];
    assert_eq!(only_mesh(&read(&file)).uvs, expected);
    material["pbrMetallicRoughness"]["baseColorTexture"] =
        json!({ "index": texture, "extensions": { "KHR_texture_transform": { "texCoord": 1 } } });
    file.json["materials"][0] = material;
    assert_eq!(only_mesh(&read(&file)).uvs, expected);
    file.json["materials"][0] = json!({});
    assert_eq!(only_mesh(&read(&file)).uvs, [[0.0, 1.0], [1.0, 1.0], [0.25, 0.25]]);
}

/// The place on the image, v downwards, that a texture shows at texture coordinates, v downwards.
fn place_on_image(texture: &Texture, u: f64, v: f64) -> [f64; 2] {
    let place = texture.transform.to_affine().inverse().transform_point3(DVec3::new(u, 1.0 - v, 0.0));
    [place.x, 1.0 - place.y]
}

#[test]
fn texture_transforms() {
    let with = |transform: Value| {
        let mut file = File::new();
        let texture = file.texture(1, &[[255; 4]]);
        let texture = json!({ "index": texture, "extensions": { "KHR_texture_transform": transform } });
        file.show_triangle(json!({ "pbrMetallicRoughness": { "baseColorTexture": texture } }));
        let scene = read(&file).scene;
        texture_of(&scene, principled(&scene.materials[0]).base_color).0.clone()
    };
    let near = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).abs() < 1e-9 && (a[1] - b[1]).abs() < 1e-9;
    let moved = with(json!({ "offset": [0.25, 0.5], "scale": [2, 4] }));
    assert!(near(place_on_image(&moved, 0.0, 0.0), [0.25, 0.5]));
    assert!(near(place_on_image(&moved, 1.0, 1.0), [2.25, 4.5]));
    // The example of the extension: "only the lower left quadrant of the source image, rotated clockwise 90°".
    let quarter = std::f64::consts::FRAC_PI_2;
    let quadrant = with(json!({ "offset": [0, 1], "rotation": quarter, "scale": [0.5, 0.5] }));
    assert!(near(place_on_image(&quadrant, 0.0, 0.0), [0.0, 1.0]));
    assert!(near(place_on_image(&quadrant, 1.0, 0.0), [0.0, 0.5]));
    assert!(near(place_on_image(&quadrant, 1.0, 1.0), [0.5, 0.5]));
    assert!(with(json!({ "offset": [0, 0] })).transform.steps.is_empty());
    let palette = with(json!({ "offset": [0.25, 0.5], "scale": [0, 0] }));
    let place = place_on_image(&palette, 0.7, 0.1);
    assert!((place[0] - 0.25).abs() < 1e-5 && (place[1] - 0.5).abs() < 1e-5, "{place:?}");
}

/// A material with a base color texture of one opaque and one nearly clear pixel.
fn with_alpha(mode: &str, factor: f32, alpha: u8) -> (File, Scene) {
    let mut file = File::new();
    let texture = file.texture(2, &[[255, 0, 0, 255], [0, 0, 0, alpha]]);
    let pbr = json!({ "baseColorFactor": [1, 1, 1, factor], "baseColorTexture": { "index": texture } });
    file.show_triangle(json!({ "pbrMetallicRoughness": pbr, "alphaMode": mode, "alphaCutoff": 0.25 }));
    let scene = read(&file).scene;
    (file, scene)
}

#[test]
fn blended_alpha() {
    let pbr = json!({ "baseColorFactor": [1, 1, 1, 0.25] });
    let plain = material_of(json!({ "pbrMetallicRoughness": pbr, "alphaMode": "BLEND" }));
    assert_eq!(plain.opacity, gray(0.25));

    let (_, scene) = with_alpha("BLEND", 0.5, 100);
    let (_, image) = texture_of(&scene, scene.materials[0].opacity);
    assert_eq!((image.channels, image.tint, image.image.0), (Channels::Alpha, Rgb::gray(0.5), 0));

    // An image without alpha leaves the factor alone.
    let (_, scene) = with_alpha("BLEND", 0.5, 255);
    assert_eq!((scene.textures.len(), scene.materials[0].opacity), (1, gray(0.5)));
}

#[test]
fn masks() {
    let (_, scene) = with_alpha("MASK", 1.0, 63);
    let (_, image) = texture_of(&scene, scene.materials[0].opacity);
    let alpha = scene.images[image.image.0 as usize].bitmap.alpha.as_ref().unwrap();
    assert_eq!((alpha.get(0), alpha.get(1), scene.images.len()), (1.0, 0.0, 2));

    let (_, scene) = with_alpha("MASK", 1.0, 64);
    let (_, image) = texture_of(&scene, scene.materials[0].opacity);
    let alpha = scene.images[image.image.0 as usize].bitmap.alpha.as_ref().unwrap();
    assert_eq!((alpha.get(0), alpha.get(1)), (1.0, 1.0));

    let (_, scene) = with_alpha("MASK", 0.0, 64);
    assert_eq!(scene.materials[0].opacity, Paint::Color(Rgb::BLACK));
    let plain = material_of(json!({ "alphaMode": "MASK" }));
    assert_eq!(plain.opacity, Paint::Color(Rgb::WHITE));
    let (mut file, _) = with_alpha("MASK", 1.0, 0);
    file.json["materials"][0]["alphaMode"] = json!("HIDE");
    assert_eq!(fault(&file), "materials[0]: alphaMode must be OPAQUE, MASK or BLEND");
}

#[test]
fn images_that_cannot_be_used() {
    let with = |change: &dyn Fn(&mut File)| {
        let (mut file, _) = with_alpha("OPAQUE", 1.0, 0);
        change(&mut file);
        file
    };
    let broken = with(&|file| file.json["bufferViews"][0]["byteLength"] = json!(50));
    assert!(fault(&broken).starts_with("images[0]: "), "{}", fault(&broken));
    let unknown = with(&|file| file.json["bufferViews"][0]["byteLength"] = json!(3));
    assert_eq!(fault(&unknown), "images[0]: not a PNG, JPEG, HDR, EXR or PFM file");
    let nowhere = with(&|file| file.json["images"][0] = json!({}));
    assert_eq!(fault(&nowhere), "images[0]: this image has neither `uri` nor `bufferView`");
    let remote = with(&|file| file.json["images"][0] = json!({ "uri": "http://example.org/a.png" }));
    assert_eq!(fault(&remote), "images[0]: `http:` addresses are not followed");
    let compressed = with(&|file| file.json["textures"][0] = json!({}));
    let model = read(&compressed);
    assert_eq!(principled(&model.scene.materials[0]).base_color, Paint::Color(Rgb::WHITE));
    assert!(model.warnings[0].starts_with("textures are left out that have no PNG or JPEG image"));
}

//! Materials and textures.

use super::build::File;
use super::{fault, only_mesh, read};
use durer_math::{DVec3, Rgb};
use durer_scene::{
    Channels, Classic, Emission, Encoding, Filter, ImageTexture, Material, MaterialKind, Paint, Pattern, Scene,
    Texture, TextureId, Wrap,
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

#[test]
fn matte_plastic() {
    let pbr = json!({ "baseColorFactor": [0.5, 0.25, 1, 1], "metallicFactor": 0, "roughnessFactor": 1 });
    let material = material_of(json!({ "pbrMetallicRoughness": pbr }));
    assert_eq!(material.as_classic().unwrap().color, Paint::Color(Rgb::new(0.5, 0.25, 1.0)));
    assert_eq!(
        (
            material.as_classic().unwrap().diffuse,
            material.as_classic().unwrap().ambient,
            material.as_classic().unwrap().shininess
        ),
        (1.0, 0.2, 1.0)
    );
    // 0.04 · (1 + 2) / 2
    assert!(
        near(material.as_classic().unwrap().specular, Rgb::gray(0.06)),
        "{:?}",
        material.as_classic().unwrap().specular
    );
    assert_eq!(
        (material.as_classic().unwrap().reflection, material.as_classic().unwrap().transparency, material.emission),
        Default::default()
    );
    assert_eq!(material.opacity, Paint::Color(Rgb::WHITE));
}

#[test]
fn glossy_plastic() {
    let pbr = json!({ "metallicFactor": 0, "roughnessFactor": 0.2 });
    let material = material_of(json!({ "pbrMetallicRoughness": pbr }));
    // α = 0.04: (1/0.0016 - 1)/2
    assert!(
        (material.as_classic().unwrap().shininess - 312.0).abs() < 0.01,
        "{}",
        material.as_classic().unwrap().shininess
    );
    assert!(near(material.as_classic().unwrap().specular, Rgb::WHITE));
    assert!(near(material.as_classic().unwrap().reflection, Rgb::gray(0.04 * 0.64)));
    assert_eq!(material.as_classic().unwrap().diffuse, 1.0);
}

#[test]
fn metal() {
    let gold = json!({ "baseColorFactor": [1, 0.75, 0.5, 1], "roughnessFactor": 0.5 });
    let material = material_of(json!({ "pbrMetallicRoughness": gold }));
    assert!(near(material.as_classic().unwrap().reflection, Rgb::new(0.25, 0.1875, 0.125)));
    assert!(near(material.as_classic().unwrap().specular, Rgb::new(0.5, 0.375, 0.25)));
    assert!(
        (material.as_classic().unwrap().diffuse - 0.75).abs() < 1e-6
            && (material.as_classic().unwrap().ambient - 0.15).abs() < 1e-6
    );
    let mirror = material_of(json!({ "pbrMetallicRoughness": { "roughnessFactor": 0 } }));
    assert_eq!(
        (
            mirror.as_classic().unwrap().reflection,
            mirror.as_classic().unwrap().diffuse,
            mirror.as_classic().unwrap().shininess
        ),
        (Rgb::WHITE, 0.0, 10_000.0)
    );
}

#[test]
fn glass_with_a_thickness_refracts() {
    let pbr = json!({ "metallicFactor": 0, "roughnessFactor": 0 });
    let volume = json!({ "thicknessFactor": 1, "attenuationColor": [0.5, 1, 0], "attenuationDistance": 2 });
    let glass = material_of(json!({ "pbrMetallicRoughness": pbr, "extensions": {
        "KHR_materials_transmission": { "transmissionFactor": 1 },
        "KHR_materials_ior": { "ior": 1.25 },
        "KHR_materials_volume": volume,
    }}));
    assert_eq!(
        (
            glass.as_classic().unwrap().transparency,
            glass.as_classic().unwrap().ior,
            glass.as_classic().unwrap().fresnel
        ),
        (Rgb::WHITE, Some(1.25), true)
    );
    assert_eq!((glass.as_classic().unwrap().diffuse, glass.as_classic().unwrap().reflection), (0.0, Rgb::BLACK));
    let attenuation = glass.as_classic().unwrap().attenuation.unwrap();
    assert_eq!((attenuation.color, attenuation.distance), (Rgb::new(0.5, 1.0, 1e-4), 2.0));
}

#[test]
fn glass_without_thickness_is_a_sheet() {
    let pbr = json!({ "metallicFactor": 0, "roughnessFactor": 0, "baseColorFactor": [1, 0.5, 0.5, 1] });
    let sheet = material_of(json!({ "pbrMetallicRoughness": pbr, "extensions": {
        "KHR_materials_transmission": { "transmissionFactor": 0.5 },
    }}));
    assert!(near(sheet.as_classic().unwrap().transparency, Rgb::new(0.5, 0.25, 0.25)));
    assert_eq!(
        (sheet.as_classic().unwrap().ior, sheet.as_classic().unwrap().fresnel, sheet.as_classic().unwrap().attenuation),
        (None, false, None)
    );
    assert!(near(sheet.as_classic().unwrap().reflection, Rgb::gray(0.04)));
    // What is left of the surface itself is to be half: 0.5 / (1 - 0.303).
    assert!((sheet.as_classic().unwrap().diffuse - 0.717_46).abs() < 1e-4, "{}", sheet.as_classic().unwrap().diffuse);
}

#[test]
fn a_different_reflectance() {
    let pbr = json!({ "metallicFactor": 0, "roughnessFactor": 0 });
    let specular = json!({ "specularFactor": 0.5, "specularColorFactor": [1, 2, 100] });
    let material = material_of(json!({ "pbrMetallicRoughness": pbr, "extensions": {
        "KHR_materials_ior": { "ior": 3 },
        "KHR_materials_specular": specular,
    }}));
    assert!(near(material.as_classic().unwrap().reflection, Rgb::new(0.125, 0.25, 0.5)));
}

#[test]
fn specular_and_glossiness() {
    let extension = json!({
        "diffuseFactor": [0.5, 0.5, 0.5, 1],
        "specularFactor": [1, 0.5, 0.25],
        "glossinessFactor": 0.5,
    });
    let material = material_of(json!({ "extensions": { "KHR_materials_pbrSpecularGlossiness": extension } }));
    assert_eq!(
        (material.as_classic().unwrap().color, material.as_classic().unwrap().diffuse),
        (Paint::Color(Rgb::gray(0.5)), 1.0)
    );
    assert!(near(material.as_classic().unwrap().reflection, Rgb::new(0.25, 0.125, 0.0625)));
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
    assert_eq!(material.emission, Emission::of(Rgb::new(8.0, 4.0, 0.0)));
}

#[test]
fn textures_of_which_only_the_mean_is_used() {
    let mut file = File::new();
    let glow = file.texture(2, &[[255, 0, 0, 255], [255, 255, 0, 255]]);
    // Roughness in green, metal in blue.
    let rough = file.texture(2, &[[0, 51, 255, 255], [0, 153, 255, 255]]);
    file.show_triangle(json!({
        "pbrMetallicRoughness": { "metallicRoughnessTexture": { "index": rough }, "metallicFactor": 0.5 },
        "emissiveFactor": [1, 1, 1],
        "emissiveTexture": { "index": glow },
        "normalTexture": { "index": glow },
        "occlusionTexture": { "index": glow },
    }));
    let model = read(&file);
    let material = &model.scene.materials[0];
    let Paint::Color(emission) = material.emission.color else { panic!("{:?}", material.emission) };
    assert!(near(emission, Rgb::new(1.0, 0.5, 0.0)));
    // Roughness (0.2 + 0.6)/2, metal 0.5: 1 - 0.5 · 0.6²
    assert!((material.as_classic().unwrap().diffuse - 0.82).abs() < 1e-6, "{}", material.as_classic().unwrap().diffuse);
    assert!(model.scene.images.is_empty() && model.scene.textures.is_empty());
    assert_eq!(model.warnings.len(), 4, "{:?}", model.warnings);
    assert!(model.warnings.iter().all(|warning| warning.ends_with("(materials[0])")));
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
    let (texture, image) = texture_of(&model.scene, model.scene.materials[0].as_classic().unwrap().color);
    assert_eq!((image.wrap, image.filter, image.encoding), (Wrap::Clamp, Filter::Nearest, Encoding::Srgb));
    assert_eq!((image.tint, image.channels), (Rgb::new(1.0, 0.5, 0.5), Channels::Color));
    assert!(texture.transform.steps.is_empty());
    assert_eq!(model.scene.images[0].file, "model.gltf#images[0]");
    // Opaque, whatever alpha says.
    assert_eq!(model.scene.materials[0].opacity, Paint::Color(Rgb::WHITE));
    assert_eq!(model.scene.materials[0].as_classic().unwrap().transparency, Rgb::BLACK);
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
        texture_of(&scene, scene.materials[0].as_classic().unwrap().color).0.clone()
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
    assert_eq!((plain.as_classic().unwrap().transparency, plain.opacity), (Rgb::gray(0.75), Paint::Color(Rgb::WHITE)));

    let (_, scene) = with_alpha("BLEND", 0.5, 100);
    assert_eq!(scene.materials[0].as_classic().unwrap().transparency, Rgb::BLACK);
    let (_, image) = texture_of(&scene, scene.materials[0].opacity);
    assert_eq!((image.channels, image.tint, image.image.0), (Channels::Alpha, Rgb::gray(0.5), 0));

    // An image without alpha needs no opacity.
    let (_, scene) = with_alpha("BLEND", 0.5, 255);
    assert_eq!((scene.textures.len(), scene.materials[0].as_classic().unwrap().transparency), (1, Rgb::gray(0.5)));
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
    assert_eq!(model.scene.materials[0].as_classic().unwrap().color, Paint::Color(Rgb::WHITE));
    assert!(model.warnings[0].starts_with("textures are left out that have no PNG or JPEG image"));
}

use super::super::testing::{Chance, Files};
use super::*;

const PICTURE: &[u8] = b"PF\n1 1\n-1.0\n\0\0\0\0\0\0\0\0\0\0\0\0";

/// The material `m` of a library beside `dir/a.obj`, what it refers to, and the warnings.
fn read(text: &str, files: &[(&str, &[u8])]) -> (Material, Scene, Vec<String>) {
    let files: Vec<(&str, &[u8])> = [("dir/a.mtl", text.as_bytes())].into_iter().chain(files.iter().copied()).collect();
    let (files, limits) = (Files(&files), Limits::default());
    let mut warnings = Warnings::default();
    let mut library = Library::new("dir/a.obj", &files, &limits);
    library.open("a.mtl", &mut warnings);
    let id = library.material("m", &mut warnings).expect("a material");
    (library.scene.materials[id.0 as usize].clone(), library.scene, warnings.into_list())
}

/// The material with these statements, without images or warnings.
#[track_caller]
fn material(statements: &str) -> Material {
    let (material, _, warnings) = read(&format!("newmtl m\n{statements}\n"), &[]);
    assert_eq!(warnings, [""; 0]);
    material
}

fn gray(material: &Material) -> f32 {
    match material.as_classic().unwrap().color {
        Paint::Color(color) => color.r,
        Paint::Texture(_) => panic!("a texture"),
    }
}

#[test]
fn what_is_no_usable_number_is_left_out_and_said() {
    let sound = material("Kd 0.5 0.25 0");
    for nonsense in
        ["Kd 1 nan 0", "Kd 1 -1 0", "Kd 1 2", "Ke -5 0 0", "d -1", "d 7", "Tr 2", "Ni -3", "Ns 1e99", "illum 11"]
    {
        let (found, _, warnings) = read(&format!("newmtl m\nKd 0.5 0.25 0\n{nonsense}\n"), &[]);
        assert_eq!(found, sound, "{nonsense}");
        assert!(warnings.len() == 1 && warnings[0].contains("is no usable number"), "{nonsense}: {warnings:?}");
    }
}

#[test]
fn a_matte_surface_gives_back_its_color() {
    let plain = material("Kd 0.25 0.5 1");
    assert_eq!(plain.as_classic().unwrap().color, Paint::Color(Rgb::new(0.25, 0.5, 1.0)));
    assert_eq!(
        (
            plain.as_classic().unwrap().diffuse,
            plain.as_classic().unwrap().specular,
            plain.as_classic().unwrap().reflection
        ),
        (1.0, Rgb::BLACK, Rgb::BLACK)
    );
    assert_eq!(
        (plain.as_classic().unwrap().transparency, plain.as_classic().unwrap().ior, plain.emission),
        (Rgb::BLACK, None, Emission::NONE)
    );
    assert_eq!(plain.name, None);
    assert_eq!(gray(&material("Kd 0.5")), 0.5, "one number is gray");
    assert_eq!(gray(&material("Kd 7 7 7")), 1.0);
}

#[test]
fn highlights_follow_the_model_of_illumination() {
    let shiny = |model: &str| material(&format!("Kd 1 1 1\nKs 0.5 0.4 0.3\nNs 96.5\n{model}"));
    for model in ["", "illum 2", "illum 3", "illum 5"] {
        assert_eq!(
            (shiny(model).as_classic().unwrap().specular, shiny(model).as_classic().unwrap().shininess),
            (Rgb::new(0.5, 0.4, 0.3), 96.5)
        );
    }
    assert_eq!(shiny("illum 1").as_classic().unwrap().specular, Rgb::BLACK);
    assert_eq!(
        (shiny("illum 2").as_classic().unwrap().reflection, shiny("illum 3").as_classic().unwrap().reflection),
        (Rgb::BLACK, Rgb::new(0.5, 0.4, 0.3))
    );
}

#[test]
fn ambient_light_is_a_part_of_the_usual() {
    let usual = Material::default().as_classic().unwrap().ambient;
    for all in ["", "Ka 0.5 0.5 0.5", "Ka 1 1 1", "Ka 0 0 0"] {
        assert!(
            (material(&format!("Kd 0.5 0.5 0.5\n{all}")).as_classic().unwrap().ambient - usual).abs() < 1e-7,
            "{all}"
        );
    }
    assert!((material("Kd 0.5 0.5 0.5\nKa 0.1 0.1 0.1").as_classic().unwrap().ambient - 0.2 * usual).abs() < 1e-7);
}

#[test]
fn surfaces_that_are_not_whole_show_what_is_behind() {
    assert_eq!(material("d 0.25").as_classic().unwrap().transparency, Rgb::gray(0.75));
    assert_eq!(material("Tr 0.25").as_classic().unwrap().transparency, Rgb::gray(0.25));
    assert_eq!(material("d 1\nTr 1").as_classic().unwrap().transparency, Rgb::BLACK, "d counts");
    assert_eq!(material("d 0.5\nTf 1 0.5 0").as_classic().unwrap().transparency, Rgb::new(0.5, 0.25, 0.0));
    assert_eq!(material("Tf 1 1 1\nillum 2").as_classic().unwrap().transparency, Rgb::BLACK);
    assert_eq!(
        (
            material("d 0.5\nNi 1.5").as_classic().unwrap().ior,
            material("d 0.5\nNi 1.5\nillum 6").as_classic().unwrap().ior
        ),
        (None, Some(1.5))
    );
}

#[test]
fn glass_refracts_and_reflects() {
    let bent = material("d 0.1\nKs 0.2 0.2 0.2\nNi 1.5\nillum 6");
    assert_eq!(
        (bent.as_classic().unwrap().ior, bent.as_classic().unwrap().fresnel, bent.as_classic().unwrap().reflection),
        (Some(1.5), false, Rgb::gray(0.2))
    );
    let glass = material("d 0.1\nKs 0.2 0.2 0.2\nNi 1.5\nillum 7");
    assert_eq!(
        (glass.as_classic().unwrap().ior, glass.as_classic().unwrap().fresnel, glass.as_classic().unwrap().reflection),
        (Some(1.5), true, Rgb::BLACK)
    );
    let filter = material("Tf 0.8 0.8 1\nKs 0.5 0.5 0.5\nNi 1.33\nillum 7");
    assert_eq!(
        (filter.as_classic().unwrap().transparency, filter.as_classic().unwrap().ior),
        (Rgb::new(0.4, 0.4, 0.5), Some(1.33))
    );
    assert_eq!(material("d 0.5\nNi 1\nillum 7").as_classic().unwrap().ior, None);
    assert_eq!(material("d 0.5\nNi 99\nillum 7").as_classic().unwrap().ior, None);
}

#[test]
fn surfaces_may_glow() {
    assert_eq!(material("Ke 3 2 1").emission, Emission::of(Rgb::new(3.0, 2.0, 1.0)));
}

#[test]
fn images_lie_on_the_surface() {
    let text = "newmtl m\nKd 0.5 1 1\nmap_Kd -s 2 4 1 -o 0.5 0.25 -clamp on textures\\my wood.pfm\nmap_d mask.pfm\n";
    let files = [("dir/textures/my wood.pfm", PICTURE), ("dir/mask.pfm", PICTURE)];
    let (material, scene, warnings) = read(text, &files);
    assert_eq!(warnings, [""; 0]);
    assert_eq!(
        (material.as_classic().unwrap().color, material.opacity),
        (Paint::Texture(TextureId(0)), Paint::Texture(TextureId(1)))
    );
    let names: Vec<&str> = scene.images.iter().map(|image| image.file.as_str()).collect();
    assert_eq!(names, ["dir/textures/my wood.pfm", "dir/mask.pfm"]);
    let Pattern::Image(color) = &scene.textures[0].pattern else { panic!("an image") };
    assert_eq!((color.image, color.wrap, color.encoding), (ImageId(0), Wrap::Clamp, Encoding::Srgb));
    assert_eq!(color.tint, Rgb::new(0.5, 1.0, 1.0));
    // The place of the image's corner (0, 0), and of (1, 1): scale · uv + offset is there.
    let uv_from_image = scene.textures[0].transform.to_affine();
    for corner in [0.0, 1.0] {
        let uv = uv_from_image.transform_point3(DVec3::new(corner, corner, 0.0));
        assert_eq!((2.0 * uv.x + 0.5, 4.0 * uv.y + 0.25), (corner, corner));
    }
    let Pattern::Image(mask) = &scene.textures[1].pattern else { panic!("an image") };
    assert_eq!((mask.encoding, mask.channels, mask.wrap), (Encoding::Linear, Channels::Color, Wrap::Repeat));
}

#[test]
fn options_of_images_are_skipped_with_their_arguments() {
    let options =
        "-blendu on -blendv off -cc on -mm 0 1 -t 1 1 -texres 512 -bm 0.5 -imfchan l -type sphere -o 1 -boost 2";
    let (material, scene, warnings) = read(&format!("newmtl m\nmap_Kd {options} a.pfm"), &[("dir/a.pfm", PICTURE)]);
    assert_eq!((material.as_classic().unwrap().color, scene.images.len()), (Paint::Texture(TextureId(0)), 1));
    assert_eq!(warnings.len(), 10, "{warnings:?}");
}

#[test]
fn an_image_is_read_once_and_may_lie_beside_the_model() {
    let text = "newmtl m\nKd 0 0 0\nmap_Kd C:\\Users\\me\\wood.pfm\nmap_d C:\\Users\\me\\wood.pfm\n";
    let (_, scene, warnings) = read(text, &[("dir/wood.pfm", PICTURE)]);
    assert_eq!((scene.images.len(), scene.textures.len(), warnings.len()), (1, 2, 0));
    let Pattern::Image(image) = &scene.textures[0].pattern else { panic!("an image") };
    assert_eq!(image.tint, Rgb::WHITE, "black beside an image is not meant");
}

#[test]
fn images_that_cannot_be_had_leave_the_color() {
    let text = "newmtl m\nKd 0.5 0.5 0.5\nmap_Kd gone.png\nmap_d bad.png\n";
    let (material, scene, warnings) = read(text, &[("dir/bad.png", b"no picture")]);
    assert_eq!((gray(&material), material.opacity, scene.images.len()), (0.5, Paint::Color(Rgb::WHITE), 0));
    assert_eq!(warnings.len(), 2);
    assert!(warnings[0].contains("cannot read the image `gone.png`: there is no such file"), "{warnings:?}");
    assert!(warnings[1].contains("cannot use the image `bad.png`: not a PNG"), "{warnings:?}");
}

#[test]
fn each_kind_of_statement_that_is_left_out_is_said_once() {
    let text = "Kd 1 1 1\nnewmtl m\nmap_Bump a.png\nbump b.png\nmap_Bump c.png\nPr 0.5\nKs spectral f.rfl\nd -halo 0.5\n\
                illum x\nmap_Ka a.png\nsharpness 60\nnewmtl n\nPr 1\n";
    let (material, _, warnings) = read(text, &[]);
    let expected = ["before its first", "`map_Bump`", "`bump`", "`Pr`", "a `Ks`", "-halo", "a `illum`"];
    assert_eq!(warnings.len(), expected.len(), "{warnings:?}");
    for (warning, expected) in warnings.iter().zip(expected) {
        assert!(warning.contains(expected), "{warning}, not {expected}");
    }
    assert_eq!(material.as_classic().unwrap().transparency, Rgb::gray(0.5));
}

#[test]
fn a_name_that_comes_again_is_a_new_material() {
    let (material, _, _) = read("newmtl m\nKd 1 1 1\nKs 1 1 1\nnewmtl m\nKd 0.5 0.5 0.5\n", &[]);
    assert_eq!((gray(&material), material.as_classic().unwrap().specular), (0.5, Rgb::BLACK));
}

#[test]
fn broken_libraries_never_panic() {
    let good = b"newmtl m\nKd 1 0.5 0\nKs 1 1 1\nNs 10\nd 0.5\nTf 1 1 1\nNi 1.5\nillum 7\nKe 1 1 1\nmap_Kd -s 1 1 -o 0 a.pfm\n";
    let limits = Limits::default();
    let attempt = |bytes: &[u8]| {
        let files: [(&str, &[u8]); 2] = [("a.mtl", bytes), ("a.pfm", PICTURE)];
        let files = Files(&files);
        let mut library = Library::new("a.obj", &files, &limits);
        let mut warnings = Warnings::default();
        library.open("a.mtl", &mut warnings);
        library.material("m", &mut warnings);
        // Materials of any file are those of a scene that passes its check.
        let scene = Scene {
            materials: library.scene.materials,
            ..Scene { textures: library.scene.textures, images: library.scene.images, ..Scene::default() }
        };
        assert!(scene.check().is_ok(), "{}", String::from_utf8_lossy(bytes));
    };
    (0..good.len()).for_each(|length| attempt(&good[..length]));
    let mut chance = Chance(5);
    for _ in 0..3000 {
        let mut bytes = good.to_vec();
        for _ in 0..=chance.below(3) {
            let at = chance.below(bytes.len());
            match chance.below(3) {
                0 => bytes[at] = chance.below(256) as u8,
                1 => bytes[at] = b"0123456789.-e \n"[chance.below(15)],
                _ => drop(bytes.splice(at..at, *b"1e30 ")),
            }
        }
        attempt(&bytes);
    }
}

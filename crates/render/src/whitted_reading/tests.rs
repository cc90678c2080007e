use super::*;
use durer_scene::{MetalName, Scene};

fn gray(amount: f32) -> Paint {
    Paint::Color(Rgb::gray(amount))
}

fn read(kind: &MaterialKind) -> Classic {
    whitted(kind, &mut Means::new(&Scene::default()))
}

fn read_principled(metallic: f32, roughness: f32, more: impl FnOnce(&mut Principled)) -> Classic {
    let base = Principled {
        base_color: gray(1.0),
        metallic: gray(metallic),
        roughness: gray(roughness),
        ..Principled::default()
    };
    let mut principled = base;
    more(&mut principled);
    read(&MaterialKind::Principled(Box::new(principled)))
}

fn near(a: Rgb, b: Rgb) -> bool {
    (a - b).map(f32::abs).max_component() < 1e-5
}

#[test]
fn dull_principled_surfaces_are_matte() {
    let dull = read_principled(0.0, 1.0, |one| one.base_color = Paint::Color(Rgb::new(0.5, 0.25, 1.0)));
    assert_eq!(dull.color, Paint::Color(Rgb::new(0.5, 0.25, 1.0)));
    assert_eq!((dull.diffuse, dull.ambient, dull.shininess), (1.0, 0.2, 1.0));
    // 0.04 · (1 + 2) / 2
    assert!(near(dull.specular, Rgb::gray(0.06)), "{:?}", dull.specular);
    assert_eq!((dull.reflection, dull.transparency), Default::default());
}

#[test]
fn glossy_principled_surfaces_have_a_highlight_and_mirror_a_little() {
    let glossy = read_principled(0.0, 0.2, |_| {});
    // α = 0.04: (1/0.0016 - 1)/2
    assert!((glossy.shininess - 312.0).abs() < 0.01, "{}", glossy.shininess);
    assert!(near(glossy.specular, Rgb::WHITE) && near(glossy.reflection, Rgb::gray(0.04 * 0.64)));
    assert_eq!(glossy.diffuse, 1.0);
}

#[test]
fn principled_metals_mirror_in_their_color() {
    let gold = read_principled(1.0, 0.5, |one| one.base_color = Paint::Color(Rgb::new(1.0, 0.75, 0.5)));
    assert!(near(gold.reflection, Rgb::new(0.25, 0.1875, 0.125)));
    assert!(near(gold.specular, Rgb::new(0.5, 0.375, 0.25)));
    assert!((gold.diffuse - 0.75).abs() < 1e-6 && (gold.ambient - 0.15).abs() < 1e-6);
    let mirror = read_principled(1.0, 0.0, |_| {});
    assert_eq!((mirror.reflection, mirror.diffuse, mirror.shininess), (Rgb::WHITE, 0.0, 10_000.0));
}

#[test]
fn principled_glass_refracts_unless_it_is_thin() {
    let attenuation = Some(Attenuation { color: Rgb::new(0.5, 1.0, 1e-4), distance: 2.0 });
    let glass = read_principled(0.0, 0.0, |one| {
        (one.transmission, one.ior, one.attenuation) = (gray(1.0), 1.25, attenuation);
    });
    assert_eq!((glass.transparency, glass.ior, glass.fresnel), (Rgb::WHITE, Some(1.25), true));
    assert_eq!((glass.diffuse, glass.reflection, glass.attenuation), (0.0, Rgb::BLACK, attenuation));

    let sheet = read_principled(0.0, 0.0, |one| {
        (one.transmission, one.thin, one.attenuation) = (gray(0.5), true, attenuation);
        one.base_color = Paint::Color(Rgb::new(1.0, 0.5, 0.5));
    });
    // What is mirrored does not pass.
    assert!(near(sheet.transparency, Rgb::new(0.48, 0.24, 0.24)) && near(sheet.reflection, Rgb::gray(0.04)));
    assert_eq!((sheet.ior, sheet.fresnel, sheet.attenuation), (None, false, None));
    // What is left of the surface itself is to be half: 0.5 / (1 - 0.303).
    assert!((sheet.diffuse - 0.717_46).abs() < 1e-4, "{}", sheet.diffuse);
}

#[test]
fn principled_reflectance_follows_the_index_and_what_tints_it() {
    let odd = read_principled(0.0, 0.0, |one| {
        (one.ior, one.specular) = (3.0, gray(0.5));
        one.specular_color = Paint::Color(Rgb::new(1.0, 2.0, 100.0));
    });
    assert!(near(odd.reflection, Rgb::new(0.125, 0.25, 0.5)));
}

#[test]
fn a_clear_coat_mirrors_above_what_is_dull() {
    let coated = read_principled(0.0, 1.0, |one| one.clearcoat = gray(1.0));
    assert!(near(coated.reflection, Rgb::gray(0.04)) && near(coated.specular, Rgb::WHITE));
    assert_eq!((coated.shininess, coated.diffuse), (10_000.0, 1.0));
}

#[test]
fn metals_and_mirrors_mirror() {
    let metal = |roughness| {
        let conductor = Conductor::Named(MetalName::Gold);
        read(&MaterialKind::Metal(Metal { conductor, roughness: gray(roughness), ..Metal::default() }))
    };
    let gold = MetalName::Gold.reflectance();
    assert!(near(metal(0.0).reflection, gold) && metal(0.0).diffuse == 0.0);
    assert!(near(metal(0.5).reflection, gold * 0.25) && metal(0.5).diffuse == 0.75);
    assert_eq!((metal(1.0).reflection, metal(1.0).color), (Rgb::BLACK, Paint::Color(gold)));
    let mirror = read(&MaterialKind::Mirror(Mirror { color: gray(0.9) }));
    assert_eq!((mirror.reflection, mirror.diffuse, mirror.ambient), (Rgb::gray(0.9), 0.0, 0.0));
}

#[test]
fn glass_refracts_and_panes_do_not() {
    let body = read(&MaterialKind::Glass(Glass { color: gray(0.9), ..Glass::default() }));
    assert_eq!((body.transparency, body.ior, body.fresnel), (Rgb::gray(0.9), Some(1.5), true));
    assert_eq!((body.diffuse, body.reflection), (0.0, Rgb::BLACK));
    let pane = read(&MaterialKind::Glass(Glass { thin: true, ..Glass::default() }));
    // Both sides of a pane of index 1.5 give back 0.08 / 1.04, and let all else through.
    assert!(near(pane.reflection, Rgb::gray(0.08 / 1.04)) && near(pane.transparency, Rgb::gray(0.96 / 1.04)));
    assert_eq!((pane.ior, pane.fresnel), (None, false));
}

#[test]
fn plastic_is_matte_below_its_coat() {
    let plastic = Plastic { color: gray(0.3), ior: 1.5, roughness: gray(0.0) };
    let polished = read(&MaterialKind::Plastic(plastic));
    assert_eq!((polished.color, polished.diffuse), (gray(0.3), 1.0));
    assert!(near(polished.reflection, Rgb::gray(0.04)) && near(polished.specular, Rgb::WHITE));
    let matte = read(&MaterialKind::Matte(Matte { color: gray(0.3), roughness: gray(1.0) }));
    assert_eq!((matte.color, matte.diffuse, matte.specular), (gray(0.3), 1.0, Rgb::BLACK));
}

//! `durer check` and `durer info`.

use crate::workshop::Workshop;

#[test]
fn a_fine_scene_is_counted() {
    let workshop = Workshop::new();
    let ran = workshop.fine("check room.yaml");
    assert!(ran.stdout.starts_with("room.yaml: fine: 4 shapes, 2 lights, "), "{}", ran.stdout);
    assert_eq!(workshop.fine("check room.yaml --json").json()["fine"], true);
}

#[test]
fn a_wrong_scene_is_told_with_its_places() {
    let workshop = Workshop::new();
    let ran = workshop.fails("check bad.yaml", 3, "did you mean `radius`?");
    assert_eq!(ran.stdout, "");
    assert!(!ran.stderr.contains('\x1b'), "no color in a pipe");
    let ran = workshop.run("check bad.yaml --json");
    let report = ran.json();
    assert_eq!((ran.code, &report["fine"]), (Some(3), &false.into()));
    assert_eq!(report["diagnostics"].as_array().unwrap().len(), 2, "{report}");
    workshop.fails("check missing.yaml --json", 4, "missing.yaml");
}

#[test]
fn a_scene_is_a_file() {
    let workshop = Workshop::new();
    for words in ["check -", "info -", "explain - --pixel 0,0", "render - -o a.png"] {
        workshop.fails(words, 2, "cannot be read from standard input: give a file");
    }
    workshop.fails("check .", 4, "it is a folder");
    #[cfg(unix)]
    {
        assert!(std::process::Command::new("mkfifo").arg(workshop.path("pipe")).status().unwrap().success());
        workshop.fails("check pipe", 4, "it is not a regular file");
    }
}

#[test]
fn color_follows_the_conventions() {
    let workshop = Workshop::new();
    let colored = |variable: &str, value: &str| {
        let output = workshop.command("check bad.yaml").env(variable, value).output().unwrap();
        output.stderr.contains(&0x1b)
    };
    assert!(colored("CLICOLOR_FORCE", "1"));
    assert!(!colored("CLICOLOR_FORCE", "0"));
    assert!(!colored("NO_COLOR", "1"));
    let both = workshop.command("check bad.yaml").env("NO_COLOR", "1").env("CLICOLOR_FORCE", "1").output().unwrap();
    assert!(!both.stderr.contains(&0x1b), "NO_COLOR wins");
}

#[test]
fn info_counts_what_there_is() {
    let workshop = Workshop::new();
    let text = workshop.fine("info room.yaml").stdout;
    let expected = [
        "picture    24 × 16 pixels, srgb, depth 5, antialias none",
        "shapes     4: 1 plane, 2 spheres, 1 box",
        "groups     1",
        "textures   1: 1 checker",
        "lights     2: 1 point, 1 spot",
        "bounds     (-3, 0, -3) to (3, 2, 1)",
    ];
    for line in expected {
        assert!(text.contains(line), "no `{line}` in:\n{text}");
    }
    let json = workshop.fine("info room.yaml --json").json();
    assert_eq!((&json["shapes"]["total"], &json["shapes"]["kinds"]["sphere"]), (&4.into(), &2.into()));
    assert!(json["geometry_bytes"].as_u64().unwrap() > 0);
}

#[test]
fn images_must_be_within_reach() {
    let workshop = Workshop::new();
    workshop.fine("render room.yaml -o wall.png");
    for folder in ["scenes", "pictures"] {
        std::fs::create_dir(workshop.path(folder)).unwrap();
    }
    std::fs::rename(workshop.path("wall.png"), workshop.path("pictures/wall.png")).unwrap();
    workshop.put("scenes/a.yaml", "objects: [sphere: {material: {color: {image: {file: ../pictures/wall.png}}}}]");
    workshop.fails("info scenes/a.yaml", 3, "wall.png");
    let text = workshop.fine("info scenes/a.yaml --allow-path pictures").stdout;
    assert!(text.contains("../pictures/wall.png: 24 × 16 pixels"), "{text}");
}

#[test]
fn info_tells_what_a_picture_says_of_itself() {
    let workshop = Workshop::new();
    let words = "render room.yaml --crop 4,2,10,8 --max-depth 3 --antialias grid:2";
    for (name, samples) in [("a.png", "RGB, 8 bits each"), ("a.exr", "B half, G half, R half")] {
        workshop.fine(&format!("{words} -o {name}"));
        let text = workshop.fine(&format!("info {name}")).stdout;
        let expected = ["10 × 8 pixels", samples, "durer 0.1.0", "24x16", "4,2,10,8", "grid:2", "0.001", "srgb"];
        for part in expected {
            assert!(text.contains(part), "{part} is not in {text}");
        }
        let json = workshop.fine(&format!("info {name} --json")).json();
        assert_eq!((&json["width"], &json["height"]), (&10.into(), &8.into()));
        assert_eq!(json["metadata"]["Max depth"], "3");
        assert_eq!(json["metadata"]["Scene"].as_str().map(str::len), Some(32));
    }
    workshop.fine(&format!("{words} -o a.jpg"));
    let text = workshop.fine("info a.jpg").stdout;
    assert_eq!(text, "a.jpg\n  kind    JPEG\n  size    10 × 8 pixels\n  samples RGB, 8 bits each\n");
    workshop.put("b.png", "objects: [sphere]");
    workshop.fails("info b.png", 4, "not a PNG");
    workshop.fails("info c.png", 4, "c.png");
}

/// Not those of another integrator.
#[test]
fn settings_are_those_of_the_integrator() {
    let workshop = Workshop::new();
    assert!(workshop.fine("info room.yaml").stdout.contains("srgb, depth 5, antialias none"));
    workshop.put("path.yaml", "render: {integrator: path, noise: 0.1, seed: 4, filter: mitchell}\nobjects: [sphere]\n");
    let about = workshop.fine("info path.yaml").stdout;
    let expected = "path, depth 16, at most 4096 samples a pixel, noise 0.1, seed 4, filter mitchell:2";
    assert!(about.contains(expected) && !about.contains("antialias"), "{about}");
    let json = workshop.fine("info path.yaml --json").json();
    assert_eq!((&json["integrator"], &json["max_depth"]), (&"path".into(), &16.into()));
    assert_eq!(json["samples"]["most"], 4096);
}

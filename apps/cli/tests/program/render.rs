//! `durer render`.

use crate::workshop::Workshop;
use durer::imaging::DecodeLimits;
use durer::math::Rgb;

#[test]
fn the_picture_is_named_after_the_scene_and_one_line_tells_of_it() {
    let workshop = Workshop::new();
    let ran = workshop.fine("render room.yaml");
    assert_eq!(workshop.names(), ["bad.yaml", "room.png", "room.yaml"]);
    assert_eq!((workshop.picture("room.png").width, workshop.picture("room.png").height), (24, 16));
    assert_eq!(ran.stdout, "");
    assert_eq!(ran.stderr.lines().count(), 1, "{}", ran.stderr);
    assert!(ran.stderr.starts_with("room.png: 24 × 16 pixels") && ran.stderr.contains("384 eye"), "{}", ran.stderr);
    assert!(!ran.stderr.contains(['\r', '\x1b']), "no progress bar in a pipe");
}

#[test]
fn the_picture_of_a_scene_elsewhere_is_written_here() {
    let workshop = Workshop::new();
    std::fs::create_dir(workshop.path("scenes")).unwrap();
    std::fs::rename(workshop.path("room.yaml"), workshop.path("scenes/hall.yaml")).unwrap();
    assert_eq!(workshop.fine("render scenes/hall.yaml --quiet").stderr, "");
    assert_eq!(workshop.names(), ["bad.yaml", "hall.png", "scenes"]);
}

#[test]
fn every_format_is_written_and_read() {
    let workshop = Workshop::new();
    workshop.fine("render room.yaml -o a.pfm");
    let exact = workshop.picture("a.pfm");
    let cases = [
        ("b.png", 0.02),
        ("c.png --bit-depth 16", 1e-4),
        ("d.exr", 1e-3),
        ("e.exr --bit-depth float", 0.0),
        ("f.hdr", 0.02),
        ("g.jpg --quality 100", 0.3),
        ("h.JPEG", 0.5),
    ];
    for (file, tolerance) in cases {
        workshop.fine(&format!("render room.yaml -o {file}"));
        let picture = workshop.picture(file.split(' ').next().unwrap());
        for (a, b) in picture.pixels.iter().zip(&exact.pixels) {
            let away =
                (*a - b.map(|v| v.min(if file.starts_with(['d', 'e', 'f']) { f32::MAX } else { 1.0 }))).map(f32::abs);
            assert!(away.max_component() <= tolerance, "{file}: {a:?} is not {b:?}");
        }
    }
    let (plain, deep) = (workshop.bytes("b.png"), workshop.bytes("c.png"));
    assert_eq!((plain[24], deep[24]), (8, 16), "bit depth in the PNG header");
    assert!(plain.windows(11).any(|bytes| bytes == b"durer 0.1.0"));
}

/// The same whatever says it: a scene's own layout, name and folder, threads and instruction sets.
#[test]
fn the_same_scene_with_the_same_settings_gives_the_same_file() {
    let workshop = Workshop::new();
    let spaced = crate::workshop::ROOM.replace("[0, 1, 6]", "[0.0,   1, 6.0]");
    workshop.put("hall.yaml", &format!("# another name\n{spaced}"));
    for name in ["a.png", "a.exr"] {
        workshop.fine(&format!("render room.yaml -o {name} --threads 1"));
        let first = workshop.bytes(name);
        workshop.fine(&format!("render hall.yaml -o {name} --threads 3"));
        assert_eq!(workshop.bytes(name), first);
        workshop.fine(&format!("render room.yaml -o {name} --width 24 --antialias none"));
        assert_eq!(workshop.bytes(name), first, "settings that say the same");
        workshop.put("hall.yaml", &spaced.replace("radius: 1,", "radius: 1.25,"));
        workshop.fine(&format!("render hall.yaml -o {name}"));
        assert_ne!(workshop.fine(&format!("info {name} --json")).json()["metadata"]["Scene"], scene_of(&workshop));
        workshop.put("hall.yaml", &spaced);
    }
}

/// What a picture of the room calls its scene.
fn scene_of(workshop: &Workshop) -> serde_json::Value {
    workshop.fine("render room.yaml -o scene.png");
    workshop.fine("info scene.png --json").json()["metadata"]["Scene"].clone()
}

#[test]
fn every_instruction_set_of_the_machine_gives_the_same_file() {
    let workshop = Workshop::new();
    let told = workshop.fails("render room.yaml --simd mmx", 2, "this machine has ").stderr;
    let names = told.lines().find_map(|line| line.split_once("this machine has ")).unwrap().1;
    workshop.fine("render room.yaml -o a.png");
    for name in names.split(", ") {
        workshop.fine(&format!("render room.yaml -o b.png --simd {name}"));
        assert_eq!(workshop.bytes("b.png"), workshop.bytes("a.png"), "{name}");
    }
}

#[test]
fn wrong_outputs_are_found_before_rendering() {
    let workshop = Workshop::new();
    workshop.fails("render room.yaml -o a.gif", 2, "extension `gif`");
    workshop.fails("render room.yaml -o a", 2, "no extension");
    workshop.fails("render room.yaml -o -", 2, "standard output");
    workshop.fails("render room.yaml -o no/such/a.png", 4, "there is no folder `no/such`");
    workshop.fails("render room.yaml -o a.png --crop 20,0,5,5", 2, "--crop");
    workshop.fails("render room.yaml -o a.png --bit-depth half", 2, "8 or 16");
    workshop.fails("render room.yaml -o a.exr --bit-depth 16", 2, "half or float");
    workshop.fails("render room.yaml -o a.png --quality 80", 2, "--quality is for JPEG; PNG is lossless");
    assert_eq!(workshop.names(), ["bad.yaml", "room.yaml"]);
}

#[test]
fn wrong_scenes_have_an_exit_code_of_their_own() {
    let workshop = Workshop::new();
    let ran = workshop.fails("render bad.yaml", 3, "radius");
    assert!(ran.stderr.contains("bad.yaml:2") && ran.stderr.contains("bad.yaml:3"), "both are told: {}", ran.stderr);
    workshop.fails("render missing.yaml", 4, "missing.yaml");
    workshop.fails("render .", 2, "extension");
    workshop.fails("render . -o a.png", 4, "folder");
    assert_eq!(workshop.names(), ["bad.yaml", "room.yaml"]);
}

#[test]
fn the_command_line_wins_over_the_file() {
    let workshop = Workshop::new();
    let size = |options: &str| {
        workshop.fine(&format!("render room.yaml -o a.pfm {options}"));
        let picture = workshop.picture("a.pfm");
        (picture.width, picture.height)
    };
    assert_eq!(size("--width 12"), (12, 8));
    assert_eq!(size("--height 32"), (48, 32));
    assert_eq!(size("--width 10 --height 3"), (10, 3));
    let different = |options: &str| {
        workshop.fine("render room.yaml -o plain.png");
        workshop.fine(&format!("render room.yaml -o other.png {options}"));
        workshop.bytes("plain.png") != workshop.bytes("other.png")
    };
    assert!(!different("--antialias none --max-depth 5 --transfer srgb"));
    assert!(different("--antialias grid:2"));
    assert!(different("--max-depth 1"));
    assert!(different("--transfer linear"));
    assert!(different("--exposure 1"));
    assert!(different("--tone-mapping aces"));
    assert!(different("--integrator normals"));
    assert!(!different("--integrator whitted --samples 3 --noise 0.5 --time 100 --seed 4"));
    assert!(different("--integrator path:2 --samples 1"));
}

/// As the file would say it; the others of its path tracer stay.
#[test]
fn settings_of_the_path_tracer_win_over_those_of_the_file() {
    let workshop = Workshop::new();
    let about = |path: &str, options: &str| {
        let text = format!(
            "picture: {{width: 16, height: 8}}\nrender: {{integrator: {path}, samples: 2}}\nobjects: [plane, sphere]"
        );
        workshop.put("path.yaml", &text);
        workshop.fine(&format!("render path.yaml -o a.png --quiet {options}"));
        (workshop.picture("a.png"), workshop.fine("info a.png --json").json()["metadata"].clone())
    };
    let (picture, by_options) = about("{path: {reuse: 64, clamp: 5}}", "--reuse 4 --split 3");
    assert_eq!(
        (&by_options["Reuse"], &by_options["Split"], &by_options["Clamp"]),
        (&"4".into(), &"3".into(), &"5".into())
    );
    assert!(about("{path: {reuse: 4, split: 3, clamp: 5}}", "").0 == picture);
    assert!(about("{path: {reuse: 9, split: 0}}", "--reuse 4 --split 3 --integrator path:16,5").0 == picture);
    // The integrator may be an option, too; to others they mean nothing.
    assert!(about("whitted", "--integrator path:16,5 --reuse 4 --split 3").0 == picture);
    let told = workshop.fine("render room.yaml -o a.png --quiet --reuse 4 --split 3").stderr;
    assert!(told.contains("--reuse means nothing to `whitted`") && told.contains("--split means nothing"), "{told}");
    workshop.fails("render path.yaml --integrator path --reuse 5", 2, "--reuse: reuse must be 1, 4, 16 or 64, not 5");
    workshop.fails("render path.yaml --integrator path --split 65", 2, "--split: split must be from 1 to 64, not 65");
    workshop.put("path.yaml", "render: {integrator: {path: {reuse: 9, clamp: -1}}}\nobjects: [sphere]");
    let told = workshop.fails("render path.yaml --integrator path:8", 3, "path.yaml:1:37").stderr;
    assert!(
        told.contains("reuse must be") && told.contains("clamp must be") && !told.contains("--integrator"),
        "{told}"
    );
}

#[test]
fn settings_beyond_the_limits_name_their_option() {
    let workshop = Workshop::new();
    workshop.fails("render room.yaml --width 70000", 2, "--width: width must be from 1 to 65535 pixels, not 70000");
    workshop.fails("render room.yaml --height 65535", 2, "--height, from which the width follows: width must be");
    workshop.fails("render room.yaml --width 0", 2, "--width: width must be from 1 to 65535 pixels, not 0");
    workshop.fails("render room.yaml --height 30000", 2, "--height: a picture may have at most 400 million pixels");
    workshop.fails("render room.yaml --antialias grid:100000", 2, "--antialias");
    workshop.fails("render room.yaml --antialias recursive:nan", 2, "--antialias");
    workshop.fails("render room.yaml --antialias often", 2, "recursive[:THRESHOLD");
    workshop.fails("render room.yaml --max-depth 0", 2, "--max-depth: max_depth must be from 1 to 100, not 0");
    workshop.fails("render room.yaml --integrator magic", 2, "expected `whitted`, `path");
    workshop.fails("render room.yaml --integrator path:0", 2, "--integrator: max_depth must be from 1");
    workshop.fails("render room.yaml --samples 0", 2, "--samples: samples must be from 1 to 1000000, not 0");
    workshop.fails("render room.yaml --noise 7", 2, "--noise: noise must be from 0.0001 to 1");
    workshop.fails("render room.yaml --time -1", 2, "--time: time must be from 0.001");
    workshop.fails("render room.yaml --exposure dark", 2, "expected a number from -100 to 100");
    workshop.fails("render room.yaml --tone-mapping film", 2, "--tone-mapping");
    workshop.fails("render room.yaml --crop 20,0,5,5", 2, "--crop");
    workshop.fails("render room.yaml --crop 1,2,3", 2, "--crop");
    workshop.fails("render room.yaml --crop -1,0,2,2", 2, "expected four whole numbers");
    workshop.fails("render room.yaml --crop 0,0,0,0", 2, "width and height of the region must be at least 1");
    workshop.fails("render room.yaml --threads -1", 2, "-1 is not in 1..=1024");
    workshop.fails("render room.yaml --threads 0", 2, "--threads");
}

#[test]
fn all_numbers_that_are_wrong_are_told_at_once() {
    let workshop = Workshop::new();
    let words = "render room.yaml --integrator path --samples 0 --noise 7 --time -1 --max-depth 2000000 --width 0";
    let told = workshop.fails(words, 2, "--samples: samples must be").stderr;
    for message in
        ["--noise: noise must", "--time: time must", "--max-depth: max_depth must be from 1 to 1000000", "--width: "]
    {
        assert!(told.contains(message), "{message}: {told}");
    }
    workshop.fine("render room.yaml --integrator path --max-depth 200 --samples 1 -o a.png");
}

/// What is checked is what will be rendered.
#[test]
fn options_replace_what_the_check_refuses() {
    let workshop = Workshop::new();
    let clear = "objects: [sphere: {material: {transparency: 1, reflection: 1}}]\n";
    workshop.put("deep.yaml", &format!("render: {{max_depth: 30, min_weight: 0}}\n{clear}"));
    workshop.fails("render deep.yaml --width 8", 3, "deep.yaml:1:21");
    workshop.fine("render deep.yaml --width 8 -o a.png --max-depth 5");
    workshop.fine("render deep.yaml --width 8 -o a.png --integrator path --samples 1");
    workshop.fine("explain deep.yaml --pixel 0,0 --width 8 --max-depth 2");
    let more = "--max-depth: a ray may split into more than a hundred million rays";
    workshop.fails("render deep.yaml --max-depth 40", 2, more);
    // A scene that only the option makes too much: the depth is that of the file.
    workshop.put("path.yaml", &format!("render: {{integrator: path, min_weight: 0,\n  max_depth: 30}}\n{clear}"));
    workshop.fine("render path.yaml --width 8 -o a.png --samples 1");
    workshop.fails("render path.yaml --integrator whitted", 3, "path.yaml:2:14");
    workshop.put("wide.yaml", &format!("picture: {{width: 70000, height: 9}}\n{clear}"));
    workshop.fails("render wide.yaml", 3, "wide.yaml:1:18");
    workshop.fine("render wide.yaml --width 9 --height 9 -o a.png");
    workshop.put("flat.yaml", &format!("picture: {{width: 0, height: 9}}\n{clear}"));
    workshop.fails("render flat.yaml --height 4", 2, "from which the width follows: width must be from 1");
    // Nor do numbers that are too large for any place.
    let render = "{seed: 5e9, samples: 6e9, integrator: {path: {split: 7e9}}}";
    workshop.put("large.yaml", &format!("render: {render}\npicture: {{width: 8e9, height: 9e9}}\n{clear}"));
    let told = workshop.fails("render large.yaml", 3, "large.yaml:1:16").stderr;
    assert_eq!(told.matches("error:").count(), 5, "{told}");
    let size = "--width 9 --height 9 --samples 1";
    let told = workshop.fails(&format!("render large.yaml {size} --split 1"), 3, "large.yaml:1:16").stderr;
    assert!(told.matches("error:").count() == 1 && told.contains("this number is too large"), "{told}");
    let told = workshop.fails(&format!("render large.yaml {size} --seed 1 --integrator path"), 3, "not 7e9").stderr;
    assert_eq!(told.matches("error:").count(), 1, "{told}");
    for options in ["--split 1", "--integrator normals"] {
        workshop.fine(&format!("render large.yaml -o a.png {size} --seed 1 {options}"));
    }
}

/// What is said of settings that do nothing is said of the option, if that gives them.
#[test]
fn paths_that_cannot_be_reused_are_told() {
    let workshop = Workshop::new();
    let small = "picture: {width: 9, height: 9}\nobjects: [sphere]";
    workshop.put(
        "fog.yaml",
        &format!("render: {{integrator: path}}\nfog: {{exponential: {{color: 1, distance: 5}}}}\n{small}"),
    );
    workshop.put("clear.yaml", small);
    let told = |words: &str| workshop.fine(&format!("render {words} -o a.png --samples 1 --quiet")).stderr;
    assert_eq!(told("fog.yaml"), "");
    let in_fog = told("fog.yaml --reuse 4");
    assert!(in_fog.starts_with("warning: --reuse: `reuse` does nothing in fog\n"), "{in_fog}");
    let flat = told("clear.yaml --integrator path:2 --reuse 4");
    assert!(flat.starts_with("warning: --reuse: `reuse` does nothing with a `max_depth` of 2"), "{flat}");
    assert_eq!(told("clear.yaml --integrator path:3 --reuse 4"), "");
}

#[test]
fn options_and_files_each_get_their_own_messages() {
    let workshop = Workshop::new();
    let text = "render: {max_depth: 500, integrator: {path: {clamp: -1}}}\nobjects: [sphere]\n";
    workshop.put("both.yaml", text);
    let told = workshop.fails("render both.yaml --noise 7 --max-depth 3", 3, "--noise: noise must be from").stderr;
    assert!(told.contains("both.yaml:1:21") && told.contains("max_depth must be from 1 to 100, not 500"), "{told}");
    assert!(told.contains("both.yaml:1:53") && told.contains("clamp must be"), "{told}");
    assert!(!told.contains("--max-depth") && !told.contains("--integrator"), "{told}");
    workshop.fails("render both.yaml --integrator path:2,-3", 3, "--integrator: clamp must be above 0");
    workshop.put("model.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    workshop.fails("render model.obj --samples 0", 2, "--samples: samples must be from 1");
}

/// A picture says which scene it shows, whatever it was rendered with.
#[test]
fn options_leave_the_scene_in_the_picture_the_same() {
    let workshop = Workshop::new();
    let scene = |options: &str| {
        workshop.fine(&format!("render room.yaml -o a.png {options}"));
        workshop.fine("info a.png --json").json()["metadata"]["Scene"].clone()
    };
    let plain = scene("");
    assert!(plain.is_string());
    assert_eq!(scene("--width 8 --max-depth 2 --exposure 1"), plain);
}

#[test]
fn warnings_are_of_the_integrator_that_renders() {
    let workshop = Workshop::new();
    let text = "render: {integrator: whitted, samples: 1, light_samples: 2}\npicture: {width: 8, height: 8}\nobjects: [sphere]\n";
    workshop.put("a.yaml", text);
    let told = |options: &str| workshop.fine(&format!("render a.yaml -o a.png --quiet {options}")).stderr;
    let of_file = told("");
    assert!(of_file.contains("`samples` means nothing to `whitted`, the integrator of this file"), "{of_file}");
    assert!(!of_file.contains("`light_samples`"), "{of_file}");
    let of_option = told("--integrator path");
    assert!(
        of_option.contains("`light_samples` means nothing to `path`, the choice of --integrator")
            && !of_option.contains("to `whitted`"),
        "{of_option}"
    );
    workshop.put("a.yaml", &text.replace(", light_samples: 2", ""));
    assert_eq!(told("--integrator path"), "");
}

#[test]
fn options_that_mean_nothing_are_told() {
    let workshop = Workshop::new();
    let told = workshop.fine("render room.yaml -o a.png --samples 3 --noise 0.5 --time 100 --quiet").stderr;
    for option in ["--samples", "--noise", "--time"] {
        assert!(told.contains(&format!("warning: {option} means nothing to `whitted`")), "{told}");
    }
    let words = "render room.yaml -o a.png --integrator path --samples 1 --antialias none --light-samples 3 --quiet";
    let told = workshop.fine(words).stderr;
    assert!(told.contains("--antialias means nothing to `path`") && told.contains("--light-samples means"), "{told}");
    assert_eq!(
        workshop.fine("render room.yaml -o a.png --integrator path --samples 1 --max-depth 3 --quiet").stderr,
        ""
    );
}

#[test]
fn a_crop_is_that_part_of_the_whole() {
    let workshop = Workshop::new();
    workshop.fine("render room.yaml -o whole.pfm");
    workshop.fine("render room.yaml -o part.pfm --crop 5,3,9,7");
    let (whole, part) = (workshop.picture("whole.pfm"), workshop.picture("part.pfm"));
    assert_eq!((part.width, part.height), (9, 7));
    let bits = |color: Rgb| color.to_array().map(f32::to_bits);
    for y in 0..7 {
        for x in 0..9 {
            assert_eq!(bits(part.pixel(x, y)), bits(whole.pixel(x + 5, y + 3)), "{x},{y}");
        }
    }
}

#[test]
fn threads_change_no_byte() {
    let workshop = Workshop::new();
    for format in ["png", "exr"] {
        for threads in [1, 2, 5] {
            workshop.fine(&format!("render room.yaml --width 150 --threads {threads} -o {threads}.{format}"));
        }
        assert_eq!(workshop.bytes(&format!("1.{format}")), workshop.bytes(&format!("2.{format}")));
        assert_eq!(workshop.bytes(&format!("1.{format}")), workshop.bytes(&format!("5.{format}")));
    }
}

#[test]
fn statistics_are_json_in_place_of_the_line() {
    let workshop = Workshop::new();
    let ran = workshop.fine("render room.yaml --stats json --crop 0,0,10,5");
    assert_eq!(ran.stderr, "");
    let stats = ran.json();
    assert_eq!((&stats["complete"], &stats["finished_pixels"]), (&true.into(), &50.into()));
    assert_eq!((&stats["rays"]["eye"], &stats["region"]["width"]), (&50.into(), &10.into()));
    assert_eq!((&stats["output"], &stats["bytes"]), (&"room.png".into(), &workshop.bytes("room.png").len().into()));
    let total: u64 =
        ["eye", "reflected", "transmitted", "shadow"].iter().map(|k| stats["rays"][k].as_u64().unwrap()).sum();
    assert_eq!(stats["rays"]["total"], total);
    assert!(["load", "build", "render", "write"].iter().all(|step| stats["seconds"][step].as_f64().unwrap() >= 0.0));
}

#[test]
fn films_have_the_layers_that_are_asked_for() {
    let workshop = Workshop::new();
    workshop.fine("render room.yaml -o film.exr --layers all");
    let list = workshop.fine("develop film.exr --list").stdout;
    let names: Vec<&str> = list.lines().filter_map(|line| line.split(' ').next()).collect();
    let expected = ["beauty", "albedo", "depth", "material_id", "normal", "object_id", "position", "uv"];
    assert_eq!(names, expected, "{list}");
    assert!(list.contains("depth        24 × 16  Z float\n"), "{list}");
    for name in expected {
        workshop.fine(&format!("develop film.exr --layer {name} -o {name}.png"));
        let shown = workshop.picture(&format!("{name}.png"));
        assert!(shown.pixels.iter().any(|pixel| *pixel != shown.pixels[0]), "{name} is one color");
    }
    workshop.fine("render room.yaml -o some.exr --layers depth,beauty --crop 3,4,10,8 --bit-depth float");
    let list = workshop.fine("develop some.exr --list").stdout;
    assert_eq!(list, "beauty  10 × 8  R float, G float, B float\ndepth   10 × 8  Z float\n");
    workshop.fine("render room.yaml -o plain.exr");
    workshop.fine("render room.yaml -o beauty.exr --layers beauty");
    assert_eq!(workshop.bytes("plain.exr"), workshop.bytes("beauty.exr"));
    workshop.fails("render room.yaml -o a.png --layers all", 2, "only EXR has layers");
    workshop.fails("render room.yaml -o a.exr --layers direct", 2, "pictures by `whitted` have no layer `direct`");
    let settings = "antialias: none, integrator: path, samples: 4";
    workshop.put("paths.yaml", &crate::workshop::ROOM.replace("antialias: none", settings));
    workshop.fine("render paths.yaml -o paths.exr --layers samples,direct");
    let list = workshop.fine("develop paths.exr --list").stdout;
    assert_eq!(list, "direct   24 × 16  R half, G half, B half\nsamples  24 × 16  N integer\n");
    workshop.fails("render room.yaml -o a.exr --layers all,deep", 2, "no layer `all`; there are beauty, albedo");
}

/// What is rendered at once is what is developed later.
#[test]
fn films_are_developed_as_pictures_are_rendered() {
    let workshop = Workshop::new();
    let settings = "width: 24, height: 16, exposure: 1.5, tone_mapping: agx";
    let room = crate::workshop::ROOM.replace("width: 24, height: 16", settings);
    workshop.put("room.yaml", &room);
    workshop.fine("render room.yaml -o at-once.png");
    workshop.fine("render room.yaml -o film.exr --bit-depth float --layers all");
    workshop.fine("develop film.exr -o later.png");
    assert_eq!(workshop.picture("at-once.png"), workshop.picture("later.png"));
    workshop.fine("develop film.exr -o plain.png --exposure 0 --tone-mapping none");
    workshop.put("room.yaml", crate::workshop::ROOM);
    workshop.fine("render room.yaml -o plain-at-once.png");
    assert_eq!(workshop.picture("plain-at-once.png"), workshop.picture("plain.png"));
    assert_ne!(workshop.picture("plain.png"), workshop.picture("later.png"));
}

/// A ball before a bright sky, cut out: where nothing is, nothing is, and the ball is what it is without alpha.
#[test]
fn backgrounds_are_left_out_with_alpha() {
    let workshop = Workshop::new();
    for (integrator, antialias) in
        [("whitted", "{grid: 4}"), ("whitted", "adaptive"), ("path", "none"), ("ambient_occlusion", "none")]
    {
        workshop.put(
            "ball.yaml",
            &format!(
                "{{picture: {{width: 20, height: 16, transfer: linear}}, background: [0.9, 0.6, 0.3],
                   render: {{integrator: {integrator}, antialias: {antialias}, samples: 16}},
                   camera: {{position: [0, 0, 5], look_at: [0, 0, 0]}},
                   objects: [sphere: {{radius: 1.2, material: {{color: [0.2, 0.4, 0.8], specular: 0}}}}]}}"
            ),
        );
        workshop.fine("render ball.yaml -o whole.exr --bit-depth float");
        workshop.fine("render ball.yaml -o cut.exr --bit-depth float --alpha");
        workshop.fine("render ball.yaml -o cut.png --bit-depth 16 --alpha");
        workshop.fine("render ball.yaml -o film.exr --bit-depth float --alpha --layers beauty,albedo");
        workshop.fine("develop film.exr -o developed.png --bit-depth 16");
        let bitmap = |name: &str| durer::read_picture(&workshop.path(name), &DecodeLimits::default()).unwrap();
        let (whole, cut) = (workshop.picture("whole.exr"), workshop.picture("cut.exr"));
        let alpha = bitmap("cut.exr").alpha.unwrap();
        let sky = if integrator == "ambient_occlusion" { Rgb::WHITE } else { Rgb::new(0.9, 0.6, 0.3) };
        let tolerance = if antialias == "adaptive" { 0.02 } else { 1e-4 };
        let mut edges = 0;
        for (index, (&whole, &cut)) in whole.pixels.iter().zip(&cut.pixels).enumerate() {
            let put_back = cut + sky * (1.0 - alpha.get(index));
            let off = (put_back - whole).map(f32::abs).max_component();
            assert!(off < tolerance, "{integrator}, {antialias}, {index}: {put_back:?} is not {whole:?}");
            edges += u32::from(alpha.get(index) > 0.0 && alpha.get(index) < 1.0);
        }
        assert_eq!((alpha.get(0), cut.pixels[0], alpha.get(8 * 20 + 10)), (0.0, Rgb::BLACK, 1.0));
        assert!(edges > 10, "{integrator}, {antialias}: {edges}");
        assert_eq!(bitmap("cut.png"), bitmap("developed.png"));
    }
    workshop.fails("render ball.yaml -o a.jpg --alpha", 2, "--alpha: JPEG has no alpha");
}

//! Films of samples: parts of pictures, merged; renders that end by noise or time; checkpoints of them.

use crate::workshop::Workshop;
use durer::{Checkpoint, Origin, SampleRange, SceneHash, encode_checkpoint, read_checkpoint};

const BALL: &str = "picture: {width: 60, height: 40}\nrender: {integrator: path, samples: 8}\nobjects:\n\
    - plane: {material: {matte: {color: gray}}}\n- sphere: {center: [0, 1, 0], material: {matte: {color: tomato}}}\n";

fn workshop() -> Workshop {
    let workshop = Workshop::new();
    workshop.put("ball.yaml", BALL);
    workshop
}

#[test]
fn parts_are_merged_to_the_bytes_of_one_run() {
    let workshop = workshop();
    workshop.fine("render ball.yaml -o whole.png");
    workshop.fine("render ball.yaml -o whole.film --threads 1");
    workshop.fine("render ball.yaml --sample-range 0..3 -o a.film");
    workshop.fine("render ball.yaml --sample-range 3..8 --crop 0,0,25,40 -o b.film");
    workshop.fine("render ball.yaml --sample-range 3..8 --crop 25,0,35,40 -o c.film");
    workshop.fine("merge c.film a.film b.film -o merged.png");
    assert_eq!(workshop.bytes("merged.png"), workshop.bytes("whole.png"));
    let told = workshop.fine("merge c.film a.film -o some.film");
    assert!(told.stderr.contains("samples 3..8 of the pixels 0,0,25,40 are missing"), "{}", told.stderr);
    workshop.fine("merge b.film some.film -o again.png");
    assert_eq!(workshop.bytes("again.png"), workshop.bytes("whole.png"));
    let told = workshop.fine("merge whole.film -o from-film.png").stderr;
    assert!(told.contains("8 samples a pixel") && !told.contains("Mrays/s"), "nothing is traced: {told}");
    assert_eq!(workshop.bytes("from-film.png"), workshop.bytes("whole.png"));
    workshop.fine("render ball.yaml --layers all -o whole.exr");
    workshop.fine("render ball.yaml --layers all --sample-range 0..5 -o d.film");
    workshop.fine("render ball.yaml --layers all --sample-range 5..8 -o e.film");
    workshop.fine("merge d.film e.film -o layers.exr");
    assert_eq!(workshop.bytes("layers.exr"), workshop.bytes("whole.exr"));
    workshop.fails("merge a.film e.film -o layers.exr", 4, "it has other layers than");
    assert!(!workshop.names().iter().any(|name| name.contains("checkpoint") || name.contains("part")));
}

#[test]
fn films_that_do_not_fit_are_told() {
    let workshop = workshop();
    workshop.fine("render ball.yaml --sample-range 0..3 -o a.film");
    workshop.fine("render ball.yaml --sample-range 2..5 -o b.film");
    workshop.fails("merge a.film b.film -o c.png", 4, "both have samples 2..3 of the pixels 0,0,60,40");
    workshop.put("other.yaml", &BALL.replace("tomato", "gold"));
    workshop.fine("render other.yaml --sample-range 5..6 -o other.film");
    workshop.fails("merge a.film other.film -o c.png", 4, "it differs from a.film in the scene");
    workshop.fine("render ball.yaml --seed 3 --exposure 1 --sample-range 5..6 -o seed.film");
    let differing = "it differs from a.film in the setting `exposure`, the setting `seed`";
    workshop.fails("merge a.film seed.film -o c.png", 4, differing);
    // Which of the path tracer's settings, and what they are.
    for (path, others) in [
        ("{path: {reuse: 16}}", "the setting `reuse` of `path` (16 in place of 1)"),
        (
            "{path: {max_depth: 9, clamp: 0.1, split: 2}}",
            "the setting `max_depth` of `path` (9 in place of 16), the setting `clamp` of `path` (0.1 in place of none), \
             the setting `split` of `path` (2 in place of 1)",
        ),
        ("ambient_occlusion", "the setting `integrator` (`ambient_occlusion` in place of `path`)"),
    ] {
        workshop.put("path.yaml", &BALL.replace("integrator: path", &format!("integrator: {path}")));
        workshop.fine("render path.yaml --sample-range 5..6 -o path.film --quiet");
        workshop.fails("merge a.film path.film -o c.png", 4, &format!("it differs from a.film in {others}\n"));
    }
    let what_is_one = "it is no film; films are what `durer render SCENE -o NAME.film` writes";
    workshop.fails("merge a.film ball.yaml -o c.png", 4, what_is_one);
    workshop.fine("render ball.yaml -o picture.png");
    workshop.fails("merge picture.png a.film -o c.png", 4, what_is_one);
    workshop.fails("merge a.film -o c.gif", 2, "gif");
    workshop.fails("resume a.film", 4, "it is a finished film");
    workshop.fails("render ball.yaml --sample-range 3..3", 2, "must be greater");
    for beyond in ["999999..1000001", "0..5000000000"] {
        workshop.fails(&format!("render ball.yaml --sample-range {beyond}"), 2, "a pixel has at most 1000000 samples");
    }
    let last = workshop.fine("render ball.yaml --sample-range 999999..1000000 -o last.film").stderr;
    assert!(last.contains(", 1 sample a pixel;"), "{last}");
    assert!(workshop.fine("info last.film").stdout.contains(", 1 sample a pixel\n"));
    workshop.fails("render ball.yaml -o a.film --quality 3", 2, "--quality");
    workshop.fails("render room.yaml -o a.film", 2, "`whitted` takes no samples");
    workshop.fails("render room.yaml --sample-range 0..4", 2, "`whitted` takes no samples");
    assert!(!workshop.path("c.png").exists());
    // The scene says how films are developed.
    workshop.put("ball.yaml", &BALL.replace("tomato", "gold"));
    let why = "cannot make a picture of a.film: since it was made, the scene changed";
    workshop.fails("merge a.film -o c.png", 3, why);
}

/// How many samples were wanted, how little noise, and how soon, changes none of them.
#[test]
fn films_of_one_scene_with_other_counts_are_merged() {
    let workshop = workshop();
    workshop.fine("render ball.yaml --samples 4 -o a.film");
    workshop.fine("render ball.yaml --samples 20 --noise 0.5 --sample-range 4..8 -o b.film");
    workshop.fine("render ball.yaml -o whole.png");
    workshop.fine("merge b.film a.film -o merged.png");
    assert_eq!(workshop.picture("merged.png"), workshop.picture("whole.png"));
    // Nor does the scene of a film that says so by now.
    workshop.fine("render ball.yaml -o c.film");
    workshop.put("ball.yaml", &BALL.replace("samples: 8", "samples: 99, time: 50"));
    workshop.fine("merge c.film -o again.png");
    assert_eq!(workshop.picture("again.png"), workshop.picture("whole.png"));
}

/// Each says what to do instead.
#[test]
fn films_are_no_pictures() {
    let workshop = workshop();
    workshop.fine("render ball.yaml --sample-range 0..3 -o a.film");
    let hint = "make one of it with `durer merge a.film -o picture.exr`";
    workshop.fails("develop a.film", 4, hint);
    workshop.fails("compare a.film a.film", 4, hint);
    workshop.fails("render ball.yaml -o a.gif", 2, "hdr and pfm, and film for `durer merge`");
    workshop.fails("merge a.film -o a.gif", 2, "hdr and pfm, and film for `durer merge`");
}

#[test]
fn films_say_what_they_are() {
    let workshop = workshop();
    workshop.fine("render ball.yaml --sample-range 3..8 --crop 25,0,35,40 -o a.film");
    let about = workshop.fine("info a.film").stdout;
    for words in [
        "film, finished",
        "35 × 40 pixels from 25,0, 5 samples a pixel",
        "60 × 40 pixels",
        "integrator path",
        "samples 3..8 of the pixels 25,0,35,40",
        "durer render ball.yaml --sample-range 3..8",
    ] {
        assert!(about.contains(words), "{words}: {about}");
    }
    let json = workshop.fine("info a.film --json").json();
    assert_eq!((&json["complete"], &json["picture"]["width"]), (&true.into(), &60.into()));
    assert_eq!(json["parts"][0]["samples"], serde_json::json!([3, 8]));
    let path = serde_json::json!({ "max_depth": 16, "clamp": null, "split": 1, "reuse": 1 });
    assert_eq!((&json["integrator"], &json["path"]), (&"path".into(), &path));
    workshop.fine("render ball.yaml --integrator path:9,2.5 --split 3 --reuse 4 --samples 1 -o c.film");
    assert!(workshop.fine("info c.film").stdout.contains("integrator path, depth 9, clamp 2.5, split 3, reuse 4\n"));
    let path = serde_json::json!({ "max_depth": 9, "clamp": 2.5, "split": 3, "reuse": 4 });
    assert_eq!(workshop.fine("info c.film --json").json()["path"], path);
    let bytes = workshop.bytes("a.film");
    std::fs::write(workshop.path("b.film"), &bytes[..bytes.len() / 2]).unwrap();
    workshop.fails("info b.film", 4, "it is damaged");
}

/// What is missing is told: of the pixels of the picture, too. Films that are written are told of.
#[test]
fn what_is_missing_is_told() {
    let workshop = workshop();
    workshop.fine("render ball.yaml --sample-range 0..3 --crop 0,0,25,40 -o a.film");
    workshop.fine("render ball.yaml --sample-range 3..8 --crop 0,0,25,40 -o b.film");
    let told = workshop.fine("merge a.film b.film -o c.film").stderr;
    assert!(told.contains("these are the pixels 0,0,25,40 of a picture of 60 × 40"), "{told}");
    assert!(told.contains("c.film: 25 × 40 pixels from 0,0, 8 samples a pixel, "), "{told}");
    assert!(!told.contains("missing"), "{told}");
}

/// What a render that was stopped has can be looked at, and gone on with.
#[test]
fn a_picture_is_made_of_what_there_is() {
    let workshop = workshop();
    workshop.put("long.yaml", &BALL.replace("samples: 8", "samples: 1000000"));
    for (scene, way, words) in [
        ("long.yaml", "", "of 1000000; `durer resume c` goes on"),
        ("room.yaml", "--width 600 --antialias grid:8", "pixels, the others are black; `durer resume c` goes on"),
    ] {
        let words_of_render =
            format!("render {scene} {way} -o a.png --checkpoint c --checkpoint-every 0 --limits time=2 --threads 1");
        let ran = workshop.run(&words_of_render);
        assert_eq!(ran.code, Some(130), "{}", ran.stderr);
        let told = workshop.fine("merge c -o now.png").stderr;
        assert!(told.contains("c is not finished: ") && told.contains(words), "{told}");
        assert!(workshop.path("now.png").exists() && workshop.path("c").exists());
        assert!(workshop.fine("info c").stdout.contains("so far"));
        match way {
            "" => {
                let told = workshop.fine("merge c -o now.film").stderr;
                assert!(told.contains("c is not finished: ") && told.contains(words), "{told}");
                assert!(workshop.fine("info now.film").stdout.contains("film, finished"));
            }
            _ => drop(workshop.fails("merge c -o now.film", 4, "takes no samples")),
        }
        std::fs::remove_file(workshop.path("c")).unwrap();
    }
}

/// Stops after the first pass.
#[derive(Default)]
struct Soon(std::sync::atomic::AtomicBool);

impl durer::Progress for Soon {
    fn advanced(&self, _film: &durer::Film) {
        self.0.store(true, std::sync::atomic::Ordering::Relaxed);
    }

    fn stop(&self) -> bool {
        self.0.load(std::sync::atomic::Ordering::Relaxed)
    }
}

/// The file of a film of the ball that these words began and that was stopped soon.
fn stopped(workshop: &Workshop, words: &[&str], samples: SampleRange) -> Vec<u8> {
    let loaded = durer::load_str(BALL, "ball.yaml", &durer::NoAssets, &durer::Limits::default()).unwrap();
    let hash = SceneHash::of(loaded.scene.scene(), &loaded.sources);
    let options = durer::RenderOptions { threads: None, region: None, samples: Some(samples), direct: false };
    let film = durer::render(&durer::compile(&loaded.scene), &options, &Soon::default()).unwrap();
    assert!(!film.is_complete());
    let folder = workshop.path("").canonicalize().unwrap().into_os_string().into_string().unwrap();
    let words = words.iter().map(|&word| word.to_owned()).collect();
    encode_checkpoint(&Origin { folder, words }, &hash, &film, 1.0)
}

/// Films that are not finished are told, and merged for what they have.
#[test]
fn unfinished_films_are_merged_for_what_they_have() {
    let workshop = workshop();
    for (name, start) in [("a.film", 0), ("b.film", 8)] {
        let bytes = stopped(&workshop, &["ball.yaml", "-o", name], SampleRange { start, end: start + 8 });
        std::fs::write(workshop.path(name), bytes).unwrap();
    }
    workshop.fine("render ball.yaml --sample-range 20..22 -o c.film");
    let told = workshop.fine("merge a.film b.film c.film -o all.film").stderr;
    for words in
        ["a.film is not finished: ", "b.film is not finished: ", "`durer resume b.film` goes on", "are missing"]
    {
        assert!(told.contains(words), "{told}");
    }
    workshop.fine("merge b.film a.film c.film -o all.png --quiet");
    let sums = |name: &str| read_checkpoint(&workshop.path(name)).unwrap().film.sums().unwrap().clone();
    let [all, a, b, c] = ["all.film", "a.film", "b.film", "c.film"].map(sums);
    assert!(a.samples() > 0 && a.samples() < 8 * 2400 && c.samples() == 2 * 2400);
    for pixel in 0..all.taken.len() {
        assert_eq!(all.taken[pixel], a.taken[pixel] + b.taken[pixel] + c.taken[pixel]);
        let added: [i128; 3] = std::array::from_fn(|i| [&a, &b, &c].map(|sums| sums.colors[pixel][i]).iter().sum());
        assert_eq!(all.colors[pixel], added);
    }
    // What it has it cannot be given again.
    workshop.fails("resume a.film", 4, "give it another name first");
    std::fs::rename(workshop.path("a.film"), workshop.path("begun.film")).unwrap();
    workshop.fine("resume begun.film --quiet");
    workshop.fails("merge all.film a.film -o b.png", 4, "both have samples 0..");
}

/// Whichever of the two files of an interrupted film is gone on with, both go when the film is written; not those of others.
#[test]
fn a_film_gone_on_with_leaves_no_checkpoint() {
    let workshop = workshop();
    workshop.fine("render ball.yaml -o whole.film");
    let render = |checkpoint: &[&str]| {
        let words = [&["ball.yaml", "-o", "a.film"], checkpoint].concat();
        stopped(&workshop, &words, SampleRange { start: 0, end: 8 })
    };
    for (checkpoint, words) in [("a.film.durer-checkpoint", &[][..]), ("c", &["--checkpoint", "c"])] {
        for name in ["a.partial.film", checkpoint] {
            std::fs::write(workshop.path(name), render(words)).unwrap();
        }
        std::fs::write(workshop.path("other"), render(&["--checkpoint", "other"])).unwrap();
        workshop.fine("resume a.partial.film");
        assert_eq!(workshop.names(), ["a.film", "bad.yaml", "ball.yaml", "other", "room.yaml", "whole.film"]);
        let sums = |film: &str| read_checkpoint(&workshop.path(film)).unwrap().film;
        assert!(sums("a.film") == sums("whole.film"));
    }
    // One that lies there and is of another render stays.
    std::fs::write(workshop.path("a.partial.film"), render(&[])).unwrap();
    std::fs::write(workshop.path("a.film.durer-checkpoint"), render(&["--checkpoint", "other"])).unwrap();
    workshop.fine("resume a.partial.film");
    assert!(workshop.path("a.film.durer-checkpoint").exists() && !workshop.path("a.partial.film").exists());
}

/// The time that was taken before counts: if nothing is left of it, going on ends with the pass that was begun.
#[test]
fn time_does_not_begin_again() {
    let workshop = workshop();
    workshop.put("timed.yaml", &BALL.replace("samples: 8", "samples: 1000000, time: 100"));
    let render = "render timed.yaml -o a.png --checkpoint c --checkpoint-every 0 --limits time=1 --threads 1";
    assert_eq!(workshop.run(render).code, Some(130));
    let Checkpoint { origin, scene, film, seconds } = read_checkpoint(&workshop.path("c")).unwrap();
    assert!(seconds > 0.0, "{seconds}");
    let most = film.sums().unwrap().least_and_most().1;
    std::fs::write(workshop.path("c"), encode_checkpoint(&origin, &scene, &film, 100.0)).unwrap();
    let stats = workshop.fine("resume c --stats json").json();
    assert_eq!((&stats["samples"]["least"], &stats["samples"]["most"]), (&most.into(), &most.into()));
}

/// With a goal for noise, any parts are those of the whole.
#[test]
fn parts_with_noise_are_merged_to_the_bytes_of_one_run() {
    let workshop = workshop();
    workshop.put("noise.yaml", &BALL.replace("samples: 8", "samples: 150, noise: 0.03"));
    workshop.fine("render noise.yaml -o whole.png --alpha");
    workshop.fine("render noise.yaml --crop 0,0,21,40 -o a.film");
    workshop.fine("render noise.yaml --crop 21,0,39,13 -o b.film");
    workshop.fine("render noise.yaml --crop 21,13,39,27 -o c.film");
    workshop.fine("merge c.film a.film b.film -o merged.png");
    workshop.fine("render noise.yaml -o opaque.png");
    assert_eq!(workshop.bytes("merged.png"), workshop.bytes("opaque.png"));
}

/// Of nothing but the even sky, which is calm everywhere after as few samples as can be, a film is one of all that were wanted
/// still: nothing is missing, and the films together are, byte for byte, that of one run.
#[test]
fn parts_where_nothing_is_noisy_are_merged_to_the_bytes_of_one_run() {
    let workshop = workshop();
    workshop.put(
        "noise.yaml",
        "picture: {width: 60, height: 40}\nrender: {integrator: path, samples: 150, noise: 0.02}\n\
         camera: {position: [0, 0, 12], look_at: [0, 0, 0], fov: 40}\nbackground: skyblue\n\
         objects:\n- sphere: {material: {matte: {color: tomato}}}\n",
    );
    workshop.fine("render noise.yaml -o whole.film");
    workshop.fine("render noise.yaml --crop 0,0,10,40 -o sky.film");
    workshop.fine("render noise.yaml --crop 10,0,50,40 -o ball.film");
    let taken = |film: &str| read_checkpoint(&workshop.path(film)).unwrap().film.sums().unwrap().least_and_most();
    assert!(taken("sky.film") == (64, 64) && taken("ball.film").1 > 64, "{:?}", taken("ball.film"));
    let told = workshop.fine("merge sky.film ball.film -o merged.film").stderr;
    assert!(!told.contains("missing"), "{told}");
    // All of their bytes but the words that they were begun with.
    let bytes = |film: &str| {
        let Checkpoint { origin: _, scene, film, seconds } = read_checkpoint(&workshop.path(film)).unwrap();
        encode_checkpoint(&Origin::default(), &scene, &film, seconds)
    };
    assert!(bytes("merged.film") == bytes("whole.film"));
}

#[test]
fn statistics_tell_of_samples() {
    let workshop = workshop();
    let stats = workshop.fine("render ball.yaml -o a.png --stats json").json();
    let samples = &stats["samples"];
    assert_eq!((&samples["least"], &samples["most"], &samples["wanted"]), (&8.into(), &8.into(), &8.into()));
    assert!(samples["noise"].as_f64().unwrap() > 0.0 && samples["per_second"].as_f64().unwrap() > 0.0);
    assert!(workshop.fine("render room.yaml --width 8 -o b.png --stats json").json()["samples"].is_null());
    workshop.put("noise.yaml", &BALL.replace("samples: 8", "samples: 400, noise: 0.05"));
    let stats = workshop.fine("render noise.yaml -o n.png --stats json").json();
    let (least, most) = (stats["samples"]["least"].as_u64().unwrap(), stats["samples"]["most"].as_u64().unwrap());
    assert!(16 <= least && least < most && most <= 400, "{least} {most}");
    let about = workshop.fine("info n.png").stdout;
    assert!(about.contains("Noise") && about.contains(&format!("{least} to {most}")), "{about}");
}

/// A limit of time tells how many samples there were, and that many give the same colors.
#[test]
fn a_limit_of_time_can_be_repeated_without_it() {
    let workshop = workshop();
    workshop.put("timed.yaml", &BALL.replace("samples: 8", "samples: 1000000, time: 0.3"));
    let stats = workshop.fine("render timed.yaml -o a.exr --stats json").json();
    let samples = stats["samples"]["least"].as_u64().unwrap();
    assert_eq!(stats["samples"]["most"].as_u64(), Some(samples));
    workshop.put("counted.yaml", &BALL.replace("samples: 8", &format!("samples: {samples}")));
    workshop.fine("render counted.yaml -o b.exr");
    assert_eq!(workshop.picture("a.exr"), workshop.picture("b.exr"));
    assert!(workshop.fine("info a.exr").stdout.contains(&samples.to_string()));
}

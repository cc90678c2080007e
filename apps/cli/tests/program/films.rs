//! Films of samples: parts of pictures, merged; renders that end by noise or time; checkpoints of them.

use crate::workshop::Workshop;

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
    workshop.fine("merge whole.film -o from-film.png");
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
    workshop.fails("merge a.film other.film -o c.png", 4, "is of another scene");
    workshop.fails("merge a.film ball.yaml -o c.png", 4, "this is no checkpoint of durer");
    workshop.fails("merge a.film -o c.gif", 2, "gif");
    workshop.fails("resume a.film", 4, "it is a finished film");
    workshop.fails("render ball.yaml --sample-range 3..3", 2, "must be greater");
    workshop.fails("render ball.yaml -o a.film --quality 3", 2, "--quality");
    workshop.fails("render room.yaml -o a.film", 2, "`whitted` takes no samples");
    workshop.fails("render room.yaml --sample-range 0..4", 2, "`whitted` takes no samples");
    assert!(!workshop.path("c.png").exists());
    // The scene says how films are developed.
    workshop.put("ball.yaml", &BALL.replace("tomato", "gold"));
    workshop.fails("merge a.film -o c.png", 3, "the scene changed");
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

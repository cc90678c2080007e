//! `durer compare`.

use crate::workshop::Workshop;

/// A folder with a picture `a.png`, nearly the same `b.png`, and one of another size.
fn pictures() -> Workshop {
    let workshop = Workshop::new();
    workshop.fine("render room.yaml -o a.png");
    workshop.fine("render room.yaml -o b.png --antialias grid:2");
    workshop.fine("render room.yaml -o small.png --width 6");
    workshop
}

#[test]
fn equal_pictures_are_equal() {
    let workshop = pictures();
    let ran = workshop.fine("compare a.png a.png");
    assert!(ran.stdout.contains("maximum     0\n") && ran.stdout.ends_with("\nequal\n"), "{}", ran.stdout);
}

#[test]
fn the_threshold_is_on_the_mean_flip_error() {
    let workshop = pictures();
    let ran = workshop.run("compare a.png b.png --json");
    let numbers = ran.json();
    assert_eq!((ran.code, &numbers["within"]), (Some(1), &false.into()));
    let flip = numbers["flip_mean"].as_f64().unwrap();
    assert!(
        flip > 0.0
            && numbers["max"].as_f64() > numbers["rms"].as_f64()
            && numbers["rms"].as_f64() > numbers["mean"].as_f64()
    );
    workshop.fine(&format!("compare a.png b.png --threshold {flip}"));
    assert_eq!(workshop.run(&format!("compare a.png b.png --threshold {}", flip * 0.99)).code, Some(1));
    let text = workshop.run("compare a.png b.png").stdout;
    assert!(text.contains("FLIP mean") && text.contains("% of the pixels") && text.ends_with("different\n"), "{text}");
}

#[test]
fn the_difference_is_a_picture() {
    let workshop = pictures();
    assert_eq!(workshop.run("compare a.png b.png --diff d.png").code, Some(1));
    let picture = workshop.picture("d.png");
    assert_eq!((picture.width, picture.height), (24, 16));
}

#[test]
fn what_cannot_be_compared_has_other_codes() {
    let workshop = pictures();
    workshop.fails("compare a.png small.png", 2, "24 × 16 and 6 × 4");
    workshop.fails("compare a.png missing.png", 4, "missing.png");
    workshop.fails("compare a.png room.yaml", 4, "room.yaml");
    workshop.fails("compare a.png b.png --threshold 2", 2, "from 0 to 1");
    workshop.fails("compare a.png b.png --diff d.txt", 2, "txt");
    workshop.fails("compare a.png b.png --diff no/d.png", 4, "no/d.png");
}

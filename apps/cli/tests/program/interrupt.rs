//! Ctrl-C while rendering.

#![cfg(unix)]

use crate::workshop::{Ran, Workshop};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// Long enough for a signal to come in time: 1.5 million pixels of 4096 rays each.
const LONG: &str = "render room.yaml --width 1500 --antialias grid:64 --threads 2";

fn start(workshop: &Workshop, words: &str) -> Child {
    let mut command = workshop.command(words);
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    // The file beside the picture is there once rendering is about to begin.
    let patience = Instant::now() + Duration::from_secs(60);
    while !workshop.names().iter().any(|name| name.ends_with(".part")) {
        assert!(Instant::now() < patience, "rendering does not begin");
        std::thread::sleep(Duration::from_millis(5));
    }
    child
}

fn interrupt(child: &Child) {
    send(child, "INT");
}

fn send(child: &Child, signal: &str) {
    let status = Command::new("kill").args(["-s", signal, &child.id().to_string()]).status().unwrap();
    assert!(status.success());
}

fn end(child: Child) -> Ran {
    child.wait_with_output().unwrap().into()
}

#[test]
fn the_first_one_saves_what_is_finished() {
    let workshop = Workshop::new();
    workshop.put("room.png", "the old picture");
    let child = start(&workshop, LONG);
    std::thread::sleep(Duration::from_millis(1500));
    interrupt(&child);
    let ran = end(child);
    assert_eq!(ran.code, Some(130), "{}", ran.stderr);
    assert!(ran.stderr.contains("interrupted"), "{}", ran.stderr);
    assert!(!workshop.names().iter().any(|name| name.ends_with(".part")), "{:?}", workshop.names());
    assert_eq!(workshop.bytes("room.png"), b"the old picture");
    assert!(ran.stderr.ends_with("room.png is as it was\n"), "{}", ran.stderr);
    // On a machine too slow for a single tile there is no picture, and the program says so.
    if ran.stderr.contains("before any tile") {
        return assert!(!workshop.path("room.partial.png").exists());
    }
    assert!(ran.stderr.contains("interrupted: room.partial.png has "), "{}", ran.stderr);
    let picture = workshop.picture("room.partial.png");
    assert_eq!((picture.width, picture.height), (1500, 1000));
    assert!(
        picture.pixels.iter().any(|color| color.is_black()) && picture.pixels.iter().any(|color| !color.is_black())
    );
}

#[test]
fn other_calls_to_end_are_heeded_as_well() {
    for signal in ["TERM", "HUP"] {
        let workshop = Workshop::new();
        let child = start(&workshop, LONG);
        send(&child, signal);
        let ran = end(child);
        assert_eq!(ran.code, Some(130), "{signal}: {}", ran.stderr);
        assert!(ran.stderr.ends_with("room.png is not written\n"), "{signal}: {}", ran.stderr);
        assert!(!workshop.names().iter().any(|name| name.ends_with(".part")), "{:?}", workshop.names());
    }
}

#[test]
fn the_second_one_ends_at_once_and_leaves_nothing() {
    let workshop = Workshop::new();
    let child = start(&workshop, LONG);
    std::thread::sleep(Duration::from_millis(300));
    interrupt(&child);
    std::thread::sleep(Duration::from_millis(20));
    interrupt(&child);
    let ran = end(child);
    assert_eq!(ran.code, Some(130), "{}", ran.stderr);
    assert!(!workshop.names().iter().any(|name| name.ends_with(".part")), "{:?}", workshop.names());
}

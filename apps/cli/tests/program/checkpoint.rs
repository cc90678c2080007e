//! Renders that are killed, and go on.

#![cfg(unix)]

use crate::workshop::{Ran, Workshop};
use std::fs;
use std::os::unix::process::ExitStatusExt;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// Some seconds in pieces of less than one.
const SLOW: &str = "--width 320 --threads 2";

const LONG: &str = "render room.yaml --width 1500 --antialias grid:64 --threads 2";

fn start(workshop: &Workshop, words: &str) -> Child {
    workshop.command(words).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap()
}

fn end(child: Child) -> Ran {
    child.wait_with_output().unwrap().into()
}

fn send(child: &Child, signal: &str) {
    assert!(Command::new("kill").args(["-s", signal, &child.id().to_string()]).status().unwrap().success());
}

/// Waits until something is so, or the program has ended; true if it has not.
fn wait_for(child: &mut Child, is_so: impl Fn() -> bool) -> bool {
    let patience = Instant::now() + Duration::from_secs(120);
    while !is_so() {
        if child.try_wait().unwrap().is_some() {
            return false;
        }
        assert!(Instant::now() < patience, "nothing happens");
        std::thread::sleep(Duration::from_millis(3));
    }
    true
}

/// Begins a render that writes checkpoints to `c`, and kills it once there is one.
fn kill_midway(workshop: &Workshop, words: &str) {
    let mut child = start(workshop, words);
    assert!(wait_for(&mut child, || workshop.path("c").exists()), "it was too fast: {words}");
    child.kill().unwrap();
    assert_eq!(child.wait().unwrap().signal(), Some(9));
}

#[test]
fn a_render_killed_again_and_again_gives_the_same_bytes() {
    for (way, least) in [("grid:12", 3), ("adaptive:0.003,5 --filter mitchell", 1)] {
        let workshop = Workshop::new();
        workshop.fine(&format!("render room.yaml -o whole.png {SLOW} --antialias {way}"));
        let mut words =
            format!("render room.yaml -o a.png {SLOW} --antialias {way} --checkpoint c --checkpoint-every 0");
        let mut kills = 0;
        while kills < 6 {
            let before = fs::read(workshop.path("c")).ok();
            let mut child = start(&workshop, &words);
            if !wait_for(&mut child, || fs::read(workshop.path("c")).ok() != before) {
                break;
            }
            std::thread::sleep(Duration::from_millis(17 * kills));
            child.kill().unwrap();
            if child.wait().unwrap().signal() != Some(9) {
                break;
            }
            kills += 1;
            words = "resume c --threads 2".to_owned();
        }
        if workshop.path("c").exists() {
            let ran = workshop.fine("resume c");
            assert!(ran.stderr.starts_with("a.png: 320 × 213 pixels"), "{}", ran.stderr);
        }
        assert!(kills >= least, "{way}: killed {kills} times only");
        assert_eq!(workshop.bytes("a.png"), workshop.bytes("whole.png"), "{way}, killed {kills} times");
        assert_eq!(workshop.names(), ["a.png", "bad.yaml", "room.yaml", "whole.png"], "nothing else is left");
    }
}

#[test]
fn what_is_damaged_or_changed_is_refused_and_stays() {
    let workshop = Workshop::new();
    kill_midway(&workshop, &format!("render room.yaml {SLOW} --antialias grid:12 --checkpoint c --checkpoint-every 0"));
    let good = workshop.bytes("c");
    for at in [20, 60, good.len() / 2, good.len() - 1] {
        let mut bytes = good.clone();
        bytes[at] ^= 0x10;
        fs::write(workshop.path("c"), &bytes).unwrap();
        workshop.fails("resume c", 4, "cannot go on with c: it is damaged");
        fs::write(workshop.path("c"), &good[..at]).unwrap();
        workshop.fails("resume c", 4, "cannot go on with c: it is damaged");
    }
    fs::write(workshop.path("c"), &good).unwrap();
    workshop.fails("resume room.yaml", 4, "this is no checkpoint of durer");
    workshop.fails("resume missing", 4, "cannot go on with missing");
    let room = String::from_utf8(workshop.bytes("room.yaml")).unwrap();
    workshop.put("room.yaml", &room.replace("skyblue", "gold"));
    workshop.fails("resume c", 3, "since it was made, the scene changed");
    assert!(!workshop.path("room.png").exists());
    assert_eq!(workshop.bytes("c"), good);
    workshop.put("room.yaml", &format!("# A comment changes nothing.\n{room}"));
    workshop.fine("resume c --quiet");
    assert!(workshop.path("room.png").exists());
}

#[test]
fn other_files_are_not_written_over() {
    let workshop = Workshop::new();
    let room = workshop.bytes("room.yaml");
    workshop.fails("render room.yaml --checkpoint room.yaml", 4, "room.yaml is not written over");
    workshop.fails("render room.yaml --checkpoint no/such/c", 4, "there is no folder `no/such`");
    assert_eq!((workshop.bytes("room.yaml"), workshop.names().len()), (room, 2));
}

#[test]
fn a_long_render_has_a_checkpoint_unasked_and_ctrl_c_keeps_it() {
    let workshop = Workshop::new();
    let mut child = start(&workshop, &format!("{LONG} --crop 0,0,1500,640"));
    let file = workshop.path("room.png.durer-checkpoint");
    assert!(wait_for(&mut child, || file.exists()));
    send(&child, "INT");
    let ran = end(child);
    assert_eq!(ran.code, Some(130), "{}", ran.stderr);
    assert!(ran.stderr.contains("go on with: durer resume room.png.durer-checkpoint"), "{}", ran.stderr);
    let names = ["bad.yaml", "room.partial.png", "room.png.durer-checkpoint", "room.yaml"];
    assert_eq!(workshop.names(), names, "nothing temporary is left");
    // A new one does not go on by itself: it tells of it, and does not replace it by less.
    let finished = || durer::read_checkpoint(&file).unwrap().film.finished_pixels();
    let before = finished();
    let mut child = start(&workshop, &format!("{LONG} --crop 0,0,1500,640"));
    assert!(wait_for(&mut child, || workshop.names().iter().any(|name| name.ends_with(".part"))));
    std::thread::sleep(Duration::from_millis(300));
    send(&child, "INT");
    let ran = end(child);
    let hint = "% of this picture; this begins anew, `durer resume room.png.durer-checkpoint` goes on";
    assert!(ran.stderr.contains(hint), "{}", ran.stderr);
    assert!(before > 0 && finished() >= before);
}

#[test]
fn a_render_goes_on_from_another_folder() {
    let workshop = Workshop::new();
    workshop.fine(&format!("render room.yaml -o whole.png {SLOW} --antialias grid:12"));
    kill_midway(&workshop, &format!("render room.yaml {SLOW} --antialias grid:12 --checkpoint c --checkpoint-every 0"));
    fs::create_dir(workshop.path("elsewhere")).unwrap();
    let mut command = workshop.command("resume ../c");
    let ran: Ran = command.current_dir(workshop.path("elsewhere")).output().unwrap().into();
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    assert_eq!(workshop.bytes("room.png"), workshop.bytes("whole.png"));
}

#[test]
fn a_checkpoint_that_cannot_be_written_is_told_once_and_stops_nothing() {
    let workshop = Workshop::new();
    fs::create_dir(workshop.path("folder")).unwrap();
    let words = format!("render room.yaml {SLOW} --antialias grid:12 --checkpoint folder/c --checkpoint-every 0");
    let mut child = start(&workshop, &words);
    assert!(wait_for(&mut child, || workshop.path("folder/c").exists()));
    // It may be being written just now.
    while fs::remove_dir_all(workshop.path("folder")).is_err() {}
    let ran = end(child);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    assert_eq!(ran.stderr.matches("cannot write the checkpoint folder/c").count(), 1, "{}", ran.stderr);
    assert!(workshop.path("room.png").exists());
}

#[test]
fn a_picture_that_cannot_be_written_in_the_end_is_not_lost() {
    let workshop = Workshop::new();
    workshop.fine(&format!("render room.yaml -o whole.png {SLOW} --antialias grid:8"));
    let mut child = start(&workshop, &format!("render room.yaml {SLOW} --antialias grid:8"));
    assert!(wait_for(&mut child, || workshop.names().iter().any(|name| name.ends_with(".part"))));
    fs::create_dir(workshop.path("room.png")).unwrap();
    let ran = end(child);
    assert_eq!(ran.code, Some(4), "{}", ran.stderr);
    assert!(ran.stderr.contains("cannot write room.png"), "{}", ran.stderr);
    assert!(ran.stderr.contains("go on with: durer resume room.png.durer-checkpoint"), "{}", ran.stderr);
    fs::remove_dir(workshop.path("room.png")).unwrap();
    workshop.fine("resume room.png.durer-checkpoint");
    assert_eq!(workshop.bytes("room.png"), workshop.bytes("whole.png"));
    assert_eq!(workshop.names(), ["bad.yaml", "room.png", "room.yaml", "whole.png"]);
}

/// A limit to the size of files stands for a full disk.
#[test]
fn a_lack_of_room_is_found_before_the_first_ray() {
    let workshop = Workshop::new();
    let limited = |words: &str| -> Ran {
        let mut command = Command::new("sh");
        let script = format!("trap '' XFSZ; ulimit -f 100; exec \"$0\" {words}");
        command.arg("-c").arg(script).arg(env!("CARGO_BIN_EXE_durer"));
        command.current_dir(workshop.path("")).output().unwrap().into()
    };
    let ran = limited(LONG);
    assert_eq!(ran.code, Some(4), "{}", ran.stderr);
    assert!(ran.stderr.contains("cannot write room.png, which may take"), "{}", ran.stderr);
    let ran = limited("render room.yaml --width 100 --checkpoint c");
    assert_eq!(ran.code, Some(4), "{}", ran.stderr);
    assert!(ran.stderr.contains("cannot write c, which may take"), "{}", ran.stderr);
    assert_eq!(workshop.names(), ["bad.yaml", "room.yaml"]);
    assert_eq!(limited("render room.yaml").code, Some(0));
}

#[test]
fn progress_is_json_for_programs() {
    let workshop = Workshop::new();
    let ran = workshop.fine(&format!("render room.yaml {SLOW} --antialias grid:8 --progress json --quiet"));
    let lines: Vec<serde_json::Value> = ran.stderr.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let phases: Vec<&str> = lines.iter().map(|line| line["phase"].as_str().unwrap()).collect();
    let mut different = phases.clone();
    different.dedup();
    assert_eq!(different, ["reading", "building", "rendering", "writing", "done"]);
    let numbers = |key: &str| lines.iter().filter_map(|line| line[key].as_f64()).collect::<Vec<f64>>();
    assert!(numbers("elapsed").is_sorted() && numbers("elapsed").len() == lines.len());
    assert!(numbers("finished").is_sorted() && numbers("total").iter().all(|&total| total == 320.0 * 213.0));
    let last = lines.last().unwrap();
    assert_eq!((&last["finished"], &last["remaining"]), (&68_160.into(), &0.0.into()));
    assert!(numbers("remaining").iter().all(|&seconds| seconds >= 0.0));
}

//! Inputs made to harm: the answer is a list of errors, soon, and never a panic.

use durer_formats::{Diagnostics, Limits, NoAssets, load_bytes, load_str};

fn refused(text: &str) -> Diagnostics {
    load_str(text, "hostile.yaml", &NoAssets, &Limits::default()).expect_err("must be refused")
}

#[track_caller]
fn refused_because(text: &str, why: &str) {
    let diagnostics = refused(text);
    assert!(diagnostics.list.iter().any(|one| one.message.contains(why)), "{diagnostics}");
    assert!(diagnostics.to_string().len() < 100_000);
}

#[test]
fn alias_bombs_stop_early() {
    let mut bomb = "a: &a [1, 2, 3, 4, 5, 6, 7, 8, 9, 10]\n".to_owned();
    for (of, name) in ('a'..'k').zip('b'..='k') {
        bomb += &format!("{name}: &{name} [*{of}, *{of}, *{of}, *{of}, *{of}, *{of}, *{of}, *{of}, *{of}, *{of}]\n");
    }
    refused_because(&bomb, "unfolds to more than");
}

#[test]
fn merge_bombs_stop_early() {
    let mut bomb = "k: &a0 {x: 1}\n".to_owned();
    for (i, of) in (1..40).zip(0..) {
        bomb += &format!("k{i}: &a{i} {{<<: [*a{of}, *a{of}, *a{of}], k{i}: *a{of}, l{i}: *a{of}}}\n");
    }
    refused_because(&bomb, "unfolds to more than");
}

#[test]
fn depth_is_limited() {
    refused_because(&"[".repeat(1_000_000), "nested");
    refused_because(&"{a: ".repeat(1_000_000), "nested");
    refused_because(&"- ".repeat(1_000_000), "nested");
    refused_because(&"? ".repeat(100_000), "nested");
    let stairs: String = (0..2000).map(|i| format!("{}a:\n", " ".repeat(i))).collect();
    refused_because(&stairs, "nested");
    let groups = format!("objects: {}[]{}", "[{group: {objects: ".repeat(40), "}}]".repeat(40));
    assert!(load_str(&groups, "groups", &NoAssets, &Limits::default()).is_ok());
    let deep = format!("objects: {}[]{}", "[{group: {objects: ".repeat(66), "}}]".repeat(66));
    refused_because(&deep, "groups may nest at most 64 deep");
    let paints = format!("textures: {{a: {}red{}}}", "{checker: {colors: [white, ".repeat(65), "]}}".repeat(65));
    refused_because(&paints, "at most 32 deep");
    let aliases: String = (1..100).map(|i| format!("a{i}: &a{i} [[[*a{}]]]\n", i - 1)).collect();
    refused_because(&format!("a0: &a0 []\n{aliases}"), "nested");
}

#[test]
fn long_things_are_shown_short() {
    refused_because(&"x".repeat(10 << 20), "expected the fields of a scene");
    refused_because(&format!("objects:\n  - sphere: {{radius: \"{}\"}}", "y".repeat(10 << 20)), "expected a number");
    refused_because(&format!("{}: 1", "k".repeat(900)), "unknown field");
    refused_because(&format!("objects: [{}]", "shpere, ".repeat(20_000)), "unknown object");
}

#[test]
fn many_mistakes_take_no_longer_than_many_values() {
    let names: String = (0..20_000).map(|i| format!("  a quite long name of a material {i}: {{}}\n")).collect();
    let uses: String =
        (0..20_000).map(|i| format!("  - sphere: {{material: another quite long name {i}}}\n")).collect();
    let wrong = refused(&format!("materials:\n{names}objects:\n{uses}"));
    assert_eq!(wrong.list.len(), 50);
    assert!(wrong.omitted > 1000);
    refused_because(&format!("objects: [{}]", "sphere: {radus: 1, colr: blakc}, ".repeat(20_000)), "unknown field");
    refused_because(&format!("objects: [{}]", "sphere: {radius: 0}, ".repeat(20_000)), "radius must be above 0");
    let fields: String = (0..50_000).map(|i| format!("field{i}: {i}\n")).collect();
    refused_because(&fields, "unknown field");
}

#[test]
fn all_kinds_of_line_ends_and_marks_are_read() {
    let text = "\u{feff}# a comment\r\nobjects:\r\n  - sphere: {radius: 2}\r\n";
    let loaded = load_str(text, "crlf", &NoAssets, &Limits::default()).unwrap();
    assert_eq!(loaded.scene.scene().objects.len(), 1);
    let wrong = refused("\u{feff}objects:\r\n  - sphere: {radus: 2}\r\n");
    assert_eq!((wrong.list[0].line, wrong.list[0].column), (2, 14));
    let first = refused("\u{feff}objcts: []");
    assert_eq!((first.list[0].line, first.list[0].column), (1, 1));
}

#[test]
fn numbers_without_measure_are_refused() {
    let of_radius = |number: &str| format!("objects: [sphere: {{radius: {number}}}]");
    for number in ["1e999999999", "-1e999999999", &"9".repeat(1_000_000), "1e309", "0x1p99999"] {
        let shown = &number[..number.len().min(20)];
        let diagnostics = refused(&of_radius(number));
        assert_eq!(diagnostics.list.len(), 1, "{shown}: {diagnostics}");
        assert!(diagnostics.to_string().len() < 100_000, "{shown}");
    }
    refused_because(&of_radius("1e-999999999"), "radius must be above 0");
    refused_because(&of_radius(&format!("0.{}1", "0".repeat(1_000_000))), "radius must be above 0");
    refused_because("picture: {width: 99999999999999999999, height: -7}", "expected");
}

#[test]
fn what_is_not_text_is_refused() {
    for bytes in [
        &b"objects: \xff\xfe"[..],
        b"\x00",
        b"a: b\0c",
        b"\xff",
        b"PK\x03\x04\x9f\x00",
        b"\xff\xfeo\0b\0j\0:\0",
        b"\0\0\0o",
    ] {
        let diagnostics = load_bytes(bytes, "binary", &NoAssets, &Limits::default()).unwrap_err();
        assert!(!diagnostics.to_string().is_empty());
    }
}

#[test]
fn large_scenes_load() {
    let line = "  - sphere: {center: [0, 1, 0], radius: 1, material: {color: [0.1, 0.2, 0.3]}}\n";
    let text = format!("objects:\n{}", line.repeat(20_000));
    assert_eq!(load_str(&text, "large", &NoAssets, &Limits::default()).unwrap().scene.scene().objects.len(), 20_000);
}

/// Who follows all names from each of them never ends.
#[test]
fn names_of_names_are_told_soon() {
    let names: String = (0..20_000).map(|at| format!("  m{at}: m{}\n", at + 1)).collect();
    for section in ["materials", "textures"] {
        for end in ["{}", "{checker: {}}", "m0"] {
            let text = format!("{section}:\n{names}  m20000: {end}\n");
            let wrong = load_str(&text, "names", &NoAssets, &Limits::default()).unwrap_err();
            assert!(wrong.list[0].message.ends_with("found the name of one, `m1`"), "{}", wrong.list[0].message);
            assert_eq!(wrong.list[0].help, None);
        }
    }
}

#[test]
fn mutated_scenes_never_panic() {
    const SCENE: &str = include_str!("every_field.yaml");
    #[rustfmt::skip]
    let pieces = [
        "{", "}", "[", "]", ":", ": ", "- ", "\n", "  ", "\t", "&a ", "*a", "<<: *a", "!x ", "'", "\"", "#", "|", ">", "%",
        "?", ",", "1e999", "-1", ".nan", "0", "\u{feff}", "\u{0}", "ä", "\r", "---\n", "...\n", "~", "null",
    ];
    let mut random = 1_u64;
    let mut next = move |below: usize| {
        random ^= random << 13;
        random ^= random >> 7;
        random ^= random << 17;
        (random % below.max(1) as u64) as usize
    };
    for _ in 0..10_000 {
        let mut bytes = SCENE.as_bytes().to_vec();
        // Mostly a window, so that each is short and most changes are met.
        let from = next(bytes.len());
        if next(4) > 0 {
            bytes.drain(..SCENE[..from].rfind('\n').map_or(0, |line| line + 1));
            bytes.truncate(400);
        }
        for _ in 0..=next(4) {
            let at = next(bytes.len());
            match next(4) {
                0 => drop(bytes.drain(at..(at + next(20)).min(bytes.len()))),
                1 => bytes[at] = next(256) as u8,
                _ => drop(bytes.splice(at..at, pieces[next(pieces.len())].bytes())),
            }
            if bytes.is_empty() {
                bytes.push(b'a');
            }
        }
        let text = String::from_utf8_lossy(&bytes);
        if let Err(diagnostics) = load_str(&text, "mutated", &NoAssets, &Limits::default()) {
            assert!(!diagnostics.is_empty(), "refused without a reason:\n{text}");
            assert!(!diagnostics.render(true).is_empty());
        }
    }
}

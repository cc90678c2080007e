//! `durer heatmap`.

use crate::workshop::Workshop;

#[test]
fn a_map_is_black_where_nothing_is_tested_and_bright_where_much_is() {
    let workshop = Workshop::new();
    // One ball is tested for every ray; nothing else is there.
    workshop.put("ball.yaml", "picture: {width: 20, height: 10}\nobjects: [sphere]");
    let ran = workshop.fine("heatmap ball.yaml");
    assert_eq!(ran.stdout, "");
    let expected = "ball.heat.png: 20 × 10 pixels; nodes: 0 in the mean, at most 0; \
                    primitives: 1 in the mean, at most 1; the scale ends at 1";
    assert_eq!(ran.stderr.trim_end(), expected);
    let brightness = |name: &str| workshop.picture(name).pixels.iter().map(|p| p.luminance()).fold(0.0, f32::max);
    assert!(brightness("ball.heat.png") > 0.9);
    workshop.fine("heatmap ball.yaml --what nodes -q -o nodes.png");
    assert!(brightness("nodes.png") < 0.01);
    workshop.fine("heatmap ball.yaml --scale 1000 -q -o dark.png");
    assert!(brightness("dark.png") < 0.01);
}

#[test]
fn the_numbers_are_there_for_programs_and_do_not_depend_on_threads() {
    let workshop = Workshop::new();
    let json = |threads: u32| {
        workshop.fine(&format!("heatmap room.yaml --json --threads {threads} -o {threads}.png --width 50")).json()
    };
    let (one, many) = (json(1), json(4));
    assert_eq!((&one["width"], &one["height"]), (&50.into(), &33.into()));
    for what in ["nodes", "primitives"] {
        assert!(one[what]["max"].as_f64() >= one[what]["mean"].as_f64(), "{one}");
        assert!(one[what]["mean"].as_f64() > Some(0.5), "{one}");
        assert_eq!(one[what], many[what]);
    }
    assert_eq!(workshop.bytes("1.png"), workshop.bytes("4.png"));
}

#[test]
fn wrong_maps_are_refused() {
    let workshop = Workshop::new();
    workshop.fails("heatmap room.yaml -o a.txt", 2, "a.txt");
    workshop.fails("heatmap room.yaml --scale 0", 2, "--scale");
    workshop.fails("heatmap room.yaml --what time", 2, "primitives");
    workshop.fails("heatmap bad.yaml", 3, "radius");
    workshop.fails("heatmap room.yaml --width 65535 --height 65535", 2, "--width and --height");
    assert_eq!(workshop.names(), ["bad.yaml", "room.yaml"], "and nothing is left behind");
}

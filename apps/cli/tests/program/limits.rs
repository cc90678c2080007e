//! How much a scene may ask for.

use crate::workshop::Workshop;

#[test]
fn what_asks_for_more_than_it_may_is_refused_before_it_is_built() {
    let workshop = Workshop::new();
    let refused = |limits: &str, message: &str| {
        workshop.fails(&format!("render room.yaml --limits {limits}"), 3, message);
        workshop.fails(&format!("render room.yaml -q -o b.png --limits {limits}"), 3, "if you trust this scene");
        workshop.fails(&format!("check room.yaml --limits {limits}"), 3, message);
    };
    refused("pixels=383", "it asks for 384 pixels, but only 383 pixels are allowed");
    refused("samples=383", "`--limits samples=384`");
    refused("primitives=3", "it asks for 4 primitives");
    refused("memory=10KiB", "of memory, but only 10 KiB of memory are allowed");
    refused("scene=100", "but only 100 bytes of files are allowed");
    refused("values=10", "more than 10 values");
    workshop.fails("check room.yaml --limits nesting=3", 3, "nested more than 3 levels deep");
    workshop.fails("check room.yaml --limits nesting=3", 3, "`--limits nesting=200`");
    workshop.fails("render room.yaml --width 300 --limits pixels=50000", 3, "`--limits pixels=60000`");
    workshop.fails("explain room.yaml --pixel 1,1 --limits pixels=3", 3, "`--limits pixels=384`");
    workshop.fails("heatmap room.yaml --limits pixels=3", 3, "`--limits pixels=384`");
    workshop.fails("info room.yaml --limits primitives=1", 3, "`--limits primitives=4`");
    assert_eq!(workshop.names(), ["bad.yaml", "room.yaml"]);
    workshop.fine("render room.yaml --limits pixels=384,samples=384,primitives=4");
    workshop.fine("render room.yaml --limits untrusted");
}

#[test]
fn wrong_limits_get_help() {
    let workshop = Workshop::new();
    workshop.fails("check room.yaml --limits pixel=3", 2, "did you mean `pixels`?");
    workshop.fails("check room.yaml --limits memory=3pixels", 2, "for example 500MiB or 2GiB");
    workshop.fails("check room.yaml --limits careful", 2, "expected KEY=VALUE");
}

#[test]
fn files_and_images_are_limited_before_they_are_read() {
    let workshop = Workshop::new();
    workshop.fine("render room.yaml -o wall.png");
    workshop.put("image.yaml", "textures: {a: {image: {file: wall.png}}}\n");
    workshop.fails("check image.yaml --limits file=100", 3, "but only 100 bytes of files are allowed");
    workshop.fails("check image.yaml --limits files=100", 3, "`--limits files=");
    workshop.fails("check image.yaml --limits textures=100", 3, "`--limits textures=");
    workshop.put("dots.csv", "x,y,z\n1,2,3\n");
    workshop.put("dots.yaml", "objects: [spheres: {centers: {file: dots.csv}, radius: 1}]\n");
    workshop.fails("check dots.yaml --limits file=5", 3, "`--limits file=1MiB`");
    workshop.fails("check dots.yaml --limits memory=5", 3, "`--limits memory=");
    workshop.put("tri.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 3 2 1\n");
    workshop.fails("check tri.obj --limits file=5", 3, "`--limits file=1MiB`");
    workshop.fails("check tri.obj --limits primitives=1", 3, "more than 1 triangles");
}

/// Long enough for the limit to come first: 1.5 million pixels of 4096 rays each.
#[test]
fn when_the_time_is_up_the_run_ends() {
    let workshop = Workshop::new();
    let long = "render room.yaml --width 1500 --antialias grid:64 --limits time=1";
    workshop.fails(long, 130, "time limit");
    assert!(!workshop.names().iter().any(|name| name.ends_with(".part")), "{:?}", workshop.names());
    assert!(!workshop.names().contains(&"room.png".to_owned()));
}

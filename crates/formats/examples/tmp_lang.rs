use std::time::Instant;
fn main() {
    let mode = std::env::args().nth(1).unwrap();
    if mode == "bless" {
        std::fs::write("docs/scene.schema.json", format!("{:#}\n", durer_formats::json_schema())).unwrap();
        std::fs::write("docs/reference.md", durer_formats::reference_markdown()).unwrap();
        return;
    }
    for file in std::env::args().skip(2) {
        for _ in 0..3 {
            let start = Instant::now();
            let loaded = durer_formats::load_file(format!("{mode}/{file}"), &durer_formats::LoadOptions::default());
            let took = start.elapsed();
            match loaded {
                Ok(loaded) => {
                    let scene = loaded.scene.into_scene();
                    let start = Instant::now();
                    let checked = scene.check().unwrap();
                    let check = start.elapsed();
                    let start = Instant::now();
                    let n = if file.contains("inline") { durer_formats::to_yaml(checked.scene()).len() } else { 0 };
                    println!("{file}: load {took:?}, check {check:?}, write {:?} {n}", start.elapsed());
                }
                Err(e) => println!("{file}: {e}"),
            }
        }
    }
}

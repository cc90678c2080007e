//! The same scene gives the same bytes, however it is rendered.

use crate::room::room;
use crate::support::{Numbers, compile, explained, scene};
use durer::scene::{Antialias, PixelFilter};
use durer::{CompiledScene, Film, Progress, Region, RenderOptions};
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

type Mode = (Antialias, PixelFilter);

const MODES: [Mode; 10] = [
    (Antialias::None, PixelFilter::Box),
    (Antialias::Grid { n: 1 }, PixelFilter::Box),
    (Antialias::Grid { n: 3 }, PixelFilter::Box),
    (Antialias::Recursive { threshold: 0.1, max_depth: 2 }, PixelFilter::Box),
    (Antialias::ADAPTIVE, PixelFilter::Box),
    (Antialias::Pov1 { threshold: 0.2, depth: 3 }, PixelFilter::Box),
    (Antialias::Pov2 { threshold: 0.2, depth: 3 }, PixelFilter::Box),
    (Antialias::Recursive { threshold: 0.1, max_depth: 1 }, PixelFilter::Tent { radius: 1.0 }),
    (Antialias::ADAPTIVE, PixelFilter::Mitchell { radius: 2.0 }),
    (Antialias::Pov1 { threshold: 0.2, depth: 2 }, PixelFilter::BlackmanHarris { radius: 3.0 }),
];

/// The seed's room in a small size, which is no multiple of a tile.
fn small_room((antialias, filter): Mode, width: u32, height: u32) -> CompiledScene {
    let mut scene = room();
    (scene.render.antialias, scene.render.filter) = (antialias, filter);
    (scene.picture.width, scene.picture.height) = (width, height);
    compile(scene)
}

fn rendered(scene: &CompiledScene, options: &RenderOptions) -> Film {
    durer::render(scene, options, &()).expect("a picture")
}

#[test]
fn any_number_of_threads_gives_the_same_film() {
    for mode in MODES {
        let scene = small_room(mode, 75, 70);
        let one = rendered(&scene, &RenderOptions { threads: Some(1), ..RenderOptions::default() });
        assert_eq!(one.finished_pixels(), 75 * 70);
        for threads in [2, 3, 8] {
            let many = rendered(&scene, &RenderOptions { threads: Some(threads), ..Default::default() });
            assert!(one == many, "{threads} threads, {mode:?}");
        }
    }
}

#[test]
fn compiling_again_gives_the_same_film() {
    let film = || rendered(&small_room(MODES[3], 40, 33), &RenderOptions::default());
    assert!(film() == film());
}

#[test]
fn a_region_is_the_same_part_of_the_whole() {
    for mode in MODES {
        let scene = small_room(mode, 75, 70);
        let whole = rendered(&scene, &RenderOptions::default()).develop();
        for region in [(0, 0, 75, 70), (13, 7, 40, 35), (74, 69, 1, 1), (5, 0, 1, 70), (0, 33, 75, 2)] {
            let (x, y, width, height) = region;
            let region = Region { x, y, width, height };
            let film = rendered(&scene, &RenderOptions { region: Some(region), ..Default::default() });
            assert_eq!(film.region(), region);
            let part = film.develop();
            for row in 0..height {
                for column in 0..width {
                    assert_eq!(part.pixel(column, row), whole.pixel(x + column, y + row), "{mode:?} {region:?}");
                }
            }
        }
    }
}

/// Small things are looked for where they are; that must not depend on what else is looked at.
#[test]
fn a_region_of_small_things_is_the_same_part_of_the_whole() {
    let mut numbers = Numbers(7);
    let mut balls = String::new();
    for _ in 0..60 {
        let (x, y, radius) = (2.0 * numbers.signed(), 2.0 * numbers.signed(), 0.03 * numbers.next());
        balls += &format!("  - sphere: {{center: [{x}, {y}, 0], radius: {radius}}}\n");
        balls += &format!("  - cylinder: {{base: [{x}, {y}, -1], top: [{y}, {x}, -1.5], radius: {}}}\n", radius * 0.1);
    }
    for filter in ["box", "gaussian"] {
        let text = format!(
            "picture: {{width: 60, height: 60}}\nrender: {{filter: {filter}}}\n\
             camera: {{position: [0, 0, 5], look_at: [0, 0, 0]}}\nobjects:\n{balls}"
        );
        let scene = compile(scene(&text));
        let whole = rendered(&scene, &RenderOptions::default()).develop();
        for pixel in explained(&scene).step_by(7) {
            assert_eq!(pixel.color, whole.pixel(pixel.x, pixel.y), "{filter} ({}, {})", pixel.x, pixel.y);
        }
    }
}

#[test]
fn a_region_must_lie_within_the_picture() {
    let scene = small_room(MODES[0], 20, 10);
    for (x, y, width, height) in [(0, 0, 21, 1), (20, 0, 1, 1), (0, 0, 0, 5), (u32::MAX, 0, 2, 2), (0, 9, 1, 2)] {
        let region = Some(Region { x, y, width, height });
        assert!(durer::render(&scene, &RenderOptions { region, ..Default::default() }, &()).is_err());
    }
}

/// Also that the colour is the sum of the contributions in their order, to the last bit.
#[test]
fn explain_shows_every_pixel_of_the_room_as_it_was_rendered() {
    for mode in MODES {
        let scene = small_room(mode, 36, 30);
        let film = rendered(&scene, &RenderOptions::default());
        let mut rays = 0;
        let counted = film.rays();
        let image = film.develop();
        for pixel in explained(&scene) {
            let rendered = image.pixel(pixel.x, pixel.y);
            assert_eq!(pixel.color, rendered, "{mode:?} ({}, {})", pixel.x, pixel.y);
            assert_eq!(pixel.sum(), rendered, "{mode:?} ({}, {})", pixel.x, pixel.y);
            rays += pixel.samples.len() as u64;
            let kept: f64 = pixel.samples.iter().filter_map(|sample| sample.weight).map(f64::from).sum();
            assert!((kept - 1.0).abs() < 1e-6, "the weights are one pixel together, not {kept} {mode:?}");
        }
        // Where pixels share no samples, all of them are shown.
        if matches!(mode.0, Antialias::None | Antialias::Grid { .. } | Antialias::Recursive { .. })
            && mode.1 == PixelFilter::Box
        {
            assert_eq!(rays, counted.eye, "{mode:?}");
        }
    }
}

#[test]
fn there_is_nothing_to_explain_outside_of_the_picture() {
    let scene = small_room(MODES[0], 20, 10);
    assert!(durer::explain(&scene, 20, 0).is_none() && durer::explain(&scene, 0, 10).is_none());
    assert!(durer::explain(&scene, 19, 9).is_some());
}

/// Stops after so many tiles or bands.
struct StopAfter(AtomicU64);

impl Progress for StopAfter {
    fn advanced(&self, _film: &Film) {
        let _ = self.0.fetch_update(Relaxed, Relaxed, |left| left.checked_sub(1));
    }

    fn stop(&self) -> bool {
        self.0.load(Relaxed) == 0
    }
}

#[test]
fn a_render_that_was_stopped_goes_on_to_the_same_picture() {
    for mode in MODES {
        let scene = small_room(mode, 75, 130);
        let whole = rendered(&scene, &RenderOptions::default());
        let mut film = durer::render(&scene, &RenderOptions::default(), &StopAfter(AtomicU64::new(1))).expect("a film");
        let mut stops = 0;
        while !film.is_complete() {
            stops += 1;
            let stop = StopAfter(AtomicU64::new(1));
            film = durer::render_on(&scene, film, &RenderOptions::default(), &stop).expect("a film");
        }
        assert!(stops >= 3, "{mode:?}: {stops}");
        assert!(film.develop() == whole.develop(), "{mode:?}");
    }
}

#[test]
fn films_of_other_pictures_are_refused() {
    let film = rendered(&small_room(MODES[0], 40, 30), &RenderOptions::default());
    let smaller = small_room(MODES[0], 30, 40);
    assert!(durer::render_on(&smaller, film, &RenderOptions::default(), &()).is_err());
}

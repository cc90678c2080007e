//! What is chosen of the background, against what is there.

use super::*;
use crate::textures::Environment;
use durer_imaging::{Bitmap, Texels};
use durer_math::Rgb;
use durer_math::functions::{cos, sin};
use durer_scene::{ImageAsset, ImageId, Scene};
use std::sync::Arc;

fn plane_points(count: u32) -> impl Iterator<Item = DVec2> {
    (0..count).map(move |index| {
        let second = (f64::from(index.reverse_bits()) + 0.5) / 4_294_967_296.0;
        DVec2::new((f64::from(index) + 0.5) / f64::from(count), second)
    })
}

fn on_sphere(at: DVec2) -> DVec3 {
    let (y, angle) = (1.0 - 2.0 * at.x, 2.0 * PI * at.y);
    let across = (1.0 - y * y).sqrt();
    DVec3::new(across * cos(angle), y, across * sin(angle))
}

fn image(width: u32, height: u32, luminance: impl Fn(u32, u32) -> f32) -> Background {
    let texels = (0..width * height).map(|at| [luminance(at % width, at / width); 3]).collect();
    let bitmap = Arc::new(Bitmap { width, height, texels: Texels::F32(texels), alpha: None });
    let images = vec![ImageAsset { file: "sky.hdr".to_owned(), bitmap }];
    let map = durer_scene::Environment { image: ImageId(0), rotation_degrees: 70.0, strength: 2.0 };
    Background::Image(Environment::compile(&map, &Scene { images, ..Scene::default() }))
}

fn receivers() -> [Receiver; 3] {
    let normal = DVec3::new(0.48, 0.64, -0.6);
    let receiver = Receiver { point: DVec3::ZERO, normal, passes: false };
    [receiver, Receiver { passes: true, ..receiver }, Receiver { normal: DVec3::NEG_Y, ..receiver }]
}

/// Directions fall in the cells of a grid on the sphere as often as the density says (Pearson's test at 1 in 10⁵), the
/// density is 1 in all, and the mean of what is seen over it is all that is there.
#[track_caller]
fn agrees(background: &Background) {
    const CELLS: [usize; 2] = [12, 8];
    const SAMPLES: u32 = 20_000;
    let sky = Sky::new(background).unwrap();
    for receiver in receivers() {
        let cell = |direction: DVec3| {
            let longitude = durer_math::functions::atan2(direction.z, direction.x) / (2.0 * PI) + 0.5;
            let column = ((longitude * CELLS[0] as f64) as usize).min(CELLS[0] - 1);
            let row = ((0.5 * (direction.y + 1.0) * CELLS[1] as f64) as usize).min(CELLS[1] - 1);
            row * CELLS[0] + column
        };
        let (mut expected, mut all, mut light) = (vec![0.0; CELLS[0] * CELLS[1]], 0.0, 0.0);
        const DIRECTIONS: u32 = 1 << 19;
        for at in plane_points(DIRECTIONS) {
            let (direction, share) = (on_sphere(at), 4.0 * PI / f64::from(DIRECTIONS));
            let pdf = sky.pdf(background, &receiver, &background.look(direction));
            all += pdf * share;
            expected[cell(direction)] += pdf * share;
            if pdf > 0.0 {
                light += f64::from(background.seen(direction).luminance()) * share;
            }
        }
        assert!((all - 1.0).abs() < 5e-3, "the density is {all} in all");
        let (mut found, mut mean) = (vec![0.0; expected.len()], 0.0);
        for index in 0..SAMPLES {
            let sampler = crate::sampler::Sampler::new(7, (3, 4), index);
            let at = sampler.two(0, crate::sampler::Purpose::LightPoint);
            let Some((look, pdf)) = sky.sample(background, &receiver, at) else { continue };
            let (direction, seen) = (look.direction, background.light(&look));
            assert!(direction.is_normalized());
            let again = sky.pdf(background, &receiver, &background.look(direction));
            assert!((again / pdf - 1.0).abs() < 1e-4, "{pdf} is not {again}");
            found[cell(direction)] += 1.0;
            let again = background.seen(direction);
            assert!(
                (again.luminance() - seen.luminance()).abs() <= 1e-3 * seen.luminance(),
                "{seen:?} is not {again:?}"
            );
            mean += f64::from(seen.luminance()) / pdf / f64::from(SAMPLES);
        }
        // Where the cosine is in it, the grazing directions make this noisier.
        assert!((mean / light - 1.0).abs() < 0.06, "{mean} by samples, {light} by all directions");
        let (mut statistic, mut degrees) = (0.0, -1.0);
        for (found, expected) in found.iter().zip(&expected) {
            let expected = expected * f64::from(SAMPLES);
            if expected >= 5.0 {
                statistic += (found - expected) * (found - expected) / expected;
                degrees += 1.0;
            } else {
                assert!(*found < 25.0, "{found} where {expected} were expected");
            }
        }
        // Wilson and Hilferty's approximation of the quantile.
        let root = 1.0 - 2.0 / (9.0 * degrees) + 4.3 * (2.0_f64 / (9.0 * degrees)).sqrt();
        let limit = degrees * root * root * root;
        assert!(statistic < limit, "χ² = {statistic} with {degrees} degrees of freedom; the limit is {limit}");
    }
}

#[test]
fn even_skies() {
    agrees(&Background::Color(Rgb::new(0.2, 0.5, 0.9)));
}

#[test]
fn gradients() {
    let colors = [Rgb::gray(0.1), Rgb::new(0.4, 0.9, 2.0)];
    agrees(&Background::Gradient { bottom: colors[0], top: colors[1] });
    agrees(&Background::Gradient { bottom: colors[1], top: colors[0] });
    agrees(&Background::Gradient { bottom: Rgb::BLACK, top: colors[1] });
    agrees(&Background::Gradient { bottom: colors[1], top: colors[1] });
}

#[test]
fn maps() {
    agrees(&image(16, 8, |column, row| 0.1 + (column * 3 + row * 5) as f32 % 7.0));
    agrees(&image(1, 1, |_, _| 0.3));
    agrees(&image(3, 5, |column, row| if row == 1 { 1.0 + column as f32 } else { 0.0 }));
    // The last tiles have fewer cells, which fill fewer cache lines.
    agrees(&image(520, 260, |column, row| 1.0 + ((column / 7 + row / 5) % 5) as f32));
    agrees(&image(1025, 512, |column, row| 1.0 + ((column / 9 + row / 7) % 4) as f32));
    // A sun of one pixel, which is seen in its neighbors, too.
    agrees(&image(24, 12, |column, row| if (column, row) == (5, 3) { 1000.0 } else { 0.05 }));
}

#[test]
fn numbers_that_no_light_has_count_as_none() {
    let broken = [f32::NAN, -3.0, 0.0, 1.0, 2.0];
    agrees(&image(5, 3, |column, _| if column < 2 { 0.0 } else { broken[column as usize] }));
    assert!(Sky::new(&image(4, 2, |_, _| 0.0)).is_none());
    assert!(Sky::new(&image(4, 2, |_, _| -1.0)).is_none());
    assert!(Sky::new(&Background::Color(Rgb::BLACK)).is_none());
    assert!(Sky::new(&Background::Gradient { bottom: Rgb::BLACK, top: Rgb::BLACK }).is_none());
    let sky = Sky::new(&image(5, 3, |column, _| broken[column as usize]));
    assert!(sky.is_some_and(|sky| sky.mean.is_finite()));
}

/// More pixels than cells: what shares a cell is chosen together.
#[test]
fn large_maps_share_cells() {
    let background = image(4099, 3, |column, _| if column == 4098 { 5.0 } else { 0.5 });
    let sky = Sky::new(&background).unwrap();
    let Kind::Map(map) = &sky.kind else { panic!("{sky:?}") };
    let Background::Image(environment) = &background else { panic!() };
    let receiver = Receiver { point: DVec3::ZERO, normal: DVec3::Y, passes: true };
    let mut sum = 0.0;
    const DIRECTIONS: u32 = 1 << 16;
    for at in plane_points(DIRECTIONS) {
        let direction = on_sphere(at);
        sum +=
            map.pdf(environment, &receiver, environment.place(direction), direction) * 4.0 * PI / f64::from(DIRECTIONS);
        let (place, direction, pdf) = map.sample(environment, &receiver, at).unwrap();
        assert!((map.pdf(environment, &receiver, place, direction) / pdf - 1.0).abs() < 1e-4);
    }
    assert!((sum - 1.0).abs() < 2e-3, "{sum}");
}

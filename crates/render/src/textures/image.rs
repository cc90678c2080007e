//! A picture from a file, laid on things.

use super::cells::{cell, fraction};
use super::texels::{BRIGHTEST, Tables, Texels};
use super::wrap::wrap_pixel;
use durer_imaging::Bitmap;
use durer_math::{DVec2, DVec3, Rgb, functions};
use durer_scene::{Filter, ImageTexture, Mapping, Wrap};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

/// An image and how it lies. Pixel i of n reaches from i/n to (i + 1)/n, columns from the left and rows from below.
#[derive(Debug)]
pub(super) struct Image {
    texels: Texels,
    mapping: Mapping,
    wrap: Wrap,
    filter: Filter,
    /// Multiplies what is found.
    tint: Rgb,
}

impl Image {
    pub(super) fn new(texture: &ImageTexture, bitmap: &Arc<Bitmap>, tables: &mut Tables) -> Image {
        Image {
            texels: Texels::new(bitmap, texture.channels, texture.encoding, tables),
            mapping: texture.mapping,
            wrap: texture.wrap,
            filter: texture.filter,
            tint: texture.tint,
        }
    }

    /// The linear colour at a point of the texture's space; for [`Mapping::Uv`], at (u, v, anything).
    pub(super) fn color(&self, point: DVec3) -> Rgb {
        let place = self.place(point);
        let [width, height] = self.texels.size();
        let in_pixels = place * DVec2::new(f64::from(width), f64::from(height));
        let found = match self.filter {
            Filter::Nearest => self.pixel(cell(in_pixels.x), cell(in_pixels.y)),
            Filter::Bilinear => self.bilinear(in_pixels - 0.5),
        };
        (found * self.tint).map(|component| component.min(BRIGHTEST))
    }

    /// Where on the image a point of the texture's space is: from (0, 0) at its lower left corner to (1, 1).
    pub(super) fn place(&self, point: DVec3) -> DVec2 {
        place_on_image(self.mapping, point)
    }

    /// Blends the four pixels around a place that counts pixels from centre to centre.
    fn bilinear(&self, place: DVec2) -> Rgb {
        let (left, below) = (place.x.floor() as i64, place.y.floor() as i64);
        let (right, above) = (left.saturating_add(1), below.saturating_add(1));
        let (across, up) = (fraction(place.x) as f32, fraction(place.y) as f32);
        let lower = self.pixel(left, below).lerp(self.pixel(right, below), across);
        let upper = self.pixel(left, above).lerp(self.pixel(right, above), across);
        lower.lerp(upper, up)
    }

    /// The colour of a pixel, within the image or beyond it.
    fn pixel(&self, column: i64, row: i64) -> Rgb {
        let [width, height] = self.texels.size();
        self.texels.get(wrap_pixel(self.wrap, column, width), wrap_pixel(self.wrap, row, height))
    }
}

/// (s, t) by the formulas of [`Mapping`].
fn place_on_image(mapping: Mapping, p: DVec3) -> DVec2 {
    match mapping {
        Mapping::Uv | Mapping::Planar => DVec2::new(p.x, p.y),
        Mapping::Spherical => DVec2::new(around_y(p), functions::asin(p.y / p.length()) / PI + 0.5),
        Mapping::Cylindrical { half_height } => DVec2::new(around_y(p), (p.y + half_height) / (2.0 * half_height)),
    }
}

/// From 0 at -x by way of -z, +x and +z to 1 at -x again.
fn around_y(p: DVec3) -> f64 {
    (functions::atan2(p.z, p.x) + PI) / TAU
}

#[cfg(test)]
mod tests {
    use super::*;
    use durer_imaging::{Alpha, Texels as Stored};
    use durer_scene::{Channels, Encoding, ImageId};

    const WRAPS: [Wrap; 3] = [Wrap::Repeat, Wrap::Clamp, Wrap::Mirror];

    /// Each pixel's red is its column from the left, its green its row from below.
    fn image(size: [u32; 2], mapping: Mapping, wrap: Wrap, filter: Filter) -> Image {
        let [width, height] = size;
        let pixel = |i: u32| [(i % width) as f32, (height - 1 - i / width) as f32, 0.0];
        let texels = Stored::F32((0..width * height).map(pixel).collect());
        let bitmap = Arc::new(Bitmap { width, height, texels, alpha: None });
        let texture = ImageTexture {
            image: ImageId(0),
            mapping,
            wrap,
            filter,
            encoding: Encoding::Linear,
            channels: Channels::Color,
            tint: Rgb::WHITE,
        };
        Image::new(&texture, &bitmap, &mut Tables::default())
    }

    fn at(image: &Image, s: f64, t: f64) -> [f32; 2] {
        let color = image.color(DVec3::new(s, t, 3.0));
        [color.r, color.g]
    }

    #[test]
    fn the_lower_left_corner_is_at_zero() {
        for wrap in WRAPS {
            let image = image([4, 8], Mapping::Uv, wrap, Filter::Nearest);
            assert_eq!(at(&image, 0.0, 0.0), [0.0, 0.0]);
            assert_eq!(at(&image, 0.99, 0.01), [3.0, 0.0]);
            assert_eq!(at(&image, 0.01, 0.99), [0.0, 7.0]);
            assert_eq!(at(&image, 0.5, 0.375), [2.0, 3.0], "a pixel owns its lower and left edges");
        }
    }

    #[test]
    fn beyond_the_edges() {
        for (wrap, before, after) in [
            (Wrap::Repeat, [2.0, 5.0], [0.0, 2.0]),
            (Wrap::Clamp, [0.0, 0.0], [3.0, 7.0]),
            (Wrap::Mirror, [1.0, 2.0], [3.0, 5.0]),
        ] {
            let image = image([4, 8], Mapping::Planar, wrap, Filter::Nearest);
            assert_eq!(at(&image, -0.26, -0.26), before, "{wrap:?}");
            assert_eq!(at(&image, 1.24, 1.26), after, "{wrap:?}");
        }
    }

    #[test]
    fn bilinear_is_exact_at_centres_and_halfway_between() {
        for wrap in WRAPS {
            let image = image([4, 8], Mapping::Uv, wrap, Filter::Bilinear);
            assert_eq!(at(&image, 0.375, 0.4375), [1.0, 3.0], "a centre");
            assert_eq!(at(&image, 0.5, 0.5), [1.5, 3.5], "a corner of four pixels");
            assert_eq!(at(&image, 0.4375, 0.4375), [1.25, 3.0], "a quarter of the way");
        }
    }

    #[test]
    fn bilinear_reaches_across_the_edges_as_they_wrap() {
        for (wrap, edge, last) in [
            (Wrap::Repeat, [1.5, 3.5], [1.5, 3.5]),
            (Wrap::Clamp, [0.0, 0.0], [3.0, 7.0]),
            (Wrap::Mirror, [0.0, 0.0], [3.0, 7.0]),
        ] {
            let image = image([4, 8], Mapping::Uv, wrap, Filter::Bilinear);
            assert_eq!(at(&image, 0.0, 0.0), edge, "{wrap:?}");
            assert_eq!(at(&image, 1.0, 1.0), last, "{wrap:?}");
        }
    }

    /// Halfway between black and white is half the light, not the middle of the numbers in the file.
    #[test]
    fn bilinear_blends_light() {
        let texels = Stored::U8(vec![[0; 3], [255; 3]]);
        let bitmap = Arc::new(Bitmap { width: 2, height: 1, texels, alpha: None });
        let texture = ImageTexture {
            image: ImageId(0),
            mapping: Mapping::Uv,
            wrap: Wrap::Clamp,
            filter: Filter::Bilinear,
            encoding: Encoding::Srgb,
            channels: Channels::Color,
            tint: Rgb::WHITE,
        };
        let color = Image::new(&texture, &bitmap, &mut Tables::default()).color(DVec3::new(0.5, 0.5, 0.0));
        assert!((color.r - 0.5).abs() < 1e-6, "{color:?}");
    }

    /// Three quarters of the way from nothing to all, of alpha; the tint multiplies it.
    #[test]
    fn alpha_is_blended_and_tinted() {
        let (texels, alpha) = (Stored::U8(vec![[7; 3]; 2]), Some(Alpha::U8(vec![0, 255])));
        let bitmap = Arc::new(Bitmap { width: 2, height: 1, texels, alpha });
        let texture = ImageTexture {
            image: ImageId(0),
            mapping: Mapping::Uv,
            wrap: Wrap::Clamp,
            filter: Filter::Bilinear,
            encoding: Encoding::Srgb,
            channels: Channels::Alpha,
            tint: Rgb::new(1.0, 0.5, 2.0),
        };
        let color = Image::new(&texture, &bitmap, &mut Tables::default()).color(DVec3::new(0.625, 0.5, 0.0));
        assert_eq!(color, Rgb::new(0.75, 0.375, 1.5));
    }

    /// The label of the seed scene's cylinder: s = (atan2(z, x) + π) / 2π, t = (y + 8) / 16.
    #[test]
    fn the_seed_s_cylinder() {
        let mapping = Mapping::Cylindrical { half_height: 8.0 };
        let image = image([256, 256], mapping, Wrap::Repeat, Filter::Nearest);
        for (point, texel) in [
            (DVec3::new(2.5, -8.0, 0.0), [128.0, 0.0]),
            (DVec3::new(0.0, 0.0, 2.5), [192.0, 128.0]),
            (DVec3::new(0.0, 7.99, -2.5), [64.0, 255.0]),
            (DVec3::new(-2.5, 4.0, 1e-13), [0.0, 192.0]),
            (DVec3::new(-2.5, 4.0, 0.01), [255.0, 192.0]),
            // atan2(1.5, 2) = 0.643501: s = 0.602416, 256 s = 154.2; t = 0.578125, 256 t = 148.
            (DVec3::new(2.0, 1.25, 1.5), [154.0, 148.0]),
        ] {
            let color = image.color(point);
            assert_eq!([color.r, color.g], texel, "{point}");
        }
    }

    #[test]
    fn the_sphere_has_its_poles_at_the_edges() {
        let place = |x, y, z| place_on_image(Mapping::Spherical, DVec3::new(x, y, z));
        assert_eq!(place(0.0, 3.0, 0.0).y, 1.0);
        assert_eq!(place(0.0, -3.0, 0.0).y, 0.0);
        assert_eq!(place(5.0, 0.0, 0.0), DVec2::new(0.5, 0.5));
        let place = place(0.0, 2.0, 2.0);
        assert!((place - DVec2::splat(0.75)).length() < 1e-15, "{place}");
    }

    #[test]
    fn no_number_leaves_the_image() {
        let mappings = [Mapping::Uv, Mapping::Planar, Mapping::Spherical, Mapping::Cylindrical { half_height: 1.0 }];
        for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 0.0, 1e300, -1e300, 1e19, -1e-300] {
            for (mapping, wrap) in mappings.iter().flat_map(|m| WRAPS.map(|w| (*m, w))) {
                for filter in [Filter::Nearest, Filter::Bilinear] {
                    let image = image([3, 2], mapping, wrap, filter);
                    for point in [DVec3::splat(x), DVec3::new(0.3, x, 0.3), DVec3::new(x, 0.3, 0.3)] {
                        assert!(image.color(point).is_finite(), "{mapping:?} {wrap:?} {filter:?} {point}");
                    }
                }
            }
        }
    }
}

//! A linear colour: three numbers, red, green, blue.

use std::ops::{Add, AddAssign, Mul, MulAssign, Sub};

/// A linear-light RGB triple with the primaries of sRGB / ITU-R BT.709. Values above 1 are allowed: it also carries
/// radiance, weights and transmittances.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rgb {
    /// Red.
    pub r: f32,
    /// Green.
    pub g: f32,
    /// Blue.
    pub b: f32,
}

impl Rgb {
    /// (0, 0, 0).
    pub const BLACK: Rgb = Rgb::gray(0.0);
    /// (1, 1, 1).
    pub const WHITE: Rgb = Rgb::gray(1.0);

    /// The colour with these components.
    pub const fn new(r: f32, g: f32, b: f32) -> Rgb {
        Rgb { r, g, b }
    }

    /// The colour with three equal components.
    pub const fn gray(value: f32) -> Rgb {
        Rgb { r: value, g: value, b: value }
    }

    /// The components, in the order red, green, blue.
    pub const fn to_array(self) -> [f32; 3] {
        [self.r, self.g, self.b]
    }

    /// Applies `f` to each component.
    pub fn map(self, f: impl Fn(f32) -> f32) -> Rgb {
        Rgb::new(f(self.r), f(self.g), f(self.b))
    }

    /// The linear blend `(1 - t) * self + t * other`.
    pub fn lerp(self, other: Rgb, t: f32) -> Rgb {
        self * (1.0 - t) + other * t
    }

    /// The largest component.
    pub fn max_component(self) -> f32 {
        self.r.max(self.g).max(self.b)
    }

    /// The smallest component.
    pub fn min_component(self) -> f32 {
        self.r.min(self.g).min(self.b)
    }

    /// Relative luminance Y by the weights of ITU-R BT.709.
    pub fn luminance(self) -> f32 {
        0.2126 * self.r + 0.7152 * self.g + 0.0722 * self.b
    }

    /// True if no component is NaN or infinite.
    pub fn is_finite(self) -> bool {
        self.r.is_finite() && self.g.is_finite() && self.b.is_finite()
    }

    /// True if every component is exactly zero.
    #[inline]
    pub fn is_black(self) -> bool {
        // One question instead of three, each of which would ask for NaN, too: only zeros have no bit but the sign's.
        (self.r.to_bits() | self.g.to_bits() | self.b.to_bits()) << 1 == 0
    }
}

impl From<[f32; 3]> for Rgb {
    fn from([r, g, b]: [f32; 3]) -> Rgb {
        Rgb { r, g, b }
    }
}

impl Add for Rgb {
    type Output = Rgb;
    fn add(self, o: Rgb) -> Rgb {
        Rgb::new(self.r + o.r, self.g + o.g, self.b + o.b)
    }
}

impl Sub for Rgb {
    type Output = Rgb;
    fn sub(self, o: Rgb) -> Rgb {
        Rgb::new(self.r - o.r, self.g - o.g, self.b - o.b)
    }
}

/// Component by component.
impl Mul for Rgb {
    type Output = Rgb;
    fn mul(self, o: Rgb) -> Rgb {
        Rgb::new(self.r * o.r, self.g * o.g, self.b * o.b)
    }
}

impl Mul<f32> for Rgb {
    type Output = Rgb;
    fn mul(self, k: f32) -> Rgb {
        Rgb::new(self.r * k, self.g * k, self.b * k)
    }
}

impl AddAssign for Rgb {
    fn add_assign(&mut self, o: Rgb) {
        *self = *self + o;
    }
}

impl MulAssign for Rgb {
    fn mul_assign(&mut self, o: Rgb) {
        *self = *self * o;
    }
}

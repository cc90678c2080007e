//! Settings of the whole picture.

use durer_imaging::Transfer;
use durer_math::Rgb;

/// Size and encoding of the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Picture {
    /// Width in pixels, at least 1.
    pub width: u32,
    /// Height in pixels, at least 1.
    pub height: u32,
    /// How linear light becomes the numbers of an 8- or 16-bit file.
    pub transfer: Transfer,
}

impl Picture {
    /// Width times height.
    pub fn pixels(&self) -> u64 {
        u64::from(self.width) * u64::from(self.height)
    }
}

impl Default for Picture {
    fn default() -> Picture {
        Picture { width: 640, height: 480, transfer: Transfer::Srgb }
    }
}

/// How the picture is computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RenderSettings {
    /// Longest chain of rays: the eye's ray has depth 1, and rays deeper than this are black.
    pub max_depth: u32,
    /// Rays whose weight in the pixel is below this (largest component) are not traced; 0 traces all.
    pub min_weight: f32,
    /// Where in a pixel rays are sent, and how many.
    pub antialias: Antialias,
    /// What the search trees are built for. The picture is the same.
    pub trees: Trees,
}

impl Default for RenderSettings {
    fn default() -> RenderSettings {
        RenderSettings { max_depth: 5, min_weight: 0.001, antialias: Antialias::default(), trees: Trees::default() }
    }
}

/// What the trees in which rays search are built for: more time for building makes each ray faster.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Trees {
    /// A first look: built in the least time.
    Preview,
    /// A picture with some rays a pixel.
    #[default]
    Picture,
    /// Very many rays: built for the fastest search.
    ManyRays,
}

/// Where in a pixel rays are sent, and how many.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Antialias {
    /// One ray through the middle of each pixel.
    None,
    /// n × n rays through the middles of a grid of cells.
    Grid {
        /// Cells along each side.
        n: u32,
    },
    /// The seed's: 2 × 2 rays through the middles of the quarters; where the first differs from another by more than
    /// `threshold` (sum over the three components, linear), every quarter is treated in the same way again.
    Recursive {
        /// Largest difference that is let pass.
        threshold: f32,
        /// How often a pixel may be divided again; 0 gives four rays everywhere.
        max_depth: u32,
    },
}

impl Default for Antialias {
    /// A 3 × 3 grid.
    fn default() -> Antialias {
        Antialias::Grid { n: 3 }
    }
}

/// What rays that leave the scene see.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Background {
    /// One colour.
    Color(Rgb),
    /// From `bottom` (straight down) to `top` (straight up), linear in the y component of the direction.
    Gradient {
        /// Seen straight down.
        bottom: Rgb,
        /// Seen straight up.
        top: Rgb,
    },
}

impl Default for Background {
    /// A quiet sky: pale at the bottom, blue at the top.
    fn default() -> Background {
        Background::Gradient { bottom: Rgb::new(0.95, 0.95, 0.95), top: Rgb::new(0.25, 0.45, 0.8) }
    }
}

/// Fog that takes light away along every ray and puts its own colour there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fog {
    /// After a length d of fog, `exp(-d / distance)` of the light is left.
    Exponential {
        /// Its colour.
        color: Rgb,
        /// The length at which 1/e is left.
        distance: f64,
    },
    /// All light is left up to length `start`, none from `end` on, linear between.
    Linear {
        /// Its colour.
        color: Rgb,
        /// Up to here the view is clear.
        start: f64,
        /// From here on there is only fog; greater than `start`.
        end: f64,
    },
}

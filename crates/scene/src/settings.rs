//! Settings of the whole picture.

use crate::ImageId;
use durer_imaging::{ToneMapping, Transfer};
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
    /// Multiplies the light by 2 to the power of this, in 8- and 16-bit files; stops, as photographers count.
    pub exposure: f32,
    /// How light above 1 is brought into what 8- and 16-bit files can hold.
    pub tone_mapping: ToneMapping,
}

impl Picture {
    /// Width times height.
    pub fn pixels(&self) -> u64 {
        u64::from(self.width) * u64::from(self.height)
    }
}

impl Default for Picture {
    fn default() -> Picture {
        Picture { width: 640, height: 480, transfer: Transfer::Srgb, exposure: 0.0, tone_mapping: ToneMapping::None }
    }
}

impl Picture {
    /// The same picture with a longer side of so many pixels, at least 1; the other is rounded.
    #[must_use]
    pub fn with_longer_side(self, pixels: u32) -> Picture {
        let longer = u64::from(self.width.max(self.height).max(1));
        let scaled = |side: u32| ((u64::from(side) * u64::from(pixels) + longer / 2) / longer).max(1) as u32;
        Picture { width: scaled(self.width), height: scaled(self.height), ..self }
    }
}

/// How the picture is computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RenderSettings {
    /// What is computed.
    pub integrator: Integrator,
    /// Samples a pixel, for integrators that sample at random: exactly so many, or with a `noise` or `time` at most. `None`
    /// is [`RenderSettings::SAMPLES`] of them, or [`RenderSettings::MOST_SAMPLES`] with a `noise` or `time`.
    pub samples: Option<u32>,
    /// Samples are taken until the noise is estimated to be below this everywhere: the standard error of a pixel's luminance
    /// over the root of its luminance, both with the picture's exposure; in the white of a screen, 0.02 is one in fifty. `None`
    /// takes `samples` everywhere.
    pub noise: Option<f32>,
    /// No samples are begun after this many seconds; `None` sets no limit. The picture then depends on the machine.
    pub time: Option<f64>,
    /// Chooses among equally good sequences of random numbers: other seeds, other noise.
    pub seed: u32,
    /// Shadow rays to each light that has an area, for each point that `whitted` shades. With 0, what glows lights nothing,
    /// and lamps with a radius are points.
    pub light_samples: u32,
    /// `whitted`: longest chain of rays: the eye's ray has depth 1, and rays deeper than this are black.
    pub max_depth: u32,
    /// `whitted`: rays whose weight in the pixel is below this (largest component) are not traced; 0 traces all.
    pub min_weight: f32,
    /// Where in a pixel rays are sent, and how many.
    pub antialias: Antialias,
    /// How the samples around a pixel's middle are weighed.
    pub filter: PixelFilter,
    /// What the search trees are built for. The picture is the same.
    pub trees: Trees,
}

impl Default for RenderSettings {
    fn default() -> RenderSettings {
        RenderSettings {
            integrator: Integrator::Whitted,
            samples: None,
            noise: None,
            time: None,
            seed: 0,
            light_samples: 16,
            max_depth: 5,
            min_weight: 0.001,
            antialias: Antialias::default(),
            filter: PixelFilter::default(),
            trees: Trees::default(),
        }
    }
}

impl RenderSettings {
    /// Samples a pixel, unless something else is said.
    pub const SAMPLES: u32 = 64;
    /// The most samples of a pixel where something else ends them, unless it is said.
    pub const MOST_SAMPLES: u32 = 4096;

    /// No pixel has more samples than this.
    pub const SAMPLES_LIMIT: u32 = 1_000_000;

    /// The most samples of a pixel, for integrators that sample at random.
    pub fn samples_a_pixel(&self) -> u32 {
        let is_open = self.noise.is_some() || self.time.is_some();
        self.samples.unwrap_or(if is_open { RenderSettings::MOST_SAMPLES } else { RenderSettings::SAMPLES })
    }
}

/// What is computed of a scene.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Integrator {
    /// Classic ray tracing after Whitted 1980: mirrors, glass and sharp shadows, without noise.
    #[default]
    Whitted,
    /// All the light that there is, by path tracing (Kajiya 1986).
    Path(PathSettings),
    /// How much of the sky each point sees.
    AmbientOcclusion {
        /// What is further away hides nothing; `None` for any distance.
        distance: Option<f64>,
    },
    /// The normal of what is seen, as a color.
    Normals,
    /// How far away it is.
    Depth,
    /// Its texture coordinates in the middle of each pixel, as red and green; `antialias` and `filter` do not matter.
    Uv,
}

impl Integrator {
    /// The path tracer, as it is unless something else is said.
    pub const PATH: Integrator = Integrator::Path(PathSettings::DEFAULT);

    /// True if it takes samples at random; the others look where anti-aliasing says.
    pub fn takes_samples(&self) -> bool {
        match self {
            Integrator::Path { .. } | Integrator::AmbientOcclusion { .. } => true,
            Integrator::Whitted | Integrator::Normals | Integrator::Depth | Integrator::Uv => false,
        }
    }

    /// The word for it in scene files and messages.
    pub fn word(&self) -> &'static str {
        match self {
            Integrator::Whitted => "whitted",
            Integrator::Path { .. } => "path",
            Integrator::AmbientOcclusion { .. } => "ambient_occlusion",
            Integrator::Normals => "normals",
            Integrator::Depth => "depth",
            Integrator::Uv => "uv",
        }
    }
}

/// How paths are traced.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathSettings {
    /// Longest path, counted in surfaces that light meets on its way from a light to the eye; at least 1.
    pub max_depth: u32,
    /// Samples brighter than this (largest component) are lowered to it, which takes fireflies away and some light with
    /// them; `None` leaves all as it is.
    pub clamp: Option<f32>,
    /// How many paths go on from the first surface that spreads light; from 1. Where paths are reused, all but the first of them
    /// only look for what cannot be.
    pub split: u32,
    /// By how many neighboring pixels a path is used: by its own alone, or by those of a block of 2 × 2, 4 × 4 or 8 × 8; one of
    /// [`PathSettings::REUSES`].
    pub reuse: u32,
}

impl PathSettings {
    /// As paths are traced unless something else is said.
    pub const DEFAULT: PathSettings = PathSettings { max_depth: 16, clamp: None, split: 1, reuse: 1 };
    /// What `reuse` may be.
    pub const REUSES: [u32; 4] = [1, 4, 16, 64];
}

impl Default for PathSettings {
    /// [`PathSettings::DEFAULT`].
    fn default() -> PathSettings {
        PathSettings::DEFAULT
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
    /// Samples at the corners and in the middle of each pixel, which neighbors share; where they differ, the edge between
    /// is searched for, or the pixel is divided. Small things are looked for where they are.
    Adaptive {
        /// Largest difference that is let pass: of a component, from 0 to 1 as on a screen.
        threshold: f32,
        /// How often a pixel may be divided.
        max_depth: u32,
    },
    /// POV-Ray's method 1: one ray through the middle of each pixel; where it differs from a neighbor's, a grid of more.
    Pov1 {
        /// Smallest difference that counts (sum over the three components, encoded with a gamma of 2.5).
        threshold: f32,
        /// Cells along each side of the grid.
        depth: u32,
    },
    /// POV-Ray's method 2: rays through the corners of each pixel; where they differ, each quarter in the same way.
    Pov2 {
        /// As for method 1.
        threshold: f32,
        /// A pixel has at most (2^(`depth` - 1) + 1)² rays.
        depth: u32,
    },
}

impl Antialias {
    /// The adaptive one, as it is unless something else is said.
    pub const ADAPTIVE: Antialias = Antialias::Adaptive { threshold: 0.03, max_depth: 4 };
}

impl Default for Antialias {
    /// [`Antialias::ADAPTIVE`].
    fn default() -> Antialias {
        Antialias::ADAPTIVE
    }
}

/// How samples are weighed by their distance from a pixel's middle; lengths in pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum PixelFilter {
    /// The same everywhere in the pixel, and nothing beyond: a pixel is the mean of its area.
    #[default]
    Box,
    /// Falls evenly to 0.
    Tent {
        /// Where it is 0.
        radius: f64,
    },
    /// A bell, lowered so that it ends at 0.
    Gaussian {
        /// Where it is 0.
        radius: f64,
        /// Its standard deviation.
        sigma: f64,
    },
    /// That of Mitchell and Netravali with B = C = 1/3: sharpens a little, since it is below 0 on its outer half.
    Mitchell {
        /// Where it is 0.
        radius: f64,
    },
    /// The four-term window of Blackman and Harris: close to a bell, and smooth where it ends.
    BlackmanHarris {
        /// Where it is 0.
        radius: f64,
    },
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
    /// A picture of all that is around.
    Image(Environment),
}

/// An environment map: a picture of all directions, in latitude and longitude, its top straight up.
///
/// In a direction d of unit length, turned back by the rotation about +y, stands what the picture shows at
/// s = (atan2(d.z, d.x) + π) / 2π from its left and t = asin(d.y) / π + 1/2 from below: as
/// [`Mapping::Spherical`](crate::Mapping::Spherical) has it. Seen from within, it is not mirrored.
/// Without rotation the middle of the picture is seen toward +x, and what is a quarter of its width left of that toward -z.
/// Light is linear and may be above 1; 8- and 16-bit files are sRGB.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Environment {
    /// The picture.
    pub image: ImageId,
    /// Turns it about the y axis, counterclockwise as seen from above; 90 brings its middle from +x to -z.
    pub rotation_degrees: f64,
    /// Multiplies its light.
    pub strength: f32,
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_longer_side_is_as_asked() {
        let sized = |width, height, pixels| {
            let picture = Picture { width, height, ..Picture::default() }.with_longer_side(pixels);
            (picture.width, picture.height)
        };
        assert_eq!(sized(640, 480, 96), (96, 72));
        assert_eq!(sized(480, 640, 96), (72, 96));
        assert_eq!(sized(3, 2, 96), (96, 64));
        assert_eq!(sized(65_535, 1, 96), (96, 1));
        assert_eq!(sized(65_535, 65_535, u32::MAX), (u32::MAX, u32::MAX));
    }
}

//! Textures: their numbers, and that none is made of itself.

use super::Step;
use super::bounds::BRIGHTEST;
use super::values::{Around, Checker};
use crate::{ImageId, Mapping, Paint, Pattern, Scene, Texture, TextureId};
use durer_imaging::{Alpha, Bitmap, Texels};

/// How deep textures may be made of textures.
const DEEPEST: usize = 32;
/// How many patterns a point of a texture may ask: blends of blends double with each level.
const MOST_PATTERNS: u64 = 1000;
/// The most colours of a pattern.
const MOST_COLORS: usize = 1000;

pub(super) fn check(c: &mut Checker<'_>) {
    images(c);
    let glowing = glowing(c.scene);
    for ((id, one), glows) in (0..).zip(&c.scene.textures).zip(glowing) {
        c.at(Step::Texture(TextureId(id)), |c| texture(c, one, glows));
    }
    nesting(c);
}

/// Which textures give a material its emission, themselves or as parts of others.
fn glowing(scene: &Scene) -> Vec<bool> {
    let mut glowing = vec![false; scene.textures.len()];
    let id_of = |paint: Paint| match paint {
        Paint::Color(_) => None,
        Paint::Texture(TextureId(id)) => Some(id as usize),
    };
    let mut open: Vec<usize> = scene.materials.iter().filter_map(|material| id_of(material.emission.color)).collect();
    while let Some(id) = open.pop() {
        if glowing.get(id) == Some(&false) {
            glowing[id] = true;
            open.extend(parts(&scene.textures[id]));
        }
    }
    glowing
}

fn images(c: &mut Checker<'_>) {
    for (id, image) in (0..).zip(&c.scene.images) {
        let bitmap = &image.bitmap;
        let texels = match &bitmap.texels {
            Texels::U8(texels) => texels.len(),
            Texels::U16(texels) => texels.len(),
            Texels::F32(texels) => texels.len(),
        };
        let alphas = bitmap.alpha.as_ref().map_or(texels, Alpha::len);
        let fine = texels > 0 && texels as u64 == u64::from(bitmap.width) * u64::from(bitmap.height);
        if !fine || alphas != texels {
            c.at(Step::Image(ImageId(id)), |c| c.problem("the image's pixels do not fill its width and height"));
        }
        if let Some(at) = first_not_finite(bitmap) {
            let (x, y) = (at as u64 % u64::from(bitmap.width.max(1)), at as u64 / u64::from(bitmap.width.max(1)));
            c.at(Step::Image(ImageId(id)), |c| {
                let help = "put numbers there in an image editor; renderers leave such pixels where they divided by 0";
                c.problem_with_help(format!("the image's pixel {x},{y} is infinite or not a number"), help)
            });
        }
    }
}

fn first_not_finite(bitmap: &Bitmap) -> Option<usize> {
    let color = match &bitmap.texels {
        Texels::F32(texels) => texels.iter().position(|texel| texel.iter().any(|value| !value.is_finite())),
        Texels::U8(_) | Texels::U16(_) => None,
    };
    let alpha = || match &bitmap.alpha {
        Some(Alpha::F32(alphas)) => alphas.iter().position(|alpha| !alpha.is_finite()),
        Some(Alpha::U8(_) | Alpha::U16(_)) | None => None,
    };
    color.or_else(alpha)
}

impl Pattern {
    /// The word for this kind of pattern in scene files and messages.
    pub fn word(&self) -> &'static str {
        match self {
            Pattern::Checker { .. } => "checker",
            Pattern::Stripes { .. } => "stripes",
            Pattern::Rings { .. } => "rings",
            Pattern::Gradient { .. } => "gradient",
            Pattern::Image(_) => "image",
            Pattern::Noise { .. } => "noise",
            Pattern::Marble { .. } => "marble",
            Pattern::Wood { .. } => "wood",
        }
    }

    /// The colours and textures that it is made of.
    pub fn colors(&self) -> &[Paint] {
        match self {
            Pattern::Checker { colors, .. }
            | Pattern::Noise { colors, .. }
            | Pattern::Marble { colors, .. }
            | Pattern::Wood { colors, .. } => colors,
            Pattern::Stripes { colors, .. } | Pattern::Rings { colors, .. } | Pattern::Gradient { colors, .. } => {
                colors
            }
            Pattern::Image(_) => &[],
        }
    }
}

fn texture(c: &mut Checker<'_>, texture: &Texture, glows: bool) {
    let Texture { name: _, transform, pattern } = texture;
    c.field(pattern.word(), |c| {
        c.transform(transform, Around::WORLD);
        c.field("colors", |c| colors(c, pattern, glows));
        match *pattern {
            Pattern::Checker { size, .. } => _ = c.size("size", size),
            Pattern::Stripes { axis, width, .. } => _ = c.direction("axis", axis) & c.size("width", width),
            Pattern::Rings { width, .. } => _ = c.size("width", width),
            Pattern::Gradient { axis, length, .. } => _ = c.direction("axis", axis) & c.size("length", length),
            Pattern::Image(ref image) => {
                let ImageId(id) = image.image;
                c.require((id as usize) < c.scene.images.len(), "file", format!("there is no image {id}"));
                c.light("tint", image.tint);
                if let Mapping::Cylindrical { half_height } = image.mapping {
                    c.field("mapping", |c| c.field("cylindrical", |c| c.size("half_height", half_height)));
                }
            }
            Pattern::Noise { size, octaves, .. } => _ = c.size("size", size) & self::octaves(c, octaves),
            Pattern::Marble { size, turbulence, octaves, .. } | Pattern::Wood { size, turbulence, octaves, .. } => {
                c.size("size", size);
                c.within("turbulence", turbulence, 0.0, 1e6);
                self::octaves(c, octaves);
            }
        }
    });
}

fn octaves(c: &mut Checker<'_>, octaves: u32) -> bool {
    c.within("octaves", octaves.into(), 1.0, 16.0)
}

fn colors(c: &mut Checker<'_>, pattern: &Pattern, glows: bool) {
    let colors = pattern.colors();
    let counts = !matches!(pattern, Pattern::Image(_));
    if counts && !(2..=MOST_COLORS).contains(&colors.len()) {
        c.problem(format!("there must be from 2 to {MOST_COLORS} colors, not {}", colors.len()));
    }
    let brightest = colors.iter().filter_map(|paint| match paint {
        Paint::Color(color) if color.is_finite() => Some(color.max_component()),
        Paint::Color(_) | Paint::Texture(_) => None,
    });
    let brightest = brightest.fold(0.0, f32::max);
    for (at, color) in colors.iter().enumerate() {
        c.at(Step::Index(at), |c| match color {
            Paint::Color(color) if glows && color.min_component() >= 0.0 && is_light(color.max_component()) => {
                let help = format!(
                    "divide all of them by {brightest}, and say so beside the texture: `emission: {{color: …, strength: {brightest}}}`"
                );
                c.problem_with_help("a color of a texture must not be above 1, though it gives light", help);
            }
            Paint::Color(_) | Paint::Texture(_) => super::materials::paint(c, "a color", *color),
        });
    }
}

/// True for what light may be, but a color may not.
fn is_light(component: f32) -> bool {
    component > 1.0 && component <= BRIGHTEST
}

/// The textures that a texture is made of.
fn parts(texture: &Texture) -> impl Iterator<Item = usize> {
    texture.pattern.colors().iter().filter_map(|paint| match paint {
        Paint::Color(_) => None,
        Paint::Texture(TextureId(id)) => Some(*id as usize),
    })
}

/// Refuses textures that are made of themselves, or of textures of textures too deep. Without recursion: at first
/// nothing is known of this depth.
fn nesting(c: &mut Checker<'_>) {
    let textures = &c.scene.textures;
    // 0: not seen, 1: on the way down, 2: done.
    let mut state = vec![0u8; textures.len()];
    let mut height = vec![0usize; textures.len()];
    let mut asked = vec![1u64; textures.len()];
    for start in 0..textures.len() {
        if state[start] != 0 {
            continue;
        }
        let mut way: Vec<(usize, Vec<usize>)> = Vec::new();
        let enter = |id: usize, state: &mut Vec<u8>| {
            state[id] = 1;
            (id, parts(&textures[id]).filter(|part| *part < textures.len()).collect::<Vec<_>>())
        };
        way.push(enter(start, &mut state));
        while let Some((id, open)) = way.last_mut() {
            let id = *id;
            match open.pop() {
                Some(part) if state[part] == 0 => way.push(enter(part, &mut state)),
                Some(part) if state[part] == 1 => made_of_itself(c, id, part),
                Some(_) => {}
                None => {
                    state[id] = 2;
                    let below = parts(&textures[id]).filter_map(|part| height.get(part)).max();
                    height[id] = below.map_or(1, |below| below + 1);
                    if height[id] == DEEPEST + 1 {
                        c.at(Step::Texture(TextureId(id as u32)), |c| {
                            c.problem(format!("textures of textures may be at most {DEEPEST} deep"))
                        });
                    }
                    asked[id] = patterns_asked(&textures[id], &asked);
                    let first = height[id] <= DEEPEST
                        && parts(&textures[id]).all(|part| asked.get(part).is_none_or(|n| *n <= MOST_PATTERNS));
                    if first && asked[id] > MOST_PATTERNS {
                        c.at(Step::Texture(TextureId(id as u32)), |c| {
                            c.problem(format!("a point of this texture asks more than {MOST_PATTERNS} patterns"))
                        });
                    }
                    way.pop();
                }
            }
        }
    }
}

/// How many patterns a point of a texture asks at most, itself counted, if its parts ask so many.
fn patterns_asked(texture: &Texture, asked: &[u64]) -> u64 {
    let mut below: Vec<u64> = parts(texture).filter_map(|part| asked.get(part)).copied().collect();
    below.sort_unstable_by(|a, b| b.cmp(a));
    let at_once = match texture.pattern {
        Pattern::Checker { .. } | Pattern::Stripes { .. } | Pattern::Rings { .. } | Pattern::Image(_) => 1,
        // Blends of two.
        Pattern::Gradient { .. } | Pattern::Noise { .. } | Pattern::Marble { .. } | Pattern::Wood { .. } => 2,
    };
    below.iter().take(at_once).fold(1, |sum, part| sum.saturating_add(*part))
}

/// The problem that the texture `id` refers back to `part`.
fn made_of_itself(c: &mut Checker<'_>, id: usize, part: usize) {
    let texture = &c.scene.textures[id];
    let at = texture.pattern.colors().iter().position(|paint| *paint == Paint::Texture(TextureId(part as u32)));
    let name = c.scene.textures[part].name.as_ref().map_or("a texture".to_owned(), |name| format!("`{name}`"));
    c.at(Step::Texture(TextureId(id as u32)), |c| {
        c.field(texture.pattern.word(), |c| {
            c.field("colors", |c| {
                let help = "a texture's colors may not lead back to it";
                let message = format!("{name} is made of itself");
                c.at(Step::Index(at.unwrap_or(0)), |c| c.problem_with_help(message, help));
            });
        });
    });
}

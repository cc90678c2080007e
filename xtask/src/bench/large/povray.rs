//! The scene in POV-Ray's language. Its axes are left-handed, so the camera names all of them.

use super::things::{AMBIENT, BACKGROUND, DIFFUSE, EYE, FLOOR, HALF_HEIGHT, LAMP, PALETTE, Thing, things};
use durer::math::DVec3;
use std::io::{self, Write};

pub(super) fn write(count: usize, out: &mut impl Write) -> io::Result<()> {
    head(out)?;
    for thing in things(count) {
        match thing {
            Thing::Ball { center, radius, color } => {
                writeln!(out, "sphere{{{},{radius} texture{{T{color}}}}}", Vector(center))?;
            }
            Thing::Rod { base, top, radius, color } => {
                writeln!(out, "cylinder{{{},{},{radius} open texture{{T{color}}}}}", Vector(base), Vector(top))?;
            }
        }
    }
    out.flush()
}

fn head(out: &mut impl Write) -> io::Result<()> {
    let forward = -EYE.normalize();
    let right = forward.cross(DVec3::Y).normalize();
    let up = right.cross(forward);
    let [location, direction, right, up] =
        [EYE, forward, right * (2.0 * HALF_HEIGHT), up * (2.0 * HALF_HEIGHT)].map(|v| Vector(v.to_array()));
    writeln!(out, "#version 3.7;\nglobal_settings {{ assumed_gamma 1.0 max_trace_level 5 }}")?;
    writeln!(out, "background {{ rgb {} }}", Vector(BACKGROUND))?;
    writeln!(out, "camera {{ perspective location {location} direction {direction} right {right} up {up} }}")?;
    writeln!(out, "light_source {{ {}, rgb 1 }}", Vector(LAMP.to_array()))?;
    let finish = format!("finish {{ ambient {AMBIENT} diffuse {DIFFUSE} }}");
    for (number, color) in PALETTE.into_iter().enumerate() {
        writeln!(out, "#declare T{number} = texture {{ pigment {{ rgb {} }} {finish} }}", Vector(color))?;
    }
    writeln!(out, "plane {{ y, {FLOOR} pigment {{ rgb 1 }} {finish} }}")
}

/// Three numbers as POV-Ray writes them.
struct Vector<T>([T; 3]);

impl<T: std::fmt::Display> std::fmt::Display for Vector<T> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let [x, y, z] = &self.0;
        write!(f, "<{x},{y},{z}>")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scene_has_all_its_parts() {
        let mut out = Vec::new();
        write(100, &mut out).unwrap();
        let text = String::from_utf8(out).unwrap();
        let count = |word: &str| text.lines().filter(|line| line.starts_with(word)).count();
        assert_eq!((count("sphere{"), count("cylinder{"), count("#declare T"), count("plane ")), (50, 50, 8, 1));
        assert!(text.contains("location <16,10,-32>"), "{text}");
    }
}

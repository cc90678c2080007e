//! The scene as a model for Tachyon.

use super::things::{AMBIENT, BACKGROUND, DIFFUSE, EYE, FLOOR, HALF_HEIGHT, LAMP, PALETTE, Thing, things};
use std::io::{self, Write};

pub(super) fn write(count: usize, size: u32, out: &mut impl Write) -> io::Result<()> {
    head(size, out)?;
    for thing in things(count) {
        match thing {
            Thing::Ball { center, radius, color } => {
                writeln!(out, "SPHERE CENTER {} RAD {radius} T{color}", Numbers(center))?;
            }
            Thing::Rod { base, top, radius, color } => {
                writeln!(out, "FCYLINDER BASE {} APEX {} RAD {radius} T{color}", Numbers(base), Numbers(top))?;
            }
        }
    }
    writeln!(out, "END_SCENE")?;
    out.flush()
}

fn head(size: u32, out: &mut impl Write) -> io::Result<()> {
    // Tachyon's rays go through corners of pixels. So the picture is moved by half a pixel, for those through the middles.
    let half_pixel = HALF_HEIGHT / f64::from(size);
    let [left, right] = [HALF_HEIGHT, -HALF_HEIGHT].map(|side| side + half_pixel);
    let [bottom, top] = [-HALF_HEIGHT, HALF_HEIGHT].map(|side| side - half_pixel);
    let (eye, forward) = (Numbers(EYE.to_array()), Numbers((-EYE.normalize()).to_array()));
    writeln!(
        out,
        "BEGIN_SCENE\nRESOLUTION {size} {size}\nCAMERA\n PROJECTION PERSPECTIVE\n ZOOM 1.0\n ASPECTRATIO 1.0"
    )?;
    writeln!(out, " ANTIALIASING 0\n RAYDEPTH 5\n CENTER {eye}\n VIEWDIR {forward}\n UPDIR 0 1 0")?;
    writeln!(out, " FRUSTUM {left} {right} {bottom} {top}\nEND_CAMERA\nBACKGROUND {}", Numbers(BACKGROUND))?;
    writeln!(out, "LIGHT CENTER {} RAD 0.0 COLOR 1 1 1", Numbers(LAMP.to_array()))?;
    let texture = |color: [f64; 3]| {
        let color = Numbers(color);
        format!("AMBIENT {AMBIENT} DIFFUSE {DIFFUSE} SPECULAR 0.0 OPACITY 1.0 COLOR {color} TEXFUNC 0")
    };
    for (number, color) in PALETTE.into_iter().enumerate() {
        writeln!(out, "TEXDEF T{number} {}", texture(color))?;
    }
    writeln!(out, "PLANE CENTER 0 {FLOOR} 0 NORMAL 0 1 0 TEXTURE {}", texture([1.0; 3]))
}

/// Three numbers with blanks between them.
struct Numbers<T>([T; 3]);

impl<T: std::fmt::Display> std::fmt::Display for Numbers<T> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let [x, y, z] = &self.0;
        write!(f, "{x} {y} {z}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_model_has_all_its_parts() {
        let mut out = Vec::new();
        write(100, 9, &mut out).unwrap();
        let text = String::from_utf8(out).unwrap();
        let count = |word: &str| text.lines().filter(|line| line.starts_with(word)).count();
        assert_eq!((count("SPHERE "), count("FCYLINDER "), count("TEXDEF "), count("PLANE ")), (50, 50, 8, 1));
        assert!(text.contains("FRUSTUM 0.5 -0.4 -0.5 0.4") && text.ends_with("END_SCENE\n"), "{text}");
    }
}

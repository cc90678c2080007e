//! The seed's room as a model for Tachyon 0.99, which lacks some of what is in it: refraction becomes plain
//! transparency, cones and the ellipsoid become smooth triangles, the checker one quad for each square, caps rings.

use durer::math::functions::{cos, sin};
use durer::math::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};
use std::fmt::Write;

/// The model for a picture of this size; `texture` is the path of a PPM, without blanks.
pub(crate) fn model(size: (u32, u32), texture: &str) -> String {
    let mut model = Model::default();
    model.camera(size);
    model.text += LIGHTS;
    model.textures();
    model.walls();
    model.table();
    let corners = [(-14.0, -6.0, -69.0), (14.0, -6.0, -69.0), (14.0, 14.0, -66.0), (-14.0, 14.0, -66.0)];
    model.quad(corners.map(|(x, y, z)| DVec3::new(x, y, z)), "mirror");
    model.text += "SPHERE CENTER -9 -10 -38 RAD 5 sph1\nSPHERE CENTER 0 -10 -42 RAD 5 sph2\n";
    model.ellipsoid();
    model.cylinders(texture);
    model.cone(DVec3::new(3.0, -15.0, -32.0), 2.0, 5.0, "con1");
    model.cone(DVec3::new(-12.0, -15.0, -50.0), 4.0, 13.0, "con2");
    model.text += "END_SCENE\n";
    model.text
}

const LIGHTS: &str = "\
FOG EXP START 0.0 END 400.0 DENSITY 0.0025 COLOR 0.75 0.75 0.8
LIGHT CENTER 20 23 15 RAD 0.0 COLOR 0.5 0.5 0.5
LIGHT CENTER -20 23 15 RAD 0.0 COLOR 0.5 0.5 0.5
SPOTLIGHT CENTER 0 5 -5 RAD 0.0 DIRECTION 0 -20 -35 FALLOFF_START 15.0 FALLOFF_END 15.01 COLOR 0.5 0.5 0.5
";

/// Names, colours and what else there is to say of textures.
const MATTE: [(&str, &str); 8] = [
    ("left", ".8 .2 .2"),
    ("right", ".2 .7 .2"),
    ("floor", ".5 .5 .5"),
    ("ceil", ".8 .8 .75"),
    ("back", ".2 .3 .8"),
    ("front", ".7 .3 .7"),
    ("white", ".95 .95 .95"),
    ("black", ".05 .05 .05"),
];

/// Names, colours and opacities.
const SHINY: [(&str, &str, &str); 7] = [
    ("sph1", ".9 .4 .4", "0.3"),
    ("sph2", ".6 .8 .9", "0.2"),
    ("ell", ".9 .8 .1", "1"),
    ("cap1", ".6 .6 .6", "1"),
    ("cyl2", ".1 .6 .2", "1"),
    ("con1", ".9 .5 .1", "1"),
    ("con2", ".1 .7 .1", "1"),
];

/// Names, points and normals.
const WALLS: [(&str, &str, &str); 6] = [
    ("left", "-30 0 0", "1 0 0"),
    ("right", "30 0 0", "-1 0 0"),
    ("floor", "0 -25 0", "0 1 0"),
    ("ceil", "0 25 0", "0 -1 0"),
    ("back", "0 0 -70", "0 0 1"),
    ("front", "0 0 20", "0 0 -1"),
];

/// Segments around cones and the ellipsoid.
const AROUND: u32 = 64;
/// Segments of the ellipsoid from pole to pole.
const UPWARD: u32 = 32;

/// A point and the normal there.
type Vertex = (DVec3, DVec3);

#[derive(Default)]
struct Model {
    text: String,
}

impl Model {
    /// A line. Writing to a `String` cannot fail.
    fn line(&mut self, line: std::fmt::Arguments<'_>) {
        let _ = writeln!(self.text, "{line}");
    }

    fn camera(&mut self, (width, height): (u32, u32)) {
        let right = 0.8 * f64::from(width) / f64::from(height);
        self.line(format_args!("BEGIN_SCENE\nRESOLUTION {width} {height}\nCAMERA\n PROJECTION PERSPECTIVE\n ZOOM 1.0"));
        self.line(format_args!(" ASPECTRATIO 1.0\n ANTIALIASING 0\n RAYDEPTH 5\n CENTER 0 0 0\n VIEWDIR 0 0 -1"));
        self.line(format_args!(" UPDIR 0 1 0\n FRUSTUM {right} {} -0.8 0.8\nEND_CAMERA", -right));
    }

    fn textures(&mut self) {
        let base = "AMBIENT 0.2 DIFFUSE 0.8";
        for (name, color) in MATTE {
            self.line(format_args!("TEXDEF {name} {base} SPECULAR 0.0 OPACITY 1.0 COLOR {color} TEXFUNC 0"));
        }
        self.line(format_args!("TEXDEF mirror {base} SPECULAR 0.8 OPACITY 1.0 COLOR .1 .1 .1 TEXFUNC 0"));
        for (name, color, opacity) in SHINY {
            let phong = "PHONG PLASTIC 0.6 PHONG_SIZE 40.0";
            self.line(format_args!(
                "TEXDEF {name} {base} SPECULAR 0.0 OPACITY {opacity} {phong} COLOR {color} TEXFUNC 0"
            ));
        }
    }

    fn walls(&mut self) {
        for (name, point, normal) in WALLS {
            self.line(format_args!("PLANE CENTER {point} NORMAL {normal} {name}"));
        }
    }

    fn table(&mut self) {
        for i in -5..5 {
            for j in -14..-7 {
                let texture = if (i + j) % 2 == 0 { "white" } else { "black" };
                let corner = DVec3::new(f64::from(4 * i), -15.0, f64::from(4 * j));
                let (right, back) = (DVec3::X * 4.0, DVec3::Z * 4.0);
                self.quad([corner, corner + right, corner + right + back, corner + back], texture);
            }
        }
    }

    fn quad(&mut self, [a, b, c, d]: [DVec3; 4], texture: &str) {
        for [a, b, c] in [[a, b, c], [a, c, d]] {
            self.line(format_args!("TRI V0 {} V1 {} V2 {} {texture}", Numbers(a), Numbers(b), Numbers(c)));
        }
    }

    fn smooth_triangle(&mut self, [a, b, c]: [Vertex; 3], texture: &str) {
        let points = [a, b, c].map(|vertex| Numbers(vertex.0));
        let normals = [a, b, c].map(|vertex| Numbers(vertex.1));
        let ([a, b, c], [n, o, p]) = (points, normals);
        self.line(format_args!("STRI V0 {a} V1 {b} V2 {c} N0 {n} N1 {o} N2 {p} {texture}"));
    }

    fn ellipsoid(&mut self) {
        for j in 0..UPWARD {
            let latitude = |j: u32| PI * (f64::from(j) / f64::from(UPWARD) - 0.5);
            for i in 0..AROUND {
                let longitude = |i: u32| TAU * f64::from(i) / f64::from(AROUND);
                let [u, v] = [[i, i + 1].map(longitude), [j, j + 1].map(latitude)];
                let [a, b, c, d] = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(i, j)| on_ellipsoid(u[i], v[j]));
                // At the poles one of the two triangles has no area.
                if j > 0 {
                    self.smooth_triangle([a, b, c], "ell");
                }
                if j + 1 < UPWARD {
                    self.smooth_triangle([a, c, d], "ell");
                }
            }
        }
    }

    fn cylinders(&mut self, texture: &str) {
        self.line(format_args!(
            "FCYLINDER BASE -12 -25 -23 APEX -12 -9 -23 RAD 2.5 TEXTURE AMBIENT 0.2 DIFFUSE 0.8 SPECULAR 0.0 OPACITY 1.0 \
             PHONG PLASTIC 0.6 PHONG_SIZE 40.0 COLOR 1 1 1 TEXFUNC 7 {texture} CENTER -12 -25 -23 ROTATE 0 0 0 SCALE 1 0.5 1"
        ));
        self.ring("-12 -9 -23", "0 1 0", 2.5, "cap1");
        self.ring("-12 -25 -23", "0 -1 0", 2.5, "cap1");
        self.line(format_args!("FCYLINDER BASE 8.5 -15 -47 APEX 8.5 -7 -47 RAD 3 cyl2"));
        self.ring("8.5 -7 -47", "0 1 0", 3.0, "cyl2");
        self.ring("8.5 -15 -47", "0 -1 0", 3.0, "cyl2");
    }

    fn ring(&mut self, center: &str, normal: &str, radius: f64, texture: &str) {
        self.line(format_args!("RING CENTER {center} NORMAL {normal} INNER 0 OUTER {radius} {texture}"));
    }

    fn cone(&mut self, base: DVec3, radius: f64, height: f64, texture: &str) {
        let slope = DVec2::new(height, radius).normalize();
        let around = |u: f64| DVec3::new(cos(u), 0.0, sin(u));
        let normal = |u: f64| around(u) * slope.x + DVec3::Y * slope.y;
        let apex = base + DVec3::Y * height;
        for i in 0..AROUND {
            let angle = |steps: f64| TAU * (f64::from(i) + steps) / f64::from(AROUND);
            let on_base = |u: f64| (base + around(u) * radius, normal(u));
            let triangle = [on_base(angle(0.0)), on_base(angle(1.0)), (apex, normal(angle(0.5)))];
            self.smooth_triangle(triangle, texture);
        }
        self.ring(&Numbers(base).to_string(), "0 -1 0", radius, texture);
    }
}

fn on_ellipsoid(u: f64, v: f64) -> Vertex {
    let unit = DVec3::new(cos(v) * cos(u), sin(v), cos(v) * sin(u));
    let scale = DVec3::new(1.3, 0.8, 1.0);
    let (sine, cosine) = (sin(15f64.to_radians()), cos(15f64.to_radians()));
    let turned = |p: DVec3| DVec3::new(p.x * cosine + p.z * sine, p.y, -p.x * sine + p.z * cosine);
    let center = DVec3::new(8.5, -4.6, -47.0);
    (center + turned(unit * scale * 3.0), turned((unit / scale).normalize()))
}

/// Three numbers with blanks between them.
struct Numbers(DVec3);

impl std::fmt::Display for Numbers {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} {} {}", self.0.x, self.0.y, self.0.z)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_model_has_all_its_parts() {
        let model = model((500, 500), "t.ppm");
        let count = |word: &str| model.lines().filter(|line| line.starts_with(word)).count();
        assert_eq!((count("PLANE "), count("SPHERE "), count("FCYLINDER "), count("RING ")), (6, 2, 2, 6));
        assert_eq!(count("TRI "), 2 * (10 * 7 + 1));
        assert_eq!(count("STRI "), (2 * 64 * 31) + 2 * 64);
        assert!(model.contains("FRUSTUM 0.8 -0.8 -0.8 0.8"));
    }
}

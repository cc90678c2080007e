//! The scenes, once for durer and once for the others.

use durer::imaging::Image;
use durer::math::{DVec3, Rgb, functions};
use serde_json::{Value, json};
use std::f64::consts::PI;
use std::fmt::Write as _;

/// A scene as all programs can draw it.
pub(super) struct Scene {
    pub(super) name: &'static str,
    pub(super) size: u32,
    pub(super) max_depth: u32,
    /// What else durer's path tracer is told.
    pub(super) settings: &'static str,
    eye: DVec3,
    target: DVec3,
    /// The vertical angle of view, in degrees.
    fov: f64,
    /// The file of the environment, if there is one.
    environment: Option<&'static str>,
    materials: Vec<(&'static str, Material)>,
    shapes: Vec<(Shape, &'static str)>,
}

enum Material {
    Matte { color: [f64; 3], emission: Option<[f64; 3]> },
    Metal { eta: [f64; 3], k: [f64; 3], roughness: f64 },
    Glass { ior: f64 },
}

enum Shape {
    Sphere {
        center: DVec3,
        radius: f64,
    },
    Cylinder {
        base: DVec3,
        top: DVec3,
        radius: f64,
    },
    Rectangle {
        corner: DVec3,
        edges: [DVec3; 2],
    },
    /// The cube from -1 to 1 under these columns.
    Box {
        columns: [DVec3; 3],
        center: DVec3,
    },
}

/// The file of the sky that lights the second scene.
pub(super) const SKY: &str = "sky.exr";
/// The same for Mitsuba, which takes the first and the last row of pixels for the poles themselves.
pub(super) const SKY_TO_THE_POLES: &str = "sky-to-the-poles.exr";

/// How far things stand above the floor: Mitsuba's rays, in single precision, leave what they meet by up to 0.002 at these
/// distances, and would begin behind what is nearer.
const GAP: f64 = 0.02;

const WHITE: [f64; 3] = [0.885809, 0.698859, 0.666422];

/// The Cornell box with the numbers of Mitsuba's `cornell_box()`.
pub(super) fn cornell(size: u32) -> Scene {
    let v = DVec3::new;
    let wall = |corner, a, b| Shape::Rectangle { corner, edges: [a, b] };
    Scene {
        name: "cornell",
        size,
        max_depth: 8,
        settings: ", split: 4, reuse: 16",
        eye: v(0.0, 0.0, 3.9),
        target: DVec3::ZERO,
        fov: 39.3077,
        environment: None,
        materials: vec![
            ("white", Material::Matte { color: WHITE, emission: None }),
            ("green", Material::Matte { color: [0.105421, 0.37798, 0.076425], emission: None }),
            ("red", Material::Matte { color: [0.570068, 0.0430135, 0.0443706], emission: None }),
            ("lamp", Material::Matte { color: WHITE, emission: Some([18.387, 13.9873, 6.75357]) }),
        ],
        shapes: vec![
            (wall(v(-1.0, -1.0, 1.0), v(2.0, 0.0, 0.0), v(0.0, 0.0, -2.0)), "white"),
            (wall(v(-1.0, 1.0, -1.0), v(2.0, 0.0, 0.0), v(0.0, 0.0, 2.0)), "white"),
            (wall(v(-1.0, -1.0, -1.0), v(2.0, 0.0, 0.0), v(0.0, 2.0, 0.0)), "white"),
            (wall(v(1.0, -1.0, -1.0), v(0.0, 0.0, 2.0), v(0.0, 2.0, 0.0)), "green"),
            (wall(v(-1.0, -1.0, 1.0), v(0.0, 0.0, -2.0), v(0.0, 2.0, 0.0)), "red"),
            (wall(v(-0.23, 0.99, -0.18), v(0.46, 0.0, 0.0), v(0.0, 0.0, 0.38)), "lamp"),
            (
                Shape::Box {
                    columns: [v(0.286891, 0.0, 0.0877115), v(0.0, 0.3, 0.0), v(-0.0877115, 0.0, 0.286891)],
                    center: v(0.335, -0.7, 0.38),
                },
                "white",
            ),
            (
                Shape::Box {
                    columns: [v(0.28491, 0.0, -0.0939491), v(0.0, 0.61, 0.0), v(0.0939491, 0.0, 0.28491)],
                    center: v(-0.33, -0.4, -0.28),
                },
                "white",
            ),
        ],
    }
}

/// A thousand balls and tubes of metal, glass and matte stuff on a floor, under the sky.
pub(super) fn thousand(size: u32) -> Scene {
    let mut shapes = vec![(
        Shape::Rectangle {
            corner: DVec3::new(-40.0, 0.0, 40.0),
            edges: [DVec3::new(80.0, 0.0, 0.0), DVec3::new(0.0, 0.0, -80.0)],
        },
        "floor",
    )];
    let kinds = ["gold", "glass", "clay", "steel", "glass", "slate"];
    for index in 0..1000_u32 {
        // Places on a jittered grid; the numbers are the fractional parts of multiples of irrational ones.
        let dice = |n: u32| (f64::from(index * 7 + n) * 0.754_877_666_246_692_7).fract();
        let (column, row) = (f64::from(index % 32), f64::from(index / 32));
        let radius = 0.16 + 0.2 * dice(1);
        let at = DVec3::new(column - 15.5 + 0.24 * (dice(2) - 0.5), 0.0, row - 15.5 + 0.24 * (dice(3) - 0.5));
        let shape = match index % 2 {
            0 => Shape::Sphere { center: at + DVec3::Y * (radius + GAP), radius },
            _ => Shape::Cylinder {
                base: at + DVec3::Y * GAP,
                top: at + DVec3::Y * (0.3 + 0.8 * dice(4)),
                radius: 0.8 * radius,
            },
        };
        shapes.push((shape, kinds[(dice(5) * 6.0) as usize % 6]));
    }
    Scene {
        name: "thousand",
        size,
        max_depth: 16,
        settings: "",
        eye: DVec3::new(7.0, 6.0, 20.0),
        target: DVec3::new(0.0, 0.0, 4.0),
        fov: 34.0,
        environment: Some(SKY),
        materials: vec![
            ("floor", Material::Matte { color: [0.5, 0.5, 0.5], emission: None }),
            ("clay", Material::Matte { color: [0.6, 0.25, 0.15], emission: None }),
            ("slate", Material::Matte { color: [0.15, 0.2, 0.3], emission: None }),
            ("gold", Material::Metal { eta: [0.143, 0.375, 1.442], k: [3.983, 2.386, 1.603], roughness: 0.3 }),
            ("steel", Material::Metal { eta: [2.875, 2.95, 2.8], k: [3.2, 2.93, 2.9], roughness: 0.5 }),
            ("glass", Material::Glass { ior: 1.5 }),
        ],
        shapes,
    }
}

/// Where the rows of pixels of a sky are, from the top down.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Rows {
    /// Each is as high as the others.
    Even,
    /// The first and the last are the poles.
    ToThePoles,
}

/// A sky with a soft sun, 512 × 256: u grows with the angle from -z towards +x, v from the top down.
pub(super) fn sky(rows: Rows) -> Image {
    let (width, height) = (512_u32, 256_u32);
    let down = |y: u32| match rows {
        Rows::Even => (f64::from(y) + 0.5) / f64::from(height),
        Rows::ToThePoles => f64::from(y) / f64::from(height - 1),
    };
    let sun = DVec3::new(0.5, 0.6, 0.4).normalize();
    let mut pixels = Vec::new();
    for y in 0..height {
        for x in 0..width {
            let (u, v) = ((f64::from(x) + 0.5) / f64::from(width), down(y));
            let (azimuth, polar) = (2.0 * PI * u, PI * v);
            let ring = functions::sin(polar);
            let d = DVec3::new(ring * functions::sin(azimuth), functions::cos(polar), -ring * functions::cos(azimuth));
            let glow = functions::pow(d.dot(sun).max(0.0) as f32, 400.0) * 120.0;
            let blue = Rgb::new(0.9, 0.95, 1.0).lerp(Rgb::new(0.25, 0.45, 0.9), d.y.max(0.0) as f32);
            let ground = Rgb::gray(0.25);
            let base = if d.y < 0.0 { ground } else { blue };
            pixels.push(base + Rgb::new(1.0, 0.85, 0.6) * glow);
        }
    }
    Image { width, height, pixels }
}

fn list(v: DVec3) -> [f64; 3] {
    v.to_array()
}

impl Scene {
    /// For the scripts of the others.
    pub(super) fn json(&self) -> Value {
        let materials = self.materials.iter().map(|(name, material)| {
            let value = match material {
                Material::Matte { color, emission } => json!({"kind": "matte", "color": color, "emission": emission}),
                Material::Metal { eta, k, roughness } => {
                    json!({"kind": "metal", "eta": eta, "k": k, "roughness": roughness})
                }
                Material::Glass { ior } => json!({"kind": "glass", "ior": ior}),
            };
            ((*name).to_owned(), value)
        });
        let shapes = self.shapes.iter().map(|(shape, material)| match shape {
            Shape::Sphere { center, radius } => {
                json!({"kind": "sphere", "center": list(*center), "radius": radius, "material": material})
            }
            Shape::Cylinder { base, top, radius } => {
                json!({"kind": "cylinder", "base": list(*base), "top": list(*top), "radius": radius, "material": material})
            }
            Shape::Rectangle { corner, edges } => {
                json!({"kind": "rectangle", "corner": list(*corner), "edges": edges.map(list), "material": material})
            }
            Shape::Box { columns, center } => {
                json!({"kind": "box", "columns": columns.map(list), "center": list(*center), "material": material})
            }
        });
        json!({
            "size": self.size,
            "max_depth": self.max_depth,
            "camera": {"eye": list(self.eye), "target": list(self.target), "fov": self.fov},
            "environment": self.environment,
            "environment_to_the_poles": self.environment.map(|_| SKY_TO_THE_POLES),
            "materials": materials.collect::<serde_json::Map<String, Value>>(),
            "shapes": shapes.collect::<Vec<_>>(),
        })
    }

    /// For durer.
    pub(super) fn yaml(&self) -> String {
        let v = |v: DVec3| format!("[{}, {}, {}]", v.x, v.y, v.z);
        let a = |[r, g, b]: [f64; 3]| format!("[{r}, {g}, {b}]");
        let mut text = format!(
            "camera: {{position: {}, look_at: {}, fov: {}}}\n\
             picture: {{width: {size}, height: {size}}}\n\
             render: {{integrator: {{path: {{max_depth: {}{}}}}}}}\n\
             lights: []\n",
            v(self.eye),
            v(self.target),
            self.fov,
            self.max_depth,
            self.settings,
            size = self.size,
        );
        text += &match self.environment {
            Some(file) => format!("background: {{image: {file}, rotation: -90}}\n"),
            None => "background: black\n".to_owned(),
        };
        text += "materials:\n";
        for (name, material) in &self.materials {
            let material = match material {
                Material::Matte { color, emission: None } => format!("matte: {{color: {}}}", a(*color)),
                Material::Matte { color, emission: Some(emission) } => {
                    format!("matte: {{color: {}, emission: {{color: {}, sides: front}}}}", a(*color), a(*emission))
                }
                Material::Metal { eta, k, roughness } => {
                    format!("metal: {{eta: {}, k: {}, roughness: {roughness}}}", a(*eta), a(*k))
                }
                Material::Glass { ior } => format!("glass: {{ior: {ior}}}"),
            };
            let _ = writeln!(text, "  {name}: {{{material}}}");
        }
        text += "objects:\n";
        for (shape, material) in &self.shapes {
            let shape = match shape {
                Shape::Sphere { center, radius } => {
                    format!("sphere: {{center: {}, radius: {radius}, material: {material}}}", v(*center))
                }
                Shape::Cylinder { base, top, radius } => {
                    format!(
                        "cylinder: {{base: {}, top: {}, radius: {radius}, material: {material}}}",
                        v(*base),
                        v(*top)
                    )
                }
                Shape::Rectangle { corner, edges } => {
                    let [a, b] = edges.map(v);
                    format!("rectangle: {{corner: {}, edges: [{a}, {b}], material: {material}}}", v(*corner))
                }
                Shape::Box { columns: [x, y, z], center } => format!(
                    "box: {{min: [-1, -1, -1], max: [1, 1, 1], material: {material}, transform: [matrix: [[{}, \
                     {}, {}, {}], [{}, {}, {}, {}], [{}, {}, {}, {}]]]}}",
                    x.x, y.x, z.x, center.x, x.y, y.y, z.y, center.y, x.z, y.z, z.z, center.z
                ),
            };
            let _ = writeln!(text, "  - {shape}");
        }
        text
    }
}

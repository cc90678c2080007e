//! A second ray tracer, for one scene only: the seed's room, from its table of numbers and its seven rules.
//!
//! It shares no code with durer and is made to be read against the table, not to be fast. `+y` is up, the eye is at the
//! origin and looks along -z; all surfaces are tested one after the other, in double precision.

type V = [f64; 3];

const EPSILON: f64 = 1e-7;

fn add(a: V, b: V) -> V {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}
fn sub(a: V, b: V) -> V {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}
fn scale(a: V, k: f64) -> V {
    a.map(|c| c * k)
}
fn times(a: V, b: V) -> V {
    [a[0] * b[0], a[1] * b[1], a[2] * b[2]]
}
fn dot(a: V, b: V) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
fn unit(a: V) -> V {
    scale(a, 1.0 / dot(a, a).sqrt())
}

#[derive(Clone, Copy)]
enum Behind {
    Nothing,
    Mirrored(f64),
    Straight(f64),
    Bent(f64, f64),
}

#[derive(Clone, Copy)]
struct Surface {
    t: f64,
    normal: V,
    color: V,
    specular: f64,
    behind: Behind,
}

/// The texture: linear colours, rows from the top.
pub(crate) struct Texture {
    pub(crate) size: usize,
    pub(crate) pixels: Vec<V>,
}

pub(crate) struct Room {
    pub(crate) texture: Texture,
    pub(crate) fog: bool,
}

/// Both solutions of a t² + 2 b t + c = 0.
fn roots(a: f64, b: f64, c: f64) -> Vec<f64> {
    let d = b * b - a * c;
    if d < 0.0 { vec![] } else { vec![(-b - d.sqrt()) / a, (-b + d.sqrt()) / a] }
}

impl Room {
    /// All surfaces that a ray meets, both faces of everything.
    fn surfaces(&self, o: V, d: V) -> Vec<Surface> {
        let mut all = Vec::new();
        let mut meet = |t: f64, normal: V, color: V, specular: f64, behind: Behind| {
            if t > EPSILON {
                all.push(Surface { t, normal: unit(normal), color, specular, behind });
            }
        };
        let at = |t: f64| add(o, scale(d, t));

        // Walls, floor, ceiling.
        for (axis, place, color) in [
            (0, -30.0, [0.8, 0.2, 0.2]),
            (0, 30.0, [0.2, 0.7, 0.2]),
            (1, -25.0, [0.5, 0.5, 0.5]),
            (1, 25.0, [0.8, 0.8, 0.75]),
            (2, -70.0, [0.2, 0.3, 0.8]),
            (2, 20.0, [0.7, 0.3, 0.7]),
        ] {
            let mut normal = [0.0; 3];
            normal[axis] = 1.0;
            meet((place - o[axis]) / d[axis], normal, color, 0.0, Behind::Nothing);
        }

        // Table.
        let t = (-15.0 - o[1]) / d[1];
        let p = at(t);
        if p[0].abs() <= 20.0 && (-56.0..=-28.0).contains(&p[2]) {
            let even = ((p[0] / 4.0).floor() + (p[2] / 4.0).floor()).rem_euclid(2.0) == 0.0;
            meet(t, [0.0, 1.0, 0.0], [if even { 0.95 } else { 0.05 }; 3], 0.0, Behind::Nothing);
        }

        // Mirror: through (-14, -6, -69), sides (28, 0, 0) and (0, 20, 3), normal (0, -3, 20).
        let (corner, normal) = ([-14.0, -6.0, -69.0], [0.0, -3.0, 20.0]);
        let t = dot(sub(corner, o), normal) / dot(d, normal);
        let p = at(t);
        if p[0].abs() <= 14.0 && (-6.0..=14.0).contains(&p[1]) {
            meet(t, normal, [0.1; 3], 0.0, Behind::Mirrored(0.8));
        }

        // Clear ball and glass ball.
        for (center, color, behind) in [
            ([-9.0, -10.0, -38.0], [0.9, 0.4, 0.4], Behind::Straight(0.7)),
            ([0.0, -10.0, -42.0], [0.6, 0.8, 0.9], Behind::Bent(0.8, 1.5)),
        ] {
            let q = sub(o, center);
            for t in roots(dot(d, d), dot(q, d), dot(q, q) - 25.0) {
                meet(t, sub(at(t), center), color, 0.6, behind);
            }
        }

        // Ellipsoid: (x, z) -> (x cos + z sin, -x sin + z cos) is undone, then the scale.
        let (sin, cos) = 15.0_f64.to_radians().sin_cos();
        let undo = |v: V| [(v[0] * cos - v[2] * sin) / 1.3, v[1] / 0.8, v[0] * sin + v[2] * cos];
        let (q, e) = (undo(sub(o, [8.5, -4.6, -47.0])), undo(d));
        for t in roots(dot(e, e), dot(q, e), dot(q, q) - 9.0) {
            let p = add(q, scale(e, t));
            let n = [p[0] / 1.3, p[1] / 0.8, p[2]];
            let normal = [n[0] * cos + n[2] * sin, n[1], -n[0] * sin + n[2] * cos];
            meet(t, normal, [0.9, 0.8, 0.1], 0.6, Behind::Nothing);
        }

        // Cylinders.
        for (center, half, r, textured) in
            [([-12.0, -17.0, -23.0], 8.0, 2.5, true), ([8.5, -11.0, -47.0], 4.0, 3.0, false)]
        {
            let q = sub(o, center);
            let a = d[0] * d[0] + d[2] * d[2];
            for t in roots(a, q[0] * d[0] + q[2] * d[2], q[0] * q[0] + q[2] * q[2] - r * r) {
                let p = add(q, scale(d, t));
                if p[1].abs() <= half {
                    let color = if textured { self.label(p) } else { [0.1, 0.6, 0.2] };
                    meet(t, [p[0], 0.0, p[2]], color, 0.6, Behind::Nothing);
                }
            }
            for y in [-half, half] {
                let t = (y - q[1]) / d[1];
                let p = add(q, scale(d, t));
                if p[0] * p[0] + p[2] * p[2] <= r * r {
                    let color = if textured { [0.6; 3] } else { [0.1, 0.6, 0.2] };
                    meet(t, [0.0, 1.0, 0.0], color, 0.6, Behind::Nothing);
                }
            }
        }

        // Cones: x² + z² = (k (h - y))², k = r / h.
        for (base, r, h, color) in
            [([3.0, -15.0, -32.0], 2.0, 5.0, [0.9, 0.5, 0.1]), ([-12.0, -15.0, -50.0], 4.0, 13.0, [0.1, 0.7, 0.1])]
        {
            let (q, k2) = (sub(o, base), (r / h) * (r / h));
            let g = h - q[1];
            let a = d[0] * d[0] + d[2] * d[2] - k2 * d[1] * d[1];
            let b = q[0] * d[0] + q[2] * d[2] + k2 * g * d[1];
            for t in roots(a, b, q[0] * q[0] + q[2] * q[2] - k2 * g * g) {
                let p = add(q, scale(d, t));
                if (0.0..=h).contains(&p[1]) {
                    meet(t, [p[0], k2 * (h - p[1]), p[2]], color, 0.6, Behind::Nothing);
                }
            }
            let t = -q[1] / d[1];
            let p = add(q, scale(d, t));
            if p[0] * p[0] + p[2] * p[2] <= r * r {
                meet(t, [0.0, -1.0, 0.0], color, 0.6, Behind::Nothing);
            }
        }
        all
    }

    /// The texture around the cylinder, at a point relative to its middle: bilinear, repeating, t upward.
    fn label(&self, p: V) -> V {
        let n = self.texture.size as f64;
        let x = (p[2].atan2(p[0]) + std::f64::consts::PI) / std::f64::consts::TAU * n - 0.5;
        let y = (p[1] + 8.0) / 16.0 * n - 0.5;
        let pixel = |i: f64, j: f64| {
            let (column, row) = (i.rem_euclid(n) as usize, j.rem_euclid(n) as usize);
            self.texture.pixels[(self.texture.size - 1 - row) * self.texture.size + column]
        };
        let (i, j) = (x.floor(), y.floor());
        let (u, v) = (x - i, y - j);
        let mix = |a: V, b: V, k: f64| add(scale(a, 1.0 - k), scale(b, k));
        mix(mix(pixel(i, j), pixel(i + 1.0, j), u), mix(pixel(i, j + 1.0), pixel(i + 1.0, j + 1.0), u), v)
    }

    /// What gets from a light to a point: the product over all surfaces between.
    fn visibility(&self, p: V, l: V, distance: f64) -> f64 {
        let between = self.surfaces(p, l).into_iter().filter(|s| s.t < distance - EPSILON);
        between.fold(1.0, |left, s| match s.behind {
            Behind::Straight(t) | Behind::Bent(t, _) => left * t,
            Behind::Nothing | Behind::Mirrored(_) => 0.0,
        })
    }

    /// 0.2 C + Σ V I (0.8 C max(0, n·l) + ks max(0, r·v)^40).
    fn shade(&self, p: V, d: V, n: V, s: &Surface) -> V {
        let mut sum = scale(s.color, 0.2);
        let axis = unit([0.0, -20.0, -35.0]);
        for (light, spot) in [([20.0, 23.0, 15.0], false), ([-20.0, 23.0, 15.0], false), ([0.0, 5.0, -5.0], true)] {
            let to = sub(light, p);
            let distance = dot(to, to).sqrt();
            let l = scale(to, 1.0 / distance);
            if spot && -dot(l, axis) < 15.0_f64.to_radians().cos() {
                continue;
            }
            let cosine = dot(n, l);
            if cosine > 0.0 {
                let light = 0.5 * self.visibility(p, l, distance);
                let r = sub(scale(n, 2.0 * cosine), l);
                let highlight = s.specular * (-dot(r, d)).max(0.0).powi(40);
                sum = add(sum, add(scale(s.color, light * 0.8 * cosine), [light * highlight; 3]));
            }
        }
        sum
    }

    /// What is seen along a ray of unit direction; a ray of depth 6 is black.
    fn trace(&self, o: V, d: V, depth: u32) -> V {
        if depth > 5 {
            return [0.0; 3];
        }
        let all = self.surfaces(o, d).into_iter();
        let s = all.min_by(|a, b| a.t.total_cmp(&b.t)).expect("the room is closed");
        let p = add(o, scale(d, s.t));
        let entering = dot(s.normal, d) < 0.0;
        let n = if entering { s.normal } else { scale(s.normal, -1.0) };
        let mirrored = || sub(d, scale(n, 2.0 * dot(n, d)));
        let shade = self.shade(p, d, n, &s);
        let blend = |t: f64, behind: V| add(scale(shade, 1.0 - t), scale(behind, t));
        let color = match s.behind {
            Behind::Nothing => shade,
            Behind::Mirrored(k) => add(shade, scale(self.trace(p, mirrored(), depth + 1), k)),
            Behind::Straight(t) => blend(t, self.trace(p, d, depth + 1)),
            Behind::Bent(t, index) => {
                let eta = if entering { 1.0 / index } else { index };
                let cosine = -dot(n, d);
                let k = 1.0 - eta * eta * (1.0 - cosine * cosine);
                let on = if k < 0.0 { mirrored() } else { add(scale(d, eta), scale(n, eta * cosine - k.sqrt())) };
                blend(t, self.trace(p, unit(on), depth + 1))
            }
        };
        if !self.fog {
            return color;
        }
        let fog = [0.75, 0.75, 0.8];
        add(fog, scale(sub(color, fog), (-s.t / 400.0).exp()))
    }

    /// The pixel in column x and row y of a square picture: one ray through its middle.
    pub(crate) fn pixel(&self, x: u32, y: u32, size: u32) -> V {
        let along = |i: u32| (2.0 * f64::from(i) + 1.0) / f64::from(size) - 1.0;
        self.trace([0.0; 3], unit(times([along(x), -along(y), -1.0], [0.8, 0.8, 1.0])), 1)
    }
}

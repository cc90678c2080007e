//! One emitter, described in several ways.

use crate::support::pixel;

/// A spot of floor under a ball of light: exact, as a mesh, and as part of the sky.
#[test]
fn a_ball_of_light_as_shape_and_as_mesh() {
    let scene = |light: &str| {
        format!(
            "camera: {{position: [0, 0.01, 0], look_at: [0, 0, 0], up: [0, 0, 1], orthographic: {{height: 0.0001}}}}\n\
             background: black\nlights: []\n\
             objects:\n  \
             - rectangle: {{corner: [-1, 0, 1], edges: [[2, 0, 0], [0, 0, -2]], material: {{matte: {{color: 0.8}}}}}}\n  \
             - {light}\n"
        )
    };
    let ball = "sphere: {center: [1, 3, 0], radius: 0.8, material: {matte: {color: black, emission: 5}}}";
    let (exact, error) = pixel("{path: {max_depth: 2}}", 64, &scene(ball));
    let (mesh, mesh_error) = pixel("{path: {max_depth: 2}}", 64, &scene(&ball_mesh(96)));
    let (a, b) = (f64::from(exact.g), f64::from(mesh.g));
    // A polyhedron of so many corners, all on the ball, is a little smaller than that.
    assert!((a - b).abs() < 5.0 * (error + mesh_error) + 0.002 * a, "{a} ± {error}, {b} ± {mesh_error}");
}

/// The same ball as triangles between meridians and parallels.
fn ball_mesh(meridians: usize) -> String {
    let parallels = meridians / 2;
    let angle = |part: usize, of: usize| std::f64::consts::PI * part as f64 / of as f64;
    let mut positions = Vec::new();
    for row in 0..=parallels {
        for column in 0..meridians {
            let (polar, around) = (angle(row, parallels), 2.0 * angle(column, meridians));
            let (x, y, z) = (polar.sin() * around.cos(), polar.cos(), polar.sin() * around.sin());
            positions.push(format!("[{}, {}, {}]", 1.0 + 0.8 * x, 3.0 + 0.8 * y, 0.8 * z));
        }
    }
    let mut triangles = Vec::new();
    for row in 0..parallels {
        for column in 0..meridians {
            let at = |row: usize, column: usize| row * meridians + column % meridians;
            let [a, b] = [at(row, column), at(row, column + 1)];
            let [c, d] = [at(row + 1, column), at(row + 1, column + 1)];
            if row > 0 {
                triangles.push(format!("[{a}, {b}, {c}]"));
            }
            if row + 1 < parallels {
                triangles.push(format!("[{b}, {d}, {c}]"));
            }
        }
    }
    format!(
        "mesh: {{vertices: [{}], triangles: [{}], material: {{matte: {{color: black, emission: 5}}}}}}",
        positions.join(", "),
        triangles.join(", ")
    )
}

//! The colour spaces of FLIP. White is that of the sRGB primaries, so that grays have no chroma.

use durer_math::functions::cbrt;

/// Rows X, Y, Z of the matrix from linear sRGB, as the paper's supplement has it, in exact fractions.
const XYZ_FROM_LINEAR: [[f64; 3]; 3] = [
    [10_135_552.0 / 24_577_794.0, 8_788_810.0 / 24_577_794.0, 4_435_075.0 / 24_577_794.0],
    [2_613_072.0 / 12_288_897.0, 8_788_810.0 / 12_288_897.0, 887_015.0 / 12_288_897.0],
    [1_425_312.0 / 73_733_382.0, 8_788_810.0 / 73_733_382.0, 70_074_185.0 / 73_733_382.0],
];

/// Its inverse.
const LINEAR_FROM_XYZ: [[f64; 3]; 3] = [
    [3.241_003_232_976_358, -1.537_398_969_488_785, -0.498_615_881_996_363],
    [-0.969_224_252_202_516, 1.875_929_983_695_176, 0.041_554_226_340_084_7],
    [0.055_639_419_851_975_4, -0.204_011_206_123_910, 1.057_148_977_187_533],
];

fn multiply(matrix: &[[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

/// X, Y, Z, each divided by that of white.
fn relative_xyz_from_linear(linear: [f32; 3]) -> [f64; 3] {
    let xyz = multiply(&XYZ_FROM_LINEAR, linear.map(f64::from));
    let white = multiply(&XYZ_FROM_LINEAR, [1.0; 3]);
    [xyz[0] / white[0], xyz[1] / white[1], xyz[2] / white[2]]
}

/// The linear opponent space YCxCz.
pub(super) fn ycxcz_from_linear(linear: [f32; 3]) -> [f32; 3] {
    let [x, y, z] = relative_xyz_from_linear(linear);
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)].map(|v| v as f32)
}

/// Back from [`ycxcz_from_linear`].
pub(super) fn linear_from_ycxcz(ycxcz: [f32; 3]) -> [f32; 3] {
    let [y, cx, cz] = ycxcz.map(f64::from);
    let y = (y + 16.0) / 116.0;
    let (x, z) = (y + cx / 500.0, y - cz / 200.0);
    let white = multiply(&XYZ_FROM_LINEAR, [1.0; 3]);
    multiply(&LINEAR_FROM_XYZ, [x * white[0], y * white[1], z * white[2]]).map(|v| v as f32)
}

/// CIE L*a*b* with a* and b* scaled by the lightness: the Hunt effect, that colours fade in the dark.
pub(super) fn hunt_lab_from_linear(linear: [f32; 3]) -> [f32; 3] {
    let [x, y, z] = relative_xyz_from_linear(linear).map(compressed);
    let lightness = 116.0 * y - 16.0;
    let hunt = 0.01 * lightness;
    [lightness, hunt * 500.0 * (x - y), hunt * 200.0 * (y - z)].map(|v| v as f32)
}

/// The cube root, with a straight piece near black.
fn compressed(t: f64) -> f64 {
    const DELTA: f64 = 6.0 / 29.0;
    if t > DELTA * DELTA * DELTA { cbrt(t) } else { t / (3.0 * DELTA * DELTA) + 4.0 / 29.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_and_back_again() {
        for linear in [[0.0, 0.0, 0.0], [1.0, 1.0, 1.0], [0.2, 0.7, 0.1], [1.0, 0.0, 0.5]] {
            let back = linear_from_ycxcz(ycxcz_from_linear(linear));
            for (a, b) in linear.iter().zip(back) {
                assert!((a - b).abs() < 1e-6, "{linear:?} {back:?}");
            }
        }
    }

    #[test]
    fn known_colors() {
        for (linear, lab) in
            [([1.0; 3], [100.0, 0.0, 0.0]), ([0.0; 3], [0.0; 3]), ([0.0, 0.0, 1.0], [32.3, 25.6, -34.8])]
        {
            let ours = hunt_lab_from_linear(linear);
            for (a, b) in ours.iter().zip(lab) {
                assert!((a - b).abs() < 0.1, "{linear:?}: {ours:?}");
            }
        }
    }
}

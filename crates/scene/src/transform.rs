//! Transforms: an ordered list of steps.

use durer_math::{DAffine3, DMat3, DVec3, rotation};

/// Steps applied to a point one after the other, the first one first.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Transform {
    /// The steps.
    pub steps: Vec<TransformStep>,
}

/// One step of a transform.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TransformStep {
    /// Moves by a vector.
    Translate(DVec3),
    /// Multiplies each coordinate; negative factors mirror, none may be zero.
    Scale(DVec3),
    /// Turns about an axis through the origin, by the right-hand rule.
    Rotate {
        /// The axis (any length but zero).
        axis: DVec3,
        /// The angle, in degrees.
        degrees: f64,
    },
    /// Multiplies the column vector (x, y, z, 1); three rows of four numbers, the last column being the translation.
    Matrix([[f64; 4]; 3]),
}

impl Transform {
    /// All steps in one map, from the inner space to the outer.
    pub fn to_affine(&self) -> DAffine3 {
        self.steps.iter().fold(DAffine3::IDENTITY, |all, step| step.to_affine() * all)
    }
}

impl TransformStep {
    /// The step as a map.
    pub fn to_affine(&self) -> DAffine3 {
        match *self {
            TransformStep::Translate(by) => DAffine3::from_translation(by),
            TransformStep::Scale(factors) => DAffine3::from_scale(factors),
            TransformStep::Rotate { axis, degrees } => {
                DAffine3::from_mat3(rotation(axis.normalize(), degrees.to_radians()))
            }
            TransformStep::Matrix([a, b, c]) => DAffine3 {
                matrix3: DMat3::from_cols(
                    DVec3::new(a[0], b[0], c[0]),
                    DVec3::new(a[1], b[1], c[1]),
                    DVec3::new(a[2], b[2], c[2]),
                ),
                translation: DVec3::new(a[3], b[3], c[3]),
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_apply_in_order() {
        let transform = Transform {
            steps: vec![
                TransformStep::Scale(DVec3::new(2.0, 1.0, 1.0)),
                TransformStep::Rotate { axis: DVec3::Y * 3.0, degrees: 90.0 },
                TransformStep::Translate(DVec3::new(0.0, 5.0, 0.0)),
            ],
        };
        let moved = transform.to_affine().transform_point3(DVec3::X);
        assert!((moved - DVec3::new(0.0, 5.0, -2.0)).length() < 1e-15, "{moved}");
    }

    #[test]
    fn a_matrix_is_given_by_rows() {
        let step = TransformStep::Matrix([[1.0, 2.0, 3.0, 4.0], [0.0, 1.0, 0.0, 5.0], [0.0, 0.0, 1.0, 6.0]]);
        assert_eq!(step.to_affine().transform_point3(DVec3::ONE), DVec3::new(10.0, 6.0, 7.0));
    }
}

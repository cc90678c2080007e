//! Single values: numbers, vectors, colours, transforms.

use super::bounds::{
    BRIGHTEST, LARGEST, LARGEST_FACTOR, SMALLEST, are_apart, changes_lengths_by, is_near, wrong_with_fraction,
    wrong_with_point, wrong_with_size, wrong_with_size_or_zero,
};
use super::{Place, Problem, Step};
use crate::{Scene, Transform, TransformStep};
use durer_math::{DAffine3, DVec3, Rgb};
use std::collections::{BTreeMap, BTreeSet};

/// What an object stands in.
#[derive(Clone, Copy)]
pub(super) struct Around {
    /// From there to the world; with instances, that of the first copy and without their scale.
    pub(super) map: DAffine3,
    /// The least factor by which instances scale it.
    pub(super) least: f64,
    /// The greatest.
    pub(super) most: f64,
}

impl Around {
    /// Nothing around.
    pub(super) const WORLD: Around = Around { map: DAffine3::IDENTITY, least: 1.0, most: 1.0 };

    /// True if all together are reversible and change no length too much, nor move too far.
    pub(super) fn is_usable(&self) -> bool {
        let Around { map, least, most } = *self;
        changes_lengths_by(map.matrix3, least, most) && is_near(map.translation)
    }
}

/// Gathers problems on the way through a scene.
pub(super) struct Checker<'s> {
    pub(super) scene: &'s Scene,
    pub(super) problems: Vec<Problem>,
    /// Where the check is now.
    place: Vec<Step>,
    /// Addresses of the meshes that have been checked: several objects may share one.
    pub(super) meshes: BTreeSet<usize>,
    /// How many open edges those among them have that are parts of solids.
    pub(super) open_edges: BTreeMap<usize, Option<usize>>,
}

impl<'s> Checker<'s> {
    pub(super) fn new(scene: &'s Scene) -> Self {
        Checker { scene, problems: Vec::new(), place: Vec::new(), meshes: BTreeSet::new(), open_edges: BTreeMap::new() }
    }

    /// Checks something one step further down.
    pub(super) fn at<R>(&mut self, step: Step, check: impl FnOnce(&mut Self) -> R) -> R {
        self.place.push(step);
        let result = check(self);
        self.place.pop();
        result
    }

    /// Checks something in a field.
    pub(super) fn field<R>(&mut self, name: &'static str, check: impl FnOnce(&mut Self) -> R) -> R {
        self.at(Step::Field(name), check)
    }

    /// A problem right here; always false.
    pub(super) fn problem(&mut self, message: impl Into<String>) -> bool {
        let place = Place { steps: self.place.clone() };
        self.problems.push(Problem { place, message: message.into(), help: None, is_of_one_value: false });
        false
    }

    /// What has come of looking at one value alone: unless `fine`, the last problem is of that.
    fn alone(&mut self, fine: bool) -> bool {
        if let (false, Some(last)) = (fine, self.problems.last_mut()) {
            last.is_of_one_value = true;
        }
        fine
    }

    /// A problem right here, and what to do about it; always false.
    pub(super) fn problem_with_help(&mut self, message: impl Into<String>, help: impl Into<String>) -> bool {
        self.problem(message);
        self.advise(help);
        false
    }

    /// What to do about the last problem.
    pub(super) fn advise(&mut self, help: impl Into<String>) {
        if let Some(last) = self.problems.last_mut() {
            last.help = Some(help.into());
        }
    }

    /// A problem in a field unless `fine`.
    pub(super) fn require(&mut self, fine: bool, field: &'static str, message: impl Into<String>) -> bool {
        fine || self.field(field, |c| c.problem(message))
    }

    /// A number in a range of its own.
    pub(super) fn within(&mut self, name: &'static str, value: f64, least: f64, most: f64) -> bool {
        let message = format!("{name} must be from {least} to {most}, not {value}");
        let fine = self.require((least..=most).contains(&value), name, message);
        self.alone(fine)
    }

    /// A radius, width or distance.
    pub(super) fn size(&mut self, name: &'static str, value: f64) -> bool {
        let fine = wrong_with_size(name, value).is_none_or(|message| self.require(false, name, message));
        self.alone(fine)
    }

    /// A size that may also be 0.
    pub(super) fn size_or_zero(&mut self, name: &'static str, value: f64) -> bool {
        let fine = wrong_with_size_or_zero(name, value).is_none_or(|message| self.require(false, name, message));
        self.alone(fine)
    }

    /// A point.
    pub(super) fn point(&mut self, name: &'static str, point: DVec3) -> bool {
        self.field(name, |c| c.point_here(name, point))
    }

    /// A point that is what the check has come to.
    pub(super) fn point_here(&mut self, name: &str, point: DVec3) -> bool {
        let fine = wrong_with_point(name, point).is_none_or(|message| self.problem(message));
        self.alone(fine)
    }

    /// A direction of any usable length.
    pub(super) fn direction(&mut self, name: &'static str, direction: DVec3) -> bool {
        let fine = self.field(name, |c| c.direction_here(name, direction));
        self.alone(fine)
    }

    /// A direction that is what the check has come to.
    pub(super) fn direction_here(&mut self, name: &str, direction: DVec3) -> bool {
        if !self.point_here(name, direction) {
            return false;
        }
        if direction == DVec3::ZERO {
            let help = "any length other than 0 will do, such as `[0, 1, 0]`";
            return self.problem_with_help(format!("{name} must not be zero: it has no direction"), help);
        }
        direction.length() >= SMALLEST || self.problem(format!("{name} must be at least {SMALLEST:e} long"))
    }

    /// Two points that must not coincide.
    pub(super) fn apart(&mut self, (name, point): (&'static str, DVec3), (other, from): (&str, DVec3)) -> bool {
        self.require(are_apart(point, from), name, format!("{name} must not be the same point as {other}"))
    }

    /// Light: no component negative.
    pub(super) fn light(&mut self, name: &'static str, color: Rgb) -> bool {
        let fine = self.field(name, |c| c.light_here(name, color));
        self.alone(fine)
    }

    /// Light that is what the check has come to.
    pub(super) fn light_here(&mut self, name: &str, color: Rgb) -> bool {
        if !color.is_finite() {
            self.problem(format!("{name} must be finite"))
        } else if color.min_component() < 0.0 {
            self.problem(format!("{name} must not be negative"))
        } else {
            color.max_component() <= BRIGHTEST || self.problem(format!("{name} must be at most {BRIGHTEST:e}"))
        }
    }

    /// A part of light: every component from 0 to 1.
    pub(super) fn fraction(&mut self, name: &'static str, color: Rgb) -> bool {
        let fine = self.field(name, |c| c.fraction_here(name, color));
        self.alone(fine)
    }

    /// A part of light that is what the check has come to.
    pub(super) fn fraction_here(&mut self, name: &str, color: Rgb) -> bool {
        let Some(message) = wrong_with_fraction(name, color) else { return true };
        if !color.is_finite() || color.min_component() < 0.0 {
            return self.problem(message);
        }
        let help = "components go from 0 to 1";
        // Bytes that are all so small are more likely meant as something else.
        if (16.0..=255.0).contains(&color.max_component()) && color.to_array().iter().all(|x| x.fract() == 0.0) {
            let [r, g, b] = color.to_array().map(|x| x as u8);
            return self.problem_with_help(message, format!("{help}; for 0 to 255 write \"#{r:02x}{g:02x}{b:02x}\""));
        }
        self.problem_with_help(message, help)
    }

    /// A strength, usually 0 to 1.
    pub(super) fn strength(&mut self, name: &'static str, value: f32) -> bool {
        let message = if value < 0.0 {
            format!("{name} must not be negative")
        } else {
            format!("{name} must be at most {BRIGHTEST:e}")
        };
        let fine = self.require((0.0..=BRIGHTEST).contains(&value), name, message);
        self.alone(fine)
    }

    /// The field `transform`, and it together with those around it. Gives all of them in one, or only the outer if this
    /// one cannot be used.
    pub(super) fn transform(&mut self, transform: &Transform, outer: Around) -> Around {
        self.field("transform", |c| {
            let mut fine = true;
            for (at, step) in transform.steps.iter().enumerate() {
                fine &= c.at(Step::Index(at), |c| c.step(step));
            }
            if !fine {
                return outer;
            }
            let all = Around { map: outer.map * transform.to_affine(), ..outer };
            if all.is_usable() {
                return all;
            }
            c.problem_with_help(
                "these steps, with those of the groups around, flatten, stretch or move too much",
                format!("together they may change no length by more than {LARGEST_FACTOR:e}"),
            );
            outer
        })
    }

    fn step(&mut self, step: &TransformStep) -> bool {
        match *step {
            TransformStep::Translate(by) => self.point("translate", by),
            TransformStep::Scale(by) => self.field("scale", |c| c.scale(by)),
            TransformStep::Rotate { axis, degrees } => self.field("rotate", |c| {
                c.direction("axis", axis)
                    & c.require(degrees.abs() <= 1e6, "angle", "the angle must be at most 1e6 degrees")
            }),
            TransformStep::Matrix(rows) => self.field("matrix", |c| {
                let finite = rows.iter().flatten().all(|x| x.abs() <= LARGEST);
                if !finite {
                    return c.problem(format!("the numbers of a matrix must be at most {LARGEST:e} in size"));
                }
                changes_lengths_by(step.to_affine().matrix3, 1.0, 1.0)
                    || c.problem_with_help(
                        "this matrix cannot be reversed",
                        "its first three columns must point in different directions",
                    )
            }),
        }
    }

    fn scale(&mut self, by: DVec3) -> bool {
        if !by.is_finite() {
            return self.problem("scale must be finite");
        }
        if by.abs().min_element() == 0.0 {
            return self
                .problem_with_help("scale must not be 0: it would flatten things", "a small factor such as 0.001 can");
        }
        let fine = by.abs().max_element() <= LARGEST_FACTOR && by.abs().min_element() >= 1.0 / LARGEST_FACTOR;
        fine || self.problem(format!("scale must be between {:e} and {LARGEST_FACTOR:e}", 1.0 / LARGEST_FACTOR))
    }
}

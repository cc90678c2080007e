//! Which media a ray is inside: one of them decides how light bends and what it loses, the innermost of those of the highest
//! priority.
//!
//! Priorities let things overlap that touch in truth, such as a glass and the wine in it (Schmidt and Budge, "Simple Nested
//! Dielectrics in Ray Traced Images", 2002): the glass goes a little into the wine and, of the higher priority, hides what of
//! the wine's surface is in it. Media may overlap and nest. The one entered last is the innermost; leaving one that is not innermost changes nothing
//! for the ray until the others are left, too.

use crate::compile::CompiledScene;
use crate::materials::Material;
use durer_geometry::{Primitive, Ray};
use durer_math::Rgb;

/// The media around a point on a ray's path, outermost first, as primitives' indices.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Media {
    inside: Vec<u32>,
}

/// What [`Media::cross`] changed, so that it can be undone.
#[derive(Clone, Copy, Debug)]
#[must_use]
pub(crate) enum Undo {
    Nothing,
    Pop,
    Insert { at: usize, primitive: u32 },
}

impl Media {
    /// The media around a ray's origin, nested by where the ray leaves them: what is left last is outermost.
    pub(crate) fn around(scene: &CompiledScene, ray: &Ray) -> Media {
        let primitives = scene.world.primitives();
        let mut exits: Vec<(f64, u32)> = Vec::new();
        for &id in &scene.media_at_eye {
            let primitive = &primitives[id as usize];
            if primitive.contains(ray.origin) {
                exits.extend(exits_from(primitive, ray).into_iter().map(|exit| (exit, id)));
            }
        }
        exits.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        Media { inside: exits.into_iter().map(|(_, id)| id).collect() }
    }

    /// Enters or leaves a primitive.
    pub(crate) fn cross(&mut self, primitive: u32, entering: bool) -> Undo {
        if entering {
            self.inside.push(primitive);
            return Undo::Pop;
        }
        match self.inside.iter().rposition(|&id| id == primitive) {
            Some(at) => Undo::Insert { at, primitive: self.inside.remove(at) },
            None => Undo::Nothing,
        }
    }

    /// Goes back to before a crossing; crossings must be undone in reverse order.
    pub(crate) fn undo(&mut self, undo: Undo) {
        match undo {
            Undo::Nothing => {}
            Undo::Pop => {
                self.inside.pop();
            }
            Undo::Insert { at, primitive } => self.inside.insert(at, primitive),
        }
    }

    /// True in empty space.
    pub(crate) fn is_empty(&self) -> bool {
        self.inside.is_empty()
    }

    /// The medium that decides here: of those of the highest priority the innermost.
    pub(crate) fn ruling(&self, scene: &CompiledScene) -> Option<u32> {
        self.highest(scene, |_| true)
    }

    /// The index of refraction here: that of the ruling medium among those that have one, 1 outside of all.
    pub(crate) fn ior(&self, scene: &CompiledScene) -> f64 {
        let ruling = self.highest(scene, |material| material.ior.is_some());
        ruling.and_then(|id| scene.material(id).ior).unwrap_or(1.0)
    }

    /// What is left of light after a length of the ruling medium.
    pub(crate) fn transmittance(&self, scene: &CompiledScene, length: f64) -> Rgb {
        match self.ruling(scene) {
            Some(id) => scene.material(id).transmittance(length),
            None => Rgb::WHITE,
        }
    }

    /// The innermost of those of the highest priority among these.
    #[inline]
    fn highest(&self, scene: &CompiledScene, counts: impl Fn(&Material) -> bool) -> Option<u32> {
        let mut best: Option<(i32, u32)> = None;
        for &id in &self.inside {
            let material = scene.material(id);
            if counts(material) && best.is_none_or(|(priority, _)| material.priority >= priority) {
                best = Some((material.priority, id));
            }
        }
        best.map(|(_, id)| id)
    }
}

/// Where a ray that starts inside of a primitive leaves it: at several places if it is a set of things that overlap and
/// the ray starts inside of several of them.
fn exits_from(primitive: &Primitive, ray: &Ray) -> Vec<f64> {
    let (mut exits, mut entered, mut length) = (Vec::new(), 0, 0.0);
    let _ = primitive.each_crossing(ray, f64::INFINITY, |ray, crossing, surface| {
        length += crossing.t;
        if ray.direction.dot(surface.normal) < 0.0 {
            entered += 1;
        } else if entered > 0 {
            entered -= 1;
        } else {
            exits.push(length);
        }
        false
    });
    // Half of space is never left by a ray that goes on into it.
    if exits.is_empty() { vec![f64::INFINITY] } else { exits }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn overlapping_media_are_left_in_any_order_and_undone_in_reverse() {
        let mut media = Media::default();
        let undo = [media.cross(1, true), media.cross(2, true), media.cross(1, false), media.cross(7, false)];
        assert_eq!(media.inside, [2]);
        for step in undo.into_iter().rev() {
            media.undo(step);
        }
        assert_eq!(media, Media::default());
    }
}

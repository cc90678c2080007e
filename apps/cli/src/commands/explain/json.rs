//! The explanation for programs: everything, with all digits.

use super::{Explained, words};
use crate::labels;
use durer::math::{DVec3, Rgb};
use durer::{
    ArrivalExplanation, Contribution, HitExplanation, HoleExplanation, JunctionExplanation, LightExplanation,
    RayExplanation, ReuseExplanation, SampleExplanation, Scattering, Turn, Way, Weighing,
};
use serde_json::{Value, json};

impl Explained<'_> {
    /// The whole explanation.
    pub(super) fn json(&self) -> Value {
        let picture = self.scene.picture;
        json!({
            "pixel": [self.pixel.x, self.pixel.y],
            "picture": [picture.width, picture.height],
            "color": rgb(self.pixel.color),
            "sum": rgb(self.sum()),
            "stored": self.stored(),
            "samples": self.pixel.samples.iter().map(|sample| self.sample_json(sample)).collect::<Vec<_>>(),
        })
    }

    fn sample_json(&self, sample: &SampleExplanation) -> Value {
        json!({
            "at": [sample.at.x, sample.at.y],
            "weight": sample.weight,
            "color": rgb(sample.color),
            "ray": self.ray_json(&sample.ray),
        })
    }

    fn ray_json(&self, ray: &RayExplanation) -> Value {
        let not_traced = ray.not_traced.iter().map(|(kind, weight, why)| {
            json!({ "kind": words::ray_key(*kind), "weight": rgb(*weight), "why": words::why_not_key(*why) })
        });
        json!({
            "kind": words::ray_key(ray.kind),
            "depth": ray.depth,
            "origin": xyz(ray.origin),
            "direction": xyz(ray.direction),
            "weight": rgb(ray.weight),
            "relative_to": words::relative_to_key(ray.relative_to),
            "way": ray.way.map(way),
            "holes": ray.holes.iter().map(|hole| self.hole_json(hole)).collect::<Vec<_>>(),
            "hit": ray.hit.as_ref().map(|hit| self.hit_json(hit)),
            "lights": ray.lights.iter().map(|light| self.light_json(light)).collect::<Vec<_>>(),
            "scattering": ray.turns.iter().map(turn).collect::<Vec<_>>(),
            "junction": ray.junction.as_ref().map(junction),
            "reuse": ray.reuse.as_ref().map(reuse),
            "contributions": ray.contributions.iter().map(contribution).collect::<Vec<_>>(),
            "brought": ray.brought.iter().map(contribution).collect::<Vec<_>>(),
            "not_traced": not_traced.collect::<Vec<_>>(),
            "children": ray.children.iter().map(|child| self.ray_json(child)).collect::<Vec<_>>(),
        })
    }

    fn hit_json(&self, hit: &HitExplanation) -> Value {
        let label = self.shapes.label(hit.shape);
        let label = label.as_ref();
        json!({
            "shape": hit.shape,
            "kind": label.map(|label| label.kind),
            "name": label.and_then(|label| label.name),
            "place": label.map(|label| label.place.as_str()),
            "element": words::element_json(hit.element),
            "material": hit.material.map(|id| id.0),
            "distance": hit.distance,
            "point": xyz(hit.point),
            "normal": xyz(hit.normal),
            "shading_normal": xyz(hit.shading_normal),
            "from_outside": hit.from_outside,
            "color": rgb(hit.color),
            "opacity": rgb(hit.opacity),
        })
    }

    fn hole_json(&self, hole: &HoleExplanation) -> Value {
        json!({
            "shape": hole.shape,
            "place": self.shapes.label(hole.shape).map(|label| label.place),
            "element": words::element_json(hole.element),
            "distance": hole.distance,
        })
    }

    /// `distance` is null both where the light does not shine and where it is infinitely far away; `shines` tells.
    fn light_json(&self, light: &LightExplanation) -> Value {
        json!({
            "light": light.light,
            "label": labels::light(self.scene, light.light),
            "shines": light.distance.is_some(),
            "distance": light.distance,
            "cosine": light.cosine,
            "visibility": rgb(light.visibility),
        })
    }
}

fn contribution(contribution: &Contribution) -> Value {
    json!({
        "source": words::source_key(contribution.source),
        "light": words::light_of(contribution.source),
        "amount": rgb(contribution.amount),
        "weighing": contribution.weighing.map(weighing),
    })
}

fn weighing(Weighing { by_surface, by_aiming, part }: Weighing) -> Value {
    json!({ "pdf_surface": by_surface, "pdf_light": by_aiming, "mis_weight": part })
}

fn turn(turn: &Turn) -> Value {
    let Scattering { direction, pdf, weight, survival } = turn.scattering;
    json!({
        "way": turn.way.map(way),
        "direction": xyz(direction),
        "pdf": pdf,
        "weight": rgb(weight),
        "survival": survival,
    })
}

fn way(Way { number, of }: Way) -> Value {
    json!({ "number": number, "of": of })
}

/// `arriving` is null where no light was looked for.
fn junction(junction: &JunctionExplanation) -> Value {
    let arrival = |arrival: &ArrivalExplanation| {
        json!({
            "source": arrival.source.map_or("ray", words::source_key),
            "light": arrival.source.and_then(words::light_of),
            "direction": xyz(arrival.direction),
            "radiance_over_pdf": rgb(arrival.light),
            "weighing": arrival.weighing.map(weighing),
        })
    };
    let arriving = match junction {
        JunctionExplanation::Found(arrivals) => Some(arrivals.iter().map(arrival).collect::<Vec<_>>()),
        JunctionExplanation::Left => None,
    };
    json!({ "arriving": arriving })
}

/// Samples are counted from 1, as `--sample` has it. Densities are by area.
fn reuse(reuse: &ReuseExplanation) -> Value {
    let (x, y) = reuse.pixel;
    json!({
        "found_by": { "pixel": [x, y], "sample": reuse.sample + 1 },
        "radiance": rgb(reuse.light),
        "sharing": reuse.sharing.map(|sharing| {
            json!({
                "pdf": sharing.density,
                "pdf_sum": sharing.sum,
                "views": sharing.views,
                "mis_weight": sharing.part,
            })
        }),
    })
}

fn rgb(color: Rgb) -> [f32; 3] {
    color.to_array()
}

fn xyz(v: DVec3) -> [f64; 3] {
    [v.x, v.y, v.z]
}

//! The explanation for people: a tree of rays at the left, an account of light at the right.

use super::Explained;
use super::ledger::Ledger;
use super::words;
use crate::labels;
use crate::numbers::{color, count, short, vector};
use durer::imaging::Transfer;
use durer::math::Rgb;
use durer::{
    ArrivalExplanation, Contribution, HitExplanation, JunctionExplanation, LightExplanation, NotTraced, RayExplanation,
    RayKind, RelativeTo, ReuseExplanation, SampleExplanation, Scattering, Sharing, Turn, Weighing,
};

/// More samples than this are only listed.
const MOST_IN_FULL: usize = 4;

impl Explained<'_> {
    /// The whole explanation.
    pub(super) fn text(&self) -> String {
        let mut page = Ledger::default();
        self.heading(&mut page);
        let is_long = self.only.is_none() && self.pixel.is_mean && self.pixel.samples.len() > MOST_IN_FULL;
        if is_long {
            page.gap();
            page.heading("its samples; `--sample 1` shows the path of the first");
        }
        for (index, sample) in self.pixel.samples.iter().enumerate() {
            if is_long {
                let place = format!("sample {} at ({}, {})", index + 1, short(sample.at.x), short(sample.at.y));
                page.amount(&place, sample.color);
            } else if self.only.is_none_or(|only| only == index + 1) {
                self.sample(&mut page, index, sample);
            }
        }
        self.account(&mut page);
        page.into_text()
    }

    fn heading(&self, page: &mut Ledger) {
        let picture = self.scene.picture;
        let samples = &self.pixel.samples;
        let kept = samples.iter().filter(|sample| sample.weight.is_some()).count();
        let thrown = match samples.len() - kept {
            0 => String::new(),
            thrown => format!(", {thrown} of them not counted"),
        };
        page.line(&format!(
            "{}: pixel {},{} of {} × {}, {}{thrown}",
            self.file,
            self.pixel.x,
            self.pixel.y,
            picture.width,
            picture.height,
            count(samples.len(), "sample"),
        ));
    }

    fn sample(&self, page: &mut Ledger, index: usize, sample: &SampleExplanation) {
        let place = format!("sample {} at ({}, {})", index + 1, short(sample.at.x), short(sample.at.y));
        let Some(weight) = sample.weight else {
            page.line(&format!("{place}, not counted; its color was {}", three(sample.color)));
            return;
        };
        page.gap();
        page.heading(&format!("{place}, which counts {}", short(f64::from(weight))));
        self.ray(page, &sample.ray);
        page.rule();
        page.amount(&format!("color of sample {}", index + 1), sample.color);
        if sample.color != sample.ray.sum(Rgb::BLACK) {
            page.line("(a color that is not finite is left out)");
        }
        if weight != 1.0 {
            page.amount(&format!("  × {}", short(f64::from(weight))), sample.color * weight);
        }
    }

    /// A ray whose heading stands already at the place of the branch.
    fn ray(&self, page: &mut Ledger, ray: &RayExplanation) {
        let weight = match ray.kind {
            RayKind::Eye => String::new(),
            RayKind::Reflected | RayKind::Transmitted | RayKind::Connected | RayKind::Cast => {
                let over = if ray.kind == RayKind::Cast { " before the density" } else { "" };
                format!(", weight {}{over}{}", color(ray.weight), words::relative_to(ray.relative_to))
            }
        };
        let way = ray.way.map_or_else(String::new, |way| format!(", {}", words::way(way)));
        page.line(&format!("{}{way}, depth {}{weight}", words::ray(ray.kind), ray.depth));
        let ends = ray.children.is_empty() && ray.not_traced.is_empty();
        page.within(if ends { "   " } else { "│  " }, |page| self.of_ray(page, ray));
        self.branches(page, ray);
    }

    /// What the ray itself met and brought.
    fn of_ray(&self, page: &mut Ledger, ray: &RayExplanation) {
        page.line(&format!("from {} towards {}", vector(ray.origin), vector(ray.direction)));
        for hole in &ray.holes {
            let (shape, element) = (self.shape(hole.shape), words::element(hole.element));
            page.line(&format!("goes through a hole of {shape}{element} after {}", short(hole.distance)));
        }
        match &ray.hit {
            Some(hit) => self.hit(page, hit),
            None => page.line("hits nothing"),
        }
        if let Some(reuse) = &ray.reuse {
            self.reuse(page, reuse);
        }
        for contribution in amounts_of(ray).filter(|c| words::light_of(c.source).is_none()) {
            let source = match ray.reuse.and_then(|reuse| reuse.sharing) {
                Some(Sharing { part, .. }) => counting(words::source(contribution.source), part),
                None => with_weighing(words::source(contribution.source), contribution.weighing),
            };
            amount(page, &source, (contribution.amount, ray.relative_to));
        }
        if let Some(junction) = &ray.junction {
            page.line(words::junction(junction));
        }
        for arrival in arrivals_of(ray).filter(|a| a.source.and_then(words::light_of).is_none()) {
            arrives(page, arrival);
        }
        ray.lights.iter().for_each(|light| self.of_light(page, ray, light));
        ray.turns.iter().for_each(|turn| goes_on(page, turn));
    }

    /// What a ray took from a junction.
    fn reuse(&self, page: &mut Ledger, reuse: &ReuseExplanation) {
        let ((x, y), sample) = (reuse.pixel, reuse.sample + 1);
        let who = match reuse.pixel == (self.pixel.x, self.pixel.y) {
            true => "this sample".to_owned(),
            false => format!("sample {sample} of pixel {x},{y}"),
        };
        let alone = if reuse.sharing.is_none() { ", which alone takes light from it" } else { "" };
        page.line(&format!("found by {who}{alone}; it sends {} here", three(reuse.light)));
        if let Some(Sharing { density, sum, views, .. }) = reuse.sharing {
            let (density, sum, pixels) = (short(density), short(sum), count(views, "pixel"));
            page.line(&format!("densities by area: from here {density}, from all {pixels} that see it {sum}"));
        }
    }

    /// What a ray sees of a light, and has from it.
    fn of_light(&self, page: &mut Ledger, ray: &RayExplanation, light: &LightExplanation) {
        page.line(&self.light(light));
        for contribution in amounts_of(ray).filter(|c| words::light_of(c.source) == Some(light.light)) {
            let source = format!("  {}", words::source(contribution.source));
            let source = with_weighing(&source, contribution.weighing);
            amount(page, &source, (contribution.amount, ray.relative_to));
        }
        let from_it = arrivals_of(ray).filter(|a| a.source.and_then(words::light_of) == Some(light.light));
        from_it.for_each(|arrival| page.within("  ", |page| arrives(page, arrival)));
    }

    fn hit(&self, page: &mut Ledger, hit: &HitExplanation) {
        let side = if hit.from_outside { "outside" } else { "inside" };
        let (shape, distance) = (self.shape(hit.shape), short(hit.distance));
        page.line(&format!("hits {shape} after {distance}, on its {side}{}", words::element(hit.element)));
        page.line(&format!("at {}, normal {}, color {}", vector(hit.point), vector(hit.normal), three(hit.color)));
        let mut rest = self.material(hit.material);
        if hit.shading_normal != hit.normal && hit.shading_normal != -hit.normal {
            rest += &format!(", shaded with normal {}", vector(hit.shading_normal));
        }
        if hit.opacity != Rgb::WHITE {
            rest += &format!(", opacity {}", color(hit.opacity));
        }
        page.line(&rest);
    }

    fn light(&self, light: &LightExplanation) -> String {
        let name = labels::light(self.scene, light.light);
        let Some(distance) = light.distance else { return format!("{name}: does not shine here") };
        if light.cosine <= 0.0 {
            return format!("{name}: behind the surface");
        }
        let away = if distance.is_finite() { format!(", {} away", short(distance)) } else { String::new() };
        let through = match light.visibility {
            v if v == Rgb::WHITE => "nothing in the way".to_owned(),
            v if v.is_black() => "in shadow".to_owned(),
            v => format!("{} gets through", color(v)),
        };
        format!("{name}: {through}{away}, cosine {}", short(light.cosine))
    }

    /// The rays that start where this one ended, and those that would have.
    fn branches(&self, page: &mut Ledger, ray: &RayExplanation) {
        let mut left = ray.children.len() + ray.not_traced.len();
        for child in &ray.children {
            left -= 1;
            page.fork(left == 0, |page| self.ray(page, child));
        }
        for (kind, weight, why) in &ray.not_traced {
            left -= 1;
            let weight = format!("{}{}", color(*weight), words::relative_to(ray.relative_to));
            page.fork(left == 0, |page| page.line(&not_traced(*kind, &weight, *why)));
        }
    }

    /// The sum, and what becomes of it.
    fn account(&self, page: &mut Ledger) {
        page.gap();
        if self.pixel.samples.len() > 1 {
            let what = if self.pixel.is_mean {
                "the mean of all samples"
            } else {
                "sum of all samples, each times what it counts"
            };
            page.amount(what, self.sum());
        }
        page.amount("the pixel as rendered, in linear light", self.pixel.color);
        page.line(match self.sum_is_exact() {
            true => "The two are equal to the last bit.",
            false => "The sum differs from the pixel as rendered. This is a defect of durer: please report it.",
        });
        if let Some([r, g, b]) = self.stored() {
            let transfer = match self.scene.picture.transfer {
                Transfer::Srgb => "sRGB",
                Transfer::Linear => "linear",
            };
            page.line(&format!("In a PNG of 8 bits ({transfer}): {r} {g} {b}, that is #{r:02x}{g:02x}{b:02x}."));
        }
    }
}

/// What a ray added to the sample, or brought to a junction: never both.
fn amounts_of(ray: &RayExplanation) -> impl Iterator<Item = &Contribution> {
    ray.contributions.iter().chain(&ray.brought)
}

/// What arrives at the surface that a ray met, if it is a junction.
fn arrivals_of(ray: &RayExplanation) -> impl Iterator<Item = &ArrivalExplanation> {
    let arrivals = match &ray.junction {
        Some(JunctionExplanation::Found(arrivals)) => arrivals.as_slice(),
        Some(JunctionExplanation::Left) | None => &[],
    };
    arrivals.iter()
}

/// An amount of light: at the right, if it is one of those that add up to the sample.
fn amount(page: &mut Ledger, source: &str, (amount, relative_to): (Rgb, RelativeTo)) {
    match relative_to {
        RelativeTo::Sample => page.amount(source, amount),
        RelativeTo::Junction => {
            page.line(source);
            page.line(&format!("  brings the junction {}", three(amount)));
        }
    }
}

fn arrives(page: &mut Ledger, arrival: &ArrivalExplanation) {
    let source = arrival.source.map_or("light of the rays from here", words::source);
    page.line(&with_weighing(source, arrival.weighing));
    let (light, direction) = (three(arrival.light), vector(arrival.direction));
    page.line(&format!("  arrives from {direction}: {light}, radiance over density"));
}

fn goes_on(page: &mut Ledger, turn: &Turn) {
    let Scattering { direction, pdf, weight, survival } = turn.scattering;
    let way = turn.way.map_or_else(String::new, |way| format!("{}: ", words::way(way)));
    let density = pdf.map_or_else(|| "the only direction".to_owned(), |pdf| format!("density {}", short(pdf)));
    let chance = match survival {
        1.0 => String::new(),
        survival => format!(", with a chance of {}", short(f64::from(survival))),
    };
    page.line(&format!("{way}goes on towards {}, {density}, × {}{chance}", vector(direction), color(weight)));
}

/// A source, and what it counts if light can be found in two ways.
fn with_weighing(source: &str, weighing: Option<Weighing>) -> String {
    match weighing {
        None => source.to_owned(),
        Some(Weighing { by_surface, by_aiming, part }) => {
            let (surface, light) = (short(by_surface), short(by_aiming));
            counting(source, part) + &format!(" (densities: surface {surface}, light {light})")
        }
    }
}

/// A source, and what it counts beside other ways to find it.
fn counting(source: &str, part: f64) -> String {
    format!("{source}, of which this way counts {}", short(part))
}

/// Always three numbers, where one alone could be taken for something else.
fn three(color: Rgb) -> String {
    color.to_array().map(|v| short(f64::from(v))).join(" ")
}

fn not_traced(kind: RayKind, weight: &str, why: NotTraced) -> String {
    format!("{}, weight {weight}: not traced, {}", words::ray(kind), words::why_not(why))
}

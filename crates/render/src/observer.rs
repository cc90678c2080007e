//! Who watches rays being traced: nobody, a counter, or `explain`.
//!
//! The integrator tells an observer what it does; it is one program whoever watches, so what `explain` shows is what
//! `render` did. For an observer that ignores an event the compiler removes the call.

use durer_geometry::{Hit, Ray, Surface};
use durer_math::{DVec3, Rgb};

/// Why a ray is traced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RayKind {
    /// From the eye.
    Eye,
    /// From a mirror.
    Reflected,
    /// Through a clear surface, straight or bent.
    Transmitted,
    /// To a junction: a surface that a path has met, from which all pixels of its block that see it take light.
    Connected,
    /// Of a path: to a ball or cylinder by way of which it finds light of the sky. Its weight, and that of what follows it, is not yet
    /// divided by the density with which it was found.
    Cast,
}

/// Where a contribution to a pixel comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// The fog along a ray.
    Fog,
    /// The background.
    Background,
    /// What a surface gives off by itself.
    Emission,
    /// Ambient light given back by a surface.
    Ambient,
    /// The light with this index, given back in all directions.
    Diffuse(usize),
    /// The highlight of the light with this index.
    Specular(usize),
    /// An emitter that was aimed at: the light with this index, or a shape or the background.
    Light(Option<usize>),
    /// Light that leaves a junction, by whichever way it came there.
    Reused,
    /// What an integrator that computes no light shows of a surface: its normal, how far away it is …
    Shown,
}

impl Source {
    /// True if light of this kind, found at the end of a path's segment of this depth, met one surface at most on its way.
    pub(crate) fn is_direct(self, depth: u32) -> bool {
        // The segment of depth 2 comes from the first surface: what gives light by itself at its end met that one alone.
        let deepest = match self {
            Source::Emission | Source::Background => 2,
            Source::Fog
            | Source::Ambient
            | Source::Diffuse(_)
            | Source::Specular(_)
            | Source::Light(_)
            | Source::Shown => 1,
            Source::Reused => 0,
        };
        depth <= deepest
    }
}

/// Why a ray that a surface asks for was not traced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NotTraced {
    /// The chain of rays is as long as it may be.
    TooDeep,
    /// Its weight in the pixel is below the cut-off.
    TooFaint,
}

/// Of a path: light that two ways find, by aiming at an emitter and by going where the surface scatters to, and what that
/// found by one of them counts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weighing {
    /// Density of the direction by the surface, per solid angle, times the number of ways into which the sample is split there;
    /// infinite if it is the only one.
    pub by_surface: f64,
    /// Density of the direction by aiming at emitters, per solid angle; infinite for lights that are points.
    pub by_aiming: f64,
    /// What it counts, from 0 to 1.
    pub part: f64,
}

/// Of a path: how it goes on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scattering {
    /// Where to; unit length.
    pub direction: DVec3,
    /// Density of that direction, per solid angle; `None` if it is the only one.
    pub pdf: Option<f64>,
    /// What light from there counts, of that which leaves the surface.
    pub weight: Rgb,
    /// The chance with which the path goes on at all.
    pub survival: f32,
}

/// Of a sample that is split: one of the ways by which it goes on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Way {
    /// From 1.
    pub number: u32,
    /// How many there are.
    pub of: u32,
}

/// Of light that several pixels take from a junction: what it counts for one of them. The balance heuristic, by which the parts of
/// all add up to one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sharing {
    /// With which paths from here find the junction, per area.
    pub density: f64,
    /// The same of all that see it, added up.
    pub sum: f64,
    /// How many these are.
    pub views: usize,
    /// What it counts here, from 0 to 1: density / sum.
    pub part: f64,
}

/// What shading found out about a hit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SurfaceSeen {
    pub(crate) hit: Hit,
    /// From where the ray began to the hit.
    pub(crate) length: f64,
    pub(crate) surface: Surface,
    /// The normal of shading, on the side that the ray came from.
    pub(crate) normal: DVec3,
    /// The colour there.
    pub(crate) color: Rgb,
    /// How much of the surface is there; `None` if all of it.
    pub(crate) opacity: Option<Rgb>,
    /// True if the ray came from the side that the normal points to.
    pub(crate) from_outside: bool,
}

/// What was found out about a light at a hit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LightSeen {
    pub(crate) index: usize,
    /// `None` where it does not shine (outside of a spot's cone).
    pub(crate) distance: Option<f64>,
    /// Between the normal and the direction to the light; not positive if the light is behind the surface.
    pub(crate) cosine: f64,
    /// What gets through to the point.
    pub(crate) visibility: Rgb,
}

/// Light that arrives at a junction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ArrivalSeen {
    /// What was aimed at; `None` if it came along the ray that goes on from there.
    pub(crate) source: Option<Source>,
    /// Where it comes from; unit length.
    pub(crate) direction: DVec3,
    /// Radiance over the density of the direction, as far as it counts.
    pub(crate) light: Rgb,
}

/// Light that is taken from a junction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ReuseSeen {
    /// Whose path has met it: a number among the samples that are taken together.
    pub(crate) found_by: usize,
    /// What leaves it to where it is taken.
    pub(crate) light: Rgb,
    /// `None` if only the path that has met it takes light from there.
    pub(crate) sharing: Option<Sharing>,
}

/// Told what an integrator does. Rays nest: between `ray_begins` and `ray_ends` of one come those of its children.
pub(crate) trait Observer {
    fn ray_begins(&mut self, _kind: RayKind, _depth: u32, _ray: &Ray, _weight: Rgb) {}
    /// The ray passes a hole of a surface, so far from where it began.
    fn hole(&mut self, _hit: &Hit, _surface: &Surface, _length: f64) {}
    fn surface(&mut self, _seen: &SurfaceSeen) {}
    fn light(&mut self, _seen: &LightSeen) {}
    fn shadow_ray(&mut self) {}
    /// An amount added to the pixel, weights included. The pixel is the sum of these, in this order.
    fn contribution(&mut self, _source: Source, _amount: Rgb) {}
    /// Of the contribution that comes next.
    fn weighing(&mut self, _weighing: &Weighing) {}
    fn scattering(&mut self, _scattering: &Scattering) {}
    /// What comes next of the surface that the last ray met is that of one of the ways into which the sample is split there.
    fn way_begins(&mut self, _way: Way) {}
    /// What the last ray met is a junction: light is looked for there that all who see it may take.
    fn junction(&mut self) {}
    /// What the last ray met could be a junction, but only the first way of a split sample makes some: this one ends.
    fn junction_left(&mut self) {}
    /// Rays that begin from now on until light [arrives](Observer::arrives) bring it to the junction, and have weights relative to
    /// that.
    fn arriving_begins(&mut self) {}
    /// An amount that such a ray brings, and that is not added to the pixel: others may take it, too.
    fn brings(&mut self, _source: Source, _amount: Rgb) {}
    /// Light arrives at the junction that the last ray met.
    fn arrives(&mut self, _arrival: &ArrivalSeen) {}
    /// Of the contribution that comes next.
    fn reuse(&mut self, _reuse: &ReuseSeen) {}
    fn not_traced(&mut self, _kind: RayKind, _weight: Rgb, _why: NotTraced) {}
    fn ray_ends(&mut self) {}
}

/// Somebody or nobody.
impl<O: Observer> Observer for Option<O> {
    fn ray_begins(&mut self, kind: RayKind, depth: u32, ray: &Ray, weight: Rgb) {
        self.iter_mut().for_each(|observer| observer.ray_begins(kind, depth, ray, weight));
    }

    fn hole(&mut self, hit: &Hit, surface: &Surface, length: f64) {
        self.iter_mut().for_each(|observer| observer.hole(hit, surface, length));
    }

    fn surface(&mut self, seen: &SurfaceSeen) {
        self.iter_mut().for_each(|observer| observer.surface(seen));
    }

    fn light(&mut self, seen: &LightSeen) {
        self.iter_mut().for_each(|observer| observer.light(seen));
    }

    fn shadow_ray(&mut self) {
        self.iter_mut().for_each(Observer::shadow_ray);
    }

    fn contribution(&mut self, source: Source, amount: Rgb) {
        self.iter_mut().for_each(|observer| observer.contribution(source, amount));
    }

    fn weighing(&mut self, weighing: &Weighing) {
        self.iter_mut().for_each(|observer| observer.weighing(weighing));
    }

    fn scattering(&mut self, scattering: &Scattering) {
        self.iter_mut().for_each(|observer| observer.scattering(scattering));
    }

    fn way_begins(&mut self, way: Way) {
        self.iter_mut().for_each(|observer| observer.way_begins(way));
    }

    fn junction(&mut self) {
        self.iter_mut().for_each(Observer::junction);
    }

    fn junction_left(&mut self) {
        self.iter_mut().for_each(Observer::junction_left);
    }

    fn arriving_begins(&mut self) {
        self.iter_mut().for_each(Observer::arriving_begins);
    }

    fn brings(&mut self, source: Source, amount: Rgb) {
        self.iter_mut().for_each(|observer| observer.brings(source, amount));
    }

    fn arrives(&mut self, arrival: &ArrivalSeen) {
        self.iter_mut().for_each(|observer| observer.arrives(arrival));
    }

    fn reuse(&mut self, reuse: &ReuseSeen) {
        self.iter_mut().for_each(|observer| observer.reuse(reuse));
    }

    fn not_traced(&mut self, kind: RayKind, weight: Rgb, why: NotTraced) {
        self.iter_mut().for_each(|observer| observer.not_traced(kind, weight, why));
    }

    fn ray_ends(&mut self) {
        self.iter_mut().for_each(Observer::ray_ends);
    }
}

/// How many rays were traced, by kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RayCounts {
    /// From the eye.
    pub eye: u64,
    /// From mirrors.
    pub reflected: u64,
    /// Through clear surfaces.
    pub transmitted: u64,
    /// Towards lights.
    pub shadow: u64,
    /// Not traced, and black, because the chain of rays was as long as it may be.
    pub cut_off: u64,
}

impl RayCounts {
    /// Rays of all kinds that were traced.
    pub fn total(&self) -> u64 {
        [self.reflected, self.transmitted, self.shadow].iter().fold(self.eye, |sum, &rays| sum.saturating_add(rays))
    }

    /// Adds other counts to these.
    pub fn add(&mut self, other: &RayCounts) {
        self.eye = self.eye.saturating_add(other.eye);
        self.reflected = self.reflected.saturating_add(other.reflected);
        self.transmitted = self.transmitted.saturating_add(other.transmitted);
        self.shadow = self.shadow.saturating_add(other.shadow);
        self.cut_off = self.cut_off.saturating_add(other.cut_off);
    }
}

impl Observer for RayCounts {
    fn ray_begins(&mut self, kind: RayKind, _depth: u32, _ray: &Ray, _weight: Rgb) {
        match kind {
            RayKind::Eye => self.eye += 1,
            RayKind::Reflected => self.reflected += 1,
            RayKind::Transmitted => self.transmitted += 1,
            // It looks for light.
            RayKind::Cast => self.shadow += 1,
            // It is a shadow ray that has got through.
            RayKind::Connected => {}
        }
    }

    fn shadow_ray(&mut self) {
        self.shadow += 1;
    }

    fn not_traced(&mut self, _kind: RayKind, _weight: Rgb, why: NotTraced) {
        self.cut_off += u64::from(why == NotTraced::TooDeep);
    }
}

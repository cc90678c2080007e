//! The scenes of the comparison in durer's kernel.

use durer_bench_kernel::measure::{self, Found, Kernel};
use durer_bench_kernel::meshes;
use durer_bench_kernel::print::Lines;
use durer_bench_kernel::rays::Ray;
use durer_bench_kernel::scene::{Scene, Things};
use durer_geometry::{BuildFor, LANES, Mesh, MeshSource, Packet, Particles, Primitive, World};
use durer_math::{DAffine3, DVec3};
use std::sync::Arc;

/// All rays go to all things.
const ALL: u32 = u32::MAX;

/// The lists of a mesh, as durer asks for them.
#[derive(Debug)]
pub(crate) struct Lists(pub(crate) meshes::Mesh);

impl MeshSource for Lists {
    fn positions(&self) -> &[[f32; 3]] {
        &self.0.positions
    }

    fn triangles(&self) -> &[[u32; 3]] {
        &self.0.triangles
    }

    fn normals(&self) -> &[[f32; 3]] {
        &[]
    }

    fn uvs(&self) -> &[[f32; 2]] {
        &[]
    }

    fn enclosed_volume(&self) -> Option<f64> {
        None
    }
}

/// Builds a scene and measures it.
pub(crate) fn measure(scene: &Scene, repeats: usize, purpose: &str) -> Result<(), String> {
    let lines = Lines { program: "durer", variant: purpose, scene: &scene.name };
    let purpose = match purpose {
        "preview" => BuildFor::Preview,
        "picture" => BuildFor::Picture,
        "many-rays" => BuildFor::ManyRays,
        _ => return Err(format!("there is no purpose `{purpose}`")),
    };
    lines.scene(scene.count(), &scene.hashes());
    let kernel = match &scene.things {
        Things::Triangles(mesh) => mesh_kernel(lines, mesh, repeats, purpose),
        Things::Spheres(spheres) => sphere_kernel(lines, spheres, repeats, purpose),
    };
    measure::all(lines, scene, &kernel, repeats);
    Ok(())
}

fn mesh_kernel(lines: Lines<'_>, mesh: &meshes::Mesh, repeats: usize, purpose: BuildFor) -> Built {
    let lists = Arc::new(Lists(mesh.clone()));
    let source = || Arc::clone(&lists) as Arc<dyn MeshSource>;
    let (seconds, built) = measure::build(repeats, || Mesh::build(source(), purpose));
    let list_bytes = size_of_val(mesh.positions.as_slice()) + size_of_val(mesh.triangles.as_slice());
    lines.build(seconds, built.memory(), list_bytes);
    let primitive = Primitive::mesh(Arc::new(built), DVec3::ZERO, &DAffine3::IDENTITY);
    Built { world: World::build(vec![primitive], purpose), particles: None }
}

fn sphere_kernel(lines: Lines<'_>, spheres: &[[f32; 4]], repeats: usize, purpose: BuildFor) -> Built {
    let sphere = |index: usize| {
        let [x, y, z, radius] = spheres[index].map(f64::from);
        (DVec3::new(x, y, z), radius)
    };
    let (seconds, built) = measure::build(repeats, || Particles::spheres(spheres.len(), purpose, sphere));
    // What it has is in its own blocks: it needs no list beside them.
    lines.build(seconds, built.memory(), 0);
    let built = Arc::new(built);
    let primitive = Primitive::particles(Arc::clone(&built), &DAffine3::IDENTITY);
    Built { world: World::build(vec![primitive], purpose), particles: Some(built) }
}

/// A world, ready for rays.
struct Built {
    world: World,
    /// To find out which of them a ray hit.
    particles: Option<Arc<Particles>>,
}

impl Kernel for Built {
    #[inline]
    fn closest(&self, ray: &Ray) -> Option<f64> {
        let hit = self.world.closest_hit(&wide(ray), f64::INFINITY, ALL, None)?;
        Some(hit.crossing.t)
    }

    #[inline]
    fn any(&self, ray: &Ray, t_max: f32) -> bool {
        self.world.any_hit(&wide(ray), f64::from(t_max), None, |_, _| true)
    }

    fn first(&self, ray: &Ray) -> Option<u32> {
        let part = self.world.closest_hit(&wide(ray), f64::INFINITY, ALL, None)?.crossing.part;
        Some(self.particles.as_ref().map_or(part, |particles| particles.particle_of(part)))
    }

    fn packets_closest(&self, rays: &[Ray]) -> Option<Found> {
        Some(packets_closest(&self.world, rays))
    }

    fn packets_any(&self, rays: &[Ray], t_max: f32) -> Option<Found> {
        let t_max = [f64::from(t_max); LANES];
        let met = |rays| self.world.any_hits(&packet(rays), &t_max, ALL).count_ones() as usize;
        Some(Found { hits: rays.chunks(LANES).map(met).sum(), sum: 0.0 })
    }
}

/// The nearest hits of all rays, eight at a time.
pub(crate) fn packets_closest(world: &World, rays: &[Ray]) -> Found {
    let mut found = Found::default();
    for rays in rays.chunks(LANES) {
        let hits = world.closest_hits(&packet(rays), f64::INFINITY, ALL);
        for hit in hits[..rays.len()].iter().flatten() {
            found.hits += 1;
            found.sum += hit.crossing.t;
        }
    }
    found
}

fn packet(rays: &[Ray]) -> Packet {
    let last = rays.len() - 1;
    let wide: [durer_geometry::Ray; LANES] = std::array::from_fn(|lane| wide(&rays[lane.min(last)]));
    Packet::new(&wide[..rays.len()])
}

/// A ray in durer's precision.
#[inline]
pub(crate) fn wide(ray: &Ray) -> durer_geometry::Ray {
    let vector = |narrow: [f32; 3]| DVec3::from(narrow.map(f64::from));
    durer_geometry::Ray { origin: vector(ray.origin), direction: vector(ray.direction) }
}

//! Shading normals: made where a file has none, mended where it has useless ones.

use super::vertices::{Distinct, bits_of};
use durer_math::{DVec3, functions::atan2};
use durer_scene::{MeshData, MeshNormals};

/// What a vertex gets that no triangle has an opinion on.
const ANY: [f32; 3] = [0.0, 0.0, 1.0];

/// Gives a mesh, as it came from its file, the normals that are asked for.
pub(crate) fn shade(mesh: &mut MeshData, normals: MeshNormals) {
    match normals {
        MeshNormals::File => {}
        MeshNormals::Smooth if mesh.normals.is_empty() => smooth_normals(mesh),
        MeshNormals::Smooth => {}
        MeshNormals::Flat => mesh.normals = Vec::new(),
    }
}

/// Gives each vertex the mean of the normals of the triangles around it, weighted by their angles there (G. Thürmer and
/// C. A. Wüthrich, "Computing Vertex Normals from Polygonal Facets", 1998), so that it does not matter how a surface is
/// cut into triangles. Vertices in the same place count as one, so that seams of textures do not show.
pub(crate) fn smooth_normals(mesh: &mut MeshData) {
    let mut places = Distinct::with_capacity(mesh.positions.len());
    // There are no more places than vertices, and those have numbers of 32 bits.
    let place_of: Vec<u32> = mesh.positions.iter().map(|p| places.number(bits_of(*p)).unwrap_or(0)).collect();
    let mut sums = vec![DVec3::ZERO; places.len()];
    for triangle in &mesh.triangles {
        let corners = triangle.map(|vertex| corner(mesh, vertex));
        let normal = across(corners);
        for (at, vertex) in triangle.iter().enumerate() {
            let angle = angle(corners[at], corners[(at + 1) % 3], corners[(at + 2) % 3]);
            sums[place_of[*vertex as usize] as usize] += normal * angle;
        }
    }
    let unit = |place: &u32| match sums[*place as usize].normalize_or_zero() {
        DVec3::ZERO => ANY,
        normal => normal.to_array().map(|x| x as f32),
    };
    mesh.normals = place_of.iter().map(unit).collect();
}

/// Puts the triangle's own normal where a normal cannot be used: it is not finite, or has no length to speak of. A vertex
/// that triangles with different normals share is given to each of them. If no normal can be used, there are none.
pub(super) fn mend(mesh: &mut MeshData) {
    let lacks: Vec<bool> = mesh.normals.iter().map(|normal| !is_usable(*normal)).collect();
    if !lacks.contains(&true) {
        return;
    }
    if !lacks.contains(&false) {
        mesh.normals = Vec::new();
        return;
    }
    let mut taken = vec![false; lacks.len()];
    for at in 0..mesh.triangles.len() {
        let triangle = mesh.triangles[at];
        if !triangle.iter().any(|vertex| lacks[*vertex as usize]) {
            continue;
        }
        let normal = match across(triangle.map(|vertex| corner(mesh, vertex))) {
            DVec3::ZERO => ANY,
            normal => normal.to_array().map(|x| x as f32),
        };
        for (which, vertex) in triangle.map(|vertex| vertex as usize).into_iter().enumerate() {
            if !lacks[vertex] {
                continue;
            }
            if !taken[vertex] {
                taken[vertex] = true;
                mesh.normals[vertex] = normal;
            } else if mesh.normals[vertex] != normal {
                // With too many vertices for 32 bits the first triangle's normal will do.
                mesh.triangles[at][which] = copy(mesh, vertex, normal).unwrap_or(vertex as u32);
            }
        }
    }
    let unused = lacks.iter().zip(&taken).zip(&mut mesh.normals).filter(|((lacks, taken), _)| **lacks && !**taken);
    unused.for_each(|(_, normal)| *normal = ANY);
}

fn is_usable(normal: [f32; 3]) -> bool {
    let length = normal.iter().map(|x| f64::from(*x) * f64::from(*x)).sum::<f64>().sqrt();
    // NaN is in no range.
    (1e-30..=1e30).contains(&length)
}

/// The number of a new vertex: a copy of another one but for its normal.
fn copy(mesh: &mut MeshData, vertex: usize, normal: [f32; 3]) -> Option<u32> {
    let new = u32::try_from(mesh.positions.len()).ok()?;
    mesh.positions.push(mesh.positions[vertex]);
    mesh.normals.push(normal);
    mesh.uvs.extend(mesh.uvs.get(vertex).copied());
    mesh.colors.extend(mesh.colors.get(vertex).copied());
    Some(new)
}

fn corner(mesh: &MeshData, vertex: u32) -> DVec3 {
    DVec3::from_array(mesh.positions[vertex as usize].map(f64::from))
}

/// The unit normal of a triangle; zero if it has no area.
fn across([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a).normalize_or_zero()
}

/// The angle at `at` between the directions to two points, in radians.
fn angle(at: DVec3, to: DVec3, and: DVec3) -> f64 {
    let (to, and) = (to - at, and - at);
    // Better than an arc cosine near 0 and π, and good for any lengths.
    atan2(to.cross(and).length(), to.dot(and))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A box of side 2 around the origin with as many vertices as there are corners of squares; squares are cut along
    /// either diagonal.
    fn cube() -> MeshData {
        let mut mesh = MeshData::default();
        for (axis, sign) in [0, 1, 2].into_iter().flat_map(|axis| [(axis, 1.0), (axis, -1.0_f32)]) {
            let first = mesh.positions.len() as u32;
            for [u, v] in [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0_f32]] {
                let mut position = [0.0; 3];
                position[axis] = sign;
                position[(axis + 1) % 3] = u * sign;
                position[(axis + 2) % 3] = v;
                mesh.positions.push(position);
            }
            let cuts = if axis == 1 { [[0, 1, 2], [0, 2, 3]] } else { [[0, 1, 3], [1, 2, 3]] };
            mesh.triangles.extend(cuts.map(|cut: [u32; 3]| cut.map(|corner| first + corner)));
        }
        mesh
    }

    #[test]
    fn the_corners_of_a_cube_point_along_its_diagonals() {
        let mut mesh = cube();
        smooth_normals(&mut mesh);
        for (position, normal) in mesh.positions.iter().zip(&mesh.normals) {
            for (x, n) in position.iter().zip(normal) {
                assert!((n * 3.0_f32.sqrt() - x).abs() < 1e-6, "{position:?} {normal:?}");
            }
        }
    }

    #[test]
    fn flat_drops_normals_and_smooth_keeps_those_of_the_file() {
        let mut mesh = cube();
        shade(&mut mesh, MeshNormals::File);
        assert!(mesh.normals.is_empty());
        mesh.normals = vec![[0.0, 2.0, 0.0]; mesh.positions.len()];
        shade(&mut mesh, MeshNormals::Smooth);
        assert_eq!(mesh.normals[0], [0.0, 2.0, 0.0]);
        shade(&mut mesh, MeshNormals::Flat);
        assert!(mesh.normals.is_empty());
        shade(&mut mesh, MeshNormals::Smooth);
        assert_eq!(mesh.normals.len(), mesh.positions.len());
    }

    #[test]
    fn degenerate_triangles_and_lonely_vertices_get_some_normal() {
        let mut mesh = MeshData {
            positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [9.0; 3]],
            triangles: vec![[0, 1, 2], [1, 1, 1]],
            ..MeshData::default()
        };
        smooth_normals(&mut mesh);
        assert_eq!(mesh.normals, vec![ANY; 4]);
    }

    #[test]
    fn useless_normals_become_those_of_their_triangles() {
        // Two triangles like an open book; one shared vertex has a normal, the other one has none.
        let mut mesh = MeshData {
            positions: vec![[0.0; 3], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            triangles: vec![[0, 1, 2], [1, 0, 3]],
            normals: vec![[0.0, f32::NAN, 0.0], [3.0, 0.0, 0.0], [0.0; 3], [0.0, 0.0, f32::INFINITY]],
            uvs: vec![[0.5, 0.25]; 4],
            ..MeshData::default()
        };
        mend(&mut mesh);
        assert_eq!(mesh.triangles, [[0, 1, 2], [1, 4, 3]]);
        assert_eq!(mesh.positions[4], [0.0; 3]);
        assert_eq!(mesh.normals, [[0.0, 1.0, 0.0], [3.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [1.0, 0.0, 0.0]]);
        assert_eq!((mesh.uvs.len(), mesh.colors.len()), (5, 0));
    }

    #[test]
    fn no_normals_are_better_than_only_useless_ones() {
        let mut mesh = cube();
        mesh.normals = vec![[0.0; 3]; mesh.positions.len()];
        mend(&mut mesh);
        assert!(mesh.normals.is_empty());
    }
}

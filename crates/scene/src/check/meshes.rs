//! Meshes: triangles of vertices that exist, and a number of everything for each vertex.

use super::Step;
use super::bounds::{wrong_with_fraction, wrong_with_point};
use super::lists::{each, entry, length};
use super::objects::material;
use super::values::Checker;
use crate::{Mesh, MeshData};
use durer_math::DVec3;
use std::sync::Arc;

pub(super) fn check(c: &mut Checker<'_>, mesh: &Mesh) {
    if !c.meshes.insert(Arc::as_ptr(&mesh.data) as usize) {
        return;
    }
    match mesh.file {
        // What is in a file has no place but the name of the file.
        Some(_) => c.field("file", |c| data(c, &mesh.data)),
        None => data(c, &mesh.data),
    }
}

fn data(c: &mut Checker<'_>, mesh: &MeshData) {
    let count = mesh.positions.len();
    if mesh.triangles.len() > MeshData::MOST_TRIANGLES {
        c.field("triangles", |c| c.problem(format!("a mesh has at most {} triangles", MeshData::MOST_TRIANGLES)));
    }
    c.point("origin", mesh.origin);
    each(c, "vertices", &mesh.positions, |point| wrong_with_point("vertices", wide(*point)));
    each(c, "triangles", &mesh.triangles, |triangle| {
        let missing = triangle.iter().find(|vertex| **vertex as usize >= count)?;
        Some(format!("there is no vertex {missing}: vertices are counted from 0, and there are {count}"))
    });
    if !mesh.normals.is_empty() {
        length(c, "vertex_normals", mesh.normals.len(), count, "vertices");
        each(c, "vertex_normals", &mesh.normals, |normal| wrong_with_normal(*normal));
    }
    if !mesh.uvs.is_empty() {
        length(c, "uvs", mesh.uvs.len(), count, "vertices");
        let wrong = || Some("texture coordinates must be at most 1e6 in size".to_owned());
        each(c, "uvs", &mesh.uvs, |uv| if uv.iter().all(|x| x.abs() <= 1e6) { None } else { wrong() });
    }
    if !mesh.colors.is_empty() {
        length(c, "colors", mesh.colors.len(), count, "vertices");
        each(c, "colors", &mesh.colors, |color| wrong_with_fraction("colors", *color));
    }
    parts(c, mesh);
}

fn wide(vector: [f32; 3]) -> DVec3 {
    DVec3::from_array(vector.map(f64::from))
}

fn wrong_with_normal(normal: [f32; 3]) -> Option<String> {
    let length = wide(normal).length();
    if (1e-30..=1e30).contains(&length) {
        return None;
    }
    Some(match length == 0.0 {
        true => "a normal must not be zero: it has no direction".to_owned(),
        false => "a normal must be from 1e-30 to 1e30 long".to_owned(),
    })
}

/// Parts come in order, do not overlap, and have materials that exist.
fn parts(c: &mut Checker<'_>, mesh: &MeshData) {
    let count = mesh.triangles.len() as u64;
    let mut end = 0;
    for (at, part) in mesh.parts.iter().enumerate() {
        c.field("parts", |c| c.at(Step::Index(at), |c| c.field("material", |c| material(c, part.material))));
        let (first, next) = (u64::from(part.first), u64::from(part.first) + u64::from(part.count));
        let wrong = if next > count {
            format!("triangles {first} to {next} of a part are not all there: there are {count}")
        } else if first < end {
            "parts must not overlap, and follow one another".to_owned()
        } else {
            end = next;
            continue;
        };
        entry(c, "parts", at, mesh.parts.len(), &wrong);
        return;
    }
}

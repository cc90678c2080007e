//! Primitives: triangles, strips and fans of vertices, to triangles that share them.
//!
//! Only vertices that a triangle uses are read: files often keep one long list for many primitives.

use super::super::ModelError;
use super::accessor::{Accessor, Component, FRACTIONS, INDICES, MEASURES};
use super::deform::{self, Bones, Skin, Target};
use super::materials::Finish;
use super::source::Source;
use super::value::{Place, Value};
use durer_math::{DVec3, Rgb};
use durer_scene::{MeshData, MeshPart};

/// How the corners of triangles follow each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Mode {
    Triangles,
    Strip,
    Fan,
}

/// A primitive whose accessors are open.
pub(super) struct Primitive<'s> {
    place: Place,
    mode: Mode,
    indices: Option<Accessor<'s>>,
    positions: Accessor<'s>,
    normals: Option<Accessor<'s>>,
    uvs: Option<Accessor<'s>>,
    colors: Option<Accessor<'s>>,
    /// What vertex colors are multiplied by.
    tint: Rgb,
    targets: Vec<Target<'s>>,
    bones: Vec<Bones<'s>>,
    /// What it is made of: primitives with the same key have the same triangles.
    pub(super) key: Vec<u64>,
}

/// Texture coordinates, by their set.
const UVS: [&str; 8] =
    ["TEXCOORD_0", "TEXCOORD_1", "TEXCOORD_2", "TEXCOORD_3", "TEXCOORD_4", "TEXCOORD_5", "TEXCOORD_6", "TEXCOORD_7"];
/// Texture coordinates beyond this are no places on an image.
const LARGEST_UV: f32 = 1e6;
/// Scenes allow no larger coordinates.
const LARGEST_COORDINATE: f32 = 1e12;

impl<'s> Primitive<'s> {
    /// Opens a primitive; `None` if it has no triangles to show. `weights` are those of the morph targets.
    pub(super) fn open<'a>(
        source: &'s Source<'a>,
        primitive: &Value<'a>,
        finish: Option<Finish>,
        weights: &[f64],
        skin: Option<&Skin>,
    ) -> Result<Option<Primitive<'s>>, ModelError> {
        let place = primitive.place;
        let Some(mode) = mode(source, primitive)? else { return Ok(None) };
        let Some(attributes) = primitive.object("attributes")? else { return Ok(None) };
        let Some((index, positions)) = Accessor::open(source, &attributes, "POSITION", &[3], MEASURES)? else {
            source.notes.add("primitives without positions are left out", place);
            return Ok(None);
        };
        let mut opener = Opener { source, vertices: positions.count, key: vec![mode as u64, index as u64] };
        let indices = opener.open_any(primitive, "indices", &[1], INDICES)?;
        let normals = opener.open(&attributes, "NORMAL", &[3], MEASURES)?;
        let uvs = opener.open_uvs(&attributes, finish, place)?;
        let colors = opener.open_colors(&attributes, finish, place)?;
        let tint = finish.map_or(Rgb::WHITE, |finish| finish.tint);
        let targets = deform::open_targets(&mut opener, primitive, weights)?;
        let bones = match skin {
            Some(skin) => skin.open_bones(&mut opener, &attributes)?,
            None => Vec::new(),
        };
        if skin.is_some() && bones.is_empty() {
            source.notes.add("a mesh with a skin does not hang on its joints", place);
        }
        let key = opener.key;
        Ok(Some(Primitive { place, mode, indices, positions, normals, uvs, colors, tint, targets, bones, key }))
    }

    /// Its triangles; `None` if it has none.
    pub(super) fn read(&self, source: &Source<'_>, skin: Option<&Skin>) -> Result<Option<MeshData>, ModelError> {
        let mut triangles = self.triangles(source)?;
        if triangles.is_empty() {
            return Ok(None);
        }
        source.budget.triangles(triangles.len(), self.place)?;
        let used = keep_used(&mut triangles, self.positions.count);
        source.budget.spend(used.len(), 12 * (1 + self.targets.len()) + 64 * self.bones.len(), self.place)?;
        let mut positions = self.read_positions(&used)?;
        let mut normals =
            each(&self.normals, &used, |normals, vertex| normals.get_single::<3>(vertex), source, self.place)?;
        for target in &self.targets {
            target.add_to(&used, &mut positions, &mut normals);
        }
        if let Some(skin) = skin
            && !self.bones.is_empty()
        {
            skin.bend(&self.bones, &used, &mut positions, &mut normals, &mut triangles)?;
        }
        if !positions.iter().all(is_usable) {
            return Err(self.place.fault("its morph targets or its skin lead too far"));
        }
        if mend_normals(&mut normals, &positions, &triangles) {
            source.notes.add("normals without a direction are replaced by those of triangles", self.place);
        }
        let uvs = each(&self.uvs, &used, |uvs, vertex| uv(uvs.get_single(vertex)), source, self.place)?;
        let colors = each(&self.colors, &used, |colors, vertex| self.color(colors, vertex), source, self.place)?;
        let count = triangles.len() as u32;
        let parts = vec![MeshPart { name: None, first: 0, count, material: None }];
        Ok(Some(MeshData { origin: DVec3::ZERO, positions, triangles, normals, uvs, colors, parts }))
    }

    /// The triangles, by vertices as the file numbers them. Those with two equal corners are nothing to see.
    fn triangles(&self, source: &Source<'_>) -> Result<Vec<[u32; 3]>, ModelError> {
        let count = self.indices.as_ref().map_or(self.positions.count, |indices| indices.count);
        source.budget.spend(count, 4 + 12, self.place)?;
        let Ok(vertices) = u32::try_from(self.positions.count) else {
            return Err(self.positions.place.fault("these are too many vertices for one mesh"));
        };
        let mut corners = Vec::with_capacity(count);
        for corner in 0..count {
            let vertex = match &self.indices {
                Some(indices) => indices.get_whole::<1>(corner)[0],
                None => corner as u32,
            };
            if vertex >= vertices {
                let place = self.indices.as_ref().map_or(self.place, |indices| indices.place);
                let message = format!("index {corner} is {vertex}, but there are only {vertices} vertices");
                return Err(place.fault(message));
            }
            corners.push(vertex);
        }
        let different = |[a, b, c]: &[u32; 3]| a != b && b != c && c != a;
        Ok(match self.mode {
            Mode::Triangles => corners.as_chunks().0.iter().copied().filter(different).collect(),
            Mode::Strip => strip(&corners).filter(different).collect(),
            Mode::Fan => fan(&corners).filter(different).collect(),
        })
    }

    fn read_positions(&self, used: &[u32]) -> Result<Vec<[f32; 3]>, ModelError> {
        let mut positions = Vec::with_capacity(used.len());
        for &vertex in used {
            let position = self.positions.get_single::<3>(vertex as usize);
            if !is_usable(&position) {
                let is_finite = position.iter().all(|coordinate| coordinate.is_finite());
                let what = if is_finite { "too far away" } else { "not finite" };
                return Err(self.positions.place.fault(format!("the position of vertex {vertex} is {what}")));
            }
            positions.push(position);
        }
        Ok(positions)
    }

    fn color(&self, colors: &Accessor<'_>, vertex: usize) -> Rgb {
        // What is no number is as if it were not there.
        let component = |component: f32| if component.is_nan() { 1.0 } else { component.clamp(0.0, 1.0) };
        Rgb::from(colors.get_single::<3>(vertex).map(component)) * self.tint
    }
}

/// The mode; `None` for points and lines.
fn mode(source: &Source<'_>, primitive: &Value<'_>) -> Result<Option<Mode>, ModelError> {
    Ok(match primitive.whole("mode")? {
        None | Some(4) => Some(Mode::Triangles),
        Some(5) => Some(Mode::Strip),
        Some(6) => Some(Mode::Fan),
        Some(0..=3) => {
            source.notes.add("points and lines are left out", primitive.place);
            None
        }
        Some(other) => return Err(primitive.fault(format!("there is no mode {other}"))),
    })
}

/// Opens the accessors of one primitive, and gathers what it is made of.
pub(super) struct Opener<'s, 'a> {
    pub(super) source: &'s Source<'a>,
    /// Number of vertices.
    vertices: usize,
    pub(super) key: Vec<u64>,
}

impl<'s, 'a> Opener<'s, 'a> {
    /// An accessor of any length.
    fn open_any(
        &mut self,
        from: &Value<'a>,
        field: &'static str,
        widths: &[usize],
        components: &[Component],
    ) -> Result<Option<Accessor<'s>>, ModelError> {
        let opened = Accessor::open(self.source, from, field, widths, components)?;
        self.key.push(opened.as_ref().map_or(u64::MAX, |(index, _)| *index as u64));
        Ok(opened.map(|(_, accessor)| accessor))
    }

    /// An accessor that must have an element for each vertex.
    pub(super) fn open(
        &mut self,
        from: &Value<'a>,
        field: &'static str,
        widths: &[usize],
        components: &[Component],
    ) -> Result<Option<Accessor<'s>>, ModelError> {
        let opened = self.open_any(from, field, widths, components)?;
        match opened {
            Some(accessor) if accessor.count != self.vertices => {
                let message = format!("it has {} elements, but there are {} positions", accessor.count, self.vertices);
                Err(accessor.place.fault(message))
            }
            opened => Ok(opened),
        }
    }

    /// The texture coordinates that a material uses.
    fn open_uvs(
        &mut self,
        attributes: &Value<'a>,
        finish: Option<Finish>,
        place: Place,
    ) -> Result<Option<Accessor<'s>>, ModelError> {
        let set = finish.map_or(0, |finish| finish.uv_set);
        self.key.push(set as u64);
        let uvs = match UVS.get(set) {
            Some(name) => self.open(attributes, name, &[2], MEASURES)?,
            None => None,
        };
        if uvs.is_none() && finish.is_some_and(|finish| finish.has_texture) {
            self.source.notes.add("a texture has no texture coordinates to lie by", place);
        }
        Ok(uvs)
    }

    /// The vertex colors, which depend on the material's.
    fn open_colors(
        &mut self,
        attributes: &Value<'a>,
        finish: Option<Finish>,
        place: Place,
    ) -> Result<Option<Accessor<'s>>, ModelError> {
        let Some(colors) = self.open(attributes, "COLOR_0", &[3, 4], FRACTIONS)? else { return Ok(None) };
        if let Some(finish) = finish {
            self.key.extend(finish.tint.to_array().map(|component| u64::from(component.to_bits())));
            if finish.has_alpha && colors.width == 4 {
                self.source.notes.add("the alpha of vertex colors is not used", place);
            }
        }
        Ok(Some(colors.into_fractions()))
    }
}

/// The triangles of a strip, all turned to the same side.
fn strip(corners: &[u32]) -> impl Iterator<Item = [u32; 3]> {
    let turned = |at: usize, [a, b, c]: [u32; 3]| if at.is_multiple_of(2) { [a, b, c] } else { [a, c, b] };
    corners.windows(3).enumerate().map(move |(at, three)| turned(at, [three[0], three[1], three[2]]))
}

/// The triangles of a fan.
fn fan(corners: &[u32]) -> impl Iterator<Item = [u32; 3]> {
    let (first, others) = corners.split_first().map_or((0, corners), |(first, others)| (*first, others));
    others.windows(2).map(move |two| [first, two[0], two[1]])
}

/// Gives the vertices that triangles use, in order, and makes the triangles number them so.
fn keep_used(triangles: &mut [[u32; 3]], vertices: usize) -> Vec<u32> {
    let corners = || triangles.iter().flatten().copied();
    // Of a long list of which little is used, a table of all would take more than the triangles do.
    if vertices / 16 > triangles.len() {
        let mut used: Vec<u32> = corners().collect();
        used.sort_unstable();
        used.dedup();
        for corner in triangles.iter_mut().flatten() {
            *corner = used.partition_point(|vertex| *vertex < *corner) as u32;
        }
        return used;
    }
    let mut new = vec![u32::MAX; vertices];
    corners().for_each(|corner| new[corner as usize] = 0);
    let used: Vec<u32> = (0..vertices as u32).filter(|vertex| new[*vertex as usize] == 0).collect();
    (0..).zip(&used).for_each(|(place, vertex)| new[*vertex as usize] = place);
    triangles.iter_mut().flatten().for_each(|corner| *corner = new[*corner as usize]);
    used
}

/// Reads an attribute of the vertices that are used; nothing if there is no such attribute.
fn each<T>(
    accessor: &Option<Accessor<'_>>,
    used: &[u32],
    read: impl Fn(&Accessor<'_>, usize) -> T,
    source: &Source<'_>,
    place: Place,
) -> Result<Vec<T>, ModelError> {
    let Some(accessor) = accessor else { return Ok(Vec::new()) };
    source.budget.spend(used.len(), size_of::<T>(), place)?;
    Ok(used.iter().map(|vertex| read(accessor, *vertex as usize)).collect())
}

/// True for positions that scenes allow.
fn is_usable(position: &[f32; 3]) -> bool {
    position.iter().all(|coordinate| coordinate.abs() <= LARGEST_COORDINATE)
}

/// Texture coordinates with v upwards; the corner of the image for what is no place on it.
fn uv([u, v]: [f32; 2]) -> [f32; 2] {
    let uv = [u, 1.0 - v];
    if uv.iter().all(|x| x.abs() <= LARGEST_UV) { uv } else { [0.0, 1.0] }
}

/// Gives normals that have no direction that of the triangles around; true if there were such.
fn mend_normals(normals: &mut [[f32; 3]], positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> bool {
    let wide = |[x, y, z]: [f32; 3]| DVec3::new(x.into(), y.into(), z.into());
    let has_direction = |normal: &[f32; 3]| {
        let length = wide(*normal).length_squared();
        length > 1e-30 && length < 1e30
    };
    let broken: Vec<usize> = (0..normals.len()).filter(|at| !has_direction(&normals[*at])).collect();
    if broken.is_empty() {
        return false;
    }
    let mut sums = vec![DVec3::ZERO; normals.len()];
    for triangle in triangles {
        let [a, b, c] = triangle.map(|vertex| wide(positions[vertex as usize]));
        let across = (b - a).cross(c - a);
        triangle.iter().for_each(|vertex| sums[*vertex as usize] += across);
    }
    for at in broken {
        let direction = sums[at].try_normalize().unwrap_or(DVec3::Y);
        normals[at] = [direction.x as f32, direction.y as f32, direction.z as f32];
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strips_and_fans_keep_their_side() {
        assert_eq!(strip(&[0, 1, 2, 3, 4]).collect::<Vec<_>>(), [[0, 1, 2], [1, 3, 2], [2, 3, 4]]);
        assert_eq!(fan(&[0, 1, 2, 3]).collect::<Vec<_>>(), [[0, 1, 2], [0, 2, 3]]);
        for short in [&[][..], &[0], &[0, 1]] {
            assert_eq!((strip(short).count(), fan(short).count()), (0, 0));
        }
    }

    #[test]
    fn only_used_vertices_stay_whichever_way_they_are_counted() {
        for vertices in [10, 10_000] {
            let mut triangles = [[7, 2, 9], [2, 3, 7]];
            assert_eq!(keep_used(&mut triangles, vertices), [2, 3, 7, 9]);
            assert_eq!(triangles, [[2, 0, 3], [0, 1, 2]]);
        }
    }

    #[test]
    fn normals_without_direction_are_mended() {
        let positions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [5.0, 5.0, 5.0]];
        let mut normals = [[0.0, 3.0, 0.0], [0.0; 3], [f32::NAN; 3], [0.0; 3]];
        assert!(mend_normals(&mut normals, &positions, &[[0, 1, 2]]));
        assert_eq!(normals, [[0.0, 3.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]]);
        assert!(!mend_normals(&mut normals, &positions, &[[0, 1, 2]]));
    }
}

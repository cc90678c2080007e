//! "Did you mean …?", and what to say to habits from elsewhere.

/// Words of other programs, and ours.
const OTHER_WORDS: &[(&str, &str)] = &[
    ("colour", "color"),
    ("colours", "colors"),
    ("albedo", "color"),
    ("diffuse_color", "color"),
    ("pigment", "color"),
    ("centre", "center"),
    ("position", "center"),
    ("origin", "center"),
    ("pos", "position"),
    ("location", "position"),
    ("eye", "position"),
    ("from", "position"),
    ("origin", "position"),
    ("center", "position"),
    ("target", "look_at"),
    ("lookat", "look_at"),
    ("at", "look_at"),
    ("to", "look_at"),
    ("look_at", "target"),
    ("at", "target"),
    ("direction", "target"),
    ("field_of_view", "fov"),
    ("vertical_fov", "fov"),
    ("vfov", "fov"),
    ("fovy", "fov"),
    ("yfov", "fov"),
    ("angle", "fov"),
    ("angle", "half_angle"),
    ("cutoff", "half_angle"),
    ("r", "radius"),
    ("size", "radius"),
    ("inner", "inner_radius"),
    ("minor_radius", "tube_radius"),
    ("tube", "tube_radius"),
    ("major_radius", "radius"),
    ("base_radius", "radius"),
    ("bottom", "base"),
    ("apex", "top"),
    ("index", "ior"),
    ("refraction", "ior"),
    ("refractive_index", "ior"),
    ("index_of_refraction", "ior"),
    ("reflectivity", "reflection"),
    ("reflectance", "reflection"),
    ("mirror", "reflection"),
    ("reflective", "reflection"),
    ("transmission", "transparency"),
    ("transmittance", "transparency"),
    ("transparent", "transparency"),
    ("exponent", "shininess"),
    ("phong", "shininess"),
    ("power", "intensity"),
    ("brightness", "intensity"),
    ("strength", "intensity"),
    ("alpha", "opacity"),
    ("cutout", "opacity"),
    ("mask", "opacity"),
    ("emissive", "emission"),
    ("emit", "emission"),
    ("glow", "emission"),
    ("points", "centers"),
    ("positions", "centers"),
    ("radii", "radius"),
    ("ends", "tops"),
    ("starts", "bases"),
    ("faces", "triangles"),
    ("indices", "triangles"),
    ("scales", "scale"),
    ("translations", "positions"),
    ("path", "file"),
    ("filename", "file"),
    ("src", "file"),
    ("url", "file"),
    ("decay", "falloff"),
    ("attenuation", "falloff"),
    ("points", "vertices"),
    ("children", "objects"),
    ("items", "objects"),
    ("members", "objects"),
    ("shapes", "objects"),
    ("primitives", "objects"),
    ("light", "lights"),
    ("material", "materials"),
    ("texture", "textures"),
    ("object", "objects"),
    ("image", "picture"),
    ("output", "picture"),
    ("resolution", "picture"),
    ("film", "picture"),
    ("settings", "render"),
    ("sky", "background"),
    ("recursion_depth", "max_depth"),
    ("depth", "max_depth"),
    ("antialiasing", "antialias"),
    ("gamma", "transfer"),
    ("scale", "size"),
    ("lambert", "diffuse"),
    ("kd", "diffuse"),
    ("ks", "specular"),
    ("ka", "ambient"),
    ("dir", "direction"),
    ("ball", "sphere"),
    ("cube", "box"),
    ("cuboid", "box"),
    ("circle", "disc"),
    ("disk", "disc"),
    ("annulus", "disc"),
    ("ring", "torus"),
    ("donut", "torus"),
    ("quad", "rectangle"),
    ("rect", "rectangle"),
    ("parallelogram", "rectangle"),
    ("merge", "union"),
    ("csg", "difference"),
    ("subtraction", "difference"),
    ("subtract", "difference"),
    ("minus", "difference"),
    ("intersect", "intersection"),
    ("obj", "mesh"),
    ("ply", "mesh"),
    ("stl", "mesh"),
    ("model", "mesh"),
    ("triangles", "mesh"),
    ("trimesh", "mesh"),
    ("gltf", "import"),
    ("glb", "import"),
    ("include", "import"),
    ("scene", "import"),
    ("particles", "spheres"),
    ("points", "spheres"),
    ("balls", "spheres"),
    ("atoms", "spheres"),
    ("sticks", "cylinders"),
    ("bonds", "cylinders"),
    ("capsule", "capsules"),
    ("copies", "instances"),
    ("instance", "instances"),
    ("clones", "instances"),
    ("tube", "cylinder"),
    ("frustum", "cone"),
    ("ground", "plane"),
    ("floor", "plane"),
    ("sun", "directional"),
    ("distant", "directional"),
    ("parallel", "directional"),
    ("omni", "point"),
    ("spotlight", "spot"),
    ("checkerboard", "checker"),
    ("chequer", "checker"),
    ("checkers", "checker"),
    ("chess", "checker"),
    ("bitmap", "image"),
    ("picture", "image"),
    ("perlin", "noise"),
    ("turbulence", "noise"),
    ("sphere", "spherical"),
    ("cylinder", "cylindrical"),
    ("linear", "bilinear"),
    ("quadratic", "inverse_square"),
    ("physical", "inverse_square"),
    ("tile", "repeat"),
    ("periodic", "repeat"),
    ("exp", "exponential"),
    ("adaptive", "recursive"),
    ("supersampling", "grid"),
    ("off", "none"),
    ("no", "none"),
    ("false", "none"),
    ("pathtracer", "path"),
    ("path_tracing", "path"),
    ("pathtracing", "path"),
    ("global_illumination", "path"),
    ("raytracing", "whitted"),
    ("classic", "whitted"),
    ("ao", "ambient_occlusion"),
    ("normal", "normals"),
    ("spp", "samples"),
    ("samples_per_pixel", "samples"),
    ("time_limit", "time"),
    ("ev", "exposure"),
    ("tonemap", "tone_mapping"),
    ("tonemapping", "tone_mapping"),
    ("tone_map", "tone_mapping"),
    ("neutral", "pbr_neutral"),
    ("khronos", "pbr_neutral"),
    ("aperture", "lens"),
    ("depth_of_field", "lens"),
    ("dof", "lens"),
    ("aperture", "radius"),
    ("fstop", "f_number"),
    ("f_stop", "f_number"),
    ("focus_distance", "focus"),
    ("focal_distance", "focus"),
    ("hdri", "image"),
    ("environment", "image"),
    ("map", "image"),
    ("file", "image"),
    ("environment", "background"),
    ("world", "background"),
    ("watt", "power"),
    ("watts", "power"),
    ("alu", "aluminum"),
    ("aluminium", "aluminum"),
    ("chrome", "chromium"),
    ("steel", "iron"),
    ("conductor", "metal"),
    ("dielectric", "glass"),
    ("diffuse", "matte"),
    ("lambert", "matte"),
    ("lambertian", "matte"),
    ("pbr", "principled"),
    ("disney", "principled"),
    ("standard", "principled"),
    ("base_colour", "base_color"),
    ("albedo", "base_color"),
    ("metalness", "metallic"),
    ("metallicity", "metallic"),
    ("alpha", "roughness"),
    ("coat", "clearcoat"),
    ("normals", "normal_map"),
    ("normal", "normal_map"),
    ("displacement", "bump"),
    ("move", "translate"),
    ("position", "translate"),
    ("turn", "rotate"),
];

/// Names beyond these are not compared: a hostile file has many.
const MOST_CANDIDATES: usize = 2000;

/// The one of `known` that was probably meant by `word`.
pub(crate) fn nearest<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let word = word.chars().take(64).collect::<String>().to_lowercase().replace('-', "_");
    let length = word.chars().count();
    let mut best: Option<(usize, &str)> = None;
    for candidate in known.into_iter().take(MOST_CANDIDATES) {
        if OTHER_WORDS.iter().any(|(other, ours)| *other == word && *ours == candidate) {
            return Some(candidate);
        }
        // Bytes bound characters from above, and are there at no cost.
        if candidate.len() > 6 * (length + 1) {
            continue;
        }
        let distance = strsim::damerau_levenshtein(&word, &candidate.to_lowercase());
        let allowed = length.max(candidate.chars().count()) / 3;
        if distance <= allowed && best.is_none_or(|(least, _)| distance < least) {
            best = Some((distance, candidate));
        }
    }
    best.map(|(_, candidate)| candidate)
}

/// "did you mean `x`?" or, if nothing is near, what can be chosen.
pub(crate) fn did_you_mean(word: &str, known: &[&str], kind_of_choice: &str) -> String {
    match nearest(word, known.iter().copied()) {
        Some(near) => format!("did you mean `{near}`?"),
        None if known.is_empty() => format!("see the {kind_of_choice} in the reference"),
        None => format!("the {kind_of_choice} are {}", list(known)),
    }
}

/// "`a`, `b` and `c`", at most twenty of them.
pub(crate) fn list(words: &[&str]) -> String {
    let quoted: Vec<String> = words.iter().take(20).map(|word| format!("`{word}`")).collect();
    match quoted.split_last() {
        None => String::new(),
        Some((only, [])) => only.clone(),
        Some(_) if words.len() > 20 => format!("{} and {} more", quoted.join(", "), words.len() - 20),
        Some((last, others)) => format!("{} and {last}", others.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_near_words_are_suggested() {
        let known = ["radius", "center", "material"];
        assert_eq!(nearest("radus", known), Some("radius"));
        assert_eq!(nearest("Centre", known), Some("center"));
        assert_eq!(nearest("zebra", known), None);
        assert_eq!(did_you_mean("zebra", &known, "fields"), "the fields are `radius`, `center` and `material`");
    }
}

//! Extensions: which are understood, and what is said of the others.

use super::super::ModelError;
use super::source::Source;
use crate::native::tree::shorten;

/// What is read.
const READ: [&str; 13] = [
    "KHR_lights_punctual",
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_volume",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
];

/// What can be left out without a difference to a picture of the file as it is.
const HARMLESS: [&str; 4] = ["KHR_animation_pointer", "KHR_materials_variants", "KHR_xmp", "KHR_xmp_json_ld"];

/// How many are named in a warning.
const MOST_NAMED: usize = 8;

/// Refuses a file that cannot be read without an extension that is not understood.
pub(super) fn check(source: &Source<'_>) -> Result<(), ModelError> {
    for value in source.root.list("extensionsRequired")?.iter() {
        let name = value.as_text()?;
        if !is_known(name) {
            let fault = value.fault(format!("the file needs {}, which cannot be read", shorten(name)));
            return Err(fault.help(help(name)));
        }
    }
    let used = source.root.list("extensionsUsed")?;
    let mut unknown = Vec::new();
    for value in used.iter() {
        let name = value.as_text()?;
        if !is_known(name) && unknown.len() <= MOST_NAMED && !unknown.contains(&name) {
            unknown.push(name);
        }
    }
    for (at, name) in unknown.iter().enumerate() {
        match at {
            MOST_NAMED => source.notes.add("the file uses more extensions that are not read", used.place),
            _ => source.notes.add(&format!("the extension {} is not read", shorten(name)), used.place),
        }
    }
    Ok(())
}

fn is_known(name: &str) -> bool {
    READ.contains(&name) || HARMLESS.contains(&name)
}

/// What to do about a file that needs an extension.
fn help(name: &str) -> String {
    let what = match name {
        "KHR_draco_mesh_compression" | "EXT_meshopt_compression" | "KHR_meshopt_compression" => {
            "write it without compression first"
        }
        "KHR_texture_basisu" | "EXT_texture_webp" | "EXT_texture_avif" | "MSFT_texture_dds" => {
            "convert its images to PNG or JPEG first"
        }
        _ => "convert it to a file without this extension first",
    };
    format!("{what}, for example with `gltf-transform` or Blender")
}

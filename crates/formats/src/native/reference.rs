//! The reference page of the scene language, from the same definitions as the reader.

use super::camera::lens_about;
use super::file::SceneFile;
use super::lights::Shine;
use super::objects::Placing;
use super::record::{Choice, DefaultAbout, FieldAbout, KindAbout, Record};
use super::surfaces::{Common, Physical};
use super::textures;
use super::transform::STEPS;
use super::value::Value;
use super::write::Out;
use durer_imaging::{ToneMapping, Transfer};
use durer_scene::{
    Antialias, Attenuation, Bump, Camera, Channels, Classic, Emission, Encoding, Environment, Falloff, Filter, Fog,
    Integrator, LightKind, Mapping, MeshNormals, MeshPart, MetalName, NormalMap, Pattern, Picture, PixelFilter,
    RenderSettings, Sides, Space, Wrap,
};
use std::fmt::Write as _;

const OPENING: &str = "# The scene language

<!-- Made by `cargo xtask bless` from crates/formats: edit the definitions there. -->

A scene is a YAML file (or JSON, which is YAML too). Coordinates are right-handed with +y up; lengths are in any one
unit; angles are in degrees; colors are linear light. Every field below may be left out unless it says *required*.

```yaml
camera: {position: [0, 2, 6], look_at: [0, 1, 0]}
materials:
  glass: {color: white, transparency: 0.9, ior: 1.5, fresnel: true}
objects:
  - plane: {material: {color: {checker: {colors: [white, gray]}}}}
  - sphere: {center: [0, 1, 0], material: glass}
```

A *color* is a gray such as `0.5`; three numbers `[r, g, b]`; `\"#rrggbb\"` or `\"#rgb\"`; or one of the 148 CSS names such
as `tomato` (the last two are sRGB and made linear). Where it says *a color or texture*, the name of a texture or a
texture itself may stand as well; a texture of the file goes before a CSS color of the same name.

What is used often can be shared by YAML's anchors (`&name`, `*name`) and merge keys (`<<: *name`). To have an editor
complete and explain fields, begin the file with `# yaml-language-server: $schema=` and the path of
`docs/scene.schema.json`.
";

const DATA: &str = "
## Lists and data files

Where it says *or a data file*, three things may stand:

```yaml
centers: [[0, 0, 0], [1, 0, 0]]                         # the values themselves
centers: positions.npy                                  # a file: its usual columns
centers: {file: run.csv, columns: [px, py, pz]}         # a file: these columns, by name or by number from 1
```

| file | what is read |
|---|---|
| `.npy` | NumPy arrays of shape (n,) or (n, columns), of floats or whole numbers, in any order of bytes; not structured ones. |
| `.csv`, `.tsv`, `.txt`, `.dat` | Tables as text: cells are separated by commas, semicolons, tabs or spaces, as the first line shows. If no cell of the first line is a number, it holds names; so does a line that begins with `#`, right before a first line of numbers. Other lines with `#`, and empty ones, are skipped. Cells may be in double quotes. |
| `.ply` | The vertices of a PLY file, each property a column. |
| `.xyz` | Atoms: their number, a line of remarks, then element, x, y, z of each; or as `Properties=` in the remarks of extended XYZ says. Of several frames the first is read. |

Usual columns, in any case of letters:

| field | columns |
|---|---|
| `centers`, `positions` | `x`, `y`, `z`; or `px`…, `pos_x`…, `position_x`…, `points:0`… |
| `bases` and `tops` | `x0`, `y0`, `z0` and `x1`, `y1`, `z1`; or `x1`… and `x2`…; `base_x`… and `top_x`…; `start_x`… and `end_x`…; `ax`… and `bx`… |
| `radius` | `radius`, `r` (unless there is a `g`), or `size` |
| `top_radius` | `top_radius` |
| `colors` | `red`, `green`, `blue`; or `r`, `g`, `b`; `color_r`… |
| `rotations` | `rx`, `ry`, `rz`; or `rot_x`…, `rotation_x`… |
| `scale` | `scale`, `size` or `s` |

A file with just as many columns as the field takes needs no names. As `file:` of particles, a table without names may have
3 columns for each point, then a radius, then a color; the last two may be missing.

Colors in files are linear, from 0 to 1; but bytes are sRGB from 0 to 255, and so are other numbers if all of them are whole
and one is above 1.

Atoms get the radius and color of their element, unless the file has columns for them: the covalent radius in ångström
(Cordero et al. 2008), with which bonded atoms just touch, and the color that Jmol gives them. What is no element becomes a
pink ball of radius 1.

Numbers that are infinite or not a number are refused. Tables have at most 1000 columns.
";

const MATERIALS: &str = "
```yaml
materials:
  red: {color: red, specular: 0.5}                # a classic one: fields
  gold: {metal: {of: gold, roughness: 0.2}}       # a physical one: the word of its kind, and in it the fields
  lamp: {color: black, emission: [5, 4, 3]}
```
";

const LIMITS: &str = "## Limits

Coordinates and lengths are at most 1e12 in size; radii, widths and distances are at least 1e-9; directions are at
least 1e-9 long. Transforms must be reversible, also all together: no step may flatten or stretch space by more than a
factor of 1e9. Pictures have at most 65535 pixels a side and 400 million in all. Objects nest at most 64 deep, textures
at most 32. Instances place at most 20 million things, of which a mesh is one, and so is a set of particles. A ray may split into at most 100 million rays; `max_depth` and `min_weight` bound how many it can become.
Images, models and data files must lie in the folder of the scene file or in one given by `--allow-path`.
";

/// The reference page, in Markdown.
pub fn reference_markdown() -> String {
    let mut page = OPENING.to_owned();
    section(&mut page, 2, "The file", "", &SceneFile::about());
    section(
        &mut page,
        2,
        "`camera`",
        "Only one of `fov`, `image_plane` and `orthographic` can be given.",
        &Camera::about(),
    );
    page += "\n`image_plane: {distance: 12.5, half_height: 10}` is the angle of view of a picture of that height at that\n\
             distance; `orthographic: {height: 4}` shows that height in parallel projection. Both fields are required.\n";
    section(&mut page, 3, "`lens`", "One of `radius` and `f_number` must be given.", &lens_about());
    section(&mut page, 2, "`picture`", "", &Picture::about());
    words(&mut page, "transfer", &Transfer::kinds());
    words(&mut page, "tone_mapping", &ToneMapping::kinds());
    section(&mut page, 2, "`render`", "", &RenderSettings::about());
    family(&mut page, "`integrator`", "", &Integrator::kinds(), &[]);
    family(&mut page, "`antialias`", "", &Antialias::kinds(), &[]);
    family(&mut page, "`filter` of the picture", "", &PixelFilter::kinds(), &[]);
    let about = "As a picture of all that is around.";
    section(&mut page, 2, "`background`", about, &Environment::about());
    family(&mut page, "`fog`", "", &Fog::kinds(), &[]);
    family(&mut page, "Lights", "Items of `lights:`.", &LightKind::kinds(), &Shine::about());
    words(&mut page, "falloff", &Falloff::kinds());
    family(&mut page, "Objects", "Items of `objects:`.", &super::objects::kinds(), &Placing::about());
    words(&mut page, "normals", &MeshNormals::kinds());
    let about = "Items of `parts:` of a mesh.";
    section(&mut page, 3, "`parts`", about, &MeshPart::about());
    page += DATA;
    transforms(&mut page);
    let about = "Named under `materials:`, or written at `material:`.";
    section(&mut page, 2, "Materials", about, &[]);
    page += MATERIALS;
    section(&mut page, 3, "All materials", "", &Common::about());
    section(&mut page, 3, "`emission`", "If it is more than a color or texture.", &Emission::about());
    words(&mut page, "sides", &Sides::kinds());
    section(&mut page, 3, "`normal_map`", "If it is more than a texture.", &NormalMap::about());
    section(&mut page, 3, "`bump`", "", &Bump::about());
    section(&mut page, 3, "Classic materials", "Without a word for their kind.", &Classic::about());
    family(&mut page, "Physical materials", "The kind is a word with fields.", &Physical::kinds(), &[]);
    let metals: Vec<String> = MetalName::WORDS.iter().map(|(word, _)| format!("`{word}`")).collect();
    let _ = writeln!(page, "\nThe metals are {}.", metals.join(", "));
    section(&mut page, 3, "`attenuation`", "", &Attenuation::about());
    let about = "Named under `textures:`, or written where a color may stand.";
    family(&mut page, "Textures", about, &Pattern::kinds(), &textures::Placing::about());
    words(&mut page, "space", &Space::kinds());
    words(&mut page, "wrap", &Wrap::kinds());
    words(&mut page, "filter", &Filter::kinds());
    words(&mut page, "encoding", &Encoding::kinds());
    words(&mut page, "channels", &Channels::kinds());
    words(&mut page, "mapping", &Mapping::kinds());
    page + "\n" + LIMITS
}

fn section(page: &mut String, level: usize, title: &str, about: &str, fields: &[FieldAbout]) {
    let _ = writeln!(page, "\n{} {title}\n", "#".repeat(level));
    if !about.is_empty() {
        let _ = writeln!(page, "{about}\n");
    }
    table(page, fields);
}

fn table(page: &mut String, fields: &[FieldAbout]) {
    if fields.is_empty() {
        return;
    }
    *page += "| field | type | default | |\n|---|---|---|---|\n";
    for FieldAbout { key, about, noun, schema, default } in fields {
        let default = match default {
            DefaultAbout::Required => "*required*".to_owned(),
            DefaultAbout::SameAs(other) => format!("as `{other}`"),
            DefaultAbout::Value(Out::Null) => "–".to_owned(),
            DefaultAbout::Value(Out::Text(words)) => words.clone(),
            // Things by name: none of them.
            DefaultAbout::Value(Out::Fields(_)) if schema["additionalProperties"].is_object() => "`{}`".to_owned(),
            DefaultAbout::Value(Out::Fields(fields)) if fields.is_empty() => "all defaults".to_owned(),
            DefaultAbout::Value(value) => format!("`{}`", value.to_flow()),
        };
        let _ = writeln!(page, "| `{key}` | {noun} | {default} | {about} |");
    }
}

fn family(page: &mut String, title: &str, about: &str, kinds: &[KindAbout], common: &[FieldAbout]) {
    let _ = writeln!(page, "\n## {title}");
    if !about.is_empty() {
        let _ = writeln!(page, "\n{about}");
    }
    if !common.is_empty() {
        *page += "All have these fields beside their own:\n\n";
        table(page, common);
    }
    for KindAbout { word, about, example, fields } in kinds {
        let dash = if title == "Lights" || title == "Objects" { "- " } else { "" };
        let _ = writeln!(page, "\n### `{word}`\n\n{about}\n\n```yaml\n{dash}{example}\n```");
        if !fields.is_empty() {
            *page += "\n";
        }
        table(page, fields);
    }
}

fn words(page: &mut String, title: &str, kinds: &[KindAbout]) {
    let _ = writeln!(page, "\n`{title}` is one of\n");
    for KindAbout { word, about, fields, .. } in kinds {
        let fields: Vec<String> = fields.iter().map(|field| format!("{}: {}", field.key, field.noun)).collect();
        match fields.is_empty() {
            true => _ = writeln!(page, "* `{word}`: {about}"),
            false => _ = writeln!(page, "* `{word}: {{{}}}`: {about}", fields.join(", ")),
        }
    }
}

fn transforms(page: &mut String) {
    let noun = <durer_scene::Transform as Value>::noun();
    let _ = writeln!(page, "\n## `transform`\n\nIs {noun}, applied one after the other, the first one first:\n");
    for (word, about, example) in STEPS {
        let _ = writeln!(page, "* `{word}`: {about} `{example}`");
    }
    *page += "\n`rotate` takes `{x: 90}`, `{y: 90}`, `{z: 90}`, or any axis: `{axis: [1, 1, 0], angle: 90}`.\n\n\
              ```yaml\ntransform: [scale: [1.3, 0.8, 1], rotate: {y: 15}, translate: [8.5, -4.6, -47]]\n```\n";
}

//! durer's own scene language: YAML (and so JSON) to [`Scene`](durer_scene::Scene) and back.
//!
//! Text becomes a tree whose values know their places (`parse`, `tree`); the tree becomes a scene (`file` and the
//! families `objects`, `lights` …, each field defined once by the macros of `record`); the same definitions write
//! scenes (`write`), and make the JSON Schema and the reference page.

mod camera;
mod colors;
mod decode;
mod file;
mod hints;
mod images;
mod instances;
mod lights;
mod lists;
mod materials;
mod meshes;
mod models;
mod names;
mod objects;
mod paint;
mod parse;
mod particles;
mod place;
mod record;
mod reference;
mod schema;
mod settings;
pub(crate) mod suggest;
mod surfaces;
mod syntax;
mod tables;
mod textures;
mod transform;
pub(crate) mod tree;
mod value;
mod write;

pub use reference::reference_markdown;
pub use schema::json_schema;

use crate::diagnostics::Complaint;
use crate::{Assets, Limits, Overlay};
use decode::Decoder;
use durer_scene::{CheckedScene, Picture, Place, RenderSettings, Scene, Step};
use std::collections::BTreeSet;
use tree::Span;

/// A scene, and the settings that its file has under those that were laid over them.
type Read = (CheckedScene, (Picture, RenderSettings));

/// Reads and checks a scene; complaints may be warnings only, and then there is a scene.
pub(crate) fn load(text: &str, files: (&dyn Assets, &Limits), overlay: &dyn Overlay) -> (Option<Read>, Vec<Complaint>) {
    let (scene, complaints) = load_tree(text, files, overlay);
    (scene, complaints.into_iter().map(|complaint| complaint.help_from_line(text, hints::unquoted_color)).collect())
}

fn load_tree(
    text: &str,
    (assets, limits): (&dyn Assets, &Limits),
    overlay: &dyn Overlay,
) -> (Option<Read>, Vec<Complaint>) {
    let mut complaints = Vec::new();
    let Some(root) = parse::parse(text, limits, &mut complaints) else {
        if complaints.is_empty() {
            let complaint = Complaint::error(Span::new(0, 0), "this file is empty");
            complaints.push(complaint.help("a scene needs objects: `objects: [sphere: {radius: 1}]`"));
        }
        return (None, complaints);
    };
    if root.is_null() {
        let complaint = Complaint::error(Span::new(0, 0), "there is nothing in this file");
        return (None, vec![complaint.help("a scene needs objects: `objects: [sphere: {radius: 1}]`")]);
    }
    let mut decoder = Decoder::new(assets, limits);
    decoder.complaints = complaints;
    file::read(&root, &mut decoder);
    images::warn_of_ignored_alpha(&mut decoder);
    let mut scene = std::mem::take(&mut decoder.scene);
    let written = (scene.picture, scene.render);
    overlay.lay_over(&mut scene.picture, &mut scene.render);
    let render = scene.render;
    let mut complaints = std::mem::take(&mut decoder.complaints);
    let given_elsewhere = settings::places().filter(|place| overlay.name_of(place, &render).is_some());
    let laid_over: Vec<Span> = given_elsewhere.filter_map(|place| place::whole_span_of(&place, &root)).collect();
    match scene.check() {
        Ok(scene) => {
            decoder.refuse_those_beyond(&laid_over, &mut complaints);
            let place = Place { steps: ["render", "integrator"].map(Step::Field).into() };
            let chosen_by = overlay.name_of(&place, &render);
            settings::warn_of_unused(&root, &render.integrator, chosen_by.as_deref(), &mut complaints);
            // What is not there because it could not be read is not missed.
            if !complaints.iter().any(Complaint::is_error) {
                for remark in scene.remarks() {
                    let span = place::span_of(&remark.place, &root, &decoder);
                    complaints.push(match overlay.name_of(&remark.place, &render) {
                        Some(name) => Complaint::of_overlay(name, remark).into_warning(),
                        None => Complaint::warning(span, remark.message).maybe_help(remark.help),
                    });
                }
            }
            let usable = !complaints.iter().any(Complaint::is_error);
            (usable.then_some((scene, written)), complaints)
        }
        Err(problems) => {
            let unread: BTreeSet<usize> =
                complaints.iter().filter(|one| one.is_error()).map(Complaint::start).collect();
            for problem in problems.into_iter().take(decode::MOST_COMPLAINTS) {
                if let Some(name) = overlay.name_of(&problem.place, &render) {
                    complaints.push(Complaint::of_overlay(name, problem));
                    continue;
                }
                let span = place::span_of(&problem.place, &root, &decoder);
                let doubtful = |near: &Span| near.start <= span.start && span.end <= near.end;
                // What is wrong with a value by itself is certain if it could be read.
                let is_certain =
                    problem.is_of_one_value && unread.range(span.start..span.end.max(span.start + 1)).next().is_none();
                if !is_certain && decoder.doubtful.iter().any(doubtful) {
                    continue;
                }
                let message = decoder.as_written(problem.message, span);
                complaints.push(Complaint::error(span, message).maybe_help(problem.help));
            }
            decoder.refuse_those_beyond(&laid_over, &mut complaints);
            (None, complaints)
        }
    }
}

/// The scene as a scene file. Reading it gives an equal scene, if every texture and material has a name of its own;
/// those without are written where they are used, or get a name if they are used several times. Meant for scenes that
/// pass [`Scene::check`]; what is wrong with others is written as it is.
pub fn to_yaml(scene: &Scene) -> String {
    write(scene, (scene.picture, scene.render))
}

/// As [`to_yaml`], with these settings in place of its own.
pub(crate) fn write(scene: &Scene, settings: (Picture, RenderSettings)) -> String {
    file::write(scene, settings)
}

#[cfg(test)]
mod tests {
    use super::record::{Choice, KindAbout};
    use super::*;
    use crate::{NoAssets, load_str};
    use durer_imaging::ToneMapping;
    use durer_scene::{Antialias, Fog, Integrator, LightKind, MetalName, Pattern};

    #[track_caller]
    fn assert_loads(text: &str) {
        if let Err(diagnostics) = load_str(text, "example", &NoAssets, &Limits::default()) {
            panic!("{diagnostics}");
        }
    }

    #[test]
    fn the_examples_of_the_reference_load() {
        let each = |kinds: Vec<KindAbout>, around: &dyn Fn(&str) -> String| {
            // These need a file.
            let examples = kinds.iter().filter(|kind| !matches!(kind.word, "image" | "import"));
            examples.for_each(|kind| assert_loads(&around(kind.example)));
        };
        each(objects::kinds(), &|example| format!("objects:\n  - {example}"));
        each(LightKind::kinds(), &|example| format!("lights:\n  - {example}"));
        each(Pattern::kinds(), &|example| format!("textures:\n  a:\n    {example}"));
        each(Antialias::kinds(), &|example| format!("render:\n  {example}"));
        each(Fog::kinds(), &|example| example.to_owned());
        each(Integrator::kinds(), &|example| format!("render:\n  {example}"));
        each(ToneMapping::kinds(), &|example| format!("picture:\n  {example}"));
        each(surfaces::Physical::kinds(), &|example| format!("materials:\n  a:\n    {example}"));
        each(MetalName::kinds(), &|example| format!("materials: {{a: {{metal: {{{example}}}}}}}"));
        for (_, _, example) in transform::STEPS {
            assert_loads(&format!("objects:\n  - sphere:\n      transform:\n        - {example}"));
        }
        for start in ["camera", "materials"] {
            for block in reference_markdown().split(&format!("```yaml\n{start}")).skip(1) {
                assert_loads(&format!("{start}{}", block.split("```").next().unwrap_or_default()));
            }
        }
    }

    #[test]
    fn schema_defaults_are_json_values() {
        let schema = json_schema();
        assert_eq!(schema["properties"]["picture"]["properties"]["width"]["default"], 640);
        assert_eq!(schema["$defs"]["material"]["anyOf"][0]["properties"]["shininess"]["default"], 40);
    }
}

//! A model file in place of a scene file: read, staged and checked.

use super::{FilePlace, ModelError, read, stage::stage};
use crate::diagnostics::Complaint;
use crate::native::tree::Span;
use crate::sources::Remembering;
use crate::{Assets, Diagnostics, Limits, Loaded, Overlay};
use durer_scene::{Problem, Step};

/// Reads a model, which messages call `name`, and makes a scene that shows it; `assets` are the files beside it.
///
/// # Errors
///
/// What is wrong with it.
pub(crate) fn load(
    bytes: &[u8],
    name: &str,
    (assets, limits): (&dyn Assets, &Limits),
    overlay: &dyn Overlay,
) -> Result<Loaded, Diagnostics> {
    // As the model's own folder sees it.
    let file = name.rsplit(['/', '\\']).next().unwrap_or(name);
    let assets = Remembering::new(assets);
    assets.remember(file, bytes);
    let model = read(file, bytes, &assets, limits).map_err(|error| diagnostics_of(error, bytes, name, limits))?;
    let warning = |message: &str| Complaint::warning(Span::default(), format!("in {file}: {message}"));
    let mut warnings: Vec<Complaint> = model.warnings.iter().map(|message| warning(message)).collect();
    if model.scene.primitives().total() == 0 {
        warnings.push(warning("there is nothing to see in this model"));
    }
    let mut scene = stage(model.scene, file);
    let written = (scene.picture, scene.render);
    overlay.lay_over(&mut scene.picture, &mut scene.render);
    let render = scene.render;
    match scene.check() {
        Ok(scene) => {
            // Which nodes of a model are empty is its own affair.
            let is_of_objects = |remark: &Problem| remark.place.steps.first() == Some(&Step::Field("objects"));
            let remarks = scene.remarks().into_iter().filter(|remark| !is_of_objects(remark));
            warnings.extend(remarks.map(|remark| match overlay.name_of(&remark.place, &render) {
                Some(name) => Complaint::of_overlay(name, remark).into_warning(),
                None => warning(&remark.message).maybe_help(remark.help),
            }));
            let warnings = Diagnostics::new(warnings, name, "", limits.max_diagnostics);
            Ok(Loaded { scene, warnings, sources: assets.into_sources(), written })
        }
        Err(problems) => {
            let complaint = |problem: Problem| {
                if let Some(name) = overlay.name_of(&problem.place, &render) {
                    return Complaint::of_overlay(name, problem);
                }
                let message = format!("in {file}, {}: {}", problem.place, problem.message);
                Complaint::error(Span::default(), message).maybe_help(problem.help)
            };
            let complaints = problems.into_iter().take(limits.max_diagnostics).map(complaint).collect();
            Err(Diagnostics::new(complaints, name, "", limits.max_diagnostics))
        }
    }
}

/// What is wrong, with the line that it is about if it has one.
fn diagnostics_of(error: ModelError, bytes: &[u8], name: &str, limits: &Limits) -> Diagnostics {
    let file = name.rsplit(['/', '\\']).next().unwrap_or(name);
    let (text, span, message) = match error.place {
        Some(FilePlace::Line(line)) if bytes.len() as u64 <= limits.max_bytes => {
            let (text, span) = text_up_to_line(bytes, line);
            (text, span, format!("in {file}, {}", error.message))
        }
        Some(place) => (String::new(), Span::default(), format!("in {file}, at {place}: {}", error.message)),
        None => (String::new(), Span::default(), format!("in {file}: {}", error.message)),
    };
    let complaint = Complaint::error(span, message).maybe_help(error.help);
    Diagnostics::new(vec![complaint], name, &text, 1)
}

/// The text of a file up to the end of a line, and the place of that line in it. What follows may not even be text.
fn text_up_to_line(bytes: &[u8], line: usize) -> (String, Span) {
    let mut ends = (0..).zip(bytes).filter(|(_, byte)| **byte == b'\n').map(|(at, _)| at);
    let end = ends.nth(line - 1).unwrap_or(bytes.len());
    let text = String::from_utf8_lossy(&bytes[..end]).into_owned();
    let start = text.rfind('\n').map_or(0, |newline| newline + 1);
    let shown = text[start..].trim();
    let from = start + text[start..].find(shown).unwrap_or(0);
    let span = Span::new(from, from + shown.len());
    (text, span)
}

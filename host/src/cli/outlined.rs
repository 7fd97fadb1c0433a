//! A look at a scene as text, as JSON and as a plan to draw.

use std::fmt::Write as _;

use serde_json::{Value as Json, json};

use signorini_draw::{BoundaryKind, Plan, PlanBoundary, PlanKind, ScenePanel, plain};
use signorini_problem::outline::{BoundaryGroup, HeldPart, Outline};
use signorini_scene::error::{Error, InputError};
use signorini_scene::mesh::Mesh;
use signorini_scene::scene::{Input, Output, Scene};

use super::look::Look;

/// The look as a person reads it.
pub(super) fn text(look: &Look) -> String {
    let scene = &look.draft.scene;
    let mut text = scene.title.clone();
    if let Some((mesh, outline)) = &look.on_mesh {
        let cells = format!("{} triangles, {} quads", mesh.triangles.len(), mesh.quads.len());
        let _ = write!(text, "\n  mesh      {}: {cells}", scene.mesh.value.display());
        text.push_str(&groups(outline));
    }
    // Where the scene has no such table, there is no place of it.
    if !scene.source.span.is_empty() {
        let source = [format!("f = {}", scene.source.value), String::new(), String::new()];
        text.push_str(&rows("source", vec![source]));
    }
    let inputs = scene.inputs.iter().map(|input| {
        let range = input.range.as_ref().map(|range| range.value);
        let range = range.map_or_else(String::new, |[lo, hi]| format!(", from {lo} to {hi}"));
        let place = format!("{} of {}", input.field.value.name(), input.of.value);
        [input.name.value.clone(), place, format!("default {}{range}", input.default)]
    });
    let outputs = scene.outputs.iter().map(|output| {
        [output.name.value.clone(), output.quantity.kind().to_owned(), place_of(output)]
    });
    let end = match look.faults.is_empty() {
        true => "\nIt can be solved: `signorini solve` does.",
        false => "",
    };
    text + &rows("input", inputs.collect()) + &rows("output", outputs.collect()) + end
}

fn groups(outline: &Outline) -> String {
    let boundaries = outline.boundaries.iter().map(|of| {
        let turn = of.turn.map_or_else(String::new, |turn| {
            format!("; they turn by up to {turn:.0}°: what is guaranteed is so for them, and not for a curve")
        });
        let size = format!("length {}, {} edges{turn}", plain(of.length), of.edges);
        let kind = of.kind.unwrap_or("?");
        let law = of.law.as_ref().map_or_else(String::new, |law| format!(": {law}"));
        [of.name.clone(), format!("{kind}{law}"), size]
    });
    let materials = outline.materials.iter().map(|of| {
        let size = format!("area {}, {} cells", plain(of.area), of.cells);
        let conductivity = of.conductivity.as_ref().map_or("?".to_owned(), |of| of.join(", "));
        [of.name.clone(), format!("A = {conductivity}"), size]
    });
    let parts = outline
        .parts
        .iter()
        .enumerate()
        .map(|(at, part)| [(at + 1).to_string(), held(part), format!("{} cells", part.cells)]);
    rows("material", materials.collect())
        + &rows("boundary", boundaries.collect())
        + &rows("part", parts.collect())
}

fn held(part: &HeldPart) -> String {
    match (&part.held_by[..], part.by_contact_alone) {
        ([], _) => "held by nothing: u is determined up to a constant".to_owned(),
        (by, false) => format!("held by {}", by.join(", ")),
        (by, true) => format!("held by contact alone: {}", by.join(", ")),
    }
}

/// Rows in columns, the first with what they are.
fn rows(what: &str, rows: Vec<[String; 3]>) -> String {
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max();
    let [first, second] = [0, 1].map(|column| width(column).unwrap_or(0));
    rows.iter().enumerate().fold(String::new(), |mut text, (at, [a, b, c])| {
        let what = if at == 0 { what } else { "" };
        let row = format!("  {what:<8}  {a:<first$}  {b:<second$}  {c}");
        let _ = write!(text, "\n{}", row.trim_end());
        text
    })
}

/// What an output is taken over.
fn place_of(output: &Output) -> String {
    let what = if output.quantity.is_inside() { "material" } else { "boundary" };
    output.place("", |name| format!("{what} {name}"))
}

/// The look as a program reads it.
pub(super) fn json(look: &Look) -> Json {
    let scene = &look.draft.scene;
    let mesh = look.on_mesh.as_ref().map(|(mesh, _)| {
        json!({
            "file": scene.mesh.value.display().to_string(),
            "vertices": mesh.vertices.len(), "triangles": mesh.triangles.len(), "quads": mesh.quads.len(),
        })
    });
    let outline = look.on_mesh.as_ref().map(|(_, outline)| outline);
    json!({
        "title": scene.title,
        "can_be_solved": look.faults.is_empty(),
        "mesh": mesh,
        "boundaries": outline.map(|of| &of.boundaries),
        "materials": outline.map(|of| &of.materials),
        "parts": outline.map(|of| &of.parts),
        "source": scene.source.value.to_string(),
        "inputs": scene.inputs.iter().map(input_json).collect::<Vec<_>>(),
        "outputs": scene.outputs.iter().map(output_json).collect::<Vec<_>>(),
        "warnings": look.warnings,
        "faults": look.faults.iter().map(fault).collect::<Vec<_>>(),
    })
}

/// A file that is no scene at all, as a program reads it.
pub(super) fn unreadable(error: Error) -> Json {
    let faults = match &error {
        Error::Input(fault) => vec![self::fault(fault)],
        other @ (Error::Io { .. } | Error::Check(_)) => {
            vec![json!({ "message": other.to_string() })]
        }
    };
    json!({ "can_be_solved": false, "faults": faults })
}

fn fault(fault: &InputError) -> Json {
    let (file, line) = fault.place();
    json!({
        "file": file.map(|file| file.display().to_string()),
        "line": line,
        "key": fault.key(),
        "message": fault.message(),
        "hint": fault.said_hint(),
    })
}

fn input_json(input: &Input) -> Json {
    json!({
        "name": input.name.value,
        "of": input.of.value,
        "field": input.field.value.name(),
        "default": input.default,
        "range": input.range.as_ref().map(|range| range.value),
        "unit": input.unit,
    })
}

fn output_json(output: &Output) -> Json {
    json!({
        "name": output.name.value,
        "kind": output.quantity.kind(),
        "of": output.of.iter().map(|of| &of.value).collect::<Vec<_>>(),
        "unit": output.unit,
    })
}

/// The plan of a scene on its mesh.
pub(super) fn plan(scene: &Scene, mesh: &Mesh, outline: &Outline) -> Plan {
    let boundary = |of: &BoundaryGroup| PlanBoundary {
        name: of.name.clone(),
        kind: plan_kind(of.kind),
        edges: of.of.clone(),
    };
    let panel = ScenePanel {
        title: scene.title.clone(),
        vertices: mesh.vertices.clone(),
        triangles: mesh.triangles.clone(),
        quads: mesh.quads.clone(),
        ..ScenePanel::default()
    };
    let materials = outline.materials.iter().map(|of| (of.name.clone(), of.of.clone()));
    let boundaries = outline.boundaries.iter().filter(|of| of.edges > 0).map(boundary);
    Plan { panel, boundaries: boundaries.collect(), materials: materials.collect() }
}

fn plan_kind(kind: Option<&str>) -> PlanKind {
    match kind {
        Some("dirichlet") => PlanKind::Prescribed(BoundaryKind::Dirichlet),
        Some("neumann") => PlanKind::Prescribed(BoundaryKind::Neumann),
        Some("robin") => PlanKind::Prescribed(BoundaryKind::Robin),
        Some(_) => PlanKind::Contact,
        None => PlanKind::Open,
    }
}

//! The columns of the condensed model: whose full fields everything is read off.

use signorini_kernel::mesh::geometry::{quad_area, triangle_area};

use super::elimination::FieldLoads;
use signorini_certify::TermData;
use signorini_problem::{Loads, Problem};

/// Loads and openings of each column: patterns without opening, unit openings without load, and a source
/// that adds up to 1 on these cells, where asked for.
pub(super) fn columns(
    problem: &Problem,
    patterns: &[TermData],
    edges: &[usize],
    source: Option<&[bool]>,
) -> Vec<FieldLoads> {
    let counts = problem.topology.counts;
    let of_patterns = patterns.iter().map(|pattern| FieldLoads {
        contact: pattern.loads().gap.clone(),
        loads: pattern.loads().clone(),
    });
    let mut columns: Vec<_> = of_patterns.collect();
    let silent = silent(problem);
    for &opened in edges {
        let mut contact = vec![0.0; counts.contact];
        contact[opened] = 1.0;
        columns.push(FieldLoads { loads: silent.clone(), contact });
    }
    if let Some(cells) = source {
        let contact = vec![0.0; counts.contact];
        columns.push(FieldLoads { loads: uniform_source(problem, cells, silent), contact });
    }
    columns
}

/// No load at all.
pub(super) fn silent(problem: &Problem) -> Loads {
    let counts = problem.topology.counts;
    let mut silent = Loads {
        robin: problem.loads.robin.clone(),
        contact_flux: vec![0.0; counts.contact],
        gap: vec![0.0; counts.contact],
        dirichlet: vec![0.0; counts.dirichlet],
        ..Loads::default()
    };
    silent.robin.iter_mut().for_each(|record| record.ambient = 0.0);
    silent
}

/// `silent` with a source that adds up to 1, the same all over `cells`.
fn uniform_source(problem: &Problem, cells: &[bool], silent: Loads) -> Loads {
    let mesh = &problem.mesh;
    let corner = |vertex: u32| mesh.vertices[vertex as usize];
    let (of_triangles, of_quads) = cells.split_at(mesh.triangles.len());
    let on = |area: f64, here: &bool| if *here { area } else { 0.0 };
    let areas = mesh.triangles.iter().map(|cell| triangle_area(cell.map(corner)));
    let triangles: Vec<f64> = areas.zip(of_triangles).map(|(area, here)| on(area, here)).collect();
    let areas = mesh.quads.iter().map(|cell| quad_area(cell.map(corner)));
    let quads: Vec<f64> = areas.zip(of_quads).map(|(area, here)| on(area, here)).collect();
    let whole: f64 = triangles.iter().chain(&quads).sum();
    let share = |areas: Vec<f64>| areas.into_iter().map(|area| area / whole).collect();
    Loads { triangles: share(triangles), quads: share(quads), ..silent }
}

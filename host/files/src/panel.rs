//! A solved scene as it is drawn; its contact boundary is one line, its edges in the order of a walk.

use std::collections::HashMap;

use super::contact::state;
use super::fields::Drawn;
use signorini_certify::ErrorBound;
use signorini_draw::{BoundTerms, BoundaryEdge, BoundaryKind, ContactEdge, ScenePanel};
use signorini_problem::{EdgeKind, Problem};
use signorini_scene::scene::Condition;
use signorini_solve::{Solution, energy_norm};

/// Points per edge at which the exact multiplier is drawn.
const SAMPLES: usize = 9;

/// The panel of a solution, without what checks and outputs have to say.
pub fn panel(problem: &Problem, solution: &Solution) -> ScenePanel {
    let (_, cell_flux) = Drawn::plain(solution).in_cells(problem);
    let norm = energy_norm::of_solution(problem, solution).ok().flatten();
    ScenePanel {
        title: problem.scene.title.clone(),
        is_test: problem.scene.exact.is_some(),
        vertices: problem.mesh.vertices.clone(),
        triangles: problem.mesh.triangles.clone(),
        quads: problem.mesh.quads.clone(),
        vertex_u: solution.certified.vertices.clone(),
        cell_flux,
        indicators: solution.certified.indicators.clone(),
        bound: solution.bound.map(terms),
        no_bound: solution.no_bound.as_ref().map(ToString::to_string),
        energy: (norm.unwrap_or(f64::NAN), energy_norm::name(problem)),
        contact: walk(problem, solution),
        boundary: boundary(problem),
        ..ScenePanel::default()
    }
}

fn terms(bound: ErrorBound) -> BoundTerms {
    let ErrorBound { total, of_u, duality_gap: gap, algebraic, oscillation, rounding, .. } = bound;
    BoundTerms { total, of_u, gap, algebraic, oscillation, rounding }
}

/// A contact edge, `reversed` where it is walked against its direction, and the arc length where it begins.
fn contact_edge(
    problem: &Problem,
    solution: &Solution,
    contact: usize,
    (reversed, start): (bool, f64),
) -> ContactEdge {
    let edge = problem.topology.counts.free + contact;
    let opening = solution.u[edge] - solution.gap(problem, contact);
    let mut ends = problem.segment(edge);
    if reversed {
        ends.reverse();
    }
    let boundary = problem.boundary_of(edge).map(|of| of.name.value.clone());
    ContactEdge {
        boundary: boundary.unwrap_or_default(),
        ends,
        arc_length: [start, start + problem.lengths[edge]],
        state: state(problem, solution, contact),
        multiplier: solution.multiplier(problem, contact),
        exact_multiplier: exact_multiplier(problem, edge, ends).unwrap_or_default(),
        opening,
    }
}

/// A∇u·n − q of the exact solution along an edge walked from `ends`\[0\].
fn exact_multiplier(problem: &Problem, edge: usize, ends: [[f64; 2]; 2]) -> Option<Vec<f64>> {
    let exact = problem.scene.exact.as_ref()?;
    let Condition::Contact { flux, .. } = &problem.boundary_of(edge)?.condition else {
        return None;
    };
    let (cell, _) = problem.topology.first_side(edge);
    let material = &problem.scene.materials[problem.binding.materials[cell] as usize];
    let ([a, b], length) = (problem.segment(edge), problem.lengths[edge]);
    let normal = [(b[1] - a[1]) / length, (a[0] - b[0]) / length];
    let at = |sample: usize| {
        let t = sample as f64 / (SAMPLES - 1) as f64;
        let [x, y] = [0, 1].map(|k| ends[0][k] + t * (ends[1][k] - ends[0][k]));
        let [ux, uy] = exact.gradient.each_ref().map(|entry| entry.value.eval(x, y, problem.time));
        let [xx, xy, yy] = material.conductivity.each_ref().map(|a| a.value.eval(x, y, 0.0));
        let outward = (xx * ux + xy * uy) * normal[0] + (xy * ux + yy * uy) * normal[1];
        outward - flux.value.eval(x, y, problem.time)
    };
    Some((0..SAMPLES).map(at).collect())
}

fn boundary(problem: &Problem) -> Vec<BoundaryEdge> {
    let edges = problem.kinds.iter().enumerate();
    let drawn = edges.filter_map(|(edge, kind)| {
        let kind = match kind {
            EdgeKind::Dirichlet => BoundaryKind::Dirichlet,
            EdgeKind::Neumann => BoundaryKind::Neumann,
            EdgeKind::Robin => BoundaryKind::Robin,
            EdgeKind::Interior | EdgeKind::Contact => return None,
        };
        Some(BoundaryEdge { ends: problem.segment(edge), kind })
    });
    drawn.collect()
}

/// The contact edges by arc length; separate pieces of the boundary follow one another.
fn walk(problem: &Problem, solution: &Solution) -> Vec<ContactEdge> {
    let counts = problem.topology.counts;
    let ends = |contact: usize| problem.ends[counts.free + contact];
    let mut at_vertex: HashMap<u32, Vec<usize>> = HashMap::new();
    for contact in 0..counts.contact {
        ends(contact).iter().for_each(|&v| at_vertex.entry(v).or_default().push(contact));
    }
    // Pieces with two ends are begun at the end from which the domain lies on the left.
    let is_end = |contact: &usize| at_vertex[&ends(*contact)[0]].len() == 1;
    let all = 0..counts.contact;
    let starts = all.clone().filter(is_end).chain(all);
    let mut used = vec![false; counts.contact];
    let mut line = Vec::new();
    let mut length = 0.0;
    for first in starts {
        let mut from = ends(first)[0];
        let mut next = Some(first).filter(|&first| !used[first]);
        while let Some(contact) = next {
            used[contact] = true;
            let reversed = ends(contact)[0] != from;
            line.push(contact_edge(problem, solution, contact, (reversed, length)));
            length += problem.lengths[counts.free + contact];
            from = ends(contact)[usize::from(!reversed)];
            next = at_vertex[&from].iter().copied().find(|&other| !used[other]);
        }
    }
    line
}

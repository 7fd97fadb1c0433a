//! `edges.csv`: one line an edge, in the order of the kernel's unknowns.

use super::contact::{state, written};
use signorini_problem::threads::on_two_threads;
use signorini_problem::{EdgeKind, Problem};
use signorini_scene::error::{Error, Result};
use signorini_solve::{ScalarKind, Solution};

/// Edges that a thread writes at a time.
const PORTION: usize = 16_384;

/// The columns.
const COLUMNS: &str =
    "x0,y0,x1,y1,kind,u_mean,flux_normal,boundary,psi,q,limit,lambda,state,left,right";

/// The text of `edges.csv`.
///
/// The normal is the direction (x0, y0) → (x1, y1) turned clockwise, outward on the boundary: out of cell `left`, into cell
/// `right` (triangles first, as in `solution.vtu`), which is empty on the boundary. psi to state are empty but on contact
/// edges: mean gap, the least and the largest σ·n, how far σ·n is from the one that u ≥ ψ goes with, and where u is.
///
/// # Errors
/// Never for a solution of this problem.
pub fn edges_csv(problem: &Problem, solution: &Solution) -> Result<Vec<u8>> {
    let edges = problem.ends.len();
    let starts: Vec<usize> = (0..edges).step_by(PORTION).collect();
    let rows = |&start: &usize| {
        let rows = start..edges.min(start + PORTION);
        rows_of(problem, solution, rows)
            .map_err(|error| Error::Check(format!("edges.csv: {error}")))
    };
    let mut portions = on_two_threads(&starts, rows, || ())?;
    portions.insert(0, format!("{COLUMNS}\n").into_bytes());
    Ok(portions.concat())
}

fn rows_of(
    problem: &Problem,
    solution: &Solution,
    edges: std::ops::Range<usize>,
) -> csv::Result<Vec<u8>> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for edge in edges {
        let [a, b] = problem.segment(edge);
        let flux = solution.flux[edge] / problem.lengths[edge];
        let numbers = [a[0], a[1], b[0], b[1]].map(|x| x.to_string());
        let kind = problem.kinds[edge].name();
        let (u, flux) = (digits(solution, solution.u[edge]), digits(solution, flux));
        let is_outer = problem.kinds[edge] != EdgeKind::Interior;
        let boundary = problem.boundary_of(edge).filter(|_| is_outer);
        let name = boundary.map_or("", |boundary| &boundary.name.value);
        let [psi, q, limit, lambda, state] = on_contact(problem, solution, edge);
        let [left, right] = cells(problem, edge);
        let rest = [kind, &u, &flux, name, &psi, &q, &limit, &lambda, &state, &left, &right];
        writer.write_record(numbers.iter().map(String::as_str).chain(rest))?;
    }
    writer.into_inner().map_err(|error| error.into_error().into())
}

/// Gap, ends of the flux, λ and state of a contact edge; nothing of others.
fn on_contact(problem: &Problem, solution: &Solution, edge: usize) -> [String; 5] {
    if problem.kinds[edge] != EdgeKind::Contact {
        return Default::default();
    }
    let at = edge - problem.topology.counts.free;
    let (gap, range) = (solution.gap(problem, at), problem.loads.flux_range(at));
    let (state, _) = written(state(problem, solution, at));
    let [least, most] = range.ends().map(|end| digits(solution, end / problem.lengths[edge]));
    let lambda = digits(solution, solution.multiplier(problem, at));
    [digits(solution, gap), least, most, lambda, state.to_owned()]
}

/// The cells on both sides; no second one on the boundary.
fn cells(problem: &Problem, edge: usize) -> [String; 2] {
    problem.topology.cells_of(edge).map(|cell| cell.map_or(String::new(), |at| at.to_string()))
}

/// The shortest text that reads back as the same number of the solution's scalar type; −0 is 0.
fn digits(solution: &Solution, x: f64) -> String {
    let x = x + 0.0;
    match solution.scalar {
        ScalarKind::F64 => format!("{x:?}"),
        ScalarKind::F32 => format!("{:?}", x as f32),
    }
}

//! Full fields behind given values on contact and Dirichlet edges: the free unknowns eliminated.
//!
//! ```text
//!   K_FF u_F = b_F − K_FC u_C − K_FD u_D
//! ```
//! One factorisation serves all patterns of loads and all unit openings. The fluxes of a field are the
//! conservative ones (15); on a contact edge they are the residual of the condensed problem. Everything else is read off the
//! fields of these columns.

use std::iter::repeat;

use signorini_certify::TermData;
use signorini_kernel::mesh::geometry::{quad_area, triangle_area};
use signorini_problem::{Assembled, Loads, Problem};
use signorini_reference::{LinearFactor, ReferenceError};
use signorini_scene::error::{Error, InputError, Result};
use signorini_scene::scene::Scene;
use signorini_solve::unfit;

/// Means of u over the edges, and ∫_E σ·n along their directions.
#[derive(Debug, Clone)]
pub(super) struct Field {
    pub u: Vec<f64>,
    pub flux: Vec<f64>,
}

impl Field {
    pub fn scale(&mut self, factor: f64) {
        self.u.iter_mut().chain(&mut self.flux).for_each(|number| *number *= factor);
    }
}

/// Data of a field: loads, and u on the contact edges.
pub(super) struct FieldLoads {
    pub loads: Loads,
    pub contact: Vec<f64>,
}

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

/// No load at all; a step from where that of `problem` begins.
pub(super) fn silent(problem: &Problem) -> Loads {
    let counts = problem.topology.counts;
    let mut silent = Loads {
        robin: problem.loads.robin.clone(),
        contact_flux: vec![0.0; counts.contact],
        gap: vec![0.0; counts.contact],
        dirichlet: vec![0.0; counts.dirichlet],
        step: problem.loads.step.clone(),
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

/// The edges of the rows that are eliminated: the free edges, then the contact edges that are `open` whatever happens, counted from the
/// first one.
pub(super) fn free_rows(problem: &Problem, open: &[usize]) -> Vec<usize> {
    let free = problem.topology.counts.free;
    // Rows of the matrix have their columns in order.
    let mut edges: Vec<usize> = (0..free).chain(open.iter().map(|edge| free + edge)).collect();
    edges.sort_unstable();
    edges
}

/// The fields of all `given`, in their order, with the contact edges `open` as free as those inside.
///
/// # Errors
/// Numbers out of range, a matrix that is singular to working precision.
pub(super) fn fields(
    problem: &Problem,
    given: &[FieldLoads],
    open: &[usize],
) -> Result<Vec<Field>> {
    let unfit = unfit::<f64>(&problem.scene);
    let mut assembled = Assembled::<f64>::new(problem).map_err(&unfit)?;
    let (counts, rows) = (problem.topology.counts, free_rows(problem, open));
    let mut right = Vec::with_capacity(rows.len() * given.len());
    let mut fields = Vec::with_capacity(given.len());
    for FieldLoads { loads, contact } in given {
        assembled.set_loads(loads).map_err(&unfit)?;
        let system = assembled.system().map_err(&unfit)?;
        let mut u = vec![0.0; counts.free];
        u.extend(contact.iter().chain(&loads.dirichlet));
        rows.iter().for_each(|&edge| u[edge] = 0.0);
        let lacking: Vec<f64> = system
            .matrix()
            .iter()
            .zip(system.load())
            .map(|(row, load)| load - row.dot(&u))
            .collect();
        right.extend(rows.iter().map(|&edge| lacking[edge]));
        fields.push(Field { flux: vec![0.0; u.len()], u });
    }
    // Of a column alone there may be no transfer laws, which the matrix has.
    assembled.set_loads(&problem.loads).map_err(&unfit)?;
    let solved = free_block(&assembled, &rows, &right).map_err(failed(&problem.scene))?;
    let solved = solved.chunks(rows.len().max(1)).map(Some).chain(repeat(None));
    for ((field, FieldLoads { loads, .. }), solved) in fields.iter_mut().zip(given).zip(solved) {
        let solved = rows.iter().zip(solved.unwrap_or_default());
        solved.for_each(|(&edge, &u)| field.u[edge] = u);
        assembled.set_loads(loads).map_err(&unfit)?;
        assembled.recover(&field.u, &[], &mut field.flux).map_err(&unfit)?;
    }
    Ok(fields)
}

/// K_FF⁻¹ of these rows, applied to the columns of `right`.
pub(super) fn free_block(
    assembled: &Assembled<f64>,
    rows: &[usize],
    right: &[f64],
) -> std::result::Result<Vec<f64>, ReferenceError> {
    let malformed = |_| ReferenceError::Malformed("the assembled matrix is not one");
    let system = assembled.system().map_err(malformed)?;
    let mut numbers = vec![None; assembled.edges().counts().edges()];
    rows.iter().zip(0..).for_each(|(&edge, number)| numbers[edge] = Some(number));
    let matrix: Vec<_> = system.matrix().iter().collect();
    let of_edge = |&edge: &usize| {
        matrix[edge].entries().filter_map(|(column, value)| Some((numbers[column]?, value)))
    };
    LinearFactor::new(rows.iter().map(of_edge))?.solve(right)
}

/// A failed factorisation in the words of the scene.
pub(super) fn failed(scene: &Scene) -> impl Fn(ReferenceError) -> Error + '_ {
    move |error| {
        InputError::new(format!("the scene cannot be condensed: {error}"))
            .file(&scene.path)
            .hint("see the numbers of the scene")
            .into()
    }
}

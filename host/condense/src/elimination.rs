//! Full fields behind given values on contact and Dirichlet edges: the free unknowns eliminated.
//!
//! ```text
//!   K_FF u_F = b_F − K_FC u_C − K_FD u_D
//! ```
//! One factorisation serves all patterns of loads and all unit openings. The fluxes of a field are the
//! conservative ones (15); on a contact edge they are the residual of the condensed problem.

use signorini_problem::{Assembled, Loads, Problem};
use signorini_reference::ReferenceError;
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

/// The fields of all `given`, in their order.
///
/// # Errors
/// Numbers out of range, a matrix that is singular to working precision.
pub(super) fn fields(problem: &Problem, given: &[FieldLoads]) -> Result<Vec<Field>> {
    let unfit = unfit::<f64>(&problem.scene);
    let mut assembled = Assembled::<f64>::new(problem).map_err(&unfit)?;
    let free = problem.topology.counts.free;
    let mut right = Vec::with_capacity(free * given.len());
    let mut fields = Vec::with_capacity(given.len());
    for FieldLoads { loads, contact } in given {
        assembled.set_loads(loads).map_err(&unfit)?;
        let system = assembled.system().map_err(&unfit)?;
        let mut u = vec![0.0; free];
        u.extend(contact.iter().chain(&loads.dirichlet));
        let rows = system.matrix().iter().zip(system.load()).take(free);
        right.extend(rows.map(|(row, load)| load - row.dot(&u)));
        fields.push(Field { flux: vec![0.0; u.len()], u });
    }
    let solved = free_block(&assembled, free, &right).map_err(failed(&problem.scene))?;
    for (at, (field, FieldLoads { loads, .. })) in fields.iter_mut().zip(given).enumerate() {
        field.u[..free].copy_from_slice(&solved[at * free..][..free]);
        assembled.set_loads(loads).map_err(&unfit)?;
        assembled.recover(&field.u, &[], &mut field.flux).map_err(&unfit)?;
    }
    Ok(fields)
}

/// K_FF⁻¹ applied to the columns of `right`.
fn free_block(
    assembled: &Assembled<f64>,
    free: usize,
    right: &[f64],
) -> std::result::Result<Vec<f64>, ReferenceError> {
    let malformed = |_| ReferenceError::Malformed("the assembled matrix is not one");
    let system = assembled.system().map_err(malformed)?;
    let (mut row_ptr, mut col_idx, mut values) = (vec![0], Vec::new(), Vec::new());
    for row in system.matrix().iter().take(free) {
        for (column, value) in row.entries().filter(|&(column, _)| column < free) {
            col_idx.push(column as u32);
            values.push(value);
        }
        row_ptr.push(values.len() as u32);
    }
    signorini_reference::Linear { row_ptr: &row_ptr, col_idx: &col_idx, values: &values }
        .solve(right)
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

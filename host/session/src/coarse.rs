//! A start from a coarser mesh: solved there first, and brought to the fine one.

use signorini_kernel::element::crouzeix_raviart;
use signorini_solve::prolongation::{Origin, prolong};

use signorini_problem::Problem;
use signorini_problem::scalar::Scalar;
use signorini_problem::search::{LocatedPoint, Search};
use signorini_scene::error::{InputError, Result};
use signorini_solve::{Options, SolverKind, is_long_to_sweep, solve, unfit};

/// Means of u over the edges of `coarse`.
///
/// # Errors
/// As for [`solve`].
pub fn solved(coarse: &Problem) -> Result<Vec<f64>> {
    let options = Options { solver: SolverKind::Auto, ..Options::default() };
    Ok(solve(coarse, &options)?.u)
}

/// Sets `u`, one mean per edge of `problem`, to where a first tick starts: to the solution on `coarse`, the same problem on a
/// coarser mesh, where there is one, else to `problem`'s own where `is_open` and cold sweeps would take long: on
/// a large mesh they would take longer than all ticks after them.
///
/// # Errors
/// As for [`solve`]; numbers that the scalar cannot hold.
pub(crate) fn start<R: Scalar>(
    problem: &Problem,
    coarse: Option<&Problem>,
    is_open: bool,
    u: &mut [R],
) -> Result<()> {
    if let Some(coarse) = coarse {
        check_domain(problem, coarse)?;
        let means: Vec<R> = solved(coarse)?.into_iter().map(R::narrow).collect();
        let origins = origins(problem, coarse)?;
        return prolong(&origins, &means, u).map_err(unfit::<R>(&problem.scene));
    }
    if is_open && is_long_to_sweep(problem) {
        let means = solved(problem)?.into_iter().map(R::narrow);
        u.iter_mut().zip(means).for_each(|(u, mean)| *u = mean);
    }
    Ok(())
}

/// How far apart the boxes of two meshes of one domain may be, as a part of its size: a coarse mesh cuts curves short.
const APART: f64 = 0.2;

/// Refuses a coarse mesh of another domain, or of the same one in another unit of length.
fn check_domain(fine: &Problem, coarse: &Problem) -> Result<()> {
    let boxes = [fine, coarse].map(|of| {
        [0, 1].map(|k| {
            let along = || of.mesh.vertices.iter().map(|vertex| vertex[k]);
            [along().fold(f64::INFINITY, f64::min), along().fold(f64::NEG_INFINITY, f64::max)]
        })
    });
    let [own, other] = boxes;
    let size = own.iter().map(|[low, high]| high - low).fold(0.0, f64::max);
    let mut both = own.as_flattened().iter().zip(other.as_flattened());
    if both.all(|(a, b)| (a - b).abs() <= APART * size) {
        return Ok(());
    }
    let [own, other] = [own, other].map(|[[left, right], [bottom, top]]| {
        format!("from ({left}, {bottom}) to ({right}, {top})")
    });
    let message = format!("--coarse: the mesh goes {other}, that of the scene {own}");
    let hint = "expected a coarser mesh of the same domain, in the same unit of length";
    Err(InputError::new(message).hint(hint).into())
}

/// For every edge of `fine` the sides of the coarse cell that its middle lies in.
///
/// # Errors
/// A coarse mesh without cells.
pub fn origins<R: Scalar>(fine: &Problem, coarse: &Problem) -> Result<Vec<Origin<R, u32>>> {
    let search = Search::new(coarse);
    (0..fine.ends.len())
        .map(|edge| {
            let [a, b] = fine.segment(edge);
            let middle = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
            origin(coarse, &search, middle)
        })
        .collect()
}

/// The sides of the cell at a place, with the values of their basis functions there.
fn origin<R: Scalar>(coarse: &Problem, search: &Search, point: [f64; 2]) -> Result<Origin<R, u32>> {
    let Some(LocatedPoint { cell, reference }) = search.find(point) else {
        return Err(InputError::new("--coarse: the mesh has no cells").into());
    };
    let (cell, topology) = (cell as usize, &coarse.topology);
    let Some(quad) = cell.checked_sub(topology.of_triangles.len()) else {
        let [a, b, c] = topology.of_triangles[cell];
        let [p, q, r] = crouzeix_raviart::basis(reference).map(R::narrow);
        return Ok(Origin { edges: [a, b, c, a], weights: [p, q, r, R::ZERO] });
    };
    let corners = coarse.mesh.quads[quad].map(|vertex| coarse.mesh.vertices[vertex as usize]);
    let [x, y, _] = reference;
    let weights = coarse.element.basis(corners, [x, y]).map(R::narrow);
    Ok(Origin { edges: topology.of_quads[quad], weights })
}

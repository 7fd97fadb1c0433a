//! How far outputs move on the mesh refined once: an estimate of their errors, without a guarantee.

use std::collections::BTreeMap;

use super::answer::Found;
use signorini_problem::Problem;
use signorini_scene::error::Result;
use signorini_scene::mesh::adapted::adapted;
use signorini_solve::outputs::outputs;
use signorini_solve::{Options, SolverKind, solve};

/// Beyond so many unknowns there are none: the finer mesh has four times as many.
const MOST_UNKNOWNS: usize = 25_000;

/// Adds the estimates to intervals of outputs with these values; none where the data have no value on the finer mesh.
pub fn estimate(
    problem: &Problem,
    values: &BTreeMap<String, Option<f64>>,
    intervals: &mut BTreeMap<String, Found>,
) {
    let is_small = problem.topology.counts.unknowns() <= MOST_UNKNOWNS;
    if !is_small || intervals.values().all(Found::is_err) {
        return;
    }
    let Ok(finer) = on_finer_mesh(problem) else { return };
    for (name, found) in intervals {
        let value = |of: &BTreeMap<String, Option<f64>>| of.get(name).copied().flatten();
        if let (Ok(found), Some(own), Some(finer)) = (found, value(values), value(&finer)) {
            found.estimate = Some((own - finer).abs());
        }
    }
}

/// The outputs on the mesh refined once.
fn on_finer_mesh(problem: &Problem) -> Result<BTreeMap<String, Option<f64>>> {
    let mut finer = Problem::new(&problem.scene, adapted(problem.mesh.as_ref().clone(), None, 1)?)?;
    finer.set_time(problem.time)?;
    outputs(&finer, &solve(&finer, &Options::by(SolverKind::Factor))?)
}

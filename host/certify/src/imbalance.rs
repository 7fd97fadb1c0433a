//! The part that is missed of the integrals of f, g and q: it has no zero mean, and leaves along cells through a side that can take it.
//!
//! With δ_T missed in cell T, τ + θ is admissible for the data themselves, where ∇·θ = −δ_T/|T| and θ flows along the forest of cells to an
//! edge of D or R. ‖A^{−½}θ‖ ≤ stability Σ|δ_T| moves the gap once, and what the bound is about, τ, once more. Of an edge, the
//! deviation from the mean in its cell counts as g's own ([`super::oscillation`]), and the mean leaves from there.

use signorini_problem::{Assembled, EdgeKind, Problem};

use super::forest::EquilibrationForest;
use super::metric::Metric;
use super::no_bound::NoBound;
use super::reach::Reach;

/// Part of the loads up to which contact alone takes what is missed, as it takes what rounding leaves.
const ROUNDING: f64 = 1e-9;

/// The share of the oscillation that comes from what is missed of the loads, and from ends of contact fluxes that have `moved`.
///
/// # Errors
/// More is missed than rounding would where contact alone holds a part, or nothing does.
pub(super) fn carried(problem: &Problem, moved: f64) -> Result<f64, NoBound> {
    let loads = &problem.loads;
    if loads.missed == 0.0 && moved == 0.0 {
        return Ok(0.0);
    }
    let cells = loads.triangles.iter().chain(&loads.quads).chain(&loads.contact_flux);
    let given = loads.neumann.iter().map(|record| &record.flux);
    let size: f64 = cells.chain(given).map(|load| load.abs()).sum();
    let overflow = |_| NoBound::overflow::<f64>();
    let assembled = Assembled::<f64>::new(problem).map_err(overflow)?;
    let metric = Metric::new(problem);
    let mut forest = EquilibrationForest::new(problem);
    let is_small = loads.missed <= ROUNDING * size;
    // An end that has moved takes nothing, and contact alone takes rounding: where nothing else leads out.
    let touches = |edge: usize| {
        let contact = edge.checked_sub(problem.topology.counts.free);
        let is_contact = is_small && problem.kinds[edge] == EdgeKind::Contact;
        is_contact && contact.is_some_and(|at| loads.spans.get(at) != Some(&0.0))
    };
    let stores = |edge| is_small && loads.content(problem.topology.first_side(edge).0) > 0.0;
    let mut find = |also: &dyn Fn(usize) -> bool| forest.find(&assembled, &metric, also).is_ok();
    let leads_out = find(&|_| false) || find(&touches);
    if !leads_out && !find(&|edge| touches(edge) || stores(edge)) {
        return Err(NoBound::unbalanced(loads.missed));
    }
    let reach = Reach::new(problem, forest.stability(), !leads_out);
    let most = reach.of_cells().iter().fold(0.0, |most: f64, &cost| most.max(cost));
    let carried = 2.0 * most * loads.missed + reach.settled(moved);
    if carried.is_finite() { Ok(carried) } else { Err(NoBound::unbalanced(loads.missed)) }
}

#[cfg(test)]
mod tests {
    use crate::Evaluated;
    use signorini_problem::fixtures::on_grid;
    use signorini_scene::error::Result;
    use signorini_scene::mesh::structured::{Cells, grid};

    /// Through a wall with h = 1 that an input may lower to 1e−4.
    #[test]
    fn what_is_missed_leaves_a_term_where_the_least_passes() -> Result<()> {
        let text = "
mesh = \"grid\"
material.default.conductivity = \"1\"
source.f = \"sign(sin(300*x*y))\"
boundary.left = { kind = \"robin\", coefficient = \"1\", ambient = \"0\" }
boundary.right = { kind = \"neumann\", flux = \"0\" }
boundary.dirichlet = { kind = \"neumann\", flux = \"0\" }
boundary.contact = { kind = \"neumann\", flux = \"0\" }
input.frost = { of = \"left\", field = \"coefficient\", pattern = \"1\", range = [-0.9999, 0] }
";
        let (_, problem) = on_grid(text, grid(2, Cells::Triangles))?;
        assert!(problem.loads.missed > 0.0);
        let [whole, term] =
            [Evaluated::new(&problem)?, Evaluated::of_term(&problem)?].map(|data| data.unresolved);
        assert!(term > 10.0 * whole, "{term} beside {whole}");
        Ok(())
    }
}

//! Intervals of outputs: where a force, a flux or a mean of the exact solution lies, in its own unit.
//!
//! ```text
//!   output ─► goal ─► a linear dual problem on the same mesh ─► z and ζ ─► products with the residual ─► interval
//! ```
//! Of s and τ, which the error bound T is about, and of the weights z and ζ of a linear output J (`goal`) follows
//! ```text
//!   {…} = ½⟨τ − A∇s, ζ + A∇z⟩ + ⟨σ − Σ, ζ − A∇z⟩ + ∫_C (σ − τ)·n z′ − ∫_C ζ′ (u − s),      Σ = ½(τ + A∇s)
//! ```
//! The first product is known. ‖σ − Σ‖² = M² − K/2 with M² = ½T² − ¼‖τ − A∇s‖² (Prager and Synge), where K ≥ 0 is what the
//! identity of the bound has on C, and c K/2 bounds the rest (`contact`). The largest value over all K is
//! ```text
//!   ‖ζ − A∇z‖ M,  or where c > ‖ζ − A∇z‖/2M:   c M² + ‖ζ − A∇z‖²/4c.
//! ```
//! Without contact near the output c is 0, and this is of second order, as the error of an output is. Near the end of a contact zone
//! c and ‖ζ − A∇z‖ cannot both be small, and the order is 4/3.
//!
//! # A step in time
//! Of k(u − s_old) − ∇·(A∇u) = f, k = c/dt, the weights have kz − ∇·ζ = j. Let R = ∇·τ + f − k(s − s_old), R_z = ∇·ζ + j − kz. Since
//! ∇·(σ − τ) = k(u − s) − R, {…} has beside all that
//! ```text
//!   ∫R z + ∫R_z (u − s) = ∫R z + ½Σ∫R̄ R̄_z/k + Σ∫(ū − s̄ − R̄/2k) R̄_z + Σ∫(u − s) R_z′
//! ```
//! with means R̄ over the cells and R_z′ = R_z − R̄_z. T bounds ‖A^½∇e‖² + ∫k e² + ‖A^{−½}(σ − τ)‖² + Σ∫(k ē − R̄)²/k + K, e = u − s, so that
//! ```text
//!   ‖σ − Σ‖² + Σ∫k (ē − R̄/2k)² + ½Σ∫k (e − ē)² ≤ M² − K/2,      M² = ½T² − ¼‖τ − A∇s‖² − ¼Σ∫R̄²/k.
//! ```
//! Any part of R_z′ counts in the storage, twice its square over k beside ‖ζ − A∇z‖² + Σ∫R̄_z²/k. The rest costs
//! T (Σ‖R_z′‖²/(k + π²α/h²))^½. ∫R z is known (`stored`) but for what f varies by, which is at most the oscillation of data
//! times ‖A^½∇z‖. Where k = 0 both R̄ and R̄_z are 0, and k = 0 everywhere is the steady problem.

mod answer;
mod contact;
mod coverage;
mod dual;
mod estimate;
mod evolved;
mod exact;
mod goal;
mod interval;
mod kept;
pub mod known;
pub mod midpoints;
mod part;
mod products;
mod squares;
mod stored;
#[cfg(test)]
mod tests;
mod unseen;
mod values;
pub mod weights;

use std::collections::BTreeMap;
use std::sync::Mutex;

use answer::OnMesh;
pub use answer::{Answered, Found, OutputBound, zero_rounding};
use contact::contact_edges;
pub use coverage::{Coverage, MOST_BY_DEFAULT};
use dual::Weights;
pub use estimate::estimate;
pub use evolved::over_time;
pub use goal::described;
use interval::Known;
use products::Residual;
use signorini_certify::curved::followed;
use signorini_problem::Problem;
use signorini_problem::functional::{of_one, wanted};
use signorini_problem::threads::on_two_threads;
use signorini_scene::error::Result;
use signorini_scene::scene::Output;
use signorini_solve::{SharedSolver, Solution};

/// Intervals of every output of a solution, with those that a scene without any has; none at all where they are not asked for.
pub fn of_outputs(
    problem: &Problem,
    solution: &Solution,
    coverage: Coverage,
) -> BTreeMap<String, Found> {
    if coverage == Coverage::None {
        return BTreeMap::new();
    }
    let Some((scaled, own)) = solution.in_its_units() else {
        return of_answer(problem, &solution.into(), coverage);
    };
    let mut all = of_answer(scaled, &own.into(), coverage);
    for output in wanted(&problem.scene).iter() {
        if let Some(Ok(found)) = all.get_mut(&output.name.value) {
            let of_one = of_one(scaled, output);
            *found = found.clone().in_scene(&solution.units, output.quantity, of_one);
        }
    }
    all
}

/// Intervals of any answer whose numbers are near 1.
pub fn of_answer(
    problem: &Problem,
    answer: &Answered,
    coverage: Coverage,
) -> BTreeMap<String, Found> {
    let mut lasting = Lasting::default();
    if answer.bound.is_some() && coverage.takes(problem) {
        // Without a solver there is a reason instead of an interval.
        let _ = lasting.renew(problem);
    }
    of_next(problem, answer, &lasting)
}

/// Data that stay from answer to answer of one scene on one mesh.
#[derive(Default)]
pub struct Lasting {
    /// The solver of its matrix.
    solver: Option<Box<SharedSolver>>,
    /// ∫h of the laws of transfer in it.
    transfers: Vec<f64>,
    /// z and ζ of the outputs by their names, where there is no contact.
    weights: Mutex<BTreeMap<String, Weights>>,
}

impl Lasting {
    /// Works out anew what is not that of `problem` any more.
    ///
    /// # Errors
    /// A matrix that nothing solves.
    pub fn renew(&mut self, problem: &Problem) -> Result<()> {
        let laws = problem.loads.robin.iter();
        let transfers: Vec<f64> = laws.map(|law| law.coefficient).collect();
        if self.solver.is_none() || self.transfers != transfers {
            let solver = SharedSolver::of(problem)?.map(Box::new);
            *self = Self { solver, transfers, weights: Mutex::default() };
        }
        Ok(())
    }
}

/// Intervals with the data that stay from answer to answer. An answer stays one where data have no value at a point that is looked at here alone:
/// that is the reason then.
pub fn of_next(problem: &Problem, answer: &Answered, lasting: &Lasting) -> BTreeMap<String, Found> {
    let all = wanted(&problem.scene);
    let found = intervals(problem, answer, lasting, &all);
    let found = found.unwrap_or_else(|error| vec![Err(error.reason()); all.len()]);
    all.iter().map(|output| output.name.value.clone()).zip(found).collect()
}

/// The value of an output for the exact solution, where a scene has one and the output is linear, and by how much its quadrature is
/// in doubt.
pub fn exact_value(problem: &Problem, output: &Output) -> Option<[f64; 2]> {
    exact::value(problem, problem.scene.exact.as_ref()?, output).ok()
}

fn intervals(
    problem: &Problem,
    answer: &Answered,
    lasting: &Lasting,
    all: &[Output],
) -> Result<Vec<Found>> {
    let none = |why: &str| Ok(vec![Err(why.to_owned()); all.len()]);
    let Some(bound) = answer.bound else { return none("the solution has no error bound") };
    let Some(solver) = &lasting.solver else {
        return none(&coverage::reason(problem));
    };
    let deviations = followed(problem, &answer.certified.admissible())?;
    let on = OnMesh { problem, answer: *answer, deviations: &deviations };
    let known = Known {
        solver,
        kept: &lasting.weights,
        problem,
        on,
        contact: contact_edges(&on)?,
        residual: Residual::new(&on)?,
        bound,
        doubt: values::doubt(problem) + values::imbalance(&on),
    };
    let found =
        |output: &Output| Ok(known.interval(output).unwrap_or_else(|error| Err(error.reason())));
    on_two_threads(all, found, || ())
}

//! Outputs as functionals of u and σ, and the data of the linear problem that weighs their errors.
//!
//! ```text
//!   J(u) = J(s) + {…}      the mean of u over a part P of the boundary, or over cells with weights w_T
//!   J(σ) = J(τ) − {…}      the flux through P, or the force of contact there
//! ```
//! with the same {…} for both ([`super`]). Its weights z and ζ have these data:
//! ```text
//!   mean    ζ·n = 1/|P| on P, 0 on the rest of N and C,  z = 0 on D,  ζ·n = −h z (+ 1/|P|) on R,  −∇·ζ = w_T/|T| in a cell
//!   flux    z = ±1 on P, 0 on the rest of D and C,  ζ·n = 0 on N,  ζ·n = h (1_P − z) on R
//! ```

use super::answer::OnMesh;
use super::part::Part;
use super::values::{self, Value};
use std::f64::consts::PI;

use signorini_certify::cell::Cell;
use signorini_certify::conductivity::Conductivity;
use signorini_problem::functional::{Functional, of_cells};
use signorini_problem::{EdgeKind, Problem};
use signorini_scene::error::Result;
use signorini_scene::scene::{Field, Output, Quantity};

/// A linear output.
pub(super) struct Goal {
    /// 1 of u, −1 of σ.
    pub sign: f64,
    /// J(s) or J(τ).
    pub start: Value,
    /// z on each of the scene's boundaries with a given u, a gap, or a transfer law that is asked for its flux.
    pub values: Vec<f64>,
    /// ζ·n on each of the scene's boundaries, as far as no u makes it.
    pub densities: Vec<f64>,
    /// ∫_T −∇·ζ in each cell, triangles first, with the sum 1; nothing where ζ has no source.
    pub sources: Vec<f64>,
    /// How far J(u) − J(s) may be from {…}, for an error of 1 in the energy norm: a source of ζ is no constant on a quad that is no
    /// parallelogram.
    pub beside: f64,
    /// Where the conditions keep J(σ), whatever the solution is.
    pub law: [f64; 2],
    /// Words for the quantity.
    pub of: String,
}

/// A goal, or why there is none.
pub(super) type Posed = std::result::Result<Goal, String>;

/// Describes the quantity of an output in a few words.
pub fn described(output: &Output) -> String {
    let of = output.place("all contact edges", str::to_owned);
    match output.quantity {
        Quantity::Mean | Quantity::MeanInside => format!("the mean of u over {of}"),
        Quantity::Content => {
            format!("∫cu over {}", output.place("the domain", str::to_owned))
        }
        Quantity::Flux => format!("the flux (A∇u)·n over {of}"),
        Quantity::Force => format!("the force ∫λ over {of}"),
        Quantity::Length => format!("the length of {of} that touches"),
        Quantity::Saturated => format!("the length of {of} at its limit"),
        Quantity::Probe { at: [x, y] } => format!("u at ({x}, {y})"),
        Quantity::Bound => "the error bound".to_owned(),
        Quantity::Window => "the bound over time".to_owned(),
    }
}

const EVERYTHING: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

/// Where lo ≤ σ·n ≤ hi keeps a flux, and 0 ≤ λ a force.
fn law(problem: &Problem, part: &Part, is_force: bool) -> [f64; 2] {
    let free = problem.topology.counts.free;
    let of_edge = |edge: usize| match problem.kinds[edge] {
        EdgeKind::Contact => {
            let [lo, hi] = problem.loads.flux_range(edge - free).ends();
            // Data are integrated up to this.
            let off = |end: f64| if end.is_finite() { values::INTEGRATED * end.abs() } else { 0.0 };
            let [lo, hi] = [lo - off(lo), hi + off(hi)];
            if is_force { [0.0, hi - lo] } else { [lo, hi] }
        }
        _ if is_force => [0.0; 2],
        _ => EVERYTHING,
    };
    part.edges().map(of_edge).fold([0.0; 2], |sum, of| [sum[0] + of[0], sum[1] + of[1]])
}

/// ‖1/|T| − w‖ d/π√α: w is the source of ζ, d the diameter of the cell, α the least eigenvalue of A there. By Poincaré's inequality on
/// convex cells (Payne and Weinberger) no more is between two means of a function whose energy is 1. w is monotone along both
/// reference coordinates, so that corners tell its largest distance from 1/|T|.
fn beside(problem: &Problem, at: usize) -> f64 {
    let cell = Cell::of(problem, at);
    if cell.is_affine() {
        return 0.0;
    }
    // The area elements at the corners, whose mean is |T|; w is the inverse of the area element.
    let corners = cell.corners();
    let side = |from: usize, to: usize| [0, 1].map(|k| corners[to % 4][k] - corners[from % 4][k]);
    let element = |at: usize| {
        let [there, back] = [side(at, at + 1), side(at, at + 3)];
        there[0] * back[1] - there[1] * back[0]
    };
    let elements = [0, 1, 2, 3].map(element);
    let area = elements.iter().sum::<f64>() / 4.0;
    let most = elements.map(|element| (1.0 / area - 1.0 / element).abs());
    let most = most.into_iter().fold(0.0, f64::max);
    most * area.sqrt() * cell.diameter() / (PI * Conductivity::of(problem, at).alpha().sqrt())
}

impl Goal {
    /// The goal of an output, where it is linear.
    ///
    /// # Errors
    /// Data that are not finite, a probe outside the mesh.
    pub fn of(on: &OnMesh, output: &Output) -> Result<Posed> {
        let problem = on.problem;
        let part = Part::new(problem, output);
        let none = |why: &str| Ok(Err(why.to_owned()));
        match output.quantity {
            Quantity::Length | Quantity::Saturated => none("the length of a contact set has none"),
            Quantity::Bound | Quantity::Window => none("it is a bound itself"),
            Quantity::Probe { .. } => {
                let Functional::Probe(cell, _) = Functional::of(problem, output)? else {
                    return none("it is outside the mesh");
                };
                let mut sources = vec![0.0; problem.cells()];
                sources[cell] = 1.0;
                let [x, y] = Cell::of(problem, cell).middle();
                let of = format!("the mean of u over the cell around ({x}, {y})");
                Self::inside(on, (sources, of)).map(Ok)
            }
            Quantity::MeanInside | Quantity::Content => {
                let weights = of_cells(problem, output);
                let all: f64 = weights.iter().sum();
                if all == 0.0 {
                    return none("its materials have no cell that counts");
                }
                let sources = weights.into_iter().map(|weight| weight / all).collect();
                Self::inside(on, (sources, described(output))).map(Ok)
            }
            _ if part.edges().next().is_none() => none("its boundary has no edge"),
            Quantity::Mean => Self::of_mean(on, output).map(Ok),
            Quantity::Flux | Quantity::Force => Self::of_flux(on, output).map(Ok),
        }
    }

    fn of_mean(on: &OnMesh, output: &Output) -> Result<Self> {
        let (problem, part) = (on.problem, &Part::new(on.problem, output));
        let density = 1.0 / part.length();
        let start = values::mean(on, part)?;
        let own = |at: usize| if part.has_table(at) { density } else { 0.0 };
        let densities = (0..problem.scene.boundaries.len()).map(own).collect();
        Ok(Self { densities, ..Self::without_data(problem, start, described(output)) })
    }

    /// u at the start and no data: z and ζ are 0.
    fn without_data(problem: &Problem, start: Value, of: String) -> Self {
        let none = vec![0.0; problem.scene.boundaries.len()];
        let (values, densities, sources) = (none.clone(), none, Vec::new());
        Self { sign: 1.0, start, values, densities, sources, beside: 0.0, law: EVERYTHING, of }
    }

    /// Σ_T w_T ū_T for weights with the sum 1, and words for it.
    fn inside(on: &OnMesh, (sources, of): (Vec<f64>, String)) -> Result<Self> {
        let (problem, start) = (on.problem, values::inside(on, &sources)?);
        let counted = sources.iter().enumerate().filter(|(_, weight)| **weight != 0.0);
        let squares = counted.map(|(at, weight)| (weight * beside(problem, at)).powi(2));
        let beside = squares.sum::<f64>().sqrt();
        Ok(Self { sources, beside, ..Self::without_data(problem, start, of) })
    }

    fn of_flux(on: &OnMesh, output: &Output) -> Result<Self> {
        let (problem, part) = (on.problem, &Part::new(on.problem, output));
        let is_force = output.quantity == Quantity::Force;
        let weight = |at: usize| match part.has_table(at) {
            true if is_force => values::direction(problem, at),
            true => 1.0,
            false => 0.0,
        };
        let values = (0..problem.scene.boundaries.len()).map(weight).collect();
        let (start, law) = (values::flux(on, part, is_force)?, law(problem, part, is_force));
        let plain = Self::without_data(problem, start, described(output));
        Ok(Self { sign: -1.0, values, law, ..plain })
    }

    /// ζ·n that is given on a boundary edge.
    pub fn density_on(&self, problem: &Problem, edge: usize) -> f64 {
        on(problem, edge, &self.densities)
    }

    /// z that is given there.
    pub fn value_on(&self, problem: &Problem, edge: usize) -> f64 {
        on(problem, edge, &self.values)
    }

    /// The size of ∫ζ·n over the whole boundary, roughly: 1 for a mean, that of A where z goes from 0 to 1.
    pub fn size(&self, problem: &Problem) -> f64 {
        if self.sign > 0.0 { 1.0 } else { problem.stiffest() }
    }

    /// The value where the data give it: of a flux through N, of a mean over D.
    ///
    /// # Errors
    /// Data that are not finite.
    pub fn given(problem: &Problem, output: &Output) -> Result<Option<Value>> {
        if output.quantity.is_inside() {
            return Ok(None);
        }
        let part = Part::new(problem, output);
        let field = match output.quantity {
            Quantity::Flux if part.is_all(EdgeKind::Neumann) => Field::Flux,
            Quantity::Mean if part.is_all(EdgeKind::Dirichlet) => Field::Value,
            _ => return Ok(None),
        };
        values::given(problem, &part, field).map(Some)
    }
}

/// The number of the boundary that an edge lies on, of one for each table.
fn on(problem: &Problem, edge: usize, numbers: &[f64]) -> f64 {
    problem.binding.boundary(problem.ends[edge]).map_or(0.0, |table| numbers[table])
}

//! What a scene stores in steps of time, and where they start.

use signorini_bound::certificate::StoredCell;
use signorini_device::full::{Begin, Storing};
use signorini_kernel::evolution::{Carried, Rates};

use signorini_certify::Certifier;
use signorini_certify::evolution::{Evolution, rates};
use signorini_problem::scalar::Scalar;
use signorini_problem::{Assembled, Problem, State, Step};
use signorini_scene::error::Result;
use signorini_scene::scene::units::Units;
use signorini_scene::setting::{Setting, Start};
use signorini_solve::unfit;

/// Above this part of the diagonal that is proved for the least eigenvalue, sweeps need no ω.
const SHORT: f64 = 0.5;

/// The largest ω that they begin with.
const MOST: f64 = 1.98;

/// The arrays of [`Storing`].
#[derive(Debug, Clone)]
pub(super) struct Stored<R> {
    step: Step<R>,
    diagonal: Vec<R>,
    cells: Vec<StoredCell<R>>,
    rates: Rates<R>,
    carried: Carried<R>,
    is_cold: bool,
}

impl<R: Scalar> Stored<R> {
    /// Of `problem`, a step in time in its units; nothing where it is none. `held` is the same at its least transfer coefficients.
    pub fn new(
        problem: &Problem,
        (certifier, held): (&Certifier<R>, &Assembled<R>),
        setting: &Setting,
    ) -> Result<Option<Self>> {
        let Some(step) = held.step() else { return Ok(None) };
        let unfit = unfit::<R>(&problem.scene);
        let edges = held.edges();
        let mut diagonal = vec![R::ZERO; edges.counts().unknowns()];
        step.storage(edges).map_err(&unfit)?.add_to_diagonal(edges, &mut diagonal);
        if problem.scene.transfer_input().is_none() {
            // Added in the scalar, as a tick does where an input changes them.
            for law in &problem.loads.robin {
                diagonal[law.edge as usize] += R::narrow(law.coefficient);
            }
        }
        let has_bound = setting.certificate;
        let cells = if has_bound { certifier.stored_cells(held, step) } else { Vec::new() };
        let mut step = step.clone();
        if !has_bound {
            step.begin.vertices.clear();
        }
        if !has_bound || problem.mesh.quads.is_empty() {
            step.begin.bubbles.clear();
        }
        Ok(Some(Self {
            step,
            diagonal,
            cells,
            rates: Rates::default(),
            carried: Carried { bound: R::INFINITY, before: R::ZERO },
            is_cold: setting.start == Start::Cold,
        }))
    }

    /// With what the bound of the evolution begins with, in the scene's units.
    #[must_use]
    pub fn with_evolution(self, evolution: Option<&Evolution>, units: &Units) -> Self {
        let Some(of) = evolution.filter(|_| !self.cells.is_empty()) else { return self };
        let Carried { bound, before } = of.in_unit(units.energy()).carried();
        let up = |x: f64| R::narrow(x * (1.0 + 2.0 * R::EPSILON.wide()));
        let carried = Carried { bound: up(bound), before: up(before).or_smaller(R::ONE) };
        Self { rates: rates(of.rate, R::narrow(self.step.length).wide()), carried, ..self }
    }

    /// As the kernel takes it.
    pub fn view(&self) -> Storing<'_, R> {
        let Self { step, diagonal, cells, rates, carried, is_cold } = self;
        let State { u, vertices, bubbles, openings, .. } = &step.begin;
        Storing {
            length: R::narrow(step.length),
            masses: step.masses(),
            diagonal,
            cells,
            rates: *rates,
            begin: Begin { u, vertices, bubbles, openings, carried: *carried },
            is_cold: *is_cold,
        }
    }
}

/// Where ω starts for a step, by what is proved of the least eigenvalue of its scaled matrix:
/// ```text
///   λ_min(D⁻¹(K + M)) ≥ (1 + λdt) min M_i/D_i = 1 − μ,     ω = 2/(1 + (1 − μ²)^½)
/// ```
/// Nothing where some cells store nothing, or where the matrix has no diagonal.
pub(super) fn short(problem: &Problem, evolution: Option<&Evolution>) -> Option<f64> {
    let step = problem.loads.step.as_ref()?;
    let edges = problem.topology.edges().ok()?;
    let mut masses = vec![0.0; edges.counts().unknowns()];
    step.storage(&edges).ok()?.add_to_diagonal(&edges, &mut masses);
    let [diagonal, _] = problem.diagonal_and_load().ok()?;
    let least = masses.iter().zip(&diagonal).map(|(mass, all)| mass / all).fold(1.0, f64::min);
    let least = least * (1.0 + evolution.map_or(0.0, |of| of.rate) * step.length);
    if least <= 0.0 {
        return None;
    }
    let radius = (1.0 - least).max(0.0);
    let omega = 2.0 / (1.0 + (1.0 - radius * radius).sqrt());
    Some(if least > SHORT { 1.0 } else { omega.min(MOST) })
}

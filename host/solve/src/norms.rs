//! Errors against an exact solution at the time of the problem, integrated with 16×16 Gauss points a cell, 8×8 on
//! meshes of 20 000 cells or more.
//!
//! A lower rule comes out up to 0.5 % too small where the exact gradient has a kink.

use serde::Serialize;
use signorini_kernel::Tensor;

use signorini_certify::cell::{Cell, Jet};
use signorini_certify::conductivity::{Conductivity, apply, dot, product};
use signorini_certify::exact::{Distance, distance, of_fewer_points};
use signorini_certify::sampled::{Sampled, Solution};
use signorini_certify::weighed::minus;
use signorini_problem::Problem;
use signorini_problem::field::{CellField, Sample};
use signorini_problem::pointwise::{POINTS, points_on};
use signorini_problem::quadrature::gauss;
use signorini_problem::threads::in_portions;
use signorini_scene::error::Result;
use signorini_scene::scene::Exact;
use signorini_scene::scene::units::Units;

/// Distances between the discrete and the exact solution.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Errors {
    /// Broken |u − u_h|₁
    pub h1: f64,
    /// ‖u − u_h‖
    pub l2: f64,
    /// ‖σ − σ_h‖
    pub flux: f64,
    /// ‖A^½ ∇_h(u − u_h)‖
    pub energy: f64,
    /// Distance of the error bound's S and τ to the solution, for whoever has them: see
    /// [`signorini_certify::exact`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub combined: Option<f64>,
    /// Number that the bound should equal, from the same place.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub identity: Option<f64>,
    /// By how much `combined` differs with half of the points a direction.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub quadrature: Option<f64>,
}

/// All errors of a solution, where the scene has an exact one.
///
/// # Errors
/// An exact solution that is not finite at a quadrature point.
pub fn of_solution(problem: &Problem, solution: &crate::Solution) -> Result<Option<Errors>> {
    let Some(exact) = &problem.scene.exact else { return Ok(None) };
    if let Some((problem, own)) = solution.in_its_units() {
        return Ok(of_solution(problem, own)?.map(|errors| errors.times(&solution.units)));
    }
    let errors = errors(exact, problem, &solution.u, &solution.flux)?;
    if solution.bound.is_none() {
        return Ok(Some(errors));
    }
    let admissible = solution.certified.admissible();
    let found = distance(exact, problem, &admissible)?;
    let quadrature = Some((found.combined - of_fewer_points(exact, problem, &admissible)?).abs());
    Ok(Some(Errors { quadrature, ..errors.with(found) }))
}

/// Integrates the errors of edge means `u` and edge fluxes `flux`.
///
/// # Errors
/// An exact solution that is not finite at a quadrature point.
pub fn errors(exact: &Exact, problem: &Problem, u: &[f64], flux: &[f64]) -> Result<Errors> {
    of_fields(problem, &Solution { exact, problem }, u, flux)
}

/// [`errors`] against the exact solution `known`, which may be evaluated or tabulated.
pub fn of_fields<S: Sampled>(
    problem: &Problem,
    known: &S,
    u: &[f64],
    flux: &[f64],
) -> Result<Errors> {
    let rule = gauss(if S::ANYWHERE { points_on(problem.cells()) } else { POINTS });
    let sums = in_portions(problem.cells(), |cells| {
        let mut sums = Errors::default();
        for at in cells {
            let field = CellField::new(problem, at, u, flux);
            let conductivity = Conductivity::of(problem, at);
            let points = Cell::of(problem, at).points(&rule);
            for (point, known) in points.iter().zip(known.on_cell(at, &points)?.iter()) {
                sums.add(known, &conductivity.at(point.x), &field.sample(point), point.weight);
            }
        }
        Ok([sums.h1, sums.l2, sums.flux, sums.energy])
    })?;
    let add = |sum: [f64; 4], portion: [f64; 4]| [0, 1, 2, 3].map(|k| sum[k] + portion[k]);
    let [h1, l2, flux, energy] = sums.into_iter().fold([0.0; 4], add);
    let [h1, l2, flux, energy] = [h1, l2, flux, energy].map(f64::sqrt);
    Ok(Errors { h1, l2, flux, energy, ..Errors::default() })
}

impl Errors {
    /// In the scene's units, from those of the solve.
    fn times(self, units: &Units) -> Self {
        let energy = |error: f64| error * units.energy();
        Self {
            h1: self.h1 * units.u,
            l2: self.l2 * units.u,
            flux: self.flux * units.flux(),
            energy: energy(self.energy),
            combined: self.combined.map(energy),
            identity: self.identity.map(energy),
            quadrature: self.quadrature.map(energy),
        }
    }

    /// With the distance of S and τ.
    #[must_use]
    pub fn with(self, Distance { combined, identity, .. }: Distance) -> Self {
        Self { combined: Some(combined), identity: Some(identity), ..self }
    }

    /// Adds the squares of one point, an element of area `weight`.
    fn add(&mut self, known: &Jet, a: &Tensor<f64>, found: &Sample, weight: f64) {
        let error = minus(known.gradient, found.gradient);
        let flux_error = minus(apply(a, known.gradient), found.flux);
        self.h1 += weight * dot(error, error);
        self.l2 += weight * (known.value - found.u).powi(2);
        self.flux += weight * dot(flux_error, flux_error);
        self.energy += weight * product(a, error, error);
    }
}

//! The true distance of S and τ to an exact solution: what the bound must not fall below.
//!
//! With σ = A∇u, the means f̄, ḡ, q̄ that τ was made for, and R the Robin boundary,
//! ```text
//!   combined² = ‖A^½∇(u − S)‖² + ‖A^{−½}(σ − τ)‖² + ∫_R h(u − S)² + ∫_R ((σ − τ)·n)²/h
//!   identity² = combined² + 2∫_C [(σ·n − q)(S − ψ) + (τ·n − q̄)(u − ψ)]
//!             + 2∫(S − u)(f − f̄) + 2∫_N (S − u)(g − ḡ) + 2∫_C (S − u)(q − q̄)
//! ```
//! bound² = identity², whatever S and τ are, is a test of the bound from both sides. Nothing is
//! clipped: where S or τ are not admissible, single terms are negative.

mod along;
mod in_energy;
mod two_sided;

pub use in_energy::in_energy;

use std::borrow::Cow;
use std::iter::repeat;

use along::EdgePoint;

use super::admissible::Admissible;
use super::cell::{Cell, Jet};
use super::conductivity::Conductivity;
use super::curved;
use super::deviation::Deviations;
use super::sampled::{Lifted, Sampled, Solution};
use super::weighed::{FEW, Weighed, in_cell, on_robin, plus, size_in_cell, twice};
use signorini_problem::field::CellField;
use signorini_problem::pointwise::{POINTS, points_on};
use signorini_problem::quadrature::{gauss, on_panels};
use signorini_problem::threads::in_portions;
use signorini_problem::{EdgeKind, Problem, Sum};
use signorini_scene::error::Result;
use signorini_scene::scene::{Exact, Field};

/// Distances of S and τ to the exact solution, in the unit of ‖A^½∇u‖.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Distance {
    /// The error that the bound is for: bound ≥ combined.
    pub combined: f64,
    /// The number that the bound equals up to quadrature: bound = identity.
    pub identity: f64,
    /// How far the squares of both may be off, since data and exact solution are evaluated in f64.
    pub rounding: f64,
}

/// Integrates the distances at the time of the problem, with 16×16 points a cell (8×8 on meshes of 20 000 cells or more) and 64 an edge, more where ψ or u_D has a
/// kink or a layer inside an edge; the means are those of `problem.loads`.
///
/// # Errors
/// An exact solution or data that are not finite at a quadrature point.
pub fn distance(exact: &Exact, problem: &Problem, admissible: &Admissible) -> Result<Distance> {
    distance_on(1, exact, problem, admissible)
}

/// Distance with `panels`×`panels` times the points, where kinks and layers of the exact solution lie inside cells.
///
/// # Errors
/// As for [`distance`].
pub fn distance_on(
    panels: u32,
    exact: &Exact,
    problem: &Problem,
    admissible: &Admissible,
) -> Result<Distance> {
    let deviations = &curved::followed(problem, admissible)?;
    let (u, lift) = (&Solution { exact, problem }, &Lifted { problem, deviations });
    Integrands { exact, problem, admissible, deviations, u, lift, panels, fewer: 1 }.distance()
}

/// [`Distance::combined`] with half of the points a direction: how far the rule may be trusted.
///
/// # Errors
/// As for [`distance`].
pub fn of_fewer_points(exact: &Exact, problem: &Problem, admissible: &Admissible) -> Result<f64> {
    let deviations = &curved::followed(problem, admissible)?;
    let (u, lift) = (&Solution { exact, problem }, &Lifted { problem, deviations });
    Integrands { exact, problem, admissible, deviations, u, lift, panels: 1, fewer: 2 }.combined()
}

/// Fields that a distance is integrated from.
pub struct Integrands<'a, U, L> {
    /// The exact solution.
    pub exact: &'a Exact,
    /// The problem on its mesh.
    pub problem: &'a Problem,
    /// The s and τ whose distance is sought.
    pub admissible: &'a Admissible<'a>,
    /// Deviations that S follows: [`curved::followed`].
    pub deviations: &'a Deviations<'a>,
    /// `exact` inside the cells.
    pub u: &'a U,
    /// The function that S follows inside the cells where any of `deviations` are; elsewhere it follows nothing.
    pub lift: &'a L,
    /// Parts of a cell in each direction, each with a rule of its own.
    pub panels: u32,
    /// Number that divides the points of each rule.
    pub fewer: u32,
}

/// Values at a point of a cell.
struct CellPoint {
    x: [f64; 2],
    /// An element of area.
    weight: f64,
    /// The area element of the reference coordinates.
    determinant: f64,
    u: f64,
    s: f64,
    /// |A^½(∇u − ∇S)|² + |A^{−½}(σ − τ)|²
    square: f64,
    /// The size that its rounding is a part of.
    size: f64,
}

impl<U: Sampled, L: Sampled> Integrands<'_, U, L> {
    /// Both distances.
    pub fn distance(&self) -> Result<Distance> {
        let problem = self.problem;
        let (mut combined, mut rest) = ([0.0; 2], [0.0; 2]);
        let f = Sum::source(&problem.scene, problem.time);
        let rule = self.rule();
        let inside = in_portions(problem.cells(), |cells| {
            let (mut combined, mut rest) = ([0.0; 2], [0.0; 2]);
            for at in cells {
                let (cell, load) = (Cell::of(problem, at), problem.loads.of_cell(at));
                self.visit(at, &rule, |point| {
                    let w = point.weight;
                    combined = plus(combined, [w * point.square, w * point.size]);
                    let means = cell.spread(load, point.determinant);
                    let missing = [f.at(point.x[0], point.x[1]), means];
                    rest = plus(rest, twice(w, [point.s, point.u], missing));
                })?;
            }
            Ok((combined, rest))
        })?;
        for (of_combined, of_rest) in inside {
            (combined, rest) = (plus(combined, of_combined), plus(rest, of_rest));
        }
        for (edge, kind) in problem.kinds.iter().enumerate() {
            match kind {
                EdgeKind::Contact => rest = plus(rest, self.contact(edge)?),
                EdgeKind::Neumann => rest = plus(rest, self.neumann(edge)?),
                EdgeKind::Robin => combined = plus(combined, self.robin(edge)?),
                EdgeKind::Interior | EdgeKind::Dirichlet => {}
            }
        }
        let [identity, size] = plus(combined, rest);
        Ok(Distance {
            combined: combined[0].sqrt(),
            identity: identity.max(0.0).sqrt(),
            rounding: FEW * size,
        })
    }

    /// [`Distance::combined`] alone.
    pub fn combined(&self) -> Result<f64> {
        let (mut square, rule) = (0.0, self.rule());
        for at in 0..self.problem.cells() {
            self.visit(at, &rule, |point| square += point.weight * point.square)?;
        }
        for edge in 0..self.problem.kinds.len() {
            square += self.robin(edge)?[0];
        }
        Ok(square.sqrt())
    }

    /// Points along the sides of the reference square.
    fn rule(&self) -> Vec<[f64; 2]> {
        let points = match U::ANYWHERE && L::ANYWHERE {
            true => points_on(self.problem.cells()),
            false => POINTS,
        };
        on_panels(self.panels, &gauss(points / self.fewer as usize))
    }

    /// Calls `add` with the points of `rule` on a cell.
    fn visit(&self, at: usize, rule: &[[f64; 2]], mut add: impl FnMut(CellPoint)) -> Result<()> {
        let (problem, tau) = (self.problem, self.admissible.tau);
        let cell = Cell::of(problem, at);
        let conductivity = Conductivity::of(problem, at);
        let chordal = self.admissible.chordal(problem, at);
        // Of this field only the flux is read, so that any numbers do for the means of u.
        let tau = CellField::new(problem, at, tau, tau);
        let points = match (U::ANYWHERE && L::ANYWHERE, conductivity.cut_for_curves()) {
            (true, Some(pieces)) => pieces.many_points(cell).map(|of| of.point).collect(),
            (true, None) => curved::points(problem, at, self.deviations, rule)?,
            (false, _) => cell.points(rule),
        };
        let u = self.u.on_cell(at, &points)?;
        let is_lifted = self.deviations.of_cell(problem, at).iter().any(Option::is_some);
        let lift = if is_lifted { self.lift.on_cell(at, &points)? } else { Cow::Borrowed(&[][..]) };
        let lift = lift.iter().copied().chain(repeat(Jet::default()));
        for ((point, u), lift) in points.iter().zip(u.iter()).zip(lift) {
            let local = cell.local(point.reference);
            let mut s = chordal.at(&local);
            s.add(1.0, lift);
            let (a, tau) = (conductivity.at(point.x), tau.flux(point));
            add(CellPoint {
                x: point.x,
                weight: point.weight,
                determinant: local.determinant,
                u: u.value,
                s: s.value,
                square: in_cell(&a, u.gradient, s.gradient, tau),
                size: size_in_cell(&a, u.gradient, s.gradient, tau),
            });
        }
        Ok(())
    }

    /// 2∫[(σ·n − q)(S − ψ) + (τ·n − q̄)(u − ψ) + (S − u)(q − q̄)] over an edge of C.
    fn contact(&self, edge: usize) -> Result<Weighed> {
        let (Some(q), Some(gap)) = (self.data(edge, Field::Flux), self.data(edge, Field::Gap))
        else {
            return Ok([0.0; 2]);
        };
        if !self.problem.loads.spans.is_empty() {
            return self.two_sided(edge);
        }
        let mean = q.mean(self.problem.segment(edge))?;
        let term = |point: EdgePoint| {
            let (q, psi) = (q.finite_at(point.x)?, gap.finite_at(point.x)?);
            let EdgePoint { weight, u, s, sigma, tau, .. } = point;
            let contact =
                plus(twice(weight, [sigma, q], [s, psi]), twice(weight, [tau, mean], [u, psi]));
            Ok(plus(contact, twice(weight, [s, u], [q, mean])))
        };
        self.on_edge(edge, term)
    }

    /// 2∫(S − u)(g − ḡ) over an edge of N.
    fn neumann(&self, edge: usize) -> Result<Weighed> {
        let Some(g) = self.data(edge, Field::Flux).filter(|g| g.constant().is_none()) else {
            return Ok([0.0; 2]);
        };
        let mean = g.mean(self.problem.segment(edge))?;
        let term = |point: EdgePoint| {
            Ok(twice(point.weight, [point.s, point.u], [g.finite_at(point.x)?, mean]))
        };
        self.on_edge(edge, term)
    }

    /// ∫[h(u − S)² + ((σ − τ)·n)²/h] over an edge of R, 0 on others.
    fn robin(&self, edge: usize) -> Result<Weighed> {
        let problem = self.problem;
        let h = Sum::transfer(problem, edge);
        let Some(coefficient) = h else { return Ok([0.0; 2]) };
        let term = |point: EdgePoint| {
            let h = coefficient.finite_at(point.x)?;
            let EdgePoint { weight, u, s, sigma, tau, .. } = point;
            let square = weight * on_robin(h, u - s, sigma - tau);
            let [_, size] = twice(weight, [u, s], [u, s]);
            let [_, of_flux] = twice(weight, [sigma, tau], [sigma, tau]);
            Ok([square, h * size + if h > 0.0 { of_flux / h } else { 0.0 }])
        };
        self.on_edge(edge, term)
    }

    fn data(&self, edge: usize, field: Field) -> Option<Sum<'_>> {
        Sum::on_edge(self.problem, edge, field)
    }
}

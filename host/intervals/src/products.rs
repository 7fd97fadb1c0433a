//! Energies and products of the residuals r = τ − A∇s of the solution and ζ ∓ A∇z of the weights, cell by cell and on R:
//! ```text
//!   ⟨a, b⟩ = ∫ a·A⁻¹b + ∫_R a b/h          r on R is τ·n + h (s − u_ext),   ζ·n ± (h z − κ) that of ζ ∓ A∇z
//! ```

use std::collections::{BTreeMap, BTreeSet};

use super::answer::OnMesh;
use super::dual::Weights;
use super::goal::Goal;
use super::squares::Products;
use super::stored::Stored;
use super::values::largest;
use signorini_certify::admissible::Admissible;
use signorini_certify::cell::{Cell, Local};
use signorini_certify::conductivity::{Conductivity, apply, dot, inverse};
use signorini_certify::curved;
use signorini_certify::deviation::{Deviation, Deviations};
use signorini_certify::factor::coefficients;
use signorini_certify::robin::robin;
use signorini_certify::transfer_points::{EdgePoint, MISSED_BETWEEN, unseen};
use signorini_kernel::Real;
use signorini_problem::Problem;
use signorini_problem::field::CellField;
use signorini_problem::pieces::PiecePoint;
use signorini_problem::quadrature::{DATA_POINTS, gauss};
use signorini_problem::threads::in_portions;
use signorini_scene::error::Result;

/// The solution's side of the products.
pub(super) struct Residual<'p> {
    problem: &'p Problem,
    s: Admissible<'p>,
    /// The fluxes of transfer laws, where they are not those of τ.
    laws: Option<&'p [f64]>,
    deviations: &'p Deviations<'p>,
    /// Points of the cells in which s follows data, with ∇s there: these take long to evaluate.
    lifted: BTreeMap<usize, Vec<(PiecePoint, [f64; 2])>>,
    stored: Option<Stored<'p>>,
}

/// The points of a cell in which s follows data, with ∇s at each.
fn gradients(
    problem: &Problem,
    s: &Admissible,
    deviations: &Deviations,
    at: usize,
) -> Result<Vec<(PiecePoint, [f64; 2])>> {
    let (cell, conductivity) = (Cell::of(problem, at), Conductivity::of(problem, at));
    let s = s.on_cell(problem, at, deviations);
    let points = match conductivity.cut_for_curves() {
        Some(pieces) => pieces.many_points(cell).collect(),
        None => curved::points_along_sides(problem, at, deviations, &gauss(curved::POINTS))?
            .into_iter()
            .map(|point| conductivity.resolved(point))
            .collect::<Vec<_>>(),
    };
    let along = |of: PiecePoint| Ok((of, s.at(&cell.local(of.point.reference))?.gradient));
    points.into_iter().map(along).collect()
}

/// r, ζ and A∇z at one point; on R the flux that passes, that of ζ beyond its density, and −h (z − its value).
struct Fluxes<T> {
    residual: T,
    zeta: T,
    gradient: T,
}

/// A flux below this part of the largest is what a solver rounds.
const ROUNDING: f64 = 1e-12;

impl Fluxes<f64> {
    /// Whether nothing passes but what is below these, of r and of ζ.
    fn is_rounding(&self, [of_residual, of_zeta]: [f64; 2]) -> bool {
        self.residual.abs() <= of_residual && self.zeta.abs() <= of_zeta
    }
}

impl<T: Copy> Fluxes<T> {
    /// Their share of all products, by the inner product at the point.
    fn products(&self, inner: impl Fn(T, T) -> f64) -> Products {
        let Self { residual, zeta, gradient } = *self;
        let (of_zeta, of_gradient) = (inner(zeta, zeta), inner(gradient, gradient));
        Products {
            residual: inner(residual, residual),
            weights: of_zeta - 2.0 * inner(zeta, gradient) + of_gradient,
            both: inner(residual, zeta) + inner(residual, gradient),
            off: 0.0,
            sizes: [of_gradient, of_zeta],
            inside: [0.0; 2],
        }
    }
}

impl<'p> Residual<'p> {
    /// Products of a solution.
    ///
    /// # Errors
    /// Data that are not finite.
    pub fn new(&OnMesh { problem, answer, deviations }: &OnMesh<'p>) -> Result<Self> {
        let s = answer.certified.admissible();
        let cell = |of: &Deviation| problem.topology.first_side(of.edge).0;
        let cells: BTreeSet<usize> = deviations.found.iter().map(cell).collect();
        let lifted = cells.into_iter().map(|at| Ok((at, gradients(problem, &s, deviations, at)?)));
        let lifted = lifted.collect::<Result<_>>()?;
        let stored = Stored::of(problem, answer.scalar);
        Ok(Self { problem, s, laws: None, deviations, lifted, stored })
    }

    /// These with other fluxes through the edges of transfer laws, in their order.
    pub fn with_laws(self, laws: &'p [f64]) -> Self {
        Self { laws: Some(laws), ..self }
    }

    /// The products with these weights.
    ///
    /// # Errors
    /// Data that are not finite.
    pub fn with(&self, goal: &Goal, weights: &Weights) -> Result<Products> {
        let z = weights.admissible();
        let cells = in_portions(self.problem.cells(), |cells| {
            let mut sum = Products::default();
            for at in cells {
                self.add_cell(at, &z, &mut sum);
                if let Some(stored) = &self.stored {
                    sum = sum.and(stored.products(at, goal, [&self.s, &z]));
                }
            }
            Ok(sum)
        })?;
        let mut sum = cells.into_iter().fold(Products::default(), Products::and);
        self.add_transfer(goal, &z, &mut sum)?;
        Ok(sum)
    }

    fn add_cell(&self, at: usize, z: &Admissible, sum: &mut Products) {
        let problem = self.problem;
        let is_lifted = self.lifted.contains_key(&at);
        if let Some(cut) = problem.cuts().get(&at).filter(|_| !is_lifted) {
            let of = |fields| coefficients(problem, at, fields);
            *sum = sum.and(Products::on_pieces(cut, of(&self.s), of(z)).widened(cut.missed));
            return;
        }
        let (cell, conductivity) = (Cell::of(problem, at), Conductivity::of(problem, at));
        let z_here = z.chordal(problem, at);
        let [tau, zeta] = [self.s.tau, z.tau].map(|flux| CellField::new(problem, at, flux, flux));
        let mut own = Products::default();
        let mut add = |of: &PiecePoint, local: &Local, along_s: [f64; 2]| {
            let (point, a) = (&of.point, &of.below);
            let (tau, along_z) = (tau.flux(point), z_here.at(local).gradient);
            let flux = apply(a, along_s);
            let here = Fluxes {
                residual: [tau[0] - flux[0], tau[1] - flux[1]],
                zeta: zeta.flux(point),
                gradient: apply(a, along_z),
            };
            let inverse = inverse(a);
            let seen = here.products(|a, b| dot(apply(&inverse, a), b));
            let beyond = PiecePoint { share: 1.0, ..*of }.open(along_z);
            let seen = seen.beside(of.share, [along_s, along_z].map(|v| of.open(v)), beyond);
            own = own.and(seen.times(point.weight));
        };
        if let Some(lifted) = self.lifted.get(&at) {
            for (of, along_s) in lifted {
                add(of, &cell.local(of.point.reference), *along_s);
            }
        } else {
            let s = self.s.chordal(problem, at);
            for of in conductivity.points(&cell, &gauss(conductivity.points_for(&cell, 2))) {
                let local = cell.local(of.point.reference);
                add(&of, &local, s.at(&local).gradient);
            }
        }
        let [missed, _] = conductivity.missed(cell);
        *sum = sum.and(own.widened(missed));
    }

    fn add_transfer(&self, goal: &Goal, z: &Admissible, sum: &mut Products) -> Result<()> {
        let problem = self.problem;
        let transfer = robin(problem)?;
        let rounding = [self.s.tau, z.tau].map(|flux| ROUNDING * largest(flux));
        for (at, (record, points)) in problem.loads.robin.iter().zip(&transfer).enumerate() {
            let edge = record.edge as usize;
            let length = problem.lengths[edge];
            let (value, density) = (goal.value_on(problem, edge), goal.density_on(problem, edge));
            let z_flux = z.tau[edge];
            let flux = self.laws.map_or(self.s.tau[edge], |laws| laws[at]);
            let unseen = unseen(problem, edge)?;
            let own = f64::GAUSS[DATA_POINTS - 1].iter().zip(points);
            let own =
                own.map(|(&[t, weight], &[h, ambient])| EdgePoint::seen(t, weight, h, ambient));
            let missed = unseen.as_ref().map_or(0.0, |_| MISSED_BETWEEN);
            let mut of_edge = Products::default();
            for point in unseen.unwrap_or_else(|| own.collect()) {
                let [h, more] =
                    [point.between[0], point.between[1] - point.between[0]].map(|h| h / length);
                let along = self.deviations.on(edge);
                let s = self.s.on_edge(problem, edge, along, point.t)? - point.ambient;
                let z = z.on_edge(problem, edge, None, point.t)? - value;
                let here = Fluxes {
                    residual: flux / length + h * s,
                    zeta: z_flux / length - density,
                    gradient: -h * z,
                };
                // Where h is 0 nothing passes, and what the solver rounds of nothing is none.
                if h == 0.0 && here.is_rounding(rounding.map(|flux| flux / length)) {
                    continue;
                }
                let share = if more > 0.0 { more / h } else { 0.0 };
                let open = |v: f64| (share.min(1.0) * more).sqrt() * v.abs();
                let seen = here.products(|a, b| a * b / h);
                let seen = seen.beside(share.min(1.0), [open(s), open(z)], more.sqrt() * z.abs());
                of_edge = of_edge.and(seen.times(point.weight * length));
            }
            *sum = sum.and(of_edge.widened(missed));
        }
        Ok(())
    }
}

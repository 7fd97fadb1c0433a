//! The way back from a condensed answer: u and σ_h on the whole mesh, and the s and τ of its bound.

use std::collections::BTreeSet;
use std::ops::Range;

use faer::linalg::solvers::Solve;
use faer::{Mat, Side};

use super::chain::is_left_out;
use super::elimination::Field;
use super::form::Admissibles;
use super::{CondensedModel, Form};
use signorini_certify::admissible::Following;
use signorini_certify::{CertifiedFields, Column};
use signorini_kernel::mesh::boundary::Robin;
use signorini_problem::Problem;
use signorini_scene::error::Result;

/// The fields of all columns: what condensation leaves out.
#[derive(Debug)]
pub struct Recovery {
    pub(super) fields: Vec<Field>,
    pub(super) admissibles: Option<Admissibles>,
}

impl Recovery {
    /// Edge means of u_h and ∫_E σ_h·n along each edge, for inputs `p` (1 first) and scaled openings `x`.
    pub fn field(&self, of: &CondensedModel, p: &[f64], x: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let factors = columns(of, p, x);
        let edges = self.fields.first().map_or(0, |field| field.u.len());
        let (mut u, mut flux) = (vec![0.0; edges], vec![0.0; edges]);
        for (factor, field) in
            factors.iter().zip(&self.fields).filter(|(factor, _)| **factor != 0.0)
        {
            u.iter_mut().zip(&field.u).for_each(|(sum, u)| *sum += factor * u);
            flux.iter_mut().zip(&field.flux).for_each(|(sum, flux)| *sum += factor * flux);
        }
        (u, flux)
    }

    /// Multiplies columns that are no inputs of the scene by `unit`, as [`CondensedModel::scale_inputs`] does.
    pub(super) fn scale_inputs(&mut self, columns: Range<usize>, unit: f64) {
        self.fields[columns.clone()].iter_mut().for_each(|field| field.scale(unit));
        for table in self.admissibles.iter_mut().flat_map(|of| [&mut of.s, &mut of.fluxes]) {
            let width = table.columns;
            let rows = table.values.chunks_mut(width);
            rows.for_each(|row| row[columns.clone()].iter_mut().for_each(|entry| *entry *= unit));
        }
    }

    /// s and the mended τ that the bound of (p, x) is about; `None` where there is no bound.
    pub fn admissible(
        &self,
        of: &CondensedModel,
        problem: &Problem,
        p: &[f64],
        x: &[f64],
    ) -> Option<CertifiedFields> {
        let (Ok(form), Some(Admissibles { s, fluxes, functions, .. })) =
            (&of.certificate, &self.admissibles)
        else {
            return None;
        };
        let unit = of.energy_unit;
        let corrections = form.correction(&of.allowed(p), p.len(), x).into_iter().map(|d| unit * d);
        let z: Vec<f64> = columns(of, p, x).into_iter().chain(corrections).collect();
        let (mended, by) = self.mended(of, form, p, x)?;
        let at = |row: &[f64], z: &[f64]| row.iter().zip(z).map(|(a, b)| a * b).sum::<f64>();
        let tau = (0..problem.ends.len()).map(|edge| at(fluxes.row(edge), &mended) + by(edge));
        let fields = functions.fields(problem, |place| at(s.row(place), &z), tau.collect());
        let following = Following::Except(self.left_out(problem));
        Some(CertifiedFields { following, ..fields })
    }

    /// Factors of columns, and fluxes beside them, whose sum is the mended τ.
    fn mended<'r>(
        &'r self,
        of: &CondensedModel,
        form: &Form,
        p: &[f64],
        x: &[f64],
    ) -> Option<(Vec<f64>, impl Fn(usize) -> f64 + 'r)> {
        let mending = self.admissibles.as_ref()?.mending.as_ref();
        let (x, residuals) = match mending {
            Some(_) => (x.to_vec(), of.lacking(form, p, x)?),
            None => (of.mended(form, p, x)?, Vec::new()),
        };
        let residuals: Vec<f64> = residuals.iter().map(|r| of.energy_unit * r).collect();
        let by = move |edge: usize| {
            let row = mending.map_or(&[][..], |fluxes| fluxes.row(edge));
            row.iter().zip(&residuals).map(|(flux, r)| flux * r).sum()
        };
        Some((columns(of, p, &x), by))
    }

    /// The columns that s and τ are sums of: a unit of every input, amplitude, opening and correction, in this order; nothing where
    /// there is no bound. `problem` has the transfer coefficients that are asked for.
    ///
    /// # Errors
    /// Data that are not finite.
    pub fn columns(&self, problem: &Problem) -> Result<Vec<Column>> {
        let Some(Admissibles { s, fluxes, functions, .. }) = &self.admissibles else {
            return Ok(Vec::new());
        };
        let inputs = problem.scene.inputs.len();
        let silent = problem.left_with(&[])?;
        let edges = problem.ends.len();
        let following = Following::Except(self.left_out(problem));
        let column = |j: usize| {
            let of = if j <= inputs { problem.left_with(&[j])? } else { silent.clone() };
            // A correction has no flux and no means.
            let of_fluxes = |place: usize| fluxes.row(place).get(j).copied().unwrap_or(0.0);
            let tau = (0..edges).map(of_fluxes).collect();
            let fields = functions.fields(problem, |place| s.row(place)[j], tau);
            let certified = CertifiedFields { following: following.clone(), ..fields };
            let by_law = |law: &Robin<f64, u32>| {
                let mean = of_fluxes(edges + law.edge as usize);
                law.ambient - law.coefficient * mean
            };
            let has_means = fluxes.values.len() > edges * fluxes.columns;
            let laws = of.loads.robin.iter().filter(|_| has_means).map(by_law).collect();
            Ok(Column { problem: of, certified, laws })
        };
        (0..s.columns).map(column).collect()
    }

    /// The edges between vertices at which s is free: it follows no curve there.
    fn left_out(&self, problem: &Problem) -> Vec<u32> {
        let released = self.admissibles.iter().flat_map(|of| &of.released);
        let released: BTreeSet<u32> = released.map(|(vertex, _)| *vertex).collect();
        let ends = problem.ends.iter().zip(0_u32..);
        let left_out = ends.filter(|(ends, _)| is_left_out(**ends, &released));
        left_out.map(|(_, edge)| edge).collect()
    }
}

/// Factors of the columns of p and x, which are those of U = 1.
fn columns(of: &CondensedModel, p: &[f64], x: &[f64]) -> Vec<f64> {
    p.iter().copied().chain(x.iter().map(|x| of.energy_unit * x)).collect()
}

impl CondensedModel {
    /// By how much the residual changes where it is mended.
    fn lacking(&self, form: &Form, p: &[f64], x: &[f64]) -> Option<Vec<f64>> {
        let before = self.residual(p, x);
        let mut after = before.clone();
        form.mend(&self.opening, &self.ends_of(p), &mut after, x)?;
        Some(after.iter().zip(&before).map(|(after, before)| after - before).collect())
    }

    /// x with which the residual is the mended one; the part that contact alone holds stays where it is.
    pub(super) fn mended(&self, form: &Form, p: &[f64], x: &[f64]) -> Option<Vec<f64>> {
        let (n, lacking) = (self.contact, self.lacking(form, p, x)?);
        if n == 0 {
            return Some(Vec::new());
        }
        let mut constant = vec![0.0; n];
        let first = form.floating.first().map_or(1.0, |&first| self.opening[first]);
        form.floating.iter().for_each(|&i| constant[i] = first / self.opening[i]);
        let matrix = Mat::from_fn(n, n, |i, j| self.matrix[n * i + j] + constant[i] * constant[j]);
        let change = Mat::from_fn(n, 1, |i, _| lacking[i]);
        let change = matrix.llt(Side::Lower).ok()?.solve(change);
        Some(x.iter().enumerate().map(|(i, x)| x + change[(i, 0)]).collect())
    }
}

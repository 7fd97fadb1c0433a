//! A condensed model for every value of one transfer coefficient: its matrix follows by one division a mode.
//!
//! One input adds δπ to the coefficient of one boundary, so K(δ) = K + δW with W_EE = ∫π on its edges R. With K⁻¹ restricted to
//! R, W^½ (K⁻¹)_RR W^½ = Q diag(ν) Qᵀ, and with the fields g_k = K⁻¹ W^½ q_k of its modes
//! ```text
//!   u(δ) = u(0) + Σ_k y_k g_k,    y_k = δ/(1 + δν_k) a_k·(p, x),    a_k = q_kᵀ (W^−½ e − W^½ u_R),
//! ```
//! where u(0) is the field of (p, x) with δ = 0, u_R its means over R, and e = ∫π u_ext, linear in p. So the amplitudes y are
//! inputs of the model with δ = 0: its loads, outputs and fields have a column for each, and
//! ```text
//!   Ŝ(δ) = Ŝ + Σ_k δ/(1 + δν_k) α_k α_kᵀ,    B̂(δ) = B̂ − Σ_k δ/(1 + δν_k) α_k β_kᵀ,    a_k = (β_k, U α_k).
//! ```
//! Exact to rounding, however many modes there are. Two coefficients are not diagonalised together.
//!
//! The flux through R is that of its law, ∫τ·n = ∫h(u_ext − u_E). Where h is constant along every edge, the residual of the bound is
//! h(s − u_E − u_ext + ū_ext) there, whatever h, and
//! ```text
//!   |A^½∇s − A^{−½}τ|² + ∫_R …/h = |F(z)|² + δ |F_π(z)|²,    z = (p, y, x, d),   δ = 0 at the least h.
//! ```
//! What mends r costs most there too.
//!
//! A mode that is left out, y_k = 0, leaves the flux of the law off by δ a_k: (Σ δ a_k²)^½ more, and no other part of the bound
//! knows of it ([`LeftOut`]).

mod passing;
mod signs;
mod values;

use super::factor::{packed, triangular};
use super::laws::Laws;
use super::rounding::{FEW, terms};
use super::{CondensedModel, Pieces, Recovery};
use passing::{Mode, Passing, combined};
use signorini_certify::TermData;
use signorini_certify::robin::{RobinPoints, robin};
use signorini_problem::quadrature::DATA_POINTS;
use signorini_problem::{Approach, Problem, TransferPattern};
use signorini_scene::error::{InputError, Result};
use signorini_scene::scene::Field as SceneField;
use signs::slack;

/// See the module.
#[derive(Debug, Clone)]
pub struct ModalModel {
    /// The model at [`ModalModel::origin`]; its inputs are those of the scene, then y.
    pub model: CondensedModel,
    /// m, the number of its inputs that are those of the scene with the constant 1.
    pub inputs: usize,
    /// The place of the coefficient's input among them.
    pub input: usize,
    /// Value of that input where δ = 0.
    pub origin: f64,
    /// ν_k
    pub compliance: Vec<f64>,
    /// β_k, m numbers a mode.
    pub of_inputs: Vec<Vec<f64>>,
    /// U α_k, n numbers a mode.
    pub of_contact: Vec<Vec<f64>>,
    /// F_π; nothing where there is no bound.
    pub of_laws: Option<LawsForm>,
    /// Cost of the modes that are no part of it.
    pub left_out: LeftOut,
    /// Where the matrix is an M-matrix whatever the coefficient is: at most how far above 0 the sum of what is positive of a
    /// row of Ŝ(δ) may be by rounding, off the diagonal.
    pub slack: Option<f64>,
}

/// (Σ over the modes left out of δ a_k²)^½ is at most √δ (Σ|p_j| of_inputs_j + Σ x_i of_contact_i).
#[derive(Debug, Clone)]
pub struct LeftOut {
    /// How many.
    pub count: usize,
    /// The norm of all their β_k, a number for each input.
    pub of_inputs: Vec<f64>,
    /// The norm of all their U α_k, a number for each contact edge.
    pub of_contact: Vec<f64>,
}

/// F_π
#[derive(Debug, Clone)]
pub struct LawsForm {
    /// By columns.
    pub factor: Vec<f64>,
    /// Rounding in f64 that each may hide.
    pub lost: Vec<f64>,
}

/// Condenses `problem`, one input of which changes a coefficient, for all values of its inputs. Modes whose share, of 1 in the
/// squares of x and of the inputs, is at most `negligible` are left out.
///
/// # Errors
/// Several inputs of coefficients, a pattern that is negative on an edge; as for [`super::condense`].
pub fn modal(problem: &Problem, negligible: f64) -> Result<(ModalModel, Recovery)> {
    let input = only_input(problem)?;
    Approach::Modes.check(problem)?;
    let [origin, most] = problem.scene.inputs[input].interval();
    let problem = &at_least(problem, input, origin)?;
    let pattern = problem.transfer_pattern(input)?;
    let range = Passing::new(problem, &pattern, input)?;
    let mut pieces = Pieces::new(problem)?;
    let m = pieces.patterns.len();
    let mut fields = pieces.fields(range.unit_loads(problem))?;
    let modes = range.modes(&fields, problem, &pattern)?;
    let free = problem.topology.counts.free;
    let stiffness = pieces.edges.iter().zip(&fields.openings);
    let openings = stiffness.map(|(edge, field)| field.flux[free + edge].sqrt().recip());
    let share = shares(&modes, problem, most - origin, &openings.collect::<Vec<_>>());
    let (kept, others): (Vec<_>, Vec<_>) =
        modes.iter().zip(share).partition(|(_, share)| *share > negligible);
    let of_kept = kept.iter().map(|(mode, _)| combined(&mode.weights, &fields.more));
    fields.inputs.extend(of_kept.collect::<Vec<_>>());
    let silent = TermData::silent(problem)?;
    pieces.patterns.resize(m + kept.len(), silent);
    pieces.laws = laws(problem, &pattern, most - origin)?;
    let (mut model, recovery) = pieces.model(fields)?;
    if pieces.laws.is_none() {
        model.certificate =
            Err("a transfer coefficient that changes varies along an edge".to_owned());
    }
    let of_laws = of_laws(&pieces, &recovery, &model)?;
    let alpha = |mode: &Mode| -> Vec<f64> {
        model.opening.iter().zip(&mode.of_contact).map(|(d, of)| d * of).collect()
    };
    let rows = |of: &[(&Mode, f64)]| -> (Vec<_>, Vec<_>) {
        of.iter().map(|(mode, _)| (mode.of_inputs.clone(), alpha(mode))).unzip()
    };
    let ((of_inputs, of_contact), (beta, of_others)) = (rows(&kept), rows(&others));
    let modal = ModalModel {
        of_inputs,
        of_contact,
        slack: slack(&model, &modes, &modes.iter().map(alpha).collect::<Vec<_>>()),
        left_out: LeftOut {
            count: others.len(),
            of_inputs: norms(&beta, m),
            of_contact: norms(&of_others, model.contact),
        },
        inputs: m,
        input: input + 1,
        origin,
        compliance: kept.iter().map(|(mode, _)| mode.compliance).collect(),
        of_laws,
        model,
    };
    Ok((modal, recovery))
}

/// The share of each mode: that of the energy of unit openings, Ŝ having a diagonal of 1 where they are scaled by `openings`, for
/// the largest δ, or that of what all inputs make of all modes, the larger.
fn shares(modes: &[Mode], problem: &Problem, change: f64, openings: &[f64]) -> Vec<f64> {
    let square = |of: &[f64], sizes: &[f64]| -> f64 {
        of.iter().zip(sizes).map(|(of, size)| (of * size).powi(2)).sum()
    };
    let sizes = sizes(problem);
    let all: f64 = modes.iter().map(|mode| square(&mode.of_inputs, &sizes)).sum();
    let share = |mode: &Mode| {
        let of_inputs = if all > 0.0 { square(&mode.of_inputs, &sizes) / all } else { 0.0 };
        (change * square(&mode.of_contact, openings)).max(of_inputs)
    };
    modes.iter().map(share).collect()
}

/// How large the constant and every input may be: at the end of its range, or by its default where there is none.
fn sizes(problem: &Problem) -> Vec<f64> {
    let of_inputs = problem.scene.inputs.iter().map(|input| {
        let most = input.interval().into_iter().fold(0.0, |most: f64, end| most.max(end.abs()));
        let default = if input.default == 0.0 { 1.0 } else { input.default.abs() };
        if most.is_finite() { most } else { default }
    });
    std::iter::once(1.0).chain(of_inputs).collect()
}

/// The norms of `count` columns.
fn norms(rows: &[Vec<f64>], count: usize) -> Vec<f64> {
    let square = |j: usize| rows.iter().map(|row| row[j] * row[j]).sum::<f64>();
    (0..count).map(|j| square(j).sqrt()).collect()
}

/// `problem` with the input of the coefficient at the lower end of its range.
fn at_least(problem: &Problem, input: usize, origin: f64) -> Result<Problem> {
    let values = problem.scene.inputs.iter().map(|input| input.default);
    let mut values: Vec<f64> = values.collect();
    values[input] = origin;
    problem.with_inputs(&values)
}

/// The part of the range for which s is the best function.
const MIDDLE: f64 = 0.1;

/// The laws of R, where h is constant along each of its edges.
fn laws(problem: &Problem, pattern: &TransferPattern, range: f64) -> Result<Option<Laws>> {
    let is_constant = |(points, added): (&RobinPoints, &[f64; DATA_POINTS])| {
        added[0] == 0.0 || {
            points.iter().all(|point| point[0] == points[0][0])
                && added.iter().all(|h| *h == added[0])
        }
    };
    let points = robin(problem)?;
    let all = points.iter().zip(&pattern.points).all(is_constant);
    let shares = pattern.integrals.clone();
    Ok(all.then_some(Laws { shares, change: MIDDLE * range }))
}

/// F_π in the units of the model.
fn of_laws(
    pieces: &Pieces,
    recovery: &Recovery,
    model: &CondensedModel,
) -> Result<Option<LawsForm>> {
    let (Some(laws), Some(of)) = (&pieces.laws, &recovery.admissibles) else { return Ok(None) };
    let blocks = laws.blocks(pieces, &of.functions)?;
    let mut factor = packed(&triangular(&blocks, &of.s, &of.fluxes));
    let of_inputs = model.inputs * (model.inputs + 1) / 2;
    factor.iter_mut().take(of_inputs).for_each(|entry| *entry /= model.energy_unit);
    let mut lost = terms(&blocks, &of.s, &of.fluxes);
    lost.iter_mut().for_each(|size| *size *= FEW);
    lost.iter_mut().take(model.inputs).for_each(|size| *size /= model.energy_unit);
    Ok(Some(LawsForm { factor, lost }))
}

fn only_input(problem: &Problem) -> Result<usize> {
    let scene = &problem.scene;
    let mut all = scene.inputs.iter().enumerate();
    let mut next = || all.by_ref().find(|(_, of)| of.field.value == SceneField::Coefficient);
    match (next(), next()) {
        (Some((first, _)), None) => Ok(first),
        (_, Some((_, second))) => {
            let message = "a second coefficient: the modes of two are not the same";
            Err(scene.error(&second.field, message).hint("take the full model").into())
        }
        (None, None) => {
            Err(InputError::new("no input adds to a transfer coefficient").file(&scene.path).into())
        }
    }
}

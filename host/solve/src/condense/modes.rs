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

use faer::{Mat, Side};

use super::columns::silent;
use super::elimination::{Field, FieldLoads};
use super::factor::triangular;
use super::form::packed;
use super::patterns::Pattern;
use super::residual::Laws;
use super::{CondensedModel, Measure, Pieces, Recovery};
use crate::certify::robin::{RobinPoints, robin};
use crate::problem::{Approach, Problem, TransferPattern};
use crate::quadrature::DATA_POINTS;
use signorini_scene::error::{InputError, Result};
use signorini_scene::scene::Field as SceneField;

/// See the module.
#[derive(Debug, Clone)]
pub struct ModalModel {
    /// The model at [`ModalModel::origin`]; its inputs are those of the scene, then y.
    pub model: CondensedModel,
    /// m, the number of its inputs that are those of the scene with the constant 1.
    pub inputs: usize,
    /// The place of the coefficient's input among them.
    pub input: usize,
    /// What that input is where δ = 0.
    pub origin: f64,
    /// ν_k
    pub compliance: Vec<f64>,
    /// β_k, m numbers a mode.
    pub of_inputs: Vec<Vec<f64>>,
    /// U α_k, n numbers a mode.
    pub of_contact: Vec<Vec<f64>>,
    /// F_π by columns; nothing where there is no bound.
    pub of_laws: Option<Vec<f64>>,
}

/// Condenses `problem`, one input of which changes a coefficient, for all values of its inputs.
///
/// # Errors
/// Several inputs of coefficients, a pattern that is negative on an edge; as for [`super::condense`].
pub fn modal(problem: &Problem) -> Result<(ModalModel, Recovery)> {
    let input = only_input(problem)?;
    Approach::Modes.check(problem)?;
    let [origin, most] = problem.scene.inputs[input].interval();
    let problem = &at_least(problem, input, origin)?;
    let pattern = problem.transfer_pattern(input)?;
    let range = Passing::new(problem, &pattern, input)?;
    let mut pieces = Pieces::new(problem)?;
    let m = pieces.patterns.len();
    let mut fields = pieces.fields(range.unit_loads(problem))?;
    let modes = range.modes(&fields.more, problem)?;
    let of_fields = |all: &[Field]| -> Vec<Vec<f64>> {
        all.iter().map(|field| modes.iter().map(|mode| range.seen(mode, field)).collect()).collect()
    };
    let mut of_inputs = of_fields(&fields.inputs);
    for (term, products) in &pattern.ambient {
        let brought = modes.iter().map(|mode| range.brought(mode, products));
        of_inputs[*term].iter_mut().zip(brought).for_each(|(sum, more)| *sum += more);
    }
    let of_openings = of_fields(&fields.openings);
    fields.inputs.extend(modes.iter().map(|mode| combined(&mode.weights, &fields.more)));
    let silent = Pattern::silent(problem)?;
    pieces.patterns.resize(m + modes.len(), silent);
    pieces.laws = laws(problem, &pattern, most - origin)?;
    let (mut model, recovery) = pieces.model(fields)?;
    if pieces.laws.is_none() {
        model.certificate =
            Err("a transfer coefficient that changes varies along an edge".to_owned());
    }
    let of_laws = of_laws(problem, &pieces, &recovery, &model)?;
    let transposed = |columns: &[Vec<f64>], units: &[f64]| -> Vec<Vec<f64>> {
        let row = |k: usize| columns.iter().zip(units).map(|(of, unit)| unit * of[k]).collect();
        (0..modes.len()).map(row).collect()
    };
    let modal = ModalModel {
        of_inputs: transposed(&of_inputs, &vec![1.0; m]),
        of_contact: transposed(&of_openings, &model.opening),
        model,
        inputs: m,
        input: input + 1,
        origin,
        compliance: modes.iter().map(|mode| mode.compliance).collect(),
        of_laws,
    };
    Ok((modal, recovery))
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
    let points = robin(problem, problem.time)?;
    let all = points.iter().zip(&pattern.points).all(is_constant);
    let shares = pattern.integrals.clone();
    Ok(all.then_some(Laws { shares, change: MIDDLE * range }))
}

/// F_π in the units of the model.
fn of_laws(
    problem: &Problem,
    pieces: &Pieces,
    recovery: &Recovery,
    model: &CondensedModel,
) -> Result<Option<Vec<f64>>> {
    let (Some(laws), Some(of)) = (&pieces.laws, &recovery.admissibles) else { return Ok(None) };
    let blocks = laws.blocks(problem, &pieces.patterns, &of.functions)?;
    let mut factor = packed(&triangular(&blocks, &of.s, &of.fluxes));
    let of_inputs = model.inputs * (model.inputs + 1) / 2;
    factor.iter_mut().take(of_inputs).for_each(|entry| *entry /= model.energy_unit);
    Ok(Some(factor))
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

/// The edges R with W^½.
struct Passing {
    edges: Vec<usize>,
    roots: Vec<f64>,
    /// Of each edge, its place among the transfer laws.
    laws: Vec<usize>,
}

/// A mode: g_k = Σ weights · (field of a unit on an edge of R).
struct Mode {
    vector: Vec<f64>,
    weights: Vec<f64>,
    compliance: f64,
}

impl Passing {
    fn new(problem: &Problem, pattern: &TransferPattern, input: usize) -> Result<Self> {
        if pattern.integrals.iter().any(|&integral| integral < 0.0) {
            let scene = &problem.scene;
            let message = "negative on an edge: modes need a pattern of one sign";
            return Err(scene.error(&scene.inputs[input].pattern, message).into());
        }
        let acts = pattern.integrals.iter().enumerate().filter(|(_, integral)| **integral > 0.0);
        let laws: Vec<usize> = acts.map(|(law, _)| law).collect();
        let edges = laws.iter().map(|&law| problem.loads.robin[law].edge as usize).collect();
        let roots = laws.iter().map(|&law| pattern.integrals[law].sqrt()).collect();
        Ok(Self { edges, roots, laws })
    }

    /// 1 on each edge of R.
    fn unit_loads(&self, problem: &Problem) -> Vec<FieldLoads> {
        let silent = silent(problem);
        let unit = |&law: &usize| {
            let mut loads = silent.clone();
            loads.robin[law].ambient = 1.0;
            FieldLoads { contact: vec![0.0; problem.topology.counts.contact], loads }
        };
        self.laws.iter().map(unit).collect()
    }

    /// Q and ν from the fields of units.
    fn modes(&self, units: &[Field], problem: &Problem) -> Result<Vec<Mode>> {
        let entry = |i: usize, j: usize| self.roots[i] * self.roots[j] * units[j].u[self.edges[i]];
        let count = self.edges.len();
        let matrix = Mat::from_fn(count, count, |i, j| 0.5 * (entry(i, j) + entry(j, i)));
        let failed = |_| {
            let message = "the modes of the transfer coefficient cannot be found";
            InputError::new(message).file(&problem.scene.path)
        };
        let found = matrix.self_adjoint_eigen(Side::Lower).map_err(failed)?;
        let mode = |k: usize| {
            let vector: Vec<f64> = (0..count).map(|edge| found.U()[(edge, k)]).collect();
            let weights = vector.iter().zip(&self.roots).map(|(q, root)| q * root).collect();
            Mode { vector, weights, compliance: found.S()[k] }
        };
        Ok((0..count).map(mode).collect())
    }

    /// −q_kᵀ W^½ u_R
    fn seen(&self, mode: &Mode, field: &Field) -> f64 {
        let means = self.edges.iter().map(|&edge| field.u[edge]);
        -mode.weights.iter().zip(means).map(|(weight, u)| weight * u).sum::<f64>()
    }

    /// q_kᵀ W^−½ e, `products` being ∫π u_ext of every law.
    fn brought(&self, mode: &Mode, products: &[f64]) -> f64 {
        let of_edges = self.laws.iter().zip(&self.roots).map(|(&law, root)| products[law] / root);
        mode.vector.iter().zip(of_edges).map(|(q, e)| q * e).sum()
    }
}

fn combined(weights: &[f64], fields: &[Field]) -> Field {
    let sum = |of: fn(&Field) -> &Vec<f64>| {
        let mut sum = vec![0.0; fields.first().map_or(0, |field| of(field).len())];
        for (weight, field) in weights.iter().zip(fields) {
            sum.iter_mut().zip(of(field)).for_each(|(sum, entry)| *sum += weight * entry);
        }
        sum
    };
    Field { u: sum(|field| &field.u), flux: sum(|field| &field.flux) }
}

impl ModalModel {
    /// p and y where the input of the coefficient is `value`, of any x ≥ 0 of [`ModalModel::model`].
    pub fn amplitudes(&self, value: f64, p: &[f64], x: &[f64]) -> Vec<f64> {
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let rows = self.of_inputs.iter().zip(&self.of_contact);
        let sums = rows.map(|(beta, alpha)| dot(beta, p) + dot(alpha, x));
        let y = self.gains(value).into_iter().zip(sums).map(|(gain, sum)| gain * sum);
        p.iter().copied().chain(y.collect::<Vec<_>>()).collect()
    }

    /// The guaranteed bound of (p, x), x ≥ 0 of [`ModalModel::model`], in the unit of ‖A^½∇u‖; `None` where there is none.
    pub fn bound(&self, value: f64, p: &[f64], x: &[f64]) -> Option<f64> {
        let (form, of_laws) = (self.model.certificate.as_ref().ok()?, self.of_laws.as_ref()?);
        let p = self.amplitudes(value, p, x);
        let [own, laws] = [&form.factor, of_laws].map(|factor| form.norm(factor, &p, x));
        let delta = (value - self.origin).max(0.0);
        self.model.bound_with((own * own + delta * laws * laws).sqrt(), &p, x)
    }

    /// δ/(1 + δν_k)
    fn gains(&self, value: f64) -> Vec<f64> {
        let delta = value - self.origin;
        self.compliance.iter().map(|nu| delta / (1.0 + delta * nu)).collect()
    }

    /// The model where the input of the coefficient is `value`; without an error bound, which is that of another coefficient.
    pub fn at(&self, value: f64) -> CondensedModel {
        let (n, m, unit) = (self.model.contact, self.inputs, self.model.energy_unit);
        let gains = self.gains(value);
        let mut model = self.model.clone();
        for ((gain, alpha), beta) in gains.iter().zip(&self.of_contact).zip(&self.of_inputs) {
            let alpha: Vec<f64> = alpha.iter().map(|alpha| alpha / unit).collect();
            for (row, a) in model.matrix.chunks_mut(n.max(1)).zip(&alpha) {
                row.iter_mut().zip(&alpha).for_each(|(entry, b)| *entry += gain * a * b);
            }
            for (column, b) in model.load.iter_mut().zip(beta) {
                let changes = column.iter_mut().zip(&alpha);
                changes.for_each(|(entry, a)| *entry -= gain * a * b / unit);
            }
        }
        model.load.truncate(m);
        for measure in &mut model.outputs {
            self.follow(measure, &gains);
        }
        model.defaults.truncate(m);
        model.defaults[self.input] = value;
        model.ranges.truncate(m);
        model.inputs = m;
        model.certificate = Err("the bound of another coefficient".to_owned());
        model.normalise();
        model
    }

    /// y put into an output.
    fn follow(&self, measure: &mut Measure, gains: &[f64]) {
        let (Measure::Linear { of_inputs, of_contact }
        | Measure::Flux { of_inputs, of_contact, .. }) = measure
        else {
            return;
        };
        if of_inputs.len() <= self.inputs {
            return;
        }
        let of_modes = of_inputs.split_off(self.inputs);
        of_contact.resize(self.model.contact, 0.0);
        for (k, (factor, gain)) in of_modes.iter().zip(gains).enumerate() {
            let add = |to: &mut [f64], row: &[f64]| {
                to.iter_mut().zip(row).for_each(|(sum, entry)| *sum += factor * gain * entry);
            };
            add(of_inputs, &self.of_inputs[k]);
            add(of_contact, &self.of_contact[k]);
        }
    }
}

impl CondensedModel {
    /// To a unit diagonal: x_i √Ŝ_ii are the unknowns then.
    fn normalise(&mut self) {
        let n = self.contact;
        let roots: Vec<f64> = (0..n).map(|i| self.matrix[i * n + i].sqrt()).collect();
        for (row, root) in self.matrix.chunks_mut(n.max(1)).zip(&roots) {
            row.iter_mut().zip(&roots).for_each(|(entry, other)| *entry /= root * other);
        }
        let divide = |numbers: &mut [f64]| {
            numbers.iter_mut().zip(&roots).for_each(|(number, root)| *number /= root);
        };
        let multiply = |numbers: &mut [f64]| {
            numbers.iter_mut().zip(&roots).for_each(|(number, root)| *number *= root);
        };
        self.load.iter_mut().for_each(|column| divide(column));
        divide(&mut self.opening);
        multiply(&mut self.multiplier);
        for measure in &mut self.outputs {
            match measure {
                Measure::Linear { of_contact, .. } => divide(of_contact),
                Measure::Flux { of_contact, of_reaction, .. } => {
                    divide(of_contact);
                    multiply(of_reaction);
                }
                Measure::Length { .. } | Measure::Bound => {}
            }
        }
    }
}

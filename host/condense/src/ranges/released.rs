//! The certificate of a reduced model, its s free at vertices where nothing ever touches.
//!
//! s = ψ + E x follows ψ into open water: where ψ is curved, that alone may be most of the bound. Where all contact edges at a
//! vertex are open whatever the inputs are, τ·n = q there, and s costs nothing on C wherever it is above ψ. So it is free there,
//! like inside, and follows no curve between two such vertices. That it is above ψ, and above what ψ has over its chord, is proved:
//! ```text
//!   s − ψ at a vertex = a·(p, x, d),   x = x(p, x_U),  d = 0, −e(p, x_U) or between them      all affine
//!   ─► at least Σ_j |p_j| peak_j for every p of the box and every x_U between its limits?  ─► released
//! ```
//! A vertex that fails is taken back, and the others are tried again, since s is another function then. The certificate holds
//! for the model without the edges that never change sides: there x_O is positive and r_O = 0 whatever a tick leaves unfinished.

use std::collections::{BTreeMap, BTreeSet};

use super::interval::Interval;
use super::reduction::{Affine, Reduction};
use super::sides::{Sides, VertexSide};
use crate::chain::is_left_out;
use crate::form::{Admissibles, FormData};
use crate::{Columns, CondensedModel, Form, Pieces, Recovery};
use faer::Mat;
use signorini_certify::curved::peak;
use signorini_certify::deviation::Deviations;
use signorini_problem::Problem;
use signorini_scene::error::Result;

/// How often vertices may be taken back.
const TRIALS: usize = 4;

/// A certificate with free vertices.
#[derive(Debug)]
pub struct Released {
    /// The model that has it.
    pub model: CondensedModel,
    /// Its way back.
    pub recovery: Recovery,
    /// How far s is above ψ at least at these vertices and along the edges between them, in the unit of u.
    pub clear: BTreeMap<u32, f64>,
}

/// `whole` and its way back with such a certificate, for a model that is reduced by `sides`; nothing where no vertex is released.
///
/// # Errors
/// As for [`crate::condense`].
pub fn released(
    problem: &Problem,
    whole: &CondensedModel,
    recovery: &Recovery,
    sides: &Sides,
) -> Result<Option<Released>> {
    let (Ok(form), false) = (&whole.certificate, whole.is_limited()) else { return Ok(None) };
    let Some(maps) = sides.reduction(whole) else { return Ok(None) };
    let vertices = form.vertices.iter().zip(recovery.contact_vertices());
    let is_free = |vertex| sides.at(vertex, &maps) == VertexSide::Free;
    let mut free: BTreeSet<u32> =
        vertices.filter(|(vertex, _)| is_free(vertex)).map(|(_, &at)| at).collect();
    if free.is_empty() {
        return Ok(None);
    }
    let pieces = Pieces::new(problem)?;
    for _ in 0..TRIALS {
        if free.is_empty() {
            break;
        }
        let Some((model, recovery)) = with_released(&pieces, whole, recovery, &free)? else {
            break;
        };
        let Ok(form) = &model.certificate else { break };
        let proof = Proof { model: &model, form, sides, maps: &maps };
        let all = recovery.released(&pieces, model.energy_unit)?;
        let clear: BTreeMap<u32, f64> =
            all.iter().map(|of| (of.vertex, proof.clearance(of))).collect();
        // A NaN proves nothing.
        let is_failed = |clear: f64| clear.is_nan() || clear <= 0.0;
        let failed =
            clear.iter().filter(|(_, clear)| is_failed(**clear)).map(|(vertex, _)| *vertex);
        let failed: Vec<u32> = failed.collect();
        if failed.is_empty() {
            return Ok(Some(Released { model, recovery, clear }));
        }
        free.retain(|vertex| !failed.contains(vertex));
    }
    Ok(None)
}

/// What s at a vertex is proved with.
struct Proof<'a> {
    model: &'a CondensedModel,
    form: &'a Form,
    sides: &'a Sides,
    maps: &'a Reduction,
}

impl Proof<'_> {
    /// By how much s is above ψ at least, all along the edges beside a vertex, whatever p and x_U are.
    fn clearance(&self, vertex: &ReleasedVertex) -> f64 {
        let Self { model, form, sides, maps } = *self;
        let (m, n) = (model.inputs, model.contact);
        let mut sum = Affine::exact(vec![0.0; m + maps.kept.len()]);
        sum.factors[..m].copy_from_slice(&vertex.above[..m]);
        for (edge, &factor) in vertex.above[m..m + n].iter().enumerate() {
            sum.add(factor, &Affine::exact(maps.x[edge].clone()));
        }
        let (inputs, mut lower) = (sides.box_of(maps), 0.0);
        for (of, &factor) in form.vertices.iter().zip(&vertex.above[m + n..]) {
            let e = maps.interpolated(of);
            match sides.at(of, maps) {
                VertexSide::Free => {}
                VertexSide::Touching => sum.add(-factor, &e),
                VertexSide::MayChange => {
                    let highest = -e.least(-1.0, &inputs);
                    let up = (-e.least(1.0, &inputs)).max(0.0);
                    let d = Interval { lo: -highest.max(0.0), hi: up };
                    lower += (factor * d.lo).min(factor * d.hi).next_down();
                }
            }
        }
        let peak: f64 =
            vertex.peak.iter().zip(&inputs).map(|(peak, [lo, hi])| peak * hi.max(-lo)).sum();
        let least = sum.least(1.0, &inputs) + lower * (1.0 + 1e-12);
        least - peak * (1.0 + 1e-12)
    }
}

impl Affine {
    /// Adds so many times another.
    fn add(&mut self, times: f64, other: &Self) {
        let own = self.factors.iter_mut().zip(&mut self.noise);
        for ((factor, noise), (of, off)) in own.zip(other.factors.iter().zip(&other.noise)) {
            *factor += times * of;
            *noise += times.abs() * off + f64::EPSILON * (factor.abs() + (times * of).abs());
        }
    }
}

/// s and ψ at a vertex that was released.
struct ReleasedVertex {
    /// The vertex of the mesh.
    vertex: u32,
    /// s − ψ as factors of (p, x, d), in the unit of u.
    above: Vec<f64>,
    /// Height of ψ above its chord at most on edges beside it that s does not follow, for each pattern.
    peak: Vec<f64>,
}

/// `whole` with a certificate whose s is free at these vertices, and the way back; nothing where there is none.
///
/// # Errors
/// As for [`crate::condense`].
fn with_released(
    pieces: &Pieces,
    whole: &CondensedModel,
    recovery: &Recovery,
    released: &BTreeSet<u32>,
) -> Result<Option<(CondensedModel, Recovery)>> {
    let (n, unit) = (whole.contact, whole.energy_unit);
    let openings: Vec<f64> = whole.opening.iter().map(|d| d / unit).collect();
    let matrix = Mat::from_fn(n, n, |i, j| whole.matrix[i * n + j]);
    let columns = Columns { pieces, fields: &recovery.fields, openings: &openings };
    let data = FormData { columns, matrix: &matrix, source: None, touching: &[], released };
    let Ok((mut form, admissibles)) = data.form()? else { return Ok(None) };
    form.rescale(unit, whole.inputs);
    let model = CondensedModel { certificate: Ok(form), ..whole.clone() };
    let (fields, admissibles) = (recovery.fields.clone(), Some(admissibles));
    Ok(Some((model, Recovery { fields, admissibles })))
}

impl Recovery {
    /// The mesh's vertex of each correction d.
    fn contact_vertices(&self) -> &[u32] {
        self.admissibles.as_ref().map_or(&[], |of| &of.contact)
    }

    /// The vertices that were released.
    fn released(&self, pieces: &Pieces, unit: f64) -> Result<Vec<ReleasedVertex>> {
        let Some(Admissibles { s, released, .. }) = &self.admissibles else {
            return Ok(Vec::new());
        };
        let peaks: Vec<_> =
            pieces.patterns.iter().map(|p| peaks(&p.problem, released)).collect::<Result<_>>()?;
        let inputs = pieces.patterns.len();
        let of_vertex = |(vertex, psi): &(u32, Vec<f64>)| {
            let mut above = s.row(*vertex as usize).to_vec();
            above.iter_mut().zip(psi).for_each(|(s, psi)| *s -= psi);
            above.iter_mut().skip(inputs).for_each(|factor| *factor *= unit);
            let peak = peaks
                .iter()
                .map(|of| {
                    of.iter()
                        .filter(|(ends, _)| ends.contains(vertex))
                        .map(|of| of.1)
                        .fold(0.0, f64::max)
                })
                .collect();
            ReleasedVertex { vertex: *vertex, above, peak }
        };
        Ok(released.iter().map(of_vertex).collect())
    }
}

/// The peaks of a pattern on edges between vertices that were released.
fn peaks(problem: &Problem, released: &[(u32, Vec<f64>)]) -> Result<Vec<([u32; 2], f64)>> {
    let released: BTreeSet<u32> = released.iter().map(|(vertex, _)| *vertex).collect();
    let deviations = Deviations::of(problem)?;
    let left_out = deviations.found.iter().map(|of| (problem.ends[of.edge], of));
    let left_out = left_out.filter(|(ends, _)| is_left_out(*ends, &released));
    left_out.map(|(ends, of)| Ok((ends, peak(of)?))).collect()
}

//! A row of problems on its contact unknowns alone.
//!
//! ```text
//!   S = K_CC − K_CI K_II⁻¹ K_IC,   b̃ = b_C − K_CI K_II⁻¹ b_I,   x = (u_C − ψ)/d,   d_i = 1/√S_ii
//!   minimise ½ xᵀŜx − b̂ᵀx over x ≥ 0,   Ŝ_ij = d_i S_ij d_j,   b̂ = d (b̃ − Sψ),   m̂ = d m
//! ```
//! S comes from the reference factorisation, so that loads may be any: [`signorini_condense`] takes patterns
//! with inputs, and its matrix and loads are these, in the same order along the boundary. ‖x − x*‖_Ŝ is the energy distance of the full fields.

use faer::Mat;

use signorini_condense::{CondensedModel, along_boundary};
use signorini_problem::Problem;
use signorini_reference::{Factor, LinearFactor};
use signorini_scene::Result;

use super::failed;
use super::quadratic::{Matrix, Quadratic, QuadraticLoads};

/// The condensed problems, and the model that the kernel's exact method is baked from.
pub(super) fn condensed(
    problem: &Problem,
    full: &Quadratic,
    factor: &Factor,
) -> Result<(Quadratic, CondensedModel)> {
    let (n, free, edges) = (full.contact(), full.free(), along_boundary(problem));
    let schur = Mat::from_fn(n, n, |i, j| factor.schur()[(edges[i], edges[j])]);
    let d: Vec<f64> = (0..n).map(|i| 1.0 / schur[(i, i)].sqrt()).collect();
    let mut matrix = Matrix::new();
    for i in 0..n {
        matrix.push((0..n).map(|j| (j, if i == j { 1.0 } else { d[i] * schur[(i, j)] * d[j] })));
    }
    let mut ticks = Vec::new();
    for (tick, condensed) in full.ticks.iter().zip(condensed_loads(full)?) {
        let product = |i: usize| (0..n).map(|j| schur[(i, j)] * tick.lower[edges[j]]).sum::<f64>();
        let load = (0..n).map(|i| d[i] * (condensed[edges[i]] - product(i))).collect();
        let spans = match tick.spans.is_empty() {
            true => Vec::new(),
            false => (0..n).map(|i| d[i] * tick.span(edges[i])).collect(),
        };
        ticks.push(QuadraticLoads { load, lower: vec![0.0; n], spans });
    }
    let openings = full.answers.iter().zip(&full.ticks).map(|(u, tick)| {
        let opening = |i: usize| (u[free + edges[i]] - tick.lower[edges[i]]) / d[i];
        let allowed = |i: usize| match tick.span(edges[i]) {
            f64::INFINITY => opening(i).max(0.0),
            f64::NEG_INFINITY => opening(i).min(0.0),
            _ => opening(i),
        };
        (0..n).map(allowed).collect()
    });
    let answers = openings.collect();
    let held = edges.iter().map(|&edge| full.floating.get(edge) == Some(&true));
    let floating: Vec<bool> = held.collect();
    let condensate = CondensedModel {
        contact: n,
        inputs: 1,
        matrix: matrix.values.clone(),
        multiplier: d.iter().map(|d| 1.0 / d).collect(),
        opening: d,
        load: vec![ticks[0].load.clone()],
        spans: Some(ticks[0].spans.clone()).filter(|spans| !spans.is_empty()).into_iter().collect(),
        limits: Vec::new(),
        defaults: vec![1.0],
        ranges: vec![[1.0, 1.0]],
        outputs: Vec::new(),
        certificate: Err("left out".to_owned()),
        energy_unit: 1.0,
        held_by_contact: held_by_contact(&floating, &schur),
        rooms: Vec::new(),
        balances: Vec::new(),
        edges,
    };
    Ok((Quadratic { matrix, ticks, answers, floating }, condensate))
}

/// The contact unknowns of each part that contact alone holds: S knows nothing from one part to another.
fn held_by_contact(floating: &[bool], schur: &Mat<f64>) -> Vec<Vec<usize>> {
    let mut held: Vec<Vec<usize>> = Vec::new();
    for i in (0..floating.len()).filter(|&i| floating[i]) {
        let together = |part: &&mut Vec<usize>| part.iter().any(|&j| schur[(i, j)] != 0.0);
        match held.iter_mut().find(together) {
            Some(part) => part.push(i),
            None => held.push(vec![i]),
        }
    }
    held
}

/// b̃ of every tick.
fn condensed_loads(full: &Quadratic) -> Result<Vec<Vec<f64>>> {
    let (n, free) = (full.contact(), full.free());
    let own = |row| full.matrix.row(row).filter(|&(j, _)| j < free).map(|(j, k)| (j as u32, k));
    let inner = LinearFactor::new((0..free).map(own)).map_err(failed)?;
    let loads: Vec<f64> =
        full.ticks.iter().flat_map(|tick| tick.load[..free].iter().copied()).collect();
    let inner = inner.solve(&loads).map_err(failed)?;
    let of_tick = |(at, tick): (usize, &QuadraticLoads)| {
        let z = &inner[at * free..(at + 1) * free];
        let held = |i: usize| {
            let row = full.matrix.row(free + i).filter(|&(j, _)| j < free);
            row.map(|(j, value)| value * z[j]).sum::<f64>()
        };
        (0..n).map(|i| tick.load[free + i] - held(i)).collect()
    };
    Ok(full.ticks.iter().enumerate().map(of_tick).collect())
}

//! A certificate whose s is free at contact vertices that nothing touches, like inside.
//!
//! s = ψ + E x follows ψ into open water: where ψ is curved, that alone may be most of the bound. Where all contact edges at a
//! vertex are open whatever the inputs are, τ·n = q there, and s costs nothing on C wherever it is above ψ. So it is free there,
//! and follows no curve between two such vertices. That it is above ψ, and above what ψ has over its chord, is for whoever
//! releases them to prove: [`ReleasedVertex`] says what s and ψ are there.

use std::collections::BTreeSet;

use faer::Mat;

use super::chain::is_left_out;
use super::form::{Admissibles, FormData};
use super::{Columns, CondensedModel, Pieces, Recovery};
use signorini_certify::curved::peak;
use signorini_certify::deviation::Deviations;
use signorini_problem::Problem;
use signorini_scene::error::Result;

/// s and ψ at a vertex that was released.
#[derive(Debug, Clone)]
pub struct ReleasedVertex {
    /// The vertex of the mesh.
    pub vertex: u32,
    /// s − ψ as factors of (p, x, d), in the unit of u.
    pub above: Vec<f64>,
    /// What ψ has above its chord at most on edges beside it that s does not follow, for each pattern.
    pub peak: Vec<f64>,
}

/// `whole` with a certificate whose s is free at these vertices, and the way back; nothing where there is none.
///
/// # Errors
/// As for [`super::condense`].
pub fn with_released(
    problem: &Problem,
    whole: &CondensedModel,
    recovery: &Recovery,
    released: &BTreeSet<u32>,
) -> Result<Option<(CondensedModel, Recovery)>> {
    let (pieces, n, unit) = (Pieces::new(problem)?, whole.contact, whole.energy_unit);
    let openings: Vec<f64> = whole.opening.iter().map(|d| d / unit).collect();
    let matrix = Mat::from_fn(n, n, |i, j| whole.matrix[i * n + j]);
    let columns = Columns { pieces: &pieces, fields: &recovery.fields, openings: &openings };
    let data = FormData { columns, matrix: &matrix, source: None, released };
    let Ok((mut form, admissibles)) = data.form()? else { return Ok(None) };
    form.rescale(unit, whole.inputs);
    let model = CondensedModel { certificate: Ok(form), ..whole.clone() };
    let (fields, admissibles) = (recovery.fields.clone(), Some(admissibles));
    Ok(Some((model, Recovery { fields, admissibles })))
}

impl Recovery {
    /// The mesh's vertex of each correction d.
    pub fn contact_vertices(&self) -> &[u32] {
        self.admissibles.as_ref().map_or(&[], |of| &of.contact)
    }

    /// The vertices that were released.
    ///
    /// # Errors
    /// Data that are not finite.
    pub fn released(&self, problem: &Problem, unit: f64) -> Result<Vec<ReleasedVertex>> {
        let Some(Admissibles { s, released, .. }) = &self.admissibles else {
            return Ok(Vec::new());
        };
        let pieces = Pieces::new(problem)?;
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
    let deviations = Deviations::at_time(problem, 0.0)?;
    let left_out = deviations.found.iter().map(|of| (problem.ends[of.edge], of));
    let left_out = left_out.filter(|(ends, _)| is_left_out(*ends, &released));
    left_out.map(|(ends, of)| Ok((ends, peak(of)?))).collect()
}

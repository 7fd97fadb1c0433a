//! The certificate of a step in time, and its terms in the bound of the evolution.

use signorini_bound::certificate::{self, Kept, StoredCell, Verdict, certify_step_with};
use signorini_bound::equilibrium::Iterate;
use signorini_kernel::Error as KernelError;

use super::Certifier;
use crate::data::Data;
use crate::evolution::StepTerms;
use crate::fields::Fields;
use crate::lifted::Lifts;
use crate::stored::stored_cells;
use signorini_problem::scalar::Scalar;
use signorini_problem::{Assembled, State, Step};

impl<R: Scalar> Certifier<R> {
    /// The lesser bound of a step in time: where cells keep what they lack of balance, and where they hand on most of it.
    pub(super) fn of_step(
        &mut self,
        assembled: &Assembled<R>,
        (data, step): (&Data<R>, &Step<R>),
        u: &[R],
        moved: impl Fn(&mut [R], &mut [R]),
    ) -> Result<Verdict<R>, KernelError> {
        let forms = data.forms();
        let given = data.given(assembled, forms.as_slice())?;
        let discretization = self.ways.discretization(assembled, &self.metric)?;
        let State { vertices, bubbles, .. } = &step.begin;
        let law = assembled.law();
        let cells = self.stored_cells(assembled, step);
        let storage = step.storage(assembled.edges())?;
        let of_kernel = certificate::Step { storage, cells: &cells, vertices, bubbles };
        let iterate = Iterate { u, law };
        let mut evolution = Vec::new();
        let mut of = |kept: Kept, fields: &mut Fields<R>| {
            let (verdict, residual) = certify_step_with(
                &discretization,
                (&given, &of_kernel),
                iterate,
                kept,
                fields.buffers(),
                &moved,
            )?;
            fields.open(&discretization, &given, law)?;
            if let Some(certificate) = verdict.certificate() {
                let left = (&residual, data.oscillation() + certificate.rounding);
                let begin = (&step.begin, step.length);
                let terms = fields.terms(&discretization, &given, law, begin, left)?;
                evolution.push(lifted(terms, data.lifts(), step.begin.lifted));
            }
            Ok::<_, KernelError>(verdict)
        };
        let kept = of(Kept::All, &mut self.fields)?;
        let total = |of: &Verdict<R>| of.certificate().map_or(R::INFINITY, |of| of.total);
        if self.hands_on {
            let mut fields = self.fields.clone();
            let handed = of(Kept::Part, &mut fields)?;
            if total(&handed) < total(&kept) {
                self.fields = fields;
                self.evolution = evolution;
                return Ok(handed);
            }
        }
        self.evolution = evolution;
        Ok(kept)
    }

    /// What each cell stores in `step`, triangles first, as its bound takes it.
    pub fn stored_cells(&self, assembled: &Assembled<R>, step: &Step<R>) -> Vec<StoredCell<R>> {
        let contents: Vec<f64> = step.contents().map(|content| content.wide()).collect();
        let keep = self.ways.kept(assembled.edges(), &self.metric, &contents);
        stored_cells(assembled.problem(), step, &keep)
    }
}

/// The terms of a step with what the extensions of curved data add at most, `before` being ‖A^½∇·‖ of those at its beginning.
fn lifted(terms: StepTerms<f64>, lifts: &Lifts, before: f64) -> StepTerms<f64> {
    let energy = lifts.energy.max(before);
    if energy == 0.0 && lifts.moved == 0.0 {
        return terms;
    }
    let moved = lifts.moved / terms.length.sqrt();
    let [mean, rest] = terms.residual;
    let (mean, all) = (mean + moved, mean.hypot(rest) + moved);
    StepTerms {
        distance: terms.distance.map(|square| (square.sqrt() + energy).powi(2)),
        residual: [mean, (all * all - mean * mean).max(0.0).sqrt()],
        ..terms
    }
}

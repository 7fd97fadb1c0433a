//! The certificate of a step in time, and its terms in the bound of the evolution.

use signorini_bound::certificate::{self, Handed, Judged, StoredCell, Verdict, certify_step_with};
use signorini_bound::equilibrium::Iterate;
use signorini_kernel::Error as KernelError;

use super::Certifier;
use crate::data::Data;
use crate::evolution::StepTerms;
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
        let State { vertices, bubbles, openings, .. } = &step.begin;
        let law = assembled.law();
        let cells = self.stored_cells(assembled, step);
        let storage = step.storage(assembled.edges())?;
        let length = R::narrow(step.length);
        let of_kernel =
            certificate::Step { length, storage, cells: &cells, vertices, bubbles, openings };
        let iterate = Iterate { u, law };
        let (mut tau, mut indicators) = (self.fields.tau.clone(), self.fields.indicators.clone());
        if !self.hands_on {
            // It would be the first way once more.
            tau.clear();
        }
        let second = Handed { tau: &mut tau, indicators: &mut indicators };
        let buffers = (self.fields.buffers(), second);
        let given_step = (&given, &of_kernel);
        let judged = certify_step_with(&discretization, given_step, iterate, buffers, &moved)?;
        let wide = judged.iter().filter_map(|way| way.terms).map(|terms| {
            // How far extensions have moved stands in the residual there.
            let of_extensions = given.oscillation - data.oscillation();
            let rounding = R::TWO * R::EPSILON * given.oscillation;
            let oscillation = terms.oscillation - of_extensions + rounding;
            let terms = widened(&StepTerms { oscillation, ..terms });
            let lifts = &data.evaluated.lifts;
            lifted(StepTerms { length: step.length, ..terms }, lifts, step.begin.lifted)
        });
        self.fields.evolution = wide.collect();
        let total = |of: &Judged<R>| of.verdict.certificate().map_or(R::INFINITY, |of| of.total);
        let [kept, handed] = judged;
        let is_handed = total(&handed) < total(&kept);
        if is_handed {
            (self.fields.tau, self.fields.indicators) = (tau, indicators);
        }
        self.fields.open(&discretization, &given, law)?;
        Ok(if is_handed { handed.verdict } else { kept.verdict })
    }

    /// What each cell stores in `step`, triangles first, as its bound takes it.
    pub fn stored_cells(&self, assembled: &Assembled<R>, step: &Step<R>) -> Vec<StoredCell<R>> {
        let contents: Vec<f64> = step.contents().map(|content| content.wide()).collect();
        // A way may end on a side whose flux is given where no other side could take what a cell hands on.
        let keep = match self.hands_on {
            true => self.ways.kept(assembled.edges(), &self.metric, &contents),
            false => vec![1.0; contents.len()],
        };
        stored_cells(assembled.problem(), step, &keep)
    }
}

fn widened<R: Scalar>(of: &StepTerms<R>) -> StepTerms<f64> {
    StepTerms {
        length: of.length.wide(),
        distance: of.distance.map(R::wide),
        contact: of.contact.map(R::wide),
        oscillation: of.oscillation.wide(),
        inside: of.inside.wide(),
        residual: of.residual.map(R::wide),
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

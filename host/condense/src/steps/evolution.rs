//! What the bound of the evolution takes beside the form of a step: forms of what a step changes, and where it starts.
//!
//! R and s − s_old are linear in w = (p − p⁻, x − x⁻, y⁻, d − d⁻), since a step that begins in a static shape and changes nothing ends there:
//! they are those of a step from p⁻ = 0, x⁻ = 0, d⁻ = 0 and y⁻ to the rest of w. See `signorini_contact::steps::evolution`.

use std::collections::BTreeSet;

use super::super::best::Table;
use super::super::block::Block;
use super::super::factor::{packed, triangular};
use super::super::form::Admissibles;
use super::super::residual::Residual;
use super::super::rounding::{FEW, terms};
use super::super::{Pieces, Recovery};
use super::SteppedModel;
use super::rows::storage;
use signorini_certify::CertifiedFields;
use signorini_certify::evolution::Evolution;
use signorini_certify::stated::distance;
use signorini_problem::{Assembled, Problem, Sum};
use signorini_scene::error::Result;
use signorini_scene::scene::Datum;
use signorini_solve::{decay::decay_rate, unfit};

/// Forms over w in the unit of energy, and the start.
#[derive(Debug, Clone)]
pub struct EvolutionForms {
    /// (∫R²/k)^½ by columns, column j with its j + 1 entries.
    pub residual: Vec<f64>,
    /// (‖A^½∇(s − s_old)‖² + ∫_R h (s − s_old)²)^½ in the same way.
    pub motion: Vec<f64>,
    /// Rounding in f64 that each column of both may hide.
    pub lost: [Vec<f64>; 2],
    /// Where s − ψ at both ends of each unknown's edge comes from, as `Form::ends` has it.
    pub ends: Vec<[usize; 2]>,
    /// dt
    pub length: f64,
    /// λ, and what is carried at the start, in the unit of energy.
    pub start: Evolution,
}

impl EvolutionForms {
    /// Of the model `of`, made from these `pieces` of a step; `steady` is the problem at the start, whose u is `stated` or else the steady
    /// one. Nothing without a bound of the step or a rate at which the past fades.
    ///
    /// # Errors
    /// Data that are not finite.
    pub(super) fn new(
        of: &SteppedModel,
        (pieces, recovery): (&Pieces, &Recovery),
        (steady, length, stated): (&Problem, f64, Option<&Datum>),
        ends: Vec<[usize; 2]>,
    ) -> Result<Option<Self>> {
        let (Ok(_), Some(fields)) = (&of.model.certificate, &recovery.admissibles) else {
            return Ok(None);
        };
        let Some(start) = start(of, fields, steady, stated)? else { return Ok(None) };
        let (problem, functions) = (pieces.problem, &fields.functions);
        let columns = changes(of);
        let s = picked(&fields.s, &columns);
        let fluxes = picked(&fields.fluxes, &columns);
        let mut residual = storage(problem, &pieces.patterns[1..of.inputs], functions);
        residual.iter_mut().for_each(|block| scale_inputs(block, 1.0 / of.model.energy_unit));
        let motion = Residual::new(pieces, functions, &BTreeSet::new())?.blocks()?;
        let motion: Vec<Block> = motion.into_iter().map(of_s_alone).collect();
        let (moved, none) =
            (difference(&s, functions.count()), Table::new(problem.ends.len(), s.columns));
        let assembled = Assembled::<f64>::new(problem).map_err(unfit::<f64>(&problem.scene))?;
        let share = 1.0 + assembled.hidden();
        let factor = |blocks: &[Block], s: &Table, fluxes: &Table| {
            let factor = packed(&triangular(blocks, s, fluxes));
            factor.into_iter().map(|entry| share * entry).collect::<Vec<_>>()
        };
        let lost = |blocks: &[Block], s: &Table, fluxes: &Table| {
            terms(blocks, s, fluxes).into_iter().map(|size| FEW * size).collect::<Vec<_>>()
        };
        Ok(Some(Self {
            residual: factor(&residual, &s, &fluxes),
            motion: factor(&motion, &moved, &none),
            lost: [lost(&residual, &s, &fluxes), lost(&motion, &moved, &none)],
            ends,
            length,
            start: start.in_unit(of.model.energy_unit),
        }))
    }
}

/// The columns of a step's terms, openings and corrections that stand for w, each with its factor for the unit of energy.
fn changes(of: &SteppedModel) -> Vec<(usize, f64)> {
    let (m, n, terms) = (of.inputs, of.model.contact, of.model.inputs);
    let (states, corrections) = (of.fading.len(), of.corrections);
    let in_unit = |column: usize| (column, 1.0 / of.model.energy_unit);
    let first = 2 * m - 1 + n;
    // Columns of x and d are those of a unit of 1.
    let openings = (terms..terms + n).map(|column| (column, 1.0));
    let corrected = (terms + n..terms + n + corrections).map(|column| (column, 1.0));
    let (of_inputs, of_states) = ((1..m).map(in_unit), (first..first + states).map(in_unit));
    of_inputs.chain(openings).chain(of_states).chain(corrected).collect()
}

/// These columns of `of`; those that it does not have are 0.
fn picked(of: &Table, columns: &[(usize, f64)]) -> Table {
    let places = of.values.len() / of.columns;
    let mut picked = Table::new(places, columns.len());
    for place in 0..places {
        let from = of.row(place);
        let to = picked.row_mut(place).iter_mut().zip(columns);
        to.for_each(|(to, &(column, factor))| *to = from.get(column).map_or(0.0, |x| factor * x));
    }
    picked
}

/// s − s_old, whose rows follow those of s.
fn difference(s: &Table, count: usize) -> Table {
    let mut moved = Table::new(count, s.columns);
    for place in 0..count {
        let (now, old) = (s.row(place), s.row(count + place));
        let to = moved.row_mut(place).iter_mut().zip(now.iter().zip(old));
        to.for_each(|(to, (now, old))| *to = now - old);
    }
    moved
}

/// Multiplies what inputs add to rows.
fn scale_inputs(of: &mut Block, factor: f64) {
    let own = of.functions.len() + of.edges.len();
    of.rows.iter_mut().flat_map(|row| &mut row[own..]).for_each(|entry| *entry *= factor);
}

/// Rows without what fluxes and inputs add.
fn of_s_alone(of: Block) -> Block {
    let own = of.functions.len() + of.edges.len();
    let rows = of.rows.into_iter().map(|mut row| {
        row.truncate(own);
        row
    });
    Block { rows: rows.collect(), ..of }
}

/// What is carried at the start, in the scene's units.
fn start(
    of: &SteppedModel,
    fields: &Admissibles,
    steady: &Problem,
    stated: Option<&Datum>,
) -> Result<Option<Evolution>> {
    let (model, rate) = (&of.model, decay_rate(steady)?);
    let Some(initial) = stated else {
        let x = &model.defaults[2 * of.inputs - 1..][..model.contact];
        let total = model.bound(&of.at_start(), x).map(|total| total + of.rounded(x));
        return Ok(total.and_then(|total| Evolution::begin(rate, Some(total), 0.0)));
    };
    let s = of.begun(fields, steady);
    let error = distance(steady, &s.admissible(), &Sum::alone(&steady.scene, initial, 0.0))?;
    Ok(Evolution::begin(rate, None, error))
}

impl SteppedModel {
    /// s at the start, on the mesh of `problem`; nothing where there is no bound.
    pub fn s_at_start(&self, recovery: &Recovery, problem: &Problem) -> Option<CertifiedFields> {
        Some(self.begun(recovery.admissibles.as_ref()?, problem))
    }

    fn begun(&self, fields: &Admissibles, problem: &Problem) -> CertifiedFields {
        let count = fields.functions.count();
        let at = |place: usize| -> f64 {
            let row = fields.s.row(count + place).iter();
            row.zip(&self.model.defaults).map(|(s, term)| s * term).sum()
        };
        fields.functions.fields(problem, at, vec![0.0; problem.ends.len()])
    }

    /// How much of the bound at the start rounding may hide, for these openings, in the scene's unit of energy.
    fn rounded(&self, x: &[f64]) -> f64 {
        let Ok(form) = &self.model.certificate else { return 0.0 };
        let sizes = form.lost.iter().zip(self.model.defaults.iter().chain(x));
        self.model.energy_unit * sizes.map(|(lost, term)| lost * term.abs()).sum::<f64>()
    }
}

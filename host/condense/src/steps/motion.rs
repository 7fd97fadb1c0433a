//! How u moves from step to step, whatever states a model keeps of it.

use super::gramian::{Gramian, Subspace};
use super::modes::Deviations;
use super::shapes::{Begun, Shapes};
use super::{Memory, StepShapes, SteppedModel};
use crate::{CondensedModel, Recovery, Settled};

/// Shapes that a step begins from, and what u deviates from them, in coordinates of modes.
pub(super) struct Motion<'s> {
    pub shapes: &'s Shapes,
    pub start: &'s Begun,
    pub deviations: Deviations,
    /// Shapes of p⁻ without the constant, and of x⁻.
    pub columns: Vec<Vec<f64>>,
    /// How much each of them may change.
    pub sizes: Vec<f64>,
    /// Coordinates of these shapes.
    pub coordinates: Vec<Vec<f64>>,
    /// Coordinates of what the start deviates from its static shape.
    pub left: Vec<f64>,
}

impl<'s> Motion<'s> {
    pub fn new(
        shapes: &'s Shapes,
        start: &'s Begun,
        openings: &[f64],
        deviations: Deviations,
    ) -> Self {
        let (columns, sizes) = (shapes.columns(openings), shapes.sizes(openings));
        let coordinates = columns.iter().map(|u| deviations.coordinates(u)).collect();
        let left = start.deviation(shapes, &deviations);
        Self { shapes, start, deviations, columns, sizes, coordinates, left }
    }

    /// m − 1, the inputs without the constant.
    fn inputs(&self) -> usize {
        self.shapes.inputs.len() - 1
    }

    pub fn gramian(&self) -> Gramian<'_> {
        Gramian::new(&self.deviations.fading, (&self.coordinates, &self.sizes), &self.left)
    }

    /// What the bound takes of a step that keeps these states.
    pub fn remembered(
        &self,
        kept: &Subspace,
        states: Vec<Vec<f64>>,
        corrections: usize,
    ) -> StepShapes {
        let openings = self.columns[self.inputs()..].to_vec();
        StepShapes {
            means: [self.shapes.inputs.clone(), openings, states],
            fading: kept.fading.clone(),
            changes: kept.changes(&self.deviations.fading, &self.coordinates),
            corrections,
        }
    }

    /// The model of a step with what it hands on, in its unit of energy.
    pub fn model(
        &self,
        mut model: CondensedModel,
        recovery: &mut Recovery,
        (kept, corrections): (Subspace, usize),
    ) -> SteppedModel {
        let (unit, given) = (model.energy_unit, self.inputs());
        let own = 2 * given + 1..model.inputs;
        model.scale_inputs(own.clone(), unit);
        recovery.scale_inputs(own.clone(), unit);
        model.defaults[own].iter_mut().for_each(|x| *x /= unit);
        let changes = kept.changes(&self.deviations.fading, &self.coordinates);
        let of_inputs = changes.iter().map(|row| over(&row[..given], unit)).collect();
        SteppedModel {
            model,
            inputs: given + 1,
            fading: kept.fading,
            of_inputs,
            modes: self.deviations.count(),
            corrections,
            evolution: None,
            gaps: Vec::new(),
            full: self.full_memory(unit),
            settled: Settled::default(),
        }
    }

    /// The memory of all modes.
    fn full_memory(&self, unit: f64) -> Memory {
        let all = Subspace::all(&self.deviations);
        let changes = all.changes(&self.deviations.fading, &self.coordinates);
        let rows = changes.iter().map(|row| row.split_at(self.inputs()));
        let (of_p, of_x): (Vec<_>, Vec<_>) = rows.map(|(p, x)| (over(p, unit), x.to_vec())).unzip();
        Memory::new(&all.fading, [&of_x, &of_p], &over(&self.left, unit))
    }
}

fn over(row: &[f64], unit: f64) -> Vec<f64> {
    row.iter().map(|entry| entry / unit).collect()
}

//! A scene's loads as a sum: base + Σ input · pattern, and the scene that only some of these terms leave.

use super::{Datum, Located, Output, Quantity, Scene};
use crate::expression::Expression;

/// A term of the sum: 0 is the base, 1 + j what one unit of input j adds.
pub type Term = usize;

/// `scene` with one unit of each of these terms and nothing else. Coefficients are no loads: inputs keep what they add to them,
/// and add no term.
pub fn left_with(scene: &Scene, terms: &[Term]) -> Scene {
    let mut scene = scene.clone();
    let inputs = scene.inputs.iter_mut().enumerate();
    for (at, input) in inputs.filter(|(_, input)| input.field.value.is_load()) {
        input.default = if terms.contains(&(at + 1)) { 1.0 } else { 0.0 };
    }
    if !terms.contains(&0) {
        let infinite = |load: &Expression| load.is_constant().is_some_and(f64::is_infinite);
        each_load(&mut scene, |load| {
            // An infinite end of a flux is no term.
            if !infinite(&load.value) {
                load.value = Expression::constant(0.0);
            }
        });
    }
    scene
}

impl Scene {
    /// The scene as it stands at t = 0, for whoever knows no time.
    #[must_use]
    pub fn at_rest(mut self) -> Self {
        let rest = |load: &mut Datum| load.value = load.value.at_time(0.0);
        each_load(&mut self, rest);
        if let Some(exact) = &mut self.exact {
            rest(&mut exact.u);
            exact.gradient.iter_mut().for_each(rest);
        }
        self
    }
}

/// Visits the load f, then the loads of every boundary in the order of the file.
pub fn each_load(scene: &mut Scene, mut each: impl FnMut(&mut Datum)) {
    each(&mut scene.source);
    for boundary in &mut scene.boundaries {
        let data = boundary.condition.data_mut().into_iter();
        data.filter(|(field, _)| field.is_load()).for_each(|(_, data)| each(data));
    }
}

/// The sentence for whoever takes a scene that changes with t at rest.
pub fn at_rest_warning(scene: &Scene) -> Option<String> {
    let stores = scene.materials.iter().find(|material| material.stores()).map(|material| {
        format!(
            "{} = \"{}\" has no part in the steady state, which this is (`signorini tick` steps in time)",
            material.capacity.key, material.capacity.value
        )
    });
    let moves = first_in_time(scene).map(|Located { key, value, .. }| {
        format!(
            "{key} = \"{value}\" depends on t: all data are those of t = 0 (`signorini tick` plays the scene over time)"
        )
    });
    let window = scene.outputs.iter().find(|output| output.quantity == Quantity::Window);
    let window = window.map(|Output { name, .. }| {
        format!("output.{} has no value: the steady state has no bound over time", name.value)
    });
    let all: Vec<String> = moves.into_iter().chain(stores).chain(window).collect();
    (!all.is_empty()).then(|| all.join("; "))
}

/// The first load that depends on t.
pub fn first_in_time(scene: &Scene) -> Option<Datum> {
    let mut first = None;
    each_load(&mut scene.clone(), |load| {
        if load.value.uses_time() && first.is_none() {
            first = Some(load.clone());
        }
    });
    first
}

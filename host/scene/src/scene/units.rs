//! A scene in other units of u and A: powers of two, which change no digit.
//!
//! With u = U û and A = α Â the same problem reads
//! ```text
//!   f̂ = f / (α U),  ĝ = g / (α U),  q̂ = q / (α U),  ĥ = h / α,  û_D = u_D / U,  ψ̂ = ψ / U,
//! ```
//! and every number of its solution is that of the first one to the last bit, as long as none was
//! too large or too small for the scalar: then only the second one can be computed.

use super::{Boundary, Condition, Field, Located, Quantity, Scene};
use crate::expression::Expression;

/// What 1 stands for, each a power of two.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Units {
    /// U
    pub u: f64,
    /// α
    pub conductivity: f64,
}

impl Default for Units {
    fn default() -> Self {
        Self { u: 1.0, conductivity: 1.0 }
    }
}

impl Units {
    /// The unit of fluxes and loads.
    pub fn flux(&self) -> f64 {
        self.u * self.conductivity
    }

    /// The unit of energy norms, U √α.
    pub fn energy(&self) -> f64 {
        self.u * self.conductivity.sqrt()
    }

    /// The other way round.
    pub fn inverse(&self) -> Self {
        Self { u: 1.0 / self.u, conductivity: 1.0 / self.conductivity }
    }

    /// `scene` with its data, and its exact solution if it has one, in these units.
    pub fn scene(&self, scene: &Scene) -> Scene {
        let mut scene = scene.clone();
        let times = |data: &mut Located<Expression>, unit: f64| {
            data.value = data.value.times(1.0 / unit);
        };
        for material in &mut scene.materials {
            material.conductivity.iter_mut().for_each(|entry| times(entry, self.conductivity));
        }
        times(&mut scene.source, self.flux());
        for Boundary { condition, .. } in &mut scene.boundaries {
            match condition {
                Condition::Dirichlet { value } => times(value, self.u),
                Condition::Neumann { flux } => times(flux, self.flux()),
                Condition::Robin { coefficient, ambient } => {
                    times(coefficient, self.conductivity);
                    times(ambient, self.u);
                }
                Condition::Contact { gap, flux } => {
                    times(gap, self.u);
                    times(flux, self.flux());
                }
            }
        }
        if let Some(exact) = &mut scene.exact {
            times(&mut exact.u, self.u);
            exact.gradient.iter_mut().for_each(|entry| times(entry, self.u));
        }
        for input in &mut scene.inputs {
            times(&mut input.pattern, self.of(input.field.value));
        }
        scene
    }

    /// The unit of an output.
    pub fn of_output(&self, quantity: Quantity) -> f64 {
        match quantity {
            Quantity::Flux | Quantity::Force => self.flux(),
            Quantity::Length => 1.0,
            Quantity::Probe { .. } => self.u,
            Quantity::Bound => self.energy(),
        }
    }

    fn of(&self, field: Field) -> f64 {
        match field {
            Field::Value | Field::Gap | Field::Ambient => self.u,
            Field::Flux | Field::Source => self.flux(),
        }
    }
}

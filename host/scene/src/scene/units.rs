//! A scene in other units of u and A: powers of two, which change no digit; and with another zero of u.
//!
//! With u = c + U û and A = α Â the same problem reads
//! ```text
//!   f̂ = f / (α U),  ĝ = g / (α U),  q̂ = q / (α U),  ĥ = h / α,  û_D = (u_D − c) / U,  ψ̂ and û_ext likewise,
//! ```
//! and for c = 0 every number of its solution is that of the first one to the last bit, as long as none was
//! too large or too small for the scalar: then only the second one can be computed. c is taken from data that are
//! large against their differences, which loses no digit of them.

use super::{Datum, Field, Material, Quantity, Scene};

/// The unit of a datum of the scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// The unit of u.
    U,
    /// The unit of A.
    Conductivity,
    /// The unit of A∇u, and of f.
    Flux,
}

impl Field {
    /// The unit of the field.
    pub fn unit(self) -> Unit {
        match self {
            Self::Value | Self::Gap | Self::Ambient => Unit::U,
            Self::Flux | Self::Limit | Self::Source => Unit::Flux,
            Self::Coefficient => Unit::Conductivity,
        }
    }

    /// Whether u is linear in it, so that what inputs add to it is a term of its own.
    pub fn is_load(self) -> bool {
        match self {
            Self::Value | Self::Gap | Self::Ambient | Self::Flux | Self::Limit | Self::Source => {
                true
            }
            Self::Coefficient => false,
        }
    }
}

/// The values that 1 stands for, each a power of two, and the u that 0 stands for.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Units {
    /// U
    pub u: f64,
    /// α
    pub conductivity: f64,
    /// c
    pub zero: f64,
}

impl Default for Units {
    fn default() -> Self {
        Self { u: 1.0, conductivity: 1.0, zero: 0.0 }
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
        let Self { u, conductivity, zero } = self;
        Self { u: 1.0 / u, conductivity: 1.0 / conductivity, zero: 0.0 - zero / u }
    }

    /// These units, stated in `others`, in those that `others` are stated in.
    #[must_use]
    pub fn within(&self, others: &Self) -> Self {
        Self {
            u: self.u * others.u,
            conductivity: self.conductivity * others.conductivity,
            zero: others.value(self.zero),
        }
    }

    /// The value of u that `u` stands for in these units.
    pub fn value(&self, u: f64) -> f64 {
        u * self.u + self.zero
    }

    /// Size of c in these units: values of u are rounded like numbers so large.
    pub fn level(&self) -> f64 {
        (self.zero / self.u).abs()
    }

    /// `scene` with its data, and its exact solution if it has one, in these units.
    pub fn scene(&self, scene: &Scene) -> Scene {
        let mut scene = scene.clone();
        let times = |data: &mut Datum, unit: Unit| {
            data.value = data.value.times(1.0 / self.of(unit));
        };
        // Inputs are added to these.
        let moved = |data: &mut Datum, unit: Unit| {
            if unit == Unit::U && self.zero != 0.0 {
                data.value = data.value.minus(self.zero);
            }
            times(data, unit);
        };
        for (unit, data) in scene.materials.iter_mut().flat_map(Material::data_mut) {
            times(data, unit);
        }
        times(&mut scene.source, Unit::Flux);
        for boundary in &mut scene.boundaries {
            for (field, data) in boundary.condition.data_mut() {
                moved(data, field.unit());
            }
        }
        if let Some(initial) = scene.time.as_mut().and_then(|time| time.initial.as_mut()) {
            moved(initial, Unit::U);
        }
        if let Some(exact) = &mut scene.exact {
            moved(&mut exact.u, Unit::U);
            exact.gradient.iter_mut().for_each(|entry| times(entry, Unit::U));
        }
        for input in &mut scene.inputs {
            times(&mut input.pattern, input.field.value.unit());
        }
        scene
    }

    /// The value of an output that is `value` in these units, and `of_one` for u = 1 there.
    pub fn output(&self, quantity: Quantity, [value, of_one]: [f64; 2]) -> f64 {
        let unit = self.of_output(quantity);
        value * unit + self.zero * (of_one * (unit / self.u))
    }

    /// The unit of an output.
    pub fn of_output(&self, quantity: Quantity) -> f64 {
        match quantity {
            Quantity::Flux | Quantity::Force => self.flux(),
            Quantity::Length | Quantity::Saturated => 1.0,
            Quantity::Probe { .. } | Quantity::Mean | Quantity::MeanInside => self.u,
            Quantity::Content => self.conductivity * self.u,
            Quantity::Bound | Quantity::Window => self.energy(),
        }
    }

    fn of(&self, unit: Unit) -> f64 {
        match unit {
            Unit::U => self.u,
            Unit::Conductivity => self.conductivity,
            Unit::Flux => self.flux(),
        }
    }
}

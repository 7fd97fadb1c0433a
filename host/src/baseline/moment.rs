//! What changes from tick to tick.
//!
//! * A scene with inputs: these are drawn within a tenth of their defaults, as for its firmware.
//! * One without: all its loads (f, u_D, g, ambient) take one factor and what contact asks for (ψ, q)
//!   another, both drawn from [0.9, 1.1]. One factor alone would scale the answer and leave the contact set.
//! * A scene over time: its own t.

use crate::bake::trial;
use crate::error::Result;
use crate::problem::{Loads, Problem};
use crate::scene::Scene;

/// The data of one tick: those of a scene at a time, scaled.
#[derive(Debug, Clone)]
pub(super) struct Moment {
    pub scene: Scene,
    pub time: f64,
    /// Factor of f, u_D, g and the ambient.
    pub loads: f64,
    /// Factor of ψ and q.
    pub contact: f64,
}

impl Moment {
    /// The scene as it stands.
    pub fn at(scene: &Scene, time: f64) -> Self {
        Self { scene: scene.clone(), time, loads: 1.0, contact: 1.0 }
    }

    /// The scene as it stands, then `ticks` others.
    pub fn drawn(scene: &Scene, time: f64, ticks: usize) -> Vec<Self> {
        let here = Self::at(scene, time);
        if scene.inputs.is_empty() {
            let factors = trial::inputs::<f64>(&[1.0; 2], ticks);
            return factors.map(|f| Self { loads: f[0], contact: f[1], ..here.clone() }).collect();
        }
        let defaults: Vec<f64> = scene.inputs.iter().map(|input| input.default).collect();
        let drawn = trial::inputs::<f64>(&defaults, ticks).map(|values| {
            let mut moment = here.clone();
            let inputs = moment.scene.inputs.iter_mut();
            inputs.zip(values).for_each(|(input, value)| input.default = value);
            moment
        });
        drawn.collect()
    }

    /// Its integrals on the mesh of `problem`.
    pub fn integrate(&self, problem: &Problem) -> Result<Loads> {
        let mut loads = Loads::at_time(&self.scene, problem, self.time)?;
        let scale = |numbers: &mut Vec<f64>, factor: f64| {
            numbers.iter_mut().for_each(|number| *number *= factor);
        };
        scale(&mut loads.triangles, self.loads);
        scale(&mut loads.quads, self.loads);
        scale(&mut loads.dirichlet, self.loads);
        loads.neumann.iter_mut().for_each(|record| record.flux *= self.loads);
        loads.robin.iter_mut().for_each(|record| record.ambient *= self.loads);
        scale(&mut loads.gap, self.contact);
        scale(&mut loads.contact_flux, self.contact);
        Ok(loads)
    }
}

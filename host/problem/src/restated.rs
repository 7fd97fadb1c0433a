//! One mesh with other data: at another time, for other inputs, of another scene, in other units.
//!
//! Nothing here numbers an edge or looks at the shape of a cell again: [`Problem::new`] has done so.

use std::sync::Arc;

use super::{Loads, Problem, corners, integrals, limits, transfer};
use signorini_scene::error::Result;
use signorini_scene::faults::Faults;
use signorini_scene::scene::Scene;
use signorini_scene::scene::term::{Term, left_with};
use signorini_scene::scene::units::Units;
use signorini_scene::setting::Setting;

impl Problem {
    /// Integrates the data at time `time`; mesh, edges and A stay.
    ///
    /// # Errors
    /// Data that are not finite or not admissible at that time.
    pub fn set_time(&mut self, time: f64) -> Result<()> {
        let step = self.loads.step.take();
        let before = std::mem::replace(&mut self.time, time);
        let loads = Loads::of(self).and_then(|loads| loads.in_step(self, step));
        self.loads = loads.inspect_err(|_| self.time = before)?;
        let faults = Faults::default();
        for check in [limits::check, transfer::check_now, corners::check] {
            faults.keep(check(self));
        }
        faults.into_result()
    }

    /// Integrates the data at time `time` with these inputs, by their positions in the scene, at these values; others
    /// keep theirs.
    ///
    /// # Errors
    /// As for [`Problem::set_time`].
    pub fn set(&mut self, inputs: &[(usize, f64)], time: f64) -> Result<()> {
        let scene = Arc::make_mut(&mut self.scene);
        inputs.iter().for_each(|&(input, value)| scene.inputs[input].default = value);
        self.set_time(time)
    }

    /// This problem with the inputs at these values, in the order of the scene; those without one keep theirs.
    ///
    /// # Errors
    /// As for [`Problem::set_time`].
    pub fn with_inputs(&self, values: &[f64]) -> Result<Self> {
        let inputs = 0..self.scene.inputs.len();
        let values: Vec<_> = inputs.zip(values.iter().copied()).collect();
        let mut problem = self.clone();
        problem.set(&values, self.time)?;
        Ok(problem)
    }

    /// This problem with the loads of `scene`, which has the same boundaries and A.
    ///
    /// # Errors
    /// As for [`Problem::set_time`].
    pub fn with_loads_of(&self, scene: Scene) -> Result<Self> {
        let mut problem = self.restated(scene);
        problem.set_time(self.time)?;
        Ok(problem)
    }

    /// One unit of each of these terms of the loads, and nothing else. What the whole sum has to meet, a term alone may
    /// break: nothing is checked where boundaries meet, nor whether a coefficient is negative.
    ///
    /// # Errors
    /// Data that are not finite.
    pub fn left_with(&self, terms: &[Term]) -> Result<Self> {
        let mut problem = self.restated(left_with(&self.scene, terms));
        problem.loads = Loads::of(&problem)?;
        Ok(problem)
    }

    /// These loads stated by `scene`: it differs in nothing that they are made of.
    #[must_use]
    pub fn restated(&self, scene: Scene) -> Self {
        Self { scene: Arc::new(scene), ..self.clone() }
    }

    /// This problem in another setting; the mesh is that of the old one.
    #[must_use]
    pub fn with_setting(&self, setting: Option<Setting>) -> Self {
        self.restated(Scene { setting, ..Scene::clone(&self.scene) })
    }

    /// This problem in `units`.
    ///
    /// # Errors
    /// Data that are not finite in these units.
    pub fn in_units(&self, units: &Units) -> Result<Self> {
        let scene = units.scene(&self.scene);
        let pieces = self.coefficients.pieces.iter();
        let pieces = pieces.map(|(&at, of)| (at, of.divided(units.conductivity))).collect();
        let coefficients =
            integrals::coefficients(&scene, &self.mesh, &self.binding, Some(pieces))?;
        let mut problem = self.restated(scene);
        problem.units = units.within(&self.units);
        problem.coefficients = Arc::new(coefficients);
        problem.capacities = self.capacities.iter().map(|c| c / units.conductivity).collect();
        let step = problem.loads.step.take();
        problem.loads.step = step.map(|step| step.in_units(units));
        problem.set_time(self.time)?;
        Ok(problem)
    }
}

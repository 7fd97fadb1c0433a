//! A scene baked: in units in which its numbers are near 1, and with a factor where one is asked for.

use signorini_kernel::rows::{QUADS, TRIANGLES};

use super::arrays::Baked;
use super::controller::Controller;
use super::factored::Factored;
use super::scale::Scale;
use crate::face::Face;
use signorini_scene::error::{InputError, Result};
use signorini_scene::scene::Scene;
use signorini_scene::scene::units::Units;
use signorini_solve::problem::Problem;
use signorini_solve::scalar::Scalar;
use signorini_solve::solve::choose_for_inputs;

impl<R: Scalar> Baked<R> {
    /// Bakes `scene`, whose inputs stand at their defaults, as its setting says.
    ///
    /// # Errors
    /// A setting that no module can have. A part of the domain that contact alone or nothing holds; a load that depends on t; numbers or
    /// answers that the scalar type cannot hold.
    pub fn new(problem: &Problem) -> Result<Self> {
        let face = Face::new(problem);
        let units = choose_for_inputs(problem)?;
        if units == Units::default() {
            return Self::in_its_units(problem, face);
        }
        let scale = Scale::new(&problem.scene, units)?;
        let baked = Self::in_its_units(&problem.in_units(&units)?, face)?;
        Ok(Self { scale: Some(scale), ..baked })
    }

    /// What 1 stands for in [`Controller::u`] and the other arrays of a controller.
    pub fn units(&self) -> Units {
        self.scale.as_ref().map_or(Units::default(), |scale| scale.units)
    }

    /// The same with ticks that a factor solves; `scene` and `problem` are what it was baked from.
    ///
    /// # Errors
    /// A matrix that this scalar cannot tell from a singular one, a factor beyond all memory.
    pub fn with_factor(self, problem: &Problem) -> Result<Self> {
        let refused = |message: String| {
            let hint = "take solver = \"sweeps\", or the scalar f64";
            InputError::new(message).file(&problem.scene.path).hint(hint)
        };
        let in_other_units = match self.scale {
            Some(scale) => Some(problem.in_units(&scale.units)?),
            None => None,
        };
        let own = in_other_units.as_ref().unwrap_or(problem);
        let Some(factored) = Factored::new(own)? else {
            return Err(refused("setting.solver: this mesh has no factor in f64".to_owned()).into());
        };
        let baked = Self { factored: Some(factored), ..self };
        if baked.solves(&problem.scene) {
            return Ok(baked);
        }
        let why = "corrections by the factor do not converge";
        let message =
            format!("setting.solver: {why} in {}: the matrix is too close to singular", R::NAME);
        Err(refused(message).into())
    }

    /// Whether its first tick needs no sweeps.
    fn solves(&self, scene: &Scene) -> bool {
        let inputs = scene.inputs.iter().map(|input| R::narrow(input.default));
        let inputs: Vec<R> = inputs.collect();
        match self.has_quads() {
            true => Controller::<R, QUADS>::new(self).solves(&inputs),
            false => Controller::<R, TRIANGLES>::new(self).solves(&inputs),
        }
    }
}

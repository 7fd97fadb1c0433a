//! A scene baked: where its numbers are far from 1 in other units, and with a factor where one is asked for.

use super::arrays::Baked;
use super::controller::Controller;
use super::factored::Factored;
use super::storing::short;
use crate::Bakes;
use crate::module_api::ModuleApi;
use crate::narrow::exclusions;
use crate::range::refuse_answers;
use signorini_certify::evolution::Evolution;
use signorini_device::full;
use signorini_kernel::relaxation::Relaxation;
use signorini_problem::functional::wanted;
use signorini_problem::{Approach, Problem};
use signorini_scene::error::{InputError, Result};
use signorini_scene::scene::Scene;
use signorini_scene::scene::units::Units;
use signorini_scene::setting::Omega;
use signorini_solve::{Scaled, choose_for_inputs};

impl<R: Bakes> Baked<R> {
    /// Bakes `problem`, whose inputs stand at their defaults, as its setting says.
    ///
    /// # Errors
    /// A setting that no module can have. What [`Approach::FullModel`] cannot treat. Ranges of inputs that leave a contact edge
    /// no flux. Numbers or answers that the scalar type cannot hold.
    pub fn new(problem: &Problem) -> Result<Self> {
        R::bake_full(problem)
    }

    pub(crate) fn bake(problem: &Problem) -> Result<Self> {
        Self::of_scaled(&Scaled::new(problem, choose_for_inputs(problem)?)?)
    }

    /// The same in units that are chosen.
    ///
    /// # Errors
    /// As for [`Baked::new`].
    pub fn of_scaled(problem: &Scaled) -> Result<Self> {
        problem.own.check_limits_within_ranges()?;
        let face = ModuleApi::new(problem.own);
        let scale = Some(problem.units).filter(|units| *units != Units::default());
        scale.iter().try_for_each(|units| refuse_answers::<R>(&problem.own.scene, units))?;
        let exclusions = exclusions(&problem.own.exclusions());
        let baked = Self::in_its_units(problem.problem(), face)?;
        let wanted = wanted(&problem.own.scene);
        let outputs = baked.outputs.into_iter().zip(wanted.iter());
        let outputs = outputs.map(|(output, of)| output.in_scene(of.quantity, &problem.units));
        Ok(Self { scale, exclusions, outputs: outputs.collect(), ..baked })
    }

    /// With what the bound of the evolution begins with, and sweeps for steps so short.
    ///
    /// # Errors
    /// A matrix without an ω.
    pub fn evolving(mut self, problem: &Scaled, evolution: Option<&Evolution>) -> Result<Self> {
        let Some(stored) = self.stored.take() else { return Ok(self) };
        if let (Omega::Auto, Some(omega)) = (
            problem.own.scene.setting.unwrap_or_default().omega,
            short(problem.problem(), evolution),
        ) {
            self.how.relaxation = Relaxation::Adaptive(R::narrow(omega));
        }
        self.stored = Some(stored.with_evolution(evolution, &problem.units));
        Ok(self)
    }

    /// What 1 stands for in [`Controller::u`] and the other arrays of a controller.
    pub fn units(&self) -> Units {
        self.scale.unwrap_or_default()
    }

    /// The units of a controller as the kernel takes them, where they are not the scene's.
    pub(super) fn kernel_units(&self) -> Option<full::Units<R>> {
        self.scale.map(|units| {
            let [u, flux, energy] = [units.u, units.flux(), units.energy()].map(R::narrow);
            full::Units { u, flux, energy }
        })
    }

    /// The same with ticks that a factor solves; `problem` is what it was baked from, in its units.
    ///
    /// # Errors
    /// What [`Approach::FactoredTicks`] cannot treat; a matrix that this scalar cannot tell from a singular one, a factor beyond
    /// all memory.
    pub fn with_factor(self, problem: &Problem) -> Result<Self> {
        let refused = |message: String| {
            let hint = "take solver = \"sweeps\", or the scalar f64";
            InputError::new(message).file(&problem.scene.path).hint(hint)
        };
        Approach::FactoredTicks.check(problem)?;
        let Some(factored) = Factored::new(problem)? else {
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
        let inputs: Vec<R> = scene.inputs.iter().map(|input| R::narrow(input.default)).collect();
        Controller::new(self).solves(&inputs)
    }
}

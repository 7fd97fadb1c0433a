//! Limits of each approach to a problem, and the words in which it refuses.
//!
//! ```text
//!   Property (found in the problem) × Approach (asked by whoever takes it) ─► Lack, or nothing
//! ```
//! All refusals that follow from what a scene states are here. Two kinds are elsewhere, for they follow from numbers:
//! what a scalar type cannot hold (`range` of bake, `unfit` of solve), and matrices that prove singular.
//! Why there is an answer without an error bound is a `NoBound` of certify.

use std::fmt;

use signorini_kernel::mesh::components::PartCounts;

use super::property::{MOST_NUMBERS, Property};
use super::{Parts, Problem};
use signorini_scene::error::{Error, InputError, Result};
use signorini_scene::scene::term::first_in_time;
use signorini_scene::scene::{Field, Located};

/// Ways to treat a problem.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Approach {
    /// The elimination of all but the contact edges.
    Condensation,
    /// The elimination for every value of one transfer coefficient.
    Modes,
    /// The elimination for steps in time, with a few states.
    Stepped,
    /// The kernel's tick on the mesh.
    Tick,
    /// The full model that `bake` writes: that tick, with loads linear in inputs.
    FullModel,
    /// The kernel's sparse factor, in a solve.
    Factor,
    /// A factor in the ticks of a full model, one for all of them.
    FactoredTicks,
    /// Data for tests of the kernel's stages.
    Export,
    /// Other solvers on the same matrices.
    Baselines,
}

/// A property of a problem that an approach cannot treat; its text is the reason without the file.
#[derive(Debug)]
pub struct Lack {
    /// Property of the problem that is in the way.
    pub property: Property,
    refusal: InputError,
}

impl Approach {
    /// How `problem` is condensed: in steps where it stores something, else for every value of a transfer coefficient where one input
    /// changes it.
    pub fn condensing(problem: &Problem) -> Self {
        if problem.scene.stores() {
            return Self::Stepped;
        }
        let inputs = problem.scene.inputs.iter();
        match inputs.filter(|input| input.field.value == Field::Coefficient).count() {
            1 => Self::Modes,
            _ => Self::Condensation,
        }
    }

    /// The first property of `problem` that this approach cannot treat.
    ///
    /// # Errors
    /// A part without a solution, where it matters what holds the parts.
    pub fn lack(self, problem: &Problem) -> Result<Option<Lack>> {
        let needs_parts = |of: &Property| of.is_of_parts() && !self.treats(*of);
        let parts = match Property::ALL.iter().any(needs_parts) {
            true => Parts::whatever_inputs(problem)?.counts,
            false => PartCounts::default(),
        };
        Ok(self.lack_with(problem, parts))
    }

    /// The lack of `problem`, whose `parts` have been examined.
    pub fn lack_with(self, problem: &Problem, parts: PartCounts) -> Option<Lack> {
        Property::ALL.iter().find_map(|&property| self.lack_of(property, problem, parts))
    }

    /// This property of `problem`, where it has it and this approach cannot treat it.
    pub fn lack_of(self, property: Property, problem: &Problem, parts: PartCounts) -> Option<Lack> {
        let refusal = self.refusal(property)?;
        let is_there = property.is_in(problem, parts);
        is_there.then(|| Lack { property, refusal: refusal(problem) })
    }

    /// Refuses a problem with a property that this approach cannot treat.
    ///
    /// # Errors
    /// Such a property; as for [`Approach::lack`].
    pub fn check(self, problem: &Problem) -> Result<()> {
        self.lack(problem)?.map_or(Ok(()), |lack| Err(lack.into()))
    }

    /// Whether it can treat problems with this property.
    pub const fn treats(self, property: Property) -> bool {
        self.refusal(property).is_none()
    }

    /// How it refuses a problem with this property, if it does.
    const fn refusal(self, property: Property) -> Option<fn(&Problem) -> InputError> {
        use Approach::{
            Baselines, Condensation, Export, Factor, FactoredTicks, FullModel, Modes, Stepped, Tick,
        };
        match property {
            Property::NoContact => match self {
                Baselines => Some(nothing_to_compare),
                Condensation | Modes | Stepped | Tick | FullModel | Factor | FactoredTicks
                | Export => None,
            },
            Property::ManyContactEdges => match self {
                Condensation | Modes | Stepped => Some(too_many),
                Tick | FullModel | Factor | FactoredTicks | Export | Baselines => None,
            },
            // Where that leaves a matrix singular, the factor finds it out.
            Property::FloatingPart => match self {
                Condensation | Modes | Stepped => Some(no_level),
                Tick | FullModel => {
                    Some(|problem| no_tick(problem, Property::FloatingPart, "nothing holds"))
                }
                Factor | FactoredTicks | Export | Baselines => None,
            },
            Property::PartHeldByContact => match self {
                // Where h is what may fail to hold it, the matrix of modes is singular for some h alone.
                Tick | FullModel | Modes => Some(|problem| {
                    no_tick(problem, Property::PartHeldByContact, "contact alone holds")
                }),
                Stepped => Some(no_walk),
                Condensation | Factor | FactoredTicks | Export | Baselines => None,
            },
            Property::LoadInTime => match self {
                Condensation | Modes | Stepped | FullModel => Some(no_clock),
                Tick | Factor | FactoredTicks | Export | Baselines => None,
            },
            Property::TransferInput => match self {
                Condensation | Stepped | Export => Some(one_matrix),
                FactoredTicks => Some(one_factor),
                FullModel | Modes | Tick | Factor | Baselines => None,
            },
            Property::Limit => match self {
                Export => Some(two_sides),
                Condensation | Modes | Stepped | Tick | FullModel | Factor | FactoredTicks
                | Baselines => None,
            },
            Property::Step => match self {
                Condensation | Modes | Tick | Export | Baselines => Some(no_steps),
                Stepped | FullModel | Factor | FactoredTicks => None,
            },
        }
    }
}

fn nothing_to_compare(problem: &Problem) -> InputError {
    InputError::new("without contact there is nothing to compare").file(&problem.scene.path)
}

fn too_many(problem: &Problem) -> InputError {
    let counts = problem.topology.counts;
    let (contact, edges) = (counts.contact, counts.edges());
    let message = format!(
        "boundary: {contact} contact edges on a mesh of {edges} edges are too many to condense, expected at \
         most {MOST_NUMBERS} numbers in their fields"
    );
    let hint = "refine less, or take the full model (--full, model = \"full\")";
    InputError::new(message).file(&problem.scene.path).hint(hint)
}

/// The fields of a condensed model would have no level.
fn no_level(problem: &Problem) -> InputError {
    let message = "boundary: a part of the domain has neither dirichlet, robin nor contact edges: its \
                   solution has no level, and its loads would have to stay in balance";
    let hint = "give it a dirichlet or robin boundary to condense it";
    InputError::new(message).file(&problem.scene.path).hint(hint)
}

/// The tick's certificate needs a way out of every part that no iterate can close.
fn no_tick(problem: &Problem, property: Property, held: &str) -> InputError {
    let scene = &problem.scene;
    if let Some(range) = problem.insulating_input().and_then(|input| input.range.as_ref()) {
        let message = format!("within it nothing may pass, and then {held} a part of the domain");
        let hint = "narrow the range, or give every part another dirichlet or robin boundary";
        return scene.error(range, message).hint(hint);
    }
    let message = format!("boundary: the full model has no tick for a part that {held}");
    let hint = match Approach::condensing(problem).treats(property) {
        true => "bake it with --condensed, or give every part a dirichlet or robin boundary",
        false => "give every part a dirichlet or robin boundary",
    };
    InputError::new(message).file(&scene.path).hint(hint)
}

/// No static shape of such a part can be told from a level that it has.
fn no_walk(problem: &Problem) -> InputError {
    let message = "boundary: contact alone holds a part, which has no condensed model in time";
    let hint = "take the full model (--full, model = \"full\"), or give the part a dirichlet or robin boundary";
    InputError::new(message).file(&problem.scene.path).hint(hint)
}

/// Firmware has no clock of the scene's.
fn no_clock(problem: &Problem) -> InputError {
    let scene = &problem.scene;
    let hint =
        "declare an [input.…] with the part in x and y as its pattern, and set it every tick";
    let refusal = match first_in_time(scene) {
        Some(load) => {
            scene.error(&load, format!("{} depends on t, which firmware does not know", load.value))
        }
        None => InputError::new("a load depends on t").file(&scene.path),
    };
    refusal.hint(hint)
}

/// A condensed model has one matrix, or one for each value of a single coefficient; data for tests have one.
fn one_matrix(problem: &Problem) -> InputError {
    changes_matrix(problem, "it changes the matrix, and one is written for all ticks")
        .hint("take the full model (--full, model = \"full\")")
}

/// The material that stores is what a scene states.
fn no_steps(problem: &Problem) -> InputError {
    let stores = problem.scene.materials.iter().find(|material| material.stores());
    let place = stores.map(|material| &material.capacity);
    refused_at(problem, place, "steps in time are not for this model".to_owned())
        .hint("take the full model (--full, model = \"full\"); without `capacity` the controller is the steady one")
}

fn one_factor(problem: &Problem) -> InputError {
    changes_matrix(problem, "it changes the matrix, and a factor holds for one of them")
        .hint("take solver = \"sweeps\"")
}

fn changes_matrix(problem: &Problem, message: &str) -> InputError {
    let input = problem.scene.transfer_input();
    refused_at(problem, input.map(|input| &input.field), message.to_owned())
}

/// A refusal at a place of the scene, where one is known.
fn refused_at<T>(problem: &Problem, place: Option<&Located<T>>, message: String) -> InputError {
    match place {
        Some(place) => problem.scene.error(place, message),
        None => InputError::new(message).file(&problem.scene.path),
    }
}

/// Contact with two sides.
fn two_sides(problem: &Problem) -> InputError {
    let message = "the flux of contact has a limit, which test data know nothing of".to_owned();
    let place = problem.scene.limited().map(|boundary| &boundary.name);
    refused_at(problem, place, message)
        .hint("without `limit` and with a finite `flux`, u ≥ gap holds everywhere")
}

impl fmt::Display for Lack {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.refusal.message())
    }
}

impl From<Lack> for Error {
    fn from(lack: Lack) -> Self {
        lack.refusal.into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixtures::{changed, on_grid, wall};
    use signorini_scene::mesh::structured::{Cells, grid};

    /// No model is named that would refuse the problem, too.
    #[test]
    fn a_condensed_model_is_named_where_there_is_one() {
        let held = "kind = \"dirichlet\", value = \"-1\"";
        let loose = "kind = \"neumann\", flux = \"-1\"";
        let stores = "conductivity = \"2\"\nmaterial.default.capacity = \"1\"\ntime.step = 1";
        for (below, more, is_named) in [
            ("kind = \"contact\"", "conductivity = \"2\"", true),
            ("kind = \"contact\"", stores, false),
            ("kind = \"neumann\", flux = \"1\"", "conductivity = \"2\"", false),
        ] {
            let text =
                changed(&wall("-1", below), &[(held, loose), ("conductivity = \"2\"", more)]);
            let (_, problem) = on_grid(&text, grid(2, Cells::Quads)).expect("a problem");
            let refused = Approach::FullModel.check(&problem).expect_err("no tick");
            let hint = miette::Diagnostic::help(&refused).expect("a hint").to_string();
            assert_eq!(hint.contains("--condensed"), is_named, "{below} {more}: {hint}");
        }
    }
}

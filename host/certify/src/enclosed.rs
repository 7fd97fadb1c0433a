//! What takes long of the data of a problem, kept for the next tick that has the same.
//!
//! A tick changes time, inputs and the start of a step. f is enclosed, and ψ and u_D are followed, anew where their own inputs or t have
//! changed them; other ticks take over what is known, bit for bit.

use signorini_problem::{Problem, Trace};
use signorini_scene::error::Result;
use signorini_scene::scene::Field;

use super::curved::CurvedEdges;
use super::oscillation::OfSource;

/// What is known of one problem, whose time, inputs and step change alone.
#[derive(Debug, Clone, Default)]
pub struct Enclosed {
    /// The oscillation of f.
    pub(super) source: Known<OfSource>,
    /// Where ψ and u_D leave their chords, and their traces where they may move.
    pub(super) ends: Known<(CurvedEdges, Vec<Trace>)>,
}

/// A value, and the data that it is of.
#[derive(Debug, Clone)]
pub(super) struct Known<T>(Option<(Vec<u64>, T)>);

impl<T> Default for Known<T> {
    fn default() -> Self {
        Self(None)
    }
}

impl<T: Clone> Known<T> {
    /// The value for the data of these fields, worked out anew where it is of others.
    pub fn of(
        &mut self,
        (problem, fields): (&Problem, &[Field]),
        anew: impl FnOnce() -> Result<T>,
    ) -> Result<T> {
        let key = key(problem, fields);
        match &self.0 {
            Some((of, value)) if *of == key => Ok(value.clone()),
            _ => {
                let value = anew()?;
                self.0 = Some((key, value.clone()));
                Ok(value)
            }
        }
    }
}

/// The bits of the inputs that change these fields, and of t where any of them depends on it.
fn key(problem: &Problem, fields: &[Field]) -> Vec<u64> {
    let scene = &problem.scene;
    let inputs = || scene.inputs.iter().filter(|input| fields.contains(&input.field.value));
    let of_boundaries = scene
        .boundaries
        .iter()
        .flat_map(|boundary| fields.iter().filter_map(|&field| boundary.condition.datum(field)));
    let source = fields.contains(&Field::Source).then_some(&scene.source);
    let patterns = inputs().map(|input| &input.pattern);
    let mut data = of_boundaries.chain(source).chain(patterns);
    let time = data.any(|datum| datum.value.uses_time()).then_some(problem.time);
    inputs().map(|input| input.default).chain(time).map(f64::to_bits).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::Evaluated;
    use signorini_problem::fixtures::{SMOOTH, on_grid};
    use signorini_scene::mesh::structured::{Cells, grid};

    /// The data of ticks in which f, ψ, both or nothing change are those that they have anew.
    #[test]
    fn what_is_taken_over_is_what_it_would_be_anew() -> Result<()> {
        let moving = "\n[input.heat]\nof = \"source\"\nfield = \"f\"\npattern = \"exp(x*y)\"\ndefault = 0\n\
             [input.lift]\nof = \"contact\"\nfield = \"gap\"\npattern = \"x^4\"\ndefault = 0\n";
        let (_, mut problem) = on_grid(&format!("{SMOOTH}{moving}"), grid(4, Cells::Triangles))?;
        let (mut enclosed, mut seen) = (Enclosed::default(), Vec::new());
        for inputs in [[0.0, 0.0], [0.0, 0.5], [0.7, 0.5], [0.7, 0.5], [-0.7, 0.1]] {
            problem.set(&[(0, inputs[0]), (1, inputs[1])], 0.0)?;
            let found = Evaluated::again(&problem, &mut enclosed)?;
            let expected = Evaluated::new(&problem)?;
            assert_eq!(found.oscillation.to_bits(), expected.oscillation.to_bits(), "{inputs:?}");
            assert_eq!(found.curved, expected.curved, "{inputs:?}");
            seen.push((found.oscillation, found.curved[0].mean));
        }
        seen.dedup();
        assert_eq!(seen.len(), 4, "{seen:?}");
        Ok(())
    }
}

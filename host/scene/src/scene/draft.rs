//! A scene as far as it could be read, with something in the place of what could not.

use super::{Boundary, Condition, Located, Material, Named, Scene};
use crate::error::{InputError, Result};
use crate::expression::Expression;
use crate::faults::Faults;

/// A scene file as far as it could be read.
#[derive(Debug)]
pub struct Draft {
    /// The scene: a boundary without a condition that could be read has no flux, a material without one A = 1.
    pub scene: Scene,
    /// The kind of each boundary, where that could be read.
    pub kinds: Vec<Option<&'static str>>,
    /// The keys of what could not be read: `boundary.river`, `mesh`.
    pub open: Vec<String>,
    /// What is wrong with the file and with the one that it extends.
    pub faults: Vec<InputError>,
}

impl Draft {
    /// The scene, if nothing is wrong with it.
    pub(super) fn finish(self) -> Result<Scene> {
        Faults::from(self.faults).into_result().map(|()| self.scene)
    }
}

/// The keys of the groups that could not be read.
pub(super) fn unread<T>(groups: &[Named<T>]) -> impl Iterator<Item = String> {
    groups.iter().filter(|(_, of)| of.is_none()).map(|(name, _)| name.key.clone())
}

/// A boundary; without flux where its condition could not be read.
pub(super) fn bounded(name: Located<String>, condition: Option<Condition>) -> Boundary {
    let none = || Condition::Neumann { flux: name.with(Expression::constant(0.0)) };
    let condition = condition.unwrap_or_else(none);
    Boundary { name, condition }
}

/// A material of A = 1.
pub(super) fn unit(name: Located<String>) -> Material {
    let number = |value| name.with(Expression::constant(value));
    let conductivity = [number(1.0), number(0.0), number(1.0)];
    Material { conductivity, is_scalar: true, capacity: number(0.0), name }
}

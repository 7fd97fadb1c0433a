//! Materials: which keys they have, and what these are measured in.

use super::entry::Entry;
use super::table::Table;
use super::units::Unit;
use super::{Datum, Located};
use crate::error::Result;
use crate::expression::{Expression, Variables};

/// The coefficient tensor on one physical surface.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// The surface; `default` covers the cells that no other material names.
    pub name: Located<String>,
    /// a_xx, a_xy, a_yy in x, y; a scalar a stands as a, 0, a.
    pub conductivity: [Datum; 3],
    /// Whether the file gave a scalar.
    pub is_scalar: bool,
}

impl Material {
    /// Its data, to be changed, each with its unit.
    pub fn data_mut(&mut self) -> Vec<(Unit, &mut Datum)> {
        self.conductivity.iter_mut().map(|entry| (Unit::Conductivity, entry)).collect()
    }
}

/// Reads `[material.NAME]`.
pub(super) fn read_material(table: &Table) -> Result<Material> {
    table.only("a material", "conductivity")?;
    let entry = table.require("conductivity")?;
    let read = |entry: &Entry| entry.expression(Variables::Space);
    let entries = entry.array().unwrap_or_default();
    let scalar = |a: Datum| {
        let zero = a.with(Expression::constant(0.0));
        [a.clone(), zero, a]
    };
    let (conductivity, is_scalar) = match &entries[..] {
        [axx, axy, ayy] => ([read(axx)?, read(axy)?, read(ayy)?], false),
        [a] => (scalar(read(a)?), true),
        _ if entry.array().is_some() => {
            return Err(entry.expected("a scalar or an array of three: a_xx, a_xy, a_yy").into());
        }
        _ => (scalar(read(&entry)?), true),
    };
    Ok(Material { name: table.name.clone(), conductivity, is_scalar })
}

//! Materials: which keys they have, and what these are measured in.

use super::entry::Entry;
use super::table::Table;
use super::units::Unit;
use super::{Datum, Located};
use crate::error::Result;
use crate::expression::{Expression, Variables};
use crate::faults::Faults;

/// The coefficient tensor on one physical surface.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// The surface; `default` covers the cells that no other material names.
    pub name: Located<String>,
    /// a_xx, a_xy, a_yy in x, y; a scalar a stands as a, 0, a.
    pub conductivity: [Datum; 3],
    /// Whether the file gave a scalar.
    pub is_scalar: bool,
    /// c ≥ 0 in x, y: what a unit of u stores per area; a constant one has been checked. 0 by default.
    pub capacity: Datum,
}

impl Material {
    /// Whether it stores anything.
    pub fn stores(&self) -> bool {
        self.capacity.value.is_constant() != Some(0.0)
    }

    /// Its data, to be changed, each with its unit. A capacity counts as a conductivity, in the same units of length and time.
    pub fn data_mut(&mut self) -> Vec<(Unit, &mut Datum)> {
        let all = self.conductivity.iter_mut().chain([&mut self.capacity]);
        all.map(|entry| (Unit::Conductivity, entry)).collect()
    }
}

const ABOUT_CAPACITIES: &str =
    "it is what a unit of u stores: density times specific heat, or a specific storage";

/// Reads `[material.NAME]`.
pub(super) fn read_material(table: &Table) -> Option<Material> {
    table.only("material.NAME", None);
    let conductivity = table.read("conductivity", read_tensor);
    let capacity = table.or_constant("capacity", 0.0, |entry| {
        entry.not_negative(", expected a capacity of at least 0", ABOUT_CAPACITIES)
    });
    let (conductivity, is_scalar) = conductivity?;
    Some(Material { name: table.name.clone(), conductivity, is_scalar, capacity: capacity? })
}

/// The entries of A, and whether the file gives a scalar.
fn read_tensor(entry: &Entry) -> Result<([Datum; 3], bool)> {
    let read = |entry: &Entry| entry.expression(Variables::Space);
    let scalar = |a: Datum| {
        let zero = a.with(Expression::constant(0.0));
        ([a.clone(), zero, a], true)
    };
    match entry.array().as_deref() {
        Some([axx, axy, ayy]) => {
            let faults = Faults::default();
            let [axx, axy, ayy] = [axx, axy, ayy].map(|entry| faults.keep(read(entry)));
            faults.into_result()?;
            let all = axx.zip(axy).zip(ayy).map(|((axx, axy), ayy)| ([axx, axy, ayy], false));
            all.ok_or_else(|| entry.expected("three entries").into())
        }
        Some([a]) => read(a).map(scalar),
        Some(_) => Err(entry.expected("a scalar or an array of three: a_xx, a_xy, a_yy").into()),
        None => read(entry).map(scalar),
    }
}

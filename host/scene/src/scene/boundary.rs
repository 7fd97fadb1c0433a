//! Boundary conditions: which keys each kind has, and which of them an input may change.

use super::table::Table;
use super::{Boundary, Condition, Field, Located};
use crate::error::Result;
use crate::expression::{Expression, Variables};

/// Reads `[boundary.NAME]`; a key of another kind is refused.
pub(super) fn read_boundary(table: &Table) -> Result<Boundary> {
    let kind = table.require("kind")?;
    let read = kind.choice::<fn(&Table) -> Result<Condition>>(&[
        ("dirichlet", read_dirichlet),
        ("neumann", read_neumann),
        ("robin", read_robin),
        ("contact", read_contact),
    ])?;
    Ok(Boundary { name: table.name.clone(), condition: (read.value)(table)? })
}

fn read_dirichlet(table: &Table) -> Result<Condition> {
    table.only("a dirichlet boundary", &["kind", "value"])?;
    Ok(Condition::Dirichlet { value: table.require("value")?.expression(Variables::SpaceTime)? })
}

fn read_neumann(table: &Table) -> Result<Condition> {
    table.only("a neumann boundary", &["kind", "flux"])?;
    Ok(Condition::Neumann { flux: table.require("flux")?.expression(Variables::SpaceTime)? })
}

/// The coefficient enters the matrix, which stays the same from tick to tick: no t in it.
fn read_robin(table: &Table) -> Result<Condition> {
    table.only("a robin boundary", &["kind", "coefficient", "ambient"])?;
    let entry = table.require("coefficient")?;
    let coefficient = entry.expression(Variables::Space)?;
    if let Some(value) = coefficient.value.is_constant().filter(|&value| value < 0.0) {
        let error = entry.error(format_args!("{value} is negative"));
        return Err(error.hint("(A∇u)·n = coefficient (ambient − u) with coefficient ≥ 0").into());
    }
    let ambient = table.require("ambient")?.expression(Variables::SpaceTime)?;
    Ok(Condition::Robin { coefficient, ambient })
}

fn read_contact(table: &Table) -> Result<Condition> {
    table.only("a contact boundary", &["kind", "gap", "flux"])?;
    Ok(Condition::Contact {
        gap: table.expression_or_zero("gap", Variables::SpaceTime)?,
        flux: table.expression_or_zero("flux", Variables::SpaceTime)?,
    })
}

impl Condition {
    /// The kind as the scene file calls it.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Dirichlet { .. } => "dirichlet",
            Self::Neumann { .. } => "neumann",
            Self::Robin { .. } => "robin",
            Self::Contact { .. } => "contact",
        }
    }

    /// The load `field` of this boundary, if its kind has it.
    pub fn load(&self, field: Field) -> Option<&Located<Expression>> {
        match (self, field) {
            (Self::Dirichlet { value }, Field::Value) => Some(value),
            (Self::Neumann { flux } | Self::Contact { flux, .. }, Field::Flux) => Some(flux),
            (Self::Robin { ambient, .. }, Field::Ambient) => Some(ambient),
            (Self::Contact { gap, .. }, Field::Gap) => Some(gap),
            _ => None,
        }
    }
}

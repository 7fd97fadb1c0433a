//! Boundary conditions: which keys each kind has, what these data are, and which of them an input may change.
//!
//! A new key is a field of [`Condition`], read here and listed in `data_of`: whoever asks for loads, units or fields
//! asks that list.

use super::entry::Entry;
use super::table::Table;
use super::{Condition, Datum, Field};
use crate::error::Result;

/// A way to read a condition from its table.
type Read = fn(&Table) -> Option<Condition>;

const KINDS: [(&str, Read); 4] = [
    ("dirichlet", |table| Some(Condition::Dirichlet { value: table.load("value")? })),
    ("neumann", |table| Some(Condition::Neumann { flux: table.load("flux")? })),
    ("robin", read_robin),
    ("contact", read_contact),
];

/// Reads `[boundary.NAME]`; a key of another kind is a fault.
pub(super) fn read_boundary(table: &Table) -> Option<Condition> {
    let kind = table.require("kind")?;
    let read = table.keep(kind.choice(&KINDS))?;
    table.only("boundary.NAME", kind.word());
    read(table)
}

/// The kind of the boundary of a table, where that is written and there is such a kind.
pub(super) fn kind_of(table: &Table) -> Option<&'static str> {
    let word = table.get("kind")?.word()?;
    KINDS.iter().find(|(kind, _)| *kind == word).map(|(kind, _)| *kind)
}

fn read_robin(table: &Table) -> Option<Condition> {
    // It enters the matrix, which stays the same from tick to tick, so that it has no t.
    let hint = "(A∇u)·n = coefficient (ambient − u) with coefficient ≥ 0";
    let coefficient = table.read("coefficient", |entry| entry.not_negative("", hint));
    let ambient = table.load("ambient");
    Some(Condition::Robin { coefficient: coefficient?, ambient: ambient? })
}

fn read_contact(table: &Table) -> Option<Condition> {
    let gap = table.or_constant("gap", 0.0, Entry::load);
    let flux = table.or_constant("flux", 0.0, Entry::end_of_range);
    let limit = table.or_constant("limit", f64::INFINITY, Entry::end_of_range);
    let (gap, flux, limit) = (gap?, flux?, limit?);
    table.keep(check_range(table, [&flux, &limit]))?;
    Some(Condition::Contact { gap, flux, limit })
}

/// Refuses ends of a flux that leave nothing between them, and such that leave everything. What varies is checked on the mesh.
fn check_range(table: &Table, ends: [&Datum; 2]) -> Result<()> {
    let [least, most] = ends.map(|end| end.value.is_constant());
    let error = |at: &Datum, message: String, hint: &str| {
        Err(table.document.error(at, message).hint(hint.to_owned()).into())
    };
    if least == Some(f64::INFINITY) {
        return error(ends[0], "inf leaves no flux".to_owned(), "an infinite `flux` is \"-inf\"");
    }
    if most == Some(f64::NEG_INFINITY) {
        return error(ends[1], "-inf leaves no flux".to_owned(), "an infinite `limit` is \"inf\"");
    }
    match (least, most) {
        (Some(f64::NEG_INFINITY), Some(f64::INFINITY)) => error(
            ends[0],
            "-inf, where limit is inf, leaves every flux: u = gap".to_owned(),
            "write kind = \"dirichlet\" with the gap as its value, or give one of the two a finite end",
        ),
        (Some(least), Some(most)) if least > most => error(
            ends[1],
            format!("{most} is less than flux = {least}"),
            "the flux of a contact boundary lies between `flux` and `limit`",
        ),
        _ => Ok(()),
    }
}

/// The data of a condition with their fields, in the order in which they are visited: one list for `&` and for `&mut`.
macro_rules! data_of {
    ($condition:expr) => {
        match $condition {
            Condition::Dirichlet { value } => vec![(Field::Value, value)],
            Condition::Neumann { flux } => vec![(Field::Flux, flux)],
            Condition::Robin { coefficient, ambient } => {
                vec![(Field::Coefficient, coefficient), (Field::Ambient, ambient)]
            }
            Condition::Contact { gap, flux, limit } => {
                vec![(Field::Gap, gap), (Field::Flux, flux), (Field::Limit, limit)]
            }
        }
    };
}

impl Condition {
    /// Its data, each with its field.
    pub fn data(&self) -> Vec<(Field, &Datum)> {
        data_of!(self)
    }

    /// Its data, to be changed, each with its field.
    pub fn data_mut(&mut self) -> Vec<(Field, &mut Datum)> {
        data_of!(self)
    }

    /// The kind as the scene file calls it.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Dirichlet { .. } => "dirichlet",
            Self::Neumann { .. } => "neumann",
            Self::Robin { .. } => "robin",
            Self::Contact { .. } => "contact",
        }
    }

    /// The transfer coefficient h, if its kind has one: ∫h u² on its edges belongs to the energy norm then.
    pub fn transfer(&self) -> Option<&Datum> {
        match self {
            Self::Robin { coefficient, .. } => Some(coefficient),
            Self::Dirichlet { .. } | Self::Neumann { .. } | Self::Contact { .. } => None,
        }
    }

    /// Whether its flux has another range than "from `flux` on".
    pub fn is_limited(&self) -> bool {
        let Self::Contact { flux, limit, .. } = self else { return false };
        limit.value.is_constant() != Some(f64::INFINITY)
            || flux.value.is_constant() == Some(f64::NEG_INFINITY)
    }

    /// The load or coefficient `field` of this boundary, to which an input may add, if its kind has it.
    pub fn datum(&self, field: Field) -> Option<&Datum> {
        self.data().into_iter().find_map(|(of, data)| (of == field).then_some(data))
    }
}

//! Inputs, which a controller sets.

use super::entry::Entry;
use super::range::read_range;
use super::table::Table;
use super::{Boundary, Condition, Field, Input, Located, Named, Scene};
use crate::error::{InputError, Result};
use crate::expression::Variables;

pub(super) const FIELDS: [(&str, Field); 7] = [
    ("flux", Field::Flux),
    ("limit", Field::Limit),
    ("value", Field::Value),
    ("gap", Field::Gap),
    ("ambient", Field::Ambient),
    ("coefficient", Field::Coefficient),
    ("f", Field::Source),
];

impl Field {
    /// Its name in the scene file.
    pub fn name(self) -> &'static str {
        FIELDS.iter().find(|(_, field)| *field == self).map_or("", |(name, _)| name)
    }
}

/// Reads `[input.NAME]`. The pattern has no t: what changes is the value that multiplies it.
pub(super) fn read_input(table: &Table, boundaries: &[Named<Condition>]) -> Option<Input> {
    table.only("input.NAME", None);
    let place = read_place(table, boundaries);
    let pattern = table.read("pattern", |entry| entry.expression(Variables::Space));
    let default = table.read_or("default", 0.0, Entry::number);
    let range = table.read_some("range", read_range);
    let unit = read_unit(table);
    let (of, field) = place?;
    if field.value == Field::Coefficient {
        // What stands in the matrix is judged for all values.
        table.require("range")?;
    }
    let (pattern, default, range, unit) = (pattern?, default?, range?, unit?);
    let input = Input { name: table.name.clone(), of, field, pattern, default, range, unit };
    table.keep(check_default(table, &input))?;
    Some(input)
}

/// The boundary that an input acts on, and the field.
fn read_place(
    table: &Table,
    boundaries: &[Named<Condition>],
) -> Option<(Located<String>, Located<Field>)> {
    let (of, entry) = (table.require("of"), table.require("field"));
    let name = of.as_ref().and_then(|of| table.keep(of.text()));
    let field = entry.as_ref().and_then(|entry| table.keep(entry.choice(&FIELDS)));
    let (of, entry, name, field) = (of?, entry?, name?, field?);
    table.keep(check_field(&of, &entry, field, boundaries))?;
    Some((name, entry.at.with(field)))
}

/// Refuses a default outside the range; where none is written the one that counts is 0, and the range is to blame.
fn check_default(table: &Table, input: &Input) -> Result<()> {
    let culprit = table.get("default").or_else(|| table.get("range"));
    match (input.refusal(input.default), culprit) {
        (Some(refusal), Some(entry)) => {
            let error = entry.error(format!("the default {refusal}"));
            Err(error.hint("give a default inside it").into())
        }
        _ => Ok(()),
    }
}

/// Refuses a field that `of` lacks (the source has f, a boundary the fields of its kind), and an infinite end of a
/// flux: nothing can be added to it.
fn check_field(
    of: &Entry,
    entry: &Entry,
    field: Field,
    boundaries: &[Named<Condition>],
) -> Result<()> {
    let (name, written) = (of.text()?.value, entry.text()?.value);
    let (found, fields) = match (field, name.as_str()) {
        (Field::Source, "source") => return Ok(()),
        (_, "source") if !boundaries.iter().any(|(known, _)| known.value == "source") => {
            ("the source".to_owned(), "f".to_owned())
        }
        _ => {
            // One that could not be read is told of already.
            let Some(condition) = find(of, BOUNDARIES, boundaries)? else { return Ok(()) };
            if let Some(base) = condition.datum(field) {
                let infinite = base.value.is_constant().filter(|value| value.is_infinite());
                return infinite.map_or(Ok(()), |value| {
                    let message = format!("{} is {value}, to which nothing can be added", base.key);
                    let hint = format!("give [boundary.{name}] a finite `{written}`");
                    Err(entry.error(message).hint(hint).into())
                });
            }
            let has = |&&(_, field): &&(&str, Field)| condition.datum(field).is_some();
            let names: Vec<_> = FIELDS.iter().filter(has).map(|(name, _)| *name).collect();
            (format!("a {} boundary", condition.kind()), names.join(", "))
        }
    };
    let message = format!("{found} has no field `{written}`");
    Err(entry.error(message).hint(format!("an input may act on its {fields}")).into())
}

/// A short text that may stand in a comment of any language.
pub(super) fn read_unit(table: &Table) -> Option<Option<String>> {
    table.read_some("unit", unit)
}

fn unit(entry: &Entry) -> Result<String> {
    const LONGEST: usize = 24;
    let unit = entry.text()?.value;
    let is_plain = |c: char| !c.is_control() && !"\"\\".contains(c);
    let fits = (1..=LONGEST).contains(&unit.chars().count());
    if !fits || !unit.chars().all(is_plain) || unit.contains("*/") || unit.contains("/*") {
        let error = entry.error(format_args!("expected 1 to {LONGEST} characters of a unit"));
        return Err(error.hint("write one such as \"m2/s\" or \"°C\"").into());
    }
    Ok(unit)
}

/// A kind of groups in words: of one, and of several.
pub(super) type Words = [&'static str; 2];

pub(super) const BOUNDARIES: Words = ["boundary", "boundaries"];

/// The group that `of` names; nothing where it could not be read.
pub(super) fn find<'a, T>(
    of: &Entry,
    [one, many]: Words,
    groups: &'a [Named<T>],
) -> Result<Option<&'a T>> {
    let name = of.text()?.value;
    let found = groups.iter().find(|(known, _)| known.value == name);
    found.map(|(_, group)| group.as_ref()).ok_or_else(|| {
        let error = of.error(format_args!("no {one} `{name}` in the scene"));
        error.hint(format!("{many} of the scene: {}", names(groups))).into()
    })
}

pub(super) fn names<T>(groups: &[Named<T>]) -> String {
    list(groups.iter().map(|(name, _)| name))
}

fn list<'a>(names: impl Iterator<Item = &'a Located<String>>) -> String {
    names.map(|name| name.value.as_str()).collect::<Vec<_>>().join(", ")
}

const ABOUT_RANGES: &str = "a range in the scene says what the input may be";

impl Scene {
    /// The first input that adds to a transfer coefficient.
    pub fn transfer_input(&self) -> Option<&Input> {
        self.inputs.iter().find(|input| input.field.value == Field::Coefficient)
    }

    /// The first contact boundary whose flux has another range than "from `flux` on".
    pub fn limited(&self) -> Option<&Boundary> {
        self.boundaries.iter().find(|boundary| boundary.condition.is_limited())
    }

    /// The first input that changes an end of the flux of such a boundary.
    pub fn limit_input(&self) -> Option<&Input> {
        self.inputs.iter().find(|input| {
            let limited = self.boundaries.iter().filter(|of| of.condition.is_limited());
            let is_end = matches!(input.field.value, Field::Flux | Field::Limit);
            is_end && limited.into_iter().any(|of| of.name.value == input.of.value)
        })
    }

    /// The names of its inputs, as a hint.
    pub fn known_inputs(&self) -> String {
        match list(self.inputs.iter().map(|input| &input.name)) {
            none if none.is_empty() => "the scene has no inputs".to_owned(),
            names => format!("inputs of the scene: {names}"),
        }
    }

    /// The position of an input.
    pub fn find_input(&self, name: &str) -> Option<usize> {
        self.inputs.iter().position(|input| input.name.value == name)
    }

    /// The position of an input that must be there.
    ///
    /// # Errors
    /// No input of this name.
    pub fn input_number(&self, name: &str) -> Result<usize> {
        self.find_input(name).ok_or_else(|| {
            let message = format!("no input `{name}` in the scene");
            InputError::new(message).file(self.file()).hint(self.known_inputs()).into()
        })
    }

    /// `Ok` where the input at this position may have this value.
    ///
    /// # Errors
    /// A value that is no number, or outside the input's range.
    pub fn check_input(&self, at: usize, value: f64) -> Result<()> {
        let Some(input) = self.inputs.get(at) else { return Ok(()) };
        let wrong = match value.is_finite() {
            true => input.refusal(value),
            false => Some(format!("{value} is not a finite number")),
        };
        wrong.map_or(Ok(()), |why| {
            let error = InputError::new(format!("input.{}: {why}", input.name.value));
            Err(error.file(self.file()).hint(ABOUT_RANGES).into())
        })
    }

    /// Sets the default of an input from `NAME=VALUE`, as on the command line.
    pub fn set_input(&mut self, assignment: &str) -> Result<()> {
        let known = self.known_inputs();
        let error = |message: String| {
            InputError::new(format!("--input {assignment}: {message}")).hint(known.clone())
        };
        let (name, value) =
            assignment.rsplit_once('=').ok_or_else(|| error("expected NAME=VALUE".to_owned()))?;
        let found = self.find_input(name).and_then(|at| self.inputs.get_mut(at));
        let input = found.ok_or_else(|| error(format!("no input `{name}` in the scene")))?;
        let value = value
            .parse()
            .ok()
            .filter(|value: &f64| value.is_finite())
            .ok_or_else(|| error(format!("`{value}` is not a finite number")))?;
        if let Some(refusal) = input.refusal(value) {
            return Err(error(refusal).hint(ABOUT_RANGES).into());
        }
        input.default = value;
        Ok(())
    }
}

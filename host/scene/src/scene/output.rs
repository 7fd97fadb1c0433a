//! Outputs, which a controller reads.

use std::mem::discriminant;

use super::control::{BOUNDARIES, Words, find, names, read_unit};
use super::entry::Entry;
use super::table::Table;
use super::{Condition, Located, Material, Named, Output, Quantity};
use crate::error::Result;

/// The kinds of outputs.
const KINDS: [(&str, Quantity); 9] = [
    ("flux", Quantity::Flux),
    ("force", Quantity::Force),
    ("length", Quantity::Length),
    ("saturated", Quantity::Saturated),
    ("probe", Quantity::Probe { at: [0.0; 2] }),
    ("mean", Quantity::Mean),
    ("content", Quantity::Content),
    ("bound", Quantity::Bound),
    ("window", Quantity::Window),
];

const ABOUT_STORAGE: &str = "give a material a `capacity`: what a unit of u stores per area";

/// The groups that outputs are about.
#[derive(Clone, Copy)]
pub(super) struct Groups<'a> {
    pub boundaries: &'a [Named<Condition>],
    pub materials: &'a [Named<Material>],
}

/// Reads `[output.NAME]`.
pub(super) fn read_output(table: &Table, groups: Groups) -> Option<Output> {
    let kind = table.require("kind")?;
    let quantity = table.keep(kind.choice(&KINDS))?;
    table.only("output.NAME", kind.word());
    let (unit, measured) = (read_unit(table), measured(table, quantity, groups));
    let (quantity, of) = measured?;
    Some(Output { name: table.name.clone(), quantity, of, unit: unit? })
}

/// The quantity with its place, and the groups that it is about.
fn measured(
    table: &Table,
    quantity: Quantity,
    groups @ Groups { boundaries, materials }: Groups,
) -> Option<(Quantity, Vec<Located<String>>)> {
    match quantity {
        Quantity::Bound => Some((quantity, Vec::new())),
        Quantity::Window => {
            let kind = table.require("kind")?;
            table.keep(stores(&kind, materials))?;
            Some((quantity, Vec::new()))
        }
        Quantity::Probe { .. } => {
            let at = table.read("at", |at| {
                let [x, y] = at.pair("x, y")?;
                Ok([x.number()?, y.number()?])
            })?;
            Some((Quantity::Probe { at }, Vec::new()))
        }
        Quantity::Mean | Quantity::MeanInside => {
            table.read("of", |of| Ok((mean(of, groups)?, vec![of.text()?])))
        }
        Quantity::Content => {
            let kind = table.require("kind")?;
            let of = table.keep(content(&kind, table.get("of").as_ref(), materials))?;
            Some((quantity, of))
        }
        Quantity::Flux => {
            let named = |of: &Entry| find(of, BOUNDARIES, boundaries).and_then(|_| of.text());
            let of = table.read("of", |of| one_or_more(of, BOUNDARIES, named))?;
            Some((quantity, of))
        }
        Quantity::Force | Quantity::Length | Quantity::Saturated => {
            let named = |of: &Entry| contact(of, boundaries);
            let of = table.read_or("of", Vec::new(), |of| one_or_more(of, BOUNDARIES, named))?;
            Some((quantity, of))
        }
    }
}

const MATERIALS: Words = ["material", "materials"];

/// The names of one such thing or of a list of them, each once.
fn one_or_more(
    of: &Entry,
    [one, many]: Words,
    named: impl Fn(&Entry) -> Result<Located<String>>,
) -> Result<Vec<Located<String>>> {
    let Some(items) = of.array() else { return Ok(vec![named(of)?]) };
    let mut names: Vec<Located<String>> = Vec::with_capacity(items.len());
    for item in &items {
        let name = named(item)?;
        if names.iter().any(|known| known.value == name.value) {
            let error = item.error(format_args!("`{}` comes twice", name.value));
            return Err(error.hint(format!("name each {one} once")).into());
        }
        names.push(name);
    }
    match names.is_empty() {
        true => Err(of.expected(&format!("a {one}, or a list of {many}")).into()),
        false => Ok(names),
    }
}

/// The name of a contact boundary.
fn contact(of: &Entry, boundaries: &[Named<Condition>]) -> Result<Located<String>> {
    match find(of, BOUNDARIES, boundaries)? {
        Some(Condition::Contact { .. }) | None => of.text(),
        Some(other) => {
            let message = format!("expected a contact boundary, this one is {}", other.kind());
            Err(of.error(message).hint("without `of` it is taken over all contact").into())
        }
    }
}

/// A mean over a boundary or, where none has the name, over a material.
fn mean(of: &Entry, Groups { boundaries, materials }: Groups) -> Result<Quantity> {
    if of.array().is_some() {
        let hint = "write an output for each, or give these curves one name in the mesh";
        return Err(of.expected("one boundary or one material").hint(hint).into());
    }
    let name = of.text()?.value;
    if boundaries.iter().any(|(known, _)| known.value == name) {
        return Ok(Quantity::Mean);
    }
    if materials.iter().any(|(known, _)| known.value == name) {
        return Ok(Quantity::MeanInside);
    }
    let error = of.error(format_args!("no boundary or material `{name}` in the scene"));
    let [boundaries, materials] = [names(boundaries), names(materials)];
    Err(error.hint(format!("boundaries: {boundaries}; materials: {materials}")).into())
}

/// The materials whose content it is, at least one of which stores u; none stands for all.
fn content(
    kind: &Entry,
    of: Option<&Entry>,
    materials: &[Named<Material>],
) -> Result<Vec<Located<String>>> {
    let Some(of) = of else { return stores(kind, materials).map(|()| Vec::new()) };
    let named = |of: &Entry| find(of, MATERIALS, materials).and_then(|_| of.text());
    let names = one_or_more(of, MATERIALS, named)?;
    let is_named = |(name, _): &&Named<Material>| names.iter().any(|of| of.value == name.value);
    stores(of, materials.iter().filter(is_named))?;
    Ok(names)
}

/// Refuses materials none of which stores u; of one that could not be read nobody knows.
fn stores<'m>(at: &Entry, materials: impl IntoIterator<Item = &'m Named<Material>>) -> Result<()> {
    match materials.into_iter().any(|(_, of)| of.as_ref().is_none_or(Material::stores)) {
        true => Ok(()),
        false => {
            let error = at.error("no material that it is about has a capacity");
            Err(error.hint(ABOUT_STORAGE).into())
        }
    }
}

impl Output {
    /// Whether it is about this boundary or material, by its name.
    pub fn is_of(&self, name: &str) -> bool {
        self.of.iter().any(|of| of.value == name)
    }

    /// The place that it is about in words, each name as `written`: `all` where it names none.
    pub fn place(&self, all: &str, written: impl Fn(&str) -> String) -> String {
        match &self.of.iter().map(|of| written(&of.value)).collect::<Vec<_>>()[..] {
            [] => all.to_owned(),
            [one] => one.clone(),
            [most @ .., last] => format!("{} and {last}", most.join(", ")),
        }
    }
}

impl Quantity {
    /// Its kind as the scene file calls it.
    pub fn kind(self) -> &'static str {
        let is_own = |(_, of): &&(&str, Self)| discriminant(of) == discriminant(&self);
        KINDS.iter().find(is_own).map_or("mean", |(kind, _)| kind)
    }

    /// Whether it is an integral over cells of materials; `of` names these.
    pub fn is_inside(self) -> bool {
        matches!(self, Self::Content | Self::MeanInside)
    }
}

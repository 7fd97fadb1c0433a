//! Outputs, which a controller reads.

use super::control::{find_boundary, list, read_unit};
use super::entry::Entry;
use super::table::Table;
use super::{Boundary, Condition, Located, Material, Output, Quantity};
use crate::error::Result;

/// The kinds of outputs, with words for each.
const KINDS: [(&str, (&str, Quantity)); 9] = [
    ("flux", ("a flux", Quantity::Flux)),
    ("force", ("a force", Quantity::Force)),
    ("length", ("a length", Quantity::Length)),
    ("saturated", ("a saturated length", Quantity::Saturated)),
    ("probe", ("a probe", Quantity::Probe { at: [0.0; 2] })),
    ("mean", ("a mean", Quantity::Mean)),
    ("content", ("a content", Quantity::Content)),
    ("bound", ("a bound", Quantity::Bound)),
    ("window", ("a window", Quantity::Window)),
];

const ABOUT_STORAGE: &str = "give a material a `capacity`: what a unit of u stores per area";

/// Reads `[output.NAME]`.
pub(super) fn read_output(
    table: &Table,
    boundaries: &[Boundary],
    materials: &[Material],
) -> Result<Output> {
    let kind = table.require("kind")?;
    let (what, mut quantity) = kind.choice(&KINDS)?.value;
    let of = match &mut quantity {
        Quantity::Bound => table.only(what, "kind, unit").map(|()| Vec::new())?,
        Quantity::Window => {
            table.only(what, "kind, unit")?;
            stores(&kind, materials)?;
            Vec::new()
        }
        Quantity::Probe { at } => {
            table.only(what, "kind, at, unit")?;
            let [x, y] = table.require("at")?.pair("x, y")?;
            *at = [x.number()?, y.number()?];
            Vec::new()
        }
        Quantity::Mean | Quantity::MeanInside => {
            table.only(what, "kind, of, unit")?;
            let of = table.require("of")?;
            quantity = mean(&of, boundaries, materials)?;
            vec![of.text()?]
        }
        Quantity::Content => {
            table.only(what, "kind, of, unit")?;
            content(&kind, table.get("of").as_ref(), materials)?
        }
        Quantity::Flux => {
            table.only(what, "kind, of, unit")?;
            let named = |of: &Entry| find_boundary(of, boundaries).and_then(|_| of.text());
            one_or_more(&table.require("of")?, BOUNDARIES, named)?
        }
        Quantity::Force | Quantity::Length | Quantity::Saturated => {
            table.only(what, "kind, of, unit")?;
            let named = |of: &Entry| contact(of, boundaries);
            table.get("of").map_or(Ok(Vec::new()), |of| one_or_more(&of, BOUNDARIES, named))?
        }
    };
    Ok(Output { name: table.name.clone(), quantity, of, unit: read_unit(table)? })
}

const BOUNDARIES: [&str; 2] = ["boundary", "boundaries"];
const MATERIALS: [&str; 2] = ["material", "materials"];

/// The names of one such thing or of a list of them, each once.
fn one_or_more(
    of: &Entry,
    [one, many]: [&str; 2],
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
fn contact(of: &Entry, boundaries: &[Boundary]) -> Result<Located<String>> {
    match &find_boundary(of, boundaries)?.condition {
        Condition::Contact { .. } => of.text(),
        other => {
            let message = format!("expected a contact boundary, this one is {}", other.kind());
            Err(of.error(message).hint("without `of` it is taken over all contact").into())
        }
    }
}

/// A mean over a boundary or, where none has the name, over a material.
fn mean(of: &Entry, boundaries: &[Boundary], materials: &[Material]) -> Result<Quantity> {
    let name = of.text()?.value;
    if boundaries.iter().any(|known| known.name.value == name) {
        return Ok(Quantity::Mean);
    }
    if materials.iter().any(|known| known.name.value == name) {
        return Ok(Quantity::MeanInside);
    }
    let error = of.error(format_args!("no boundary or material `{name}` in the scene"));
    let names = [
        list(boundaries.iter().map(|boundary| &boundary.name)),
        list(materials.iter().map(|material| &material.name)),
    ];
    let [boundaries, materials] = names;
    Err(error.hint(format!("boundaries: {boundaries}; materials: {materials}")).into())
}

/// The materials whose content it is, at least one of which stores u; none stands for all.
fn content(
    kind: &Entry,
    of: Option<&Entry>,
    materials: &[Material],
) -> Result<Vec<Located<String>>> {
    let Some(of) = of else { return stores(kind, materials).map(|()| Vec::new()) };
    let names = one_or_more(of, MATERIALS, |of| find_material(of, materials))?;
    let is_named = |material: &&Material| names.iter().any(|of| of.value == material.name.value);
    stores(of, materials.iter().filter(is_named))?;
    Ok(names)
}

/// Refuses materials none of which stores u.
fn stores<'m>(at: &Entry, materials: impl IntoIterator<Item = &'m Material>) -> Result<()> {
    match materials.into_iter().any(Material::stores) {
        true => Ok(()),
        false => {
            let error = at.error("no material that it is about has a capacity");
            Err(error.hint(ABOUT_STORAGE).into())
        }
    }
}

/// The name of a material.
fn find_material(of: &Entry, materials: &[Material]) -> Result<Located<String>> {
    let name = of.text()?;
    if materials.iter().any(|material| material.name.value == name.value) {
        return Ok(name);
    }
    let error = of.error(format_args!("no material `{}` in the scene", name.value));
    let names = list(materials.iter().map(|material| &material.name));
    Err(error.hint(format!("materials of the scene: {names}")).into())
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
    /// Whether it is an integral over cells of materials; `of` names these.
    pub fn is_inside(self) -> bool {
        matches!(self, Self::Content | Self::MeanInside)
    }
}

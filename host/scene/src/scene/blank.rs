//! A scene for a mesh that has none yet: a table for each of its groups, with "?" where somebody has to decide.

use std::collections::BTreeSet;
use std::fmt::Write;

use super::keys::{Key, SECTIONS, Section};
use super::read::MOST_TABLES;
use super::schema;
use super::table::header;
use crate::mesh::{Curve, Mesh, Surface};

/// Fewer columns than an editor shows.
const COMMENT_AT: usize = 26;

/// The text of a scene on `mesh`, which is written as `name` in it. Its faults are exactly its question marks.
pub fn blank(mesh: &Mesh, title: &str, name: &str) -> String {
    let condition =
        |of: &Section| format!("#     {:<16}{}\n", of.kind.unwrap_or_default(), of.about);
    let conditions: String = Section::all("boundary.NAME").map(condition).collect();
    let mut text = format!(
        "#:schema {}\n# A scene of signorini. Fill in each \"?\", then run `signorini check` on this file.\n\
         #   inside:           −∇·(A∇u) = f\n\
         #   on the boundary:  one of four conditions, with the outward normal n and the flux σ·n = A∇u·n\n\
         {conditions}#   heat:             u is a temperature, A a conductivity; where σ·n > 0 heat comes in\n\
         #   seepage:          u is minus the head; where σ·n > 0 water goes out\n\
         title = {}\nmesh = {}\n",
        schema::FILE,
        quoted(title),
        quoted(name)
    );
    materials(&mut text, mesh);
    boundaries(&mut text, mesh);
    text.push_str("\n# What else a scene may have; NAME is a name of yours.\n");
    let rest =
        SECTIONS.iter().filter(|of| !["", "material.NAME", "boundary.NAME"].contains(&of.header));
    rest.for_each(|section| example(&mut text, section));
    text
}

/// Which of these groups get a table: no two that share something, none that reaches beyond `all`, and no more than a scene may have.
fn chosen<T: Ord + Copy>(groups: &[(&str, &[T])], all: &BTreeSet<T>) -> Vec<bool> {
    let (mut taken, mut count) = (BTreeSet::new(), 0);
    let mut take = |(name, items): &(&str, &[T])| {
        let is_named = *name != "default" && name.parse::<u64>().is_err();
        let fits = items.iter().all(|item| all.contains(item) && !taken.contains(item));
        let is_chosen = is_named && fits && !items.is_empty() && count + 1 < MOST_TABLES;
        if is_chosen {
            taken.extend(items.iter().copied());
            count += 1;
        }
        is_chosen
    };
    groups.iter().map(&mut take).collect()
}

/// A table for each of the groups that are chosen, a comment on each other one, and a table for what is left of `all`.
fn tables<T: Ord + Copy>(
    text: &mut String,
    kind: &str,
    groups: &[(&str, &[T])],
    all: &BTreeSet<T>,
    size: impl Fn(&[T]) -> String,
    mut keys: impl FnMut(&mut String),
) {
    let mut left = all.clone();
    for (&(name, items), is_chosen) in groups.iter().zip(chosen(groups, all)) {
        let (header, size) = (header(kind, name), size(items));
        if is_chosen {
            left.retain(|item| items.binary_search(item).is_err());
            head(text, "", &header, &size);
            keys(text);
        } else {
            let is_inside = items.iter().any(|item| !all.contains(item));
            head(text, "# ", &header, &(size + why_not(name, is_inside)));
        }
    }
    if !left.is_empty() {
        let size = size(&left.into_iter().collect::<Vec<_>>());
        head(text, "", &header(kind, "default"), &format!("all that is left: {size}"));
        keys(text);
    }
}

fn materials(text: &mut String, mesh: &Mesh) {
    let groups: Vec<(&str, &[u32])> =
        mesh.surfaces.iter().map(|Surface { name, cells }| (name.as_str(), &cells[..])).collect();
    let size = |cells: &[u32]| {
        let area = mesh.area(cells.iter().copied());
        format!("area {}, {}", shown(area), counted(cells.len(), "cell"))
    };
    let keys = Section::of("material.NAME", None).map_or(&[][..], |section| section.keys);
    tables(text, "material", &groups, &(0..mesh.cells() as u32).collect(), size, |text| {
        keys.iter().for_each(|key| line(text, None, key, key.default.is_none().then_some("\"?\"")));
    });
}

fn boundaries(text: &mut String, mesh: &Mesh) {
    let groups: Vec<(&str, &[[u32; 2]])> =
        mesh.curves.iter().map(|Curve { name, edges }| (name.as_str(), &edges[..])).collect();
    let size = |edges: &[[u32; 2]]| {
        format!("length {}, {}", shown(mesh.length(edges)), counted(edges.len(), "edge"))
    };
    let mut is_first = true;
    tables(text, "boundary", &groups, &mesh.outer_edges().into_iter().collect(), size, |text| {
        condition(text, std::mem::replace(&mut is_first, false));
    });
}

/// A condition to choose; the keys of each kind stand in the first table alone.
fn condition(text: &mut String, is_first: bool) {
    let kinds = Section::kinds("boundary.NAME").collect::<Vec<_>>().join(", ");
    if !is_first {
        let words = format!("{kinds}: the keys of each stand above");
        let _ = writeln!(text, "kind = \"?\"{}", comment(10, &words));
        return;
    }
    let _ = writeln!(text, "kind = \"?\"{}", comment(10, &kinds));
    for section in Section::all("boundary.NAME") {
        section.keys.iter().for_each(|key| line(text, section.kind, key, None));
    }
}

/// The header of a group, with its size.
fn head(text: &mut String, before: &str, header: &str, size: &str) {
    let width = before.len() + header.chars().count() + 2;
    let _ = writeln!(text, "\n{before}[{header}]{}", comment(width, size));
}

/// A table that a scene may have, as a comment.
fn example(text: &mut String, section: &Section) {
    let _ = writeln!(text, "# [{}]", section.header);
    if let Some(kind) = section.kind {
        let start = format!("# kind = \"{kind}\"");
        let _ = writeln!(text, "{start}{}", comment(start.chars().count(), section.about));
    }
    section.keys.iter().for_each(|key| line(text, None, key, None));
}

/// A key with a value, and of it the kind of its table, meaning, unit and default.
fn line(text: &mut String, kind: Option<&str>, key: &Key, value: Option<&str>) {
    let start = match value {
        Some(value) => format!("{} = {value}", key.name),
        None => format!("# {} = {}", key.name, key.sample()),
    };
    let kind = kind.map_or_else(String::new, |kind| format!("{kind}: "));
    let words = format!("{kind}{}", key.described());
    let _ = writeln!(text, "{start}{}", comment(start.chars().count(), &words));
}

fn comment(column: usize, words: &str) -> String {
    format!("{}# {words}", " ".repeat(COMMENT_AT.saturating_sub(column).max(2)))
}

/// Why a group gets no table of its own.
fn why_not(name: &str, is_inside: bool) -> &'static str {
    match name {
        _ if is_inside => "; edges of it lie inside the domain, where no condition acts",
        "default" => "; \"default\" stands for all that is left",
        number if number.parse::<u64>().is_ok() => {
            "; without a name in the mesh, or with a number for one"
        }
        _ => {
            "; a part of it lies in another group, too, or there are more groups than a scene may have"
        }
    }
}

fn counted(count: usize, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}

/// Six digits at most.
fn shown(size: f64) -> String {
    let rounded: f64 = format!("{size:.5e}").parse().unwrap_or(size);
    rounded.to_string()
}

fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

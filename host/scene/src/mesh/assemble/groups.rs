//! Physical groups: their members in order, and what they are called.

use super::draft::{Draft, Element, Parsed};
use crate::error::InputError;

/// Refuses elements that are in more groups together than the file has bytes: a few lines may put many elements
/// into many groups, and memory shall stay bounded by the file.
pub(super) fn check_room<'a>(
    draft: &Draft,
    elements: impl Iterator<Item = &'a Element>,
) -> Parsed<()> {
    let (mut total, room) = (0, draft.length);
    for element in elements {
        total += draft.tags(element).len();
        if total > room {
            let message = format!(
                "up to {} the elements are listed in more than {room} physical groups together",
                element.title()
            );
            let hint = "give an entity one physical group, or a few";
            return Err(draft.error(element.at, message).hint(hint).into());
        }
    }
    Ok(())
}

/// The items of each group under its name, by ascending physical tag; items ascend and come once.
pub(super) fn collect<T: Ord + Copy>(
    draft: &Draft,
    dimension: u8,
    mut members: Vec<(i32, T)>,
) -> Parsed<Vec<(String, Vec<T>)>> {
    members.sort_unstable();
    members.dedup();
    let of_group = |members: &[(i32, T)]| {
        (name(draft, dimension, members[0].0), members.iter().map(|member| member.1).collect())
    };
    let groups: Vec<_> = members.chunk_by(|a, b| a.0 == b.0).map(of_group).collect();
    unambiguous(&groups, dimension)?;
    Ok(groups)
}

/// The name of a group, or its tag in decimal.
fn name(draft: &Draft, dimension: u8, group: i32) -> String {
    let name = draft.names.get(&(dimension, group));
    name.filter(|name| !name.is_empty()).cloned().unwrap_or_else(|| group.to_string())
}

/// A scene speaks of groups by name: two of the same name are an error.
fn unambiguous<T>(groups: &[(String, T)], dimension: u8) -> Parsed<()> {
    let mut names: Vec<_> = groups.iter().map(|(name, _)| name).collect();
    names.sort_unstable();
    let Some(pair) = names.windows(2).find(|pair| pair[0] == pair[1]) else { return Ok(()) };
    let kind = if dimension == 1 { "curves" } else { "surfaces" };
    let error = InputError::new(format!("two physical {kind} are called `{}`", pair[0]));
    Err(error.hint("give each a name of its own, or make them one").into())
}

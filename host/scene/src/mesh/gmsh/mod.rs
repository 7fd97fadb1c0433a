//! Gmsh meshes: MSH 2.0 to 2.2 and 4.1, ASCII and binary in either byte order.
//!
//! ```text
//! bytes ─► cursor ─► sections (format22, format41) ─► raw ─► [assemble](super::assemble) ─► Mesh
//! ```
//! The sections may come in any order after `$MeshFormat`; those of no interest are passed over.
//! [`mod@write`] makes a file of a mesh.

mod cursor;
mod format22;
mod format41;
mod raw;
#[cfg(test)]
mod tests;
pub mod write;

use self::cursor::{Cursor, Encoding};
use self::raw::Raw;
use super::Mesh;
use super::assemble::assemble;
use super::assemble::draft::Parsed;
use crate::error::InputError;

/// Whether a file is Gmsh's, of whatever version: a line opens `$MeshFormat`.
pub(super) fn is_gmsh(bytes: &[u8]) -> bool {
    bytes.split(|&byte| byte == b'\n').any(|line| line.trim_ascii() == b"$MeshFormat")
}

/// The mesh in the bytes of a file.
pub(super) fn parse(bytes: &[u8]) -> Parsed<Mesh> {
    let mut cursor = Cursor::new(bytes);
    let mut raw = Raw::default();
    let mut format = None;
    while let Some((at, name)) = cursor.open_section()? {
        let known = match (name, format) {
            (b"MeshFormat", None) => {
                let found = mesh_format(&mut cursor)?;
                raw.labels_are_physical = !matches!(found, Format::V41);
                format = Some(found);
                true
            }
            (b"MeshFormat", Some(_)) => return Err(repeated(&cursor, at, name)),
            (_, None) => false,
            (_, Some(format)) => section(&mut cursor, &mut raw, format, at, name)?,
        };
        if known { cursor.close_section(name)? } else { cursor.skip_section(at, name)? }
    }
    if format.is_none() {
        let error = InputError::new("expected a Gmsh mesh, found no `$MeshFormat`");
        return Err(error.hint("save as MSH 4.1 or 2.2").into());
    }
    let error = |at, message| cursor.error(at, message);
    assemble(&raw.draft(&cursor, &error)?)
}

/// The formats that are read.
#[derive(Clone, Copy)]
enum Format {
    /// 2.2, but that names of groups have no dimension.
    V20,
    /// 2.1 and 2.2.
    V22,
    V41,
}

/// Reads `$MeshFormat`: version, 1 if binary, 8 bytes a number; in binary then a 1 that shows the
/// byte order.
fn mesh_format(cursor: &mut Cursor) -> Parsed<Format> {
    cursor.skip_blank_lines();
    let at = cursor.at();
    let line = cursor.line().to_owned();
    let words: Vec<_> = line.split(|byte| byte.is_ascii_whitespace()).collect();
    let [version, binary, b"8"] = words[..] else {
        return Err(cursor.error(at, "expected a version, 0 or 1, and 8").into());
    };
    let format = match version {
        b"2" | b"2.0" => Format::V20,
        b"2.1" | b"2.2" => Format::V22,
        b"4.1" => Format::V41,
        other => {
            let start = &other[..other.len().min(16)];
            let message = format!("format {} is not read", start.escape_ascii());
            let hint = "save as MSH 4.1 or 2.2 (`Mesh.MshFileVersion = 4.1`)";
            return Err(cursor.error(at, message).hint(hint).into());
        }
    };
    match binary {
        b"0" => Ok(format),
        b"1" => byte_order(cursor).map(|()| format),
        _ => Err(cursor.error(at, "expected 0 (ASCII) or 1 (binary) after the version").into()),
    }
}

fn byte_order(cursor: &mut Cursor) -> Parsed<()> {
    let at = cursor.at();
    cursor.encoding = Encoding::LittleEndian;
    match cursor.int("the integer 1")? {
        1 => Ok(()),
        swapped if swapped.swap_bytes() == 1 => {
            cursor.encoding = Encoding::BigEndian;
            Ok(())
        }
        other => Err(cursor.error(at, format!("expected the integer 1, found {other}")).into()),
    }
}

/// Reads a section of interest; false if it is not.
fn section(
    cursor: &mut Cursor,
    raw: &mut Raw,
    format: Format,
    at: u32,
    name: &[u8],
) -> Parsed<bool> {
    let seen = match (name, format) {
        (b"PhysicalNames", _) => {
            let may_lack_dimension = matches!(format, Format::V20);
            raw.names.replace(raw::names(cursor, may_lack_dimension)?).is_some()
        }
        (b"Nodes", Format::V20 | Format::V22) => {
            raw.nodes.replace(format22::nodes(cursor)?).is_some()
        }
        (b"Elements", Format::V20 | Format::V22) => {
            raw.elements.replace(format22::elements(cursor)?).is_some()
        }
        (b"Entities", Format::V41) => raw.entities.replace(format41::entities(cursor)?).is_some(),
        (b"Nodes", Format::V41) => raw.nodes.replace(format41::nodes(cursor)?).is_some(),
        (b"Elements", Format::V41) => raw.elements.replace(format41::elements(cursor)?).is_some(),
        (b"PartitionedEntities", Format::V41) => {
            let error = cursor.error(at, "the mesh is partitioned, expected it in one piece");
            return Err(error.hint("save it before partitioning, or `Unpartition` it").into());
        }
        _ => return Ok(false),
    };
    if seen { Err(repeated(cursor, at, name)) } else { Ok(true) }
}

fn repeated(cursor: &Cursor, at: u32, name: &[u8]) -> Box<InputError> {
    cursor.error(at, format!("a second section ${}", name.escape_ascii())).into()
}

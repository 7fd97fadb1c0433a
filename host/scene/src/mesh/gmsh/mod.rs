//! Gmsh meshes: MSH 2.2 and 4.1, ASCII and binary in either byte order.
//!
//! ```text
//! bytes ─► cursor ─► sections (format22, format41, names) ─► raw ─► build, cells, groups ─► Mesh
//! ```
//! The sections may come in any order after `$MeshFormat`; those of no interest are passed over.
//! Points are ignored, lines matter in a physical curve only, vertices without a cell are dropped,
//! clockwise cells are turned round. A cell listed once for each of its physical surfaces is one
//! cell; listed twice for the same one it is an error. [`mod@write`] makes a file of a mesh.

mod build;
mod cells;
mod cursor;
mod foreign;
mod format22;
mod format41;
mod groups;
mod index;
mod names;
mod raw;
#[cfg(test)]
mod tests;
pub mod write;

use std::io::Read;
use std::path::Path;

use self::cursor::{Cursor, Encoding, Parsed};
use self::raw::Raw;
use super::Mesh;
use crate::error::{InputError, Result};

/// The largest file that is read: 2 GiB.
const SIZE_LIMIT: u64 = 1 << 31;

/// Reads a mesh; every error names the file and, as the file numbers them, what is wrong in it.
pub fn read(path: &Path) -> Result<Mesh> {
    let bytes = load(path).map_err(|error| error.file(path))?;
    Ok(parse(&bytes).map_err(|error| error.file(path))?)
}

fn load(path: &Path) -> Parsed<Vec<u8>> {
    let unreadable = |error: std::io::Error| {
        Box::new(InputError::new(format!("the mesh cannot be read: {error}")))
    };
    let metadata = std::fs::metadata(path).map_err(unreadable)?;
    if !metadata.is_file() {
        return Err(InputError::new("expected a mesh, found something that is no file").into());
    }
    let mut bytes = Vec::new();
    let file = std::fs::File::open(path).map_err(unreadable)?;
    file.take(SIZE_LIMIT).read_to_end(&mut bytes).map_err(unreadable)?;
    if bytes.len() as u64 == SIZE_LIMIT {
        return Err(InputError::new("the mesh has 2 GiB or more, expected less").into());
    }
    Ok(bytes)
}

/// The mesh in the bytes of a file.
///
/// # Errors
/// As for [`read`], without the name of a file.
pub fn parse(bytes: &[u8]) -> std::result::Result<Mesh, Box<InputError>> {
    if let Some(error) = foreign::refused(bytes) {
        return Err(error.into());
    }
    let mut cursor = Cursor::new(bytes);
    let mut raw = Raw::default();
    let mut format = None;
    while let Some((at, name)) = cursor.open_section()? {
        let known = match (name, format) {
            (b"MeshFormat", None) => {
                let found = mesh_format(&mut cursor)?;
                raw.labels_are_physical = matches!(found, Format::V22);
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
        return Err(error.hint("save as MSH 2.2 or 4.1").into());
    }
    build::build(&cursor, &raw)
}

/// The formats that are read.
#[derive(Clone, Copy)]
enum Format {
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
        b"2.2" => Format::V22,
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
        (b"PhysicalNames", _) => raw.names.replace(names::names(cursor)?).is_some(),
        (b"Nodes", Format::V22) => raw.nodes.replace(format22::nodes(cursor)?).is_some(),
        (b"Elements", Format::V22) => raw.elements.replace(format22::elements(cursor)?).is_some(),
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

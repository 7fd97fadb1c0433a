//! A mesh file of any format that is read: one that is told by its content.
//!
//! A format is a module that tells its own bytes and makes a draft of them, which it lets [`assemble`](super::assemble) check; it
//! has its branch in [`parse`]. Bytes of no format are named as what they are ([`foreign`]).

use std::io::Read;
use std::path::Path;

use super::assemble::draft::Parsed;
use super::{Mesh, foreign, gmsh};
use crate::error::{InputError, Result};

/// The largest file that is read: 2 GiB.
const SIZE_LIMIT: u64 = 1 << 31;

/// The mark that some editors put before a text in UTF-8.
const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// Reads a mesh; every error names the file and, as the file numbers them, what is wrong in it.
///
/// # Errors
/// A file that cannot be read, or is no mesh that [`super::Mesh`] can hold.
pub fn read(path: &Path) -> Result<Mesh> {
    let bytes = load(path).map_err(|error| error.file(path))?;
    Ok(parse(&bytes).map_err(|error| error.file(path))?)
}

/// The mesh in the bytes of a file.
///
/// # Errors
/// Those of [`read`], without the name of a file.
pub fn parse(bytes: &[u8]) -> std::result::Result<Mesh, Box<InputError>> {
    let bytes = bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes);
    if gmsh::is_gmsh(bytes) { gmsh::parse(bytes) } else { Err(foreign::refused(bytes).into()) }
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

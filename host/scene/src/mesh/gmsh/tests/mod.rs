//! The reader against files written by Gmsh, by a small encoder, and by an enemy.

mod encode;
mod hostile;
mod real;
mod rejected;
mod valid;
mod written;

use crate::mesh::{Mesh, parse};

/// The error of a file that must be refused: what a user reads, without the name of the file.
fn error(bytes: &[u8]) -> String {
    let error = parse(bytes).expect_err("the file should be refused");
    let named = error.file(std::path::Path::new("m.msh"));
    let text = named.to_string();
    text.strip_prefix("m.msh:").expect("the file is named").trim_start().to_owned()
}

fn mesh(bytes: &[u8]) -> Mesh {
    parse(bytes).unwrap_or_else(|error| panic!("refused: {error}"))
}

//! The tests of the public solver as one program: `cargo test -p signorini-solve --test main NAME`.

mod inside;
mod meshes;

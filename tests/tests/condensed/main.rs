//! The condensed model on the target's arithmetic, from a scene's text to outputs and bound, against the
//! full model.

mod bound;
mod equality;
mod extremes;
#[path = "../bound/mesh.rs"]
#[expect(dead_code, reason = "cut and relisted meshes are for the bound of the full model")]
mod mesh;
mod ranges;
mod scenes;

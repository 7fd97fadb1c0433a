//! Scenes, meshes, the reference solver and the report around `signorini-kernel`.

pub mod error;
pub mod expression;
pub mod mesh;
pub mod scene;

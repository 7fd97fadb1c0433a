//! Scenes, meshes, the reference solver and the report around `signorini-kernel`.

pub mod bake;
pub mod certify;
pub mod cli;
pub mod condense;
pub mod cycles;
pub mod error;
pub mod export;
pub mod expression;
pub mod field;
pub mod functional;
pub mod mesh;
pub mod norms;
pub mod output;
pub mod outputs;
pub mod problem;
pub mod progress;
pub mod quadrature;
pub mod reference;
pub mod report;
pub mod scalar;
pub mod scene;
pub mod setting;
pub mod solve;
pub mod study;
pub mod tick;
pub mod trade;

//! Files that other programs read: written whole or not at all.

pub mod answer;
pub mod atomic;
pub mod contact;
pub mod digits;
pub mod edges;
pub mod fields;
pub mod panel;
pub mod pvd;
pub mod stated;
pub mod summary;
pub mod vtu;

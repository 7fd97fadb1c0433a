//! A scene as it was drawn, before its setting.

use signorini_scene::mesh::Mesh;

/// The condition that holds its parts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Hold {
    /// Given values somewhere.
    Dirichlet,
    /// A transfer law somewhere, no given values.
    Robin,
    /// Contact alone.
    Contact,
}

/// A scene without its setting.
pub(super) struct Posed {
    pub(super) scene: String,
    pub(super) mesh: Mesh,
    pub(super) hold: Hold,
    /// Default values of the inputs.
    pub(super) inputs: Vec<f64>,
}

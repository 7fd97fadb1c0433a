//! A scene as it was drawn, before its setting, and which ends the flux of its contact has.

use serde::{Deserialize, Serialize};

use signorini_problem::random::Random;
use signorini_scene::Mesh;

/// The condition that holds its parts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Hold {
    /// Given values somewhere.
    #[default]
    Dirichlet,
    /// A transfer law somewhere, no given values.
    Robin,
    #[serde(rename = "contact alone")]
    Contact,
}

/// A scene without its setting.
pub(super) struct Posed {
    pub(super) scene: String,
    pub(super) mesh: Mesh,
    pub(super) hold: Hold,
    pub(super) inputs: Vec<f64>,
}

/// Which ends a contact boundary has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ends {
    /// A lower one alone: u ≥ ψ.
    Above,
    /// An upper one alone: u ≤ ψ.
    Below,
    /// Both: u on either side of ψ.
    Both,
}

impl Ends {
    pub(super) fn draw(random: &mut Random) -> Self {
        random.pick(&[Self::Above, Self::Above, Self::Below, Self::Both, Self::Both])
    }
}

/// The tensor with the eigenvalues p, along an angle, and q across it, as its entries xx, xy and yy.
pub(super) fn turned([p, q]: [f64; 2], (sin, cos): (f64, f64)) -> [f64; 3] {
    [p * cos * cos + q * sin * sin, (p - q) * sin * cos, p * sin * sin + q * cos * cos]
}

/// hi − lo over the size of the flux: none, one that rounding swallows, near ones, far ones.
pub(super) fn span(random: &mut Random) -> f64 {
    match random.below(12) {
        0 => 0.0,
        1 => random.log(1e-17, 1e-6),
        2 => random.log(1e2, 1e8),
        3 => random.log(1e8, 1e30),
        _ => random.log(0.01, 30.0),
    }
}

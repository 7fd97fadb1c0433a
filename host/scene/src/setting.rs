//! A setting: what trades speed for accuracy, as the `[setting]` of a scene states it.
//!
//! Keys, meanings and defaults stand in the list of [`crate::scene::keys`]. `sweeps` of a condensed model are in the place of the exact
//! method. A factor is worked out on the host; where nothing is stated, `bake` takes the quicker solver.
//! `refine` and `error` exclude each other, so do `sweeps` and `share`, and a factor excludes both. Without `model`, a key that means something to
//! the full one alone asks for that, and so does `solver = "sweeps"`; `solver = "exact"` and `memory` ask for the condensed one. The
//! bound is left out where `certificate = false` says so, and nowhere else. The file reads them in [`crate::scene`].

use crate::goal::Goal;
use serde::{Deserialize, Serialize};
use signorini_kernel::element::QuadElement;

/// How a scene is discretised, solved and certified.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Setting {
    /// Uniform refinements of the scene's mesh.
    pub refine: u32,
    /// The greatest error bound that is wanted: the mesh is refined where the bound says. Excludes `refine`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error: Option<Goal>,
    /// The cells that the mesh is brought to before it is refined; `None` leaves them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cells: Option<CellKind>,
    /// The element on quads.
    #[serde(with = "Element", skip_serializing_if = "is_usual")]
    pub element: QuadElement,
    /// Number format; `None` leaves it to the command.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scalar: Option<Precision>,
    /// Square root of the search for ω.
    pub math: MathKind,
    /// Full or condensed; `None` leaves it to the command.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub model: Option<ModelKind>,
    /// The solver of the model; `None`, in the file `auto`, leaves it to the command.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub solver: Option<Method>,
    /// The start of a tick.
    pub start: Start,
    /// Relaxation factor.
    pub omega: Omega,
    /// Number of sweeps; `None`: as many as `share` asks for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sweeps: Option<u32>,
    /// Share of the error bound that is left to sweeps, in (0, 1).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub share: Option<f64>,
    /// Whether the error bound is computed.
    pub certificate: bool,
    /// States of a condensed model that steps in time, at most.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub memory: Option<u32>,
}

impl Default for Setting {
    fn default() -> Self {
        Self {
            refine: 0,
            error: None,
            cells: None,
            element: QuadElement::Parametric,
            scalar: None,
            math: MathKind::Libm,
            model: None,
            solver: None,
            start: Start::Warm,
            omega: Omega::Auto,
            sweeps: None,
            share: None,
            certificate: true,
            memory: None,
        }
    }
}

impl Setting {
    /// The model: as stated, or the one that the solver or another key has a meaning for.
    pub fn model_kind(&self) -> Option<ModelKind> {
        let of_solver = self.solver.map(|solver| match solver {
            Method::Exact => ModelKind::Condensed,
            Method::Sweeps | Method::Factor => ModelKind::Full,
        });
        let of_memory = self.memory.map(|_| ModelKind::Condensed);
        self.model.or(of_solver).or(of_memory).or(self.of_full_alone().map(|_| ModelKind::Full))
    }

    /// A key that is set, and means nothing to this model.
    pub fn foreign_to(&self, model: ModelKind) -> Option<&'static str> {
        match model {
            ModelKind::Condensed => self.of_full_alone(),
            ModelKind::Full => first([
                ("solver", self.solver == Some(Method::Exact)),
                ("memory", self.memory.is_some()),
            ]),
        }
    }

    /// The keys that are set and say how to solve, in which scalar apart.
    pub fn of_method(&self) -> Vec<&'static str> {
        let keys = [
            ("math", self.math == MathKind::Micromath),
            ("model", self.model.is_some()),
            ("solver", self.solver.is_some()),
            ("start", self.start == Start::Cold),
            ("omega", matches!(self.omega, Omega::Fixed(_))),
            ("sweeps", self.sweeps.is_some()),
            ("share", self.share.is_some()),
            ("certificate", !self.certificate),
            ("memory", self.memory.is_some()),
        ];
        keys.into_iter().filter(|(_, is_set)| *is_set).map(|(key, _)| key).collect()
    }

    /// A key that is set, and means nothing to the condensed model.
    fn of_full_alone(&self) -> Option<&'static str> {
        first([
            ("solver", self.solver == Some(Method::Factor)),
            ("share", self.share.is_some()),
            ("omega", matches!(self.omega, Omega::Fixed(_))),
            ("start", self.start == Start::Cold),
            ("math", self.math == MathKind::Micromath),
        ])
    }
}

/// The first key that is set.
fn first<const N: usize>(keys: [(&'static str, bool); N]) -> Option<&'static str> {
    keys.into_iter().find_map(|(key, is_set)| is_set.then_some(key))
}

/// Cells with three or four sides.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum CellKind {
    /// Quads are cut along their shorter diagonal.
    Triangles,
    /// Triangles are paired into convex quads; those that find no partner stay.
    Quads,
}

/// [`QuadElement`] as text.
#[derive(Serialize, Deserialize)]
#[serde(remote = "QuadElement", rename_all = "lowercase")]
enum Element {
    Parametric,
    Nonparametric,
}

/// Settings that were recorded before there was a choice do not change.
fn is_usual(element: &QuadElement) -> bool {
    *element == QuadElement::default()
}

/// The number format of a solve.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Precision {
    /// Double precision.
    #[serde(rename = "f64")]
    F64,
    /// Single precision.
    #[serde(rename = "f32")]
    F32,
    /// Sweeps in f32 on residuals in f64.
    #[serde(rename = "f32+f64")]
    Mixed,
}

/// Who takes square roots.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum MathKind {
    /// Correctly rounded.
    Libm,
    /// Off by up to 6 %, in f32 only.
    Micromath,
}

/// The model that is solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ModelKind {
    /// The scene's mesh.
    Full,
    /// Contact edges, inputs and outputs alone.
    Condensed,
}

/// The solver of a model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Method {
    /// Projected SOR.
    Sweeps,
    /// Of a full model: a sparse factor, and exchanges on the contact edges.
    Factor,
    /// Of a condensed model: exchanges, which end with the exact solution.
    Exact,
}

/// The start of a tick.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Start {
    /// Nothing.
    Cold,
    /// The tick before.
    Warm,
}

/// The relaxation factor.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Omega {
    /// Found while sweeping.
    Auto,
    /// This one, inside (0, 2).
    #[serde(untagged)]
    Fixed(f64),
}

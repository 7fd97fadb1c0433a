//! A scene: what is solved on a mesh, as its TOML file states it.
//!
//! −∇·(A∇u) = f in Ω, and on the boundary, with the outward normal n and σ·n = (A∇u)·n,
//!
//! | kind | condition |
//! |---|---|
//! | dirichlet | u = value |
//! | neumann | σ·n = flux |
//! | robin | σ·n = coefficient (ambient − u) |
//! | contact | u ≥ gap, σ·n ≥ flux, (u − gap)(σ·n − flux) = 0; with a limit, u may fall below the gap where σ·n = limit |
//!
//! text ─► `table`, `entry` (TOML with places) ─► `read`, `boundary`, `material`, `control`, `output`, `setting` (sections
//! into the model below); a fragment gives a scene another setting. Every part of the model knows where it stands, so
//! that whoever finds it wrong later, on the mesh or at a quadrature point, can still point at the line
//! ([`Scene::error`]).
//! The names are not compared with the mesh here.

mod blank;
mod boundary;
mod control;
mod document;
mod draft;
mod entry;
mod exclusions;
pub mod keys;
mod material;
mod output;
mod range;
mod read;
pub mod schema;
mod setting;
mod table;
pub mod term;
#[cfg(test)]
mod tests;
pub mod units;

use std::fmt::Display;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

pub use blank::blank;
pub use draft::Draft;
pub use material::Material;

use crate::error::InputError;
use crate::expression::Expression;
use crate::setting::Setting;

/// Something read from the scene file, with its place in it.
#[derive(Debug, Clone, PartialEq)]
pub struct Located<T> {
    /// The value that was read.
    pub value: T,
    /// The key with its tables: `boundary.river.value`.
    pub key: String,
    /// The bytes of the file it stands in; for a default, the header of its table.
    pub span: Range<usize>,
}

/// A datum of the scene: a number or an expression.
pub type Datum = Located<Expression>;

/// A group by its name, with what is known of it: nothing, where that could not be read.
type Named<T> = (Located<String>, Option<T>);

/// A scene file, read and checked as far as possible without its mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// The scene file.
    pub path: PathBuf,
    /// Its text.
    pub text: Arc<str>,
    /// Its title; without one, the name of the file.
    pub title: String,
    /// The mesh file, relative to where the program runs.
    pub mesh: Located<PathBuf>,
    /// The materials in the order of the file; at least one.
    pub materials: Vec<Material>,
    /// The load f in x, y, t; 0 by default.
    pub source: Datum,
    /// The boundary parts in the order of the file; at least one.
    pub boundaries: Vec<Boundary>,
    /// Loads that change at run time.
    pub inputs: Vec<Input>,
    /// The numbers that the controller reads; if empty, contact force and length.
    pub outputs: Vec<Output>,
    /// The budget of the device.
    pub target: Option<Target>,
    /// The ticks.
    pub time: Option<Time>,
    /// The exact solution.
    pub exact: Option<Exact>,
    /// How to solve it; `None` leaves everything to the command.
    pub setting: Option<Setting>,
    /// The file that extends the scene, if one does: title and setting stand there.
    pub fragment: Option<PathBuf>,
}

/// The condition on one physical curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Boundary {
    /// The curve; `default` covers the edges that no other boundary names.
    pub name: Located<String>,
    /// The condition there.
    pub condition: Condition,
}

/// A boundary condition; its data in x, y, t, except the Robin coefficient in x, y.
#[derive(Debug, Clone, PartialEq)]
pub enum Condition {
    /// u = value.
    Dirichlet {
        /// The value u_D.
        value: Datum,
    },
    /// σ·n = flux.
    Neumann {
        /// The outward flux g.
        flux: Datum,
    },
    /// σ·n = coefficient (ambient − u).
    Robin {
        /// The coefficient, ≥ 0; a constant one has been checked.
        coefficient: Datum,
        /// The value that u relaxes to.
        ambient: Datum,
    },
    /// flux ≤ σ·n ≤ limit; σ·n = flux where u > gap, σ·n = limit where u < gap.
    Contact {
        /// The gap function ψ; 0 by default.
        gap: Datum,
        /// The flux q without contact; 0 by default. −∞ where u ≤ gap.
        flux: Datum,
        /// The most that the flux can be; ∞ by default, where u ≥ gap.
        limit: Datum,
    },
}

/// The datum that an input adds to: a load, or a coefficient.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Field {
    /// The flux of a Neumann or contact boundary.
    Flux,
    /// The limit of a contact boundary's flux.
    Limit,
    /// The value of a Dirichlet boundary.
    Value,
    /// The gap of a contact boundary.
    Gap,
    /// The ambient of a Robin boundary.
    Ambient,
    /// The transfer coefficient of a Robin boundary: it stands in the matrix too.
    Coefficient,
    /// The load f.
    Source,
}

/// A load or coefficient that changes at run time: its value times the pattern is added to the field.
#[derive(Debug, Clone, PartialEq)]
pub struct Input {
    /// Its name.
    pub name: Located<String>,
    /// The boundary it acts on; `source` if the field is [`Field::Source`], and only then.
    pub of: Located<String>,
    /// The field it acts on; the boundary has it.
    pub field: Located<Field>,
    /// The pattern that its value multiplies, in x, y.
    pub pattern: Datum,
    /// Its value unless something else is set.
    pub default: f64,
    /// The least and the largest value that it may have; anything, where the scene does not say.
    pub range: Option<Located<[f64; 2]>>,
    /// The unit that its value is shown with.
    pub unit: Option<String>,
}

/// The quantity of an output.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Quantity {
    /// ∫ τ·n over a boundary: σ = A∇u, on contact edges within their law wherever the solver was stopped.
    Flux,
    /// ∫ (τ·n − q) ≥ 0 over a contact boundary, or over all of them.
    Force,
    /// The length of the active edges of a contact boundary, or of all of them.
    Length,
    /// The length of the edges whose flux is at its limit, u < gap, of a contact boundary, or of all of them.
    Saturated,
    /// u at a point.
    Probe {
        /// The point.
        at: [f64; 2],
    },
    /// The mean of u over a boundary.
    Mean,
    /// The mean of u over a material.
    MeanInside,
    /// ∫ c u over materials, or over the domain: c is the capacity, taken at its mean over each cell.
    Content,
    /// The error bound: in a step of time that of the step.
    Bound,
    /// The bound over time.
    Window,
}

/// A number that the controller reads.
#[derive(Debug, Clone, PartialEq)]
pub struct Output {
    /// Its name.
    pub name: Located<String>,
    /// The quantity that it measures.
    pub quantity: Quantity,
    /// Its boundaries, whose parts of it are summed: at least one for a flux, one for a mean; for force and length contact
    /// boundaries or, where there are none, all of them. Of a content its materials, or none for all of them; of a mean inside one
    /// material; otherwise none.
    pub of: Vec<Located<String>>,
    /// The unit that its value is shown with.
    pub unit: Option<String>,
}

/// The budget of the device, as far as the scene sets one; each positive.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Target {
    /// Memory in bytes.
    pub ram: Option<u64>,
    /// Read-only memory in bytes.
    pub flash: Option<u64>,
    /// The time of one tick in seconds.
    pub tick: Option<f64>,
    /// The clock in hertz.
    pub clock: Option<f64>,
}

/// The ticks: 0 < step ≤ end.
#[derive(Debug, Clone, PartialEq)]
pub struct Time {
    /// From tick to tick, in seconds.
    pub step: f64,
    /// The time of the last tick, in seconds, where the scene says it.
    pub end: Option<f64>,
    /// u at the start, in x and y; where there is none, the steady solution at the inputs' defaults.
    pub initial: Option<Datum>,
}

/// The exact solution in x, y, t.
#[derive(Debug, Clone, PartialEq)]
pub struct Exact {
    /// u.
    pub u: Datum,
    /// ∂u/∂x, ∂u/∂y.
    pub gradient: [Datum; 2],
}

impl Scene {
    /// Whether a material stores u, so that ticks are steps in time.
    pub fn stores(&self) -> bool {
        self.materials.iter().any(Material::stores)
    }

    /// The length of a step in time, where ticks are such.
    pub fn step(&self) -> Option<f64> {
        self.time.as_ref().filter(|_| self.stores()).map(|time| time.step)
    }

    /// Gives ticks another length.
    pub fn set_step(&mut self, step: f64) {
        let (end, initial) = self.time.take().map_or((None, None), |time| (time.end, time.initial));
        self.time = Some(Time { step, end, initial });
    }

    /// The file to be named for it: the fragment, if one extends the scene.
    pub fn file(&self) -> &Path {
        self.fragment.as_ref().unwrap_or(&self.path)
    }

    /// The error that `at` is wrong: `FILE:LINE: KEY: message`, with its place underlined.
    pub fn error<T>(&self, at: &Located<T>, message: impl Display) -> InputError {
        at.error(&self.path, &self.text, message)
    }
}

impl<T> Located<T> {
    fn error(&self, path: &Path, text: &Arc<str>, message: impl Display) -> InputError {
        InputError::new(format!("{}: {message}", self.key))
            .file(path)
            .excerpt(text, self.span.clone())
    }

    /// Another value at the same place.
    fn with<U>(&self, value: U) -> Located<U> {
        Located { value, key: self.key.clone(), span: self.span.clone() }
    }
}

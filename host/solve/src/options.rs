//! Options of a solve.

use clap::ValueEnum;
use serde::{Deserialize, Serialize};
use signorini_kernel::relaxation::Relaxation;
use signorini_kernel::solver::Settings;

use signorini_problem::scalar::Scalar;

/// The scalar type of the kernel.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ScalarKind {
    /// Double precision.
    #[default]
    F64,
    /// Single precision, the microcontroller's.
    F32,
}

impl ScalarKind {
    /// The kind of a scalar.
    pub(super) fn of<R: Scalar>() -> Self {
        if R::NAME == f64::NAME { Self::F64 } else { Self::F32 }
    }

    /// The nearest number of this type.
    pub fn round(self, x: f64) -> f64 {
        match self {
            Self::F64 => x,
            Self::F32 => f64::from(x as f32),
        }
    }

    /// The gap between 1 and the next number.
    pub fn epsilon(self) -> f64 {
        match self {
            Self::F64 => f64::EPSILON,
            Self::F32 => f64::from(f32::EPSILON),
        }
    }
}

/// Who solves.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum SolverKind {
    /// Choice by the size of the problem: sweeps on a small mesh, a factor or multigrid on a large one.
    #[default]
    Auto,
    /// The kernel's projected SOR, and its factor where that does not end.
    Kernel,
    /// The kernel's factor, and its sweeps where that has no answer: for many solves on one mesh, where what sweeps would take is
    /// not known.
    #[value(skip)]
    Factor,
    /// The host's active set on one sparse Cholesky factorisation (f64).
    Direct,
    /// The host's active set by conjugate gradients and multigrid, in cost that grows with the unknowns alone; a solver with a factor
    /// where that does not converge.
    Multigrid,
}

/// Most sweeps where nobody says how many.
pub const MOST_SWEEPS: u32 = 1_000_000;

/// Options of a solve.
#[derive(Debug, Clone, Copy)]
pub struct Options {
    /// Scalar type.
    pub scalar: ScalarKind,
    /// Solver; the default is the kernel, which is what a device has.
    pub solver: SolverKind,
    /// Bound on the scaled complementarity residual; `None`: the default of the scalar type.
    pub tolerance: Option<f64>,
    /// Whether to go on until rounding ends it, whatever the tolerance.
    pub to_the_floor: bool,
    /// Most sweeps allowed, where there are sweeps; `None`: a million, and a factor at once where more sweeps are expected than it
    /// takes.
    pub max_sweeps: Option<u32>,
    /// Whether s is the average of u_h, as a board has it, even where a better one is worth a few sweeps over the vertices.
    pub averages: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            scalar: ScalarKind::F64,
            solver: SolverKind::Kernel,
            tolerance: None,
            to_the_floor: false,
            max_sweeps: None,
            averages: false,
        }
    }
}

impl Options {
    /// The default with another solver.
    pub fn by(solver: SolverKind) -> Self {
        Self { solver, ..Self::default() }
    }

    /// Corrections of the defect at most: each gains about as many digits as the scalar leaves. In
    /// f64 the rounding limit itself is accurate enough, unless the floor is asked for.
    pub(super) fn rounds(&self) -> u32 {
        if self.scalar == ScalarKind::F32 || self.to_the_floor { 6 } else { 0 }
    }

    /// The kernel's settings. The default in f64 bounds the residual by 1e−13, two digits below the
    /// 1e−11 that is promised, so that fluxes too agree to 1e−6 where A jumps by 10⁴, and the error
    /// that may hide behind it by 1e−10. The default in f32 is the last digit of u.
    pub fn settings<R: Scalar>(&self) -> Settings<R> {
        let (tolerance, accuracy) = match (self.tolerance, self.scalar) {
            _ if self.to_the_floor => (0.0, R::EPSILON.wide()),
            (Some(tolerance), _) => (tolerance, f64::INFINITY),
            (None, ScalarKind::F64) => (1e-13, 1e-10),
            (None, ScalarKind::F32) => (0.0, f64::from(f32::EPSILON)),
        };
        Settings {
            relaxation: Relaxation::Adaptive(R::ONE),
            tolerance: R::narrow(tolerance),
            accuracy: R::narrow(accuracy),
            scale: R::ZERO,
            max_sweeps: self.max_sweeps.unwrap_or(MOST_SWEEPS),
        }
    }
}

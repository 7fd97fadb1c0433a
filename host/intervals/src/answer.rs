//! Answers that intervals are worked out from, and the interval of an output.

use serde::Serialize;
use signorini_certify::deviation::Deviations;
use signorini_certify::{CertifiedFields, ErrorBound};
use signorini_problem::Problem;
use signorini_scene::scene::Quantity;
use signorini_scene::scene::units::Units;
use signorini_solve::{ScalarKind, Solution};

/// An answer of a solve or a tick.
#[derive(Debug, Clone, Copy)]
pub struct Answered<'a> {
    /// s and τ.
    pub certified: &'a CertifiedFields,
    /// How wrong they may be.
    pub bound: Option<ErrorBound>,
    /// The scalar that they were worked out in.
    pub scalar: ScalarKind,
}

impl<'a> From<&'a Solution> for Answered<'a> {
    fn from(Solution { certified, bound, scalar, .. }: &'a Solution) -> Self {
        Self { certified, bound: *bound, scalar: *scalar }
    }
}

/// An answer of a problem, and the data that its s follows.
#[derive(Clone, Copy)]
pub(super) struct OnMesh<'a> {
    pub problem: &'a Problem,
    pub answer: Answered<'a>,
    pub deviations: &'a Deviations<'a>,
}

/// Where the value of an output lies for the exact solution.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OutputBound {
    /// Its middle, in the unit of the output.
    pub center: f64,
    /// Half of its width: the exact value is not farther from the middle.
    pub plus_minus: f64,
    /// Words for the quantity.
    pub of: String,
    /// How far its value on this mesh is from that on the mesh refined once; no guarantee. None for large meshes.
    pub estimate: Option<f64>,
    /// The exact value, where the scene has an exact solution.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub exact: Option<f64>,
    /// By how much its quadrature is in doubt.
    #[serde(skip)]
    pub doubt: f64,
}

impl OutputBound {
    /// Its ends.
    pub fn ends(&self) -> [f64; 2] {
        [self.center - self.plus_minus, self.center + self.plus_minus]
    }

    /// From `units` to those of the scene.
    /// The output is `of_one` for u = 1.
    pub(super) fn in_scene(self, units: &Units, of: Quantity, of_one: f64) -> Self {
        let value = |x: f64| units.output(of, [x, of_one]);
        self.mapped(value, units.of_output(of), zero_rounding(units, of))
    }

    /// So many times the output.
    pub(super) fn times(self, by: f64) -> Self {
        self.mapped(|x| by * x, by, SUMMED)
    }

    /// With other values, differences so many times these, and a part of the middle that is rounded.
    fn mapped(self, value: impl Fn(f64) -> f64, by: f64, rounding: f64) -> Self {
        let Self { center, plus_minus, estimate, exact, doubt, of } = self;
        let (center, exact) = (value(center), exact.map(value));
        let plus_minus = by * plus_minus + rounding * center.abs();
        Self {
            center,
            plus_minus,
            of,
            estimate: estimate.map(|x| by * x),
            exact,
            doubt: by * doubt,
        }
    }
}

/// Roundings of a sum over cells, next to its terms.
const SUMMED: f64 = 512.0 * f64::EPSILON;

/// What another zero of u rounds of an output, as a part of it: of a content, ∫c is a sum.
pub fn zero_rounding(units: &Units, of: Quantity) -> f64 {
    match of {
        _ if units.zero == 0.0 => 0.0,
        Quantity::Content => SUMMED,
        _ => f64::EPSILON,
    }
}

/// An interval, or why there is none.
pub type Found = Result<OutputBound, String>;

//! A scene as it was baked, as programs read it: `signorini bake --json`.

use serde::{Deserialize, Serialize};

/// The model that was chosen, and what is said of it before it is built.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Chosen {
    /// `full` or `condensed`.
    pub model: String,
    /// `f32` or `f64`.
    pub scalar: String,
    /// Features of the kernel that the module needs.
    pub kernel_features: Vec<String>,
    /// Bytes of RAM: the controller, and the stack of images of its kind.
    pub ram_bytes: u64,
    /// Bytes of flash: data, and the code of images of its kind.
    pub flash_bytes: u64,
    /// Instructions of the median tick of a trial; none where its parts were not counted in this scalar.
    pub instructions: Option<f64>,
    /// The sides of its contact edges; none of a full model, or where inputs have no range.
    pub ranges: Option<Ranges>,
    /// The worst case, which no tick exceeds.
    pub worst_case: WorstCase,
    /// The length of a step, of a model that steps in time.
    #[serde(default)]
    pub step: Option<f64>,
    /// States of a condensed model that steps in time; 0 of others.
    #[serde(default)]
    pub memory: u32,
    /// The slowest and the fastest time constant with open contact, of a model that steps in time: the one guaranteed and none where
    /// contact alone holds a part, the other an estimate.
    #[serde(default)]
    pub time_constants: Option<[Option<f64>; 2]>,
    /// The meaning of each output.
    #[serde(default)]
    pub outputs: Vec<String>,
    /// Why an output has no interval; none where it has one.
    #[serde(default)]
    pub without_interval: Vec<Option<String>>,
}

/// The most that a tick takes, whatever the inputs are within their ranges, and whatever state it begins in.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct WorstCase {
    /// Exchanges: of a method that is not proved to end, those at which it is cut off; none where it has none.
    pub exchanges: Option<u32>,
    /// Instructions on a Cortex-M4F, from counted stages; none where nothing is proved, or where they depend on operands.
    pub instructions: Option<u64>,
    /// Whether the tick ends with the solution in so many: by the signs of the matrix, and every input has a range; of steps in time
    /// unless it is refused, whatever the ranges.
    pub proven: bool,
}

/// Contact edges by what they do for all inputs within their ranges, in time in every exact step on the mesh, and how large the error
/// bound is, as far as is proved.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Ranges {
    /// The contact edges of the scene.
    pub contact: usize,
    /// Contact edges that are open for all inputs.
    pub always_open: usize,
    /// Contact edges that touch for all inputs.
    pub always_touching: usize,
    /// Contact edges whose flux is at its limit for all inputs.
    #[serde(default)]
    pub always_saturated: usize,
    /// The others.
    pub may_change: usize,
    /// No exact solution has a larger error bound; none where no such limit is proved near what inputs reach.
    pub largest_error_bound: Option<f64>,
}

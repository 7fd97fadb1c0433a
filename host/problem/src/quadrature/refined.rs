//! Parts of regions, cut where most is missed: the worst one first, until it is enough or too many.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use signorini_scene::expression::enclosure::Region;

/// A part of a region, an integral over it and what it may be off by.
#[derive(Debug, Clone, Copy)]
pub struct Part {
    /// The cell that it is a part of.
    pub of: usize,
    /// Where it is.
    pub region: Region,
    /// The integral.
    pub value: f64,
    /// No more is missed of it.
    pub missed: f64,
}

impl PartialEq for Part {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Part {}

impl PartialOrd for Part {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// The worst is the greatest, of those that miss as much the largest: no pole keeps others from being cut.
impl Ord for Part {
    fn cmp(&self, other: &Self) -> Ordering {
        let by_size = || self.region.measure().total_cmp(&other.region.measure());
        self.missed.total_cmp(&other.missed).then_with(by_size)
    }
}

/// Cuts after which sums are taken anew: what is missed may be infinite at first, and differences round.
const ROUND: usize = 32;

/// Part of the largest region in which a pole is enough enclosed: cutting goes on elsewhere.
const POLE: f64 = 1e-18;

/// Cuts regions, each of a cell, into at most `most` new parts, until Σ|value| and Σ missed are as they should be; `integral` gives a
/// part's own. Parts are those that `cut` tells, such as beside a kink or a jump, or else [`Region::parts`].
pub fn refined(
    cut: impl Fn(&Region) -> Option<Vec<Region>>,
    regions: impl IntoIterator<Item = (usize, Region)>,
    most: usize,
    is_enough: impl Fn(f64, f64) -> bool,
    integral: impl Fn(usize, &Region) -> [f64; 2],
) -> Vec<Part> {
    let part = |of: usize, region: Region| {
        let [value, missed] = integral(of, &region);
        Part { of, region, value, missed }
    };
    let whole: Vec<Part> = regions.into_iter().map(|(of, region)| part(of, region)).collect();
    let mut parts = BinaryHeap::from(whole);
    let (mut new, mut tiny) = (0, Vec::new());
    let largest = parts.iter().map(|part| part.region.measure()).fold(0.0, f64::max);
    while new < most {
        let [size, missed] = parts
            .iter()
            .fold([0.0; 2], |[size, missed], part| [size + part.value.abs(), missed + part.missed]);
        if is_enough(size, missed) {
            break;
        }
        for _ in 0..ROUND.min(1 + parts.len() / 2) {
            let Some(worst) = parts.pop() else { break };
            let is_pole = !worst.missed.is_finite() && worst.region.measure() < POLE * largest;
            if is_pole || worst.region.is_tiny() {
                tiny.push(worst);
                new += 1;
                continue;
            }
            for region in cut(&worst.region).unwrap_or_else(|| worst.region.parts()) {
                parts.push(part(worst.of, region));
                new += 1;
            }
        }
    }
    parts.into_iter().chain(tiny).collect()
}

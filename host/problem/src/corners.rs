//! Where two boundary edges meet, neither may ask of u what the other excludes: no function of finite energy could satisfy both.
//!
//! Around a vertex the cells that are joined by edges form a *sector*; the sides of an open one are two boundary edges. At a pinch
//! there is a sector for each part, and u may differ from one to the other; at the tip of a slit both sides belong to one.
//! ```text
//!   u_D                 asks for u ≥ u_D and u ≤ u_D
//!   limit = inf         asks for u ≥ ψ
//!   flux = −inf         asks for u ≤ ψ            a flux with two finite ends asks for nothing
//! ```
//! What one side asks from below must not exceed what the other asks from above, by more than rounding explains
//! ([`super::rounding`]). Both are sums over the inputs, so that within their ranges
//! ```text
//!   max (below − above) = b_0 − a_0 + Σ_j max(lo_j c_j, hi_j c_j),   c_j = b_j − a_j.
//! ```
//! Inputs without a range count at their values: what else they may be is refused tick by tick ([`Problem::exclusions`]). Between
//! two Dirichlet edges u_D may jump: there is a solution of the discrete problem then, and no error bound.

#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use signorini_kernel::Error as KernelError;

use super::{EdgeKind, Problem, rounding};
use signorini_scene::error::{InputError, Result};
use signorini_scene::scene::{Datum, Input};

/// Two sides of a sector, one of which asks from below and the other from above; at most one is a Dirichlet edge.
#[derive(Debug, Clone, Copy)]
struct Meeting {
    vertex: u32,
    below: usize,
    above: usize,
}

/// A difference of data at a vertex that must not be positive: Σ factor · (1, inputs).
#[derive(Debug, Clone, PartialEq)]
pub struct Exclusion {
    /// Factors of what one edge asks from below, less what the other asks from above: of the constant 1 and of the inputs.
    pub factors: Vec<f64>,
    /// The part of it that rounding explains.
    pub slack: f64,
    /// The vertex.
    pub vertex: u32,
}

/// Refuses data that exclude each other, with the inputs as they are.
///
/// # Errors
/// The first vertex with such data: both boundaries, the point and both values.
pub(super) fn check(problem: &Problem) -> Result<()> {
    each(problem, |input, _| input.default)
}

/// Refuses ranges of inputs within which data can exclude each other.
///
/// # Errors
/// As for [`check`], at the range of the first input, with the values of those that matter.
pub(super) fn check_within_ranges(problem: &Problem) -> Result<()> {
    if problem.scene.inputs.iter().all(|input| input.range.is_none()) {
        return Ok(());
    }
    each(problem, |input, rises| input.end(rises))
}

impl Problem {
    /// Differences for a tick to look at: those that inputs without a range can make positive.
    pub fn exclusions(&self) -> Vec<Exclusion> {
        let is_open = |factors: &[f64]| {
            let inputs = self.scene.inputs.iter().zip(&factors[1..]);
            inputs.into_iter().any(|(input, &factor)| input.range.is_none() && factor != 0.0)
        };
        let range = rounding::range_of(self);
        let exclusion = |meeting: Meeting| {
            let [below, above] = meeting.factors(self)?;
            let factors: Vec<f64> = below.iter().zip(&above).map(|(b, a)| b - a).collect();
            let slack = meeting.slack(self, range);
            is_open(&factors).then_some(Exclusion { factors, slack, vertex: meeting.vertex })
        };
        meetings(self).filter_map(exclusion).collect()
    }

    /// The vertices at which what is asked from below may lie above what is asked from above, for inputs within their ranges: by
    /// how much at most, where it is not refused.
    pub fn moved_at_most(&self) -> BTreeMap<u32, f64> {
        let range = rounding::range_of(self);
        let most = |meeting: Meeting| {
            let [below, above] = meeting.factors(self)?;
            let changes = below.iter().zip(&above).map(|(below, above)| below - above);
            let ends = self.scene.inputs.iter().map(Input::interval);
            let ends = std::iter::once([1.0; 2]).chain(ends);
            let used = changes.zip(ends).filter(|(change, _)| *change != 0.0);
            let most: f64 = used.map(|(by, [lo, hi])| (by * lo).max(by * hi)).sum();
            (most > 0.0).then(|| (meeting.vertex, most.min(meeting.slack(self, range))))
        };
        let mut moved = BTreeMap::new();
        for (vertex, by) in meetings(self).filter_map(most) {
            *moved.entry(vertex).or_insert(0.0) += by;
        }
        moved
    }

    /// Bounds that an edge sets to u: not to be below its datum, not to be above it.
    pub fn asks(&self, edge: usize) -> [bool; 2] {
        match self.kinds[edge] {
            EdgeKind::Dirichlet => [true; 2],
            EdgeKind::Contact => {
                let span = self.loads.flux_range(edge - self.topology.counts.free).span().length();
                [span == f64::INFINITY, span == f64::NEG_INFINITY]
            }
            EdgeKind::Interior | EdgeKind::Neumann | EdgeKind::Robin => [false; 2],
        }
    }
}

/// Each one once, those of contact edges with the next side.
fn meetings(problem: &Problem) -> impl Iterator<Item = Meeting> {
    let counts = problem.topology.counts;
    let contact = counts.free..counts.unknowns();
    let sides = contact.flat_map(|edge| problem.ends[edge].map(|vertex| (edge, vertex)));
    sides.filter_map(|(edge, vertex)| {
        let (other, _) = problem.topology.sector(&problem.ends, vertex, edge).last()?;
        let ([below, above], [other_below, other_above]) =
            (problem.asks(edge), problem.asks(other));
        match () {
            () if below && other_above => Some(Meeting { vertex, below: edge, above: other }),
            // A contact edge that asks from below finds this pair itself.
            () if above && other_below && problem.kinds[other] == EdgeKind::Dirichlet => {
                Some(Meeting { vertex, below: other, above: edge })
            }
            () => None,
        }
    })
}

/// Checks all meetings with the values of inputs that `value` gives, told whether the difference rises with an input.
fn each(problem: &Problem, value: impl Fn(&Input, bool) -> f64) -> Result<()> {
    let inputs = &problem.scene.inputs;
    let mut range = None;
    for meeting in meetings(problem) {
        let Some([below, above]) = meeting.factors(problem) else { continue };
        let changes = below.iter().zip(&above).skip(1).map(|(below, above)| below - above);
        let used = inputs.iter().zip(changes).filter(|(_, change)| *change != 0.0);
        let chosen: Vec<_> =
            used.map(|(input, change)| (input, value(input, change > 0.0))).collect();
        let at = |factors: &[f64]| {
            let of = |(at, input): (usize, &Input)| {
                let own = chosen.iter().find(|(of, _)| std::ptr::eq(*of, input));
                factors[1 + at] * own.map_or(input.default, |(_, value)| *value)
            };
            inputs.iter().enumerate().map(of).fold(factors[0], |sum, term| sum + term)
        };
        let values = [at(&below), at(&above)];
        let range = *range.get_or_insert_with(|| rounding::range_of(problem));
        if values[0] > values[1] && values[0] - values[1] > meeting.slack(problem, range) {
            return Err(meeting.refused(problem, values, &chosen).into());
        }
    }
    Ok(())
}

impl Meeting {
    /// The data of both sides at the vertex, as factors of the constant 1 and of the inputs.
    fn factors(&self, problem: &Problem) -> Option<[Vec<f64>; 2]> {
        let [x, y] = problem.mesh.vertices[self.vertex as usize];
        let of = |edge: usize| {
            let boundary = problem.boundary_of(edge)?;
            let field = rounding::field_of(problem.kinds[edge]);
            let base = boundary.condition.datum(field)?;
            let at = |datum: &Datum| datum.value.eval(x, y, problem.time);
            let is_own =
                |input: &Input| input.of.value == boundary.name.value && input.field.value == field;
            let pattern = |input: &Input| if is_own(input) { at(&input.pattern) } else { 0.0 };
            let patterns = problem.scene.inputs.iter().map(pattern);
            Some(std::iter::once(at(base)).chain(patterns).collect())
        };
        Some([of(self.below)?, of(self.above)?])
    }

    /// The part of the difference that rounding explains.
    fn slack(&self, problem: &Problem, range: f64) -> f64 {
        rounding::slack(problem, range, [self.below, self.above], self.vertex)
    }

    fn refused(
        &self,
        problem: &Problem,
        [below, above]: [f64; 2],
        chosen: &[(&Input, f64)],
    ) -> InputError {
        let name = |edge| problem.boundary_of(edge).map_or("default", |of| &of.name.value);
        let ([lower, upper], [x, y]) =
            ([self.below, self.above].map(name), problem.mesh.vertices[self.vertex as usize]);
        let is_given = |edge: usize| problem.kinds[edge] == EdgeKind::Dirichlet;
        let (culprit, said, hint) = if is_given(self.above) {
            let said = format!(
                "u_D = {above} of boundary.{upper} at ({x}, {y}) lies below the gap ψ = {below} of boundary.{lower}"
            );
            (
                self.above,
                said,
                "where Dirichlet and contact boundary meet, value ≥ gap is needed; a `limit` on the flux of the contact lets u fall below its gap",
            )
        } else if is_given(self.below) {
            let said = format!(
                "u_D = {below} of boundary.{lower} at ({x}, {y}) lies above the gap ψ = {above} of boundary.{upper}"
            );
            let hint =
                "where u ≤ gap (flux = \"-inf\") meets a Dirichlet boundary, value ≤ gap is needed";
            (self.below, said, hint)
        } else {
            let said = format!(
                "boundary.{lower} asks for u ≥ {below} at ({x}, {y}), where boundary.{upper} asks for u ≤ {above}"
            );
            let hint = "where both boundaries meet, the gap of u ≥ gap may not be above that of u ≤ gap; with a finite limit \
                        and flux u may be on either side";
            (self.below, said, hint)
        };
        let ranged = chosen.iter().find_map(|(input, _)| input.range.as_ref());
        let values: Vec<_> =
            chosen.iter().map(|(of, value)| format!("{} = {value}", of.name.value)).collect();
        let said = match values.is_empty() {
            true => said,
            false => format!("with {} {said}", values.join(" and ")),
        };
        let error = match (ranged, rounding::datum(problem, culprit)) {
            (Some(range), _) => problem.scene.error(range, said),
            (None, Some(datum)) => problem.scene.error(datum.key(), said),
            (None, None) => InputError::new(said).file(&problem.scene.path),
        };
        error.hint(hint).because(KernelError::Excluded { at: self.vertex as usize })
    }
}

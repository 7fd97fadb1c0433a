//! Where ψ or u_D leaves its chord: w(t) = data − chord of the end values, t along the edge.

use std::sync::OnceLock;

use signorini_kernel::Real;

use super::between::{PANELS, Part, missed, on_part, parts, through};
use super::cell::{Jet, Local};
use super::ends::Ends;
use super::energy::{CellEnergy, Sample};
use signorini_problem::quadrature::bisected::mean_on_edge;
use signorini_problem::quadrature::{DATA_POINTS, on_panels};
use signorini_problem::rounding::extent;
use signorini_problem::{Problem, Sum};
use signorini_scene::error::Result;
use signorini_scene::expression::enclosure::Region;
use signorini_scene::scene::Field;

/// Least energy, as a part of that of the largest data, of data that a cell follows. Data of an edge below it are
/// left out; by how much in all is said ([`Deviations::dropped`]).
const ROUNDING: f64 = 1e-14;
/// Least energy of what its points miss, as that part.
const MISSED: f64 = 1e-9;
/// Roundings of a constant that was taken from all data, which a value less its chord may have.
const OF_LEVEL: f64 = 4.0;

/// Deviations above this part of the range of the boundary data are kept without weighing them.
const PLAIN: f64 = 1e-9;

/// Distances, as parts of an edge, at which w has no curvature worth speaking of, and w′ no change.
const NEAR: f64 = 1.0 / (1_u64 << 26) as f64;
const NEXT: f64 = 1.0 / (1_u64 << 48) as f64;
/// Noise is not the same everywhere: what may be missing of a rise, over the noise in the median.
const NOISES: f64 = 64.0;

/// Panels along an edge in search of a deviation.
const LOOKS: u32 = 8;

/// w on one edge.
pub struct Deviation<'s> {
    /// The edge.
    pub edge: usize,
    data: Sum<'s>,
    segment: [[f64; 2]; 2],
    ends: [f64; 2],
    /// Size of the constant that was taken from all data.
    level: f64,
    parts: OnceLock<Vec<Part>>,
}

/// The edges whose data are not affine.
pub struct Deviations<'s> {
    /// Ascending.
    pub found: Vec<Deviation<'s>>,
    /// ‖A^½∇Σv‖ of the extensions v that were left out: affine data deviate by rounding.
    pub dropped: f64,
}

impl<'s> Deviations<'s> {
    /// Finds them at the time of `problem`.
    pub fn of(problem: &'s Problem) -> Result<Self> {
        let ends = Ends::of(problem)?;
        let counts = problem.topology.counts;
        let contact = (counts.free..).zip(ends.gap.iter().map(|&pair| (Field::Gap, pair)));
        let given = (counts.unknowns()..).zip(ends.given.iter().map(|&pair| (Field::Value, pair)));
        let level = OF_LEVEL * f64::EPSILON * problem.units.level();
        let plain = level.max(PLAIN * ends.range());
        let (mut weighed, mut largest) = (Vec::new(), 0.0_f64);
        for (edge, (field, ends)) in contact.chain(given) {
            let (at, side) = problem.topology.first_side(edge);
            let energy = CellEnergy::of(problem, at);
            largest = largest.max(energy.of_vertices() * ends[0].abs().max(ends[1].abs()));
            let data = Sum::on_edge(problem, edge, field);
            let segment = problem.segment(edge);
            let Some(data) = data.filter(|data| data.constant().is_none()) else { continue };
            let (level, parts) = (problem.units.level(), OnceLock::new());
            let deviation = Deviation { edge, data, segment, ends, level, parts };
            let both = match deviation.samples(plain)? {
                Some(samples) => {
                    let missed = deviation
                        .parts()
                        .iter()
                        .fold([0.0; 2], |sum, part| [0, 1].map(|k| sum[k] + part.missed[k]));
                    [energy.of_extension(side, &samples), energy.of_missed(side, missed)]
                }
                None => [f64::INFINITY; 2],
            };
            let of_level = if level > 0.0 { level * energy.of_vertices() } else { 0.0 };
            weighed.push((deviation, both, of_level));
        }
        let mut dropped = 0.0;
        weighed.retain(|(_, [root, missed], of_level)| {
            let is_below = |of: f64, part: f64| of <= of_level.max(part * largest);
            let small = is_below(*root, ROUNDING) && is_below(*missed, MISSED);
            let small = small && largest.is_finite();
            dropped += if small { *root + *missed } else { 0.0 };
            !small
        });
        Ok(Self { found: weighed.into_iter().map(|(deviation, ..)| deviation).collect(), dropped })
    }

    /// The deviation of an edge.
    pub fn on(&self, edge: usize) -> Option<&Deviation<'s>> {
        let at = self.found.binary_search_by_key(&edge, |deviation| deviation.edge).ok()?;
        Some(&self.found[at])
    }

    /// Deviations of the sides of cell `at`, triangles first.
    pub fn of_cell(&self, problem: &Problem, at: usize) -> Vec<Option<&Deviation<'s>>> {
        problem.topology.edges_of(at).iter().map(|&edge| self.on(edge as usize)).collect()
    }
}

impl Deviation<'_> {
    /// w and w′ = dw/dt at t.
    ///
    /// # Errors
    /// Data that are not finite or not differentiable there.
    pub fn at(&self, t: f64) -> Result<[f64; 2]> {
        let ([a, b], x) = (self.segment, self.place(t));
        let slope = self.data.slope_at(x, [b[0] - a[0], b[1] - a[1]]);
        Ok([
            self.data.finite(self.value(t), x)?,
            self.data.finite(slope - (self.ends[1] - self.ends[0]), x)?,
        ])
    }

    /// w at t; not finite where the data are not.
    pub fn value(&self, t: f64) -> f64 {
        let [x, y] = self.place(t);
        self.data.at(x, y) - (self.ends[0] + t * (self.ends[1] - self.ends[0]))
    }

    /// ∫₀¹ w dt, with the data integrated as loads are.
    ///
    /// # Errors
    /// Data that are not finite.
    pub fn mean(&self) -> Result<f64> {
        let mean = mean_on_edge(self.segment, &|x, y| self.data.at(x, y));
        Ok(self.data.finite(mean, self.segment[0])? - 0.5 * (self.ends[0] + self.ends[1]))
    }

    /// By how much these values at the ends of the edge are above the data.
    pub fn above_chord(&self, values: [f64; 2]) -> [f64; 2] {
        [values[0] - self.ends[0], values[1] - self.ends[1]]
    }

    fn place(&self, t: f64) -> [f64; 2] {
        let [a, b] = self.segment;
        [0, 1].map(|k| a[k] + t * (b[k] - a[k]))
    }

    /// Rounding that may be in w: of the data, of the place where they are evaluated, and of terms that cancel inside
    /// their expression.
    pub fn rounding(&self) -> f64 {
        let of_place = |point: &[f64; 2]| {
            let [x, y] = self.place(point[0]);
            let [by_x, by_y] = self.data.gradient_at(x, y);
            self.data.at(x, y).abs().max((by_x * x).abs() + (by_y * y).abs())
        };
        let places = f64::GAUSS[DATA_POINTS - 1].iter().map(of_place);
        let data = places.fold(self.ends[0].abs().max(self.ends[1].abs()), f64::max);
        (ROUNDING * (data + self.level)).max(NOISES * self.noise())
    }

    /// Rounding of w at t alone: of operations, and of places that are off by some ulps of the edge's coordinates.
    pub fn rounding_at(&self, t: f64) -> f64 {
        /// Ulps that a point of the edge may be off, its ends and what is added to them.
        const PLACES: f64 = 8.0 * f64::EPSILON;
        self.data.rounding_at(self.place(t), PLACES * extent(self.segment))
    }

    /// Whether the data are the same at two places, but for next to nothing.
    pub(crate) fn is_steady(&self, places: [f64; 2]) -> bool {
        const NOTHING: f64 = 1e-9;
        let [a, b] = places.map(|t| self.place(t)).map(|[x, y]| self.data.at(x, y));
        (b - a).abs() <= NOTHING * a.abs().max(b.abs())
    }

    /// Parts of the edge in which little is missed, or w is singular.
    pub fn parts(&self) -> &[Part] {
        self.parts.get_or_init(|| {
            let [a, b] = self.segment;
            let direction = [0, 1].map(|k| b[k] - a[k]);
            let of = |range @ [from, to]: [f64; 2]| {
                let region = Region::segment(range.map(|t| self.place(t)));
                let missed = missed(&self.data, &region, direction, to - from);
                (Part { range, missed, energy: self.energy(range) }, region.is_tiny())
            };
            parts(of, |range| self.seen(range))
        })
    }

    /// ∫(w − w̃)² and ∫(w′ − w̃′)² over a part, by the points of its halves; those that are singular see nothing.
    fn seen(&self, range @ [from, to]: [f64; 2]) -> [f64; 2] {
        let (rule, middle) = (f64::GAUSS[DATA_POINTS - 1], 0.5 * (from + to));
        let at = |[t, _]: [f64; 2]| self.at(t).unwrap_or_default();
        let known: Vec<_> = on_part(range, rule).map(at).collect();
        let halves =
            [[from, middle], [middle, to]].into_iter().flat_map(|half| on_part(half, rule));
        halves.fold([0.0; 2], |sum, [t, weight]| {
            let (own, of) = (at([t, weight]), through(rule, &known, (t - from) / (to - from)));
            [0, 1].map(|k| sum[k] + weight * (own[k] - of[k]).powi(2))
        })
    }

    /// ∫w′² over a part by its points; singular ones have none.
    fn energy(&self, part: [f64; 2]) -> f64 {
        let square = |[t, weight]: [f64; 2]| {
            let slope = self.at(t).map_or(0.0, |[_, slope]| slope);
            weight * slope * slope
        };
        on_part(part, f64::GAUSS[DATA_POINTS - 1]).map(square).sum()
    }

    /// Second differences of w, which rounding that follows the data in steps shows as well, and first ones of w′ at once beside
    /// a point: in the median of some points, since a kink or a jump may lie between.
    fn noise(&self) -> f64 {
        let slope = |t| self.at(t).map_or(f64::NAN, |[_, slope]| slope);
        let at = |&[t, _]: &[f64; 2]| {
            let second = self.value(t + NEAR) - 2.0 * self.value(t) + self.value(t - NEAR);
            second.abs() + (slope(t + NEXT) - slope(t)).abs()
        };
        let mut found: Vec<f64> =
            on_panels(2, f64::GAUSS[DATA_POINTS - 1]).iter().map(at).collect();
        found.sort_by(f64::total_cmp);
        found.get(found.len() / 2).copied().filter(|noise| noise.is_finite()).unwrap_or(0.0)
    }

    /// w and w′ at the points of some panels, or of the parts where these are more. `None` where w is far above rounding, or singular.
    fn samples(&self, plain: f64) -> Result<Option<Vec<Sample>>> {
        let mut samples = Vec::new();
        let rule = f64::GAUSS[DATA_POINTS - 1];
        let looks = on_panels(LOOKS, rule);
        // Parts are proofs, which data that leave their chord at a glance do not need here.
        if looks.iter().map(|&[t, _]| self.value(t).abs()).any(|w| w > plain && w.is_finite()) {
            return Ok(None);
        }
        let points = match self.parts() {
            parts if parts.len() == PANELS as usize => looks,
            parts => parts.iter().flat_map(|part| on_part(part.range, rule)).collect(),
        };
        for [t, weight] in points {
            let [w, slope] = self.at(t)?;
            if w.abs() > plain {
                return Ok(None);
            }
            samples.push(Sample { t, weight, w, slope });
        }
        Ok(Some(samples))
    }
}

/// L = Σ v_E on one cell, v_E = (1 − η) w(t) for its sides E.
pub struct Lift<'d, 's>(Vec<Option<&'d Deviation<'s>>>);

impl<'d, 's> Lift<'d, 's> {
    /// Deviations on cell `at`, triangles first.
    pub fn on_cell(problem: &Problem, at: usize, deviations: &'d Deviations<'s>) -> Self {
        Self(deviations.of_cell(problem, at))
    }

    /// Whether no side's data leave their chord.
    pub fn is_zero(&self) -> bool {
        self.0.iter().all(Option::is_none)
    }

    /// L and ∇L at a point of the cell.
    ///
    /// # Errors
    /// Data that are not finite or not differentiable there.
    pub fn at(&self, local: &Local) -> Result<Jet> {
        let mut sum = Jet::default();
        for (deviation, side) in self.0.iter().zip(&local.sides) {
            if let Some(deviation) = deviation {
                let [w, slope] = deviation.at(side.t)?;
                sum.add(1.0, side.extension(w, slope));
            }
        }
        Ok(sum)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use signorini_problem::fixtures::{self, SMOOTH};
    use signorini_scene::mesh::structured::{Cells, grid};

    fn curved(gap: &str) -> Result<usize> {
        let text = SMOOTH.replace("gap = \"x^3\"", &format!("gap = \"{gap}\""));
        let (_, problem) = fixtures::on_grid(&text, grid(4, Cells::Triangles))?;
        let free = problem.topology.counts.free;
        let contact = free..problem.topology.counts.unknowns();
        let found = Deviations::of(&problem)?;
        Ok(found.found.iter().filter(|deviation| contact.contains(&deviation.edge)).count())
    }

    /// In the middle of an edge of ¼ the points of one rule lie 0.046 apart.
    #[test]
    fn a_bump_between_the_points_of_one_rule_is_seen() -> Result<()> {
        assert_eq!(curved("max(0, 1 - abs(x-0.375)/0.02)")?, 1);
        assert_eq!(curved("max(0, 1 - abs(x-0.375)/0.004)")?, 1);
        assert_eq!(curved("2*x - 1")?, 0);
        Ok(())
    }
}

//! What the kernel's parts cost on a Cortex-M4F: the record that `cargo xtask cost` keeps in git.
//!
//! Nothing here is an estimate but [`CYCLES`] and [`FEWEST_CYCLES`]: the emulator counts instructions, not cycles.

use signorini_image::record::counts::Counts;
use signorini_image::record::sizes;
use signorini_problem::scalar::Scalar;

const RECORD: &str = include_str!("../records/cost.txt");
/// Code, data, RAM and stack of baked scenes.
const SIZES: &str = include_str!("../records/size.txt");
/// The board that is told of.
const BOARD: &str = "M4F";

/// Cycles an instruction on a Cortex-M4 whose matrices lie in flash, with wait states: an estimate, which only ever warns.
pub const CYCLES: f64 = 2.0;

/// The fewest that are likely, from the timing table of its manual and the mix of the inner loops, without wait states: a
/// load takes 2, or 1 where one follows another, a product and a sum 1 each, for the kernel fuses none. What does not fit
/// at that rate is refused.
pub const FEWEST_CYCLES: f64 = 1.4;

/// The sizes of dense problems that were counted.
pub(super) const ORDERS: [f64; 4] = [8.0, 16.0, 32.0, 64.0];

/// The three of them around n, or next to it.
pub(super) fn around(n: f64) -> [f64; 3] {
    let [a, b, c, d] = ORDERS;
    if n < b { [a, b, c] } else { [b, c, d] }
}

/// Counts by kind and stage.
#[derive(Debug)]
pub struct Costs(Counts);

impl Costs {
    /// The costs of the record.
    pub fn measured() -> Self {
        // A test reads it: what is compiled in can be read.
        Self(Counts::read(RECORD).unwrap_or_default())
    }

    /// Instructions of a stage on a kind of mesh, a unit.
    pub fn of_mesh<R: Scalar>(&self, cells: &str, stage: &str) -> Option<f64> {
        self.0.get(BOARD, &format!("{} {cells}", R::NAME), stage)
    }

    /// Instructions that a call of this function in f32 saves where it is micromath's instead of libm's.
    pub fn saved_by(&self, function: &str) -> Option<f64> {
        let of = |library: &str| self.0.get(BOARD, &format!("f32 {library}"), function);
        Some(of("libm")? - of("micromath")?)
    }

    /// Instructions of a stage on a dense problem of a size that was counted.
    pub(super) fn counted<R: Scalar>(&self, stage: &str, order: f64) -> Option<f64> {
        let of = |kind: String| self.0.get(BOARD, &kind, stage);
        let count = of(format!("{}, n = {order}", R::NAME));
        // Stages with limits were counted in f32.
        let count =
            count.or_else(|| of(format!("limits, n = {order}")).filter(|_| R::NAME == "f32"));
        count.map(|count| count * order * order)
    }

    /// Instructions of a stage on a dense problem with n contact edges: the quadratic through three sizes
    /// counted. In f64, which was counted at one size, they grow like n².
    pub fn of_dense<R: Scalar>(&self, stage: &str, n: usize) -> Option<f64> {
        let n = n as f64;
        let orders = around(n);
        let [Some(a), Some(b), Some(c)] = orders.map(|order| self.counted::<R>(stage, order))
        else {
            let [.., largest] = ORDERS;
            let count = self.counted::<R>(stage, largest);
            return count.map(|count| count * (n / largest).powi(2));
        };
        Some(quadratic(orders, [a, b, c], n).max(0.0))
    }
}

/// Bytes of flash in every image beside its code and its model's data: the vector table of the chip, 1024, and constants of the
/// runtime and of square roots. Images of condensed scenes have 1.9 to 2.1 kB; `cargo xtask test` compares what is stated
/// with images.
pub const CONSTANTS: u64 = 2048;

/// Code and stack of a model's images.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Footprint {
    /// Bytes of flash, start-up and all.
    pub code: u64,
    /// Bytes of RAM.
    pub stack: u64,
}

impl Footprint {
    /// The most of any scene in the record of `cargo xtask size` whose name ends with `model` (`, condensed` and what may
    /// follow it, `, by a factor`), or has it within (`, on `).
    pub fn measured(model: &str) -> Self {
        let rows = sizes::read(SIZES).unwrap_or_default().into_iter();
        let of_model = rows
            .filter(|(name, _)| {
                name.ends_with(model) || model.ends_with(' ') && name.contains(model)
            })
            .map(|(_, takes)| takes);
        of_model.fold(Self { code: 0, stack: 0 }, |most, row| Self {
            code: most.code.max(row.statics.code),
            stack: most.stack.max(row.stack),
        })
    }
}

/// The value at n of the quadratic with these values at three `orders` (Lagrange).
fn quadratic(orders: [f64; 3], values: [f64; 3], n: f64) -> f64 {
    let term = |(i, value): (usize, f64)| {
        let others = (0..3).filter(|&j| j != i);
        others.fold(value, |product, j| product * (n - orders[j]) / (orders[i] - orders[j]))
    };
    values.into_iter().enumerate().map(term).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use signorini_scene::expression::Elementary;
    use signorini_tolerances::bake::COSTS;

    #[test]
    fn the_records_are_read_to_their_ends() {
        assert_eq!(Counts::read(RECORD).map(drop), Ok(()));
        assert_eq!(sizes::read(SIZES).map(|rows| rows.len()), Ok(11));
    }

    #[test]
    fn the_record_tells_what_a_sweep_costs() {
        let costs = Costs::measured();
        let sweep = costs.of_mesh::<f32>("triangles", "sweep").unwrap_or_default();
        assert!((20.0..30.0).contains(&sweep), "{sweep}");
        let dense = costs.of_dense::<f32>("sweep", 64).unwrap_or_default() / 4096.0;
        assert!((2.0..3.0).contains(&dense), "{dense}");
        assert_eq!(costs.of_mesh::<f32>("triangles", "no such stage"), None);
    }

    #[test]
    fn the_record_tells_what_each_function_of_micromath_saves() {
        let costs = Costs::measured();
        for function in Elementary::ALL {
            let saved = costs.saved_by(function.name());
            assert!(
                saved.is_some_and(|saved| saved.abs() < 5_000.0),
                "{}: {saved:?}",
                function.name()
            );
        }
        assert!(costs.saved_by("negation").is_some_and(|saved| saved.abs() < 1.0));
        assert_eq!(costs.saved_by("no such function"), None);
    }

    #[test]
    fn the_record_tells_the_code_of_each_model() {
        for model in [", condensed", ", on ", ", by a factor"] {
            let Footprint { code, stack } = Footprint::measured(model);
            assert!((4_000..64_000).contains(&code), "{model}: {code}");
            assert!((100..4_000).contains(&stack), "{model}: {stack}");
        }
    }

    #[test]
    fn a_quadratic_is_met_everywhere() {
        let exact = |n: f64| 3.0 * n * n - 5.0 * n + 7.0;
        for n in [0.0, 16.0, 50.0, 96.0] {
            COSTS.check("a quadratic", quadratic(around(n), around(n).map(exact), n) - exact(n));
        }
    }
}

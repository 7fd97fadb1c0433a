//! What the kernel's parts cost on a Cortex-M4F: the record that `cargo xtask cost` keeps in git.
//!
//! Nothing here is an estimate but [`CYCLES`] and [`FEWEST_CYCLES`]: the emulator counts instructions, not cycles.

use std::collections::HashMap;

use signorini_solve::scalar::Scalar;

const RECORD: &str = include_str!("../../../tests/firmware/cost.txt");
/// Code, data, RAM and stack of baked scenes.
const SIZES: &str = include_str!("../../../tests/firmware/size.txt");
/// Columns of a scene's name there.
const NAME: usize = 36;
/// Columns of a stage, of its unit and of a count.
const WIDTHS: [usize; 3] = [36, 8, 16];

/// Cycles an instruction on a Cortex-M4 whose matrices lie in flash, with wait states: an estimate, which only ever warns.
pub const CYCLES: f64 = 2.0;

/// The fewest that are likely, from the timing table of its manual and the mix of the inner loops, without wait states: a
/// load takes 2, or 1 where one follows another, a product and a sum 1 each, for the kernel fuses none. What does not fit
/// at that rate is refused.
pub const FEWEST_CYCLES: f64 = 1.4;

/// The sizes of dense problems that were counted.
pub(super) const ORDERS: [f64; 3] = [16.0, 32.0, 64.0];

/// Counts by kind and stage.
#[derive(Debug)]
pub struct Costs(HashMap<(String, String), f64>);

impl Costs {
    /// Those of the record.
    pub fn measured() -> Self {
        let mut counts = HashMap::new();
        let mut kinds: Option<Vec<String>> = None;
        for line in RECORD.lines() {
            let (stage, numbers) = columns(line);
            if stage.ends_with(": instructions") {
                kinds = stage.starts_with("M4F:").then_some(numbers);
            } else if let Some(kinds) = &kinds {
                for (kind, number) in kinds.iter().zip(numbers) {
                    if let Ok(count) = number.parse() {
                        counts.insert((kind.clone(), stage.clone()), count);
                    }
                }
            }
        }
        Self(counts)
    }

    /// Instructions of a stage on a kind of mesh, a unit.
    pub fn of_mesh<R: Scalar>(&self, cells: &str, stage: &str) -> Option<f64> {
        self.0.get(&(format!("{} {cells}", R::NAME), stage.to_owned())).copied()
    }

    /// Instructions that a call of this function in f32 saves where it is micromath's instead of libm's.
    pub fn saved_by(&self, function: &str) -> Option<f64> {
        let of = |library: &str| self.0.get(&(format!("f32 {library}"), function.to_owned()));
        Some(of("libm")? - of("micromath")?)
    }

    /// Instructions of a stage on a dense problem of a size that was counted.
    pub(super) fn counted<R: Scalar>(&self, stage: &str, order: f64) -> Option<f64> {
        let key = (format!("{}, n = {order}", R::NAME), stage.to_owned());
        self.0.get(&key).map(|count| count * order * order)
    }

    /// Instructions of a stage on a dense problem with n contact edges: the quadratic through the sizes
    /// counted. In f64, which was counted at one size, they grow like n².
    pub fn of_dense<R: Scalar>(&self, stage: &str, n: usize) -> Option<f64> {
        let n = n as f64;
        let [a, b, c] = ORDERS.map(|order| self.counted::<R>(stage, order));
        let (Some(a), Some(b), Some(c)) = (a, b, c) else {
            return c.map(|count| count * (n / ORDERS[2]).powi(2));
        };
        Some(quadratic([a, b, c], n).max(0.0))
    }
}

/// Code and stack of a model's images.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Footprint {
    /// Bytes of flash, start-up and all.
    pub code: u64,
    /// Bytes of RAM.
    pub stack: u64,
}

impl Footprint {
    /// The most of any scene with `model` in its name (`, condensed`, `, on ` or `, by a factor`) in the record of
    /// `cargo xtask size`.
    pub fn measured(model: &str) -> Self {
        let rows = SIZES.lines().filter_map(|line| {
            let (name, numbers) = line.split_at_checked(NAME)?;
            let mut numbers = numbers.split_whitespace().map(str::parse);
            let (code, stack) = (numbers.next()?.ok()?, numbers.nth(2)?.ok()?);
            name.contains(model).then_some(Self { code, stack })
        });
        rows.fold(Self { code: 0, stack: 0 }, |most, row| Self {
            code: most.code.max(row.code),
            stack: most.stack.max(row.stack),
        })
    }
}

/// The value at n of the quadratic with these values at [`ORDERS`] (Lagrange).
fn quadratic(values: [f64; 3], n: f64) -> f64 {
    let term = |(i, value): (usize, f64)| {
        let others = (0..3).filter(|&j| j != i);
        others.fold(value, |product, j| product * (n - ORDERS[j]) / (ORDERS[i] - ORDERS[j]))
    };
    values.into_iter().enumerate().map(term).sum()
}

/// The stage of a line, and the words of its columns after the unit.
fn columns(line: &str) -> (String, Vec<String>) {
    let letters: Vec<char> = line.chars().collect();
    let text = |range: &[char]| range.iter().collect::<String>().trim().to_owned();
    let [stage, unit, width] = WIDTHS;
    let numbers = letters.get(stage + unit..).unwrap_or_default().chunks(width).map(text);
    (text(letters.get(..stage).unwrap_or(&letters)), numbers.collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use signorini_scene::expression::Elementary;
    use signorini_tolerances::bake::COSTS;

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
            COSTS.check("a quadratic", quadratic(ORDERS.map(exact), n) - exact(n));
        }
    }
}

//! Every declared output is that of the full model.
//!
//! A deviation is measured against the largest value that the output takes over the ticks, but at least
//! against the part `TERMS` of the largest sum of its terms' sizes: an output that is a small difference
//! of large terms is no better known than these. Edges touch as in the full model, but for
//! those that are within rounding of the other side: max(x_i, r_i) below `CLOSE` of the largest x and r.

use signorini_host::bake::condensed::{Baked, Controller};
use signorini_host::condense::Measure;
use signorini_host::scalar::Scalar;
use signorini_kernel::condensed::method::Ended;
use signorini_tests::random::Random;

use crate::scenes::{EXACT, Model};

/// Ticks of each controller.
const TICKS: usize = 6;

/// What came of a comparison.
#[derive(Debug, Clone, Copy, Default)]
pub struct Worst {
    /// Relative to the largest value over the ticks.
    pub of_values: f64,
    /// Relative to the largest sum of terms.
    pub of_terms: f64,
    /// Edges that touched where they should not, or the other way round, with the largest distance from
    /// switching.
    pub switched: f64,
    /// How many did.
    pub edges: usize,
    pub ticks: usize,
    pub certified: bool,
}

fn magnitude(numbers: &[f64]) -> f64 {
    numbers.iter().fold(0.0, |most: f64, x| most.max(x.abs()))
}

/// Values of the inputs that f32 holds exactly.
pub fn inputs(model: &Model, random: &mut Random) -> Vec<f64> {
    let inputs = model.scene.inputs.iter();
    inputs.map(|_| (f64::from(random.below(256)) - 128.0) / 64.0).collect()
}

pub fn compare<R: Scalar>(model: &Model, seed: u64) -> Worst {
    let random = &mut Random::new(seed ^ 0x5eed);
    let baked: Baked<R> = model.baked(EXACT);
    let mut controller = Controller::new(&baked);
    let condensate = &model.condensate;
    let outputs = &condensate.outputs;
    let mut worst = Worst { certified: condensate.certificate.is_ok(), ..Worst::default() };
    let (mut values, mut terms, mut off) =
        (vec![0.0_f64; outputs.len()], vec![0.0_f64; outputs.len()], vec![0.0_f64; outputs.len()]);
    for _ in 0..TICKS {
        let p = inputs(model, random);
        let (problem, solution, expected) = model.full(&p);
        let narrow: Vec<R> = p.iter().map(|&p| R::narrow(p)).collect();
        let (found, report) = controller.tick(&narrow).expect("a tick");
        assert_eq!(report.ended, Ended::Exact, "{}", model.what);
        worst.ticks += 1;
        let all: Vec<f64> = std::iter::once(1.0).chain(p.iter().copied()).collect();
        let x: Vec<f64> = controller.x().iter().map(|x| x.wide()).collect();
        let free = problem.topology.counts.free;
        let opening = |at: usize| solution.u[free + at] - problem.loads.gap[at];
        let scaled: Vec<f64> = (0..x.len()).map(|at| opening(at) / condensate.opening[at]).collect();
        let residual = condensate.residual(&all, &scaled);
        let size = magnitude(&scaled).max(magnitude(&residual)).max(magnitude(&condensate.load_of(&all)));
        let mut doubtful = 0.0;
        for at in 0..x.len() {
            let touches = solution.u[free + at] == problem.loads.gap[at];
            if touches != (x[at] == 0.0) {
                worst.switched = worst.switched.max(scaled[at].abs().max(residual[at].abs()) / size);
                worst.edges += 1;
                doubtful += problem.lengths[free + at];
            }
        }
        for (at, measure) in outputs.iter().enumerate() {
            let value = found[at].wide();
            match measure {
                Measure::Linear { of_inputs, of_contact } => {
                    let expected = expected[at].expect("a value");
                    let products = of_inputs.iter().zip(&all).chain(of_contact.iter().zip(&x));
                    let size: f64 = products.map(|(a, b)| (a * b).abs()).sum();
                    values[at] = values[at].max(expected.abs());
                    terms[at] = terms[at].max(size);
                    off[at] = off[at].max((value - expected).abs());
                }
                Measure::Length { .. } => {
                    let expected = expected[at].expect("a value");
                    let rounding = 16.0 * R::EPSILON.wide() * 10.0;
                    assert!((value - expected).abs() <= doubtful + rounding, "{}: {value} {expected}", model.what);
                }
                Measure::Bound => assert_eq!(value.is_finite(), worst.certified || value.is_finite()),
            }
        }
    }
    for at in 0..outputs.len() {
        if off[at] > 0.0 {
            worst.of_values = worst.of_values.max(off[at] / values[at]);
            worst.of_terms = worst.of_terms.max(off[at] / terms[at]);
        }
    }
    worst
}

#[test]
fn survey() {
    let count: u64 = std::env::var("SEEDS").ok().and_then(|n| n.parse().ok()).unwrap_or(40);
    let mut all = [Worst::default(); 2];
    let mut certified = 0;
    for seed in 0..count {
        let model = Model::random(seed, 5);
        let found = [compare::<f64>(&model, seed), compare::<f32>(&model, seed)];
        certified += usize::from(found[0].certified);
        for (all, found) in all.iter_mut().zip(found) {
            if found.of_values > all.of_values || found.of_terms > all.of_terms || found.edges > 0 {
                println!("{}: {found:?}", model.what);
            }
            all.of_values = all.of_values.max(found.of_values);
            all.of_terms = all.of_terms.max(found.of_terms);
            all.switched = all.switched.max(found.switched);
            all.edges += found.edges;
            all.ticks += found.ticks;
        }
    }
    println!("{all:?} certified {certified} of {count}");
}

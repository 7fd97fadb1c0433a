//! Controllers baked from reduced models: solved to the end, and cut off in every way; and the worst case that is proved, which
//! no tick exceeds.

use signorini_bake::Bakes;
use signorini_bake::condensed::{Baked, Controller, Work};
use signorini_condense::{CondensedModel, Measure};
use signorini_kernel::report::{Ended, Report};
use signorini_problem::inputs::{self, InputSpace};
use signorini_tests::random::Random;
use signorini_tolerances::Tolerance;
use signorini_tolerances::cases;
use signorini_tolerances::twins::{
    REDUCED_TICK, REDUCED_TICK_NARROW, REDUCED_VALUES, REDUCED_VALUES_NARROW,
};

use super::standard::pairs;
use super::{Pair, drawn, over, terms};
use crate::condensed::scenes::EXACT;

/// Ticks of each controller of a standard scene that solves to the end.
const TICKS: usize = 10_000;

/// From no exchange at all to a few sweeps.
const CUT_OFF: [Work; 7] = [
    Work { pivots: Some(0), sweeps: 0 },
    Work { pivots: Some(0), sweeps: 1 },
    Work { pivots: Some(1), sweeps: 0 },
    Work { pivots: Some(2), sweeps: 0 },
    Work { pivots: Some(2), sweeps: 1 },
    Work { pivots: None, sweeps: 1 },
    Work { pivots: None, sweeps: 3 },
];

/// One answer of a controller in f64, with the inputs that its scalar had.
struct Tick<R: Bakes> {
    p: Vec<f64>,
    /// Of the reduced model.
    own: Vec<f64>,
    /// Of the whole one.
    x: Vec<f64>,
    outputs: Vec<f64>,
    report: Report<R>,
}

impl<R: Bakes> Tick<R> {
    fn new(pair: &Pair, controller: &mut Controller<R>, random: &mut Random) -> Self {
        let p = drawn(&pair.whole, random);
        let narrow: Vec<R> = p.iter().map(|&p| R::narrow(p)).collect();
        let (outputs, report) = controller.tick(&narrow[1..]).expect("a tick");
        let wide = |numbers: &[R]| numbers.iter().map(|number| number.wide()).collect::<Vec<_>>();
        let (p, own, outputs) = (wide(&narrow), wide(controller.x()), wide(&outputs));
        Self { x: pair.reduced.expand(&p, &own), p, own, outputs, report }
    }

    /// Requirements of every tick, cut off or not.
    fn check(&self, pair: &Pair, solution: &[f64]) {
        let Pair { what, whole, reduced, .. } = pair;
        for (x, limits) in self.own.iter().zip(&reduced.model.limits) {
            let [least, most] = limits.map(|limit| R::narrow(limit).wide());
            assert!((least..=most).contains(x), "{what}: {x} in [{least}, {most}]");
        }
        for (&found, measure) in self.outputs.iter().zip(&whole.outputs) {
            match measure {
                Measure::Bound => {
                    assert_eq!(found.is_finite(), self.report.certificate().is_some(), "{what}");
                }
                _ => assert!(found.is_finite(), "{what}: {found}"),
            }
            assert!(!is_force(measure) || found >= 0.0, "{what}: {found:e}");
        }
        self.check_bound(pair, solution);
    }

    /// The bound is above that of the whole model, and above the distance of the two answers from each other with that
    /// of the solution's.
    fn check_bound(&self, Pair { what, whole, .. }: &Pair, solution: &[f64]) {
        let Some(certificate) = self.report.certificate() else { return };
        let [total, of_u] = [certificate.total, certificate.of_u].map(|bound| bound.wide());
        let known = whole.bound(&self.p, &self.x).expect("as the reduced one");
        let known_of_u = whole.bound_of_u(&self.p, &self.x).expect("as the other");
        assert!(total >= known, "{what}: {total:e} {known:e}");
        assert!(of_u >= known_of_u, "{what}: {of_u:e} {known_of_u:e}");
        let off: Vec<f64> = self.x.iter().zip(solution).map(|(x, y)| x - y).collect();
        let rows = whole.matrix.chunks(whole.contact.max(1)).zip(&off);
        let product = |row: &[f64]| row.iter().zip(&off).map(|(s, x)| s * x).sum::<f64>();
        let square: f64 = rows.map(|(row, x)| x * product(row)).sum();
        let distance = whole.energy_unit * square.max(0.0).sqrt();
        let of_solution = whole.bound_of_u(&self.p, solution).expect("as the other");
        assert!(distance <= of_u + of_solution, "{what}: {distance:e} {of_u:e} {of_solution:e}");
    }
}

/// ∫λ over contact edges alone: its terms are r, no inputs and no openings.
fn is_force(measure: &Measure) -> bool {
    matches!(measure, Measure::Flux { of_inputs, of_contact, of_reaction }
        if of_inputs.is_empty() && of_contact.is_empty() && of_reaction.iter().all(|&y| y >= 0.0))
}

/// Ticks solved to the end, against the solution of the whole model in f64; the largest deviation of outputs over their
/// terms, and over their largest values.
fn solved<R: Bakes>(pair: &Pair, ticks: usize, allowed: Tolerance) -> [f64; 2] {
    let Pair { what, whole, reduced, .. } = pair;
    let baked = Baked::<R>::new(&reduced.model, EXACT, true).expect("in range");
    let (mut controller, random) = (Controller::new(&baked), &mut Random::new(5));
    let mut most = 0.0_f64;
    let mut values = vec![[0.0_f64; 2]; whole.outputs.len()];
    for _ in 0..ticks {
        let tick = Tick::new(pair, &mut controller, random);
        assert_eq!(tick.report.ended, Ended::Exact, "{what}");
        let solution = whole.solve(&tick.p).expect("a solution");
        tick.check(pair, &solution);
        let expected = whole.outputs(&tick.p, &solution);
        let all = whole.outputs.iter().zip(&mut values).zip(tick.outputs.iter().zip(expected));
        for ((measure, [off, value]), (found, expected)) in all {
            let doubt = R::EPSILON.wide().sqrt();
            if let Some(terms) = terms(whole, measure, &tick.p, &solution, doubt) {
                let expected = expected.expect("a value");
                most = most.max(over(found - expected, terms));
                [*off, *value] = [off.max((found - expected).abs()), value.max(expected.abs())];
            }
        }
    }
    allowed.check(what, most);
    let of_values = values.iter().map(|[off, value]| over(*off, *value)).fold(0.0, f64::max);
    [most, of_values]
}

/// Ticks cut off, from one corner of the box to another.
fn cut_off<R: Bakes>(pair: &Pair, ticks: usize) -> usize {
    let (mut unfinished, mut solutions) = (0, Vec::new());
    for work in CUT_OFF {
        let baked = Baked::<R>::new(&pair.reduced.model, work, true).expect("in range");
        let (mut controller, random) = (Controller::new(&baked), &mut Random::new(6));
        for at in 0..ticks {
            let tick = Tick::new(pair, &mut controller, random);
            // Every way has the same inputs.
            if at == solutions.len() {
                let solution = pair.whole.solve(&tick.p).expect("a solution");
                solutions.push((tick.p.clone(), solution));
            }
            let (p, solution) = &solutions[at];
            assert_eq!(*p, tick.p);
            tick.check(pair, solution);
            unfinished += usize::from(tick.report.ended != Ended::Exact);
        }
    }
    unfinished
}

fn of_random(count: u64, mut then: impl FnMut(&Pair)) {
    (0..count).filter_map(Pair::random).for_each(|pair| then(&pair));
}

/// The matrix of f32 is that of f64 to 6e−8, which small eigenvalues magnify.
#[test]
fn controllers_of_standard_scenes_tell_what_the_whole_model_tells() {
    pairs().iter().for_each(|pair| {
        let wide = solved::<f64>(pair, TICKS / 10, REDUCED_TICK);
        let narrow = solved::<f32>(pair, TICKS, REDUCED_TICK_NARROW);
        REDUCED_VALUES.check(&pair.what, wide[1]);
        REDUCED_VALUES_NARROW.check(&pair.what, narrow[1]);
    });
}

#[test]
fn controllers_of_random_scenes_tell_what_the_whole_model_tells() {
    let (mut wide, mut narrow) = (0.0_f64, 0.0_f64);
    of_random(cases(200), |pair| {
        wide = wide.max(solved::<f64>(pair, 40, REDUCED_TICK)[0]);
        narrow = narrow.max(solved::<f32>(pair, 40, REDUCED_TICK_NARROW)[0]);
    });
}

#[test]
fn ticks_of_standard_scenes_may_be_cut_off() {
    pairs().iter().for_each(|pair| {
        let unfinished = [cut_off::<f32>(pair, 300), cut_off::<f64>(pair, 300)];
        assert!(unfinished.iter().all(|&count| count > 300), "{}: {unfinished:?}", pair.what);
    });
}

#[test]
fn ticks_of_random_scenes_may_be_cut_off() {
    let (mut unfinished, all) = (0, cases(150));
    of_random(all, |pair| unfinished += cut_off::<f32>(pair, 20) + cut_off::<f64>(pair, 20));
    assert!(unfinished as u64 > cases(1000) / 2, "{unfinished}");
}

/// Outside the box a controller refuses, and keeps its last answer.
#[test]
fn nothing_is_told_of_inputs_outside_their_ranges() {
    pairs().iter().for_each(|pair| {
        let model: &CondensedModel = &pair.reduced.model;
        let baked = Baked::<f32>::new(model, EXACT, true).expect("in range");
        let mut controller = Controller::new(&baked);
        let inside: Vec<f32> = model.ranges[1..].iter().map(|range| range[1] as f32).collect();
        controller.tick(&inside).expect("a tick");
        let x = controller.x().to_vec();
        for input in 0..inside.len() {
            let [lo, hi] = model.ranges[1 + input].map(|end| end as f32);
            for outside in [lo.next_down(), hi.next_up(), f32::NAN, f32::INFINITY] {
                let mut p = inside.clone();
                p[input] = outside;
                let refused = signorini_kernel::Error::InputOutOfRange { input };
                assert_eq!(controller.tick(&p).expect_err("outside"), refused);
                assert_eq!(controller.x(), x);
            }
        }
    });
}

/// Ticks of a controller in search of its worst case.
const MANY: usize = 1_000_000;

/// The most exchanges of so many ticks, half of them at corners of the box; all end with the solution.
fn most<R: Bakes>(pair: &Pair, ticks: usize) -> [u32; 2] {
    let model = &pair.reduced.model;
    let baked = Baked::<R>::new(model, EXACT, false).expect("in range");
    let proved = baked.worst_exchanges().expect("all signs are right");
    let ranges = model.defaults.iter().zip(&model.ranges).skip(1);
    let spaces: Vec<_> = ranges.map(|(&default, &range)| InputSpace { default, range }).collect();
    let mut controller = Controller::new(&baked);
    let mut most = 0;
    for inputs in inputs::drawn::<R>(&spaces, ticks) {
        let (_, report) = controller.tick(&inputs).expect("a tick");
        assert_eq!(report.ended, Ended::Exact, "{}: {inputs:?}", pair.what);
        most = most.max(report.exchanges);
    }
    [most, proved]
}

#[test]
fn no_tick_takes_more_exchanges_than_are_proved() {
    for pair in &pairs()[..2] {
        let (name, of_both) = (&pair.what, [most::<f32>(pair, MANY), most::<f64>(pair, MANY / 10)]);
        for [most, proved] in of_both {
            let n = pair.reduced.model.contact as u32;
            assert!(proved == n + n / 2 && most <= proved, "{name}: {most} of {proved}");
            assert!(4 * most >= proved, "{name}: inputs are easy, {most} of {proved}");
        }
    }
}

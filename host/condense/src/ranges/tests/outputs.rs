//! Intervals of outputs against solutions at the corners of the box and inside it.

use super::{inputs, matrix, scatter};
use crate::ranges::interval::Interval;
use crate::ranges::outputs::intervals;
use crate::ranges::sides::Sides;
use crate::{CondensedModel, Measure};
use signorini_tolerances::solve::REACHED_INTERVAL;

/// A model of `entries` with three inputs and an output of each kind but the bound.
fn model(entries: Vec<f64>, n: usize, ranges: [[f64; 2]; 3], seed: u64) -> CondensedModel {
    let mut random = scatter(seed);
    let mut signed = |length: usize| (0..length).map(|_| 2.0 * random() - 1.0).collect::<Vec<_>>();
    let load = (0..3).map(|_| signed(n)).collect();
    let flux =
        Measure::Flux { of_inputs: signed(3), of_contact: signed(n), of_reaction: signed(n) };
    let linear = Measure::Linear { of_inputs: signed(3), of_contact: signed(n) };
    let force = Measure::Flux {
        of_inputs: Vec::new(),
        of_contact: Vec::new(),
        of_reaction: (0..n).map(|at| at as f64).collect(),
    };
    let length = Measure::Length { always: 0.5, of_contact: vec![1.0; n] };
    super::model(entries, load, &ranges, vec![flux, linear, force, length])
}

/// The range of outputs at the corners of the box and at 200 points of it.
fn reached(model: &CondensedModel, seed: u64) -> Vec<Interval> {
    let mut all = vec![Interval { lo: f64::INFINITY, hi: f64::NEG_INFINITY }; model.outputs.len()];
    for p in inputs(&model.ranges, 200, seed) {
        let x = model.solve(&p).expect("a solution");
        for (range, value) in all.iter_mut().zip(model.outputs(&p, &x)) {
            *range = range.hull(Interval::point(value.expect("no output is a bound")));
        }
    }
    all
}

#[test]
fn every_output_lies_in_its_interval() {
    let (mut judged, mut widest) = ([0, 0], [0.0_f64; 2]);
    for case in 0..60 {
        let n = 3 + case as usize % 17;
        let positive = if case % 3 == 0 { 0.2 } else { 0.0 };
        let ranges = [[1.0, 1.0], [-0.05, 0.025], [0.0, 0.03]];
        let model = model(matrix(n, case, positive), n, ranges, 2000 + case);
        let sides = Sides::new(&model).expect("finite loads");
        let Some(intervals) = intervals(&model, &sides).expect("finite loads") else { continue };
        let is_m_matrix =
            model.matrix.iter().enumerate().all(|(at, &s)| at % (n + 1) == 0 || s <= 0.0);
        judged[usize::from(is_m_matrix)] += 1;
        for (interval, reached) in intervals.iter().zip(reached(&model, 3000 + case)) {
            let Interval { lo, hi } = interval.expect("no output is a bound");
            assert!(
                lo <= reached.lo && reached.hi <= hi,
                "case {case}: {reached:?} in {lo} to {hi}"
            );
            if reached.width() > 0.01 {
                let widest = &mut widest[usize::from(is_m_matrix)];
                *widest = widest.max((hi - lo) / reached.width());
            }
        }
    }
    assert!(judged.iter().all(|&count| count >= 10), "{judged:?}");
    // Most are a few percent too wide; the worst have slopes of both signs.
    assert!(widest.iter().all(|&part| part < 6.0), "{widest:?}");
}

#[test]
fn where_slopes_keep_their_signs_the_corners_reach_the_interval() {
    let (n, ranges) = (9, [[1.0, 1.0], [-0.5, 0.25], [0.0, 0.3]]);
    let mut model = model(matrix(n, 5, 0.0), n, ranges, 77);
    // All loads push: x grows with every input, and so does the first output; the second falls with the last.
    model.load.iter_mut().flatten().for_each(|b| *b = b.abs());
    model.outputs = vec![
        Measure::Linear { of_inputs: vec![0.0; 3], of_contact: vec![1.0; n] },
        Measure::Linear { of_inputs: vec![0.0, 0.0, -100.0], of_contact: vec![1.0; n] },
    ];
    let sides = Sides::new(&model).expect("finite loads");
    let intervals = intervals(&model, &sides).expect("finite loads").expect("an M-matrix");
    for (interval, reached) in intervals.iter().zip(reached(&model, 78)) {
        let Interval { lo, hi } = interval.expect("no output is a bound");
        // The box is that of any scalar, wider by the rounding of f32.
        REACHED_INTERVAL.check_over("least", reached.lo - lo, reached.width());
        REACHED_INTERVAL.check_over("largest", hi - reached.hi, reached.width());
    }
}

#[test]
fn without_contact_outputs_are_linear_in_the_inputs() {
    let mut model = model(Vec::new(), 0, [[1.0, 1.0], [-0.5, 0.25], [0.0, 0.3]], 1);
    model.outputs = vec![Measure::Linear { of_inputs: vec![1.0, 2.0, -1.0], of_contact: vec![] }];
    let sides = Sides::new(&model).expect("finite loads");
    let found = intervals(&model, &sides).expect("finite loads").expect("a proof")[0];
    let Interval { lo, hi } = found.expect("no output is a bound");
    REACHED_INTERVAL.check("least", lo + 0.3);
    REACHED_INTERVAL.check("largest", hi - 1.5);
    model.ranges[1] = [f64::NEG_INFINITY, f64::INFINITY];
    let sides = Sides::new(&model).expect("finite loads");
    assert_eq!(intervals(&model, &sides), Ok(None), "an input without a range");
}

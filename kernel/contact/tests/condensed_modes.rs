//! Two contact edges and two modes of a coefficient, in numbers that are exact: against the same by hand.

use crate::memory::bare;
use signorini_contact::Condensed;
use signorini_contact::certificate::Form;
use signorini_contact::dense::blocks::Block;
use signorini_contact::factor::Factor;
use signorini_contact::method::Sweeps;
use signorini_contact::modes::{ArrayModalStorage, Modal};
use signorini_contact::outputs::Measure;
use signorini_contact::sides::Sides;
use signorini_contact::storage::ArrayTableauStorage;
use signorini_kernel::Error;
use signorini_kernel::limits::Deadline;
use signorini_kernel::report::Ended;
use signorini_kernel::verdict::Verdict;

/// S = [1, −¼; −¼, 1]
const MATRIX: [Block<f64>; 1] = [{
    let mut block = [[0.0; 8]; 8];
    block[0] = [1.0, -0.25, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    block[1] = [-0.25, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    block
}];
/// b = (1, ½) + q (0, 1) for p = (1, q, h); then α = (½, ¼) and (0, −½).
const LOAD: [f64; 40] = {
    let mut load = [0.0; 40];
    (load[0], load[1], load[9]) = (1.0, 0.5, 1.0);
    (load[24], load[25], load[33]) = (0.5, 0.25, -0.5);
    load
};
const NU: [f64; 2] = [1.0, 3.0];
const BETA: [[f64; 3]; 2] = [[0.5, 0.25, 0.0], [-0.25, 0.0, 0.0]];
/// h = 2.5 where t = 0, and t = (h − 2.5)/4.
const ORIGIN: [f64; 2] = [2.0, 0.5];

/// q + 2 y_0 − y_1 + x_0 + 4 x_1
const OUTPUT: Measure<f64> =
    Measure::Linear { of_inputs: &[0.0, 1.0, 0.0, 2.0, -1.0], of_contact: &[1.0, 4.0] };

const MODEL: Modal<'static, f64> = Modal {
    model: Condensed {
        contact: 2,
        matrix: &MATRIX,
        load: &LOAD,
        outputs: &[OUTPUT],
        has_bound: true,
        ..bare()
    },
    input: 2,
    origin: ORIGIN,
    per_unit: 0.25,
    compliance: &NU,
    of_inputs: BETA.as_flattened(),
    laws: None,
    is_monotone: false,
};

struct Memory {
    storage: ArrayModalStorage<f64, 8, 0, 1, 5>,
    tableau: ArrayTableauStorage<f64, 8, 1>,
}

impl Memory {
    fn new() -> Self {
        Self { storage: ArrayModalStorage::zeros(), tableau: ArrayTableauStorage::zeros() }
    }

    /// Whether the matrix was worked out, how the tick ended with what bound, x and the output.
    fn tick(&mut self, modal: &Modal<'static, f64>, q: f64, h: f64) -> Result<Ticked, Error> {
        let is_new = self.storage.set(modal, &[1.0, q, h])?;
        if is_new {
            self.tableau.reset();
        }
        let (model, mut memory) = self.storage.at(modal);
        let sweeps = Sweeps { omega: 1.0, tolerance: 0.0, most: 0 };
        let mut method = self.tableau.method(&model, 8, sweeps)?;
        let report = modal.tick(&model, &mut method, &mut Deadline::never(), &mut memory)?;
        let output = model.output(0, memory.inputs, &memory.shared, &report)?;
        let x = [memory.shared.iterate.x[0], memory.shared.iterate.x[1]];
        Ok(Ticked { is_new, ended: report.ended, verdict: report.verdict, x, output })
    }
}

#[derive(Debug, PartialEq)]
struct Ticked {
    is_new: bool,
    ended: Ended,
    verdict: Verdict<f64>,
    x: [f64; 2],
    output: f64,
}

/// The answer by hand: x of two edges, whichever of them touch.
fn by_hand(q: f64, h: f64) -> ([f64; 2], f64) {
    let t = (h - 2.5) / 4.0;
    let gain = NU.map(|nu| t / (1.0 + t * nu));
    let given = BETA.map(|beta| beta[0] + beta[1] * q);
    let alpha = [[0.5, 0.25], [0.0, -0.5]];
    let entry = |i: usize, j: usize| {
        MATRIX[0][i][j] + gain[0] * alpha[0][i] * alpha[0][j] + gain[1] * alpha[1][i] * alpha[1][j]
    };
    let load = |i: usize| {
        [1.0, 0.5 + q][i] - gain[0] * alpha[0][i] * given[0] - gain[1] * alpha[1][i] * given[1]
    };
    let determinant = entry(0, 0) * entry(1, 1) - entry(0, 1) * entry(1, 0);
    let both = [
        (load(0) * entry(1, 1) - load(1) * entry(0, 1)) / determinant,
        (load(1) * entry(0, 0) - load(0) * entry(1, 0)) / determinant,
    ];
    let alone = [load(0) / entry(0, 0), load(1) / entry(1, 1)];
    let x = match both {
        [a, b] if a >= 0.0 && b >= 0.0 => both,
        _ if alone[0] > 0.0 && entry(1, 0) * alone[0] >= load(1) => [alone[0], 0.0],
        _ if alone[1] > 0.0 && entry(0, 1) * alone[1] >= load(0) => [0.0, alone[1]],
        _ => [0.0, 0.0],
    };
    let amplitude = |k: usize| gain[k] * (given[k] + alpha[k][0] * x[0] + alpha[k][1] * x[1]);
    (x, q + 2.0 * amplitude(0) - amplitude(1) + x[0] + 4.0 * x[1])
}

#[test]
fn ticks_follow_the_coefficient() -> Result<(), Error> {
    let mut memory = Memory::new();
    let mut sides = [false; 4];
    let mut last = f64::NAN;
    for (q, h) in [
        (0.0, 2.5),
        (0.0, 6.5),
        (-2.0, 6.5),
        (-2.0, 2.5),
        (1.0, 18.5),
        (-9.0, 18.5),
        (0.25, 3.5),
        (0.25, 3.5),
        (7.0, 2.5),
    ] {
        let found = memory.tick(&MODEL, q, h)?;
        let (x, output) = by_hand(q, h);
        assert_eq!((found.is_new, found.ended), (h != last, Ended::Exact), "{q} {h}");
        for (found, expected) in
            found.x.iter().chain([&found.output]).zip(x.iter().chain([&output]))
        {
            assert!(
                (found - expected).abs() <= 1e-14 * (1.0 + expected.abs()),
                "{q} {h}: {found} {expected}"
            );
        }
        sides[usize::from(x[0] > 0.0) + 2 * usize::from(x[1] > 0.0)] = true;
        last = h;
    }
    assert!(sides[1] && sides[3], "{sides:?}");
    Ok(())
}

#[test]
fn a_reset_and_a_refusal_leave_what_was() -> Result<(), Error> {
    let (mut one, mut other) = (Memory::new(), Memory::new());
    for (q, h) in [(0.0, 3.5), (0.5, 3.5), (-1.0, 10.5)] {
        for refused in [[f64::NAN, h], [1e308, 4.5], [0.0, f64::INFINITY]] {
            assert!(
                one.storage.set(&MODEL, &[1.0, refused[0], refused[1]]).is_err(),
                "{refused:?}"
            );
        }
        assert_eq!(one.tick(&MODEL, q, h), other.tick(&MODEL, q, h), "{q} {h}");
    }
    let first = Memory::new().tick(&MODEL, 0.0, 10.5);
    one.storage.reset();
    assert_eq!(one.tick(&MODEL, 0.0, 10.5), first);
    assert!(one.storage.set(&MODEL, &[1.0, 0.0]).is_err());
    Ok(())
}

#[test]
fn entries_above_0_are_left_out_where_none_should_be() -> Result<(), Error> {
    // At t = 4 the entry off the diagonal is −¼ + ⅘/8 and less; another first mode makes it positive.
    let load = {
        let mut load = LOAD;
        (load[24], load[25]) = (1.0, 1.0);
        load
    };
    let load: &'static [f64] = Box::leak(Box::new(load));
    let plain = Modal { model: Condensed { load, ..MODEL.model }, ..MODEL };
    let monotone = Modal { is_monotone: true, ..plain };
    for (modal, expected) in [(plain, 0.8 - 0.25), (monotone, 0.0)] {
        let mut memory = Memory::new();
        memory.storage.set(&modal, &[1.0, 0.0, 18.5])?;
        let (model, _) = memory.storage.at(&modal);
        let [block] = model.matrix else { panic!("one block") };
        assert!((block[0][1] - expected).abs() < 1e-15 && block[0][1] == block[1][0], "{block:?}");
        assert!(block[0][0] > 1.7 && block[1][1] > 1.7);
    }
    Ok(())
}

/// F and F_π of ones on the diagonal: the bound is U ((1 + t) ‖z‖²)^½, z = (p, y, x).
#[test]
fn the_bound_is_that_of_both_forms() -> Result<(), Error> {
    let mut columns = [0.0; 28];
    (0..7).for_each(|j| columns[(j + 1) * (j + 2) / 2 - 1] = 1.0);
    let ones = Factor { columns: &columns, norms: &[1.0; 7] };
    let form = Form {
        factor: ones,
        jump: None,
        vertices: &[],
        corners: &[],
        sides: Sides::UNLIMITED,
        stability: 1.0,
        floating: &[],
        oscillation: &[0.0; 5],
        row_sum: 2.0,
        largest_load: &[1.0; 5],
        unit: 8.0,
    };
    let certificate = Some(form);
    let with_laws =
        Modal { model: Condensed { certificate, ..MODEL.model }, laws: Some(ones), ..MODEL };
    for (q, h) in [(0.0, 2.5), (0.5, 6.5), (-2.0, 18.5)] {
        let mut storage = ArrayModalStorage::<f64, 8, 7, 1, 5>::zeros();
        storage.set(&with_laws, &[1.0, q, h])?;
        let (model, mut memory) = storage.at(&with_laws);
        let mut sweeps = Sweeps { omega: 1.0, tolerance: 1e-16, most: 99 };
        let report = with_laws.tick(&model, &mut sweeps, &mut Deadline::never(), &mut memory)?;
        let x = &memory.shared.iterate.x[..2];
        let square: f64 = memory.inputs.iter().chain(x).map(|z| z * z).sum();
        let expected = 8.0 * ((1.0 + (h - 2.5) / 4.0) * square).sqrt();
        let found = report.certificate().map(|known| known.duality_gap);
        let is_near = |found: f64| (found / expected - 1.0).abs() < 1e-14;
        assert!(found.is_some_and(is_near), "{q} {h}: {found:?} {expected}");
    }
    Ok(())
}

/// An output of amplitude `k` times a factor. Before anything changes it is refused where it might overflow: x is at most
/// ‖b‖/(64 ε), so that y is at most g (|β·p| + Σ|α| ‖b‖/(64 ε)).
#[test]
fn outputs_that_amplitudes_may_bring_to_overflow_are_refused() -> Result<(), Error> {
    let (q, h) = (-0.75, 10.5);
    let t = (h - 2.5) / 4.0;
    let gain = NU.map(|nu| t / (1.0 + t * nu));
    let given = BETA.map(|beta| beta[0] + beta[1] * q);
    // The second mode knows of both edges: α = (⅛, −½).
    let mut columns = LOAD;
    columns[32] = 0.125;
    let load = [
        1.0 - gain[0] * 0.5 * given[0] - gain[1] * 0.125 * given[1],
        0.5 + q - gain[0] * 0.25 * given[0] + gain[1] * 0.5 * given[1],
    ];
    let room = load[0].hypot(load[1]) / (64.0 * f64::EPSILON);
    let of_alpha = [0.75, 0.625];
    for k in 0..2 {
        let most = gain[k] * (given[k].abs() + of_alpha[k] * room);
        for (share, is_refused) in [(1.0 - 1e-9, false), (1.0 + 1e-9, true)] {
            let mut of_inputs = [0.0; 5];
            of_inputs[3 + k] = share / most * f64::MAX;
            let outputs = [Measure::Linear { of_inputs: &of_inputs, of_contact: &[0.0; 2] }];
            let modal = Modal {
                model: Condensed { load: &columns, outputs: &outputs, ..MODEL.model },
                ..MODEL
            };
            let set = Memory::new().storage.set(&modal, &[1.0, q, h]);
            assert_eq!(set.is_err(), is_refused, "{k} {share}: {set:?}");
        }
    }
    Ok(())
}

#[test]
fn a_report_says_whether_a_bound_was_asked_for() -> Result<(), Error> {
    for (has_bound, expected) in [(true, Verdict::NotAsked), (false, Verdict::Unavailable)] {
        let modal = Modal { model: Condensed { has_bound, ..MODEL.model }, ..MODEL };
        assert_eq!(Memory::new().tick(&modal, 0.0, 3.5)?.verdict, expected);
    }
    Ok(())
}

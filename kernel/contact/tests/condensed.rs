//! The condensed problem: its two solvers against each other and against complementarity itself.

use crate::memory::{Dense, Draw, bare};
use crate::strip::Strip;
use signorini_contact::Condensed;
use signorini_contact::dense::blocks::{self, Blocks, SIDE, padded};
use signorini_contact::dense::ranges::Given;
use signorini_contact::dense::sor;
use signorini_contact::dense::tableau::{InitialTableau, Tableau};
use signorini_contact::method::{Method, Pivots, Sweeps};
use signorini_contact::storage::{ArrayStorage, ArrayTableauStorage, Storage};
use signorini_kernel::error::Array;
use signorini_kernel::limits::Deadline;
use signorini_kernel::report::Ended;
use signorini_kernel::{Error, Real};
use signorini_tolerances::Tolerance;
use signorini_tolerances::kernel::{CONDENSED, CONDENSED_NARROW, CONDENSED_SWEPT, TABLEAU};

/// A strip and memory to solve on it.
struct Work<'s, R> {
    strip: &'s Strip<R>,
    memory: Dense<R>,
}

impl<'s, R: Real> Work<'s, R> {
    fn new(strip: &'s Strip<R>) -> Result<Self, Error> {
        Ok(Self { strip, memory: Dense::of(&strip.matrix()?, strip.order)? })
    }

    fn exact(&mut self, load: &[R], most: u32) -> Result<(Ended, u32), Error> {
        let (matrix, (tableau, iterate)) = (self.strip.matrix()?, self.memory.parts()?);
        let sweeps = Sweeps { omega: R::ONE, tolerance: R::ZERO, most: 3 };
        let start = InitialTableau::untouched(&matrix);
        let mut method = Pivots { tableau, start, most, sweeps };
        let given = Given::above(load);
        let progress = method.solve(&matrix, given, iterate, &mut Deadline::never())?;
        Ok((progress.ended, progress.pivots))
    }

    /// max |min(x_i, r_i)| relative to the largest x_i.
    fn defect(&self) -> R {
        let Dense { x, residual, .. } = &self.memory;
        assert!(x.iter().all(|x| *x >= R::ZERO));
        let pairs = x.iter().zip(residual);
        let largest = x.iter().fold(R::ONE, |most, &x| most.or_larger(x));
        R::ONE / largest
            * pairs.fold(R::ZERO, |most, (&x, &r)| most.or_larger(x.or_smaller(r).magnitude()))
    }
}

/// Loads that push a different part of the edge in every time.
fn load<R: Real>(strip: &Strip<R>, tick: u32, random: &mut Draw) -> Vec<R> {
    strip.load(f64::from(tick % 7) * 0.1 - 0.3, random)
}

fn solves_exactly<R: Real + Into<f64>>(allowed: Tolerance) -> Result<(), Error> {
    for columns in [1, 2, 5, 16, 33] {
        let strip = Strip::<R>::new(columns);
        let (mut work, mut random) = (Work::new(&strip)?, Draw(7));
        let mut sides = [0, 0];
        for tick in 0..200 {
            let load = load(&strip, tick, &mut random);
            let (ended, _) = work.exact(&load, 1000)?;
            assert_eq!(ended, Ended::Exact, "{columns} edges, tick {tick}");
            allowed.check(format_args!("{columns} edges, tick {tick}"), work.defect());
            work.memory.x.iter().for_each(|x| sides[usize::from(*x > R::ZERO)] += 1);
        }
        assert!(sides[0] > 0 && sides[1] > 0, "{columns}: one side only, {sides:?}");
    }
    Ok(())
}

#[test]
fn pivoting_solves_exactly_tick_after_tick() -> Result<(), Error> {
    solves_exactly::<f64>(CONDENSED)?;
    solves_exactly::<f32>(CONDENSED_NARROW)
}

#[test]
fn sweeps_come_to_the_same() -> Result<(), Error> {
    let strip = Strip::<f64>::new(19);
    let (mut work, mut random) = (Work::new(&strip)?, Draw(3));
    for tick in 0..20 {
        let load = load(&strip, tick, &mut random);
        work.exact(&load, 1000)?;
        let mut sweeps = Sweeps { omega: 1.4, tolerance: 1e-14, most: 1000 };
        let mut memory = Dense::new(19);
        let progress = memory.solve(&mut sweeps, &strip.matrix()?, Given::above(&load))?;
        assert_eq!(progress.ended, Ended::Settled);
        for (a, b) in memory.x.iter().zip(&work.memory.x) {
            CONDENSED_SWEPT.check_over(format_args!("tick {tick}"), a - b, 1.0 + b);
        }
    }
    Ok(())
}

#[test]
fn sweeps_need_an_omega_between_0_and_2() -> Result<(), Error> {
    let strip = Strip::<f64>::new(4);
    for (omega, fits) in [(0.0, false), (2.0, false), (-1.0, false), (2.5, false), (1.0, true)] {
        let mut sweeps = Sweeps { omega, tolerance: 0.0, most: 1 };
        let given = Given::above(&[0.0; 8]);
        let solved = Dense::new(4).solve(&mut sweeps, &strip.matrix()?, given);
        assert_eq!(solved.is_ok(), fits, "{omega}");
    }
    Ok(())
}

#[test]
fn a_cap_on_exchanges_spreads_them_over_ticks() -> Result<(), Error> {
    let strip = Strip::<f64>::new(32);
    let (mut work, mut random) = (Work::new(&strip)?, Draw(5));
    let load = strip.load(0.1, &mut random);
    let mut last = 0;
    for tick in 0..32 {
        let (ended, pivots) = work.exact(&load, 3)?;
        assert!(pivots <= 3);
        last = tick;
        if ended == Ended::Exact {
            break;
        }
        assert_eq!(ended, Ended::OutOfSweeps);
        assert!(work.memory.x.iter().all(|x| *x >= 0.0));
    }
    assert!(last > 2 && last < 31, "{last}");
    CONDENSED.check("the cap", work.defect());
    Ok(())
}

#[test]
fn exchanges_undo_each_other() -> Result<(), Error> {
    let strip = Strip::<f64>::new(9);
    let (mut work, mut z) = (Work::new(&strip)?, vec![0.0; 16]);
    let before = work.memory.blocks.clone();
    let (mut tableau, _) = work.memory.parts()?;
    for k in [3, 7, 7, 7, 0, 3, 0, 7, 2, 2, 5] {
        assert!(tableau.exchange(k, &mut z)?);
    }
    // Whoever asks for an answer sees all exchanges.
    tableau.answer(&[0.0; 16], &mut z)?;
    assert!(tableau.exchange(5, &mut z)?);
    tableau.answer(&[0.0; 16], &mut z)?;
    assert_eq!(tableau.exchanged(), [false; 16]);
    let entries = work.memory.blocks.as_flattened().as_flattened().iter();
    for (a, b) in entries.zip(before.as_flattened().as_flattened()) {
        TABLEAU.check("an entry", a - b);
    }
    Ok(())
}

#[test]
fn a_worn_tableau_is_noticed_and_built_anew() -> Result<(), Error> {
    let strip = Strip::<f32>::new(16);
    let (mut work, mut random) = (Work::new(&strip)?, Draw(11));
    let load = strip.load(0.0, &mut random);
    work.exact(&load, 1000)?;
    work.memory
        .blocks
        .as_flattened_mut()
        .as_flattened_mut()
        .iter_mut()
        .for_each(|entry| *entry *= 3.0);
    let (ended, _) = work.exact(&load, 1000)?;
    assert_eq!(ended, Ended::OutOfSweeps);
    let (ended, _) = work.exact(&load, 1000)?;
    assert_eq!(ended, Ended::Exact);
    CONDENSED_NARROW.check("built anew", work.defect());
    Ok(())
}

fn recovers<R: Real + Into<f64>>() -> Result<(), Error> {
    let strip = Strip::<R>::partly_loose(12);
    let mut work = Work::new(&strip)?;
    let number = |x: f64| R::from_f64(x).unwrap_or(R::ZERO);
    let load = |mean: f64| -> Vec<R> {
        let entry = |i: usize| if i < 24 { mean + 0.3 * (i as f64).sin() } else { 0.0 };
        (0..padded(24)).map(entry).map(number).collect()
    };
    for pull in [0.01, 0.1, 0.5, 20.0, 1e4] {
        for _ in 0..4 {
            let (ended, _) = work.exact(&load(pull), 48)?;
            assert_ne!(ended, Ended::Exact, "{pull}: nothing holds it");
            assert!(work.memory.x.iter().all(|x| *x >= R::ZERO && x.finite()));
        }
        let (ended, _) = work.exact(&load(-0.1), 48)?;
        assert_eq!(ended, Ended::Exact, "after {pull}");
        CONDENSED_NARROW.check(format_args!("after {pull}"), work.defect());
    }
    Ok(())
}

#[test]
fn loads_without_a_solution_leave_no_trace() -> Result<(), Error> {
    recovers::<f64>()?;
    recovers::<f32>()
}

#[test]
fn a_sweep_is_gauss_seidel() -> Result<(), Error> {
    let strip = Strip::<f64>::new(10);
    let mut random = Draw(2);
    let load = strip.load(-0.3, &mut random);
    let (mut x, mut naive) = (vec![0.1; 10], vec![0.1_f64; 10]);
    x.resize(16, 0.0);
    for _ in 0..5 {
        sor::sweep(&strip.matrix()?, Given::above(&load), 1.3, &mut x)?;
        for i in 0..10 {
            let product: f64 = (0..10).map(|j| strip.at(i, j) * naive[j]).sum();
            naive[i] = (naive[i] + 1.3 * (load[i] - product)).max(0.0);
        }
    }
    TABLEAU.check_each("five sweeps", &x[..10], &naive);
    assert!(x.contains(&0.0) && x.iter().any(|&x| x > 0.0), "{x:?}");
    Ok(())
}

#[test]
fn wrong_lengths_are_refused() -> Result<(), Error> {
    let strip = Strip::<f64>::new(5);
    let length = |of, found, expected| Some(Error::Length { of, found, expected });
    assert_eq!(Blocks::new(strip.blocks(), 9).err(), length(Array::MatrixValues, 1, 3));
    let matrix = strip.matrix()?;
    for (x, flags, sum) in [(16, 16, 16), (8, 8, 5), (5, 8, 8)] {
        let (x, flags, mut y) = (vec![0.0; x], vec![true; flags], vec![0.0; sum]);
        let refused = blocks::multiply_add(&matrix, &x, &flags, &mut y).err();
        let found = if x.len() == 8 { sum } else { x.len() };
        assert_eq!(refused, length(Array::Unknowns, found, 8));
    }
    let swept = |load: &[f64], x: &mut [f64]| sor::sweep(&matrix, Given::above(load), 1.0, x).err();
    assert_eq!(swept(&[0.0; 5], &mut [0.0; 8]), length(Array::Load, 5, 8));
    assert_eq!(swept(&[0.0; 8], &mut [0.0; 5]), length(Array::Unknowns, 5, 8));
    let mut room = [[[0.0_f64; SIDE]; SIDE]; 1];
    let mut tableau = |exchanged: usize, columns: [usize; 2]| {
        let [mut column, mut next] = columns.map(|length| vec![0.0; length]);
        let exchanged = &mut vec![false; exchanged];
        Tableau::new(5, &mut room, exchanged, [&mut column, &mut next]).err()
    };
    assert_eq!(tableau(8, [8, 5]), length(Array::Scratch, 5, 8));
    assert_eq!(tableau(16, [16, 16]), length(Array::Contact, 16, 8));
    Ok(())
}

#[test]
fn storage_takes_the_model_s_start_over_once() -> Result<(), Error> {
    const PADDED: usize = 8;
    let strip = Strip::<f64>::new(5);
    let given = [0.25; PADDED];
    let nothing = [false; PADDED];
    let model = Condensed {
        contact: strip.order,
        matrix: strip.blocks(),
        x: &given,
        start: InitialTableau { blocks: strip.blocks(), exchanged: &nothing },
        ..bare()
    };
    let mut storage = ArrayStorage::<f64, PADDED, 0>::zeros();
    assert_eq!(storage.memory(&model).iterate.x, given);
    storage.memory(&model).iterate.x.fill(0.5);
    assert_eq!(storage.memory(&model).iterate.x, [0.5; PADDED]);
    storage.reset();
    assert_eq!(storage.memory(&model).iterate.x, given);

    let mut vectors = Storage::of(vec![7.0; PADDED], vec![1; PADDED], vec![7.0; 3], []);
    let lent = vectors.memory(&model);
    lent.iterate.open[1] = false;
    lent.combination[2] = 0.5;
    assert_eq!(vectors.x::<f64>(), given);
    assert_eq!(vectors.open()[..3], [1, 0, 1]);
    assert_eq!(vectors.combination::<f64>(), [7.0, 7.0, 0.5]);

    let mut tableau = ArrayTableauStorage::<f64, PADDED, 1>::zeros();
    let load = strip.load(0.3, &mut Draw(1));
    let mut pivots = Vec::new();
    for _ in 0..2 {
        let lent = storage.memory(&model);
        let sweeps = Sweeps { omega: 1.0, tolerance: 0.0, most: 0 };
        let mut method = tableau.method(&model, 100, sweeps)?;
        let progress = method.solve(
            &strip.matrix()?,
            Given::above(&load),
            lent.iterate,
            &mut Deadline::never(),
        )?;
        assert_eq!(progress.ended, Ended::Exact);
        pivots.push(progress.pivots);
    }
    assert!(pivots[0] > 0 && pivots[1] == 0, "{pivots:?}: the tableau stays where it was");
    Ok(())
}

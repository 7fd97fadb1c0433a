//! The condensed problem: its two solvers against each other and against complementarity itself.

#[path = "condensed/strip.rs"]
mod strip;

use signorini_contact::Condensed;
use signorini_contact::dense::blocks::{self, Block, Blocks, SIDE, padded};
use signorini_contact::dense::ranges::Given;
use signorini_contact::dense::tableau::{InitialTableau, Tableau};
use signorini_contact::dense::{Iterate, sor};
use signorini_contact::method::{Method, Pivots, Sweeps};
use signorini_contact::spans::SpanColumns;
use signorini_contact::storage::{ArrayStorage, ArrayTableauStorage, Storage};
use signorini_kernel::error::Array;
use signorini_kernel::limits::Deadline;
use signorini_kernel::report::Ended;
use signorini_kernel::{Error, Real};
use signorini_tolerances::Tolerance;
use signorini_tolerances::kernel::{CONDENSED, CONDENSED_NARROW, CONDENSED_SWEPT, TABLEAU};
use strip::{Random, Strip};

/// Owned memory of a solve.
struct Work<R> {
    x: Vec<R>,
    residual: Vec<R>,
    scratch: Vec<R>,
    open: Vec<bool>,
    blocks: Vec<Block<R>>,
    exchanged: Vec<bool>,
    columns: [Vec<R>; 2],
}

impl<R: Real> Work<R> {
    fn new(strip: &Strip<R>) -> Result<Self, Error> {
        let n = padded(strip.order);
        let mut work = Self {
            x: vec![R::ZERO; n],
            residual: vec![R::ZERO; n],
            scratch: vec![R::ZERO; n],
            open: vec![false; n],
            blocks: vec![[[R::ZERO; SIDE]; SIDE]; blocks::count(n)],
            exchanged: vec![false; n],
            columns: [vec![R::ZERO; n], vec![R::ZERO; n]],
        };
        let Work { blocks, exchanged, columns: [column, next], .. } = &mut work;
        let exchanged_at_first = vec![false; n];
        let start = InitialTableau { blocks: strip.blocks(), exchanged: &exchanged_at_first };
        Tableau::new(strip.order, blocks, exchanged, [column, next])?.reset(&start)?;
        Ok(work)
    }

    fn exact(&mut self, strip: &Strip<R>, load: &[R], most: u32) -> Result<(Ended, u32), Error> {
        let Work { x, residual, scratch, open, blocks, exchanged, columns: [column, next] } = self;
        let tableau = Tableau::new(strip.order, blocks, exchanged, [column, next])?;
        let sweeps = Sweeps { omega: R::ONE, tolerance: R::ZERO, most: 3 };
        let nothing = vec![false; padded(strip.order)];
        let start = InitialTableau { blocks: strip.blocks(), exchanged: &nothing };
        let mut method = Pivots { tableau, start, most, sweeps };
        let progress = method.solve(
            &strip.matrix()?,
            Given::above(load),
            Iterate { x, residual, scratch, open },
            &mut Deadline::never(),
        )?;
        Ok((progress.ended, progress.pivots))
    }

    /// max |min(x_i, r_i)| relative to the largest x_i.
    fn defect(&self) -> R {
        assert!(self.x.iter().all(|x| *x >= R::ZERO));
        let pairs = self.x.iter().zip(&self.residual);
        let largest = self.x.iter().fold(R::ONE, |most, &x| most.or_larger(x));
        R::ONE / largest
            * pairs.fold(R::ZERO, |most, (&x, &r)| most.or_larger(x.or_smaller(r).magnitude()))
    }
}

/// Loads that push a different part of the edge in every time.
fn load<R: Real>(strip: &Strip<R>, tick: u32, random: &mut Random) -> Vec<R> {
    strip.load(f64::from(tick % 7) * 0.1 - 0.3, random)
}

fn solves_exactly<R: Real + Into<f64>>(allowed: Tolerance) -> Result<(), Error> {
    for columns in [1, 2, 5, 16, 33] {
        let strip = Strip::<R>::new(columns);
        let (mut work, mut random) = (Work::new(&strip)?, Random::new(7));
        let mut sides = [0, 0];
        for tick in 0..200 {
            let load = load(&strip, tick, &mut random);
            let (ended, _) = work.exact(&strip, &load, 1000)?;
            assert_eq!(ended, Ended::Exact, "{columns} edges, tick {tick}");
            allowed.check(format_args!("{columns} edges, tick {tick}"), work.defect());
            work.x.iter().for_each(|x| sides[usize::from(*x > R::ZERO)] += 1);
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
    let (mut work, mut random) = (Work::new(&strip)?, Random::new(3));
    for tick in 0..20 {
        let load = load(&strip, tick, &mut random);
        work.exact(&strip, &load, 1000)?;
        let (mut x, mut residual, mut scratch) = (vec![0.0; 24], vec![0.0; 24], vec![0.0; 24]);
        let open = &mut [false; 24];
        let mut sweeps = Sweeps { omega: 1.4, tolerance: 1e-14, most: 1000 };
        let iterate = Iterate { x: &mut x, residual: &mut residual, scratch: &mut scratch, open };
        let progress =
            sweeps.solve(&strip.matrix()?, Given::above(&load), iterate, &mut Deadline::never())?;
        assert_eq!(progress.ended, Ended::Settled);
        for (a, b) in x.iter().zip(&work.x) {
            CONDENSED_SWEPT.check_over(format_args!("tick {tick}"), a - b, 1.0 + b);
        }
    }
    Ok(())
}

#[test]
fn sweeps_need_an_omega_between_0_and_2() -> Result<(), Error> {
    let strip = Strip::<f64>::new(4);
    let [mut x, mut residual, mut scratch] = [[0.0; 8]; 3];
    for (omega, fits) in [(0.0, false), (2.0, false), (-1.0, false), (2.5, false), (1.0, true)] {
        let (x, residual, scratch) = (&mut x[..], &mut residual[..], &mut scratch[..]);
        let iterate = Iterate { x, residual, scratch, open: &mut [false; 8] };
        let mut sweeps = Sweeps { omega, tolerance: 0.0, most: 1 };
        let solved = sweeps.solve(
            &strip.matrix()?,
            Given::above(&[0.0; 8]),
            iterate,
            &mut Deadline::never(),
        );
        assert_eq!(solved.is_ok(), fits, "{omega}");
    }
    Ok(())
}

#[test]
fn a_cap_on_exchanges_spreads_them_over_ticks() -> Result<(), Error> {
    let strip = Strip::<f64>::new(32);
    let (mut work, mut random) = (Work::new(&strip)?, Random::new(5));
    let load = strip.load(0.1, &mut random);
    let mut last = 0;
    for tick in 0..32 {
        let (ended, pivots) = work.exact(&strip, &load, 3)?;
        assert!(pivots <= 3);
        last = tick;
        if ended == Ended::Exact {
            break;
        }
        assert_eq!(ended, Ended::OutOfSweeps);
        assert!(work.x.iter().all(|x| *x >= 0.0));
    }
    assert!(last > 2 && last < 31, "{last}");
    CONDENSED.check("the cap", work.defect());
    Ok(())
}

#[test]
fn exchanges_undo_each_other() -> Result<(), Error> {
    let strip = Strip::<f64>::new(9);
    let (mut work, mut z) = (Work::new(&strip)?, vec![0.0; 16]);
    let before = work.blocks.clone();
    let Work { blocks, exchanged, columns: [column, next], .. } = &mut work;
    let mut tableau = Tableau::new(9, blocks, exchanged, [column, next])?;
    for k in [3, 7, 7, 7, 0, 3, 0, 7, 2, 2, 5] {
        assert!(tableau.exchange(k, &mut z)?);
    }
    // Whoever asks for an answer sees all exchanges.
    tableau.answer(&[0.0; 16], &mut z)?;
    assert!(tableau.exchange(5, &mut z)?);
    tableau.answer(&[0.0; 16], &mut z)?;
    assert_eq!(tableau.exchanged(), [false; 16]);
    let entries = work.blocks.as_flattened().as_flattened().iter();
    for (a, b) in entries.zip(before.as_flattened().as_flattened()) {
        TABLEAU.check("an entry", a - b);
    }
    Ok(())
}

#[test]
fn a_worn_tableau_is_noticed_and_built_anew() -> Result<(), Error> {
    let strip = Strip::<f32>::new(16);
    let (mut work, mut random) = (Work::new(&strip)?, Random::new(11));
    let load = strip.load(0.0, &mut random);
    work.exact(&strip, &load, 1000)?;
    work.blocks.as_flattened_mut().as_flattened_mut().iter_mut().for_each(|entry| *entry *= 3.0);
    let (ended, _) = work.exact(&strip, &load, 1000)?;
    assert_eq!(ended, Ended::OutOfSweeps);
    let (ended, _) = work.exact(&strip, &load, 1000)?;
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
            let (ended, _) = work.exact(&strip, &load(pull), 48)?;
            assert_ne!(ended, Ended::Exact, "{pull}: nothing holds it");
            assert!(work.x.iter().all(|x| *x >= R::ZERO && x.finite()));
        }
        let (ended, _) = work.exact(&strip, &load(-0.1), 48)?;
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
    let mut random = Random::new(2);
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
    assert_eq!(
        Blocks::new(strip.blocks(), 9).err(),
        Some(Error::Length { of: Array::MatrixValues, found: 1, expected: 3 })
    );
    let matrix = strip.matrix()?;
    assert_eq!(
        blocks::multiply_add(&matrix, &[0.0; 16], &[true; 16], &mut [0.0; 16]).err(),
        Some(Error::Length { of: Array::Unknowns, found: 16, expected: 8 })
    );
    assert_eq!(
        blocks::multiply_add(&matrix, &[0.0; 8], &[true; 8], &mut [0.0; 5]).err(),
        Some(Error::Length { of: Array::Unknowns, found: 5, expected: 8 })
    );
    assert_eq!(
        blocks::multiply_add(&matrix, &[0.0; 5], &[true; 8], &mut [0.0; 8]).err(),
        Some(Error::Length { of: Array::Unknowns, found: 5, expected: 8 })
    );
    assert_eq!(
        sor::sweep(&matrix, Given::above(&[0.0; 5]), 1.0, &mut [0.0; 8]).err(),
        Some(Error::Length { of: Array::Load, found: 5, expected: 8 })
    );
    assert_eq!(
        sor::sweep(&matrix, Given::above(&[0.0; 8]), 1.0, &mut [0.0; 5]).err(),
        Some(Error::Length { of: Array::Unknowns, found: 5, expected: 8 })
    );
    let mut room = [[[0.0_f64; SIDE]; SIDE]; 1];
    assert_eq!(
        Tableau::new(5, &mut room, &mut [false; 8], [&mut [0.0; 8], &mut [0.0; 5]]).err(),
        Some(Error::Length { of: Array::Scratch, found: 5, expected: 8 })
    );
    assert_eq!(
        Tableau::new(5, &mut room, &mut [false; 16], [&mut [0.0; 16], &mut [0.0; 16]]).err(),
        Some(Error::Length { of: Array::Contact, found: 16, expected: 8 })
    );
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
        load: &[],
        limits: &[],
        spans: SpanColumns::UNLIMITED,
        outputs: &[],
        certificate: None,
        has_bound: false,
    };
    let mut storage = ArrayStorage::<f64, PADDED, 0>::zeros();
    assert_eq!(storage.memory(&model).iterate.x, given);
    storage.memory(&model).iterate.x.fill(0.5);
    assert_eq!(storage.memory(&model).iterate.x, [0.5; PADDED]);
    storage.reset();
    assert_eq!(storage.memory(&model).iterate.x, given);

    let mut vectors = Storage::of(vec![7.0; PADDED], vec![true; PADDED], vec![7.0; 3], []);
    let lent = vectors.memory(&model);
    lent.iterate.open[1] = false;
    lent.combination[2] = 0.5;
    assert_eq!(vectors.x::<f64>(), given);
    assert_eq!(vectors.open()[..3], [true, false, true]);
    assert_eq!(vectors.combination::<f64>(), [7.0, 7.0, 0.5]);

    let mut tableau = ArrayTableauStorage::<f64, PADDED, 1>::zeros();
    let load = strip.load(0.3, &mut Random::new(1));
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

//! Condensed models after inputs of any size: what overflows is refused and leaves every bit where it was, what
//! is answered is answered rightly, and so is the tick after it.

use crate::memory::{Dense, Draw, bare};
use crate::strip::Strip;
use signorini_contact::Condensed;
use signorini_contact::dense::blocks::padded;
use signorini_contact::dense::ranges::Given;
use signorini_contact::dense::tableau::InitialTableau;
use signorini_contact::method::{Pivots, Sweeps};
use signorini_contact::outputs::Measure;
use signorini_kernel::limits::Deadline;
use signorini_kernel::report::{Ended, Report};
use signorini_kernel::{Error, Real};
use signorini_tolerances::kernel::{CONDENSED_NARROW, EXTREME_DEFECT};

const EDGES: usize = 19;

/// Scalars by way of f64, which holds the bits of both.
trait Scalar: Real + Into<f64> {
    fn of(x: f64) -> Self {
        Self::from_f64(x).expect("every number has a nearest one")
    }
    fn wide(self) -> f64 {
        self.into()
    }
    fn bits(self) -> u64 {
        self.wide().to_bits()
    }
}

impl<R: Real + Into<f64>> Scalar for R {}

/// How a controller solves: with a tableau, or by sweeps alone.
#[derive(Debug, Clone, Copy, PartialEq)]
enum How {
    Exchanges(u32),
    Sweeps(u32),
}

/// A strip with two inputs, the second of which lifts and presses.
struct Plate<R> {
    strip: Strip<R>,
    load: Vec<R>,
    outputs: [Vec<R>; 2],
    nothing: Vec<bool>,
}

impl<R: Scalar> Plate<R> {
    fn new(output: f64) -> Self {
        let (strip, mut random) = (Strip::<R>::new(EDGES), Draw(5));
        let [constant, other] = [0.1, -0.2].map(|shift| strip.load(shift, &mut random));
        let of_contact = (0..EDGES).map(|at| R::of(output * (1.0 + at as f64))).collect();
        let outputs = [vec![R::of(0.5), R::of(-0.25)], of_contact];
        let nothing = vec![false; padded(EDGES)];
        Self { strip, load: [constant, other].concat(), outputs, nothing }
    }

    fn with<T>(&self, work: impl FnOnce(&Condensed<R>) -> T) -> T {
        let [of_inputs, of_contact] = &self.outputs;
        work(&Condensed {
            contact: EDGES,
            matrix: self.strip.blocks(),
            start: InitialTableau { blocks: self.strip.blocks(), exchanged: &self.nothing },
            load: &self.load,
            outputs: &[Measure::Linear { of_inputs, of_contact }],
            ..bare()
        })
    }

    /// The largest |min(x_i, (Sx − b)_i)| of an answer, relative to the largest |b_i|, summed in f64.
    fn defect(&self, p: f64, x: &[R]) -> f64 {
        let wide = R::wide;
        let (mut most, mut size) = (0.0_f64, f64::MIN_POSITIVE);
        for i in 0..EDGES {
            let b = wide(self.load[i]) + p * wide(self.load[padded(EDGES) + i]);
            let product: f64 = (0..EDGES).map(|j| wide(self.strip.at(i, j)) * wide(x[j])).sum();
            (most, size) = (most.max((product - b).min(wide(x[i])).abs()), size.max(b.abs()));
        }
        most / size
    }
}

/// Memory of a controller, all of it.
#[derive(Debug, Clone)]
struct Store<R> {
    dense: Dense<R>,
    is_built: bool,
}

impl<R: Scalar> Store<R> {
    fn new() -> Self {
        Self { dense: Dense::new(EDGES), is_built: false }
    }

    /// Ticks with the input `p`; the output is read off as a baked module does.
    fn tick(&mut self, model: &Condensed<R>, how: How, p: f64) -> Result<(R, Report<R>), Error> {
        let (mut tableau, mut memory) = self.dense.ticking()?;
        let inputs = [R::ONE, R::of(p)];
        let sweeps = |most| Sweeps { omega: R::of(1.4), tolerance: R::of(20.0) * R::EPSILON, most };
        let never = &mut Deadline::never();
        let report = match how {
            How::Sweeps(most) => model.tick(&inputs, &mut sweeps(most), never, &mut memory)?,
            How::Exchanges(most) => {
                if !self.is_built {
                    tableau.reset(&model.start)?;
                    self.is_built = true;
                }
                let mut method = Pivots { tableau, start: model.start, most, sweeps: sweeps(20) };
                model.tick(&inputs, &mut method, never, &mut memory)?
            }
        };
        Ok((model.output(0, &inputs, &memory, &report)?, report))
    }

    fn bits(&self) -> (Vec<u64>, Vec<u64>, Vec<bool>) {
        let entries = self.dense.blocks.as_flattened().as_flattened();
        let bits = |numbers: &[R]| numbers.iter().map(|x| x.bits()).collect();
        (bits(&self.dense.x), bits(entries), self.dense.exchanged.clone())
    }
}

const HOWS: [How; 4] = [How::Exchanges(100), How::Exchanges(2), How::Sweeps(400), How::Sweeps(3)];

/// Powers of ten up to the largest number of the scalar, either way.
fn sizes<R: Scalar>() -> impl Iterator<Item = f64> {
    let decades = if R::EPSILON.wide() == f64::EPSILON { 308 } else { 38 };
    (0..=decades).step_by(if decades > 100 { 7 } else { 1 }).flat_map(|decade| {
        let size = 10f64.powi(decade);
        [size, -size]
    })
}

fn answers_rightly<R: Scalar>() -> [u32; 3] {
    let plate = Plate::<R>::new(1.0);
    let [mut refused, mut exact, mut converged] = [0; 3];
    for how in HOWS {
        let mut store = Store::<R>::new();
        for extreme in sizes::<R>() {
            // The extreme one, an ordinary one, and back, from what all the others have left.
            for p in [extreme, 0.7, -extreme, -0.4, extreme] {
                let said = || format!("{how:?}, {extreme:e}: {p:e}");
                match plate.with(|model| store.tick(model, how, p)) {
                    Err(error) => {
                        assert!(matches!(error, Error::NotFinite { .. }) && p.abs() > 1.0);
                        refused += 1;
                    }
                    Ok((output, report)) => {
                        assert!(
                            output.finite() && store.dense.x.iter().all(|x| x.finite()),
                            "{}",
                            said()
                        );
                        if report.ended == Ended::OutOfSweeps {
                            continue;
                        }
                        let defect = plate.defect(p, &store.dense.x);
                        let off = defect / R::EPSILON.wide() * f64::EPSILON;
                        EXTREME_DEFECT.check(format_args!("{}: {report:?}", said()), off);
                        *(if report.ended == Ended::Exact {
                            &mut exact
                        } else {
                            &mut converged
                        }) += 1;
                    }
                }
            }
        }
    }
    [refused, exact, converged]
}

#[test]
fn no_answer_is_called_one_that_is_none() {
    for counted in [answers_rightly::<f32>(), answers_rightly::<f64>()] {
        assert!(counted.iter().all(|count| *count > 50), "{counted:?}");
    }
}

/// Each tick twice, once after one that is refused.
fn refused_ticks_leave_every_bit<R: Scalar>(output: f64) -> u32 {
    let plate = Plate::<R>::new(output);
    let mut refused = 0;
    for how in HOWS {
        let mut store = Store::<R>::new();
        plate.with(|model| store.tick(model, how, 0.5)).expect("an ordinary tick");
        for (at, extreme) in sizes::<R>().chain([f64::NAN, f64::INFINITY]).enumerate() {
            let before = store.bits();
            let mut tried = store.clone();
            if let Err(why) = plate.with(|model| tried.tick(model, how, extreme)) {
                assert!(matches!(why, Error::NotFinite { .. }), "{how:?}, {extreme:e}: {why}");
                refused += 1;
                assert_eq!(tried.bits(), before, "{how:?}, {extreme:e}");
                let ordinary = [0.3, -0.8, 1.7, 0.0][at % 4];
                let [left, right] = [&mut tried, &mut store].map(|store| {
                    let answer = plate.with(|model| store.tick(model, how, ordinary));
                    let (output, report) = answer.expect("an ordinary tick");
                    (output.bits(), report, store.bits())
                });
                assert_eq!(left, right, "{how:?}, {extreme:e}");
            }
        }
    }
    refused
}

#[test]
fn what_is_refused_changes_no_bit() {
    // Loads that overflow, and outputs that do long before.
    for output in [1.0, 1e25] {
        let refused = refused_ticks_leave_every_bit::<f32>(output);
        assert!(refused > if output > 1.0 { 100 } else { 40 }, "{refused}");
    }
    for output in [1.0, 1e200] {
        let refused = refused_ticks_leave_every_bit::<f64>(output);
        assert!(refused > if output > 1.0 { 50 } else { 20 }, "{refused}");
    }
}

/// A heavy load lifts everything, then an ordinary one presses: by sweeps alone it takes some ticks.
#[test]
fn sweeps_come_back_from_what_a_heavy_tick_has_left() {
    let plate = Plate::<f32>::new(1.0);
    for heavy in [1e4, -1e4, 1e12, -1e12, 1e20, -1e20, 1e27, -1e27] {
        let mut store = Store::<f32>::new();
        let mut tick = |p| plate.with(|model| store.tick(model, How::Sweeps(40), p));
        tick(heavy).expect("it is within the range");
        let ended = (0..20).map(|_| tick(0.6).expect("an ordinary tick").1.ended);
        let ticks = ended.take_while(|ended| *ended != Ended::Settled).count();
        assert!(ticks < 12, "{heavy:e}: {ticks}");
        CONDENSED_NARROW.check(format_args!("{heavy:e}"), plate.defect(0.6, &store.dense.x));
    }
}

/// A string that nothing holds: where loads pull it away there is no solution, whatever x has become.
fn a_huge_x_is_none<R: Scalar>() -> Result<(), Error> {
    let strip = Strip::<R>::partly_loose(12);
    let (matrix, size) = (strip.matrix()?, padded(24));
    let load = |pull: f64| -> Vec<R> {
        let entry = |i: usize| if i < 24 { pull * (1.0 + 0.3 * (i as f64).sin()) } else { 0.0 };
        (0..size).map(entry).map(R::of).collect()
    };
    let mut sweeps = Sweeps { omega: R::ONE, tolerance: R::of(20.0) * R::EPSILON, most: 50 };
    let mut memory = Dense::<R>::new(24);
    // Next to the largest numbers a load's size is the sum of its entries: refused beyond 2e29 in f32.
    for decade in 0..29 {
        for pull in [10f64.powi(decade), 1.0, 1e-3] {
            let progress = memory.solve(&mut sweeps, &matrix, Given::above(&load(pull)))?;
            assert_eq!(progress.ended, Ended::OutOfSweeps, "{pull:e} after 1e{decade}");
            assert!(memory.x.iter().all(|x| *x >= R::ZERO && x.finite()));
        }
    }
    Ok(())
}

#[test]
fn without_a_solution_nothing_converges() -> Result<(), Error> {
    a_huge_x_is_none::<f32>()?;
    a_huge_x_is_none::<f64>()
}

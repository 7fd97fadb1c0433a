//! Ticks: warm starts, what ends them, and input that is refused.

use std::cell::Cell;

use crate::numbering::SIDES;
use crate::owned::TickArrays;
use crate::plate::foundation::{Foundation, GAP};
use signorini_bound::certificate::{Certificate, Discretization, Verdict};
use signorini_device::tick::{
    CertifiedSweeps, Data, Deadline, Ended, Limits, Memory, Progress, Report, Tick,
    UncertifiedSweeps,
};
use signorini_kernel::error::Array;
use signorini_kernel::relaxation::Relaxation;
use signorini_kernel::rows::{OwnedRows, QUADS};
use signorini_kernel::stiffness::Stiffness;
use signorini_kernel::{Error, Libm, flux};
use signorini_tolerances::kernel::{ALGEBRAIC, FORCE_OF_FLUX, RESIDUAL};

type PlateTick<'a> = Tick<'a, f64, u16, QUADS>;

/// Rows that know their mesh.
type Own<const UNKNOWNS: usize> = OwnedRows<f64, u16, QUADS, UNKNOWNS>;

fn arrays(foundation: &Foundation) -> Result<TickArrays<f64>, Error> {
    let mut arrays = TickArrays::new(&foundation.plate.edges()?, foundation.plate.vertices.len());
    // What was there before does not matter.
    arrays.active.fill(true);
    Ok(arrays)
}

/// Goes on from the last tick, with rows that lie elsewhere.
fn resumed<'a, const UNKNOWNS: usize>(
    arrays: &'a mut TickArrays<f64>,
    foundation: &'a Foundation,
    rows: &'a mut Own<UNKNOWNS>,
    progress: Progress<f64>,
) -> Result<PlateTick<'a>, Error> {
    let discretization = foundation.discretization()?;
    let rows = rows.of(&discretization.edges)?;
    let memory = Memory { rows, ..arrays.memory(&discretization.edges)? };
    Tick::resume(discretization, memory, progress)
}

fn on<'a>(
    arrays: &'a mut TickArrays<f64>,
    discretization: Discretization<'a, f64, u16>,
) -> Result<PlateTick<'a>, Error> {
    let memory = arrays.memory(&discretization.edges)?;
    Tick::new(discretization, memory, Relaxation::Adaptive(1.0))
}

fn cold<'a>(
    arrays: &'a mut TickArrays<f64>,
    foundation: &'a Foundation,
) -> Result<PlateTick<'a>, Error> {
    on(arrays, foundation.discretization()?)
}

/// A tick with these data, by sweeps with certificates.
fn certified(
    tick: &mut PlateTick,
    data: Data<f64, u16>,
    limits: Limits<f64>,
) -> Result<Report<f64>, Error> {
    tick.begin(data)?.advance(CertifiedSweeps(Libm), limits, &mut Deadline::never())
}

/// The same without a bound.
fn uncertified(
    tick: &mut PlateTick,
    data: Data<f64, u16>,
    limits: Limits<f64>,
) -> Result<Report<f64>, Error> {
    tick.begin(data)?.advance(UncertifiedSweeps(Libm), limits, &mut Deadline::never())
}

/// So many sweeps, whatever they come to.
fn exactly(sweeps: u32) -> Limits<f64> {
    Limits { share: 0.0, error: 0.0, sweeps }
}

/// The plate with another gap.
fn with_gap(gap: f64, foundation: &Foundation) -> Foundation {
    let mut other = foundation.with(1.0, |_, _| gap);
    other.gap.fill([gap; 2]);
    other
}

fn certificate(report: &Report<f64>) -> Certificate<f64> {
    *report.verdict.certificate().expect("a bound")
}

#[test]
fn a_tick_goes_on_until_sweeps_buy_nothing_and_the_next_starts_there() -> Result<(), Error> {
    let foundation = Foundation::new(SIDES, false)?;
    let mut store = arrays(&foundation)?;
    let mut tick = cold(&mut store, &foundation)?;
    let cold = certified(&mut tick, foundation.data()?, Limits::default())?;
    assert_eq!(cold.ended, Ended::Settled);
    assert!(certificate(&cold).algebraic <= 0.1 * certificate(&cold).total);
    assert!(cold.active > 0 && cold.figures.changes == cold.active && cold.sweeps > 8, "{cold:?}");
    let warm = certified(&mut tick, foundation.data()?, Limits::default())?;
    assert!(warm.sweeps <= 4 && warm.figures.changes == 0, "{warm:?}");
    assert_eq!(tick.report(), Some(&warm));
    let counts = foundation.plate.edges()?.counts();
    assert!(tick.u()[counts.free..counts.unknowns()].iter().all(|&u| u >= GAP));
    Ok(())
}

#[test]
fn a_tick_resumed_from_its_memory_has_the_bits_of_one_that_went_on() -> Result<(), Error> {
    const UNKNOWNS: usize = 55;
    let foundation = Foundation::new(SIDES, false)?;
    let (mut kept, mut put_down) = (arrays(&foundation)?, arrays(&foundation)?);
    put_down.active.fill(false);
    let mut kept = cold(&mut kept, &foundation)?;
    let mut rows = Own::<UNKNOWNS>::new();
    let mut progress = Progress::new(Relaxation::Adaptive(1.0))?;
    for sweeps in [7, 40, 100, 3] {
        let limits = exactly(sweeps);
        let expected = certified(&mut kept, foundation.data()?, limits)?;
        let mut tick = resumed(&mut put_down, &foundation, &mut rows, progress)?;
        let found = certified(&mut tick, foundation.data()?, limits)?;
        assert_eq!((found, tick.u(), tick.tau()), (expected, kept.u(), kept.tau()));
        progress = tick.progress();
    }
    let none = resumed(&mut put_down, &foundation, &mut rows, Progress::NONE).map(|_| ());
    assert_eq!(none, Err(Error::Relaxation));
    let mut few = Own::<3>::new();
    let refused = resumed(&mut put_down, &foundation, &mut few, progress).err();
    assert_eq!(refused, Some(Error::Length { of: Array::Rows, found: 3, expected: 55 }));
    Ok(())
}

#[test]
fn memory_of_another_size_is_refused() -> Result<(), Error> {
    let foundation = Foundation::new(SIDES, false)?;
    for array in [0, 1, 3, 4] {
        let mut store = arrays(&foundation)?;
        store.numbers[array].pop();
        let refused = cold(&mut store, &foundation).err();
        assert!(matches!(refused, Some(Error::Length { .. })), "array {array}: {refused:?}");
    }
    let mut store = arrays(&foundation)?;
    store.active.pop();
    let refused = cold(&mut store, &foundation).err();
    assert_eq!(refused, Some(Error::Length { of: Array::Contact, found: 4, expected: 5 }));
    Ok(())
}

#[test]
fn limits_and_deadlines_end_it_and_it_can_be_carried_on() -> Result<(), Error> {
    let foundation = Foundation::new(SIDES, false)?;
    let mut store = arrays(&foundation)?;
    let mut tick = cold(&mut store, &foundation)?;
    let mut running = tick.begin(foundation.data()?)?;
    let limits = exactly(3);
    let first = running.advance(CertifiedSweeps(Libm), limits, &mut Deadline::never())?;
    assert_eq!((first.ended, first.sweeps), (Ended::OutOfSweeps, 3));
    let second = running.advance(CertifiedSweeps(Libm), limits, &mut Deadline::never())?;
    assert_eq!((second.ended, second.sweeps), (Ended::OutOfSweeps, 6));
    assert!(certificate(&second).algebraic < certificate(&first).algebraic);

    // 100 units of time, of which a sweep takes 10 and the certificate 25: 7 sweeps.
    let left = Cell::new(100_u32);
    let remaining = || {
        let now = left.get();
        left.set(now - 10);
        now
    };
    let mut deadline = Deadline { remaining, sweep: 10, certificate: 25 };
    let limits = Limits { share: 0.0, ..Limits::default() };
    let third = running.advance(CertifiedSweeps(Libm), limits, &mut deadline)?;
    assert_eq!(third.ended, Ended::OutOfTime);
    assert!(left.get() >= 15 && third.sweeps > 6, "{third:?}, {left:?}");

    let wanted = certificate(&third).total;
    let limits = Limits { share: 0.0, error: wanted, ..Limits::default() };
    let fourth = running.advance(CertifiedSweeps(Libm), limits, &mut Deadline::never())?;
    assert_eq!((fourth.ended, fourth.sweeps), (Ended::Accurate, third.sweeps));
    Ok(())
}

#[test]
fn a_certificate_waits_until_the_sweeps_have_had_as_long() -> Result<(), Error> {
    let foundation = Foundation::new(SIDES, false)?;
    let mut store = arrays(&foundation)?;
    let mut tick = cold(&mut store, &foundation)?;
    // The first one is good enough, whatever it says.
    let limits = Limits { share: f64::MAX, ..Limits::default() };
    for (sweep, certificate, sweeps) in [(0, 0, 4), (10, 25, 4), (10, 125, 12)] {
        let mut deadline = Deadline { remaining: || u32::MAX, sweep, certificate };
        let mut running = tick.begin(foundation.data()?)?;
        let report = running.advance(CertifiedSweeps(Libm), limits, &mut deadline)?;
        assert_eq!((report.ended, report.sweeps), (Ended::Settled, sweeps));
    }
    Ok(())
}

#[test]
fn without_a_certificate_the_iterate_is_the_same_and_tau_is_the_flux_of_it() -> Result<(), Error> {
    let foundation = Foundation::new(SIDES, false)?;
    let (mut with, mut without) = (arrays(&foundation)?, arrays(&foundation)?);
    let (mut with, mut without) = (cold(&mut with, &foundation)?, cold(&mut without, &foundation)?);
    let discretization = foundation.discretization()?;
    for sweeps in [13, 4] {
        let limits = exactly(sweeps);
        let certified = certified(&mut with, foundation.data()?, limits)?;
        let found = uncertified(&mut without, foundation.data()?, limits)?;
        assert_eq!((found.ended, found.sweeps), (Ended::OutOfSweeps, sweeps));
        assert_eq!(found.verdict, Verdict::NotAsked);
        assert_eq!(found.figures.residual, certified.figures.residual);
        assert_eq!(without.u(), with.u());
        let (loads, mut flux) = (foundation.data()?.given.loads, vec![0.0; with.u().len()]);
        let Discretization { edges, stiffness, .. } = &discretization;
        flux::recover(edges, *stiffness, loads, with.u(), &[], &mut flux)?;
        assert_eq!(without.tau(), flux);
        assert_ne!(without.tau(), with.tau());
    }
    Ok(())
}

#[test]
fn without_a_certificate_a_tick_ends_at_rounding_or_out_of_time() -> Result<(), Error> {
    let foundation = Foundation::new(SIDES, false)?;
    let mut store = arrays(&foundation)?;
    let mut tick = cold(&mut store, &foundation)?;
    let mut running = tick.begin(foundation.data()?)?;
    let left = Cell::new(100_u32);
    let remaining = || left.replace(left.get() - 10);
    let mut deadline = Deadline { remaining, sweep: 10, certificate: 25 };
    let late = running.advance(UncertifiedSweeps(Libm), Limits::default(), &mut deadline)?;
    assert_eq!((late.ended, late.sweeps), (Ended::OutOfTime, 7));
    let never = &mut Deadline::never();
    let end = running.advance(UncertifiedSweeps(Libm), Limits::default(), never)?;
    assert_eq!(end.ended, Ended::Settled);
    assert!(end.sweeps > 50, "{end:?}");
    RESIDUAL.check("the end", end.figures.residual);
    // What sweeps have left over is far below the error of the mesh.
    let limits = Limits { sweeps: 0, ..Limits::default() };
    let after = running.advance(CertifiedSweeps(Libm), limits, never)?;
    let (algebraic, total) = (certificate(&after).algebraic, certificate(&after).total);
    ALGEBRAIC.check_over("what sweeps have left", algebraic, total);
    Ok(())
}

/// λ of each contact edge by the law, from a flux and the openings.
fn multipliers(foundation: &Foundation, u: &[f64], flux: &[f64]) -> Result<Vec<f64>, Error> {
    let counts = foundation.plate.edges()?.counts();
    let boundary = foundation.boundary()?;
    let law = |at: usize| {
        let edge = counts.free + at;
        let touches = u[edge] == foundation.lower[at];
        if touches { (flux[edge] - boundary.contact_flux(at).base()).max(0.0) } else { 0.0 }
    };
    Ok((0..counts.contact).map(law).collect())
}

/// The flux (15) alone pulls on some edges for a long time; the force never does, with or without a bound.
#[test]
fn forces_keep_their_sign_wherever_a_tick_is_stopped() -> Result<(), Error> {
    let foundation = Foundation::new(SIDES, false)?;
    let edges = foundation.plate.edges()?;
    let counts = edges.counts();
    let mut pulled = 0;
    for sweeps in 0..40 {
        let limits = exactly(sweeps);
        let (mut bounded, mut unbounded) = (arrays(&foundation)?, arrays(&foundation)?);
        let mut tick = cold(&mut bounded, &foundation)?;
        let certified = certified(&mut tick, foundation.data()?, limits)?;
        let mut tick = cold(&mut unbounded, &foundation)?;
        let plain = uncertified(&mut tick, foundation.data()?, limits)?;
        let loads = foundation.given()?.loads;
        let mut flux = vec![0.0; counts.edges()];
        flux::recover(&edges, foundation.stiffness(), loads, tick.u(), &[], &mut flux)?;
        let by_law: f64 = multipliers(&foundation, tick.u(), &flux)?.iter().sum();
        for report in [certified, plain] {
            assert!(report.figures.force >= 0.0, "{sweeps}: {report:?}");
            let what = format!("{sweeps}: {by_law} {report:?}");
            FORCE_OF_FLUX.check(what, report.figures.force - by_law);
        }
        let on_contact = (0..counts.contact).map(|at| flux[counts.free + at]);
        let given = foundation.boundary()?.contact_flux(0).base();
        pulled += usize::from(on_contact.map(|flux| flux - given).sum::<f64>() < 0.0);
    }
    assert!(pulled > 0, "the flux (15) never pulled: this test tests nothing");
    Ok(())
}

#[test]
fn edges_in_contact_follow_the_gap() -> Result<(), Error> {
    let foundation = Foundation::new(SIDES, false)?;
    let mut store = arrays(&foundation)?;
    let mut tick = cold(&mut store, &foundation)?;
    let before = certified(&mut tick, foundation.data()?, Limits::default())?;
    // The gap falls: what was in contact stays, though nothing but the bound pushes it down.
    let lower = with_gap(GAP - 0.01, &foundation);
    let after = certified(&mut tick, lower.data()?, exactly(0))?;
    assert_eq!((after.active, after.figures.changes, after.sweeps), (before.active, 0, 0));
    Ok(())
}

#[test]
fn after_an_overflow_a_tick_starts_on_the_gap() -> Result<(), Error> {
    const UNKNOWNS: usize = 55;
    let foundation = Foundation::new(SIDES, false)?;
    let counts = foundation.plate.edges()?.counts();
    let contact = counts.free..counts.unknowns();
    let mut store = arrays(&foundation)?;
    store.numbers[4][..counts.unknowns()].fill(f64::INFINITY);
    store.active.fill(false);
    let mut rows = Own::<UNKNOWNS>::new();
    let progress = Progress::new(Relaxation::Adaptive(1.0))?;
    let mut tick = resumed(&mut store, &foundation, &mut rows, progress)?;
    // A gap above 0, where everything else starts.
    certified(&mut tick, with_gap(2.0, &foundation).data()?, exactly(0))?;
    assert!(tick.u()[contact].iter().all(|&u| u == 2.0), "{:?}", tick.u());
    Ok(())
}

/// u is finite, but what flows through an edge is not.
#[test]
fn fluxes_that_overflow_are_said_to() -> Result<(), Error> {
    let foundation = Foundation::new(SIDES, false)?;
    let given = foundation.stiffness();
    let heavy = |entry: &f64| entry * 1e60;
    let triangles: Vec<_> = given.triangles.iter().map(|k| k.map(|k| heavy(&k))).collect();
    let quads: Vec<_> = given.quads.iter().map(|k| k.map(|k| heavy(&k))).collect();
    let stiffness = Stiffness { triangles: &triangles, quads: &quads };
    let mut store = arrays(&foundation)?;
    let mut tick = on(&mut store, Discretization { stiffness, ..foundation.discretization()? })?;
    let high = with_gap(f64::MAX / 1e33, &foundation);
    let report = uncertified(&mut tick, high.data()?, exactly(0))?;
    let numbers = tick.u().iter().chain([&report.figures.residual]);
    assert!(numbers.into_iter().all(|x| x.is_finite()), "{report:?}");
    assert_eq!(report.ended, Ended::NotFinite, "{report:?}");
    Ok(())
}

/// Whether `begin` takes data with ψ, u_D or f multiplied.
fn takes(
    tick: &mut PlateTick,
    foundation: &Foundation,
    [gap, given, source]: [f64; 3],
) -> Result<bool, Error> {
    let mut other = foundation.with(source, |_, psi| psi * gap);
    other.dirichlet.iter_mut().for_each(|value| *value *= given);
    match tick.begin(other.data()?) {
        Ok(mut running) => {
            running.advance(CertifiedSweeps(Libm), Limits::default(), &mut Deadline::never())?;
            Ok(true)
        }
        Err(Error::NotFinite { .. }) => Ok(false),
        Err(error) => Err(error),
    }
}

/// Equal ticks twice, with some between that are refused.
#[test]
fn data_too_large_for_an_answer_are_refused_and_change_no_bit() -> Result<(), Error> {
    let foundation = Foundation::new(SIDES, false)?;
    let mut stores = [arrays(&foundation)?, arrays(&foundation)?];
    let [one, other] = &mut stores;
    let (mut plain, mut tried) = (cold(one, &foundation)?, cold(other, &foundation)?);
    let bits = |tick: &PlateTick| {
        let arrays = [tick.u(), tick.tau(), tick.vertices(), tick.bubbles()];
        let bits = arrays.map(|array| array.iter().map(|x| x.to_bits()).collect::<Vec<_>>());
        (bits, tick.report().copied())
    };
    for part in [1.0, 0.7, -0.3, 1.4, 0.0] {
        for tick in [&mut plain, &mut tried] {
            assert!(takes(tick, &foundation, [1.0, part, 1.0 - part])?);
        }
        assert_eq!(bits(&plain), bits(&tried), "{part}");
        for large in [1e280, -1e290, 1e300, f64::MAX] {
            for parts in [[large, 1.0, 1.0], [1.0, large, 1.0], [1.0, 1.0, large]] {
                assert!(!takes(&mut tried, &foundation, parts)?, "{parts:?}");
            }
        }
        assert_eq!(bits(&plain), bits(&tried), "{part}");
    }
    Ok(())
}

/// Leftovers of data of any size lead to the answer that a cold start leads to.
#[test]
fn after_extreme_ticks_an_ordinary_one_is_right() -> Result<(), Error> {
    let foundation = Foundation::new(SIDES, false)?;
    let (mut first, mut second) = (arrays(&foundation)?, arrays(&foundation)?);
    let mut only = cold(&mut first, &foundation)?;
    assert!(takes(&mut only, &foundation, [1.0; 3])?);
    let expected = only.report().and_then(|report| report.verdict.certificate()).copied();
    let expected = expected.expect("a bound").total;
    let mut warm = cold(&mut second, &foundation)?;
    let mut refused = 0;
    for decade in (0..=308).step_by(4) {
        let size = 10f64.powi(decade);
        for parts in [[size, 1.0, 1.0], [1.0, -size, 1.0], [1.0, 1.0, size], [-size, size, -size]] {
            refused += u32::from(!takes(&mut warm, &foundation, parts)?);
            assert!(takes(&mut warm, &foundation, [1.0; 3])?, "{parts:?}");
            let report = warm.report().expect("an answer");
            assert_eq!(report.ended, Ended::Settled, "{parts:?}");
            let total = report.verdict.certificate().expect("a bound").total;
            assert!(total <= 1.5 * expected, "{parts:?}: {total:e} {expected:e}");
            assert!(report.sweeps < 400, "{parts:?}: {} sweeps", report.sweeps);
        }
    }
    assert!(refused > 20, "{refused}");
    Ok(())
}

#[test]
fn data_that_are_not_finite_change_nothing() -> Result<(), Error> {
    let foundation = Foundation::new(SIDES, false)?;
    let mut store = arrays(&foundation)?;
    let mut tick = cold(&mut store, &foundation)?;
    let good = certified(&mut tick, foundation.data()?, Limits::default())?;
    let u = tick.u().to_vec();
    for poison in [f64::NAN, f64::INFINITY] {
        let spoilt: [fn(&mut Foundation, f64); 5] = [
            |of, poison| of.lower.fill(poison),
            |of, poison| of.dirichlet.fill(poison),
            |of, poison| of.loads.0.fill(poison),
            |of, poison| of.gap.fill([poison; 2]),
            |of, poison| of.oscillation = poison,
        ];
        for spoil in spoilt {
            let mut other = foundation.clone();
            spoil(&mut other, poison);
            assert!(matches!(tick.begin(other.data()?), Err(Error::NotFinite { .. })));
            assert_eq!((tick.u(), tick.report()), (&u[..], Some(&good)));
        }
    }
    Ok(())
}

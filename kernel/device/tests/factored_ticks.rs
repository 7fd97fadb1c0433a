//! Ticks on a factor: what sweeps find in the end, without sweeps; and sweeps where the factor is of no use.

use crate::numbering::SIDES;
use crate::owned::of_full;
use crate::plate::factor::{Baked, Store};
use crate::plate::foundation::{Foundation, GAP};
use signorini_bound::certificate::LoadCase;
use signorini_device::full::{DataMemory, Functional};
use signorini_device::sparse::Exact;
use signorini_device::tick::{
    CertifiedSweeps, Data, Deadline, Ended, Limits, Progress, Report, Running, Substitutions, Tick,
    UncertifiedSweeps,
};
use signorini_kernel::mesh::boundary::{Boundary, Robin};
use signorini_kernel::rows::QUADS;
use signorini_kernel::{Error, Libm};
use signorini_tolerances::kernel::{FACTORED, RESIDUAL, SWEPT};

/// Goes on by the factor, with a bound or without.
fn advance(
    running: &mut Running<'_, '_, '_, f64, u16, QUADS>,
    exact: &mut Exact<f64, u16>,
    has_bound: bool,
    limits: Limits<f64>,
) -> Result<Report<f64>, Error> {
    let never = &mut Deadline::never();
    match has_bound {
        true => running.advance(certified(exact), limits, never),
        false => {
            running.advance(Substitutions { exact, sweeps: UncertifiedSweeps(Libm) }, limits, never)
        }
    }
}

fn certified<'e, 'a>(
    exact: &'e mut Exact<'a, f64, u16>,
) -> Substitutions<'e, 'a, f64, u16, CertifiedSweeps<Libm>> {
    Substitutions { exact, sweeps: CertifiedSweeps(Libm) }
}

/// A tick by sweeps, to the end.
fn swept(tick: &mut Tick<f64, u16, QUADS>, data: Data<f64, u16>) -> Result<Report<f64>, Error> {
    tick.begin(data)?.advance(CertifiedSweeps(Libm), TO_THE_END, &mut Deadline::never())
}

/// With a source that is multiplied, and a gap that bends along the contact.
fn bent(foundation: &Foundation, source: f64, bend: f64) -> Foundation {
    foundation.with(source, |at, psi| psi + bend * at as f64)
}

/// Until rounding is all that is left.
const TO_THE_END: Limits<f64> = Limits { error: 0.0, share: 1e-12, sweeps: 20_000 };
const NO_SWEEPS: Limits<f64> = Limits { error: 0.0, share: 0.01, sweeps: 0 };

/// Source and bend: much contact, none at all, some, much again.
const INPUTS: [(f64, f64); 5] = [(1.0, 0.0), (-4.0, -0.3), (1.0, 0.08), (1.0, 0.08), (3.0, -0.02)];

/// Ticks by the factor and by sweeps to the end, with the same data.
fn beside_sweeps(
    has_bound: bool,
    mut compare: impl FnMut(&Report<f64>, &Exact<f64, u16>, [&[f64]; 2], [&[f64]; 2]),
) -> Result<(), Error> {
    let foundation = Foundation::new(SIDES, false)?;
    let baked = Baked::new(&foundation)?;
    let (mut own, mut other) = (Store::new(&foundation)?, Store::new(&foundation)?);
    let (mut tick, mut exact) = own.of(&foundation, &baked)?;
    let (mut reference, _) = other.of(&foundation, &baked)?;
    let mut counts = Vec::new();
    for (source, bend) in INPUTS {
        let input = bent(&foundation, source, bend);
        let data = input.data()?;
        let expected = swept(&mut reference, data)?;
        let report = advance(&mut tick.begin(data)?, &mut exact, has_bound, NO_SWEEPS)?;
        assert_eq!((report.active, report.sweeps), (expected.active, 0), "{source} {bend}");
        assert_eq!(report.figures.changes, expected.figures.changes, "{source} {bend}");
        RESIDUAL.check(format_args!("{source} {bend}"), report.figures.residual);
        let free = foundation.plate.edges()?.counts().free;
        assert!(tick.u()[free..].iter().zip(&input.lower).all(|(u, lower)| u >= lower));
        compare(&report, &exact, [tick.u(), tick.tau()], [reference.u(), reference.tau()]);
        counts.push(report.active);
    }
    assert!(counts[1] < counts[0] && counts[1] < counts[2] && counts[2] == counts[3], "{counts:?}");
    Ok(())
}

fn off(found: &[f64], expected: &[f64]) -> f64 {
    let pairs = found.iter().zip(expected);
    pairs.fold(0.0, |most, (found, expected)| most.max((found - expected).abs()))
}

#[test]
fn a_factored_tick_is_where_sweeps_end() -> Result<(), Error> {
    let mut pivots = Vec::new();
    beside_sweeps(true, |report, exact, [u, tau], [swept, swept_tau]| {
        assert_eq!(report.ended, Ended::Exact);
        FACTORED.check("u and τ", off(u, swept));
        FACTORED.check("u and τ", off(tau, swept_tau));
        let certificate = report.verdict.certificate().expect("a bound");
        assert!(certificate.total > 1e-3, "{certificate:?}");
        RESIDUAL.check("the bound", certificate.algebraic);
        let solved = exact.solved().expect("a solution");
        assert!((2..5).contains(&solved.rounds), "{solved:?}");
        RESIDUAL.check("the last correction", solved.change);
        pivots.push(solved.pivots);
    })?;
    // Edges that stay on their side are not exchanged.
    assert!(pivots[3] == 0 && pivots[1] > 0 && pivots[2] > 0, "{pivots:?}");
    Ok(())
}

#[test]
fn without_a_bound_it_leaves_the_fluxes_of_the_solution() -> Result<(), Error> {
    beside_sweeps(false, |report, _, [u, tau], [swept, swept_tau]| {
        assert_eq!(report.ended, Ended::Exact);
        assert!(report.verdict.certificate().is_none());
        // Both are balanced on the solution; the certificate's is so where it is not.
        FACTORED.check("u and τ", off(u, swept));
        FACTORED.check("u and τ", off(tau, swept_tau));
    })
}

#[test]
fn a_factor_of_another_matrix_leaves_it_to_sweeps() -> Result<(), Error> {
    let foundation = Foundation::new(SIDES, false)?;
    let input = bent(&foundation, 1.0, 0.02);
    let sound = Baked::new(&foundation)?;
    let mut store = Store::new(&foundation)?;
    let (mut tick, mut exact) = store.of(&foundation, &sound)?;
    let never = &mut Deadline::never();
    let data = input.data()?;
    tick.begin(data)?.advance(certified(&mut exact), TO_THE_END, never)?;
    let expected = tick.u().to_vec();
    for (what, spoil) in [
        ("pivots", (|baked: &mut Baked| baked.ldlt.inverse.fill(1e3)) as fn(&mut Baked)),
        ("entries", |baked| baked.ldlt.values.fill(f64::NAN)),
        ("no entries", |baked| baked.ldlt.values.clear()),
        ("S", |baked| baked.ldlt.schur.as_flattened_mut().as_flattened_mut().fill(-1.0)),
        ("places", |baked| baked.ldlt.places.fill(9999)),
        ("columns", |baked| baked.ldlt.pointers.reverse()),
    ] {
        let mut baked = Baked::new(&foundation)?;
        spoil(&mut baked);
        for has_bound in [true, false] {
            let mut store = Store::new(&foundation)?;
            let (mut tick, mut exact) = store.of(&foundation, &baked)?;
            let mut running = tick.begin(input.data()?)?;
            let report = advance(&mut running, &mut exact, has_bound, TO_THE_END)?;
            assert!(report.sweeps > 0 && report.ended == Ended::Settled, "{what}: {report:?}");
            SWEPT.check(what, off(tick.u(), &expected));
        }
    }
    Ok(())
}

/// The transfer law changes between two ticks, and with it the matrix: little, then much, on inputs that hardly
/// move or stay.
#[test]
fn a_matrix_that_changes_between_warm_ticks_is_noticed() -> Result<(), Error> {
    let foundation = Foundation::new(SIDES, false)?;
    let baked = Baked::new(&foundation)?;
    let given = foundation.boundary()?;
    for has_bound in [true, false] {
        for (times, source) in
            [1.5, 30.0, 1e-6, 1e9].into_iter().flat_map(|t| [(t, 1.0), (t, 1.00001)])
        {
            let [first, second] = [1.0, source].map(|part| bent(&foundation, part, 0.02));
            let mut store = Store::new(&foundation)?;
            let (mut tick, mut exact) = store.of(&foundation, &baked)?;
            let mut solve = |tick: &mut Tick<f64, u16, QUADS>, data: Data<f64, u16>| {
                advance(&mut tick.begin(data)?, &mut exact, has_bound, TO_THE_END)
            };
            // As close to the answer as it gets before the matrix changes.
            for _ in 0..2 {
                assert_eq!(solve(&mut tick, first.data()?)?.sweeps, 0);
            }
            let law =
                |law: &Robin<f64, u16>| Robin { coefficient: times * law.coefficient, ..*law };
            let robin: Vec<_> = given.robin().iter().map(law).collect();
            let edges = foundation.plate.edges()?;
            let flux: Vec<_> =
                (0..edges.counts().contact).map(|at| given.contact_flux(at).base()).collect();
            let boundary = Boundary::new(&edges, given.neumann(), &robin, &flux)?;
            let data = second.data()?;
            let data = Data { given: LoadCase { boundary, ..data.given }, ..data };
            solve(&mut tick, data)?;
            let mut own = Store::new(&foundation)?;
            let (mut reference, _) = own.of(&foundation, &baked)?;
            swept(&mut reference, data)?;
            let off = off(tick.u(), reference.u());
            SWEPT.check(format_args!("{times:e} {source} {has_bound}"), off);
        }
    }
    Ok(())
}

/// A factor of 10⁴ K moves u by a ten-thousandth of what is asked, which looks like the last digits.
#[test]
fn a_factor_that_is_another_on_a_warm_tick_is_noticed() -> Result<(), Error> {
    let foundation = Foundation::new(SIDES, false)?;
    let sound = Baked::new(&foundation)?;
    let [first, second] = [1.0, 1.001].map(|part| bent(&foundation, part, 0.02));
    let mut own = Store::new(&foundation)?;
    let (mut reference, _) = own.of(&foundation, &sound)?;
    swept(&mut reference, second.data()?)?;
    let never = &mut Deadline::never();
    for (times, has_bound) in [(1e4, true), (1e4, false), (1e9, true), (1e9, false)] {
        let mut other = Baked::new(&foundation)?;
        other.ldlt.inverse.iter_mut().for_each(|inverse| *inverse /= times);
        other.scale.iter_mut().for_each(|scale| *scale /= f64::sqrt(times));
        let mut store = Store::new(&foundation)?;
        let (mut tick, mut exact) = store.of(&foundation, &sound)?;
        let mut running = tick.begin(first.data()?)?;
        let report = running.advance(certified(&mut exact), TO_THE_END, never)?;
        assert_eq!(report.sweeps, 0);
        let progress = tick.progress();
        let (memory, mut exact) = store.memory(&foundation, &other)?;
        let mut tick = Tick::resume(foundation.discretization()?, memory, progress)?;
        let mut running = tick.begin(second.data()?)?;
        let report = advance(&mut running, &mut exact, has_bound, TO_THE_END)?;
        assert!(report.sweeps > 0 && report.ended == Ended::Settled, "{times:e}: {report:?}");
        let off = off(tick.u(), reference.u());
        SWEPT.check(format_args!("{times:e} {has_bound}"), off);
    }
    Ok(())
}

#[test]
fn limits_and_deadlines_hold() -> Result<(), Error> {
    let foundation = Foundation::new(SIDES, false)?;
    let (baked, input) = (Baked::new(&foundation)?, bent(&foundation, 1.0, 0.0));
    let mut store = Store::new(&foundation)?;
    let (mut tick, mut exact) = store.of(&foundation, &baked)?;
    let mut running = tick.begin(input.data()?)?;
    let short = &mut Deadline { remaining: || 9, sweep: 7, certificate: 3 };
    let report = running.advance(certified(&mut exact), TO_THE_END, short)?;
    assert_eq!((report.ended, report.sweeps), (Ended::OutOfTime, 0));
    assert!(report.figures.residual > 1e-3 && exact.solved().is_none());
    // The rest of the tick: enough time for a solve, and a bound that is small enough.
    let enough = &mut Deadline { remaining: || 10, sweep: 7, certificate: 3 };
    let generous = Limits { error: 1e3, ..TO_THE_END };
    let report = running.advance(certified(&mut exact), generous, enough)?;
    assert_eq!((report.ended, report.sweeps), (Ended::Accurate, 0));
    assert!(exact.solved().is_some());
    RESIDUAL.check("the end", report.figures.residual);
    let contact = foundation.plate.edges()?.counts().free;
    assert!(tick.u()[contact..].contains(&GAP));
    exact.restart()?;
    assert!(exact.solved().is_none());
    Ok(())
}

#[test]
fn a_full_model_begins_with_memory_of_any_contents() -> Result<(), Error> {
    let foundation = Foundation::new(SIDES, false)?;
    let baked = Baked::new(&foundation)?;
    let touching: Vec<u16> = (0..foundation.lower.len() as u16).collect();
    let outputs = [Functional::Force(&touching), Functional::Bound];
    let full = foundation.full(&outputs, true)?;
    let mut forces = Vec::new();
    for has_bound in [true, false] {
        let (mut store, mut progress) = (Store::new(&foundation)?, Progress::NONE);
        for round in 0..2 {
            let (tick, mut exact) = store.memory(&foundation, &baked)?;
            let memory = of_full(tick, DataMemory::default(), &mut progress);
            let (never, mut outputs, exact) = (&mut Deadline::never(), [0.0; 2], &mut exact);
            let by_factor = Substitutions { exact, sweeps: UncertifiedSweeps(Libm) };
            let report = match has_bound {
                true => {
                    let by_factor = certified(by_factor.exact);
                    full.tick(&[], by_factor, (None, NO_SWEEPS), never, memory, &mut outputs)?
                }
                false => {
                    full.tick(&[], by_factor, (None, NO_SWEEPS), never, memory, &mut outputs)?
                }
            };
            assert_eq!((report.ended, report.sweeps), (Ended::Exact, 0));
            // The exchanges of the first tick are still there in the second.
            let pivots = exact.solved().expect("a solution").pivots;
            assert_eq!(pivots > 0, round == 0, "{pivots}");
            assert_eq!(outputs[1].is_finite(), has_bound);
            forces.push(outputs[0]);
        }
    }
    assert!(forces[0] > 0.1, "{forces:?}");
    FACTORED.check("forces", off(&forces, &[forces[0]; 4]));
    Ok(())
}

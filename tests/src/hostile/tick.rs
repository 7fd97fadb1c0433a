//! A control loop: sound meshes and models, with data, inputs, limits and deadlines of any bits.

use std::cell::Cell;

use signorini_bake::full::{Baked, Controller};
use signorini_device::full::Numbers;
use signorini_device::tick::{
    CertifiedSweeps, Deadline, Ended, Limits, Report, Tick, UncertifiedSweeps,
};
use signorini_kernel::relaxation::Relaxation;
use signorini_kernel::rows::QUADS;
use signorini_kernel::stiffness::{self, Coefficient};
use signorini_kernel::{Error, Libm, Tensor};

use super::bytes::{Bits, Bytes, bits, check_settled};
use super::certified::{Conditions, Foundation, Loads, is_bound};
use super::owned::TickArrays;
use super::scenes::{self, Kept};
use super::{condensed, plate};

/// The first byte chooses the loop and the scalar; the rest is what it is told.
pub fn tick(data: &[u8]) {
    let mut bytes = Bytes::new(data);
    let which = bytes.byte();
    if which & 0x80 == 0 { run::<f32>(which, &mut bytes) } else { run::<f64>(which, &mut bytes) }
}

fn run<R: Bits + Kept>(which: u8, bytes: &mut Bytes) {
    match which % 4 {
        0 => condensed::controlled::<R>(bytes),
        1 => driven::<R>(bytes),
        // A refusal is as good as an answer.
        _ => drop(held::<R>(bytes)),
    }
}

/// Tensors of ordinary size.
const TENSORS: [[f64; 3]; 3] = [[1.0, 0.0, 1.0], [3.0, -1.2, 1.5], [100.0, 0.0, 0.01]];

/// The kernel's tick on a grid.
fn held<R: Bits>(bytes: &mut Bytes) -> Result<(), Error> {
    let plate = plate::grid::<R>(bytes, false)?;
    let (mesh, edges) = (plate.mesh()?, plate.edges()?);
    let counts = edges.counts();
    let mut k = (vec![[R::ZERO; 3]; plate.triangles.len()], vec![[R::ZERO; 6]; plate.quads.len()]);
    let [xx, xy, yy] = TENSORS[bytes.below(3)].map(R::narrow);
    stiffness::fill(&mesh, Coefficient::Uniform(Tensor { xx, xy, yy }), 2, &mut k.0, &mut k.1)?;
    let first = Conditions::<R>::new(bytes, &edges, false);
    let foundation = Foundation::new(bytes, &mesh, &edges, &first.boundary(&edges)?, k, false)?;
    let discretization = foundation.discretization(mesh, edges)?;
    let mut arrays = TickArrays::new(&edges, plate.vertices.len());
    arrays.numbers[4] = bytes.reals(counts.edges());
    let memory = arrays.memory(&edges)?;
    let omega = bytes.real();
    let relaxation =
        if bytes.flag() { Relaxation::Adaptive(R::ONE) } else { Relaxation::Fixed(omega) };
    let mut tick = Tick::new(discretization, memory, relaxation)?;
    for _ in 0..1 + bytes.below(4) {
        let conditions = renewed(bytes, &first);
        let loads = Loads::new(bytes, &edges, conditions);
        let state = |tick: &Tick<R, u16, QUADS>| [tick.u(), tick.tau(), tick.vertices()].map(bits);
        let before = (state(&tick), tick.report().copied());
        let Ok(data) = loads.data(&edges) else { continue };
        let Ok(mut running) = tick.begin(data) else {
            assert_eq!(state(&tick), before.0, "refused data have left a trace");
            assert!(format!("{:?}", tick.report()) == format!("{:?}", before.1.as_ref()));
            continue;
        };
        for _ in 0..1 + bytes.below(2) {
            let limits = limits(bytes);
            let left = Cell::new(bytes.bits() as u32);
            let step = u32::from(bytes.byte());
            let remaining = || left.replace(left.get().saturating_sub(step));
            let [sweep, certificate] = [(); 2].map(|()| u32::from(bytes.byte()) << bytes.below(25));
            let mut deadline = Deadline { remaining, sweep, certificate };
            let report = match bytes.below(4) {
                0 => running.advance(UncertifiedSweeps(Libm), limits, &mut deadline),
                _ => running.advance(CertifiedSweeps(Libm), limits, &mut deadline),
            };
            answered(&report.expect("a tick that has begun"));
        }
        let ended = tick.report().map(|report| report.ended);
        if ended != Some(Ended::NotFinite) {
            let on_contact = tick.u().iter().skip(counts.free).zip(loads.law()?.edges());
            assert!(on_contact.into_iter().all(|(u, law)| law.admits(*u)), "{:?}", tick.report());
            assert!(tick.u().iter().all(|u| u.finite()), "{:?}", tick.report());
        }
    }
    Ok(())
}

/// Conditions on the same edges, with fluxes and surroundings of any bits.
fn renewed<R: Bits>(bytes: &mut Bytes, first: &Conditions<R>) -> Conditions<R> {
    let mut neumann = first.neumann.clone();
    neumann.iter_mut().for_each(|record| record.flux = bytes.real());
    let mut robin = first.robin.clone();
    robin.iter_mut().for_each(|law| law.ambient = bytes.real());
    let flux = bytes.reals(first.flux.len());
    Conditions { neumann, robin, flux }
}

fn limits<R: Bits>(bytes: &mut Bytes) -> Limits<R> {
    Limits { error: bytes.real(), share: bytes.real(), sweeps: bytes.below(100) as u32 }
}

/// Requirements of a report that is no overflow.
fn answered<R: Bits>(report: &Report<R>) {
    if report.ended == Ended::NotFinite {
        return;
    }
    assert!(report.figures.residual.finite() && report.figures.residual >= R::ZERO, "{report:?}");
    assert!(report.figures.force.finite() && report.figures.force >= R::ZERO, "{report:?}");
    assert!(report.figures.omega > R::ZERO && report.figures.omega < R::TWO, "{report:?}");
    if let Some(found) = report.verdict.certificate() {
        is_bound(found);
    }
}

/// A scene's full model, tick after tick, with inputs and limits of any bits.
fn driven<R: Bits + Kept>(bytes: &mut Bytes) {
    let all = R::full();
    let baked = &all[bytes.below(all.len())];
    let mut controller = Controller::new(baked);
    // It is never asked for what the first refuses.
    let mut spared = Controller::new(baked);
    for _ in 0..1 + bytes.below(4) {
        let inputs = bytes.reals::<R>(scenes::INPUTS);
        let limits = limits(bytes);
        let left = |of: &Controller<R>| {
            let Numbers { u, tau, vertices, .. } = of.numbers();
            [u, tau, vertices].map(bits)
        };
        let before = left(&controller);
        let Ok((values, report)) = controller.tick_within(&inputs, limits) else {
            assert_eq!(left(&controller), before, "{inputs:?}: a refused tick has left a trace");
            continue;
        };
        answered(&report);
        let (other, _) = spared.tick_within(&inputs, limits).expect("the same answer");
        assert_eq!(bits(&values), bits(&other), "{inputs:?} after what was refused");
        if report.ended == Ended::NotFinite {
            continue;
        }
        let said = || format!("{inputs:?} {values:?} {report:?}");
        assert!(values.iter().all(|value| !value.wide().is_nan()), "{}", said());
        let (u, lower) = (controller.u(), controller.lower());
        assert!(u.iter().all(|u| u.finite()), "{}", said());
        let free = baked.unknowns() - lower.len();
        let on_contact = u.iter().skip(free).zip(lower);
        let is_limited = baked.features().contains(&"limited");
        let admits = |(u, lower): (&R, &R)| u >= lower || is_limited;
        assert!(on_contact.into_iter().all(admits), "{}", said());
    }
    ordinary(bytes, baked, &mut controller);
}

/// Inputs of ordinary size: the answer, or the refusal of gaps that exclude each other, is that of a cold start, whatever came before.
fn ordinary<R: Bits>(bytes: &mut Bytes, baked: &Baked<R>, controller: &mut Controller<R>) {
    let inputs: Vec<R> =
        (0..scenes::INPUTS).map(|_| R::narrow(f64::from(bytes.byte() as i8) / 16.0)).collect();
    let limits = Limits { error: R::ZERO, share: R::EPSILON, sweeps: 10_000 };
    let mut cold = Controller::new(baked);
    let (expected, found) =
        (cold.tick_within(&inputs, limits), controller.tick_within(&inputs, limits));
    let excluded = matches!(expected, Err(Error::Excluded { .. }));
    if excluded {
        assert_eq!(found.err(), expected.err(), "{inputs:?}");
        return;
    }
    let [(_, expected), (_, report)] =
        [expected, found].map(|tick| tick.expect("an ordinary tick"));
    answered(&report);
    let said = format!("{inputs:?}: {report:?} instead of {expected:?}");
    let is_settled = |ended| matches!(ended, Ended::Settled | Ended::Exact);
    assert!(is_settled(report.ended) && is_settled(expected.ended), "{said}");
    check_settled(&said, controller.u(), cold.u());
}

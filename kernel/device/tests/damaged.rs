//! States of which every bit and every byte is wrong in turn, as after a brown-out: a tick on them answers, wrongly perhaps, or is
//! refused. `cargo xtask sanitize` sees that none reads or writes beside its memory.

use std::mem::MaybeUninit;

use signorini_contact::Condensed;
use signorini_contact::dense::blocks::count;
use signorini_contact::dense::tableau::InitialTableau;
use signorini_contact::method::Sweeps;
use signorini_contact::modes::{ArrayModalStorage, Modal};
use signorini_contact::outputs::Measure;
use signorini_contact::spans::SpanColumns;
use signorini_contact::storage::{ArrayStorage, ArrayTableauStorage};
use signorini_device::condensed::{ControllerStorage, Effort, Exchanges, Phased, Solver, Swept};
use signorini_device::controller::{Outputs, Reading, Storage};
use signorini_device::full::controller::{self as full, ByFactor, Setup};
use signorini_device::full::{self as on_mesh, Full, Functional, Lengths};
use signorini_device::sparse::{self, Factored};
use signorini_device::tick::CertifiedSweeps;
use signorini_kernel::limits::{Deadline, Limits};
use signorini_kernel::rows::QUADS;
use signorini_kernel::{Error, Libm};

use crate::memory::bare;
use crate::numbering::Side;
use crate::plate::factor::Baked;
use crate::plate::foundation::Foundation;
use crate::strip::Strip;

/// All outputs, and whether all are numbers.
struct All;

impl Outputs<f64> for All {
    fn read(of: &impl Reading<f64>) -> Result<Self, Error> {
        (0..of.count()).try_for_each(|number| of.value(number).map(drop)).map(|()| Self)
    }
}

/// A state whose byte `at` has the bits of `mask` turned round.
#[allow(unsafe_code)]
fn turned<S>(state: &S, at: usize, mask: u8) -> Box<S> {
    let mut copy = Box::new(MaybeUninit::<S>::uninit());
    // SAFETY: a state is numbers, each of which any bits are.
    unsafe {
        std::ptr::copy_nonoverlapping(state, copy.as_mut_ptr(), 1);
        let byte = copy.as_mut_ptr().cast::<u8>().add(at);
        byte.write_volatile(byte.read_volatile() ^ mask);
        Box::from_raw(Box::into_raw(copy).cast())
    }
}

/// Ticks on a state that earlier ticks have left, and one on what damage makes of it; in the end the state itself still answers.
fn endures<S>(mut state: Box<S>, mut tick: impl FnMut(&mut S, f64) -> Result<(), Error>) {
    for p in [0.3, -0.2] {
        tick(&mut state, p).expect("an answer");
    }
    let masks = (0..8).map(|bit| 1 << bit).chain([u8::MAX]);
    let (mut answered, mut refused) = (0, 0);
    for mask in masks {
        for at in 0..size_of::<S>() {
            let mut damaged = turned(&*state, at, mask);
            *(if tick(&mut damaged, 0.1).is_ok() { &mut answered } else { &mut refused }) += 1;
        }
    }
    assert!(answered > 9 * refused, "{answered} {refused}");
    tick(&mut state, 0.1).expect("an answer");
}

/// A strip of six edges, whose load an input changes.
fn condensed<M: Solver<f64>>(solver: M) {
    let strip = Strip::<f64>::new(6);
    let load: [f64; 16] = std::array::from_fn(|at| match at {
        0..6 => 0.3 - 0.1 * at as f64,
        8..14 => 0.5,
        _ => 0.0,
    });
    // The last two fluxes have limits, one of which the input moves.
    let spans: [f64; 16] = std::array::from_fn(|at| match at {
        4 => 0.5,
        5 => 1.0,
        13 => 0.25,
        8.. => 0.0,
        _ => f64::INFINITY,
    });
    let (of_inputs, of_contact) = ([0.0, 1.0], [1.0; 6]);
    let model = Condensed {
        contact: 6,
        matrix: strip.blocks(),
        x: &[0.0; 8],
        start: InitialTableau { blocks: strip.blocks(), exchanged: &[] },
        load: &load,
        spans: SpanColumns::new(&spans),
        outputs: &[Measure::Linear { of_inputs: &of_inputs, of_contact: &of_contact }],
        ..bare()
    };
    let sweeps = Sweeps { omega: 1.2, tolerance: 1e-9, most: 40 };
    let effort = &Effort { pivots: 40, sweeps };
    let iterate = ArrayStorage::<f64, 8, 0, 8>::zeros();
    endures(Box::new(ControllerStorage { iterate, solver }), |state, p| {
        let limits = Limits { sweeps: 40, ..Limits::default() };
        let never = &mut Deadline::never();
        state.tick::<All, _>(&model, effort, &[1.0, p], limits, never).map(drop)
    });
}

type Tableau = ArrayTableauStorage<f64, 8, { count(6) }>;

#[test]
fn condensed_states() {
    condensed(Swept);
    condensed(Exchanges(Tableau::zeros()));
    condensed(Phased(Tableau::zeros()));
}

/// S = [1, −¼; −¼, 1] and two modes.
#[test]
fn states_of_modes() {
    let mut block = [[0.0; 8]; 8];
    (block[0][0], block[1][1], block[1][0], block[0][1]) = (1.0, 1.0, -0.25, -0.25);
    let mut load = [0.0; 32];
    (load[0], load[1], load[9], load[16], load[25]) = (1.0, 0.5, 1.0, 0.5, -0.5);
    let of_inputs = [0.5, 0.25, -0.25, 0.0];
    let measure = Measure::Linear { of_inputs: &[0.0, 1.0, 2.0, -1.0], of_contact: &[1.0, 4.0] };
    let blocks = [block];
    let modal = Modal {
        model: Condensed {
            contact: 2,
            matrix: &blocks,
            load: &load,
            outputs: &[measure],
            ..bare()
        },
        input: 1,
        origin: [-1.0, 0.0],
        per_unit: 0.25,
        compliance: &[1.0, 3.0],
        of_inputs: &of_inputs,
        laws: None,
        is_monotone: false,
    };
    let sweeps = Sweeps { omega: 1.0, tolerance: 1e-9, most: 40 };
    let effort = &Effort { pivots: 10, sweeps };
    let state = ControllerStorage {
        iterate: ArrayModalStorage::<f64, 8, 0, 1, 4>::zeros(),
        solver: Exchanges(ArrayTableauStorage::<f64, 8, 1>::zeros()),
    };
    endures(Box::new(state), |state, p| {
        let limits = Limits { sweeps: 40, ..Limits::default() };
        state.tick::<All, _>(&modal, effort, &[1.0, p], limits, &mut Deadline::never()).map(drop)
    });
}

/// Of the plate: 54 rows, 5 contact edges, and numbers for load, u, τ, s and bubbles.
const NUMBERS: usize = 54 + 59 + 59 + 30 + 59;
type Own = on_mesh::ArrayStorage<f64, u16, QUADS, 54, NUMBERS, 5, 0, 0, 0>;
type OnMesh<M> = full::ControllerStorage<Own, M, [f64; 2], u16, QUADS>;

fn on_the_plate<M: full::Solver<f64, u16>>(
    foundation: &Foundation,
    factored: Option<&Factored<f64, u16>>,
    solver: M,
) -> Result<(), Error> {
    let all: Vec<u16> = (0..59).collect();
    let outputs = [Functional::Flux(&all), Functional::Bound];
    let model: Full<f64, u16> = foundation.full(&outputs, true)?;
    let lengths = Lengths::of(&model);
    let setup = Setup { lengths: &lengths, factored, units: None };
    let state: OnMesh<M> = OnMesh::of(Own::zeros(), solver, [0.0; 2]);
    endures(Box::new(state), |state, _| {
        let limits = Limits { share: 0.1, error: 0.0, sweeps: 8 };
        state.tick::<All, _>(&model, &setup, &[1.0], limits, &mut Deadline::never()).map(drop)
    });
    Ok(())
}

const SIDES: [Side; 4] = [Side::Contact, Side::Insulated, Side::Given, Side::Transfer];

#[test]
fn states_on_a_mesh() -> Result<(), Error> {
    on_the_plate(&Foundation::new(SIDES, false)?, None, CertifiedSweeps(Libm))
}

#[test]
fn states_on_a_mesh_with_a_factor() -> Result<(), Error> {
    let foundation = Foundation::new(SIDES, false)?;
    let baked = Baked::new(&foundation)?;
    const EXCHANGES: [usize; 3] = sparse::storage::lengths(5);
    let exchanges =
        sparse::ArrayStorage::<f64, { EXCHANGES[0] }, { EXCHANGES[1] }, { EXCHANGES[2] }>::zeros();
    let solver = ByFactor { exchanges, sweeps: CertifiedSweeps(Libm) };
    on_the_plate(&foundation, Some(&baked.view()), solver)
}

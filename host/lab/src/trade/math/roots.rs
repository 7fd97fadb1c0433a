//! The kernel's square root: in the search for ω, where it can cost sweeps but no accuracy, and in the
//! lengths of edges, where its error is the answer's.

use std::cell::Cell;
use std::marker::PhantomData;

use signorini_kernel::rows::{self, Row, Rows};
use signorini_kernel::solver::{Settings, Solver, Status};
use signorini_kernel::{Error, Libm, Math, Micromath, contact};

use super::super::record::FunctionCost;
use super::change::{Change, State};
use signorini_bake::costs::Costs;
use signorini_problem::{Assembled, Parts, Problem};
use signorini_scene::error::Result;
use signorini_solve::unfit;

const NAME: &str = "sqrt";

/// A row for the search, from cold solves in f32, and one for the length of the contact set, if any.
pub(super) fn rows(problem: &Problem) -> Result<Vec<FunctionCost>> {
    let parts = Parts::examine(problem)?;
    let wide = Assembled::<f64>::new(problem).map_err(unfit::<f64>(&problem.scene))?;
    let mut single = Assembled::<f32>::new(problem).map_err(unfit::<f32>(&problem.scene))?;
    single.set_parts(&parts);
    compared(&wide, &single).map_err(unfit::<f32>(&problem.scene))
}

type Solve = fn(&Assembled<f32>) -> std::result::Result<Cold, Error>;

fn compared(
    wide: &Assembled<f64>,
    single: &Assembled<f32>,
) -> std::result::Result<Vec<FunctionCost>, Error> {
    let solves: [Solve; 2] = if single.edges().of_quads().is_empty() {
        [cold::<Libm, { rows::TRIANGLES }>, cold::<Micromath, { rows::TRIANGLES }>]
    } else {
        [cold::<Libm, { rows::QUADS }>, cold::<Micromath, { rows::QUADS }>]
    };
    let (exact, fast) = (solves[0](single)?, solves[1](single)?);
    let saved = Costs::measured().saved_by(NAME).unwrap_or_default();
    let change = Change::between(wide, &exact.state, &fast.state)?;
    let named = |place: &str| FunctionCost {
        function: NAME.to_owned(),
        used_in: place.to_owned(),
        saved,
        ..FunctionCost::default()
    };
    let search = FunctionCost {
        energy: change.energy,
        force: change.force,
        length: change.length,
        sweeps: Some(i64::from(fast.sweeps) - i64::from(exact.sweeps)),
        calls: fast.calls,
        note: ends(&exact, &fast),
        ..named("search for ω")
    };
    let lengths = Lengths::of(single, &exact.u)?;
    let measured = FunctionCost {
        energy: Some(0.0),
        force: Some(0.0),
        length: lengths.error,
        calls: lengths.calls,
        ..named("lengths of edges")
    };
    Ok(if lengths.calls > 0 { vec![search, measured] } else { vec![search] })
}

/// A note on solves that do not end well.
fn ends(exact: &Cold, fast: &Cold) -> Option<String> {
    let is_well = |cold: &Cold| matches!(cold.status, Status::Converged | Status::RoundingLimit);
    let name = signorini_solve::status_name;
    let both = || format!("libm: {}, micromath: {}", name(exact.status), name(fast.status));
    (!(is_well(exact) && is_well(fast))).then(both)
}

/// A cold solve down to the rounding limit.
struct Cold {
    u: Vec<f32>,
    state: State,
    sweeps: u32,
    status: Status,
    /// Square roots that it took.
    calls: u64,
}

fn cold<M: Math<f32>, const WIDTH: usize>(
    assembled: &Assembled<f32>,
) -> std::result::Result<Cold, Error> {
    let (system, edges) = (assembled.system()?, assembled.edges());
    let mut memory = vec![Row::<f32, u32, WIDTH>::EMPTY; edges.counts().unknowns()];
    let mut rows = Rows::new(edges, &mut memory)?;
    let mut u = assembled.start();
    CALLS.set(0);
    let mut solver = Solver::<f32, Counted<M>>::with_math(Settings::default())?;
    let outcome = solver.run(&system, &mut rows, &mut u)?;
    let calls = CALLS.get();
    let mut flux = vec![0.0; u.len()];
    assembled.recover(&u, &[], &mut flux)?;
    let length = contact::length::<_, _, Libm>(&assembled.mesh()?, edges, assembled.law(), &u);
    let boundary = assembled.boundary()?;
    let state = State {
        u: u.iter().copied().map(f64::from).collect(),
        force: contact::force(edges.counts(), &boundary, assembled.law(), &u, &flux).into(),
        length: length.into(),
    };
    Ok(Cold { u, state, sweeps: outcome.sweeps, status: outcome.status, calls })
}

thread_local! {
    static CALLS: Cell<u64> = const { Cell::new(0) };
}

/// `M`, and how often it is asked.
struct Counted<M>(PhantomData<M>);

impl<M: Math<f32>> Math<f32> for Counted<M> {
    fn sqrt(x: f32) -> f32 {
        CALLS.set(CALLS.get() + 1);
        M::sqrt(x)
    }
}

/// The length of the contact set by both square roots.
struct Lengths {
    /// Relative error; none where nothing is in contact.
    error: Option<f64>,
    /// Active edges.
    calls: u64,
}

impl Lengths {
    fn of(assembled: &Assembled<f32>, u: &[f32]) -> std::result::Result<Self, Error> {
        let (mesh, edges, law) = (assembled.mesh()?, assembled.edges(), assembled.law());
        let counts = edges.counts();
        let is_active = |&at: &usize| contact::is_active(counts, law, u, at);
        let calls = (0..counts.contact).filter(is_active).count() as u64;
        let exact = contact::length::<_, _, Libm>(&mesh, edges, law, u);
        let fast = contact::length::<_, _, Micromath>(&mesh, edges, law, u);
        let error = (calls > 0).then(|| f64::from((fast - exact) / exact).abs());
        Ok(Self { error, calls })
    }
}

//! The kernel's square root: in the search for ω, where it can cost sweeps but no accuracy, and in the
//! lengths of edges, where its error is the answer's.

use std::cell::Cell;
use std::marker::PhantomData;

use signorini_kernel::rows::{self, Row, Rows};
use signorini_kernel::solver::{Settings, Solver, Status};
use signorini_kernel::{Error, Libm, Math, Micromath, contact};

use super::super::record::FunctionCost;
use signorini_bake::costs::Costs;
use signorini_problem::{Assembled, Parts, Problem};
use signorini_scene::Result;
use signorini_solve::{Solution, unfit};

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
    let row = |place: &str, calls: u64| FunctionCost {
        function: NAME.to_owned(),
        used_in: place.to_owned(),
        calls,
        saved,
        ..FunctionCost::default()
    };
    let search = FunctionCost {
        sweeps: Some(i64::from(fast.sweeps) - i64::from(exact.sweeps)),
        note: ends(&exact, &fast),
        ..row("search for ω", fast.calls).changed(wide, &exact.answer, &fast.answer)?
    };
    let (mesh, edges, law) = (single.mesh()?, single.edges(), single.law());
    let is_active = |&at: &usize| contact::is_active(edges.counts(), law, &exact.u, at);
    let active = (0..edges.counts().contact).filter(is_active).count() as u64;
    let length = contact::length::<_, _, Libm>(&mesh, edges, law, &exact.u);
    let other = contact::length::<_, _, Micromath>(&mesh, edges, law, &exact.u);
    let lengths = (active > 0).then(|| FunctionCost {
        energy: Some(0.0),
        force: Some(0.0),
        length: Some(f64::from((other - length) / length).abs()),
        ..row("lengths of edges", active)
    });
    Ok([search].into_iter().chain(lengths).collect())
}

/// A note on solves that do not end well.
fn ends(exact: &Cold, fast: &Cold) -> Option<String> {
    let is_well = |cold: &Cold| signorini_solve::went_well(cold.status);
    let name = signorini_solve::status_name;
    let both = || format!("libm: {}, micromath: {}", name(exact.status), name(fast.status));
    (!(is_well(exact) && is_well(fast))).then(both)
}

/// A cold solve down to the rounding limit.
struct Cold {
    u: Vec<f32>,
    answer: Solution,
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
    let answer = Solution {
        u: u.iter().copied().map(f64::from).collect(),
        contact_force: contact::force(edges.counts(), &boundary, assembled.law(), &u, &flux).into(),
        contact_length: length.into(),
        ..Solution::default()
    };
    Ok(Cold { u, answer, sweeps: outcome.sweeps, status: outcome.status, calls })
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

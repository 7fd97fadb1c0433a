//! The kernel's tick on a scene whose parts D or R holds: what a device would do.

use signorini_device::tick::{CertifiedSweeps, Data, Deadline, Memory, Report, Tick};
use signorini_kernel::prolongation::prolong;
use signorini_kernel::relaxation::Relaxation;
use signorini_kernel::rows::{Row, Rows};
use signorini_kernel::{Error as KernelError, Libm, contact};

use super::player::PlayedTick;
use super::{Budget, coarse};
use signorini_certify::admissible::Following;
use signorini_certify::{Certifier, ErrorBound};
use signorini_problem::scalar::Scalar;
use signorini_problem::{Assembled, Parts, Problem};
use signorini_scene::error::Result;
use signorini_solve::{ended_name, prefers_factor, unfit};

/// Answers for the loads of a problem, tick after tick.
pub type Engine<'e> = dyn FnMut(&Problem) -> Result<PlayedTick> + 'e;

/// Lends an engine to `play` for as long as it takes: its memory lives here. Its first tick starts from
/// the solution on `coarse`, the same problem on a coarser mesh, where there is one; where there is none, on a
/// large mesh and without a budget of sweeps, from that of a factor.
///
/// # Errors
/// Numbers that the scalar type cannot hold.
pub fn with<R: Scalar, const WIDTH: usize, T>(
    problem: &Problem,
    parts: &Parts,
    coarse: Option<&Problem>,
    budget: &Budget,
    play: impl FnOnce(&mut Engine) -> T,
) -> Result<T> {
    let unfit = unfit::<R>(&problem.scene);
    // The ways out lead where something passes in every tick.
    let least = problem.at_least_transfer()?;
    let fixed = Assembled::<R>::new(&least).map_err(&unfit)?;
    let certifier = Certifier::new(&least, parts, &fixed).map_err(&unfit)?;
    let mut store = Store::<R, WIDTH>::new(problem, &fixed);
    if let Some(coarse) = coarse {
        let means: Vec<R> = coarse::solved(coarse)?.into_iter().map(R::narrow).collect();
        let origins = coarse::origins(problem, coarse)?;
        prolong(&origins, &means, &mut store.u).map_err(&unfit)?;
    } else if budget.is_open() && prefers_factor(problem) {
        // Cold sweeps on a large mesh would take longer than all ticks after them.
        let means = coarse::solved(problem)?.into_iter().map(R::narrow);
        store.u.iter_mut().zip(means).for_each(|(u, mean)| *u = mean);
    }
    let mut tick = store.tick(&certifier, &fixed).map_err(&unfit)?;
    let mut moving = fixed.clone();
    Ok(play(&mut |problem| {
        moving.set_loads(&problem.loads).map_err(&unfit)?;
        let data = signorini_certify::Data::<R>::new(problem)?;
        let report = advance(&mut tick, &moving, &data, budget).map_err(&unfit)?;
        let mut answer = answer(problem, &moving, &tick, &report);
        answer.bound = answer.bound.filter(|_| data.has_bound());
        Ok(answer)
    }))
}

/// Memory of a tick, owned.
struct Store<R, const WIDTH: usize> {
    rows: Vec<Row<R, u32, WIDTH>>,
    load: Vec<R>,
    active: Vec<bool>,
    vertices: Vec<R>,
    bubbles: Vec<R>,
    tau: Vec<R>,
    u: Vec<R>,
}

impl<R: Scalar, const WIDTH: usize> Store<R, WIDTH> {
    fn new(problem: &Problem, assembled: &Assembled<R>) -> Self {
        let counts = problem.topology.counts;
        Self {
            rows: vec![Row::EMPTY; counts.unknowns()],
            load: vec![R::ZERO; counts.unknowns()],
            active: vec![false; counts.contact],
            vertices: vec![R::ZERO; problem.mesh.vertices.len()],
            bubbles: vec![R::ZERO; counts.edges()],
            tau: vec![R::ZERO; counts.edges()],
            u: assembled.start(),
        }
    }

    fn tick<'a>(
        &'a mut self,
        certifier: &'a Certifier<R>,
        assembled: &'a Assembled<R>,
    ) -> std::result::Result<Tick<'a, R, u32, WIDTH>, KernelError> {
        let discretization = certifier.discretization(assembled)?;
        let Self { rows, load, active, vertices, bubbles, tau, u } = self;
        let rows = Rows::new(&discretization.edges, rows)?;
        let memory = Memory { rows, load, active, vertices, bubbles, tau, u };
        Tick::new(
            discretization,
            memory,
            Relaxation::for_unknowns(discretization.edges.counts().unknowns()),
        )
    }
}

fn advance<R: Scalar, const WIDTH: usize>(
    tick: &mut Tick<R, u32, WIDTH>,
    assembled: &Assembled<R>,
    data: &signorini_certify::Data<R>,
    budget: &Budget,
) -> std::result::Result<Report<R>, KernelError> {
    let given = data.given(assembled)?;
    let (law, dirichlet) = (assembled.law(), assembled.dirichlet());
    let mut running = tick.begin(Data { given, law, dirichlet })?;
    running.advance(CertifiedSweeps(Libm), budget.limits(), &mut Deadline::never())
}

fn answer<R: Scalar, const WIDTH: usize>(
    problem: &Problem,
    assembled: &Assembled<R>,
    tick: &Tick<R, u32, WIDTH>,
    report: &Report<R>,
) -> PlayedTick {
    let (counts, law) = (problem.topology.counts, assembled.law());
    let touching = (0..counts.contact).filter(|&at| contact::is_active(counts, law, tick.u(), at));
    let wide = |numbers: &[R]| -> Vec<f64> { numbers.iter().map(|x| x.wide()).collect() };
    let tau = wide(tick.tau());
    PlayedTick {
        status: ended_name(report.ended),
        sweeps: report.sweeps,
        u: wide(tick.u()),
        flux: tau.clone(),
        contact_force: report.force.wide(),
        contact_length: touching.fold(0.0, |sum, at| sum + problem.lengths[counts.free + at]),
        bound: report.verdict.certificate().map(ErrorBound::new),
        certified: signorini_certify::CertifiedFields {
            vertices: wide(tick.vertices()),
            bubbles: wide(tick.bubbles()),
            tau,
            indicators: Vec::new(),
            following: Following::WhereNeeded,
        },
    }
}

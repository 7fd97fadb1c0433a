//! The kernel's tick on a scene whose parts D or R holds: the code of a device, on data that are integrated for each moment.

use signorini_certify::{Certifier, Enclosed, NoBound};
use signorini_device::full::Numbers;
use signorini_device::tick::{
    CertifiedSweeps, Data, Deadline, IfStoring, Limits, Memory, Progress, Report, Tick,
};
use signorini_kernel::relaxation::{KeptSearch, Relaxation};
use signorini_kernel::rows::{QUADS, Row, Rows, TRIANGLES};
use signorini_kernel::{Error as KernelError, Libm, contact};
use signorini_problem::scalar::{Scalar, widened};
use signorini_problem::{Assembled, Parts, Problem};
use signorini_scene::error::{InputError, Result};
use signorini_scene::scene::units::Units;
use signorini_solve::{Solution, unfit};

use crate::Session;
use crate::on_mesh::answer;
use crate::saved::{SavedSession, check_length, narrowed};

struct KernelTick<'p, R: Scalar, const WIDTH: usize> {
    least: &'p Problem,
    /// Matrix and forest of the least transfer coefficients: ways out lead where something passes in every tick.
    fixed: Assembled<'p, R>,
    certifier: Certifier<R>,
    /// The matrix with the data of the present tick.
    moving: Assembled<'p, R>,
    data: signorini_certify::Data<R>,
    enclosed: Enclosed,
    limits: Limits<R>,
    start: Vec<R>,
    memory: Owned<R, WIDTH>,
    progress: Progress<R>,
    /// Of the last tick here.
    report: Option<Report<R>>,
}

/// A session of the kernel's ticks within `limits`, for a problem and the same at its least transfer coefficients. The first
/// tick starts from the means that `start` leaves in its slice, one per edge.
///
/// # Errors
/// Numbers that the scalar type cannot hold; what `start` fails with.
pub(crate) fn session<'p, R: Scalar>(
    problem: &Problem,
    least: &'p Problem,
    limits: Limits<R>,
    start: impl FnOnce(&mut [R]) -> Result<()>,
) -> Result<Box<dyn Session + 'p>> {
    Ok(match problem.mesh.quads.is_empty() {
        true => Box::new(KernelTick::<R, TRIANGLES>::new(problem, least, limits, start)?),
        false => Box::new(KernelTick::<R, QUADS>::new(problem, least, limits, start)?),
    })
}

/// Memory of a tick.
struct Owned<R, const WIDTH: usize> {
    rows: Vec<Row<R, u32, WIDTH>>,
    load: Vec<R>,
    active: Vec<bool>,
    vertices: Vec<R>,
    bubbles: Vec<R>,
    tau: Vec<R>,
    u: Vec<R>,
}

impl<R: Scalar, const WIDTH: usize> Owned<R, WIDTH> {
    fn new(problem: &Problem, u: Vec<R>) -> Self {
        let counts = problem.topology.counts;
        let zeros = |length| vec![R::ZERO; length];
        Self {
            rows: vec![Row::EMPTY; counts.unknowns()],
            load: zeros(counts.unknowns()),
            active: vec![false; counts.contact],
            vertices: zeros(problem.mesh.vertices.len()),
            bubbles: zeros(counts.edges()),
            tau: zeros(counts.edges()),
            u,
        }
    }
}

impl<'p, R: Scalar, const WIDTH: usize> KernelTick<'p, R, WIDTH> {
    fn new(
        problem: &Problem,
        least: &'p Problem,
        limits: Limits<R>,
        start: impl FnOnce(&mut [R]) -> Result<()>,
    ) -> Result<Self> {
        let unfit = unfit::<R>(&problem.scene);
        let parts = Parts::whatever_inputs(problem)?;
        let fixed = Assembled::<R>::new(least).map_err(&unfit)?;
        let certifier = Certifier::new(least, &parts, &fixed).map_err(&unfit)?;
        let mut u = fixed.start();
        start(&mut u)?;
        let mut enclosed = Enclosed::default();
        let data = signorini_certify::Data::again(problem, &mut enclosed)
            .map_err(|error| error.at_time(problem.time))?;
        let (moving, memory) = (fixed.clone(), Owned::new(problem, u.clone()));
        let (progress, report) = (Progress::NONE, None);
        Ok(Self {
            least,
            fixed,
            certifier,
            moving,
            data,
            enclosed,
            limits,
            start: u,
            memory,
            progress,
            report,
        })
    }

    fn advance(&mut self) -> std::result::Result<u32, KernelError> {
        let discretization = self.certifier.discretization(&self.fixed)?;
        let Owned { rows, load, active, vertices, bubbles, tau, u } = &mut self.memory;
        let unknowns = load.len();
        let rows = Rows::new(&discretization.edges, rows)?;
        let memory = Memory { rows, load, active, vertices, bubbles, tau, u };
        let mut tick = match self.progress.has_begun() {
            true => Tick::resume(discretization, memory, self.progress)?,
            false => Tick::new(discretization, memory, Relaxation::for_unknowns(unknowns))?,
        };
        let forms = self.data.forms();
        let given = self.data.given(&self.moving, forms.as_slice())?;
        let (law, dirichlet) = (self.moving.law(), self.moving.dirichlet());
        let mut running = tick.begin(Data { given, law, dirichlet, step: IfStoring::NOTHING })?;
        let never = &mut Deadline::never();
        let report = running.advance(CertifiedSweeps(Libm), self.limits, never)?;
        (self.progress, self.report) = (tick.progress(), Some(report));
        Ok(report.sweeps)
    }
}

impl<R: Scalar, const WIDTH: usize> Session for KernelTick<'_, R, WIDTH> {
    fn pose(&mut self, at: &Problem) -> Result<()> {
        self.moving.set_loads(&at.loads).map_err(unfit::<R>(&at.scene))?;
        self.data = signorini_certify::Data::again(at, &mut self.enclosed)?;
        Ok(())
    }

    fn tick(&mut self, _: &[f64]) -> Result<u32> {
        let scene = &self.least.scene;
        self.advance().map_err(unfit::<R>(scene))
    }

    fn restart(&mut self) {
        self.memory.u.copy_from_slice(&self.start);
        (self.progress, self.report) = (Progress::NONE, None);
    }

    fn saved(&self) -> Option<SavedSession> {
        let KeptSearch { omega, best, moves, phase } = self.progress.search;
        self.progress.has_begun().then(|| SavedSession::Tick {
            u: widened(&self.memory.u),
            active: self.memory.active.clone(),
            omega: omega.wide(),
            best: best.map(R::wide),
            moves,
            phase,
        })
    }

    fn restore(&mut self, saved: &SavedSession) -> Result<()> {
        let SavedSession::Tick { u, active, omega, best, moves, phase } = saved else {
            return saved.foreign();
        };
        check_length("session.active", active.len(), self.memory.active.len())?;
        let numbers = narrowed("session.omega, session.best", &[*omega, best[0], best[1]], 3)?;
        let [omega, best @ ..] = [0, 1, 2].map(|at| numbers[at]);
        let search = KeptSearch { omega, best, moves: *moves, phase: *phase };
        if search.search().is_none() {
            return Err(InputError::new("session.omega: expected a number in (0, 2)").into());
        }
        self.memory.u = narrowed("session.u", u, self.memory.u.len())?;
        self.memory.active.copy_from_slice(active);
        self.progress = Progress { search };
        Ok(())
    }

    fn answer(&self, at: &Problem) -> Result<Solution> {
        let Some(report) = &self.report else { return Ok(Solution::default()) };
        let Owned { u, tau, vertices, bubbles, .. } = &self.memory;
        let left = Numbers { u: &u[..], tau, vertices, bubbles, ..Numbers::default() };
        let found = answer(report, &left, &Units::default());
        let (counts, law) = (at.topology.counts, self.moving.law());
        let active = (0..counts.contact).map(|at| contact::is_active(counts, law, u, at));
        let bound = found.bound.filter(|_| self.data.has_bound());
        let of_verdict = || NoBound::of_verdict(&report.verdict, at, || None);
        let no_bound = self.data.no_bound().cloned().or_else(of_verdict);
        Ok(Solution { bound, no_bound, ..found }.with_active(at, active))
    }
}

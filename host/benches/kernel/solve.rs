//! Whole solves, to a residual that both scalars reach.

use criterion::{BatchSize, Bencher};
use signorini_kernel::Error;
use signorini_kernel::relaxation::Relaxation;
use signorini_kernel::rows::{Row, Rows};
use signorini_kernel::solver::{Outcome, Settings, Solver, Status};
use signorini_problem::Assembled;
use signorini_problem::scalar::Scalar;
use signorini_session::coarse;
use signorini_solve::prolongation::prolong;

use crate::strip::Strip;

fn settings<R: Scalar>(relaxation: Relaxation<R>) -> Settings<R> {
    Settings { relaxation, tolerance: R::narrow(1e-5), ..Settings::default() }
}

/// A solve with memory of its own.
struct Solve<'a, R: Scalar, const WIDTH: usize> {
    assembled: &'a Assembled<'a, R>,
    memory: Vec<Row<R, u32, WIDTH>>,
}

impl<'a, R: Scalar, const WIDTH: usize> Solve<'a, R, WIDTH> {
    fn new(assembled: &'a Assembled<R>) -> Self {
        let memory = vec![Row::EMPTY; assembled.edges().counts().unknowns()];
        Self { assembled, memory }
    }

    fn run(&mut self, relaxation: Relaxation<R>, u: &mut [R]) -> Result<Outcome<R>, Error> {
        let mut rows = Rows::new(self.assembled.edges(), &mut self.memory)?;
        Solver::<R>::new(settings(relaxation))?.run(&self.assembled.system()?, &mut rows, u)
    }

    /// The solution from nothing, and the ω found there.
    fn converged(&mut self) -> (Vec<R>, R) {
        let mut u = self.assembled.start();
        let outcome = self.run(Relaxation::Adaptive(R::ONE), &mut u).expect("one mesh");
        assert_eq!(outcome.status, Status::Converged);
        (u, outcome.omega)
    }
}

/// From nothing.
pub fn cold<R: Scalar, const WIDTH: usize>(bencher: &mut Bencher, strip: &Strip) {
    let assembled = strip.assembled::<R>();
    let mut solve = Solve::<R, WIDTH>::new(&assembled);
    solve.converged();
    let run = |u: &mut Vec<R>| solve.run(Relaxation::Adaptive(R::ONE), u);
    bencher.iter_batched_ref(|| assembled.start(), run, BatchSize::LargeInput);
}

/// From the solution for u_D that was 10 % smaller, with the ω found there.
pub fn warm<R: Scalar, const WIDTH: usize>(bencher: &mut Bencher, strip: &Strip) {
    let mut assembled = strip.assembled::<R>();
    let (mut before, omega) = Solve::<R, WIDTH>::new(&assembled).converged();
    assembled.set_loads(&strip.raised(1.1).loads).expect("the scalar holds the data");
    let unknowns = assembled.edges().counts().unknowns();
    before[unknowns..].copy_from_slice(assembled.dirichlet());
    let mut solve = Solve::<R, WIDTH>::new(&assembled);
    let run = |u: &mut Vec<R>| solve.run(Relaxation::Adaptive(omega), u);
    bencher.iter_batched_ref(|| before.clone(), run, BatchSize::LargeInput);
}

/// First on a mesh with a quarter of the cells; both solves count.
pub fn coarse_to_fine<R: Scalar, const WIDTH: usize>(bencher: &mut Bencher, strip: &Strip) {
    let coarse = Strip::new(strip.n / 2, strip.cells);
    let origins = coarse::origins(strip.problem(), coarse.problem()).expect("nested meshes");
    let (on_coarse, on_fine) = (coarse.assembled::<R>(), strip.assembled::<R>());
    let mut first = Solve::<R, WIDTH>::new(&on_coarse);
    let mut second = Solve::<R, WIDTH>::new(&on_fine);
    let (unknowns, given) = (on_fine.edges().counts().unknowns(), on_fine.dirichlet());
    let mut u = on_fine.start();
    bencher.iter(|| {
        let mut start = on_coarse.start();
        let found = first.run(Relaxation::Adaptive(R::ONE), &mut start)?;
        prolong(&origins, &start, &mut u)?;
        u[unknowns..].copy_from_slice(given);
        // Half the width of a cell takes half the 2 − ω.
        second.run(Relaxation::Adaptive(R::ONE + R::HALF * found.omega), &mut u)
    });
}

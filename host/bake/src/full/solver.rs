//! The method of a module, on this machine.

use signorini_device::full::controller::{Solver, Task};
use signorini_device::full::{Full, Memory};
use signorini_device::sparse::{Exact, Solved};
use signorini_device::tick::{
    CertifiedSweeps, Deadline, Figures, Limits, Method, Report, Running, Substitutions, Sweeping,
    UncertifiedSweeps,
};
use signorini_kernel::{Error, Libm};
use signorini_problem::scalar::Scalar;
use signorini_solve::Exchanges;

/// The method that the module has, chosen at run time; what it did last.
#[derive(Debug)]
pub struct DeskSolver<R: Scalar> {
    pub(super) is_fast: bool,
    pub(super) is_certified: bool,
    pub(super) exchanges: Option<Exchanges<R>>,
    pub(super) solved: Option<Solved<R>>,
    pub(super) figures: Option<Figures<R>>,
}

impl<R: Scalar> Solver<R, u32> for DeskSolver<R> {
    fn tick<F: FnMut() -> u32, const WIDTH: usize>(
        &mut self,
        full: &Full<R, u32>,
        Task { setup, inputs, limits }: Task<R, u32>,
        deadline: &mut Deadline<F>,
        memory: Memory<R, u32, WIDTH>,
        outputs: &mut [R],
    ) -> Result<Report<R>, Error> {
        let mut exact = match setup.factored.zip(self.exchanges.as_mut()) {
            Some((factored, own)) => {
                Some(Exact::new(*factored, own.memory(setup.lengths.active)?)?)
            }
            None => None,
        };
        let (limits, is_fast) = ((setup.units, limits), self.is_fast);
        let report = if self.is_certified {
            let roots = (CertifiedSweeps(R::FAST), CertifiedSweeps(Libm));
            let method = DeskMethod { exact: exact.as_mut(), is_fast, roots };
            full.tick(inputs, method, limits, deadline, memory, outputs)?
        } else {
            let roots = (UncertifiedSweeps(R::FAST), UncertifiedSweeps(Libm));
            let method = DeskMethod { exact: exact.as_mut(), is_fast, roots };
            full.tick(inputs, method, limits, deadline, memory, outputs)?
        };
        self.solved = exact.and_then(|exact| exact.solved()).filter(|_| report.sweeps == 0);
        self.figures = Some(report.figures);
        Ok(report)
    }
}

/// Sweeps by one of two square roots, after the factor where there is one: a choice at run time, where a module has the code of one.
struct DeskMethod<'e, 'a, R, S> {
    exact: Option<&'e mut Exact<'a, R, u32>>,
    is_fast: bool,
    /// With the fast root, and with libm's.
    roots: S,
}

impl<R, S, T> Method<R, u32> for DeskMethod<'_, '_, R, (S, T)>
where
    R: Scalar,
    S: Sweeping<R, u32> + Copy,
    T: Sweeping<R, u32> + Copy,
{
    const CERTIFIES: bool = T::CERTIFIES;

    fn restart(&mut self) -> Result<(), Error> {
        let Some(exact) = self.exact.as_deref_mut() else { return Ok(()) };
        Substitutions { exact, sweeps: self.roots.1 }.restart()
    }

    fn advance<F: FnMut() -> u32, const WIDTH: usize>(
        &mut self,
        running: &mut Running<'_, '_, '_, R, u32, WIDTH>,
        limits: Limits<R>,
        deadline: &mut Deadline<F>,
    ) -> Result<Report<R>, Error> {
        let ((mut fast, mut accurate), is_fast) = (self.roots, self.is_fast);
        match self.exact.as_deref_mut() {
            None if is_fast => fast.advance(running, limits, deadline),
            None => accurate.advance(running, limits, deadline),
            Some(exact) if is_fast => {
                Substitutions { exact, sweeps: fast }.advance(running, limits, deadline)
            }
            Some(exact) => {
                Substitutions { exact, sweeps: accurate }.advance(running, limits, deadline)
            }
        }
    }
}

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
    /// Of the last tick, in the scene's units.
    pub(super) figures: Figures<R>,
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
        let factored = setup.factored.zip(self.exchanges.as_mut());
        let mut exact = factored
            .map(|(factored, own)| Exact::new(*factored, own.memory(setup.lengths.active)?))
            .transpose()?;
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
        self.figures = setup.units.map_or(report.figures, |units| units.figures(report.figures));
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
        self.exact.as_deref_mut().map_or(Ok(()), Exact::restart)
    }

    fn advance<F: FnMut() -> u32, const WIDTH: usize>(
        &mut self,
        running: &mut Running<'_, '_, '_, R, u32, WIDTH>,
        limits: Limits<R>,
        deadline: &mut Deadline<F>,
    ) -> Result<Report<R>, Error> {
        let (mut fast, mut accurate) = self.roots;
        match (self.exact.as_deref_mut(), self.is_fast) {
            (None, true) => fast.advance(running, limits, deadline),
            (None, false) => accurate.advance(running, limits, deadline),
            (Some(exact), true) => {
                Substitutions { exact, sweeps: fast }.advance(running, limits, deadline)
            }
            (Some(exact), false) => {
                Substitutions { exact, sweeps: accurate }.advance(running, limits, deadline)
            }
        }
    }
}

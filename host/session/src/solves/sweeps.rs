//! Rows that a solve per tick sweeps over: a problem assembled in one scalar, or in f32 on residuals in f64.

use signorini_kernel::Error as KernelError;
use signorini_kernel::rows::{QUADS, Row, Rows, TRIANGLES};
use signorini_kernel::solver::{Outcome, Settings, Solver};
use signorini_problem::Assembled;
use signorini_problem::scalar::Scalar;
use signorini_solve::Mixed;

/// The result of sweeps that the kernel may refuse.
pub(super) type Refused<T> = Result<T, KernelError>;

/// An assembled problem that can be swept.
pub(crate) trait Sweeps<'p, R: Scalar> {
    /// The problem in the scalar of its answers.
    fn assembled(&self) -> &Assembled<'p, R>;

    /// See [`Sweeps::assembled`]; its loads may change.
    fn assembled_mut(&mut self) -> &mut Assembled<'p, R>;

    /// Sweeps from where `u` stands.
    fn run(&mut self, settings: Settings<R>, u: &mut [R]) -> Refused<Outcome<R>>;
}

impl<'p, R: Scalar> Sweeps<'p, R> for Assembled<'p, R> {
    fn assembled(&self) -> &Self {
        self
    }

    fn assembled_mut(&mut self) -> &mut Self {
        self
    }

    fn run(&mut self, settings: Settings<R>, u: &mut [R]) -> Refused<Outcome<R>> {
        match self.problem().mesh.quads.is_empty() {
            true => run::<R, TRIANGLES>(self, settings, u),
            false => run::<R, QUADS>(self, settings, u),
        }
    }
}

impl<'p> Sweeps<'p, f64> for Mixed<'p> {
    fn assembled(&self) -> &Assembled<'p, f64> {
        &self.wide
    }

    fn assembled_mut(&mut self) -> &mut Assembled<'p, f64> {
        &mut self.wide
    }

    fn run(&mut self, settings: Settings<f64>, u: &mut [f64]) -> Refused<Outcome<f64>> {
        Ok(Mixed::run(self, settings, u)?.outcome)
    }
}

/// Sweeps over rows of `WIDTH` entries until the solve ends.
fn run<R: Scalar, const WIDTH: usize>(
    assembled: &Assembled<R>,
    settings: Settings<R>,
    u: &mut [R],
) -> Refused<Outcome<R>> {
    let system = assembled.system()?;
    let mut memory = vec![Row::<R, u32, WIDTH>::EMPTY; system.counts().unknowns()];
    let mut rows = Rows::new(assembled.edges(), &mut memory)?;
    Solver::<R>::new(settings)?.run(&system, &mut rows, u)
}

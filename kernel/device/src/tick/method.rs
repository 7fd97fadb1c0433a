//! The ways to bring a tick to its answer, behind one face.
//!
//! ```text
//!   CertifiedSweeps(M)                sweeps with certificates between them ─► an answer with its bound
//!   UncertifiedSweeps(M)              sweeps ─► an answer
//!   Substitutions { exact, sweeps }   a factor ─► the solution; where it does not find it, `sweeps` do their best
//! ```
//! The caller names one where it calls [`Running::advance`] or [`crate::full::Full::tick`]. Each is a type of its
//! own, chosen when the program is compiled: an image has the code of those that it names, and of no other.
//! [`signorini_contact::method::Method`] is the same for the condensed model.

use super::{Deadline, Limits, Report, Running};
use signorini_kernel::{Error, Index, Real};

/// Brings a tick that has begun to its answer.
pub trait Method<R: Real, I: Index> {
    /// Whether answers have a bound.
    const CERTIFIES: bool = true;

    /// Forgets all earlier ticks, before the first one of a control loop.
    ///
    /// # Errors
    /// Memory that does not fit where the method begins.
    fn restart(&mut self) -> Result<(), Error> {
        Ok(())
    }

    /// Goes on from the present iterate until one of the limits or the deadline ends it.
    ///
    /// # Errors
    /// Never for a tick that has begun, but for a factor of another mesh.
    fn advance<F: FnMut() -> u32, const WIDTH: usize>(
        &mut self,
        running: &mut Running<'_, '_, '_, R, I, WIDTH>,
        limits: Limits<R>,
        deadline: &mut Deadline<F>,
    ) -> Result<Report<R>, Error>;
}

/// Sweeps, which know what is to be said of an answer: its bound, or nothing.
pub trait Sweeping<R: Real, I: Index>: Method<R, I> {
    /// Ends a tick whose iterate is the solution: τ is that of it, and the report says so.
    ///
    /// # Errors
    /// Never for a tick that has begun.
    fn conclude<const WIDTH: usize>(
        &self,
        running: &mut Running<'_, '_, '_, R, I, WIDTH>,
        limits: Limits<R>,
    ) -> Result<Report<R>, Error>;
}

impl<R: Real, I: Index, const WIDTH: usize> Running<'_, '_, '_, R, I, WIDTH> {
    /// Goes on by `method` until one of the limits or the deadline ends it.
    ///
    /// # Errors
    /// Never, but for a factor of another mesh.
    // Inlined: apart it lost the compiler's knowledge of the statics.
    #[inline(always)]
    pub fn advance<F: FnMut() -> u32>(
        &mut self,
        mut method: impl Method<R, I>,
        limits: Limits<R>,
        deadline: &mut Deadline<F>,
    ) -> Result<Report<R>, Error> {
        method.advance(self, limits, deadline)
    }
}

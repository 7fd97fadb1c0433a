//! Ticks from owned memory: everything is borrowed for one tick, and the next one goes on from there.

use super::{Memory, Tick};
use signorini_bound::certificate::Discretization;
use signorini_kernel::error::{Array, Error, same_length};
use signorini_kernel::mesh::edges::EdgeCounts;
use signorini_kernel::relaxation::{KeptSearch, Relaxation, Search};
use signorini_kernel::{Index, Real};

/// What a tick leaves to the next one besides its arrays: how far the search for ω has come.
///
/// Before the first tick it is [`Progress::NONE`], which is all zeros, so that a `static` that holds it
/// costs no flash. Of any bits it is that or a search, since memory may have lost some.
#[derive(Debug, Clone, Copy, Default)]
pub struct Progress<R> {
    /// How far the search for ω has come.
    pub search: KeptSearch<R>,
}

impl<R: Real> Progress<R> {
    /// No tick yet.
    pub const NONE: Self = Self { search: KeptSearch::NONE };

    /// Whether there has been a tick.
    pub fn has_begun(&self) -> bool {
        self.search.search().is_some()
    }

    /// As plain numbers.
    pub fn numbers(&self) -> [R; 5] {
        self.search.numbers()
    }

    /// From such numbers.
    pub fn of_numbers(numbers: [R; 5]) -> Self {
        Self { search: KeptSearch::of_numbers(numbers) }
    }

    /// That of a first tick; `relaxation` is where ω starts.
    ///
    /// # Errors
    /// An ω outside (0, 2).
    pub fn new(relaxation: Relaxation<R>) -> Result<Self, Error> {
        Ok(Self { search: Search::checked(relaxation)?.kept() })
    }
}

impl<'a, R: Real, I: Index, const WIDTH: usize> Tick<'a, R, I, WIDTH> {
    /// Goes on where a tick ended whose [`Tick::progress`] this is: `memory.u` and `memory.active` are the
    /// answer and the active set that it left, and what else is in `memory` does not matter.
    ///
    /// # Errors
    /// Arrays of the wrong length, [`Progress::NONE`].
    pub fn resume(
        discretization: Discretization<'a, R, I>,
        memory: Memory<'a, R, I, WIDTH>,
        progress: Progress<R>,
    ) -> Result<Self, Error> {
        check(&discretization, &memory)?;
        let search = progress.search.search().ok_or(Error::Relaxation)?;
        Ok(Self { discretization, memory, search, report: None })
    }

    /// What the next tick needs besides the memory.
    pub fn progress(&self) -> Progress<R> {
        Progress { search: self.search.kept() }
    }

    /// Sizes of the blocks of edges.
    pub fn counts(&self) -> EdgeCounts {
        self.discretization.edges.counts()
    }
}

/// Lengths of the memory.
pub(super) fn check<R: Real, I: Index, const WIDTH: usize>(
    discretization: &Discretization<R, I>,
    memory: &Memory<R, I, WIDTH>,
) -> Result<(), Error> {
    let counts = discretization.edges.counts();
    let vertices = discretization.mesh.vertices().len();
    same_length(Array::Rows, memory.rows.counts().edges(), counts.edges())?;
    same_length(Array::Load, memory.load.len(), counts.unknowns())?;
    same_length(Array::Contact, memory.active.len(), counts.contact)?;
    same_length(Array::Vertices, memory.vertices.len(), vertices)?;
    same_length(Array::Fluxes, memory.tau.len(), counts.edges())?;
    same_length(Array::Unknowns, memory.u.len(), counts.edges())
}

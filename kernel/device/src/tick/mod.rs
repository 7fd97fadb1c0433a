//! Contact in a control loop: new data every tick, an answer with its error bound at the deadline.
//!
//! ```text
//!   Tick ── begin(data) ─► Running ── advance(method, limits, deadline) ─► Report      as often as time allows
//!    ▲                        │
//!    └──── the next tick starts from this one's iterate and active set
//! ```
//! Mesh, A and forest stay ([`Discretization`]); loads, gaps, Dirichlet values and transfer coefficients change with every
//! tick, and nothing is built anew but the rows. A root of the forest keeps a coefficient > 0, and
//! [`signorini_bound::certificate::Stability`] is that of the least ones. Data that are not finite, or so large that their answer may overflow, are
//! refused before anything changes: the last answer and its report stay.
//!
//! A [`Method`] brings a tick to its answer. Of [`CertifiedSweeps`] as many lie between two certificates as the
//! algebraic part asks for: two certificates tell how fast it falls, and the next is due when it should be small
//! enough, though not before the sweeps since the last one have taken as long as a certificate does.
//!
//! Every part of the domain needs a Dirichlet or a Robin edge, through which what an unfinished iterate leaves
//! out of balance can go: then every answer has a bound. Parts that contact alone holds need a forest that
//! follows the active set, and shifts of the whole part ([`signorini_kernel::solver`]).

mod certified;
mod method;
mod range;
mod resume;
mod running;
mod step;
mod substitutions;
mod uncertified;

pub use certified::CertifiedSweeps;
pub use method::{Method, Sweeping};
pub use resume::Progress;
pub use running::{Figures, Report, Running};
pub use signorini_kernel::limits::{Deadline, Limits};
pub use signorini_kernel::report::Ended;
pub use signorini_kernel::storage::IfStoring;
pub use step::InStep;
pub use substitutions::Substitutions;
pub use uncertified::UncertifiedSweeps;

use signorini_bound::certificate::{Discretization, LoadCase};
use signorini_kernel::error::{Array, Error, all_finite, same_length};
use signorini_kernel::law::Law;
use signorini_kernel::mesh::diagonal::DiagonalTerms;
use signorini_kernel::mesh::edges::EdgeCounts;
use signorini_kernel::relaxation::{Relaxation, Search};
use signorini_kernel::rows::Rows;
use signorini_kernel::{Index, Real, assembly};

/// Memory of a [`Tick`] (borrowed).
#[derive(Debug)]
pub struct Memory<'a, R, I, const WIDTH: usize> {
    /// Packed rows of all unknowns.
    pub rows: Rows<'a, R, I, WIDTH>,
    /// The load, one entry an unknown.
    pub load: &'a mut [R],
    /// Whether a contact edge was active, one entry each.
    pub active: &'a mut [bool],
    /// s at the vertices; as many as the mesh has.
    pub vertices: &'a mut [R],
    /// The bubbles of s, one entry an edge; may be empty where there are no quads.
    pub bubbles: &'a mut [R],
    /// τ, one entry an edge.
    pub tau: &'a mut [R],
    /// Means of u, one entry an edge: where the first tick starts.
    pub u: &'a mut [R],
}

/// A contact problem whose data change from tick to tick.
#[derive(Debug)]
pub struct Tick<'a, R: Real, I, const WIDTH: usize> {
    discretization: Discretization<'a, R, I>,
    memory: Memory<'a, R, I, WIDTH>,
    search: Search<R>,
    report: Option<Report<R>>,
}

/// Data of one tick (borrowed).
#[derive(Debug, Clone, Copy)]
pub struct Data<'a, R, I> {
    /// Loads and boundary data, as the certificate takes them.
    pub given: LoadCase<'a, R, I>,
    /// The law on the contact edges.
    pub law: Law<'a, R>,
    /// Means of u_D, one a Dirichlet edge.
    pub dirichlet: &'a [R],
    /// Where the tick is a step in time.
    pub step: IfStoring<'a, InStep<'a, R>>,
}

impl<'a, R: Real, I: Index> Data<'a, R, I> {
    /// Terms on the diagonal beyond the element matrices.
    pub(crate) fn diagonal(&self) -> DiagonalTerms<'a, R, I> {
        match self.step.get() {
            Some(step) => DiagonalTerms::in_step(step.diagonal),
            None => DiagonalTerms::new(&self.given.boundary),
        }
    }
}

impl<'a, R: Real, I: Index, const WIDTH: usize> Tick<'a, R, I, WIDTH> {
    /// Takes mesh and memory for a first tick, with no edge in contact so far; `relaxation` is where ω starts.
    ///
    /// # Errors
    /// Arrays of the wrong length, a start that is not finite, an ω outside (0, 2).
    pub fn new(
        discretization: Discretization<'a, R, I>,
        memory: Memory<'a, R, I, WIDTH>,
        relaxation: Relaxation<R>,
    ) -> Result<Self, Error> {
        resume::check(&discretization, &memory)?;
        all_finite(Array::Unknowns, memory.u)?;
        memory.active.fill(false);
        let search = Search::checked(relaxation)?;
        Ok(Self { discretization, memory, search, report: None })
    }

    /// Takes the data of a tick. Where an edge was in contact it starts on the new gap, and everything
    /// else where it was, lifted onto the gap where needed; an iterate that is larger than the data by more than
    /// 2¹⁰/ε starts with zeros.
    ///
    /// # Errors
    /// Arrays of the wrong length, numbers that are not finite or within 1/ε² of the largest one, where the answer
    /// may overflow (ψ, u_D, b and b_i/K_ii): the last answer stays then, bit for bit.
    pub fn begin<'t, 'd>(
        &'t mut self,
        data: Data<'d, R, I>,
    ) -> Result<Running<'t, 'd, 'a, R, I, WIDTH>, Error> {
        let size = self.admit(&data)?;
        Ok(self.enter(data, size))
    }

    /// Lays out load and rows, which no answer is in, and returns the size of the data in the unit of u.
    pub(crate) fn admit(&mut self, data: &Data<R, I>) -> Result<R, Error> {
        check(data, &self.discretization)?;
        let (edges, given) = (&self.discretization.edges, &data.given);
        assembly::load(edges, given.loads, &given.boundary, self.memory.load)?;
        if let Some(step) = data.step.get() {
            step.step.storage.add_to_load(edges, self.memory.load);
        }
        self.lay_out_rows(data)?;
        range::size(data, &self.memory)
    }

    /// The rows for the present load and ω.
    fn lay_out_rows(&mut self, data: &Data<R, I>) -> Result<(), Error> {
        let Self { discretization, memory, search, .. } = self;
        let (edges, stiffness) = (&discretization.edges, discretization.stiffness);
        memory.rows.gather(edges, stiffness, data.diagonal(), memory.load, search.omega)
    }

    /// Begins with data that have been admitted.
    #[inline(always)]
    pub(crate) fn enter<'t, 'd>(
        &'t mut self,
        data: Data<'d, R, I>,
        size: R,
    ) -> Running<'t, 'd, 'a, R, I, WIDTH> {
        self.search.disturb();
        self.memory.carry_over(self.discretization.edges.counts(), &data, size);
        Running::new(self, data, size)
    }

    /// The memory, for a start.
    pub(crate) fn memory(&mut self) -> &mut Memory<'a, R, I, WIDTH> {
        &mut self.memory
    }

    /// Means of u over the edges, as the last [`Running::advance`] left them.
    pub fn u(&self) -> &[R] {
        self.memory.u
    }

    /// s at the vertices, as last certified.
    pub fn vertices(&self) -> &[R] {
        self.memory.vertices
    }

    /// The bubbles of s, as last certified.
    pub fn bubbles(&self) -> &[R] {
        self.memory.bubbles
    }

    /// ∫_E τ·n of every edge along its direction, as last certified.
    pub fn tau(&self) -> &[R] {
        self.memory.tau
    }

    /// The last answer, where there has been one.
    pub fn report(&self) -> Option<&Report<R>> {
        self.report.as_ref()
    }
}

impl<R: Real, I: Index, const WIDTH: usize> Memory<'_, R, I, WIDTH> {
    #[inline(always)]
    fn carry_over(&mut self, counts: EdgeCounts, data: &Data<R, I>, size: R) {
        self.forget_another_size(counts.unknowns(), size);
        let given = self.u.iter_mut().skip(counts.unknowns());
        given.zip(data.dirichlet).for_each(|(u, &value)| *u = value);
        // An overflow of the last tick: start anew.
        let unknowns = self.u.iter_mut().take(counts.unknowns());
        unknowns.filter(|u| !u.finite()).for_each(|u| *u = R::ZERO);
        let on_contact = self.u.iter_mut().skip(counts.free);
        for ((u, law), &active) in on_contact.zip(data.law.edges()).zip(self.active.iter()) {
            if active || !law.admits(*u) {
                *u = law.gap();
            }
        }
    }
}

/// Lengths and finiteness of everything that a tick may change.
fn check<R: Real, I: Index>(
    data: &Data<R, I>,
    discretization: &Discretization<R, I>,
) -> Result<(), Error> {
    let counts = discretization.edges.counts();
    let Data { given, law, dirichlet, .. } = data;
    law.check_length(counts)?;
    same_length(Array::Dirichlet, dirichlet.len(), counts.dirichlet)?;
    same_length(Array::Contact, given.ends.gap.len(), counts.contact)?;
    same_length(Array::Dirichlet, given.ends.given.len(), counts.dirichlet)?;
    law.check_finite()?;
    all_finite(Array::Dirichlet, dirichlet)?;
    all_finite(Array::Contact, given.ends.gap.as_flattened())?;
    all_finite(Array::Dirichlet, given.ends.given.as_flattened())?;
    all_finite(Array::CellLoads, given.loads.triangles)?;
    all_finite(Array::CellLoads, given.loads.quads)?;
    all_finite(Array::Robin, given.transfer.as_flattened().as_flattened())?;
    all_finite(Array::Load, &[given.oscillation])?;
    for (at, curved) in given.curved.iter().enumerate() {
        let numbers = [curved.mean, curved.energy];
        let known = numbers.iter().chain(&curved.coupling).all(|number| number.finite());
        if !known {
            return Err(Error::NotFinite { of: Array::Edges, at });
        }
    }
    Ok(())
}

/// Active edges, and how many of them differ from `before`.
fn contact_state<R: Real>(counts: EdgeCounts, law: Law<R>, u: &[R], before: &[bool]) -> (u32, u32) {
    let (mut active, mut changes) = (0, 0);
    for (at, &was) in before.iter().enumerate() {
        let is = signorini_kernel::contact::is_active(counts, law, u, at);
        active += u32::from(is);
        changes += u32::from(is != was);
    }
    (active, changes)
}

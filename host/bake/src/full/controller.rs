//! What the baked module does, on this machine and on the same numbers.

use signorini_bound::certificate::Curved;
use signorini_device::full::{Lengths, Numbers, Storage};
use signorini_device::ranges::check;
use signorini_device::sparse::{Exact, Solved};
use signorini_device::tick::{
    CertifiedSweeps, Deadline, Limits, Method, Report, Substitutions, UncertifiedSweeps,
};
use signorini_kernel::Error as KernelError;
use signorini_kernel::mesh::boundary::{Neumann, Robin};
use signorini_kernel::rows::Row;
use signorini_kernel::{Libm, Math};

use super::arrays::Baked;
use signorini_problem::scalar::Scalar;
use signorini_solve::{Exchanges, exchanges};

/// The memory of a baked scene.
type Owned<R, const WIDTH: usize> = Storage<
    R,
    Vec<Row<R, u32, WIDTH>>,
    Vec<R>,
    Vec<bool>,
    Vec<Neumann<R, u32>>,
    Vec<Robin<R, u32>>,
    Vec<Curved<R, u32>>,
>;

/// The controller of a baked scene; `WIDTH` is 4 on triangles alone and else 6.
#[derive(Debug)]
pub struct Controller<'b, R: Scalar, const WIDTH: usize> {
    baked: &'b Baked<R>,
    lengths: Lengths,
    storage: Owned<R, WIDTH>,
    exchanges: Option<Exchanges<R>>,
    solved: Option<Solved<R>>,
    certificates: u32,
}

impl<'b, R: Scalar, const WIDTH: usize> Controller<'b, R, WIDTH> {
    /// Before the first tick.
    pub fn new(baked: &'b Baked<R>) -> Self {
        let lengths = baked.lengths();
        let storage = Storage::of(
            vec![Row::EMPTY; lengths.rows],
            vec![R::ZERO; lengths.numbers.sum()],
            vec![false; lengths.active],
            vec![Neumann::default(); lengths.neumann],
            vec![Robin::default(); lengths.robin],
            vec![Curved::default(); lengths.curved],
        );
        let exchanges = baked.factored.as_ref().map(|_| exchanges(lengths.active));
        Self { baked, lengths, storage, exchanges, solved: None, certificates: 0 }
    }

    /// Outputs and report for these inputs, within the limits of the baked module.
    ///
    /// # Errors
    /// Inputs outside their ranges, that are not finite, of another number, or so large that data or answers may overflow: the last answer
    /// stays. A `WIDTH` that is not that of the mesh.
    pub fn tick(&mut self, inputs: &[R]) -> Result<(Vec<R>, Report<R>), KernelError> {
        self.tick_within(inputs, self.baked.how.limits)
    }

    /// The same within other limits.
    ///
    /// # Errors
    /// As for [`Controller::tick`].
    pub fn tick_within(
        &mut self,
        inputs: &[R],
        limits: Limits<R>,
    ) -> Result<(Vec<R>, Report<R>), KernelError> {
        let (baked, lengths) = (self.baked, &self.lengths);
        check(inputs, &baked.face.ranges::<R>())?;
        if baked.how.cold {
            self.storage.reset();
        }
        let limits = baked.scale.map_or(limits, |scale| scale.limits(limits));
        let mut outputs = vec![R::ZERO; baked.outputs.len()];
        let factored = baked.factored.as_ref().zip(self.exchanges.as_mut());
        let mut exact = match factored {
            Some((factored, own)) => {
                Some(Exact::new(factored.view(), own.memory(lengths.active)?)?)
            }
            None => None,
        };
        let mut looks = 0;
        let call = Call {
            baked,
            inputs,
            limits,
            lengths,
            storage: &mut self.storage,
            outputs: &mut outputs,
            looks: &mut looks,
        };
        let report = match baked.how.fast {
            true => call.with(R::FAST, exact.as_mut())?,
            false => call.with(Libm, exact.as_mut())?,
        };
        // The clock is asked before every sweep and once more at the end, at every certificate, and after each but the last.
        self.certificates = (looks.saturating_sub(report.sweeps) / 2).max(1);
        self.solved = exact.and_then(|exact| exact.solved()).filter(|_| report.sweeps == 0);
        let report = match baked.scale {
            Some(scale) => scale.answer(&baked.outputs, &mut outputs, report),
            None => report,
        };
        Ok((outputs, report))
    }

    /// Certificates of the last tick, where it was swept.
    pub fn certificates(&self) -> u32 {
        self.certificates
    }

    /// What the factor did in the last tick; `None` without one, or where sweeps had to help.
    pub fn solved(&self) -> Option<Solved<R>> {
        self.solved
    }

    /// Whether the factor alone answers for these inputs.
    pub(super) fn solves(&mut self, inputs: &[R]) -> bool {
        self.tick(inputs).is_ok_and(|(_, report)| report.sweeps == 0 && report.residual.finite())
    }

    /// Means of u over the edges, in [`Baked::units`] as all arrays below.
    pub fn u(&self) -> &[R] {
        self.numbers().u
    }

    /// ∫τ·n of every edge along its direction: balanced, or of a tick without certificate σ_h of (15).
    pub fn tau(&self) -> &[R] {
        self.numbers().tau
    }

    /// Means of ψ over the contact edges in the last tick.
    pub fn lower(&self) -> &[R] {
        let own = self.numbers().gap;
        if own.is_empty() { &self.baked.data.gap } else { own }
    }

    /// s at the vertices; empty without a certificate.
    pub fn vertices(&self) -> &[R] {
        self.numbers().vertices
    }

    /// The bubbles of s, one an edge; empty without quads or certificate.
    pub fn bubbles(&self) -> &[R] {
        self.numbers().bubbles
    }

    fn numbers(&self) -> Numbers<&[R]> {
        self.storage.numbers(&self.lengths).unwrap_or_default()
    }
}

/// The call that the module has in its `tick_within`, but for the method.
struct Call<'c, R: Scalar, const WIDTH: usize> {
    baked: &'c Baked<R>,
    inputs: &'c [R],
    limits: Limits<R>,
    lengths: &'c Lengths,
    storage: &'c mut Owned<R, WIDTH>,
    outputs: &'c mut [R],
    /// Becomes how often the clock was asked.
    looks: &'c mut u32,
}

impl<R: Scalar, const WIDTH: usize> Call<'_, R, WIDTH> {
    /// The method is the baked one, with this square root.
    fn with<M: Math<R> + Copy>(
        self,
        math: M,
        exact: Option<&mut Exact<R, u32>>,
    ) -> Result<Report<R>, KernelError> {
        let (certified, plain) = (CertifiedSweeps(math), UncertifiedSweeps(math));
        match (exact, self.baked.how.certified) {
            (None, true) => self.by(certified),
            (None, false) => self.by(plain),
            (Some(exact), true) => self.by(Substitutions { exact, sweeps: certified }),
            (Some(exact), false) => self.by(Substitutions { exact, sweeps: plain }),
        }
    }

    fn by(self, method: impl Method<R, u32>) -> Result<Report<R>, KernelError> {
        let Self { baked, inputs, limits, lengths, storage, outputs, looks } = self;
        let clock = || {
            *looks += 1;
            u32::MAX
        };
        let never = &mut Deadline { remaining: clock, sweep: 0, certificate: 0 };
        baked.with(|full| {
            let memory = storage.memory(full, lengths)?;
            full.tick(inputs, method, limits, never, memory, outputs)
        })
    }
}

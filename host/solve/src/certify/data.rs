//! Loads and boundary data of one time as the kernel's certificate takes them.

use signorini_kernel::Error as KernelError;
use signorini_kernel::certificate::{Curved, Given};
use signorini_kernel::conforming::VertexData;

use super::curved::{Curved as Bent, Rough, bends};
use super::ends::Ends;
use super::no_bound::{NoBound, Spot, VARYING};
use super::oscillation::oscillation;
use super::robin::{RobinPoints, robin};
use crate::problem::{Assembled, Problem};
use crate::scalar::Scalar;
use signorini_scene::error::Result;
use signorini_scene::scene::Scene;

/// What the certificate needs of the data beyond [`Assembled`], in the scalar `R`.
#[derive(Debug, Clone)]
pub struct Data<R> {
    gap: Vec<[R; 2]>,
    given: Vec<[R; 2]>,
    curved: Vec<Curved<R, u32>>,
    transfer: Vec<[[R; 2]; 8]>,
    oscillation: R,
    no_bound: Option<NoBound>,
}

/// Whether a coefficient at the points of an edge allows for a bound.
fn is_moderate(edge: &RobinPoints) -> bool {
    let low = edge.iter().fold(f64::INFINITY, |low, point| low.min(point[0]));
    let high = edge.iter().fold(0.0, |high: f64, point| high.max(point[0]));
    high <= VARYING * low
}

/// Why data on an edge allow for no bound.
fn roughness(scene: &Scene, problem: &Problem, curved: &Bent) -> Option<NoBound> {
    let spot = |t| Spot::on_edge(scene, problem, curved.edge as usize, t);
    Some(match curved.rough? {
        Rough::Jump(t) => NoBound::Jump { of: spot(t) },
        Rough::Steep(t) => NoBound::Steep { of: spot(t) },
    })
}

/// Where a transfer coefficient nearly vanishes.
fn vanishing(scene: &Scene, problem: &Problem, transfer: &[RobinPoints]) -> Option<NoBound> {
    let at = transfer.iter().position(|edge| !is_moderate(edge))?;
    let edge = problem.loads.robin.get(at)?.edge as usize;
    Some(NoBound::transfer_vanishes(scene, problem, edge))
}

impl<R: Scalar> Data<R> {
    /// Evaluates the data of `scene` at the time of `problem`.
    ///
    /// # Errors
    /// Data that are not finite.
    pub fn new(scene: &Scene, problem: &Problem) -> Result<Self> {
        let time = problem.time;
        let pairs = |all: &[[f64; 2]]| all.iter().map(|pair| pair.map(R::narrow)).collect();
        let ends = Ends::at_time(scene, problem, time)?;
        let bends = bends(scene, problem, time)?;
        // s is off by that much, and once more where u_h is compared with it.
        let left_out = 2.0 * (bends.left_out + ends.moved(scene, problem));
        let curved = bends.records;
        let rough = curved.iter().find_map(|of| roughness(scene, problem, of));
        let curved = curved.into_iter().map(|of| Curved {
            edge: of.edge,
            mean: R::narrow(of.mean),
            energy: R::narrow(of.energy),
            coupling: of.coupling.map(R::narrow),
        });
        let of_cells = oscillation(scene, problem, time)?;
        let squares: f64 = of_cells.iter().map(|osc| osc * osc).sum();
        let mut transfer = robin(scene, problem, time)?;
        let no_bound =
            rough.or_else(|| ends.jump(problem)).or_else(|| vanishing(scene, problem, &transfer));
        if transfer.iter().all(|edge| edge.iter().all(|point| *point == edge[0])) {
            transfer.clear();
        }
        Ok(Self {
            gap: pairs(&ends.gap),
            given: pairs(&ends.given),
            curved: curved.collect(),
            transfer: transfer.iter().map(|edge| edge.map(|point| point.map(R::narrow))).collect(),
            oscillation: R::narrow(squares.sqrt() + left_out),
            no_bound,
        })
    }

    /// Whether these data allow for a bound: u_D is continuous, ψ is along each edge, and no transfer coefficient nearly
    /// vanishes on a part of an edge.
    pub fn has_bound(&self) -> bool {
        self.no_bound.is_none()
    }

    /// What f, g, q, ψ and u_D leave out.
    pub fn oscillation(&self) -> R {
        self.oscillation
    }

    /// Why these data allow for none.
    pub fn no_bound(&self) -> Option<&NoBound> {
        self.no_bound.as_ref()
    }

    /// Together with the loads of `assembled`.
    ///
    /// # Errors
    /// Boundary records that are not admissible in this scalar.
    pub fn given<'a>(
        &'a self,
        assembled: &'a Assembled<R>,
    ) -> std::result::Result<Given<'a, R, u32>, KernelError> {
        Ok(Given {
            loads: assembled.cells(),
            boundary: assembled.boundary()?,
            ends: VertexData { gap: &self.gap, given: &self.given },
            curved: &self.curved,
            transfer: &self.transfer,
            oscillation: self.oscillation,
        })
    }
}

//! Why a scene's answer has no error bound.

use std::fmt;

use signorini_bound::certificate::Verdict;

use super::curved::{Curved, Rough};
use super::ends::Ends;
use super::robin::RobinPoints;
use signorini_problem::scalar::Scalar;
use signorini_problem::{Problem, spread};
use signorini_scene::scene::Field;

/// By how much a transfer coefficient may vary along an edge: where it nearly vanishes, ∫(τ·n)²/h is
/// beyond 8 points, and infinite where it does.
const VARYING: f64 = 10.0;

/// Why there is no bound; its text is one sentence that names boundary and place.
#[derive(Debug, Clone, PartialEq)]
pub enum NoBound {
    /// u_D has two values where two Dirichlet edges meet: no function of finite energy has both.
    ValuesDiffer {
        /// The vertex.
        at: [f64; 2],
        /// u_D there, from one edge and from the other.
        values: [f64; 2],
    },
    /// u_D or ψ jumps inside an edge: no function of finite energy follows it.
    Jump {
        /// Where.
        of: Spot,
    },
    /// u_D or ψ rises too steeply inside an edge: the function s that follows it into the cell has infinite energy.
    Steep {
        /// Where.
        of: Spot,
    },
    /// A transfer coefficient nearly vanishes on a part of an edge, where it divides the square of a flux.
    TransferVanishes {
        /// The Robin boundary.
        boundary: String,
        /// The middle of the edge.
        at: [f64; 2],
    },
    /// The ends of a contact edge's flux come so near to each other on a part of it that means of them say too little.
    LimitVaries {
        /// The contact boundary.
        boundary: String,
        /// The middle of the edge.
        at: [f64; 2],
    },
    /// Neither a Dirichlet, Robin nor contact edge belongs to a part, so that nothing can take its surplus.
    HeldByNothing {
        /// A point in the part.
        at: [f64; 2],
    },
    /// Contact alone holds a part, and no edge of it is active in this iterate.
    NothingActive {
        /// A point in the part.
        at: [f64; 2],
    },
    /// Contact alone holds a part, and the surplus of this iterate would pull at a contact edge.
    Pulled {
        /// The contact boundary.
        boundary: String,
        /// The middle of the edge.
        at: [f64; 2],
    },
    /// Numbers of the bound overflow the scalar.
    Overflow {
        /// `f32` or `f64`.
        scalar: &'static str,
    },
    /// Nobody asked for a bound.
    NotAsked,
    /// A condensed model's own reason.
    Condensed(String),
}

/// A place on a boundary.
#[derive(Debug, Clone, PartialEq)]
pub struct Spot {
    /// The boundary's name in the scene.
    pub boundary: String,
    /// [`Field::Gap`] or [`Field::Value`].
    pub field: Field,
    /// The place.
    pub at: [f64; 2],
}

impl Spot {
    /// That at the part `t` of an edge on C or D.
    pub fn on_edge(problem: &Problem, edge: usize, t: f64) -> Self {
        let is_contact = edge < problem.topology.counts.unknowns();
        Self {
            boundary: boundary(problem, edge),
            field: if is_contact { Field::Gap } else { Field::Value },
            at: problem.along(edge, t),
        }
    }
}

impl NoBound {
    /// Reasons that [`NoBound::of_data`] may find, for callers that have not kept it.
    pub const OF_DATA: &str = "u_D jumps between two edges, u_D or ψ jumps inside one, a transfer coefficient nearly vanishes, the range of a contact flux does, or inputs change one that varies along an edge";

    /// Why these data allow for no bound, whatever the iterate.
    pub fn of_data(
        problem: &Problem,
        ends: &Ends,
        curved: &[Curved],
        transfer: &[RobinPoints],
    ) -> Option<Self> {
        let rough = || curved.iter().find_map(|edge| Self::rough(problem, edge));
        let jump = || ends.jump(problem).map(|(at, values)| Self::ValuesDiffer { at, values });
        let vanishes = || Self::transfer_vanishes(problem, transfer);
        rough().or_else(jump).or_else(vanishes).or_else(|| Self::limit_varies(problem))
    }

    /// The first contact edge on which hi − lo falls below half of its mean: only above that are all fluxes between the
    /// means of both ends between the ends themselves, once one of these is moved to its mean.
    fn limit_varies(problem: &Problem) -> Option<Self> {
        let (free, time) = (problem.topology.counts.free, problem.time);
        let falls =
            |edge: &usize| spread(problem, *edge, time).is_some_and(|spread| spread.least < 0.5);
        let edge = (free..free + problem.loads.spans.len()).find(falls)?;
        Some(Self::LimitVaries { boundary: boundary(problem, edge), at: middle(problem, edge) })
    }

    fn rough(problem: &Problem, curved: &Curved) -> Option<Self> {
        let spot = |t| Spot::on_edge(problem, curved.edge as usize, t);
        Some(match curved.rough? {
            Rough::Jump(t) => Self::Jump { of: spot(t) },
            Rough::Steep(t) => Self::Steep { of: spot(t) },
        })
    }

    /// The first transfer edge along which the coefficient varies too much.
    fn transfer_vanishes(problem: &Problem, transfer: &[RobinPoints]) -> Option<Self> {
        let at = transfer.iter().position(|edge| !is_moderate(edge))?;
        let edge = problem.loads.robin.get(at)?.edge as usize;
        let boundary = boundary(problem, edge);
        Some(Self::TransferVanishes { boundary, at: middle(problem, edge) })
    }

    /// The kernel's reason; `data` gives that of data which never allow for a bound.
    pub fn of_verdict<R: Scalar>(
        verdict: &Verdict<R>,
        problem: &Problem,
        data: impl FnOnce() -> Option<Self>,
    ) -> Option<Self> {
        let condensed = |reason: &str| Self::Condensed(reason.to_owned());
        Some(match verdict {
            Verdict::Certified(_) => return None,
            Verdict::Pulled { edge } => Self::pulled(problem, *edge),
            Verdict::Unpressed => condensed(
                "contact alone holds a part of the mesh, and no edge is pressed hard enough to take what its fluxes \
                 leave unbalanced",
            ),
            Verdict::BelowGap => condensed(
                "a Dirichlet value lies below the gap where both boundaries meet: no solution has both",
            ),
            Verdict::Unavailable => return data().or(Some(Self::NotAsked)),
            Verdict::NotFinite => Self::Overflow { scalar: R::NAME },
            Verdict::NotAsked => Self::NotAsked,
        })
    }

    /// A contact edge that would be pulled at.
    pub fn pulled(problem: &Problem, edge: usize) -> Self {
        Self::Pulled { boundary: boundary(problem, edge), at: middle(problem, edge) }
    }
}

/// Whether a coefficient at the points of an edge allows for a bound.
fn is_moderate(edge: &RobinPoints) -> bool {
    let low = edge.iter().fold(f64::INFINITY, |low, point| low.min(point[0]));
    let high = edge.iter().fold(0.0, |high: f64, point| high.max(point[0]));
    high <= VARYING * low
}

fn middle(problem: &Problem, edge: usize) -> [f64; 2] {
    let [a, b] = problem.segment(edge);
    [0, 1].map(|k| 0.5 * (a[k] + b[k]))
}

/// The name of the boundary that an edge lies on.
fn boundary(problem: &Problem, edge: usize) -> String {
    problem.boundary_of(edge).map_or("default", |of| &of.name.value).to_owned()
}

/// A point with six digits: where data are rough is not known better.
fn place(at: &[f64; 2]) -> String {
    let [x, y] = at.map(|x| format!("{:.5e}", x + 0.0).parse().unwrap_or(x));
    format!("({x}, {y})")
}

impl fmt::Display for NoBound {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::ValuesDiffer { at, values: [a, b] } => write!(
                f,
                "the Dirichlet value jumps from {a} to {b} at {}: no function of finite energy has both values",
                place(at)
            ),
            Self::Jump { of } => {
                write!(f, "{of} jumps: no function of finite energy follows it")
            }
            Self::Steep { of } => {
                write!(
                    f,
                    "{of} rises too steeply: what follows it along the edge has infinite energy"
                )
            }
            Self::TransferVanishes { boundary, at } => write!(
                f,
                "the transfer coefficient of boundary.{boundary} varies by more than a factor of {VARYING} along the edge \
                 around {}: the bound divides by it where it nearly vanishes",
                place(at)
            ),
            Self::LimitVaries { boundary, at } => write!(
                f,
                "limit − flux of boundary.{boundary} falls below half of its mean along the edge around {}: a finer mesh \
                 there gives a bound",
                place(at)
            ),
            Self::HeldByNothing { at } => write!(
                f,
                "the part of the mesh around {} has neither a dirichlet, a robin nor a contact edge: nothing can take \
                 what its fluxes leave unbalanced",
                place(at)
            ),
            Self::NothingActive { at } => write!(
                f,
                "contact alone holds the part of the mesh around {}, and nothing touches there: no edge can take what \
                 its fluxes leave unbalanced",
                place(at)
            ),
            Self::Pulled { boundary, at } => write!(
                f,
                "contact alone holds a part of the mesh, and what its fluxes leave unbalanced would pull at \
                 boundary.{boundary} around {}: more sweeps may give a bound",
                place(at)
            ),
            Self::Overflow { scalar } => write!(f, "the numbers of the bound overflow {scalar}"),
            Self::NotAsked => write!(f, "no bound was asked for"),
            Self::Condensed(reason) => write!(f, "{reason}"),
        }
    }
}

impl fmt::Display for Spot {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let field = if self.field == Field::Gap { "gap" } else { "value" };
        write!(f, "the {field} of boundary.{} near {}", self.boundary, place(&self.at))
    }
}

//! Weights of an answer's error bound in an output: the few numbers that a controller has.
//!
//! ```text
//!   |J(σ) − J(τ)| ≤ ‖A∇z‖ · total       a flux or a force, z = ±1 on its boundary and 0 on the rest of C and D
//!   |J(u) − J(s)| ≤ ‖ζ‖ · total         a mean, ζ·n = 1/|P| on P and 0 on the rest of N and C
//! ```
//! They hold for all loads and on whatever sides of ψ the edges are, and are of first order: the intervals of a solve ([`super`])
//! know its contact zone and are narrower. Where an edge is open in all answers, with s − ψ ≥ e there, z may be off its value by
//! c e, which adds c/2 · total². Where boundaries of C meet, z jumps, and an edge beside counts with its λ: 0 where it is always open.
//!
//! A controller gives u_h and σ_h. σ_h is τ but for the algebraic part of the bound. Means of s and u_h over an edge are equal
//! between quads, where s is that of a mesh: that of a condensed model is the best one, whatever its means. On triangles with A constant in each, u_h is of the same mean error as σ_h:
//! ∫ζ·∇_h u_h = ∫ζ·A⁻¹σ_h, since σ_h − A∇_h u_h has no mean. In all other cases of_u bounds it.
//!
//! In a step of time T bounds ∫(k e − R)²/k beside ‖A^{−½}(σ − τ)‖², with ∇·(σ − τ) = k e − R ([`super`]), so that
//! ```text
//!   |J(σ) − J(τ)| ≤ (‖A^½∇z‖² + ∫k z²)^½ · T
//! ```
//! What of R counts as oscillation is the divergence of a flux that vanishes on all sides, and moves no J(τ). A full model's τ is that
//! of the way in which cells keep what they lack, whichever way T is of. On C both are the same where D or R holds every part.

use super::answer::{Answered, OnMesh};
use super::contact::ContactEdge;
use super::dual::{self, Dual};
use super::goal::Goal;
use super::interval::{FAR, UNSOLVED, unbounded};
use super::kept::{keep, left};
use super::known::Answers;
use super::part::Part;
use super::products::Residual;
use super::squares::Products;
use super::unseen::unseen;
use signorini_certify::CertifiedFields;
use signorini_certify::conductivity::Conductivity;
use signorini_certify::deviation::Deviations;
use signorini_certify::term;
use signorini_problem::functional::wanted;
use signorini_problem::{EdgeKind, Parts, Problem, Sum};
use signorini_scene::error::Result;
use signorini_scene::scene::{Output, Quantity};
use signorini_solve::energy_norm::nonconformity;
use signorini_solve::{MOST_FACTORED, ScalarKind, SharedSolver};

/// Why an output needs no weights.
const GIVEN: &str = "the data give it, up to their quadrature";

/// Parts that are tried, and by how much each is larger than the last.
const PARTS: i32 = 10;
const STEP: f64 = 2.0;

/// Deviations of zero data from their chords: none.
static NOTHING: Deviations<'static> = Deviations { found: Vec::new(), dropped: 0.0 };

/// By how much the parts of a bound may move an output, in the unit of the output over that of the bound.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Weights {
    /// Of `total`.
    pub total: f64,
    /// Of its square.
    pub square: f64,
    /// Of `algebraic`.
    pub algebraic: f64,
    /// Of `of_u`.
    pub of_u: f64,
}

/// Weights of an output, or the reason why there are none.
pub type Weighed = std::result::Result<Weights, String>;

/// Weights of every output, in their order. Where data have no value at a point that is looked at here alone, that is the reason.
pub fn weights(problem: &Problem, answers: &Answers) -> Vec<Weighed> {
    let outputs = wanted(&problem.scene);
    let found = Weighing::new(problem, answers).and_then(|of| match of {
        Ok(of) => outputs.iter().map(|output| of.output(output)).collect(),
        Err(why) => Ok(vec![Err(why); outputs.len()]),
    });
    found.unwrap_or_else(|error| vec![Err(error.reason()); outputs.len()])
}

/// The ingredients of all weights of a problem.
pub(super) struct Weighing<'p> {
    pub problem: &'p Problem,
    pub solver: SharedSolver,
    /// The problem at all corners of the ranges of its transfer coefficients: norms of weights are convex in them.
    corners: Vec<Problem>,
    pub answers: &'p Answers<'p>,
    unseen: f64,
    /// s and τ that are 0.
    nothing: CertifiedFields,
}

impl<'p> Weighing<'p> {
    /// The ingredients of a problem's weights, or why it has none.
    pub fn new(
        problem: &'p Problem,
        answers: &'p Answers<'p>,
    ) -> Result<std::result::Result<Self, String>> {
        let none = |why: &str| Ok(Err(why.to_owned()));
        if problem.topology.counts.unknowns() > MOST_FACTORED {
            return none(&format!("the mesh has more than {MOST_FACTORED} unknowns"));
        }
        if Parts::whatever_inputs(problem)?.counts.contact > 0 {
            return none(
                "contact alone holds a part: what a tick leaves open passes through any of its edges",
            );
        }
        let Some(solver) = SharedSolver::of(problem)? else {
            return none("its linear problem has no factor");
        };
        let unseen = unseen(problem)?;
        let corners = term::corners(&problem.scene).map(|scene| problem.with_loads_of(scene));
        let (corners, edges) = (corners.collect::<Result<_>>()?, problem.ends.len());
        let nothing = CertifiedFields {
            vertices: vec![0.0; problem.mesh.vertices.len()],
            bubbles: vec![0.0; edges],
            tau: vec![0.0; edges],
            ..CertifiedFields::default()
        };
        Ok(Ok(Self { problem, solver, corners, answers, unseen, nothing }))
    }

    /// What is missed of loads in an output, over the total: as much of each as z is there, and of the end that a force is measured from.
    pub fn of_loads(&self, weights: &dual::Weights) -> f64 {
        let most = weights.vertices.iter().fold(1.0_f64, |most, z| most.max(z.abs()));
        if self.unseen == 0.0 { 0.0 } else { 2.0 * most * self.unseen }
    }

    /// The weights of an output.
    pub fn output(&self, output: &Output) -> Result<Weighed> {
        let none = |why: &str| Ok(Err(why.to_owned()));
        if let Quantity::Probe { .. } = output.quantity {
            return none("u at a point has none; a mean over a boundary has one");
        }
        if output.quantity.is_inside() {
            return none("an integral over cells has none; a mean over a boundary has one");
        }
        let goal = match Goal::of(&self.on_mesh(), output)? {
            Ok(goal) => goal,
            Err(why) => return Ok(Err(why)),
        };
        let part = Part::new(self.problem, output);
        let steps = self.problem.loads.step.is_some();
        match output.quantity {
            Quantity::Mean if steps => {
                none("a mean of u has none in a step of time; a force or a flux has one")
            }
            Quantity::Flux if part.is_given() => none(GIVEN),
            _ if steps && !self.answers.are_balanced && !part.is_all(EdgeKind::Contact) => {
                none("in a step of a full model the flux of contact boundaries alone has one")
            }
            _ if steps => self.flux((&goal, output), &part),
            Quantity::Mean if part.is_all(EdgeKind::Dirichlet) => none(GIVEN),
            Quantity::Flux if part.takes_all() => none(GIVEN),
            Quantity::Mean => self.mean((&goal, output), part.is_all(EdgeKind::Contact)),
            _ => self.flux((&goal, output), &part),
        }
    }

    /// The answer whose s and τ are 0.
    pub fn on_mesh(&self) -> OnMesh<'_> {
        let answer = Answered { certified: &self.nothing, bound: None, scalar: ScalarKind::F64 };
        OnMesh { problem: self.problem, answer, deviations: &NOTHING }
    }

    pub fn contact(&self) -> Vec<ContactEdge> {
        let open = |at: usize| self.answers.open.get(at).copied().flatten();
        let counts = self.problem.topology.counts;
        let pressed = |at: usize| self.answers.pressed.get(at).copied().unwrap_or(0.0);
        let edge = |at: usize| ContactEdge::unknown(self.problem, at, open(at), pressed(at));
        (0..counts.contact).map(edge).collect()
    }

    fn flux(&self, (goal, output): (&Goal, &Output), part: &Part) -> Result<Weighed> {
        let (problem, contact) = (self.problem, self.contact());
        let (mut dual, far) = (Dual::new(problem, goal)?, FAR * goal.size(problem));
        let mut sides = [None::<Weights>; 2];
        for part in self.parts(&contact) {
            // z is free where all of [0, 1] is within its part, and has its value on all other contact edges.
            let held: Vec<_> = contact.iter().map(|of| of.held(of.is_held(part))).collect();
            let Some(solved) = dual.solve(&self.solver, &held, goal, far) else {
                return Ok(Err(UNSOLVED.to_owned()));
            };
            for takes_least in [true, false] {
                let mut weights = solved.clone();
                // Nothing is asked of ζ.
                weights.tau.fill(0.0);
                let differ = keep(problem, goal, &contact, part, takes_least, &mut weights);
                let rest = left(problem, goal, &contact, &weights);
                let [_, of_z, _] = self.sizes(goal, &weights)?;
                let total = of_z + self.of_loads(&weights);
                for at in [0, 1] {
                    let found =
                        Weights { total, square: 0.5 * rest.part[at], ..Weights::default() };
                    if rest.loose[at] == 0.0 {
                        sides[at] = Some(self.less(sides[at], found));
                    }
                }
                if !differ {
                    break;
                }
            }
        }
        let none = || Ok(Err(unbounded(problem, output)));
        let [Some(below), Some(above)] = sides else { return none() };
        let total = below.total.max(above.total);
        let square = below.square.max(above.square);
        if !(total.is_finite() && square.is_finite()) {
            return none();
        }
        // On contact edges τ is within the law, and so is the output.
        let algebraic = match part.is_all(EdgeKind::Contact) {
            true => 0.0,
            false => self.of_edges(goal, part)?.max(total),
        };
        Ok(Ok(Weights { total, square, algebraic, of_u: 0.0 }))
    }

    /// Parts of s − ψ that z may be off by: none, and such that z is off by up to 1 at some of the edges that are open.
    pub fn parts(&self, contact: &[ContactEdge]) -> Vec<f64> {
        let clear = contact.iter().flat_map(|of| of.clear).filter(|clear| *clear > 0.0);
        let most = clear.filter(|clear| clear.is_finite()).fold(0.0, f64::max);
        let parts = (0..PARTS).map(|at| STEP.powi(at) / most);
        std::iter::once(0.0).chain(parts.filter(|part| part.is_finite())).collect()
    }

    /// The one that is less at such a total.
    fn less(&self, one: Option<Weights>, other: Weights) -> Weights {
        let at =
            |of: Weights| of.total * self.answers.total + of.square * self.answers.total.powi(2);
        one.filter(|one| at(*one) <= at(other)).unwrap_or(other)
    }

    fn mean(&self, (goal, output): (&Goal, &Output), on_contact: bool) -> Result<Weighed> {
        let (problem, contact) = (self.problem, self.contact());
        let solved = Dual::new(problem, goal)?.solve(&self.solver, &contact, goal, 0.0);
        let Some(solved) = solved else {
            return Ok(Err(UNSOLVED.to_owned()));
        };
        let ([.., size], loads) = (self.sizes(goal, &solved)?, self.of_loads(&solved));
        let transfers = !problem.loads.robin.is_empty();
        let (total, of_u) = (Weights { total: size + loads, ..Weights::default() }, size);
        Ok(if !(size + loads).is_finite() {
            Err(unbounded(self.problem, output))
        } else if problem.mesh.triangles.is_empty() && !on_contact && !self.answers.are_balanced {
            Ok(total)
        } else if self.has_plain_triangles() && (self.answers.are_balanced || !transfers) {
            Ok(Weights { algebraic: size, ..total })
        } else if !transfers || problem.mesh.triangles.is_empty() {
            Ok(Weights { total: loads, of_u, ..Weights::default() })
        } else {
            Err("a law of transfer that the answer does not meet exactly is part of it".to_owned())
        })
    }

    /// Whether all cells are triangles with one A in each, and h is constant along every edge.
    fn has_plain_triangles(&self) -> bool {
        let problem = self.problem;
        let is_plain =
            |edge: usize| Sum::transfer(problem, edge).is_none_or(|h| h.constant().is_some());
        problem.mesh.quads.is_empty()
            && (0..problem.cells()).all(|at| Conductivity::of(problem, at).is_constant())
            && problem.loads.robin.iter().all(|record| is_plain(record.edge as usize))
    }

    /// The largest ‖ζ − A∇z‖, ‖A∇z‖ and ‖ζ‖ over the ranges of transfer coefficients.
    pub fn sizes(&self, goal: &Goal, weights: &dual::Weights) -> Result<[f64; 3]> {
        let mut most = [0.0_f64; 3];
        for corner in &self.corners {
            let dual = Dual::new(corner, goal)?;
            let residual = Residual::new(&OnMesh { problem: dual.problem(), ..self.on_mesh() })?;
            let Products { weights: apart, sizes: [of_z, of_zeta], .. } =
                residual.with(goal, weights)?;
            for (most, size) in most.iter_mut().zip([apart, of_z, of_zeta]) {
                // A NaN is no size.
                *most = if size <= *most { *most } else { size };
            }
        }
        Ok(most.map(f64::sqrt))
    }

    /// max |Σ ∫(τ − σ_h)·n| over ‖A^−½(τ − σ_h)‖, cell by cell, summed over the edges of P beside contact: both have the same sources
    /// there, so that it is the energy of the nonconforming function which has the mean 1 on these and 0 on all other edges.
    fn of_edges(&self, goal: &Goal, part: &Part) -> Result<f64> {
        let dual = Dual::new(self.problem, goal)?;
        let problem = dual.problem();
        let mut means = vec![0.0; self.problem.ends.len()];
        let is_contact = |edge: &usize| self.problem.kinds[*edge] == EdgeKind::Contact;
        part.edges().filter(|edge| !is_contact(edge)).for_each(|edge| means[edge] = 1.0);
        // The masses of the sides make ∫kφ² on triangles, and no less than half of it on quads.
        let stored = (0..problem.cells()).flat_map(|cell| {
            let sides = problem.topology.edges_of(cell).iter().zip(problem.stored(cell, &means));
            sides.map(|(&edge, stored)| 2.0 * means[edge as usize] * stored).collect::<Vec<_>>()
        });
        let energy = nonconformity(problem, &self.nothing.admissible(), &means)?;
        Ok((energy * energy + stored.sum::<f64>()).sqrt())
    }
}

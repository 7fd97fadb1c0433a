//! Loads and boundary data of one time as the kernel's certificate takes them.

use signorini_bound::certificate::{Curved, LoadCase, TransferForms};
use signorini_bound::conforming::VertexData;
use signorini_kernel::Error as KernelError;

use super::curved::{Curved as Bent, CurvedEdges};
use super::deviation::Deviations;
use super::enclosed::Enclosed;
use super::ends::Ends;
use super::imbalance::carried;
use super::lifted::{Lifts, traces};
use super::no_bound::NoBound;
use super::oscillation::{Oscillation, of_source, with_source};
use super::robin::{RobinPoints, robin};
use super::transfer_forms::Forms;
use signorini_problem::scalar::Scalar;
use signorini_problem::{Assembled, Problem};
use signorini_scene::error::Result;
use signorini_scene::scene::Field;

/// Data of the certificate beyond [`Assembled`], in the scalar `R`.
#[derive(Debug, Clone)]
pub struct Data<R> {
    gap: Vec<[R; 2]>,
    given: Vec<[R; 2]>,
    curved: Vec<Curved<R, u32>>,
    transfer: Vec<[[R; 2]; 8]>,
    forms: Forms<R>,
    /// The data in f64.
    pub evaluated: Evaluated,
}

/// Data of the certificate in f64, as the expressions have them: they may be narrowed, or added up over inputs.
#[derive(Debug, Clone)]
pub struct Evaluated {
    /// ψ and u_D at the ends of edges.
    pub ends: Ends,
    /// Edges on which ψ or u_D is not affine.
    pub curved: Vec<Bent>,
    /// h and u_ext along the transfer edges.
    pub transfer: Vec<RobinPoints>,
    /// Transfer edges whose points do not see h.
    pub forms: Forms<f64>,
    /// √Σ osc², and what is left out of ψ and u_D.
    pub oscillation: f64,
    /// Extensions of curved data, where materials store u.
    pub lifts: Lifts,
    /// The part of the oscillation that was enclosed and not resolved.
    pub unresolved: f64,
    /// Why these data allow for no bound.
    pub no_bound: Option<NoBound>,
}

/// What is evaluated.
#[derive(Debug, Clone, Copy)]
enum Of {
    /// The data as they are.
    Whole,
    /// One term of a sum over the inputs.
    Term,
}

impl Of {
    /// What it costs that s leaves the data.
    fn moved(self, ends: &Ends, problem: &Problem) -> f64 {
        match self {
            Self::Whole => ends.moved(problem),
            Self::Term => ends.moved_on_dirichlet(problem),
        }
    }

    /// What it costs that loads are not what the data say: [`carried`].
    fn carried(self, problem: &Problem) -> Result<std::result::Result<f64, NoBound>> {
        let loads = &problem.loads;
        if matches!(self, Self::Whole) {
            return Ok(carried(problem, loads.moved));
        }
        // Where inputs change an end, a tick tells by how much those of the sum have moved.
        let moved = match problem.scene.limit_input() {
            None => loads.moved,
            Some(_) => problem.range_term(0)?.moved,
        };
        if loads.missed == 0.0 {
            return Ok(carried(problem, moved));
        }
        // Other terms may lower h, through which it has to leave.
        Ok(carried(&problem.at_least_transfer()?, moved))
    }
}

impl Evaluated {
    /// Evaluates the data of `problem` at its time.
    ///
    /// # Errors
    /// Data that are not finite.
    pub fn new(problem: &Problem) -> Result<Self> {
        Self::again(problem, &mut Enclosed::default())
    }

    /// Evaluates them with what is known from another time or other inputs.
    ///
    /// # Errors
    /// As for [`Evaluated::new`].
    pub fn again(problem: &Problem, enclosed: &mut Enclosed) -> Result<Self> {
        Self::with(problem, Of::Whole, enclosed)
    }

    /// Data of one term of a sum. A term may break what the sum has to meet: where u_D is on a side of ψ that does not exist, the caller that
    /// adds up the terms has to count it.
    ///
    /// # Errors
    /// Data that are not finite.
    pub fn of_term(problem: &Problem) -> Result<Self> {
        Self::with(problem, Of::Term, &mut Enclosed::default())
    }

    fn with(problem: &Problem, of: Of, enclosed: &mut Enclosed) -> Result<Self> {
        let ends = Ends::of(problem)?;
        let stores = !problem.capacities.is_empty();
        let of_ends = (problem, &[Field::Gap, Field::Value][..]);
        let (mut curved_edges, traces) = enclosed.ends.of(of_ends, || {
            let deviations = Deviations::of(problem)?;
            let curved = CurvedEdges::new(problem, &deviations)?;
            let traces = if stores { traces(problem, &deviations, &curved)? } else { Vec::new() };
            Ok((curved, traces))
        })?;
        let lifts = match stores {
            true => Lifts::new(problem, &curved_edges, traces),
            false => Lifts::default(),
        };
        if problem.loads.step.is_some() {
            // s follows all of them: from step to step it may not change its mind.
            curved_edges.records.iter_mut().for_each(|record| record.peak = f64::INFINITY);
        }
        // s is off by that much, and once more where u_h is compared with it.
        let left_out = 2.0 * (curved_edges.left_out + of.moved(&ends, problem));
        let curved = curved_edges.records;
        let Oscillation { of_cells, unresolved, pole } = with_source(
            problem,
            enclosed.source.of((problem, &[Field::Source]), || of_source(problem))?,
        )?;
        let norm =
            |all: &mut dyn Iterator<Item = f64>| all.map(|osc| osc * osc).sum::<f64>().sqrt();
        let whole = norm(&mut of_cells.iter().copied());
        let resolved =
            norm(&mut of_cells.iter().zip(&unresolved).map(|(all, missed)| all - missed));
        let transfer = robin(problem)?;
        let rough = pole.map(|(field, at, is_proved)| NoBound::not_square(field, at, is_proved));
        let forms = Forms::new(&[problem])?;
        let vanishes = || forms.vanishing.map(|edge| NoBound::transfer_vanishes(problem, edge));
        let no_bound =
            rough.or_else(|| NoBound::of_data(problem, &ends, &curved)).or_else(vanishes);
        let (carried, no_way) = match of.carried(problem)? {
            Ok(carried) => (carried, None),
            Err(reason) => (0.0, Some(reason)),
        };
        Ok(Self {
            ends,
            curved,
            transfer,
            forms,
            // There is no bound where it is infinite.
            oscillation: left_out + if whole.is_finite() { whole + carried } else { 0.0 },
            lifts,
            unresolved: whole - resolved + carried,
            no_bound: no_bound.or(no_way),
        })
    }
}

impl<R: Scalar> Data<R> {
    /// Evaluates the data of `problem` at its time.
    ///
    /// # Errors
    /// Data that are not finite.
    pub fn new(problem: &Problem) -> Result<Self> {
        Evaluated::new(problem).map(Self::narrowed)
    }

    /// Evaluates them with what is known from another time or other inputs.
    ///
    /// # Errors
    /// As for [`Data::new`].
    pub fn again(problem: &Problem, enclosed: &mut Enclosed) -> Result<Self> {
        Evaluated::again(problem, enclosed).map(Self::narrowed)
    }

    fn narrowed(data: Evaluated) -> Self {
        let pairs = |all: &[[f64; 2]]| all.iter().map(|pair| pair.map(R::narrow)).collect();
        let is_uniform = |edge: &RobinPoints| edge.iter().all(|point| *point == edge[0]);
        let transfer = match data.transfer.iter().all(is_uniform) {
            true => &[],
            false => &data.transfer[..],
        };
        Self {
            gap: pairs(&data.ends.gap),
            given: pairs(&data.ends.given),
            curved: data.curved.iter().map(Bent::narrowed).collect(),
            transfer: transfer.iter().map(|edge| edge.map(|point| point.map(R::narrow))).collect(),
            forms: data.forms.narrowed(),
            evaluated: data,
        }
    }

    /// Whether these data allow for a bound: u_D is continuous, ψ is along each edge, and no transfer coefficient nearly
    /// vanishes on a part of an edge.
    pub fn has_bound(&self) -> bool {
        self.evaluated.no_bound.is_none()
    }

    /// Oscillation: the part of f, g, q, ψ and u_D that their means leave out.
    pub fn oscillation(&self) -> R {
        R::narrow(self.evaluated.oscillation)
    }

    /// Why these data allow for none.
    pub fn no_bound(&self) -> Option<&NoBound> {
        self.evaluated.no_bound.as_ref()
    }

    /// The forms of transfer laws whose points do not see h, where there is one.
    pub fn forms(&self) -> Option<TransferForms<'_, R, u32>> {
        let Forms { laws, factors, .. } = &self.forms;
        let forms = TransferForms { laws, inputs: &[], values: &[], factors };
        (!laws.is_empty()).then_some(forms)
    }

    /// Together with the loads of `assembled`, and its own forms.
    ///
    /// # Errors
    /// Boundary records that are not admissible in this scalar.
    pub fn given<'a>(
        &'a self,
        assembled: &'a Assembled<R>,
        forms: &'a [TransferForms<'a, R, u32>],
    ) -> std::result::Result<LoadCase<'a, R, u32>, KernelError> {
        Ok(LoadCase {
            loads: assembled.cells(),
            boundary: assembled.boundary()?,
            ends: VertexData { gap: &self.gap, given: &self.given },
            curved: &self.curved,
            transfer: &self.transfer,
            forms,
            oscillation: self.oscillation() + R::narrow(self.evaluated.lifts.moved),
        })
    }
}

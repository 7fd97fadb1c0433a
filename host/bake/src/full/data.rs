//! Loads and boundary data as the target adds them up: base and patterns, narrowed.

use signorini_bound::certificate::Curved;
use signorini_kernel::Error as KernelError;
use signorini_kernel::error::Array;
use signorini_kernel::mesh::boundary::Neumann;
use signorini_kernel::stiffness::Stiffness;

use super::bent::{Bent, bent};
use super::cancellation;
use super::pattern::{Pattern, fluxes};
use crate::narrow::{narrow, pairs};
use crate::range::wider;
use crate::room::Room;
use signorini_certify::reach::Reach;
use signorini_certify::term::rooms_of;
use signorini_certify::transfer_forms::Forms;
use signorini_certify::{NoBound, TermData};
use signorini_problem::scalar::Scalar;
use signorini_problem::{Loads, Problem, excess_within_ranges};
use signorini_scene::error::Result;
use signorini_scene::scene::{Field, Input, Scene};

/// The arrays of [`signorini_device::full::Base`], the patterns, the oscillation.
#[derive(Debug, Clone, Default)]
pub(super) struct Data<R> {
    /// Of the base, with a record of each Neumann edge on which some part has a flux.
    pub loads: Loads<R>,
    pub rooms: Vec<Room<R>>,
    pub settling: R,
    pub gap_ends: Vec<[R; 2]>,
    pub dirichlet_ends: Vec<[R; 2]>,
    pub curved: Vec<Curved<R, u32>>,
    pub curved_sums: Vec<Bent<R>>,
    pub transfer: Vec<[[R; 2]; 8]>,
    pub forms: Forms<R>,
    /// The numbers of the inputs that change u_ext, where there are forms.
    pub of_ambient: Vec<u16>,
    pub patterns: Vec<Pattern<R>>,
    pub oscillation: Vec<R>,
    pub no_bound: Option<NoBound>,
}

impl<R: Scalar> Data<R> {
    /// From the parts of the data, base first.
    pub fn new(
        problem: &Problem,
        parts: &[TermData],
        stiffness: Stiffness<R>,
        (least, reach): (&Problem, &Reach),
    ) -> Result<Self> {
        let Some((base, of_inputs)) = parts.split_first() else { return Ok(Self::default()) };
        let neumann = with_flux(parts);
        let is_uniform = parts.iter().all(TermData::is_uniform);
        let patterns = problem
            .scene
            .inputs
            .iter()
            .zip(of_inputs)
            .map(|(input, part)| Pattern::new(input.field.value, part, &neumann, is_uniform));
        let (curved, curved_sums) = bent(problem, parts)?;
        let (forms, of_ambient) = forms(problem, parts)?;
        let changed = || NoBound::of_changed_transfer(problem, &forms.laws);
        let of_base = neumann.iter().zip(fluxes(&neumann, base));
        let loads = Loads {
            neumann: of_base.map(|(&edge, flux)| Neumann { edge, flux: R::narrow(flux) }).collect(),
            // Where inputs change a limit, these are not the ones that are stated.
            spans: narrow(&base.spans),
            span_excess: R::narrow(span_excess(problem)),
            step: None,
            ..base.loads().narrowed()
        };
        let rooms = rooms_of(problem, parts);
        let along = base.transfer.iter().filter(|_| !is_uniform);
        let lost = cancellation::lost(least, reach, parts, &neumann, R::EPSILON.wide());
        let settling = if rooms.is_empty() { 0.0 } else { reach.of_contact().sum() };
        let mut data = Self {
            loads,
            rooms: rooms.iter().map(Room::new).collect(),
            settling: R::narrow(settling),
            gap_ends: pairs(&base.ends.gap),
            dirichlet_ends: pairs(&base.ends.given),
            curved,
            curved_sums,
            transfer: along.map(|edge| edge.map(|point| point.map(R::narrow))).collect(),
            forms: forms.narrowed(),
            of_ambient,
            patterns: patterns.collect(),
            oscillation: oscillation(problem, parts, stiffness, lost),
            no_bound: parts.iter().find_map(|part| part.no_bound.clone()).or_else(changed),
        };
        data.leave_out_zeros(problem);
        Ok(data)
    }

    /// Without everything that only the certificate reads.
    pub fn without_bound(mut self) -> Self {
        self.patterns.iter_mut().for_each(|pattern| pattern.points.clear());
        Self {
            curved: Vec::new(),
            curved_sums: Vec::new(),
            transfer: Vec::new(),
            forms: Forms::default(),
            of_ambient: Vec::new(),
            oscillation: Vec::new(),
            ..self
        }
    }

    /// A load that is 0 and stays it has no array; one that an input changes has all its entries.
    fn leave_out_zeros(&mut self, problem: &Problem) {
        let fit = |array: &mut Vec<R>, varies: bool, length: usize| {
            if varies {
                array.resize(length, R::ZERO);
            } else if array.iter().all(|&entry| entry == R::ZERO) {
                array.clear();
            }
        };
        let source = self.varies(Field::Source);
        let flux = !self.rooms.is_empty() || self.patterns.iter().any(Pattern::moves_contact_flux);
        fit(&mut self.loads.triangles, source, problem.mesh.triangles.len());
        fit(&mut self.loads.quads, source, problem.mesh.quads.len());
        fit(&mut self.loads.contact_flux, flux, problem.topology.counts.contact);
    }

    /// Whether a gap or a value is not linear along an edge, with inputs or without.
    pub fn is_curved(&self) -> bool {
        !(self.curved.is_empty() && self.curved_sums.is_empty())
    }

    /// Whether an input changes this field.
    pub fn varies(&self, field: Field) -> bool {
        self.patterns.iter().any(|pattern| pattern.field == field)
    }

    /// Checks of the kernel that it makes only where its arrays are used.
    pub fn check(&self) -> std::result::Result<(), KernelError> {
        let weights = self.patterns.iter().flat_map(Pattern::weights);
        let bound = self.oscillation.iter().chain(&self.forms.factors);
        let numbers = bound.copied().chain(weights);
        match numbers.into_iter().position(|x| !x.finite()) {
            Some(at) => Err(KernelError::NotFinite { of: Array::Inputs, at }),
            None => Ok(()),
        }
    }
}

/// A pattern that is nothing but underflow would leave its input without effect.
pub(super) fn refuse_faint<R: Scalar>(scene: &Scene, data: &Data<R>) -> Result<()> {
    for (input, pattern) in scene.inputs.iter().zip(&data.patterns) {
        let weights = pattern.weights();
        let most = weights.iter().fold(R::ZERO, |most, weight| most.or_larger(weight.magnitude()));
        if !weights.is_empty() && most < R::TINY {
            let message = format!("beside the other data too small for {}", R::NAME);
            let hint =
                format!("multiply it by a power of ten and divide the input by it{}", wider::<R>());
            return Err(scene.error(&input.pattern, message).hint(hint).into());
        }
    }
    Ok(())
}

/// The forms of transfer laws whose points do not see h, with the numbers of the inputs that change u_ext.
fn forms(problem: &Problem, parts: &[TermData]) -> Result<(Forms<f64>, Vec<u16>)> {
    let inputs = problem.scene.inputs.iter().zip(0_u16..);
    let is_ambient = |(input, _): &(&Input, u16)| input.field.value == Field::Ambient;
    let of_ambient: Vec<u16> = inputs.filter(is_ambient).map(|(_, at)| at).collect();
    let acting = of_ambient.iter().map(|&at| &parts[usize::from(at) + 1]);
    let terms: Vec<_> = parts.iter().take(1).chain(acting).map(|part| &part.problem).collect();
    let forms = Forms::new(&terms)?;
    Ok(if forms.laws.is_empty() { Default::default() } else { (forms, of_ambient) })
}

/// The largest excess of a contact edge, see [`excess_within_ranges`]; what is infinite leaves no bound.
fn span_excess(problem: &Problem) -> f64 {
    let counts = problem.topology.counts;
    let edges = (counts.free..counts.unknowns()).filter_map(|at| excess_within_ranges(problem, at));
    edges.filter(|excess| excess.is_finite()).fold(0.0, f64::max)
}

/// The Neumann edges on which some part of the data has a flux, ascending.
fn with_flux(parts: &[TermData]) -> Vec<u32> {
    let mut edges: Vec<u32> = parts
        .iter()
        .flat_map(|part| part.loads().neumann.iter().map(|record| record.edge))
        .collect();
    edges.sort_unstable();
    edges.dedup();
    edges
}

/// Of each part, what f, g and q leave out, what rounding does to its loads and, where inputs change ψ or u_D, to its
/// boundary values: the kernel's own allowance knows only their sum, which may be a small difference.
fn oscillation<R: Scalar>(
    problem: &Problem,
    parts: &[TermData],
    k: Stiffness<R>,
    lost: Vec<f64>,
) -> Vec<R> {
    let moves = |part: &TermData| part.ends.size() > 0.0;
    let varies = parts.iter().skip(1).any(moves);
    // As the kernel counts one value, and more where many terms are added up.
    let terms = parts.iter().filter(|part| moves(part)).count();
    let share = R::EPSILON.wide() * (0.5 * (terms + 2) as f64).max(2.0);
    let perturbation = |part| if varies { perturbation(problem, part, k, share) } else { 0.0 };
    let all = parts.iter().zip(lost);
    all.map(|(part, lost)| R::narrow(part.oscillation + perturbation(part) + lost)).collect()
}

/// Each value moves by this `share` of it, at 4Σ|K| of its cell for each square.
fn perturbation<R: Scalar>(problem: &Problem, part: &TermData, k: Stiffness<R>, share: f64) -> f64 {
    let free = problem.topology.counts.free;
    let size = |entries: &[R]| entries.iter().map(|k| k.wide().abs()).sum::<f64>();
    let ends = part.ends.gap.iter().chain(&part.ends.given).zip(free..);
    let squares = ends.map(|(ends, edge)| {
        let moved = share * ends[0].abs().max(ends[1].abs());
        let (cell, _) = problem.topology.first_side(edge);
        let stiff = match cell.checked_sub(k.triangles.len()) {
            None => size(&k.triangles[cell]),
            Some(quad) => size(&k.quads[quad]),
        };
        4.0 * stiff * moved * moved
    });
    squares.sum::<f64>().sqrt()
}

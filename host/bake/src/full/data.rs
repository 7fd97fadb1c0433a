//! Loads and boundary data as the target adds them up: base and patterns, narrowed.

use signorini_bound::certificate::Curved;
use signorini_device::full::{Contribution, EdgeTrace, Points};
use signorini_kernel::Error as KernelError;
use signorini_kernel::error::Array;
use signorini_kernel::mesh::boundary::{Neumann, Robin};
use signorini_kernel::stiffness::Stiffness;

use super::bent::{Bent, bent};
use super::shares::{chords, shares};
use super::transfer::Transfer;
use signorini_certify::TermData;
use signorini_problem::Problem;
use signorini_problem::scalar::Scalar;
use signorini_scene::error::Result;
use signorini_scene::scene::Field;

/// The arrays of [`signorini_device::full::Base`], the patterns, the oscillation.
#[derive(Debug, Clone, Default)]
pub(super) struct Data<R> {
    pub triangles: Vec<R>,
    pub quads: Vec<R>,
    pub neumann: Vec<Neumann<R, u32>>,
    pub robin: Vec<Robin<R, u32>>,
    pub contact_flux: Vec<R>,
    pub spans: Vec<R>,
    pub span_excess: R,
    pub gap: Vec<R>,
    pub gap_ends: Vec<[R; 2]>,
    pub dirichlet: Vec<R>,
    pub dirichlet_ends: Vec<[R; 2]>,
    pub curved: Vec<Curved<R, u32>>,
    pub curved_sums: Vec<Bent<R>>,
    pub transfer: Vec<[[R; 2]; 8]>,
    pub patterns: Vec<Pattern<R>>,
    pub oscillation: Vec<R>,
    pub has_bound: bool,
}

/// An input's pattern, owned.
#[derive(Debug, Clone)]
pub(super) enum Pattern<R> {
    Source { triangles: Vec<Contribution<R, u32>>, quads: Vec<Contribution<R, u32>> },
    Neumann(Vec<Contribution<R, u32>>),
    ContactFlux(Vec<Contribution<R, u32>>),
    ContactRange { fluxes: Vec<Contribution<R, u32>>, spans: Vec<Contribution<R, u32>> },
    Gap(Vec<EdgeTrace<R, u32>>),
    Value(Vec<EdgeTrace<R, u32>>),
    Ambient { integrals: Vec<Contribution<R, u32>>, points: Vec<Points<R, u32>> },
    Coefficient(Transfer<R>),
}

impl<R: Scalar> Data<R> {
    /// From the parts of the data, base first.
    pub fn new(problem: &Problem, parts: &[TermData], stiffness: Stiffness<R>) -> Result<Self> {
        let Some((base, of_inputs)) = parts.split_first() else { return Ok(Self::default()) };
        let neumann = with_flux(parts);
        let is_uniform = parts.iter().all(TermData::is_uniform);
        let patterns = problem.scene.inputs.iter().zip(of_inputs).map(|(input, part)| {
            let contact = !part.loads().contact_flux.iter().all(|&flux| flux == 0.0);
            match input.field.value {
                Field::Source => Pattern::Source {
                    triangles: shares(&part.loads().triangles),
                    quads: shares(&part.loads().quads),
                },
                Field::Flux if contact => range(part),
                Field::Flux => Pattern::Neumann(shares(&fluxes(&neumann, part))),
                Field::Gap => Pattern::Gap(chords(&part.loads().gap, &part.ends.gap)),
                Field::Value => Pattern::Value(chords(&part.loads().dirichlet, &part.ends.given)),
                Field::Limit => range(part),
                Field::Ambient => ambient(part, is_uniform),
                Field::Coefficient => {
                    let of = part.coefficient.as_ref();
                    Pattern::Coefficient(
                        of.map(|of| Transfer::new(of, is_uniform)).unwrap_or_default(),
                    )
                }
            }
        });
        let (curved, curved_sums) = bent(problem, parts)?;
        let mut data = Self {
            triangles: narrow(&base.loads().triangles),
            quads: narrow(&base.loads().quads),
            neumann: Vec::new(),
            robin: base.loads().robin.iter().map(robin).collect(),
            contact_flux: narrow(&base.loads().contact_flux),
            spans: narrow(&base.spans),
            span_excess: R::narrow(base.loads().span_excess),
            gap: narrow(&base.loads().gap),
            gap_ends: pairs(&base.ends.gap),
            dirichlet: narrow(&base.loads().dirichlet),
            dirichlet_ends: pairs(&base.ends.given),
            curved,
            curved_sums,
            transfer: Vec::new(),
            patterns: patterns.collect(),
            oscillation: oscillation(problem, parts, stiffness),
            has_bound: parts.iter().all(TermData::has_bound),
        };
        let of_base = neumann.iter().zip(fluxes(&neumann, base));
        data.neumann =
            of_base.map(|(&edge, flux)| Neumann { edge, flux: R::narrow(flux) }).collect();
        if !is_uniform {
            let edges = base.transfer.iter();
            data.transfer = edges.map(|edge| edge.map(|point| point.map(R::narrow))).collect();
        }
        data.leave_out_zeros(problem);
        Ok(data)
    }

    /// Without everything that only the certificate reads.
    pub fn without_bound(mut self) -> Self {
        for pattern in &mut self.patterns {
            match pattern {
                Pattern::Ambient { points, .. } => points.clear(),
                Pattern::Coefficient(of) => of.points.clear(),
                _ => {}
            }
        }
        Self {
            curved: Vec::new(),
            curved_sums: Vec::new(),
            transfer: Vec::new(),
            oscillation: Vec::new(),
            has_bound: false,
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
        let source = self.varies(|pattern| matches!(pattern, Pattern::Source { .. }));
        let flux = self.varies(|pattern| match pattern {
            Pattern::ContactRange { fluxes, .. } => !fluxes.is_empty(),
            pattern => matches!(pattern, Pattern::ContactFlux(_)),
        });
        fit(&mut self.triangles, source, problem.mesh.triangles.len());
        fit(&mut self.quads, source, problem.mesh.quads.len());
        fit(&mut self.contact_flux, flux, problem.topology.counts.contact);
    }

    /// Whether there is such a pattern.
    pub fn varies(&self, is_such: impl Fn(&Pattern<R>) -> bool) -> bool {
        self.patterns.iter().any(is_such)
    }

    /// Checks of the kernel that it makes only where its arrays are used.
    pub fn check(&self) -> std::result::Result<(), KernelError> {
        let weights = self.patterns.iter().flat_map(Pattern::weights);
        let numbers = self.oscillation.iter().copied().chain(weights);
        match numbers.into_iter().position(|x| !x.finite()) {
            Some(at) => Err(KernelError::NotFinite { of: Array::Inputs, at }),
            None => Ok(()),
        }
    }
}

impl<R: Scalar> Pattern<R> {
    /// Every number of it.
    pub fn weights(&self) -> Vec<R> {
        let of =
            |shares: &[Contribution<R, u32>]| shares.iter().map(|share| share.weight).collect();
        match self {
            Self::Source { triangles, quads } => [of(triangles), of(quads)].concat(),
            Self::ContactRange { fluxes, spans } => [of(fluxes), of(spans)].concat(),
            Self::Neumann(shares) | Self::ContactFlux(shares) => of(shares),
            Self::Gap(chords) | Self::Value(chords) => {
                let all =
                    chords.iter().flat_map(|chord| [chord.mean, chord.ends[0], chord.ends[1]]);
                all.collect()
            }
            Self::Ambient { integrals, points } => {
                let points = points.iter().flat_map(|point| point.values);
                of(integrals).into_iter().chain(points).collect()
            }
            Self::Coefficient(of) => of.weights(),
        }
    }
}

fn narrow<R: Scalar>(numbers: &[f64]) -> Vec<R> {
    numbers.iter().map(|&x| R::narrow(x)).collect()
}

fn pairs<R: Scalar>(all: &[[f64; 2]]) -> Vec<[R; 2]> {
    all.iter().map(|pair| pair.map(R::narrow)).collect()
}

fn robin<R: Scalar>(law: &Robin<f64, u32>) -> Robin<R, u32> {
    let (coefficient, ambient) = (R::narrow(law.coefficient), R::narrow(law.ambient));
    Robin { edge: law.edge, coefficient, ambient }
}

fn ambient<R: Scalar>(part: &TermData, is_uniform: bool) -> Pattern<R> {
    let integrals: Vec<f64> = part.loads().robin.iter().map(|law| law.ambient).collect();
    let edges = part.transfer.iter().zip(0..).filter(|_| !is_uniform);
    let points = edges.map(|(edge, at)| Points { at, values: edge.map(|[_, u]| R::narrow(u)) });
    let acts = |points: &Points<R, u32>| points.values.iter().any(|&u| u != R::ZERO);
    Pattern::Ambient { integrals: shares(&integrals), points: points.filter(acts).collect() }
}

/// What an input adds to the fluxes of contact edges: to their bases alone, or to spans as well.
fn range<R: Scalar>(part: &TermData) -> Pattern<R> {
    let fluxes = shares(&part.loads().contact_flux);
    match part.spans.iter().any(|&span| span != 0.0) {
        true => Pattern::ContactRange { fluxes, spans: shares(&part.spans) },
        false => Pattern::ContactFlux(fluxes),
    }
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

/// The flux of a part on each of these edges.
fn fluxes(edges: &[u32], part: &TermData) -> Vec<f64> {
    let mut fluxes = vec![0.0; edges.len()];
    for record in &part.loads().neumann {
        if let Ok(at) = edges.binary_search(&record.edge) {
            fluxes[at] += record.flux;
        }
    }
    fluxes
}

/// Of each part, what f, g and q leave out and, where inputs change ψ or u_D, what rounding does to its
/// boundary values: the kernel's own allowance knows only their sum, which may be a small difference.
fn oscillation<R: Scalar>(problem: &Problem, parts: &[TermData], k: Stiffness<R>) -> Vec<R> {
    let moves = |part: &TermData| part.ends.scale() > 0.0;
    let varies = parts.iter().skip(1).any(moves);
    let perturbation = |part| if varies { perturbation(problem, part, k) } else { 0.0 };
    parts.iter().map(|part| R::narrow(part.oscillation + perturbation(part))).collect()
}

/// As the kernel counts it: each value moves by 2ε, at 4Σ|K| of its cell for each square.
fn perturbation<R: Scalar>(problem: &Problem, part: &TermData, k: Stiffness<R>) -> f64 {
    let free = problem.topology.counts.free;
    let size = |entries: &[R]| entries.iter().map(|k| k.wide().abs()).sum::<f64>();
    let ends = part.ends.gap.iter().chain(&part.ends.given).zip(free..);
    let squares = ends.map(|(ends, edge)| {
        let moved = 2.0 * R::EPSILON.wide() * ends[0].abs().max(ends[1].abs());
        let (cell, _) = problem.topology.first_side(edge);
        let stiff = match cell.checked_sub(k.triangles.len()) {
            None => size(&k.triangles[cell]),
            Some(quad) => size(&k.quads[quad]),
        };
        4.0 * stiff * moved * moved
    });
    squares.sum::<f64>().sqrt()
}

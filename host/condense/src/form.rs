//! The certificate as a quadratic form in (p, x, d).

use std::collections::BTreeSet;

use faer::Mat;

use super::best::{Table, complete};
use super::block::{Block, Functions};
use super::chain::Chain;
use super::elimination::{Field, failed};
use super::ends::excess;
use super::factor::{Source, energies, packed, stability, triangular};
use super::laws::Laws;
use super::residual::Residual;
use super::{Columns, Form, Pieces};
use signorini_certify::ends::of_moved;
use signorini_problem::Assembled;
use signorini_scene::error::Result;
use signorini_solve::unfit;

/// Data that the certificate is made from.
pub(super) struct FormData<'g> {
    pub columns: Columns<'g>,
    /// Ŝ
    pub matrix: &'g Mat<f64>,
    /// The field of a source that adds up to 1 on the one part that contact alone holds.
    pub source: Option<&'g Field>,
    /// Fields of unit openings of the edges that always touch.
    pub touching: &'g [Field],
    /// Contact vertices at which s is free.
    pub released: &'g BTreeSet<u32>,
}

/// s and τ in every column.
#[derive(Debug)]
pub(super) struct Admissibles {
    pub s: Table,
    pub fluxes: Table,
    pub functions: Functions,
    /// The vertex of each correction d.
    pub contact: Vec<u32>,
    /// Contact vertices at which s is free, and ψ there for each pattern.
    pub released: Vec<(u32, Vec<f64>)>,
    /// Fluxes by which a residual of 1 on each unknown is mended, where edges are settled; else they follow from those of x.
    pub mending: Option<Table>,
}

/// Either the form with the functions behind it, or a sentence why there is none.
pub(super) type Found = std::result::Result<(Form, Admissibles), String>;

impl FormData<'_> {
    /// The form with U = 1.
    ///
    /// # Errors
    /// Data that are not finite, a normal matrix that is singular to working precision.
    pub fn form(&self) -> Result<Found> {
        let Columns { pieces, openings, .. } = self.columns;
        if let Some(reason) = self.obstacle() {
            return Ok(Err(reason));
        }
        let chain = match Chain::new(pieces, openings, self.released) {
            Ok(chain) => chain,
            Err(reason) => return Ok(Err(reason)),
        };
        match &pieces.step {
            Some(step) => self.of_step(step, chain),
            None => self.of_solution(chain),
        }
    }

    /// The form of a steady problem with U = 1.
    fn of_solution(&self, chain: Chain) -> Result<Found> {
        let Columns { pieces, fields, .. } = self.columns;
        let Pieces { problem, patterns, laws, .. } = pieces;
        let functions = Functions::of(problem);
        let residual = Residual::new(pieces, &functions, self.released)?;
        let blocks = residual.blocks()?;
        let fluxes = self.fluxes(fields);
        let mut s = self.boundary_values(&chain, &functions, [patterns.len(), 0]);
        let fixed = chain.fixed(&functions, &blocks);
        let judged = match laws {
            Some(laws) => [&blocks[..], &self.weighed(laws, &functions)?].concat(),
            None => Vec::new(),
        };
        let judged = if judged.is_empty() { &blocks } else { &judged };
        complete(judged, &fixed, &fluxes, &mut s).map_err(failed(&problem.scene))?;
        let jump = residual.jumps()?;
        self.assembled(chain, &blocks, (s, functions), jump)
    }

    /// The form of these rows and columns of s, and of those of a `jump` to the means of u.
    pub(super) fn assembled(
        &self,
        chain: Chain,
        blocks: &[Block],
        (s, functions): (Table, Functions),
        jump: Option<Vec<Block>>,
    ) -> Result<Found> {
        let Columns { pieces, fields, openings } = self.columns;
        let Pieces { problem, patterns, edges, .. } = pieces;
        let Some((stability, mending)) = self.stability(blocks) else {
            return Ok(Err("the condensed matrix is singular to working precision".to_owned()));
        };
        let fluxes = self.fluxes(fields);
        let assembled = Assembled::<f64>::new(problem).map_err(unfit::<f64>(&problem.scene))?;
        let widened = |factor: Vec<f64>| {
            let share = 1.0 + assembled.hidden();
            factor.into_iter().map(|entry| share * entry).collect::<Vec<_>>()
        };
        let of_jump = |blocks: Vec<Block>| {
            let means = Table::of_columns(problem.ends.len(), fields.iter().map(|field| &field.u));
            widened(packed(&triangular(&blocks, &s, &means)))
        };
        // As in `certify::Data`: for s, and for u_h beside it.
        let moved = chain.moved.iter().map(|moved| 2.0 * of_moved(problem, moved));
        let oscillation =
            patterns.iter().zip(moved).map(|(p, moved)| p.oscillation + moved).collect();
        let is_limited = !problem.loads.spans.is_empty();
        let form = Form {
            factor: widened(packed(&triangular(blocks, &s, &fluxes))),
            lost: self.lost(blocks, &s, &fluxes, &assembled, stability)?,
            jump: jump.map(of_jump),
            vertices: chain.contact.iter().map(|(_, vertex)| *vertex).collect(),
            stability,
            corners: chain.corners,
            oscillation,
            floating: self.floating().to_vec(),
            ends: if is_limited { chain.ends } else { Vec::new() },
            span_excess: excess(problem, edges, openings),
        };
        let (contact, released) =
            (chain.contact.into_iter().map(|of| of.0).collect(), chain.released);
        Ok(Ok((form, Admissibles { s, fluxes, functions, contact, released, mending })))
    }

    /// Fluxes of columns; and means of u behind them, where laws are read off these.
    pub(super) fn fluxes(&self, fields: &[Field]) -> Table {
        let Pieces { problem, laws, .. } = self.columns.pieces;
        let edges = problem.ends.len();
        let mut fluxes = Table::of_columns(edges, fields.iter().map(|field| &field.flux));
        if laws.is_some() {
            let means = Table::of_columns(edges, fields.iter().map(|field| &field.u));
            fluxes.values.extend(means.values);
        }
        fluxes
    }

    /// The rows of changing laws, for the change that s is made for.
    fn weighed(&self, laws: &Laws, functions: &Functions) -> Result<Vec<Block>> {
        let mut blocks = laws.blocks(self.columns.pieces, functions)?;
        let rows = blocks.iter_mut().flat_map(|block| &mut block.rows);
        rows.flatten().for_each(|entry| *entry *= laws.change.sqrt());
        Ok(blocks)
    }

    /// Why these data allow for no bound.
    fn obstacle(&self) -> Option<String> {
        let pieces @ Pieces { parts, patterns, step, .. } = self.columns.pieces;
        if parts.counts.contact > 1 {
            let reason = "contact alone holds more than one part of the mesh: what is mended in each would have to leave through an edge of its own";
            return Some(reason.to_owned());
        }
        let reason = patterns.iter().find_map(|pattern| pattern.no_bound.as_ref());
        let of_step = || step.as_ref().and_then(|_| pieces.obstacle_of_steps());
        reason.map(ToString::to_string).or_else(|| of_step().map(str::to_owned))
    }

    /// s where it is fixed, in all columns: so many first patterns, x and d, and `more` in which it is 0 there.
    pub(super) fn boundary_values(
        &self,
        chain: &Chain,
        functions: &Functions,
        [inputs, more]: [usize; 2],
    ) -> Table {
        let contact = self.columns.openings.len();
        let columns = inputs + contact + chain.contact.len() + more;
        let mut s = Table::new(functions.count(), columns);
        for (&vertex, values) in &chain.given {
            s.row_mut(vertex as usize)[..inputs].copy_from_slice(&values[..inputs]);
        }
        for (at, ((vertex, place), gap)) in chain.contact.iter().zip(&chain.gap).enumerate() {
            let row = s.row_mut(*vertex as usize);
            row[..inputs].copy_from_slice(&gap[..inputs]);
            for (edge, weight) in place.edges.into_iter().zip(place.weights) {
                row[inputs + edge] += weight;
            }
            row[inputs + contact + at] = 1.0;
        }
        s
    }

    /// The unknowns of the one part that contact alone holds.
    pub(super) fn floating(&self) -> &[usize] {
        let held = self.source.and(self.columns.pieces.held_by_contact.first());
        held.map_or(&[], Vec::as_slice)
    }

    /// The cost of mending; where edges are settled with the fluxes that do it.
    fn stability(&self, blocks: &[Block]) -> Option<(f64, Option<Table>)> {
        if self.columns.pieces.settled.count() > 0 {
            let fluxes = self.mending()?;
            let identity = Mat::identity(fluxes.columns, fluxes.columns);
            let found = stability(&identity, &energies(blocks, &fluxes), None)?;
            return Some((found, Some(fluxes)));
        }
        let Columns { pieces, fields, openings } = self.columns;
        let mut columns = fields[pieces.patterns.len()..].to_vec();
        let source = self.source.map(|field| {
            columns.push(field.clone());
            let mut inverse = vec![0.0; openings.len()];
            self.floating().iter().for_each(|&at| inverse[at] = 1.0 / openings[at]);
            Source { inverse, load: pieces.load(field, &vec![0.0; openings.len()], openings) }
        });
        let fluxes = self.fluxes(&columns);
        Some((stability(self.matrix, &energies(blocks, &fluxes), source.as_ref())?, None))
    }
}

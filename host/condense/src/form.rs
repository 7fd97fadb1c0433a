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
use super::residual::{blocks, jumps};
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

/// A form, and the contact vertices of its corrections.
pub(super) type Assembly = (Form, Vec<u32>);

/// Either the form with the functions behind it, or a sentence why there is none.
pub(super) type Found = std::result::Result<(Form, Admissibles), String>;

impl FormData<'_> {
    /// The form with U = 1.
    ///
    /// # Errors
    /// Data that are not finite, a normal matrix that is singular to working precision.
    pub fn form(&self) -> Result<Found> {
        let Columns { pieces, fields, openings } = self.columns;
        let Pieces { problem, patterns, laws, .. } = pieces;
        let (laws, released) = (laws.as_ref(), self.released);
        if let Some(reason) = self.obstacle()? {
            return Ok(Err(reason));
        }
        if let Some(step) = &pieces.step {
            return self.of_step(step);
        }
        let chain = match Chain::new(pieces, openings, released) {
            Ok(chain) => chain,
            Err(reason) => return Ok(Err(reason)),
        };
        let functions = Functions::of(problem);
        let blocks = blocks(problem, patterns, &functions, laws, released)?;
        let fluxes = self.fluxes(fields);
        let mut s = self.boundary_values(&chain, &functions, [patterns.len(), 0]);
        let at_boundary = chain.fixed();
        let mut fixed = vec![false; functions.count()];
        at_boundary.iter().for_each(|&vertex| fixed[vertex as usize] = true);
        fix_unused(&blocks, &mut fixed);
        let judged = match laws {
            Some(laws) => [&blocks[..], &self.weighed(laws, &functions)?].concat(),
            None => Vec::new(),
        };
        let judged = if judged.is_empty() { &blocks } else { &judged };
        complete(judged, &fixed, &fluxes, &mut s).map_err(failed(&problem.scene))?;
        let jump = jumps(problem, patterns, &functions, released)?.map(|blocks| {
            let means: Vec<&[f64]> = fields.iter().map(|field| &field.u[..]).collect();
            (blocks, table(problem.ends.len(), &means))
        });
        let released = chain.released.clone();
        let found = self.assembled(chain, &blocks, &s, jump)?;
        Ok(found.map(|(form, contact)| {
            let mending = None;
            (form, Admissibles { s, fluxes, functions, contact, released, mending })
        }))
    }

    /// The form of these rows and columns of s, and the vertices of its corrections.
    pub(super) fn assembled(
        &self,
        chain: Chain,
        blocks: &[Block],
        s: &Table,
        jump: Option<(Vec<Block>, Table)>,
    ) -> Result<std::result::Result<Assembly, String>> {
        let Columns { pieces, fields, openings } = self.columns;
        let Pieces { problem, patterns, edges, .. } = pieces;
        let Some(stability) = self.stability(blocks) else {
            return Ok(Err("the condensed matrix is singular to working precision".to_owned()));
        };
        let fluxes = self.fluxes(fields);
        let assembled = Assembled::<f64>::new(problem).map_err(unfit::<f64>(&problem.scene))?;
        let widened = |factor: Vec<f64>| {
            let share = 1.0 + assembled.hidden();
            factor.into_iter().map(|entry| share * entry).collect::<Vec<_>>()
        };
        // As in `certify::Data`: for s, and for u_h beside it.
        let moved = chain.moved.iter().map(|moved| 2.0 * of_moved(problem, moved));
        let oscillation =
            patterns.iter().zip(moved).map(|(p, moved)| p.oscillation + moved).collect();
        let is_limited = !problem.loads.spans.is_empty();
        let form = Form {
            factor: widened(packed(&triangular(blocks, s, &fluxes))),
            lost: self.lost(blocks, s, &fluxes, &assembled, stability)?,
            jump: jump.map(|(blocks, means)| widened(packed(&triangular(&blocks, s, &means)))),
            vertices: chain.contact.iter().map(|(_, vertex)| *vertex).collect(),
            stability,
            corners: chain.corners,
            oscillation,
            floating: self.floating().to_vec(),
            ends: if is_limited { chain.ends } else { Vec::new() },
            span_excess: excess(problem, edges, openings),
        };
        Ok(Ok((form, chain.contact.iter().map(|of| of.0).collect())))
    }

    /// Fluxes of columns; and means of u behind them, where laws are read off these.
    pub(super) fn fluxes(&self, fields: &[Field]) -> Table {
        let Pieces { problem, laws, .. } = self.columns.pieces;
        let edges = problem.ends.len();
        let all = |of: fn(&Field) -> &[f64]| fields.iter().map(of).collect::<Vec<_>>();
        let mut fluxes = table(edges, &all(|field| &field.flux));
        if laws.is_some() {
            fluxes.values.extend(table(edges, &all(|field| &field.u)).values);
        }
        fluxes
    }

    /// The rows of changing laws, for the change that s is made for.
    fn weighed(&self, laws: &Laws, functions: &Functions) -> Result<Vec<Block>> {
        let Pieces { problem, patterns, .. } = self.columns.pieces;
        let mut blocks = laws.blocks(problem, patterns, functions)?;
        let rows = blocks.iter_mut().flat_map(|block| &mut block.rows);
        rows.flatten().for_each(|entry| *entry *= laws.change.sqrt());
        Ok(blocks)
    }

    /// Why these data allow for no bound.
    fn obstacle(&self) -> Result<Option<String>> {
        let Pieces { parts, patterns, .. } = self.columns.pieces;
        if parts.counts.contact > 1 {
            let reason = "contact alone holds more than one part of the mesh: what is mended in each would have to leave through an edge of its own";
            return Ok(Some(reason.to_owned()));
        }
        let reason = patterns.iter().find_map(|pattern| pattern.no_bound.as_ref());
        Ok(reason.map(ToString::to_string))
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

    fn stability(&self, blocks: &[Block]) -> Option<f64> {
        if self.columns.pieces.settled.count() > 0 {
            let fluxes = self.mending()?;
            let identity = Mat::identity(fluxes.columns, fluxes.columns);
            return stability(&identity, &energies(blocks, &fluxes), None);
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
        stability(self.matrix, &energies(blocks, &fluxes), source.as_ref())
    }
}

/// Table of these columns, which have a number for each edge.
pub(super) fn table(edges: usize, columns: &[&[f64]]) -> Table {
    let mut table = Table::new(edges, columns.len());
    for (column, numbers) in columns.iter().enumerate() {
        for (edge, number) in numbers.iter().enumerate() {
            table.row_mut(edge)[column] = *number;
        }
    }
    table
}

/// A vertex of no cell has no value.
pub(super) fn fix_unused(blocks: &[Block], fixed: &mut [bool]) {
    let used: BTreeSet<u32> = blocks.iter().flat_map(|block| block.functions.clone()).collect();
    for (function, fixed) in fixed.iter_mut().enumerate() {
        *fixed |= !used.contains(&(function as u32));
    }
}

//! The certificate as a quadratic form in (p, x, d).

use std::collections::BTreeSet;

use faer::Mat;

use super::Form;
use super::best::{Table, complete};
use super::block::Block;
use super::chain::Chain;
use super::elimination::{Field, failed};
use super::factor::{energies, triangular};
use super::functions::Functions;
use super::laws::Laws;
use super::residual::{blocks, jumps};
use super::spans::{excess, varies};
use super::stability::{Source, stability};
use signorini_certify::TermData;
use signorini_certify::ends::of_moved;
use signorini_problem::{Assembled, Parts, Problem};
use signorini_scene::error::Result;
use signorini_solve::unfit;

/// Data that the certificate is made from.
pub(super) struct FormData<'g> {
    pub problem: &'g Problem,
    pub parts: &'g Parts,
    /// The contact edge of each unknown.
    pub edges: &'g [usize],
    pub patterns: &'g [TermData],
    /// Columns of p, then those of x.
    pub fields: &'g [Field],
    /// d_i
    pub openings: &'g [f64],
    /// Ŝ
    pub matrix: &'g Mat<f64>,
    /// The field of a source that adds up to 1 on the one part that contact alone holds, and its condensed load.
    pub source: Option<(&'g Field, Vec<f64>)>,
    /// The unknowns of that part.
    pub floating: Vec<usize>,
    /// Transfer laws whose coefficient changes.
    pub laws: Option<&'g Laws>,
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
}

/// Either the form with the functions behind it, or a sentence why there is none.
pub(super) type Found = std::result::Result<(Form, Admissibles), String>;

impl FormData<'_> {
    /// The form with U = 1.
    ///
    /// # Errors
    /// Data that are not finite, a normal matrix that is singular to working precision.
    pub fn form(&self) -> Result<Found> {
        let (problem, patterns) = (self.problem, self.patterns);
        if let Some(reason) = self.obstacle()? {
            return Ok(Err(reason));
        }
        let chain = match Chain::new(problem, patterns, self.edges, self.openings, self.released) {
            Ok(chain) => chain,
            Err(reason) => return Ok(Err(reason)),
        };
        let functions = Functions::of(problem);
        let blocks = blocks(problem, patterns, &functions, self.laws, self.released)?;
        let fluxes = self.fluxes(self.fields);
        let mut s = self.boundary_values(&chain, &functions);
        let at_boundary = chain.fixed();
        let mut fixed = vec![false; functions.count()];
        at_boundary.iter().for_each(|&vertex| fixed[vertex as usize] = true);
        fix_unused(&blocks, &mut fixed);
        let judged = match self.laws {
            Some(laws) => [&blocks[..], &self.weighed(laws, &functions)?].concat(),
            None => Vec::new(),
        };
        let judged = if judged.is_empty() { &blocks } else { &judged };
        complete(judged, &fixed, &fluxes, &mut s).map_err(failed(&problem.scene))?;
        let Some(stability) = self.stability(&blocks) else {
            return Ok(Err("the condensed matrix is singular to working precision".to_owned()));
        };
        let assembled = Assembled::<f64>::new(problem).map_err(unfit::<f64>(&problem.scene))?;
        let widened = |factor: Vec<f64>| {
            let share = 1.0 + assembled.hidden();
            factor.into_iter().map(|entry| share * entry).collect::<Vec<_>>()
        };
        let jump = jumps(problem, patterns, &functions, self.released)?.map(|blocks| {
            let means = table(problem.ends.len(), self.fields, |field| &field.u);
            widened(packed(&triangular(&blocks, &s, &means)))
        });
        // As in `certify::Data`: for s, and for u_h beside it.
        let moved = chain.moved.iter().map(|moved| 2.0 * of_moved(problem, moved));
        let oscillation =
            patterns.iter().zip(moved).map(|(p, moved)| p.oscillation + moved).collect();
        let is_limited = !problem.loads.spans.is_empty();
        let form = Form {
            factor: widened(packed(&triangular(&blocks, &s, &fluxes))),
            lost: self.lost(&blocks, &s, &fluxes, &assembled, stability)?,
            jump,
            vertices: chain.contact.iter().map(|(_, vertex)| vertex.clone()).collect(),
            stability,
            corners: chain.corners,
            oscillation,
            floating: self.floating.clone(),
            ends: if is_limited { chain.ends } else { Vec::new() },
            span_excess: excess(problem, self.edges, self.openings),
        };
        let (contact, released) = (chain.contact.iter().map(|of| of.0).collect(), chain.released);
        Ok(Ok((form, Admissibles { s, fluxes, functions, contact, released })))
    }

    /// Fluxes of columns; and means of u behind them, where laws are read off these.
    fn fluxes(&self, fields: &[Field]) -> Table {
        let edges = self.problem.ends.len();
        let mut fluxes = table(edges, fields, |field| &field.flux);
        if self.laws.is_some() {
            fluxes.values.extend(table(edges, fields, |field| &field.u).values);
        }
        fluxes
    }

    /// The rows of changing laws, for the change that s is made for.
    fn weighed(&self, laws: &Laws, functions: &Functions) -> Result<Vec<Block>> {
        let mut blocks = laws.blocks(self.problem, self.patterns, functions)?;
        let rows = blocks.iter_mut().flat_map(|block| &mut block.rows);
        rows.flatten().for_each(|entry| *entry *= laws.change.sqrt());
        Ok(blocks)
    }

    /// Why these data allow for no bound.
    fn obstacle(&self) -> Result<Option<String>> {
        let counts = self.parts.counts;
        if counts.contact > 1 {
            let reason = "contact alone holds more than one part of the mesh: what is mended in each would have to leave through an edge of its own";
            return Ok(Some(reason.to_owned()));
        }
        if let Some(reason) = varies(self.problem, self.patterns) {
            return Ok(Some(reason));
        }
        let reason = self.patterns.iter().find_map(|pattern| pattern.no_bound.as_ref());
        Ok(reason.map(ToString::to_string))
    }

    /// s where it is fixed, in all columns: p, x, d.
    fn boundary_values(&self, chain: &Chain, functions: &Functions) -> Table {
        let (inputs, contact) = (self.patterns.len(), self.openings.len());
        let columns = inputs + contact + chain.contact.len();
        let mut s = Table::new(functions.count(), columns);
        for (&vertex, values) in &chain.dirichlet {
            s.row_mut(vertex as usize)[..inputs].copy_from_slice(values);
        }
        for (at, ((vertex, place), gap)) in chain.contact.iter().zip(&chain.gap).enumerate() {
            let row = s.row_mut(*vertex as usize);
            row[..inputs].copy_from_slice(gap);
            for (edge, weight) in place.edges.into_iter().zip(place.weights) {
                row[inputs + edge] += weight;
            }
            row[inputs + contact + at] = 1.0;
        }
        s
    }

    fn stability(&self, blocks: &[Block]) -> Option<f64> {
        let of_contact = &self.fields[self.patterns.len()..];
        let (mut columns, mut source) = (of_contact.to_vec(), None);
        if let Some((field, load)) = &self.source {
            columns.push((*field).clone());
            let mut inverse = vec![0.0; self.openings.len()];
            self.floating.iter().for_each(|&at| inverse[at] = 1.0 / self.openings[at]);
            source = Some(Source { inverse, load: load.clone() });
        }
        let fluxes = self.fluxes(&columns);
        stability(self.matrix, &energies(blocks, &fluxes), source.as_ref())
    }
}

/// The upper triangle by columns.
pub(super) fn packed(factor: &Mat<f64>) -> Vec<f64> {
    (0..factor.ncols()).flat_map(|j| (0..=j).map(move |i| factor[(i, j)])).collect()
}

/// Table of the values that `of` gives of fields, edge by edge.
fn table(edges: usize, fields: &[Field], of: impl Fn(&Field) -> &[f64]) -> Table {
    let mut table = Table::new(edges, fields.len());
    for (column, field) in fields.iter().enumerate() {
        for (edge, number) in of(field).iter().enumerate() {
            table.row_mut(edge)[column] = *number;
        }
    }
    table
}

/// A vertex of no cell has no value.
fn fix_unused(blocks: &[Block], fixed: &mut [bool]) {
    let used: BTreeSet<u32> = blocks.iter().flat_map(|block| block.functions.clone()).collect();
    for (function, fixed) in fixed.iter_mut().enumerate() {
        *fixed |= !used.contains(&(function as u32));
    }
}

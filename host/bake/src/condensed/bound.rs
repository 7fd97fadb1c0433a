//! The form of a condensed scene's error bound as the target has it.

use signorini_contact::certificate::{Corner, Form, Vertex};
use signorini_contact::factor::Factor;
use signorini_contact::sides::{self, ON_GAP, Sides};

use crate::narrow::narrow;
use signorini_condense::CondensedModel;
use signorini_problem::scalar::Scalar;

/// A quadratic form: its triangular factor by columns, and the norms of the columns.
#[derive(Debug, Clone)]
pub(super) struct Columns<R> {
    pub columns: Vec<R>,
    pub norms: Vec<R>,
}

/// The certificate's arrays.
#[derive(Debug, Clone)]
pub(super) struct Bound<R> {
    pub factor: Columns<R>,
    pub jump: Option<Columns<R>>,
    pub vertices: Vec<Vertex<R>>,
    /// Edge, excess and energy, see [`Corner`].
    pub corners: Vec<(u16, Vec<R>, R)>,
    /// Nothing where no flux has a limit.
    pub sides: Option<Ends<R>>,
    pub stability: R,
    pub floating: Vec<R>,
    pub oscillation: Vec<R>,
    pub row_sum: R,
    pub largest_load: Vec<R>,
    pub unit: R,
}

/// Where s − ψ comes from at the ends of contact edges, see [`sides::Baked`].
#[derive(Debug, Clone)]
pub(super) struct Ends<R> {
    pub ends: Vec<[u16; 2]>,
    pub scale: Vec<R>,
    pub excess: R,
    pub largest: Vec<R>,
}

impl<R: Scalar> Ends<R> {
    fn new(condensate: &CondensedModel, form: &signorini_condense::Form) -> Option<Self> {
        if condensate.spans.is_empty() {
            return None;
        }
        let end = |at: usize| u16::try_from(at).unwrap_or(ON_GAP);
        let scale = condensate.multiplier.iter().map(|m| R::narrow(m / condensate.energy_unit));
        let sizes = |column: &Vec<f64>| {
            let finite = column.iter().filter(|span| span.is_finite());
            R::narrow(finite.fold(0.0, |most: f64, span| most.max(span.abs())))
        };
        Some(Self {
            ends: form.ends.iter().map(|ends| ends.map(end)).collect(),
            scale: scale.collect(),
            excess: R::narrow(form.span_excess),
            largest: condensate.spans.iter().map(sizes).collect(),
        })
    }

    pub fn view(&self) -> sides::Baked<'_, R> {
        let Self { ends, scale, excess, largest } = self;
        sides::Baked { ends, scale, excess: *excess, largest }
    }
}

impl<R: Scalar> Columns<R> {
    /// The norms are what ε is multiplied by: what the host's own rounding may hide of a column is counted in them.
    pub fn new(factor: &[f64], lost: &[f64], order: usize) -> Self {
        let column = |j: usize| &factor[j * (j + 1) / 2..(j + 1) * (j + 2) / 2];
        let size = |j: usize| column(j).iter().map(|entry| entry * entry).sum::<f64>().sqrt();
        // What multiplies ε stands for the absolute rounding of numbers near underflow as well.
        let least = |j: usize| R::TINY.wide() * f64::from(j as u32 + 1).sqrt();
        let hidden = |j: usize| lost[j] / (2.0 * R::EPSILON.wide());
        let norms = (0..order).map(|j| R::narrow(size(j).max(least(j)) + hidden(j))).collect();
        Self { columns: narrow(factor), norms }
    }

    pub fn view(&self) -> Factor<'_, R> {
        Factor { columns: &self.columns, norms: &self.norms }
    }
}

impl<R: Scalar> Bound<R> {
    pub fn new(condensate: &CondensedModel, form: &signorini_condense::Form) -> Self {
        let n = condensate.contact;
        let order = condensate.inputs + n + form.vertices.len();
        let least = R::TINY.wide();
        let rows = condensate.matrix.chunks(n.max(1));
        let row_sums = rows.map(|row| row.iter().map(|entry| entry.abs()).sum());
        let largest =
            |column: &Vec<f64>| column.iter().fold(least, |most: f64, b| most.max(b.abs()));
        // Only their ratios matter.
        let most = condensate.multiplier.iter().fold(f64::MIN_POSITIVE, |most, m| most.max(*m));
        let mut floating = vec![0.0; if form.floating.is_empty() { 0 } else { n }];
        form.floating.iter().for_each(|&at| floating[at] = condensate.multiplier[at] / most);
        Self {
            factor: Columns::new(&form.factor, &form.lost, order),
            jump: form.jump.as_ref().map(|jump| Columns::new(jump, &form.lost, order)),
            vertices: form.vertices.iter().map(vertex).collect(),
            corners: form.corners.iter().map(corner).collect(),
            sides: Ends::new(condensate, form),
            stability: R::narrow(form.stability),
            floating: narrow(&floating),
            oscillation: narrow(&form.oscillation),
            row_sum: R::narrow(row_sums.fold(0.0, f64::max)),
            largest_load: condensate.load.iter().map(largest).map(R::narrow).collect(),
            unit: R::narrow(condensate.energy_unit),
        }
    }

    pub fn form<'a>(&'a self, corners: &'a [Corner<'a, R>]) -> Form<'a, R> {
        Form {
            factor: self.factor.view(),
            jump: self.jump.as_ref().map(Columns::view),
            vertices: &self.vertices,
            corners,
            sides: self.sides.as_ref().map_or(Sides::UNLIMITED, |ends| Sides::new(ends.view())),
            stability: self.stability,
            floating: &self.floating,
            oscillation: &self.oscillation,
            row_sum: self.row_sum,
            largest_load: &self.largest_load,
            unit: self.unit,
        }
    }
}

fn vertex<R: Scalar>(vertex: &signorini_condense::Vertex) -> Vertex<R> {
    Vertex {
        edges: vertex.edges.map(|edge| edge as u16),
        weights: vertex.weights.map(R::narrow),
        beside: vertex.beside.map(|edge| edge as u16),
    }
}

fn corner<R: Scalar>(corner: &signorini_condense::Corner) -> (u16, Vec<R>, R) {
    (corner.edge as u16, narrow(&corner.excess), R::narrow(2.0 * corner.energy))
}

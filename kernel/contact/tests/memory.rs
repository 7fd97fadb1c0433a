//! Owned memory of dense solves and ticks, a model that has nothing yet, and the one generator of random numbers.

use signorini_contact::dense::Iterate;
use signorini_contact::dense::blocks::{Block, Blocks, SIDE, count, padded};
use signorini_contact::dense::ranges::Given;
use signorini_contact::dense::tableau::{InitialTableau, Tableau};
use signorini_contact::method::{Method, SolveSummary};
use signorini_contact::spans::{SpanBuffer, SpanColumns};
use signorini_contact::{Condensed, Memory};
use signorini_kernel::limits::Deadline;
use signorini_kernel::{Error, Real};

/// Memory for so many contact edges; the tableau is S itself after [`Dense::reset`].
#[derive(Debug, Clone)]
pub struct Dense<R> {
    order: usize,
    pub x: Vec<R>,
    pub residual: Vec<R>,
    scratch: Vec<R>,
    pub open: Vec<bool>,
    pub load: Vec<R>,
    pub blocks: Vec<Block<R>>,
    pub exchanged: Vec<bool>,
    columns: [Vec<R>; 2],
}

impl<R: Real> Dense<R> {
    pub fn new(order: usize) -> Self {
        let zeros = || vec![R::ZERO; padded(order)];
        Self {
            order,
            x: zeros(),
            residual: zeros(),
            scratch: zeros(),
            open: vec![false; padded(order)],
            load: zeros(),
            blocks: vec![[[R::ZERO; SIDE]; SIDE]; count(order)],
            exchanged: vec![false; padded(order)],
            columns: [zeros(), zeros()],
        }
    }

    /// Memory whose tableau is `matrix`, with nothing exchanged.
    pub fn of(matrix: &Blocks<R>, order: usize) -> Result<Self, Error> {
        let mut dense = Self::new(order);
        dense.parts()?.0.reset(&InitialTableau::untouched(matrix))?;
        Ok(dense)
    }

    /// The tableau, and memory of the iterate beside it.
    pub fn parts(&mut self) -> Result<(Tableau<'_, R>, Iterate<'_, R>), Error> {
        let (tableau, memory) = self.ticking()?;
        Ok((tableau, memory.iterate))
    }

    /// Solves by a method without a tableau.
    pub fn solve(
        &mut self,
        method: &mut impl Method<R>,
        matrix: &Blocks<R>,
        given: Given<R>,
    ) -> Result<SolveSummary, Error> {
        method.solve(matrix, given, self.parts()?.1, &mut Deadline::never())
    }

    /// The tableau, and memory of a tick beside it.
    pub fn ticking(&mut self) -> Result<(Tableau<'_, R>, Memory<'_, R>), Error> {
        let Self { order, x, residual, scratch, open, load, blocks, exchanged, columns } = self;
        let [column, next] = columns;
        let tableau = Tableau::new(*order, blocks, exchanged, [column, next])?;
        let iterate = Iterate { x, residual, scratch, open };
        let spans = SpanBuffer::new(&mut []);
        let (combination, sum) = (&mut [][..], &mut [][..]);
        Ok((tableau, Memory { iterate, load, spans, combination, sum }))
    }
}

/// A model of no edges, inputs, outputs and bound.
pub const fn bare<'a, R: Real>() -> Condensed<'a, R> {
    Condensed {
        contact: 0,
        matrix: &[],
        x: &[],
        start: InitialTableau { blocks: &[], exchanged: &[] },
        load: &[],
        limits: &[],
        spans: SpanColumns::UNLIMITED,
        parts: &[],
        outputs: &[],
        certificate: None,
        has_bound: false,
    }
}

/// How far x and w = Sx − b are from the law, S being `entry` and w between `ends`.
pub fn defect(
    order: usize,
    entry: impl Fn(usize, usize) -> f64,
    [load, x]: [&[f64]; 2],
    ends: impl Fn(usize) -> [f64; 2],
) -> f64 {
    let of = |row: usize| {
        let w = (0..order).fold(-load[row], |sum, column| sum + entry(row, column) * x[column]);
        let [least, most] = ends(row);
        match x[row] {
            0.0 => (least - w).max(w - most).max(0.0),
            x if x > 0.0 => (w - least).abs(),
            _ => (w - most).abs(),
        }
    };
    (0..order).map(of).fold(0.0, f64::max)
}

/// Knuth's generator.
pub struct Draw(pub u64);

impl Draw {
    /// A number of [0, 1).
    pub fn part(&mut self) -> f64 {
        let next = self.0.wrapping_mul(6_364_136_223_846_793_005);
        self.0 = next.wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A number of [−1, 1).
    pub fn signed(&mut self) -> f64 {
        2.0 * self.part() - 1.0
    }

    /// One of these.
    pub fn of<const N: usize>(&mut self, all: [f64; N]) -> f64 {
        all[(self.part() * N as f64) as usize]
    }
}

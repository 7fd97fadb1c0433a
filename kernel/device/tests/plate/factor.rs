//! The plate's factor, and memory of ticks that it solves.

use signorini_contact::dense::Iterate;
use signorini_contact::dense::blocks::{Block, SIDE, count, padded};
use signorini_contact::dense::tableau::InitialTableau;
use signorini_device::sparse::direct::normalise;
use signorini_device::sparse::elimination::PatternBuffers;
use signorini_device::sparse::factor::FactorBuffers;
use signorini_device::sparse::{self, Exact, Factor, Factored, Pattern};
use signorini_device::tick::{Memory, Tick};
use signorini_kernel::csr::Csr;
use signorini_kernel::mesh::diagonal::DiagonalTerms;
use signorini_kernel::mesh::edges::EdgeCounts;
use signorini_kernel::relaxation::Relaxation;
use signorini_kernel::rows::{QUADS, Row, Rows};
use signorini_kernel::{Error, assembly};

use super::foundation::Foundation;

/// L, D and S of the plate, unknowns in their own order.
pub struct Baked {
    pub counts: EdgeCounts,
    pub places: Vec<u16>,
    pub pointers: Vec<u32>,
    pub rows: Vec<u16>,
    pub values: Vec<f64>,
    pub inverse: Vec<f64>,
    pub schur: Vec<Block<f64>>,
    pub scale: Vec<f64>,
    pub none: Vec<bool>,
}

impl Baked {
    pub fn new(foundation: &Foundation) -> Result<Self, Error> {
        let (edges, boundary) = (foundation.plate.edges()?, foundation.boundary()?);
        let counts = edges.counts();
        let mut row_ptr = vec![0; counts.unknowns() + 1];
        let mut col_idx = vec![0; edges.nonzeros()];
        let mut entries = vec![0.0; edges.nonzeros()];
        assembly::pattern(&edges, &mut row_ptr, &mut col_idx)?;
        let diagonal = DiagonalTerms::new(&boundary);
        assembly::values(&edges, foundation.stiffness(), diagonal, &row_ptr, &mut entries)?;
        let matrix = Csr::new(&row_ptr, &col_idx, &entries, counts.edges())?;
        let free = counts.free;
        // Every third one first: places are not numbers.
        let order: Vec<u16> = (0..3).flat_map(|first| (first..free as u16).step_by(3)).collect();
        let [mut places, mut parent] = [(); 2].map(|()| vec![0; free]);
        let mut pointers = vec![0; free + 1];
        let buffers = PatternBuffers {
            place: &mut places,
            parent: &mut parent,
            visited: &mut vec![0; free],
            pointers: &mut pointers,
        };
        let pattern = Pattern::new(&matrix, counts, &order, buffers)?;
        let number = pattern.entries();
        let (mut rows, mut values) = (vec![0; number], vec![0.0; number]);
        let (mut inverse, mut row) = (vec![0.0; free], vec![0.0; counts.unknowns()]);
        let mut schur = vec![[[0.0; SIDE]; SIDE]; count(counts.contact)];
        let buffers = FactorBuffers {
            rows: &mut rows,
            values: &mut values,
            inverse: &mut inverse,
            ends: &mut vec![0; free],
            path: &mut vec![0; free],
            visited: &mut vec![0; free],
            row: &mut row,
        };
        Factor::new(&matrix, pattern, buffers, &mut schur)?.expect("a factor");
        let mut scale = vec![0.0; padded(counts.contact)];
        assert!(normalise(&mut schur, &mut scale, counts.contact));
        let none = vec![false; scale.len()];
        Ok(Self { counts, places, pointers, rows, values, inverse, schur, scale, none })
    }

    pub fn view(&self) -> Factored<'_, f64, u16> {
        let Self { counts, places, pointers, rows, values, inverse, schur, scale, none } = self;
        let factor = Factor::baked(places, pointers, rows, values, inverse, *counts);
        Factored { factor, schur, scale, start: InitialTableau { blocks: schur, exchanged: none } }
    }
}

/// A tick and what solves it.
pub type Both<'a> = (Tick<'a, f64, u16, QUADS>, Exact<'a, f64, u16>);

/// Memory of a tick and what solves it.
pub type Parts<'a> = (Memory<'a, f64, u16, QUADS>, Exact<'a, f64, u16>);

/// Memory of ticks, and of the exchanges.
pub struct Store {
    rows: Vec<Row<f64, u16, QUADS>>,
    active: Vec<bool>,
    numbers: [Vec<f64>; 5],
    tableau: Vec<Block<f64>>,
    flags: [Vec<bool>; 2],
    columns: [Vec<f64>; 6],
}

impl Store {
    pub fn new(foundation: &Foundation) -> Result<Self, Error> {
        let counts = foundation.plate.edges()?.counts();
        let (unknowns, edges) = (counts.unknowns(), counts.edges());
        let lengths = [unknowns, foundation.plate.vertices.len(), edges, edges, edges];
        let length = padded(counts.contact);
        Ok(Self {
            rows: vec![Row::EMPTY; unknowns],
            active: vec![false; counts.contact],
            numbers: lengths.map(|length| vec![0.0; length]),
            // What was there before does not matter.
            tableau: vec![[[7.0; SIDE]; SIDE]; count(counts.contact)],
            flags: [(); 2].map(|()| vec![true; length]),
            columns: [(); 6].map(|()| vec![7.0; length]),
        })
    }

    pub fn of<'a>(
        &'a mut self,
        foundation: &'a Foundation,
        baked: &'a Baked,
    ) -> Result<Both<'a>, Error> {
        let (memory, mut exact) = self.memory(foundation, baked)?;
        exact.restart()?;
        Ok((Tick::new(foundation.discretization()?, memory, Relaxation::Adaptive(1.0))?, exact))
    }

    /// Memory of a tick, and the solver as the last one left it.
    pub fn memory<'a>(
        &'a mut self,
        foundation: &'a Foundation,
        baked: &'a Baked,
    ) -> Result<Parts<'a>, Error> {
        let [load, vertices, bubbles, tau, u] = &mut self.numbers;
        let rows = Rows::new(&foundation.plate.edges()?, &mut self.rows)?;
        let memory = Memory { rows, load, active: &mut self.active, vertices, bubbles, tau, u };
        let ([exchanged, open], [column, next, load, x, residual, scratch]) =
            (&mut self.flags, &mut self.columns);
        let iterate = Iterate { x, residual, scratch, open };
        let tableau = &mut self.tableau;
        let contact = sparse::Memory { tableau, exchanged, columns: [column, next], load, iterate };
        Ok((memory, Exact::new(baked.view(), contact)?))
    }
}

//! The plate's factor, and memory of ticks that it solves.

use signorini_contact::dense::Iterate;
use signorini_contact::dense::blocks::{Block, SIDE, count, padded};
use signorini_contact::dense::tableau::InitialTableau;
use signorini_device::sparse::factor::normalise;
use signorini_device::sparse::{self, Exact, Factored};
use signorini_device::tick::{Memory, Tick};
use signorini_kernel::csr::Csr;
use signorini_kernel::mesh::diagonal::DiagonalTerms;
use signorini_kernel::relaxation::Relaxation;
use signorini_kernel::rows::QUADS;
use signorini_kernel::{Error, assembly};

use super::foundation::Foundation;
use crate::ldlt::Ldlt;
use crate::owned::TickArrays;

/// L, D and S of the plate, unknowns in their own order.
pub struct Baked {
    pub ldlt: Ldlt<f64, u16>,
    pub scale: Vec<f64>,
    none: Vec<bool>,
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
        let free = counts.free as u16;
        // Every third one first: places are not numbers.
        let order: Vec<u16> = (0..3).flat_map(|first| (first..free).step_by(3)).collect();
        let mut ldlt = Ldlt::new(&matrix, counts, &order)?.expect("a factor");
        let mut scale = vec![0.0; padded(counts.contact)];
        assert!(normalise(&mut ldlt.schur, &mut scale, counts.contact));
        Ok(Self { ldlt, none: vec![false; scale.len()], scale })
    }

    pub fn view(&self) -> Factored<'_, f64, u16> {
        let (Self { scale, none, .. }, schur) = (self, &self.ldlt.schur);
        let start = InitialTableau { blocks: schur, exchanged: none };
        Factored { factor: self.ldlt.factor(), schur, scale, start }
    }
}

/// A tick and what solves it.
pub type Both<'a> = (Tick<'a, f64, u16, QUADS>, Exact<'a, f64, u16>);

/// Memory of a tick and what solves it.
pub type Parts<'a> = (Memory<'a, f64, u16, QUADS>, Exact<'a, f64, u16>);

/// Memory of ticks, and of the exchanges.
pub struct Store {
    arrays: TickArrays<f64>,
    tableau: Vec<Block<f64>>,
    flags: [Vec<bool>; 2],
    columns: [Vec<f64>; 6],
}

impl Store {
    pub fn new(foundation: &Foundation) -> Result<Self, Error> {
        let (edges, vertices) = (foundation.plate.edges()?, foundation.plate.vertices.len());
        let contact = edges.counts().contact;
        let length = padded(contact);
        Ok(Self {
            arrays: TickArrays::new(&edges, vertices),
            // What was there before does not matter.
            tableau: vec![[[7.0; SIDE]; SIDE]; count(contact)],
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
        let memory = self.arrays.memory(&foundation.plate.edges()?)?;
        let ([exchanged, open], [column, next, load, x, residual, scratch]) =
            (&mut self.flags, &mut self.columns);
        let iterate = Iterate { x, residual, scratch, open };
        let tableau = &mut self.tableau;
        let contact = sparse::Memory { tableau, exchanged, columns: [column, next], load, iterate };
        Ok((memory, Exact::new(baked.view(), contact)?))
    }
}

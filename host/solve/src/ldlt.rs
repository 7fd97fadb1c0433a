//! The kernel's factor, owned: order, pattern and numbers worked out in memory of the right size.

use signorini_contact::dense::blocks::{Block, SIDE, count};
use signorini_device::sparse::elimination::PatternBuffers;
use signorini_device::sparse::factor::FactorBuffers;
use signorini_device::sparse::{Factor, Pattern, Storage, storage};
use signorini_kernel::mesh::edges::EdgeCounts;
use signorini_kernel::system::System;
use signorini_kernel::{Error as KernelError, Real};

use signorini_problem::scalar::Scalar;
use signorini_reference::minimum_degree;

/// Factors of more entries are left to sweeps: two gigabytes.
const MOST_ENTRIES: usize = 150_000_000;

/// Contact edges beyond these too: S is dense.
const MOST_CONTACT: usize = 10_000;

/// K_II = L D Lᵀ and S of a matrix, in an order of least degree.
#[derive(Debug, Clone)]
pub struct Ldlt<R> {
    /// How many edges are free, in contact, given.
    pub counts: EdgeCounts,
    /// The place of each free unknown.
    pub places: Vec<u32>,
    /// Where the columns of L start, and the last one ends.
    pub pointers: Vec<u32>,
    /// The row of each entry of L.
    pub rows: Vec<u32>,
    /// The entries of L.
    pub values: Vec<R>,
    /// 1/D
    pub inverse: Vec<R>,
    /// S, the lower triangle of its blocks.
    pub schur: Vec<Block<R>>,
}

impl<R: Scalar> Ldlt<R> {
    /// Nothing where the matrix is singular in this scalar, or its factor would take too much memory.
    ///
    /// # Errors
    /// More unknowns than 32 bits number.
    pub fn new(system: &System<R, u32>) -> Result<Option<Self>, KernelError> {
        let (counts, matrix) = (system.counts(), system.matrix());
        let Some(order) = order(system) else { return Ok(None) };
        let zeros = || vec![0; counts.free];
        let (mut places, mut parent) = (zeros(), zeros());
        let mut pointers = vec![0; counts.free + 1];
        let buffers = PatternBuffers {
            place: &mut places,
            parent: &mut parent,
            visited: &mut zeros(),
            pointers: &mut pointers,
        };
        let pattern = Pattern::new(matrix, counts, &order, buffers)?;
        let entries = pattern.entries();
        if entries > MOST_ENTRIES || counts.contact > MOST_CONTACT {
            return Ok(None);
        }
        let (mut rows, mut values) = (vec![0; entries], vec![R::ZERO; entries]);
        let mut inverse = vec![R::ZERO; counts.free];
        let mut schur = vec![[[R::ZERO; SIDE]; SIDE]; count(counts.contact)];
        let buffers = FactorBuffers {
            rows: &mut rows,
            values: &mut values,
            inverse: &mut inverse,
            ends: &mut zeros(),
            path: &mut zeros(),
            visited: &mut zeros(),
            row: &mut vec![R::ZERO; counts.unknowns()],
        };
        if Factor::new(matrix, pattern, buffers, &mut schur)?.is_none() {
            return Ok(None);
        }
        Ok(Some(Self { counts, places, pointers, rows, values, inverse, schur }))
    }

    /// L and D.
    pub fn factor(&self) -> Factor<'_, R, u32> {
        let Self { counts, places, pointers, rows, values, inverse, .. } = self;
        Factor::baked(places, pointers, rows, values, inverse, *counts)
    }
}

/// The free unknowns in the order of their elimination, or nothing where memory is short.
fn order<R: Scalar>(system: &System<R, u32>) -> Option<Vec<u32>> {
    let free = system.counts().free;
    let rows = system.matrix().iter().take(free).map(|row| {
        row.entries().map(|(column, _)| column as u32).filter(|&column| (column as usize) < free)
    });
    minimum_degree(rows).ok().map(|[order, _]| order)
}

/// The kernel's memory for exchanges on S.
pub type Exchanges<R> = Storage<Vec<Block<R>>, Vec<R>, Vec<u8>>;

/// Exchanges for this number of contact edges.
pub fn exchanges<R: Real>(contact: usize) -> Exchanges<R> {
    let [blocks, numbers, flags] = storage::lengths(contact);
    let zero = [[R::ZERO; SIDE]; SIDE];
    Storage::of(vec![zero; blocks], vec![R::ZERO; numbers], vec![0; flags])
}

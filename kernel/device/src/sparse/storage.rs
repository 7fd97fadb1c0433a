//! Memory for the exchanges of a contact problem, lent or owned; can be a `static`. P and B are those of [`super::Factored`].

use signorini_contact::dense::Iterate;
use signorini_contact::dense::blocks::{Block, SIDE, count, padded};
use signorini_kernel::Real;
use signorini_kernel::error::{Array, Error, same_length};
use signorini_kernel::flags::restored;

/// Memory of a contact problem (borrowed).
#[derive(Debug)]
pub struct Memory<'a, R> {
    /// Exchanges, kept from solve to solve: B blocks.
    pub tableau: &'a mut [Block<R>],
    /// Which edges are exchanged: P entries.
    pub exchanged: &'a mut [bool],
    /// Scratch, P entries each.
    pub columns: [&'a mut [R]; 2],
    /// Scratch, P entries.
    pub load: &'a mut [R],
    /// x = v √S_ii, kept from solve to solve; scratch beside it. P entries each.
    pub iterate: Iterate<'a, R>,
}

/// Arrays of numbers, each of [`padded`] contact edges.
const NUMBERS: usize = 6;

/// Arrays of flags, as long.
const FLAGS: usize = 2;

/// The blocks of S, numbers and flags, in buffers as long as [`lengths`] says.
#[derive(Debug)]
pub struct Storage<Tableau, Floats, Flags> {
    tableau: Tableau,
    numbers: Floats,
    flags: Flags,
}

/// The same in arrays.
pub type ArrayStorage<R, const BLOCKS: usize, const NUMBERS: usize, const FLAGS: usize> =
    Storage<[Block<R>; BLOCKS], [R; NUMBERS], [u8; FLAGS]>;

/// How many blocks, numbers and flags so many contact edges take.
pub const fn lengths(contact: usize) -> [usize; 3] {
    [count(contact), NUMBERS * padded(contact), FLAGS * padded(contact)]
}

/// Their bytes.
pub const fn bytes<R>(contact: usize) -> usize {
    let [blocks, numbers, flags] = lengths(contact);
    blocks * size_of::<Block<R>>() + numbers * size_of::<R>() + flags
}

impl<R: Real, const BLOCKS: usize, const NUMBERS: usize, const FLAGS: usize>
    ArrayStorage<R, BLOCKS, NUMBERS, FLAGS>
{
    /// Zeros, which take no room in flash.
    pub const fn zeros() -> Self {
        Self::of([[[R::ZERO; SIDE]; SIDE]; BLOCKS], [R::ZERO; NUMBERS], [0; FLAGS])
    }
}

impl<Tableau, Floats, Flags> Storage<Tableau, Floats, Flags> {
    /// Before the first solve, in buffers of any contents.
    pub const fn of(tableau: Tableau, numbers: Floats, flags: Flags) -> Self {
        Self { tableau, numbers, flags }
    }

    /// What [`super::Exact::new`] takes for so many contact edges.
    ///
    /// # Errors
    /// Buffers of other lengths.
    pub fn memory<R: Real>(&mut self, contact: usize) -> Result<Memory<'_, R>, Error>
    where
        Tableau: AsMut<[Block<R>]>,
        Floats: AsMut<[R]>,
        Flags: AsMut<[u8]>,
    {
        let length = padded(contact);
        let [exchanged, open] = split(restored(self.flags.as_mut()), length)?;
        let [column, next, load, x, residual, scratch] = split(self.numbers.as_mut(), length)?;
        let iterate = Iterate { x, residual, scratch, open };
        let (tableau, columns) = (self.tableau.as_mut(), [column, next]);
        Ok(Memory { tableau, exchanged, columns, load, iterate })
    }
}

/// So many arrays of this length.
fn split<T, const COUNT: usize>(all: &mut [T], length: usize) -> Result<[&mut [T]; COUNT], Error> {
    same_length(Array::Scratch, all.len(), COUNT * length)?;
    let mut rest = all;
    Ok([(); COUNT].map(|()| {
        let (first, others) =
            core::mem::take(&mut rest).split_at_mut_checked(length).unwrap_or_default();
        rest = others;
        first
    }))
}

//! Owned memory of a baked scene: arrays that can be a `static`, or whatever else lends slices. Of any bits it is memory still:
//! what a reset or a brown-out has left of it may make a tick wrong, and nothing worse.

use super::storing::copy;
use super::{DataMemory, Full, HandedOn, Lengths, Memory, Numbers, Past};
use crate::tick::{self, Progress};
use signorini_bound::certificate::Curved;
use signorini_kernel::error::{Array, Error, same_length};
use signorini_kernel::flags::restored;
use signorini_kernel::mesh::boundary::{Neumann, Robin};
use signorini_kernel::rows::{LayOut, OwnedRows};
use signorini_kernel::{Index, Real};

/// All that changes from tick to tick, in buffers as long as [`Lengths`] says.
#[derive(Debug)]
pub struct Storage<R, Rows, Floats, Flags, Fluxes, Laws, Bends> {
    rows: Rows,
    numbers: Floats,
    active: Flags,
    neumann: Fluxes,
    robin: Laws,
    curved: Bends,
    progress: Progress<R>,
}

/// The same in arrays: of [`Lengths`] the rows, the sum of the numbers, the active edges and the records.
pub type ArrayStorage<
    R,
    I,
    const WIDTH: usize,
    const ROWS: usize,
    const NUMBERS: usize,
    const ACTIVE: usize,
    const NEUMANN: usize,
    const ROBIN: usize,
    const CURVED: usize,
> = Storage<
    R,
    OwnedRows<R, I, WIDTH, ROWS>,
    [R; NUMBERS],
    [u8; ACTIVE],
    [Neumann<R, I>; NEUMANN],
    [Robin<R, I>; ROBIN],
    [Curved<R, I>; CURVED],
>;

impl<
    R: Real,
    I: Index,
    const WIDTH: usize,
    const ROWS: usize,
    const NUMBERS: usize,
    const ACTIVE: usize,
    const NEUMANN: usize,
    const ROBIN: usize,
    const CURVED: usize,
> ArrayStorage<R, I, WIDTH, ROWS, NUMBERS, ACTIVE, NEUMANN, ROBIN, CURVED>
{
    /// Zeros, which take no room in flash.
    pub const fn zeros() -> Self {
        let (edge, zero, coupling) = (I::FIRST, R::ZERO, [R::ZERO; 8]);
        Self::of(
            OwnedRows::new(),
            [zero; NUMBERS],
            [0; ACTIVE],
            [Neumann { edge, flux: zero }; NEUMANN],
            [Robin { edge, coefficient: zero, ambient: zero }; ROBIN],
            [Curved { edge, mean: zero, peak: zero, energy: zero, coupling }; CURVED],
        )
    }
}

impl<R: Real, Rows, Floats, Flags, Fluxes, Laws, Bends>
    Storage<R, Rows, Floats, Flags, Fluxes, Laws, Bends>
{
    /// Before the first tick, in buffers of any contents.
    pub const fn of(
        rows: Rows,
        numbers: Floats,
        active: Flags,
        neumann: Fluxes,
        robin: Laws,
        curved: Bends,
    ) -> Self {
        Self { rows, numbers, active, neumann, robin, curved, progress: Progress::NONE }
    }

    /// What [`Full::tick`] takes; `lengths` is [`Lengths::of`] this scene. Always the same one: [`OwnedRows`] are laid out
    /// at the first call.
    ///
    /// # Errors
    /// Buffers of other lengths.
    pub fn memory<I: Index, const WIDTH: usize>(
        &mut self,
        full: &Full<R, I>,
        lengths: &Lengths,
    ) -> Result<Memory<'_, R, I, WIDTH>, Error>
    where
        Rows: LayOut<R, I, WIDTH>,
        Floats: AsMut<[R]>,
        Flags: AsMut<[u8]>,
        Fluxes: AsMut<[Neumann<R, I>]>,
        Laws: AsMut<[Robin<R, I>]>,
        Bends: AsMut<[Curved<R, I>]>,
    {
        let numbers = split(lengths, self.numbers.as_mut())?;
        let Numbers { load, u, tau, vertices, bubbles, triangles, quads, contact_flux, .. } =
            numbers;
        let [old, old_vertices, old_bubbles] = numbers.begin;
        Ok(Memory {
            tick: tick::Memory {
                rows: self.rows.lay_out(&full.discretization.edges)?,
                load,
                active: restored(self.active.as_mut()),
                vertices,
                bubbles,
                tau,
                u,
            },
            data: DataMemory {
                triangles,
                quads,
                neumann: self.neumann.as_mut(),
                robin: self.robin.as_mut(),
                contact_flux,
                gap: numbers.gap,
                gap_ends: pairs(numbers.gap_ends),
                dirichlet: numbers.dirichlet,
                dirichlet_ends: pairs(numbers.dirichlet_ends),
                curved: self.curved.as_mut(),
                transfer: pairs(numbers.transfer).as_chunks_mut().0,
                spans: numbers.spans,
            },
            past: Past {
                u: old,
                vertices: old_vertices,
                bubbles: old_bubbles,
                diagonal: numbers.diagonal,
                handed: numbers.handed,
            },
            handed_on: HandedOn { openings: pairs(numbers.openings), carried: numbers.carried },
            progress: &mut self.progress,
        })
    }

    /// The arrays of numbers as the last tick left them; nothing where `lengths` are of another scene.
    pub fn numbers(&self, lengths: &Lengths) -> Option<Numbers<&[R]>>
    where
        Floats: AsRef<[R]>,
    {
        let mut rest = self.numbers.as_ref();
        lengths.numbers.map(|length| {
            let (first, others) = rest.split_at_checked(length)?;
            rest = others;
            Some(first)
        })
    }

    /// Lays what the last tick has left into `to`, which has room for [`Lengths::handed_on`] numbers: 0 before the first one.
    pub fn hand_on(&self, lengths: &Lengths, to: &mut [R])
    where
        Floats: AsRef<[R]>,
        Flags: AsRef<[u8]>,
    {
        to.iter_mut().for_each(|to| *to = R::ZERO);
        if !self.has_begun() {
            return;
        }
        let Numbers { begin: [u, vertices, bubbles], openings, carried, .. } =
            self.numbers(lengths).unwrap_or_default();
        let search = self.progress.numbers();
        let arrays = [u, vertices, bubbles, openings, carried, &search[..]];
        let active = self.active.as_ref().iter();
        let flags = active.map(|&flag| if flag == 0 { R::ZERO } else { R::ONE });
        let all = arrays.into_iter().flatten().copied().chain(flags);
        to.iter_mut().zip(all).for_each(|(to, from)| *to = from);
    }

    /// Goes on from what [`Storage::hand_on`] has laid there.
    ///
    /// # Errors
    /// [`Error::ForeignState`] where it is of another length: nothing has changed then.
    pub fn take_over(&mut self, lengths: &Lengths, numbers: &[R]) -> Result<(), Error>
    where
        Floats: AsMut<[R]>,
        Flags: AsMut<[u8]>,
    {
        if numbers.len() != lengths.handed_on() {
            return Err(Error::ForeignState);
        }
        let Numbers { begin: [u, vertices, bubbles], openings, carried, u: answer, .. } =
            split(lengths, self.numbers.as_mut())?;
        let mut from = numbers.iter().copied();
        for array in [&mut *u, vertices, bubbles, openings, carried] {
            array.iter_mut().zip(from.by_ref()).for_each(|(to, from)| *to = from);
        }
        // A step begins where the last one has ended.
        copy(u, answer);
        let search = core::array::from_fn(|_| from.next().unwrap_or(R::ZERO));
        let active = self.active.as_mut().iter_mut();
        active.zip(from).for_each(|(to, from)| *to = u8::from(from != R::ZERO));
        self.progress = Progress::of_numbers(search);
        Ok(())
    }

    /// Whether there has been a tick.
    pub fn has_begun(&self) -> bool {
        self.progress.has_begun()
    }

    /// Forgets all ticks: the next one is the first again.
    pub fn reset(&mut self) {
        self.progress = Progress::NONE;
    }
}

fn split<'a, R>(lengths: &Lengths, all: &'a mut [R]) -> Result<Numbers<&'a mut [R]>, Error> {
    let (of, found, expected) = (Array::Scratch, all.len(), lengths.numbers.sum());
    same_length(of, found, expected)?;
    let mut rest = all;
    let numbers = lengths.numbers.map(|length| {
        let (first, others) = core::mem::take(&mut rest).split_at_mut_checked(length)?;
        rest = others;
        Some(first)
    });
    numbers.ok_or(Error::Length { of, found, expected })
}

fn pairs<R>(numbers: &mut [R]) -> &mut [[R; 2]] {
    numbers.as_chunks_mut().0
}

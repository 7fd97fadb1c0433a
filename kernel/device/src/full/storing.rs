//! A full model that steps in time: what its cells store, where it starts, and what one tick hands on to the next.
//!
//! ```text
//!   reset ─► Begin ─► Past ── step: load and rows with the masses ─► sweeps ─► answer ─┬─► Past of the next tick, B
//!                      ▲                                                               │
//!                      └────────── a refused tick leaves it, bit for bit ◄─────────────┘
//! ```

use core::cell::Cell;

use crate::controller::Window;
use crate::tick::{Data, InStep, Memory, Tick};
use signorini_bound::certificate::{Step, StoredCell};
use signorini_kernel::evolution::{Carried, Rates, StepTerms};
use signorini_kernel::mesh::boundary::Robin;
use signorini_kernel::storage::Storage;
use signorini_kernel::{Error, Index, Real};

/// What cells store in a step, and where the first one begins (borrowed).
#[derive(Debug, Clone, Copy)]
pub struct Storing<'a, R> {
    /// dt
    pub length: R,
    /// m_T of the triangles, and of the quads.
    pub masses: [&'a [R]; 2],
    /// What K_ii has beyond the element matrices, one per unknown: masses, and ∫h where no input changes one.
    pub diagonal: &'a [R],
    /// As the bound takes them; empty without one.
    pub cells: &'a [StoredCell<R>],
    /// Constants of the bound of the evolution.
    pub rates: Rates<R>,
    /// The start.
    pub begin: Begin<'a, R>,
    /// Whether sweeps begin anew in every tick; the step itself never does.
    pub is_cold: bool,
}

/// The state at the start (borrowed).
#[derive(Debug, Clone, Copy)]
pub struct Begin<'a, R> {
    /// Means of u over the edges.
    pub u: &'a [R],
    /// s at the vertices.
    pub vertices: &'a [R],
    /// The bubbles of s.
    pub bubbles: &'a [R],
    /// The means of (s − ψ)⁺ and (ψ − s)⁺ along each contact edge.
    pub openings: &'a [[R; 2]],
    /// B, and what of its weights falls before the start.
    pub carried: Carried<R>,
}

/// Memory of what the last tick has left (borrowed); empty where nothing stores.
#[derive(Debug, Default)]
#[allow(missing_docs)]
pub struct Past<'a, R> {
    pub u: &'a mut [R],
    pub vertices: &'a mut [R],
    pub bubbles: &'a mut [R],
    /// [`Storing::diagonal`] where inputs change ∫h.
    pub diagonal: &'a mut [R],
    /// [`InStep::handed`]
    pub handed: &'a mut [R],
}

/// Memory of what else the bound of the evolution takes from it (borrowed).
#[derive(Debug, Default)]
#[allow(missing_docs)]
pub struct HandedOn<'a, R> {
    pub openings: &'a mut [[R; 2]],
    /// [`Carried`]
    pub carried: &'a mut [R],
}

/// Copies as much as there is.
pub(super) fn copy<T: Copy>(from: &[T], to: &mut [T]) {
    to.iter_mut().zip(from).for_each(|(to, &from)| *to = from);
}

fn carried<R: Real>(numbers: &[R]) -> Carried<R> {
    match *numbers {
        [bound, before] => Carried { bound, before },
        _ => Carried { bound: R::INFINITY, before: R::ZERO },
    }
}

impl<R: Real> Storing<'_, R> {
    /// The bound of the evolution for the `numbers` that are carried, or at the start; nothing where it is infinite.
    pub(super) fn window(&self, numbers: Option<&[R]>) -> Option<Window<R>> {
        let carried = numbers.map_or(self.begin.carried, carried);
        let (energy, seconds) = (self.rates.energy(carried), self.rates.seconds);
        energy.finite().then_some(Window { energy, seconds })
    }
}

impl<R: Real> Past<'_, R> {
    /// Goes back to the start.
    pub(super) fn begin(&mut self, of: &Begin<R>) {
        copy(of.u, self.u);
        copy(of.vertices, self.vertices);
        copy(of.bubbles, self.bubbles);
    }

    /// Adds these transfer laws to the masses where inputs change them.
    pub(super) fn weigh<I: Index>(&mut self, of: &Storing<R>, laws: &[Robin<R, I>]) {
        if self.diagonal.is_empty() {
            return;
        }
        copy(of.diagonal, self.diagonal);
        for law in laws {
            if let Some(term) = self.diagonal.get_mut(law.edge.at()) {
                *term += law.coefficient;
            }
        }
    }

    /// The step that begins here, with these openings.
    pub(super) fn step<'s>(
        &'s mut self,
        of: &Storing<'s, R>,
        openings: &'s [[R; 2]],
    ) -> InStep<'s, R> {
        InStep {
            step: Step {
                length: of.length,
                storage: Storage::baked(of.masses, self.u),
                cells: of.cells,
                vertices: self.vertices,
                bubbles: self.bubbles,
                openings,
            },
            diagonal: if self.diagonal.is_empty() { of.diagonal } else { self.diagonal },
            handed: Cell::new(&mut *self.handed),
            terms: Cell::default(),
        }
    }

    /// The next step begins from this answer.
    pub(super) fn advance<I, const WIDTH: usize>(&mut self, answer: &Memory<R, I, WIDTH>) {
        copy(answer.u, self.u);
        copy(answer.vertices, self.vertices);
        copy(answer.bubbles, self.bubbles);
    }
}

impl<R: Real> HandedOn<'_, R> {
    /// Goes back to the start.
    pub(super) fn begin(&mut self, of: &Begin<R>) {
        copy(of.openings, self.openings);
        copy(&[of.carried.bound, of.carried.before], self.carried);
    }

    /// Takes in the terms of the step that has just ended, and how far its s is from ψ; without a bound nothing is known from it on.
    pub(super) fn advance<I: Index, const WIDTH: usize>(
        &mut self,
        of: &Storing<R>,
        terms: &[Option<StepTerms<R>>],
        tick: &Tick<R, I, WIDTH>,
        data: &Data<R, I>,
    ) -> Result<(), Error> {
        let Carried { bound, before } = of.rates.advance(carried(self.carried), terms);
        copy(&[bound, before], self.carried);
        tick.open(data, self.openings)
    }
}

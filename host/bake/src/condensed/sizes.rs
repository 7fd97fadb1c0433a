//! What a condensed model takes of a device, from its sizes alone.

use signorini_contact::dense::blocks::{count, padded};

use super::arrays::{Baked, Solver};
use super::statics::written;
use super::steps::Steps;
use crate::Bakes;
use crate::dense::Price;
use crate::full::Sizes;

/// Bytes of a block of the matrix, in numbers.
const BLOCK: usize = 64;

impl<R: Bakes> Baked<R> {
    /// The sizes by which its ticks are priced, with so many entries of loads and outputs, and the exact method or
    /// without.
    pub fn price(&self, entries: usize, exact: bool) -> Price {
        let (bound, laws) = (self.bound.as_ref(), usize::from(self.modes.is_some()));
        Price {
            order: padded(self.contact),
            entries,
            vertices: bound.map_or(0, |bound| bound.vertices.len()),
            columns: self.columns(),
            exact,
            is_limited: self.is_limited(),
            forms: bound.map_or(0, |bound| 1 + usize::from(bound.jump.is_some()) + laws),
            changes: self.steps.as_ref().map_or(0, Steps::changes),
            modes: self.modes.as_ref().map_or(0, |modes| modes.count),
            handed_on: self.steps.as_ref().map_or(0, |_| self.terms()),
        }
    }

    /// How many numbers one tick hands on to the next: a flag, the terms, and the tableau with two flags or none.
    pub fn handed_on(&self) -> usize {
        let tableau = match self.solver() {
            Solver::Exchanges(_) | Solver::TwoPhases => {
                1 + BLOCK * count(self.contact) + padded(self.contact)
            }
            Solver::Linear | Solver::Sweeps => 0,
        };
        1 + self.terms() + tableau
    }

    /// Bytes that modes take beside the bound.
    fn of_modes(&self) -> usize {
        self.modes.as_ref().map_or(0, |modes| {
            let columns = modes.count * padded(self.contact);
            let own = modes.compliance.len() + modes.of_inputs.len() + columns;
            (own + BLOCK * count(self.contact) + self.inputs + modes.count) * size_of::<R>()
        })
    }

    /// The parts of the model: name, whether it is there, its bytes of RAM and flash, why.
    pub fn features(&self) -> impl Iterator<Item = (&'static str, bool, usize, String)> {
        let (whole, n) = (sizes(self), padded(self.contact));
        let total = |sizes: Sizes| sizes.ram + sizes.flash;
        let without = |change: &dyn Fn(&mut Self)| {
            let mut other = self.clone();
            change(&mut other);
            total(whole).saturating_sub(total(sizes(&other)))
        };
        let exact = self.work.pivots.is_some();
        let tableau = without(&|other| other.work.pivots = None);
        let of_bound = without(&|other| {
            other.bound = Err(String::new());
            other.steps.iter_mut().for_each(Steps::forget_evolution);
        });
        let corners = self.bound.as_ref().map_or(0, |bound| bound.corners.len());
        let floating = self.bound.as_ref().is_ok_and(|bound| !bound.floating.is_empty());
        let scalar = size_of::<R>();
        let matrix = format!("{} contact edges, half of a symmetric matrix", self.contact);
        let method = match exact {
            true if self.modes.is_some() => "a tableau",
            true => "a tableau, and the one it begins with",
            false if self.contact == 0 => "no contact edges",
            false => "see the models above: what it takes, and why it is not chosen",
        };
        let inputs = format!("{} and the constant part", self.inputs - 1);
        let modes =
            self.modes.as_ref().map_or("no transfer coefficient changes".to_owned(), |of| {
                let all = of.count + of.left_out;
                format!("{} of {all} modes of the coefficient's boundary kept", of.count)
            });
        let steps = self.steps.as_ref();
        let states = steps.map_or("no material stores anything".to_owned(), |of| {
            format!("{} states of the {} that the mesh has", of.count(), of.modes)
        });
        let of_steps = steps.map_or(0, |of| {
            let of_load = self.load.len() - self.inputs * n;
            (of_load + of.fading.len() + of.of_inputs.len() + of.begin.len() + self.terms())
                * scalar
        });
        let bound = self.bound.as_ref().map_or_else(String::clone, |bound| {
            let forms = if self.modes.is_some() { "factors" } else { "a factor" };
            let changes = match self.steps.as_ref().map_or(0, Steps::changes) {
                0 => String::new(),
                columns => format!(", and two of {columns} for what a step changes"),
            };
            format!("{forms} of {} columns{changes}", bound.factor.norms.len())
        });
        let spans = match self.varying_spans() {
            _ if !self.is_limited() => "no flux has a limit",
            0 => "fixed, on every edge",
            _ => "inputs change them",
        };
        let above = format!("{corners} touching edges end at a value that may lie above the gap");
        let held = match floating {
            true => "contact alone holds the domain",
            false => "a Dirichlet or Robin boundary holds the domain",
        };
        let of_floating = if floating { self.contact * scalar } else { 0 };
        [
            ("matrix S", self.contact > 0, self.matrix.len() * BLOCK * scalar, matrix),
            ("exact method", exact, tableau, method.to_owned()),
            ("inputs", self.inputs > 1, self.inputs * n * scalar, inputs),
            ("modes", self.modes.is_some(), self.of_modes(), modes),
            ("steps in time", steps.is_some(), of_steps, states),
            ("error bound", self.bound.is_ok(), of_bound, bound),
            ("limits of fluxes", self.is_limited(), self.spans.len() * scalar, spans.to_owned()),
            ("corners", corners > 0, corners * self.inputs * scalar, above),
            ("floating domain", floating, of_floating, held.to_owned()),
        ]
        .into_iter()
    }
}

/// RAM of the `Controller` and flash of its data, exact but for alignment and lengths of slices.
pub fn sizes<R: Bakes>(baked: &Baked<R>) -> Sizes {
    let (n, scalar) = (padded(baked.contact), size_of::<R>());
    let columns = baked.columns();
    let tableau = match baked.solver() {
        Solver::Exchanges(_) | Solver::TwoPhases => {
            (BLOCK * count(baked.contact) + 2 * n + 1) * scalar + n
        }
        _ => 0,
    };
    let modes = baked.modes.as_ref();
    let followed =
        modes.map_or(0, |modes| BLOCK * count(baked.contact) + baked.inputs + modes.count + 2);
    let steps = baked.steps.as_ref().map_or(0, |_| baked.terms() + 1);
    // A flag takes a number's room, as arrays end where a number may begin.
    Sizes {
        ram: (4 * n + 2 * columns + baked.varying_spans() + followed + steps + 1) * scalar
            + n
            + tableau,
        flash: written(std::iter::repeat(""), baked).bytes,
    }
}

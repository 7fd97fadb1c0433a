//! A whole solve, step by step what `signorini solve` does.

use signorini_device::model::Model;
use signorini_kernel::law::Law;
use signorini_kernel::mesh::diagonal::DiagonalTerms;
use signorini_kernel::refinement;
use signorini_kernel::rows::{QUADS, Row, Rows, TRIANGLES};
use signorini_kernel::solver::{Outcome, Settings, Status};
use signorini_kernel::system::System;
use signorini_kernel::{Error, Math, contact, flux};

use super::matrix::{Memory, residual};
use super::{CONTACT, EDGES, cut};
use crate::journal::{Bits, Journal};

/// Most sweeps: more than any of the scenes needs.
const MOST: u32 = 20_000;

#[inline(never)]
pub(super) fn scene<R: Bits, M: Math<R>>(
    model: &Model<R, u16>,
    journal: &mut Journal,
) -> Result<(), Error> {
    let (edges, boundary) = (model.edges()?, model.boundary()?);
    let mut memory = Memory::new();
    let system = memory.system(model, &edges, &boundary)?;
    let (mut iterate, mut low) = ([R::ZERO; EDGES], [R::ZERO; EDGES]);
    let u = cut(&mut iterate, model.start.len())?;
    let low = cut(&mut low, model.start.len())?;
    u.copy_from_slice(model.start);
    let outcome = if model.quads.is_empty() {
        refine::<R, M, TRIANGLES>(model, &system, u, low)?
    } else {
        refine::<R, M, QUADS>(model, &system, u, low)?
    };
    let mut fluxes = [R::ZERO; EDGES];
    let fluxes = cut(&mut fluxes, u.len())?;
    let found = flux::recover(&edges, model.stiffness, model.loads, u, low, fluxes)?;
    let length = contact::length::<R, u16, M>(&model.mesh()?, &edges, Law::above(model.gap), u);

    journal.text(name(outcome.status));
    journal.count("sweeps", outcome.sweeps);
    journal.count("conjugate", outcome.conjugate);
    journal.scalar("omega", outcome.omega);
    residual(&outcome.residual, journal);
    journal.digest("u", u.iter().copied());
    journal.digest("u, low part", low.iter().copied());
    journal.digest("flux", fluxes.iter().copied());
    journal.scalar("mismatch", found.mismatch);
    journal.scalar("largest flux", found.largest);
    let force = contact::force(model.counts, &boundary, Law::above(model.gap), u, fluxes);
    journal.scalar("contact force", force);
    journal.scalar("contact length", length * model.unit);
    Ok(())
}

#[inline(never)]
fn refine<R: Bits, M: Math<R>, const WIDTH: usize>(
    model: &Model<R, u16>,
    system: &System<R, u16>,
    u: &mut [R],
    low: &mut [R],
) -> Result<Outcome<R>, Error> {
    let mut rows = [Row::<R, u16, WIDTH>::EMPTY; EDGES];
    let rows = Rows::new(&model.edges()?, cut(&mut rows, model.counts.unknowns())?)?;
    let mut scratch = [R::ZERO; 3 * EDGES + CONTACT];
    let scratch = cut(&mut scratch, refinement::scratch(model.counts))?;
    let settings = Settings { accuracy: R::EPSILON, max_sweeps: MOST, ..Settings::default() };
    let diagonal = DiagonalTerms::new(&model.boundary()?);
    refinement::run::<R, u16, M, WIDTH>(system, diagonal, settings, 6, [u, low], rows, scratch)
}

fn name(status: Status) -> &'static str {
    match status {
        Status::Converged => "converged",
        Status::RoundingLimit => "rounding limit",
        Status::OutOfSweeps => "out of sweeps",
        Status::Stalled => "stalled",
        Status::NotFinite => "not finite",
    }
}

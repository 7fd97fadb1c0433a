//! Ticks: what ends them, what they leave to the next one.

use signorini_bound::certificate::LoadCase;
use signorini_bound::conforming::VertexData;
use signorini_device::tick::{
    CertifiedSweeps, Data, Deadline, IfStoring, Limits, Report, Tick, UncertifiedSweeps,
};
use signorini_kernel::assembly::CellLoads;
use signorini_kernel::law::Law;
use signorini_kernel::relaxation::Relaxation;
use signorini_kernel::rows::QUADS;
use signorini_kernel::{Error, Libm};

use super::arrays::Arrays;
use super::bound;
use super::journal::Journal;
use super::scene::{Draw, Scalar};
use crate::owned::TickArrays;

pub fn run<R: Scalar>(arrays: &Arrays<R>, journal: &mut Journal) -> Result<(), Error> {
    let ways = bound::ground(arrays, 4)?;
    let discretization =
        ways.discretization(arrays.mesh()?, arrays.edges()?, arrays.stiffness())?;
    let mut own = TickArrays::new(&discretization.edges, arrays.vertices.len());
    let memory = own.memory(&discretization.edges)?;
    let relaxation = Relaxation::for_unknowns(arrays.counts.unknowns());
    let mut tick = Tick::new(discretization, memory, relaxation)?;
    let mut draw = Draw(13);
    for at in 0..14 {
        let [shift, part] = [0.0, 1.0].map(|middle| R::of(middle + 0.5 * draw.signed()));
        let input = Input::new(arrays, shift, part);
        let mut running = tick.begin(input.data(arrays)?)?;
        let mut left = 40 * at;
        let remaining = || {
            left -= u32::from(left > 0);
            left
        };
        let (sweep, certificate) = (1 + at % 3, 4 * (at % 4));
        let mut deadline = Deadline { remaining, sweep, certificate };
        let sweeps = [7, 60, 250, 1000][at as usize % 4];
        let share = R::of([0.0, 0.125, 0.5][at as usize % 3]);
        let limits = Limits { sweeps, share, error: R::of(0.01) };
        let report = if at % 5 == 3 {
            running.advance(UncertifiedSweeps(Libm), limits, &mut deadline)?
        } else if at % 5 == 4 {
            running.advance(CertifiedSweeps(Libm), limits, &mut Deadline::never())?
        } else {
            running.advance(CertifiedSweeps(Libm), limits, &mut deadline)?
        };
        tell(&tick, report, journal);
    }
    // To the floor; then without a limit that a certificate could meet, and with one again.
    let limits = |sweeps: u32, share: f64| Limits { sweeps, share: R::of(share), error: R::ZERO };
    for parts in [&[(3000, 1e-30)][..], &[(9, 0.0), (40, 1e-3), (40, 1e-3)]] {
        let input = Input::new(arrays, R::of(0.5 * draw.signed()), R::of(1.0 + draw.next()));
        let mut running = tick.begin(input.data(arrays)?)?;
        let advance = |&(sweeps, share): &(u32, f64)| {
            let limits = limits(sweeps, share);
            running.advance(CertifiedSweeps(Libm), limits, &mut Deadline::never())
        };
        let reports: Result<Vec<_>, _> = parts.iter().map(advance).collect();
        reports?.into_iter().for_each(|report| tell(&tick, report, journal));
    }
    // Squares overflow, and then the numbers themselves might.
    let large = R::of(3.5) / R::TINY;
    for part in [large.rounded_sqrt() * R::of(64.0), large] {
        let input = Input::new(arrays, R::ZERO, part);
        match tick.begin(input.data(arrays)?) {
            Ok(mut running) => {
                let (limits, never) = (limits(60, 1e-2), &mut Deadline::never());
                let report = running.advance(CertifiedSweeps(Libm), limits, never)?;
                tell(&tick, report, journal);
            }
            Err(error) => journal.line("refused", error),
        }
    }
    Ok(())
}

fn tell<R: Scalar>(tick: &Tick<R, u16, QUADS>, report: Report<R>, journal: &mut Journal) {
    journal.line("tick", (report.ended, report.sweeps, report.active));
    journal.report(report);
    journal.digest("u and tau", (tick.u(), tick.tau()));
}

/// The scene with its gap shifted and its source multiplied.
struct Input<R> {
    cells: [Vec<R>; 2],
    ends: Vec<[R; 2]>,
    lower: Vec<R>,
}

impl<R: Scalar> Input<R> {
    fn new(arrays: &Arrays<R>, shift: R, part: R) -> Self {
        let of = |loads: &[R]| loads.iter().map(|&f| f * part).collect();
        Self {
            cells: [of(&arrays.loads.0), of(&arrays.loads.1)],
            ends: arrays.gap.iter().map(|ends| ends.map(|psi| psi + shift)).collect(),
            lower: arrays.lower.iter().map(|&psi| psi + shift).collect(),
        }
    }

    fn data<'a>(&'a self, arrays: &'a Arrays<R>) -> Result<Data<'a, R, u16>, Error> {
        let given = LoadCase {
            loads: CellLoads { triangles: &self.cells[0], quads: &self.cells[1] },
            boundary: arrays.boundary()?,
            ends: VertexData { gap: &self.ends, given: &arrays.given },
            ..LoadCase::default()
        };
        let dirichlet = &arrays.start[arrays.counts.unknowns()..];
        Ok(Data { given, law: Law::above(&self.lower), dirichlet, step: IfStoring::NOTHING })
    }
}

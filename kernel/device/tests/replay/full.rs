//! Full models: every kind of pattern and of output.

use signorini_bound::certificate::Curved;
use signorini_bound::conforming::VertexData;
use signorini_device::full::{
    Along, Base, Contribution, CurvedPart, CurvedSum, DataMemory, EdgeTrace, Full, Functional,
    Lengths, Memory, Pattern, Points, Product, Storage,
};
use signorini_device::tick::{
    CertifiedSweeps, Deadline, IfStoring, Limits, Progress, Report, UncertifiedSweeps,
};
use signorini_kernel::mesh::boundary::{Neumann, Robin};
use signorini_kernel::relaxation::Relaxation;
use signorini_kernel::rows::{QUADS, Row};
use signorini_kernel::{Error, Libm};

use super::arrays::Arrays;
use super::bound;
use super::journal::Journal;
use super::scene::{Draw, Scalar};
use crate::owned::{TickArrays, of_full};

/// Every third place, with a random weight.
fn shares<R: Scalar>(count: usize, draw: &mut Draw) -> Vec<Contribution<R, u16>> {
    let places = (0..count).step_by(3);
    places.map(|at| Contribution { at: at as u16, weight: R::of(0.5 * draw.signed()) }).collect()
}

fn chords<R: Scalar>(count: usize, draw: &mut Draw) -> Vec<EdgeTrace<R, u16>> {
    let chord = |at: usize| {
        let ends = [R::of(0.5 * draw.signed()), R::of(0.5 * draw.signed())];
        EdgeTrace { at: at as u16, mean: (ends[0] + ends[1]) * R::HALF, ends }
    };
    (0..count).step_by(2).map(chord).collect()
}

pub fn run<R: Scalar>(arrays: &Arrays<R>, journal: &mut Journal) -> Result<(), Error> {
    let (mut draw, counts) = (Draw(5), arrays.counts);
    let sources =
        [shares(arrays.loads.0.len(), &mut draw), shares(arrays.loads.1.len(), &mut draw)];
    let [neumann, laws, flux] = [arrays.neumann.len(), arrays.robin.len(), counts.contact]
        .map(|count| shares(count, &mut draw));
    let (gap, value) = (chords(counts.contact, &mut draw), chords(counts.dirichlet, &mut draw));
    let points: Vec<_> = (0..arrays.robin.len() as u16)
        .map(|at| Points { at, values: std::array::from_fn(|_| R::of(0.5 * draw.signed())) })
        .collect();
    let patterns = [
        Pattern::Source { triangles: &sources[0], quads: &sources[1] },
        Pattern::Neumann(&neumann),
        Pattern::ContactFlux(&flux),
        Pattern::Gap(&gap),
        Pattern::Value(&value),
        Pattern::Ambient { integrals: &laws, points: &points },
    ];
    let stated = |law: &Robin<R, u16>| [[law.coefficient, law.ambient / law.coefficient]; 8];
    let transfer: Vec<_> = arrays.robin.iter().map(stated).collect();
    let part = |input: u16, size: f64| CurvedPart {
        input,
        mean: R::of(0.01 * size),
        peak: R::of(0.01 * size.abs()),
        coupling: std::array::from_fn(|k| R::of(0.01 * size * (k as f64 - 3.0))),
    };
    let parts = [part(0, 1.0), part(4, -0.5), part(5, 0.75)];
    let product = |i: u16, j: u16, weight: f64| Product { inputs: [i, j], weight: R::of(weight) };
    let energy = [product(0, 0, 0.02), product(0, 4, -0.01), product(4, 5, 0.005)];
    let bent = (counts.free..counts.edges()).step_by(4);
    let sums: Vec<_> =
        bent.map(|edge| CurvedSum { edge: edge as u16, parts: &parts, energy: &energy }).collect();
    let all: Vec<u16> = (0..counts.edges() as u16).step_by(2).collect();
    let touching: Vec<u16> = (0..counts.contact as u16).collect();
    let (lengths, probe) = (shares(counts.contact, &mut draw), shares(counts.edges(), &mut draw));
    let outputs = [
        Functional::Flux(&all),
        Functional::Force(&touching),
        Functional::Length(&lengths),
        Functional::Probe(&probe),
        Functional::Bound,
    ];
    let ways = bound::ground(arrays, 0)?;
    let oscillation = [0.125, 0.0625, 0.25, 0.5, 0.03125, 0.125, 0.0625].map(R::of);
    let corner = |at: usize, place: usize| [at as u16, place as u16];
    let corners = [corner(1, 2 * counts.contact), corner(2 * counts.contact - 1, 0)];
    let full = Full {
        discretization: ways.discretization(arrays.mesh()?, arrays.edges()?, arrays.stiffness())?,
        base: Base {
            loads: arrays.cell_loads(),
            neumann: &arrays.neumann,
            robin: &arrays.robin,
            contact_flux: &arrays.flux,
            gap: &arrays.lower,
            dirichlet: &arrays.start[counts.unknowns()..],
            ends: arrays.ends(),
            curved_sums: &sums,
            transfer: Along::Seen(&transfer),
            ..Base::default()
        },
        patterns: &patterns,
        oscillation: &oscillation,
        outputs: &outputs,
        has_bound: true,
        corners: if counts.dirichlet > 0 { &corners } else { &[] },
        start: R::HALF,
        relaxation: Relaxation::Adaptive(R::of(1.5)),
        storing: IfStoring::NOTHING,
    };
    play(arrays, &full, 9, journal)?;
    // u_D next to ψ where they meet: as good as equal, then too low; then data that allow for no bound.
    let (twos, inputs_off) = (vec![[R::TWO; 2]; counts.contact], Full { patterns: &[], ..full });
    for (ulps, has_bound) in [(64.0, true), (256.0, true), (0.0, false)] {
        let low = vec![[R::TWO - R::of(ulps) * R::EPSILON; 2]; counts.dirichlet];
        let ends = VertexData { gap: &twos, given: &low };
        let base = Base { ends, ..full.base };
        let corners = if counts.dirichlet > 0 { &[[0, 0]][..] } else { &[] };
        play(arrays, &Full { base, corners, has_bound, ..inputs_off }, 3, journal)?;
    }
    Ok(())
}

/// The data that inputs change: all of them.
struct Own<R> {
    numbers: [Vec<R>; 5],
    ends: [Vec<[R; 2]>; 2],
    curved: Vec<Curved<R, u16>>,
    transfer: Vec<[[R; 2]; 8]>,
}

/// Memory of exactly the size that the scene needs.
type Stored<R> = Storage<
    R,
    Vec<Row<R, u16, QUADS>>,
    Vec<R>,
    Vec<u8>,
    Vec<Neumann<R, u16>>,
    Vec<Robin<R, u16>>,
    Vec<Curved<R, u16>>,
>;

fn stored<R: Scalar>(lengths: &Lengths) -> Stored<R> {
    Storage::of(
        vec![Row::EMPTY; lengths.rows],
        vec![R::ONE; lengths.numbers.sum()],
        vec![1; lengths.active],
        vec![Neumann::default(); lengths.neumann],
        vec![Robin::default(); lengths.robin],
        vec![Curved::default(); lengths.curved],
    )
}

/// A tick by sweeps, with certificates or without.
fn tick<R: Scalar>(
    full: &Full<R, u16>,
    inputs: &[R],
    is_certified: bool,
    limits: Limits<R>,
    memory: Memory<R, u16, QUADS>,
) -> Result<(Report<R>, [R; 5]), Error> {
    let (limits, never, mut outputs) = ((None, limits), &mut Deadline::never(), [R::ZERO; 5]);
    let report = match is_certified {
        true => full.tick(inputs, CertifiedSweeps(Libm), limits, never, memory, &mut outputs),
        false => full.tick(inputs, UncertifiedSweeps(Libm), limits, never, memory, &mut outputs),
    };
    Ok((report?, outputs))
}

fn play<R: Scalar>(
    arrays: &Arrays<R>,
    full: &Full<R, u16>,
    ticks: u32,
    journal: &mut Journal,
) -> Result<(), Error> {
    let base = &full.base;
    let lengths =
        [base.loads.triangles, base.loads.quads, base.contact_flux, base.gap, base.dirichlet];
    let mut own = Own {
        numbers: lengths.map(<[R]>::to_vec),
        ends: [base.ends.gap.to_vec(), base.ends.given.to_vec()],
        curved: vec![Curved::default(); base.curved_sums.len()],
        transfer: base.transfer.points().to_vec(),
    };
    let (mut neumann, mut robin) = (arrays.neumann.clone(), arrays.robin.clone());
    let edges = &full.discretization.edges;
    let mut own_arrays = TickArrays::new(edges, arrays.vertices.len());
    let (mut progress, lengths) = (Progress::NONE, Lengths::of(full));
    let mut storage = stored(&lengths);
    let mut draw = Draw(21);
    for at in 0..ticks {
        let inputs = [(); 6].map(|()| R::of(draw.signed()));
        let inputs = &inputs[..full.patterns.len()];
        let [triangles, quads, contact_flux, gap, dirichlet] = &mut own.numbers;
        let [gap_ends, dirichlet_ends] = &mut own.ends;
        let data = DataMemory {
            triangles,
            quads,
            neumann: &mut neumann,
            robin: &mut robin,
            contact_flux,
            gap,
            gap_ends,
            dirichlet,
            dirichlet_ends,
            curved: &mut own.curved,
            transfer: &mut own.transfer,
            spans: &mut [],
        };
        let memory = of_full(own_arrays.memory(edges)?, data, &mut progress);
        let limits = Limits { share: R::of(0.0625), error: R::ZERO, sweeps: 10 + 30 * (at % 4) };
        let (report, outputs) = tick(full, inputs, at % 3 < 2, limits, memory)?;
        if at == 0 {
            for _ in 0..2 {
                storage.reset();
                let memory = storage.memory(full, &lengths)?;
                assert_eq!(tick(full, inputs, true, limits, memory)?, (report, outputs));
            }
            let kept = storage.numbers(&lengths).expect("its own lengths");
            let [load, vertices, bubbles, tau, u] = &own_arrays.numbers;
            assert_eq!([kept.load, kept.vertices, kept.tau, kept.u], [load, vertices, tau, u]);
            assert!(kept.bubbles.is_empty() || kept.bubbles == bubbles);
        }
        journal.line("tick", (report.ended, report.sweeps, report.active));
        journal.report(report);
        journal.line("outputs", outputs);
        journal.digest("data", (&own.numbers, &own.ends, &own.curved, &own.transfer));
        journal.digest("laws", (&neumann, &robin));
        journal.digest("numbers", &own_arrays.numbers);
    }
    Ok(())
}

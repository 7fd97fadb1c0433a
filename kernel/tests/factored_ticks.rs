//! Ticks on a factor: what sweeps find in the end, without sweeps; and sweeps where the factor is of no use.
#![allow(clippy::indexing_slicing, clippy::expect_used)]

mod plate;

use plate::Side;
use plate::foundation::{Foundation, GAP};
use signorini_kernel::condensed::Iterate;
use signorini_kernel::condensed::blocks::{Block, SIDE, count, padded};
use signorini_kernel::condensed::tableau::Start;
use signorini_kernel::csr::Csr;
use signorini_kernel::edges::EdgeCounts;
use signorini_kernel::rows::{QUADS, Row, Rows};
use signorini_kernel::sparse::direct::normalise;
use signorini_kernel::sparse::elimination::PatternBuffers;
use signorini_kernel::sparse::factor::FactorBuffers;
use signorini_kernel::sparse::{self, Exact, Factor, Factored, Pattern};
use signorini_kernel::tick::{Data, Deadline, Ended, Limits, Memory, Report, Running, Tick};
use signorini_kernel::{Error, Libm, Relaxation, assembly};

const SIDES: [Side; 4] = [Side::Contact, Side::Transfer, Side::Insulated, Side::Given];

/// L, D and S of the plate, unknowns in their own order.
struct Baked {
    counts: EdgeCounts,
    places: Vec<u16>,
    pointers: Vec<u32>,
    rows: Vec<u16>,
    values: Vec<f64>,
    inverse: Vec<f64>,
    schur: Vec<Block<f64>>,
    scale: Vec<f64>,
    none: Vec<bool>,
}

impl Baked {
    fn new(foundation: &Foundation) -> Result<Self, Error> {
        let (edges, boundary) = (foundation.plate.edges()?, foundation.boundary()?);
        let counts = edges.counts();
        let mut row_ptr = vec![0; counts.unknowns() + 1];
        let mut col_idx = vec![0; edges.nonzeros()];
        let mut entries = vec![0.0; edges.nonzeros()];
        assembly::pattern(&edges, &mut row_ptr, &mut col_idx)?;
        assembly::values(&edges, foundation.stiffness(), &boundary, &row_ptr, &mut entries)?;
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

    fn view(&self) -> Factored<'_, f64, u16> {
        let Self { counts, places, pointers, rows, values, inverse, schur, scale, none } = self;
        let factor = Factor::baked(places, pointers, rows, values, inverse, *counts);
        Factored { factor, schur, scale, start: Start { blocks: schur, exchanged: none } }
    }
}

/// A tick and what solves it.
type Both<'a> = (Tick<'a, f64, u16, QUADS>, Exact<'a, f64, u16>);

/// Memory of ticks, and of the exchanges.
struct Store {
    rows: Vec<Row<f64, u16, QUADS>>,
    active: Vec<bool>,
    numbers: [Vec<f64>; 5],
    tableau: Vec<Block<f64>>,
    flags: [Vec<bool>; 2],
    columns: [Vec<f64>; 6],
}

impl Store {
    fn new(foundation: &Foundation) -> Result<Self, Error> {
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

    fn of<'a>(
        &'a mut self,
        foundation: &'a Foundation,
        baked: &'a Baked,
    ) -> Result<Both<'a>, Error> {
        let ground = foundation.ground()?;
        let [load, vertices, bubbles, tau, u] = &mut self.numbers;
        let rows = Rows::new(&ground.edges, &mut self.rows)?;
        let memory = Memory { rows, load, active: &mut self.active, vertices, bubbles, tau, u };
        let ([exchanged, open], [column, next, load, x, residual, scratch]) =
            (&mut self.flags, &mut self.columns);
        let iterate = Iterate { x, residual, scratch, open };
        let tableau = &mut self.tableau;
        let contact = sparse::Memory { tableau, exchanged, columns: [column, next], load, iterate };
        let mut exact = Exact::new(baked.view(), contact)?;
        exact.restart()?;
        Ok((Tick::new(ground, memory, Relaxation::Adaptive(1.0))?, exact))
    }
}

/// Data whose source is multiplied, and whose gap bends along the contact.
struct Input {
    loads: (Vec<f64>, Vec<f64>),
    lower: Vec<f64>,
}

impl Input {
    fn new(foundation: &Foundation, source: f64, bend: f64) -> Self {
        let times = |loads: &[f64]| loads.iter().map(|load| load * source).collect();
        let bent = |(at, psi): (usize, &f64)| psi + bend * at as f64;
        Self {
            loads: (times(&foundation.loads.0), times(&foundation.loads.1)),
            lower: foundation.lower.iter().enumerate().map(bent).collect(),
        }
    }

    fn data<'a>(&'a self, foundation: &'a Foundation) -> Result<Data<'a, f64, u16>, Error> {
        let mut given = foundation.given()?;
        given.loads.triangles = &self.loads.0;
        given.loads.quads = &self.loads.1;
        Ok(Data { given, lower: &self.lower, dirichlet: &foundation.dirichlet })
    }
}

/// Until rounding is all that is left.
const TO_THE_END: Limits<f64> = Limits { error: 0.0, share: 1e-12, sweeps: 20_000 };
const NO_SWEEPS: Limits<f64> = Limits { error: 0.0, share: 0.01, sweeps: 0 };

/// Source and bend: much contact, none at all, some, much again.
const INPUTS: [(f64, f64); 5] = [(1.0, 0.0), (-4.0, -0.3), (1.0, 0.08), (1.0, 0.08), (3.0, -0.02)];

/// Ticks by `advance` and by sweeps to the end, with the same data.
fn beside_sweeps(
    advance: impl Fn(
        &mut Running<'_, '_, f64, u16, QUADS>,
        &mut Exact<f64, u16>,
    ) -> Result<Report<f64>, Error>,
    mut compare: impl FnMut(&Report<f64>, &Exact<f64, u16>, [&[f64]; 2], [&[f64]; 2]),
) -> Result<(), Error> {
    let foundation = Foundation::new(SIDES, false)?;
    let baked = Baked::new(&foundation)?;
    let (mut own, mut swept) = (Store::new(&foundation)?, Store::new(&foundation)?);
    let (mut tick, mut exact) = own.of(&foundation, &baked)?;
    let (mut reference, _) = swept.of(&foundation, &baked)?;
    let mut counts = Vec::new();
    for (source, bend) in INPUTS {
        let input = Input::new(&foundation, source, bend);
        let data = input.data(&foundation)?;
        let expected = reference.begin(data)?.advance(TO_THE_END, &mut Deadline::never())?;
        let report = advance(&mut tick.begin(data)?, &mut exact)?;
        assert_eq!((report.active, report.sweeps), (expected.active, 0), "{source} {bend}");
        assert_eq!(report.changes, expected.changes, "{source} {bend}");
        assert!(report.residual < 1e-14, "{report:?}");
        let free = foundation.plate.edges()?.counts().free;
        assert!(tick.u()[free..].iter().zip(&input.lower).all(|(u, lower)| u >= lower));
        compare(&report, &exact, [tick.u(), tick.tau()], [reference.u(), reference.tau()]);
        counts.push(report.active);
    }
    assert!(counts[1] < counts[0] && counts[1] < counts[2] && counts[2] == counts[3], "{counts:?}");
    Ok(())
}

fn off(found: &[f64], expected: &[f64]) -> f64 {
    let pairs = found.iter().zip(expected);
    pairs.fold(0.0, |most, (found, expected)| most.max((found - expected).abs()))
}

#[test]
fn a_factored_tick_is_where_sweeps_end() -> Result<(), Error> {
    let mut pivots = Vec::new();
    beside_sweeps(
        |running, exact| {
            running.advance_factored::<Libm, _>(exact, NO_SWEEPS, &mut Deadline::never())
        },
        |report, exact, [u, tau], [swept, swept_tau]| {
            assert_eq!(report.ended, Ended::Settled);
            assert!(off(u, swept) < 1e-12 && off(tau, swept_tau) < 1e-10);
            let certificate = report.verdict.certificate().expect("a bound");
            assert!(certificate.algebraic < 1e-12 && certificate.total > 1e-3, "{certificate:?}");
            let solved = exact.solved().expect("a solution");
            assert!((2..5).contains(&solved.rounds) && solved.change < 1e-14, "{solved:?}");
            pivots.push(solved.pivots);
        },
    )?;
    // Edges that stay on their side are not exchanged.
    assert!(pivots[3] == 0 && pivots[1] > 0 && pivots[2] > 0, "{pivots:?}");
    Ok(())
}

#[test]
fn without_a_bound_it_leaves_the_fluxes_of_the_solution() -> Result<(), Error> {
    beside_sweeps(
        |running, exact| {
            let never = &mut Deadline::never();
            running.advance_factored_uncertified::<Libm, _>(exact, NO_SWEEPS, never)
        },
        |report, _, [u, tau], [swept, swept_tau]| {
            assert_eq!(report.ended, Ended::Settled);
            assert!(report.verdict.certificate().is_none());
            // Both are balanced on the solution; the certificate's is so where it is not.
            assert!(off(u, swept) < 1e-12 && off(tau, swept_tau) < 1e-10);
        },
    )
}

#[test]
fn a_factor_of_another_matrix_leaves_it_to_sweeps() -> Result<(), Error> {
    let foundation = Foundation::new(SIDES, false)?;
    let input = Input::new(&foundation, 1.0, 0.02);
    let sound = Baked::new(&foundation)?;
    let mut store = Store::new(&foundation)?;
    let (mut tick, mut exact) = store.of(&foundation, &sound)?;
    let never = &mut Deadline::never();
    let data = input.data(&foundation)?;
    tick.begin(data)?.advance_factored::<Libm, _>(&mut exact, TO_THE_END, never)?;
    let expected = tick.u().to_vec();
    for (what, spoil) in [
        ("pivots", (|baked: &mut Baked| baked.inverse.fill(1e3)) as fn(&mut Baked)),
        ("entries", |baked| baked.values.fill(f64::NAN)),
        ("no entries", |baked| baked.values.clear()),
        ("S", |baked| baked.schur.as_flattened_mut().as_flattened_mut().fill(-1.0)),
        ("places", |baked| baked.places.fill(9999)),
        ("columns", |baked| baked.pointers.reverse()),
    ] {
        let mut baked = Baked::new(&foundation)?;
        spoil(&mut baked);
        for certified in [true, false] {
            let mut store = Store::new(&foundation)?;
            let (mut tick, mut exact) = store.of(&foundation, &baked)?;
            let never = &mut Deadline::never();
            let mut running = tick.begin(input.data(&foundation)?)?;
            let report = match certified {
                true => running.advance_factored::<Libm, _>(&mut exact, TO_THE_END, never)?,
                false => running
                    .advance_factored_uncertified::<Libm, _>(&mut exact, TO_THE_END, never)?,
            };
            assert!(report.sweeps > 0 && report.ended == Ended::Settled, "{what}: {report:?}");
            assert!(off(tick.u(), &expected) < 1e-10, "{what}: {}", off(tick.u(), &expected));
        }
    }
    Ok(())
}

#[test]
fn limits_and_deadlines_hold() -> Result<(), Error> {
    let foundation = Foundation::new(SIDES, false)?;
    let (baked, input) = (Baked::new(&foundation)?, Input::new(&foundation, 1.0, 0.0));
    let mut store = Store::new(&foundation)?;
    let (mut tick, mut exact) = store.of(&foundation, &baked)?;
    let mut running = tick.begin(input.data(&foundation)?)?;
    let short = &mut Deadline { remaining: || 9, sweep: 7, certificate: 3 };
    let report = running.advance_factored::<Libm, _>(&mut exact, TO_THE_END, short)?;
    assert_eq!((report.ended, report.sweeps), (Ended::OutOfTime, 0));
    assert!(report.residual > 1e-3 && exact.solved().is_none());
    // The rest of the tick: enough time for a solve, and a bound that is small enough.
    let enough = &mut Deadline { remaining: || 10, sweep: 7, certificate: 3 };
    let generous = Limits { error: 1e3, ..TO_THE_END };
    let report = running.advance_factored::<Libm, _>(&mut exact, generous, enough)?;
    assert_eq!((report.ended, report.sweeps), (Ended::Accurate, 0));
    assert!(report.residual < 1e-14 && exact.solved().is_some());
    let contact = foundation.plate.edges()?.counts().free;
    assert!(tick.u()[contact..].contains(&GAP));
    exact.restart()?;
    assert!(exact.solved().is_none());
    Ok(())
}

//! An admissible flux from any iterate, converged or not, and who is told that there is none.

use crate::numbering::{NONE, SIDES, Side};
use crate::owned::Packed;
use crate::plate::{free_edges, plate};
use signorini_bound::averages;
use signorini_bound::cells::Either;
use signorini_bound::equilibrium::{Iterate, impose, pulled, walk};
use signorini_bound::forest::Forest;
use signorini_kernel::assembly::CellLoads;
use signorini_kernel::error::Array;
use signorini_kernel::law::Law;
use signorini_kernel::mesh::boundary::{Boundary, Neumann, Robin};
use signorini_kernel::mesh::diagonal::DiagonalTerms;
use signorini_kernel::mesh::edges::{Block, Edges};
use signorini_kernel::rows::{QUADS, Row, Rows};
use signorini_kernel::stiffness::{self, Coefficient, Stiffness};
use signorini_kernel::{Error, Tensor, assembly, psor};
use signorini_tolerances::kernel::BALANCE;

/// The remains of a run.
struct Run {
    /// A contact edge that is pulled at.
    pulled: Option<usize>,
    /// Largest |Σ τ + ∫f| of a cell.
    defect: f64,
    /// Flux through the free boundary edges with a given flux, minus that flux.
    given: f64,
    /// Smallest τ − q on contact edges, and largest |τ − q| where open.
    contact: [f64; 2],
}

/// Sweeps `sweeps` times from zero and equilibrates; `load` is f.
fn run(sides: [Side; 4], load: f64, sweeps: usize) -> Result<Run, Error> {
    let topology = plate(sides)?;
    let (mesh, edges, counts) = (topology.mesh()?, topology.edges()?, topology.counts);
    let given = |edge| Neumann { edge, flux: 0.01 * f64::from(edge) };
    let law = |edge| Robin { edge, coefficient: 0.5, ambient: 1.0 };
    let on = |side| free_edges(&topology, sides, side);
    let neumann: Vec<_> = on(Side::Insulated)?.into_iter().map(given).collect();
    let robin: Vec<_> = on(Side::Transfer)?.into_iter().map(law).collect();
    let (q, gap) = (vec![-0.3; counts.contact], vec![-0.5; counts.contact]);
    let boundary = Boundary::new(&edges, &neumann, &robin, &q)?;

    // A jump of 10⁴ between neighbours.
    let alpha = |cell: usize| if cell.is_multiple_of(3) { 1e4 } else { 1.0 };
    let tensors: Vec<_> = (0..edges.cells()).map(|cell| Tensor::scalar(alpha(cell))).collect();
    let mut k = (vec![[0.0; 3]; topology.triangles.len()], vec![[0.0; 6]; topology.quads.len()]);
    stiffness::fill(&mesh, Coefficient::PerCell(&tensors), 2, &mut k.0, &mut k.1)?;
    let stiffness = Stiffness { triangles: &k.0, quads: &k.1 };
    let sources = (vec![load / 2.0; k.0.len()], vec![load; k.1.len()]);
    let loads = CellLoads { triangles: &sources.0, quads: &sources.1 };
    let mut b = vec![0.0; counts.unknowns()];
    assembly::load(&edges, loads, &boundary, &mut b)?;
    let mut memory = vec![Row::<f64, u16, QUADS>::EMPTY; counts.unknowns()];
    let mut rows = Rows::new(&edges, &mut memory)?;
    rows.gather(&edges, stiffness, DiagonalTerms::new(&boundary), &b, 1.5)?;
    let mut u = vec![0.0; counts.edges()];
    for _ in 0..sweeps {
        psor::sweep(&rows, Law::above(&gap), &mut u)?;
    }

    let roots = |edge: usize| match counts.block(edge) {
        Block::Dirichlet => true,
        Block::Free => robin.iter().any(|record| usize::from(record.edge) == edge),
        Block::Contact => {
            sides.iter().all(|&side| side == Side::Contact || side == Side::Insulated)
        }
    };
    let alphas: Vec<_> = (0..edges.cells()).map(alpha).collect();
    let compliance = vec![0.25; k.0.len()];
    let a = [&alphas[..], &compliance];
    let packed = Packed::new((&mesh, &edges), stiffness, a, |cell| 1.0 / alpha(cell), roots)?;
    let (mut tau, mut s) = (vec![f64::NAN; counts.edges()], vec![f64::NAN; mesh.vertices().len()]);
    let cells = packed.cells(&edges)?;
    assert!(!cells.is_empty());
    averages::fill(&cells, (loads, None), &[], &u, &mut s, &mut tau)?;
    impose(&edges, &boundary, Iterate { u: &u, law: Law::above(&gap) }, &mut tau);
    walk(&cells, loads, &mut tau);

    let defects = cells.from_leaves().map(|cell| match cell {
        Either::Triangle(cell) => {
            cell.outward(&tau).expect("a cell").iter().sum::<f64>() + load / 2.0
        }
        Either::Quad(cell) => cell.outward(&tau).expect("a cell").iter().sum::<f64>() + load,
    });
    let defect = defects.map(f64::abs).fold(0.0, f64::max);
    let given = neumann.iter().map(|n| (tau[usize::from(n.edge)] - n.flux).abs());
    let pressures: Vec<_> = tau[counts.free..counts.unknowns()].iter().map(|t| t + 0.3).collect();
    let open = pressures.iter().enumerate().filter(|(c, _)| u[counts.free + c] > -0.5);
    Ok(Run {
        pulled: pulled(&edges, &boundary, &tau),
        defect,
        given: given.fold(0.0, f64::max),
        contact: [
            pressures.iter().copied().fold(f64::INFINITY, f64::min),
            open.map(|(_, pressure)| pressure.abs()).fold(0.0, f64::max),
        ],
    })
}

#[test]
fn any_iterate_becomes_admissible() {
    for load in [-0.4, 0.0, 0.7] {
        for sweeps in [0, 1, 3, 10, 100, 1000] {
            let run = run(SIDES, load, sweeps).expect("roots on two sides");
            let what = format!("f = {load} after {sweeps} sweeps");
            assert_eq!(run.pulled, None, "{what}");
            BALANCE.check(&what, run.defect);
            assert_eq!(run.given, 0.0, "{what}");
            assert!(run.contact[0] >= 0.0 && run.contact[1] == 0.0, "{what}: {:?}", run.contact);
        }
    }
}

#[test]
fn contact_alone_takes_what_pushes_and_refuses_what_pulls() {
    let sides = [Side::Contact, Side::Insulated, Side::Insulated, Side::Insulated];
    let pushed = run(sides, -0.4, 500).expect("contact edges are roots");
    assert_eq!(pushed.pulled, None);
    assert!(pushed.given == 0.0 && pushed.contact[0] >= 0.0);
    BALANCE.check("pushed", pushed.defect);
    let pulled = run(sides, 0.7, 5).expect("contact edges are roots");
    assert!(pulled.pulled.is_some());
}

#[test]
fn a_part_without_a_way_out_is_named() {
    assert!(matches!(run([Side::Insulated; 4], 0.0, 1), Err(Error::NoWayOut { .. })));
}

#[test]
fn forests_that_are_none_are_refused() {
    // Two triangles of a square; side 0 of the first is a root, side 2 of it leads to the second.
    let counts = signorini_kernel::mesh::edges::EdgeCounts { free: 1, contact: 0, dirichlet: 4 };
    let halves = [[2, 3], [0, NONE], [1, NONE], [4, NONE], [5, NONE]];
    let edges = Edges::<u16>::new(&[[1, 2, 0], [0, 3, 4]], &[], &halves, counts).expect("a square");
    let refused = |order: [u16; 2], parent: [u16; 2], place: [u16; 2]| {
        Forest::new(&edges, &order, &parent, &place).err()
    };
    let wrong = |at| Some(Error::OutOfRange { of: Array::Scratch, at });
    assert_eq!(refused([0, 1], [0, 3], [0, 1]), None);
    assert_eq!(refused([1, 0], [0, 3], [1, 0]), wrong(1), "the leaf before its root");
    assert_eq!(refused([0, 0], [0, 3], [0, 1]), wrong(1), "a cell twice");
    assert_eq!(refused([0, 1], [0, 2], [0, 1]), wrong(1), "the side of another cell");
    assert_eq!(refused([0, 1], [2, 3], [0, 1]), wrong(0), "in a circle");
    assert_eq!(refused([0, 1], [0, 9], [0, 1]), wrong(1), "no side");
    let short = Forest::new(&edges, &[0], &[0], &[0]).err();
    assert_eq!(short, Some(Error::Length { of: Array::Scratch, found: 1, expected: 2 }));
}

//! The kernel's public constructors: arrays of any lengths, indices and bits.

use signorini_bound::forest::Forest;
use signorini_device::condition::Condition;
use signorini_device::tick::Progress;
use signorini_device::workspace;
use signorini_kernel::csr::Csr;
use signorini_kernel::law::Law;
use signorini_kernel::mesh::Mesh;
use signorini_kernel::mesh::boundary::Boundary;
use signorini_kernel::mesh::diagonal::DiagonalTerms;
use signorini_kernel::mesh::edges::{EdgeCounts, Edges};
use signorini_kernel::relaxation::Relaxation;
use signorini_kernel::rows::{Row, Rows};
use signorini_kernel::solver::{Settings, Status};
use signorini_kernel::stiffness::Coefficient;
use signorini_kernel::system::System;
use signorini_kernel::{Error, Libm, Tensor};
use signorini_solve::prolongation::{Origin, prolong};

use super::bytes::{Bits, Bytes};
use super::numbering::{NONE, NumberedMesh};
use super::{condensed, plate, stages};

/// The first byte chooses a constructor and the scalar; the rest fills arrays.
pub fn constructors(data: &[u8]) {
    let mut bytes = Bytes::new(data);
    let which = bytes.byte();
    // A refusal is as good as an answer.
    let _ = if which & 0x80 == 0 {
        construct::<f32>(which & 0x7f, &mut bytes)
    } else {
        construct::<f64>(which & 0x7f, &mut bytes)
    };
}

fn construct<R: Bits>(which: u8, bytes: &mut Bytes) -> Result<(), Error> {
    match which % 8 {
        0 => of_mesh::<R>(bytes),
        1 => of_numbering::<R>(bytes, true),
        2 => of_numbering::<R>(bytes, false),
        3 => of_matrix::<R>(bytes),
        4 => in_a_workspace::<R>(bytes),
        5 => small_ones::<R>(bytes),
        6 => condensed::of_any_arrays::<R>(bytes),
        _ => ways_out::<R>(bytes),
    }
}

/// Any mesh that the kernel takes, on its own numbering.
fn of_mesh<R: Bits>(bytes: &mut Bytes) -> Result<(), Error> {
    let plate: NumberedMesh<R> =
        if bytes.flag() { plate::arbitrary(bytes)? } else { plate::grid(bytes, true)? };
    let (mesh, edges) = (plate.mesh()?, plate.edges()?);
    let matrices = stages::filled(bytes, &mesh)?;
    stages::all(bytes, &mesh, &edges, matrices)
}

/// Arrays of a numbering: edges of each side, half-edges of each edge.
struct Numbering {
    of_triangles: Vec<[u16; 3]>,
    of_quads: Vec<[u16; 4]>,
    half_edges: Vec<[u16; 2]>,
    counts: EdgeCounts,
}

impl Numbering {
    /// Sides joined at random, whether or not a mesh in the plane could be so.
    fn joined(bytes: &mut Bytes) -> Self {
        let (t, q) = (bytes.below(7), bytes.below(5));
        let (mut of_triangles, mut of_quads) = (vec![[NONE; 3]; t], vec![[NONE; 4]; q]);
        let mut half_edges: Vec<[u16; 2]> = Vec::new();
        let sides = of_triangles.as_flattened_mut().iter_mut();
        for (half, side) in (0..).zip(sides.chain(of_quads.as_flattened_mut())) {
            let open = half_edges.iter().position(|pair| pair[1] == NONE);
            match open.filter(|_| bytes.below(4) > 0) {
                Some(edge) => {
                    half_edges[edge][1] = half;
                    *side = edge as u16;
                }
                None => {
                    *side = half_edges.len() as u16;
                    half_edges.push([half, NONE]);
                }
            }
        }
        let free = bytes.below(half_edges.len() + 1);
        let contact = bytes.below(half_edges.len() + 1 - free);
        let dirichlet = half_edges.len() - free - contact;
        let counts = EdgeCounts { free, contact, dirichlet };
        Self { of_triangles, of_quads, half_edges, counts }
    }

    /// A copy with some entries and counts of any bits.
    fn damaged(mut self, bytes: &mut Bytes) -> Self {
        for _ in 0..bytes.below(4) {
            let entry = bytes.bits() as u16;
            let place = match bytes.below(3) {
                0 => self.of_triangles.as_flattened_mut(),
                1 => self.of_quads.as_flattened_mut(),
                _ => self.half_edges.as_flattened_mut(),
            };
            let at = bytes.below(place.len());
            place.iter_mut().skip(at).take(1).for_each(|place| *place = entry);
        }
        if bytes.flag() {
            let [free, contact, dirichlet] = [(); 3].map(|()| usize::from(bytes.byte()));
            self.counts = EdgeCounts { free, contact, dirichlet };
        }
        self
    }
}

/// Vertices and corners of any bits for a numbering.
type Corners<R> = (Vec<[R; 2]>, Vec<[u16; 3]>, Vec<[u16; 4]>);

fn corners<R: Bits>(bytes: &mut Bytes, numbering: &Numbering) -> Corners<R> {
    let vertices = bytes.below(9);
    let mut corner = || match bytes.byte() {
        255 => NONE,
        byte => u16::from(byte) % (vertices as u16 + 1),
    };
    let triangles = numbering.of_triangles.iter().map(|_| [(); 3].map(|()| corner())).collect();
    let quads = numbering.of_quads.iter().map(|_| [(); 4].map(|()| corner())).collect();
    (bytes.groups(vertices), triangles, quads)
}

/// A numbering that [`Edges::new`] takes, or one that nobody has checked, with corners that nobody has checked either: wrong
/// answers and nothing worse.
fn of_numbering<R: Bits>(bytes: &mut Bytes, is_checked: bool) -> Result<(), Error> {
    let numbering = Numbering::joined(bytes).damaged(bytes);
    let Numbering { of_triangles, of_quads, half_edges, counts } = &numbering;
    let edges = match is_checked {
        true => Edges::new(of_triangles, of_quads, half_edges, *counts)?,
        false => Edges::baked(of_triangles, of_quads, half_edges, *counts),
    };
    let (vertices, triangles, quads) = corners(bytes, &numbering);
    let mesh = Mesh::<R, u16>::baked(&vertices, &triangles, &quads);
    let matrices = (bytes.groups(triangles.len()), bytes.groups(quads.len()));
    stages::all(bytes, &mesh, &edges, matrices)
}

/// Any rows, swept if they are taken.
fn of_matrix<R: Bits>(bytes: &mut Bytes) -> Result<(), Error> {
    let (rows, columns) = (bytes.below(8), bytes.below(12));
    let (mut row_ptr, mut col_idx) = (vec![0], Vec::new());
    for row in 0..rows {
        col_idx.push(row as u16);
        col_idx.extend((0..bytes.below(5)).map(|_| u16::from(bytes.byte()) % (columns as u16 + 1)));
        row_ptr.push(col_idx.len() as u32);
    }
    if bytes.below(8) == 0 {
        let at = bytes.below(row_ptr.len());
        row_ptr[at] = bytes.bits() as u32;
    }
    let values: Vec<R> = bytes.reals(col_idx.len());
    let matrix = Csr::new(&row_ptr, &col_idx, &values, columns)?;
    let contact = bytes.below(rows + 1);
    let counts =
        EdgeCounts { free: rows - contact, contact, dirichlet: columns.saturating_sub(rows) };
    let (load, lower) = (bytes.reals(rows), bytes.reals(contact));
    let system = System::new(matrix, &load, Law::above(&lower), counts)?;
    let mut memory = vec![Row::<R, u16, 4>::EMPTY; rows];
    let packed = Rows::of_matrix(&matrix, counts, &mut memory)?;
    let apart = Edges::baked(&[], &[], &[], counts);
    let nothing = Boundary::new(&apart, &[], &[], &[])?;
    stages::iterated(bytes, &system, DiagonalTerms::new(&nothing), packed).map(drop)
}

/// The short way through the layers, with data set anew.
fn in_a_workspace<R: Bits>(bytes: &mut Bytes) -> Result<(), Error> {
    let plate = plate::arbitrary::<R>(bytes)?;
    let mesh = plate.mesh()?;
    let mut workspace = <workspace!(R, u16: vertices 10, triangles 8, quads 6, boundary 24)>::new();
    let tensor = Tensor { xx: bytes.real(), xy: bytes.real(), yy: bytes.real() };
    let kinds: Vec<u8> = (0..48).map(|_| bytes.byte()).collect();
    let numbers: Vec<R> = bytes.reals(16);
    let condition = |ends: [u16; 2]| {
        let at = usize::from(ends[0]) * 5 + usize::from(ends[1]);
        let [a, b] = [at, at + 3].map(|at| numbers[at % 16]);
        Some(match kinds[at % 48] % 8 {
            0..=2 => Condition::Dirichlet { value: a },
            3..=4 => Condition::Contact { gap: a, flux: b },
            5 => Condition::Neumann { flux: a },
            6 => Condition::Robin { coefficient: a, ambient: b },
            _ => return None,
        })
    };
    workspace.build(&mesh, Coefficient::Uniform(tensor), |edge| condition(edge.vertices))?;
    let (t, q) = (mesh.triangles().len(), mesh.quads().len());
    workspace.set_source(&bytes.reals(t), &bytes.reals(q))?;
    let settings = Settings { max_sweeps: bytes.below(100) as u32, ..Settings::default() };
    let outcome = workspace.solve(settings)?;
    if outcome.status != Status::NotFinite {
        assert!(workspace.u().iter().all(|u| u.finite()), "{outcome:?}");
    }
    workspace.contact_length::<Libm>(&mesh).map(drop)
}

/// Constructors that take a few numbers.
fn small_ones<R: Bits>(bytes: &mut Bytes) -> Result<(), Error> {
    let tensor = Tensor { xx: bytes.real::<R>(), xy: bytes.real(), yy: bytes.real() };
    if tensor.is_positive_definite() {
        let entries = [tensor.xx, tensor.xy, tensor.yy];
        assert!(entries.iter().all(|entry| entry.finite()), "{tensor:?}");
    }
    let omega = bytes.real::<R>();
    for relaxation in [Relaxation::Fixed(omega), Relaxation::Adaptive(omega)] {
        let inside = omega > R::ZERO && omega < R::TWO;
        let refused = Progress::new(relaxation).err();
        assert!(inside || refused == Some(Error::Relaxation), "{relaxation:?}: {refused:?}");
    }
    let coarse: Vec<R> = bytes.reals(bytes.clone().below(9));
    let origin = |bytes: &mut Bytes| Origin {
        edges: [(); 4].map(|()| u16::from(bytes.byte() % 10)),
        weights: [(); 4].map(|()| bytes.real()),
    };
    let origins: Vec<_> = (0..bytes.below(9)).map(|_| origin(bytes)).collect();
    prolong(&origins, &coarse, &mut vec![R::ZERO; bytes.below(10)])
}

/// Orders and parents of any bits for a grid.
fn ways_out<R: Bits>(bytes: &mut Bytes) -> Result<(), Error> {
    let plate = plate::grid::<R>(bytes, false)?;
    let edges = plate.edges()?;
    Boundary::<R, u16>::new(&edges, &[], &[], &bytes.reals(edges.counts().contact))?;
    let cells = edges.cells();
    let mut any = || -> Vec<u16> {
        let count = if bytes.below(16) == 0 { bytes.below(12) } else { cells };
        (0..count).map(|_| u16::from(bytes.byte()) % 48).collect()
    };
    let (order, parent, place) = (any(), any(), any());
    let forest = Forest::new(&edges, &order, &parent, &place)?;
    assert_eq!(forest.from_leaves().count(), cells);
    Ok(())
}

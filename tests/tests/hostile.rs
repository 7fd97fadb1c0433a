//! Arbitrary bytes: what fuzzing has found and collected, replayed, and some that nobody has chosen; and cells
//! that are hardly any, against the naive twin.

use signorini_tolerances::twins::SLENDER;
use std::fs;
use std::path::{Path, PathBuf};

use signorini_kernel::mesh::Mesh;
use signorini_kernel::stiffness::{self, Coefficient};
use signorini_kernel::{Error, Tensor};
use signorini_tests::cell::Cell;
use signorini_tests::element::Element;
use signorini_tests::hostile::{constructors, expression, mesh, scene, tick};
use signorini_tests::random::Random;

type Entry = fn(&[u8]);

const ENTRIES: [(&str, Entry); 5] = [
    ("mesh", mesh),
    ("scene", scene),
    ("expression", expression),
    ("constructors", constructors),
    ("tick", tick),
];

/// The files in a folder of `tests/fuzz`, in the order of their names.
fn files(folder: &str, target: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz").join(folder).join(target);
    let entries = fs::read_dir(folder).into_iter().flatten();
    let mut files: Vec<_> = entries.map(|entry| entry.expect("an entry").path()).collect();
    files.sort();
    files
}

/// Replays the files of a folder, of which there are at least so many for each target.
fn replay(folder: &str, least: usize) {
    for (target, entry) in ENTRIES {
        let files = files(folder, target);
        assert!(files.len() >= least, "{target}: {} files", files.len());
        for file in files {
            println!("{}", file.display());
            entry(&fs::read(&file).expect("a file"));
        }
    }
}

#[test]
fn what_fuzzing_has_found_stays_mended() {
    replay("found", 0);
}

#[test]
fn corpora_are_replayed() {
    replay("corpus", 20);
}

#[test]
fn bytes_that_nobody_has_chosen() {
    let random = &mut Random::new(9);
    for (target, entry) in ENTRIES {
        for _ in 0..RUNS {
            let length = random.below(400);
            let data: Vec<_> = (0..length).map(|_| random.bits() as u8).collect();
            println!("{target}: {data:?}");
            entry(&data);
        }
    }
}

/// A test of the functions themselves: libFuzzer chooses better.
const RUNS: u32 = 500;

/// Corners in a box that is 10^−9 … 1 times as high as wide, turned and moved; `None` unless counterclockwise
/// and strictly convex by far more than rounding.
fn flat<const N: usize>(random: &mut Random) -> Option<[[f64; 2]; N]> {
    let height = 10f64.powf(random.between(-9.0, 0.0));
    let unit = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let moved: [[f64; 2]; N] =
        std::array::from_fn(|k| unit[k].map(|x| x + random.between(-0.4, 0.4)));
    let turn = |k: usize| {
        let [a, b, c] = [0, 1, 2].map(|step| moved[(k + step) % N]);
        (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0])
    };
    let (sin, cos) = random.between(0.0, 6.0).sin_cos();
    let turned = moved.map(|[x, y]| [cos * x - sin * height * y, sin * x + cos * height * y]);
    (0..N).all(|k| turn(k) > 1e-3).then_some(turned)
}

/// Longest side squared over twice the area: what differences of corners lose.
fn slenderness(cell: &Cell) -> f64 {
    let longest = (0..cell.corners.len()).map(|k| cell.edge_length(k)).fold(0.0, f64::max);
    longest * longest / (2.0 * cell.integrate(4, |_| 1.0))
}

/// Element matrix of the kernel, or why not.
fn of_kernel<const N: usize>(corners: &[[f64; 2]; N]) -> Result<Vec<f64>, Error> {
    let (triangles, quads) = match N {
        3 => (vec![[0_u16, 1, 2]], vec![]),
        _ => (vec![], vec![[0_u16, 1, 2, 3]]),
    };
    let mesh = Mesh::new(corners, &triangles, &quads)?;
    let mut k = (vec![[0.0; 3]; triangles.len()], vec![[0.0; 6]; quads.len()]);
    stiffness::fill(&mesh, Coefficient::Uniform(A), 8, &mut k.0, &mut k.1)?;
    Ok([k.0.as_flattened(), k.1.as_flattened()].concat())
}

const A: Tensor<f64> = Tensor { xx: 3.0, xy: -1.2, yy: 1.5 };

/// Compares some thousand cells; returns how many there were and the largest slenderness.
fn compared<const N: usize>(pairs: &[[usize; 2]], seed: u64) -> (u32, f64) {
    let (random, mut cells, mut worst) = (&mut Random::new(seed), 0, 0.0_f64);
    for _ in 0..4000 {
        let Some(corners) = flat::<N>(random) else { continue };
        let cell = Cell { corners: corners.to_vec() };
        let slender = slenderness(&cell);
        let twin = Element::new(cell).stiffness(|_| [A.xx, A.xy, A.yy], 8);
        let found = of_kernel(&corners).unwrap_or_else(|error| panic!("{error}: {corners:?}"));
        let largest = twin.iter().flatten().fold(0.0, |most: f64, entry| most.max(entry.abs()));
        for (&[i, j], entry) in pairs.iter().zip(&found) {
            let what = format_args!("{i}{j} at {slender:e}, {corners:?}");
            SLENDER.check_over(what, entry - twin[i][j], largest * slender);
        }
        (cells, worst) = (cells + 1, worst.max(slender));
    }
    (cells, worst)
}

#[test]
fn needles_have_the_element_matrices_of_the_twin() {
    let triangles = compared::<3>(&[[0, 1], [1, 2], [2, 0]], 1);
    let quads = compared::<4>(&[[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]], 2);
    for (cells, slenderest) in [triangles, quads] {
        assert!(cells > 1000 && slenderest > 1e8, "{cells} {slenderest:e}");
    }
}

#[test]
fn a_cell_without_area_is_refused_whatever_its_place() {
    let random = &mut Random::new(3);
    for _ in 0..1000 {
        let at = |random: &mut Random| [random.between(-9.0, 9.0), random.between(-9.0, 9.0)];
        let (a, b) = (at(random), at(random));
        let on_the_way = |t: f64| [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])];
        let middle = on_the_way(random.between(0.1, 0.9));
        match of_kernel(&[a, middle, b]) {
            Err(_) => {}
            // Rounding may leave a sliver: then its matrix is finite.
            Ok(k) => assert!(k.iter().all(|entry| entry.is_finite()), "{a:?} {b:?} {k:?}"),
        }
    }
}

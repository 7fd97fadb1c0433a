//! Matrices, aggregates, levels and the preconditioner against dense arithmetic.

use signorini_tolerances::solve::{IN_SINGLE, MULTIGRID_MATRIX};

use super::{Random, Square, vector};
use crate::aggregation::{NONE, Strength, aggregates};
use crate::coarsest::Coarsest;
use crate::conjugate::Conjugate;
use crate::edges::Edges;
use crate::hierarchy::Hierarchy;
use crate::lines::Lines;
use crate::prolongation::smoothed;
use crate::sparse::Sparse;
use crate::vertex_matrix::{Numbering, galerkin};

fn dense(matrix: &Sparse) -> Vec<Vec<f64>> {
    let mut rows = vec![vec![0.0; matrix.columns]; matrix.rows()];
    for (at, row) in rows.iter_mut().enumerate() {
        matrix.row(at).iter().for_each(|&(column, value)| row[column as usize] += value);
    }
    rows
}

fn product(a: &[Vec<f64>], b: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let entry = |row: &[f64], column: usize| row.iter().zip(b).map(|(x, b)| x * b[column]).sum();
    a.iter().map(|row| (0..b[0].len()).map(|column| entry(row, column)).collect()).collect()
}

fn transposed(a: &[Vec<f64>]) -> Vec<Vec<f64>> {
    (0..a[0].len()).map(|column| a.iter().map(|row| row[column]).collect()).collect()
}

fn check(what: &str, found: &[Vec<f64>], expected: &[Vec<f64>]) {
    for (found, expected) in found.iter().zip(expected) {
        MULTIGRID_MATRIX.check_each(what, found, expected);
    }
}

#[test]
fn the_vertex_matrix_is_that_of_means_over_edges() {
    vertex_matrix_is_product(&Square::new(5, 3.0, true, |_, _| 1.0), 6 * 5);
}

/// Opposite sides of a quad have no vertex in common.
#[test]
fn opposite_sides_of_a_quad_are_coupled() {
    let mut square = Square::new(1, 1.0, false, |_, _| 1.0);
    square.ends = vec![[0, 1], [1, 2], [2, 3], [3, 0]];
    square.row_ptr = vec![0, 4, 8, 12, 16];
    square.col_idx = (0..4).flat_map(|row| (0..4).map(move |k| (row + k) % 4)).collect();
    square.values = [
        [7.0, -1.0, -3.0, -2.0],
        [8.0, -2.5, -1.5, -1.0],
        [9.0, -4.0, -3.0, -2.5],
        [10.0, -2.0, -1.5, -4.0],
    ]
    .concat();
    square.load = vec![0.0; 4];
    square.lower = Vec::new();
    square.floating = Vec::new();
    vertex_matrix_is_product(&square, 4);
}

fn vertex_matrix_is_product(square: &Square, count: usize) {
    let problem = square.problem();
    let numbering = Numbering::of(&problem);
    assert_eq!(numbering.count, count);
    let n = square.load.len();
    let mut means = vec![vec![0.0; numbering.count]; n];
    for (row, ends) in means.iter_mut().zip(&numbering.ends) {
        ends.iter()
            .filter(|&&end| (end as usize) < numbering.count)
            .for_each(|&end| row[end as usize] += 0.5);
    }
    let mut stiffness = vec![vec![0.0; n]; n];
    for (at, row) in stiffness.iter_mut().enumerate() {
        problem.contact.row(at).for_each(|(column, value)| row[column] = 2.0 * value);
    }
    let expected = product(&transposed(&means), &product(&stiffness, &means));
    let found = galerkin(&problem, &numbering, 2.0);
    check("PᵀKP", &dense(&found), &expected);
}

#[test]
fn products_and_transposes_are_those_of_dense_matrices() {
    let mut random = Random::new(5);
    let mut sparse = |rows: usize, columns: usize| {
        let mut matrix = Sparse::with_columns(columns);
        for _ in 0..rows {
            for column in 0..columns as u32 {
                let value = random.between(-1.0, 1.0);
                if value > 0.3 {
                    matrix.entries.push((column, value));
                }
            }
            matrix.end_row();
        }
        matrix
    };
    let (a, b) = (sparse(7, 9), sparse(9, 4));
    check("AB", &dense(&a.times(&b)), &product(&dense(&a), &dense(&b)));
    check("Aᵀ", &dense(&a.transposed()), &transposed(&dense(&a)));
}

fn vertex_matrix(n: u32, a: f64) -> Sparse {
    let square = Square::new(n, a, true, |_, _| 1.0);
    let problem = square.problem();
    galerkin(&problem, &Numbering::of(&problem), 1.0)
}

/// Across strong couplings, never along weak ones.
#[test]
fn aggregates_follow_strong_couplings() {
    let matrix = vertex_matrix(12, 1e4);
    let diagonal = matrix.diagonal();
    let (of, count) = aggregates(&Strength::new(&matrix, &diagonal, 0.08));
    assert!(of.iter().all(|&aggregate| (aggregate as usize) < count && aggregate != NONE));
    let mut members = vec![Vec::new(); count];
    of.iter().enumerate().for_each(|(at, &aggregate)| members[aggregate as usize].push(at));
    assert!(members.iter().all(|members| (2..=5).contains(&members.len())), "{members:?}");
    // Vertices that follow each other in a row of the mesh are strongly coupled.
    let is_strong = |pair: &[usize]| {
        matrix
            .row(pair[0])
            .iter()
            .any(|&(column, value)| column as usize == pair[1] && value < -1e3)
    };
    assert!(members.iter().flat_map(|members| members.windows(2)).any(is_strong));
}

/// Where constants are in the kernel, P keeps them.
#[test]
fn prolongations_keep_constants() {
    let matrix = vertex_matrix(12, 1.0);
    let prolongation = smoothed(&matrix, &matrix.diagonal(), 0.08);
    let held = |row: usize| matrix.row(row).iter().map(|entry| entry.1).sum::<f64>() > 1e-9;
    for row in (0..matrix.rows()).filter(|&row| !held(row)) {
        let sum: f64 = prolongation.row(row).iter().map(|entry| entry.1).sum();
        MULTIGRID_MATRIX.check(row, sum - 1.0);
    }
    assert!(prolongation.columns * 4 < matrix.rows());
}

#[test]
fn the_dense_factor_solves_and_holds() {
    let matrix = vertex_matrix(6, 1.0);
    let mut coarsest = Coarsest::new(&matrix);
    coarsest.hold(&[3, 11]);
    let load: Vec<f32> =
        vector(&mut Random::new(2), matrix.rows()).iter().map(|&x| x as f32).collect();
    let mut x = load.clone();
    coarsest.solve(&mut x);
    assert_eq!([x[3], x[11]], [0.0; 2]);
    for row in (0..matrix.rows()).filter(|row| ![3, 11].contains(row)) {
        let own =
            matrix.row(row).iter().map(|&(column, value)| value * f64::from(x[column as usize]));
        IN_SINGLE.check(row, own.sum::<f64>() - f64::from(load[row]));
    }
}

/// M x of a hierarchy.
fn cycled(hierarchy: &mut Hierarchy, x: &[f64]) -> Vec<f64> {
    let load = hierarchy.load();
    load[..x.len()].iter_mut().zip(x).for_each(|(load, &x)| *load = x as f32);
    hierarchy.cycle()[..x.len()].iter().map(|&z| f64::from(z)).collect()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// A hierarchy whose vertices were held and let go is the one that it was; held, it is as good as one made without them.
#[test]
fn a_hierarchy_follows_what_is_held() {
    let matrix = vertex_matrix(40, 1.0);
    let n = matrix.rows();
    let mut random = Random::new(7);
    let [x, y] = [vector(&mut random, n), vector(&mut random, n)];
    let mut hierarchy = Hierarchy::new(matrix.clone());
    let before = cycled(&mut hierarchy, &x);
    let held: Vec<u32> =
        (0..n as u32).filter(|at| at % 97 == 0 || (400..440).contains(at)).collect();
    hierarchy.hold(&held);
    let [of_x, of_y] = [cycled(&mut hierarchy, &x), cycled(&mut hierarchy, &y)];
    assert!(held.iter().all(|&at| of_x[at as usize] == 0.0));
    IN_SINGLE.check_over("symmetry", dot(&x, &of_y) - dot(&y, &of_x), dot(&x, &of_x));
    let rate = worst_rate(&mut hierarchy, &matrix, &held);
    assert!(rate < 0.5, "{rate}");
    hierarchy.hold(&[]);
    let after = cycled(&mut hierarchy, &x);
    let size = before.iter().fold(0.0, |most: f64, z| most.max(z.abs()));
    for (after, before) in after.iter().zip(&before) {
        IN_SINGLE.check_over("let go", after - before, size);
    }
}

/// How an error falls by a W-cycle, after many.
fn worst_rate(hierarchy: &mut Hierarchy, matrix: &Sparse, held: &[u32]) -> f64 {
    let n = matrix.rows();
    let mut error = vector(&mut Random::new(3), n);
    let mut rate = 0.0;
    for _ in 0..15 {
        held.iter().for_each(|&at| error[at as usize] = 0.0);
        let size = dot(&error, &error).sqrt();
        error.iter_mut().for_each(|error| *error /= size);
        let row = |at: usize| {
            matrix.row(at).iter().map(|&(column, value)| value * error[column as usize])
        };
        let residual: Vec<f64> = (0..n).map(|at| row(at).sum()).collect();
        let correction = cycled(hierarchy, &residual);
        error.iter_mut().zip(&correction).for_each(|(error, z)| *error -= z);
        held.iter().for_each(|&at| error[at as usize] = 0.0);
        rate = dot(&error, &error).sqrt();
    }
    rate
}

/// Entries in the order of the unknowns.
fn in_order(order: &[u32], entries: &[f32]) -> Vec<f64> {
    let mut of = vec![0.0; order.len()];
    order.iter().zip(entries).for_each(|(&at, &entry)| of[at as usize] = f64::from(entry));
    of
}

/// A line along each row of cells, of all edges that cross it.
#[test]
fn lines_follow_the_strong_direction() {
    let n = 8;
    let lengths = |a: f64| -> Vec<usize> {
        let lines = Lines::of(&Square::new(n, a, true, |_, _| 1.0).problem());
        let mut order = lines.order.clone();
        order.sort_unstable();
        assert!(order.into_iter().eq(0..lines.order.len() as u32));
        lines.lines.into_iter().map(|line| line.len()).collect()
    };
    assert_eq!(lengths(25.0), vec![2 * n as usize + 1; n as usize]);
    assert!(lengths(1.0).iter().all(|&length| length <= 2));
}

/// x·M⁻¹y = y·M⁻¹x and x·M⁻¹x > 0: conjugate gradients take nothing else.
#[test]
fn the_preconditioner_is_symmetric_and_positive() {
    let mut random = Random::new(7);
    for a in [1.0, 25.0, 1e3] {
        let square = Square::new(12, a, true, |_, _| 1.0);
        let mut edges = Edges::<4>::new(&square.problem());
        edges.hold((0..square.lower.len()).map(|at| at % 5 == 0));
        let mut applied = |x: &[f32]| {
            edges.rest.copy_from_slice(x);
            edges.precondition(x);
            edges.z.iter().map(|&z| f64::from(z)).collect::<Vec<f64>>()
        };
        let [x, y] = [0; 2].map(|_| vector(&mut random, square.load.len()));
        let [in_x, in_y] = [&x, &y].map(|x| x.iter().map(|&x| x as f32).collect::<Vec<f32>>());
        let [of_x, of_y] = [applied(&in_x), applied(&in_y)];
        let size = dot(&x, &of_x);
        assert!(size > 0.0, "{a}");
        IN_SINGLE.check(format!("{a}"), (dot(&x, &of_y) - dot(&y, &of_x)) / size);
    }
}

/// K z comes with z.
#[test]
fn the_sweep_up_tells_the_product() {
    let square = Square::new(16, 5.0, true, |_, _| 1.0);
    let mut edges = Edges::<4>::new(&square.problem());
    edges.hold((0..square.lower.len()).map(|at| at < 9));
    let (n, held) = (square.load.len(), square.free()..square.free() + 9);
    let residual: Vec<f32> = vector(&mut Random::new(1), n).iter().map(|&x| x as f32).collect();
    edges.rest.copy_from_slice(&residual);
    edges.precondition(&residual);
    let z = in_order(&edges.order, &edges.z);
    assert!(held.clone().all(|at| z[at] == 0.0));
    let product = square.times(&z);
    let rest = in_order(&edges.order, &edges.rest);
    let residual = in_order(&edges.order, &residual);
    for at in (0..n).filter(|at| !held.contains(at)) {
        IN_SINGLE.check(at, residual[at] + rest[at] - product[at] / edges.unit);
    }
}

#[test]
fn conjugate_gradients_correct_what_they_are_told() {
    let square = Square::new(20, 1.0, true, |_, _| 1.0);
    let mut edges = Edges::<4>::new(&square.problem());
    let wanted = vector(&mut Random::new(4), square.load.len());
    let load: Vec<f64> = square.times(&wanted).iter().map(|x| x / edges.unit).collect();
    let mut conjugate = Conjugate::new(wanted.len());
    conjugate.residual.iter_mut().zip(&load).for_each(|(r, &b)| *r = b as f32);
    let made = conjugate.correct(&mut edges, 1e-6, 100);
    assert!((5..=9).contains(&made), "{made}");
    for (at, (&x, wanted)) in conjugate.x.iter().zip(&wanted).enumerate() {
        IN_SINGLE.check(at, f64::from(x) - wanted);
    }
}

/// Four quarters in turn stiff and soft: the stiff ones meet in the middle alone. Two halves meet along a line.
#[test]
fn a_vertex_where_stiff_sectors_meet_is_two() {
    let count = |tensor: &dyn Fn(f64, f64) -> [f64; 2]| {
        let square = Square::with(6, tensor, false, |_, _| 1.0);
        Numbering::of(&square.problem()).count
    };
    let isotropic = |is_stiff: bool| if is_stiff { [1e4; 2] } else { [1.0; 2] };
    let all = 7 * 7;
    assert_eq!(count(&|_, _| [1.0, 3.0]), all);
    assert_eq!(count(&|x, _| isotropic(x > 0.5)), all);
    assert_eq!(count(&|x, y| isotropic(x > 0.5 && y > 0.5)), all);
    assert_eq!(count(&|x, y| isotropic((x > 0.5) == (y > 0.5))), all + 1);
}

#[test]
fn the_matrix_of_parted_vertices_is_that_of_means_over_edges() {
    let tensor = |x: f64, y: f64| if (x > 0.4) == (y > 0.6) { [1.0, 2.0] } else { [1e-3, 3e-3] };
    vertex_matrix_is_product(&Square::with(5, tensor, true, |_, _| 1.0), 6 * 5 + 1);
}

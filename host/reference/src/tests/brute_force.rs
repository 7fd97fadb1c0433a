//! Small dense problems against the enumeration of all contact sets.

use super::Random;
use super::stencil::Stencil;
use crate::Factor;
use signorini_tolerances::solve::{ENUMERATED, SCHUR};

type Dense = Vec<Vec<f64>>;

/// Subtracts multiples of row k from the rows below it so that their column k vanishes.
fn eliminate(matrix: &mut Dense, k: usize) {
    let (above, below) = matrix.split_at_mut(k + 1);
    let pivot = &above[k];
    for row in below {
        let multiple = row[k] / pivot[k];
        row.iter_mut().zip(pivot).skip(k).for_each(|(entry, p)| *entry -= multiple * p);
    }
}

/// Gaussian elimination with partial pivoting; the last column of `system` is the right-hand side.
fn dense_solve(mut system: Dense) -> Vec<f64> {
    let n = system.len();
    for k in 0..n {
        let pivot = (k..n).max_by(|&i, &j| system[i][k].abs().total_cmp(&system[j][k].abs()));
        system.swap(k, pivot.expect("rows are left"));
        eliminate(&mut system, k);
    }
    let mut u = vec![0.0; n];
    for i in (0..n).rev() {
        let known: f64 = (i + 1..n).map(|j| system[i][j] * u[j]).sum();
        u[i] = (system[i][n] - known) / system[i][i];
    }
    u
}

fn times(matrix: &Dense, u: &[f64]) -> Vec<f64> {
    matrix.iter().map(|row| row.iter().zip(u).map(|(a, u)| a * u).sum()).collect()
}

/// The feasible stationary point of least energy over all contact sets.
fn enumerate(matrix: &Dense, load: &[f64], lower: &[f64]) -> Vec<f64> {
    let (n, contact) = (load.len(), lower.len());
    let free = n - contact;
    let mut best = (f64::INFINITY, Vec::new());
    for set in 0..1_u32 << contact {
        let held = |i: usize| i >= free && set >> (i - free) & 1 == 1;
        let equation = |i: usize| -> Vec<f64> {
            match held(i) {
                true => (0..n).map(|j| f64::from(i == j)).chain([lower[i - free]]).collect(),
                false => matrix[i].iter().copied().chain([load[i]]).collect(),
            }
        };
        let u = dense_solve((0..n).map(equation).collect());
        let feasible = u[free..].iter().zip(lower).all(|(u, psi)| *u >= psi - 1e-12);
        let ku = times(matrix, &u);
        let energy: f64 = (0..n).map(|i| u[i] * (0.5 * ku[i] - load[i])).sum();
        if feasible && energy < best.0 {
            best = (energy, u);
        }
    }
    best.1
}

fn sparse(matrix: &Dense, load: Vec<f64>, lower: Vec<f64>) -> Stencil {
    let row = |i: usize| {
        let others = (0..matrix.len()).rev().filter(move |&j| j != i && matrix[i][j] != 0.0);
        std::iter::once(i).chain(others).map(|j| (j as u32, matrix[i][j])).collect()
    };
    let rows: Vec<Vec<(u32, f64)>> = (0..matrix.len()).map(row).collect();
    Stencil::from_rows(&rows, load, lower)
}

fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).fold(0.0, |largest, (a, b)| largest.max((a - b).abs()))
}

/// Weakly dominant, off-diagonal entries ≤ 0, about half of them zero.
fn m_matrix(n: usize, random: &mut Random) -> Dense {
    let mut matrix = vec![vec![0.0; n]; n];
    for i in 0..n {
        for j in 0..i {
            let weight = random.next().max(0.0);
            matrix[i][j] = -weight;
            matrix[j][i] = -weight;
            matrix[i][i] += weight;
            matrix[j][j] += weight;
        }
        matrix[i][i] += 0.01;
    }
    matrix
}

/// Bᵀ B + ε: entries of both signs, far from an M-matrix.
fn gram_matrix(n: usize, random: &mut Random) -> Dense {
    let factor: Dense = (0..n).map(|_| random.vector(n)).collect();
    let dot = |i: usize, j: usize| -> f64 { factor.iter().map(|row| row[i] * row[j]).sum() };
    let entry = |i, j| dot(i, j) + if i == j { 1e-3 } else { 0.0 };
    (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect()
}

fn agrees_with_enumeration(make: fn(usize, &mut Random) -> Dense) {
    let mut random = Random(7);
    for case in 0..120 {
        let (free, contact) = (case % 5, 1 + case % 8);
        let matrix = make(free + contact, &mut random);
        let (load, lower) = (random.vector(free + contact), random.vector(contact));
        let expected = enumerate(&matrix, &load, &lower);
        let stencil = sparse(&matrix, load, lower);
        let factor = Factor::new(&stencil.problem()).expect("definite");
        let starts = [None, Some(vec![false; contact])];
        for start in starts {
            let found = stencil.solve(&factor, start.as_deref());
            let found = found.expect("solvable");
            let scale = expected.iter().fold(1.0, |scale: f64, u| scale.max(u.abs()));
            let difference = largest_difference(&found.u, &expected);
            ENUMERATED.check_over(format_args!("case {case}"), difference, scale);
        }
    }
}

#[test]
fn random_m_matrices() {
    agrees_with_enumeration(m_matrix);
}

#[test]
fn random_matrices_that_are_no_m_matrices() {
    agrees_with_enumeration(gram_matrix);
}

/// From full contact the semismooth Newton step alone returns to a set it has left.
#[test]
fn matrix_on_which_newton_alone_cycles() {
    let matrix = [[21.0, -7.0, 15.0], [-7.0, 17.0, -7.0], [15.0, -7.0, 11.0]].map(Vec::from);
    let (load, lower) = (vec![-1.0, 6.0, -2.0], vec![0.0; 3]);
    let expected = enumerate(&matrix.to_vec(), &load, &lower);
    let stencil = sparse(&matrix.to_vec(), load, lower);
    let factor = Factor::new(&stencil.problem()).expect("definite");
    let found = stencil.solve(&factor, None).expect("solvable");
    ENUMERATED.check("u", largest_difference(&found.u, &expected));
    assert!(found.steps > 8, "{} steps only: no cycle was met", found.steps);
}

#[test]
fn schur_complement_is_what_elimination_leaves() {
    let mut random = Random(3);
    let (free, contact) = (6, 4);
    let mut matrix = gram_matrix(free + contact, &mut random);
    let stencil = sparse(&matrix, vec![0.0; free + contact], vec![0.0; contact]);
    let factor = Factor::new(&stencil.problem()).expect("definite");
    (0..free).for_each(|k| eliminate(&mut matrix, k));
    for i in 0..contact {
        for j in 0..contact {
            let (found, expected) = (factor.schur()[(i, j)], matrix[free + i][free + j]);
            SCHUR.check(format_args!("S[{i}][{j}]"), found - expected);
        }
    }
}

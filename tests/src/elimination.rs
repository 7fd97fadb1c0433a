//! Gaussian elimination with partial pivoting, for systems of three or four equations.

/// The solution x of `matrix` x = `rhs`, or `None` where a pivot is zero.
pub fn solve(mut matrix: Vec<Vec<f64>>, mut rhs: Vec<f64>) -> Option<Vec<f64>> {
    let n = rhs.len();
    for k in 0..n {
        let pivot = (k..n).max_by(|&i, &j| matrix[i][k].abs().total_cmp(&matrix[j][k].abs()))?;
        if matrix[pivot][k] == 0.0 {
            return None;
        }
        matrix.swap(k, pivot);
        rhs.swap(k, pivot);
        let pivot_row = matrix[k].clone();
        for i in k + 1..n {
            let factor = matrix[i][k] / pivot_row[k];
            for (entry, above) in matrix[i].iter_mut().zip(&pivot_row).skip(k) {
                *entry -= factor * above;
            }
            rhs[i] -= factor * rhs[k];
        }
    }
    for i in (0..n).rev() {
        let known: f64 = (i + 1..n).map(|j| matrix[i][j] * rhs[j]).sum();
        rhs[i] = (rhs[i] - known) / matrix[i][i];
    }
    Some(rhs)
}

#[cfg(test)]
mod tests {
    use super::solve;

    #[test]
    fn a_zero_in_the_corner_needs_the_pivot() {
        let x = solve(vec![vec![0.0, 2.0], vec![4.0, 1.0]], vec![6.0, 7.0]);
        assert_eq!(x, Some(vec![1.0, 3.0]));
    }

    #[test]
    fn dependent_rows_have_no_solution() {
        assert_eq!(solve(vec![vec![1.0, 2.0], vec![2.0, 4.0]], vec![1.0, 0.0]), None);
    }
}

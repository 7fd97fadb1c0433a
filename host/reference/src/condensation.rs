//! Static condensation: the free unknowns eliminated by one sparse Cholesky factorisation.
//!
//! With C last in the elimination order the factor of any symmetric positive definite
//!
//! ```text
//! A = [A_FF A_FC; A_CF A_CC] = L Lᵀ   has   L_CC L_CCᵀ = A_CC − A_CF A_FF⁻¹ A_FC,
//! ```
//!
//! the Schur complement on C. K itself may be singular where only contact holds it, so A is K with
//! a spring D = diag(K_ii) on each contact unknown: then A is definite as soon as K_FF is,
//! S = L_CC L_CCᵀ − D, and K_FF is untouched. Solves with A give all that is needed of K_FF⁻¹:
//!
//! ```text
//! A x = (r_F, 0)             ⇒  K_CF K_FF⁻¹ r_F = −(S + D) x_C
//! A x = (0, (S + D) v)       ⇒  x_C = v,  x_F = −K_FF⁻¹ K_FC v
//! ```

use faer::linalg::matmul::matmul;
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::{Accum, ColMut, ColRef, Mat, MatRef, Par};

use super::ReferenceError;
use super::problem::Matrix;
use super::sparse_cholesky::SparseCholesky;

/// The largest n_c: S takes 1.2 GB then, and the work on it is of order n_c³.
const MOST_CONTACTS: usize = 12_000;
/// A pivot that has lost all but this share of its diagonal entry is a zero hidden by rounding.
const SINGULAR_PIVOT: f64 = 1e-14;
/// S_ii may be negative by rounding, up to this share of K_ii.
const NEGATIVE_BY_ROUNDING: f64 = 1e-8;

/// The factor of A, D, and S.
pub(super) struct Condensation {
    pub cholesky: SparseCholesky,
    springs: Vec<f64>,
    pub schur: Mat<f64>,
}

/// A load r with its effect on C when the free unknowns have been eliminated.
pub(super) struct CondensedLoad {
    /// r_C − K_CF K_FF⁻¹ r_F.
    pub load: Vec<f64>,
    /// A⁻¹ (r_F, 0).
    pub response: Vec<f64>,
}

impl Condensation {
    pub fn new(matrix: &Matrix) -> Result<Self, ReferenceError> {
        let contact = matrix.contact();
        if contact > MOST_CONTACTS {
            return Err(ReferenceError::TooManyContacts { contact, most: MOST_CONTACTS });
        }
        let mut values = matrix.values.clone();
        let mut springs = Vec::with_capacity(contact);
        for unknown in matrix.free..matrix.unknowns() {
            let entry = matrix.diagonal(unknown)?;
            springs.push(values[entry]);
            values[entry] *= 2.0;
        }
        let cholesky = SparseCholesky::new(matrix, &values)?;
        check_pivots(&cholesky, matrix)?;
        let schur = schur_complement(&cholesky, &springs, matrix.free);
        let negative =
            springs.iter().enumerate().find(|&(i, k)| schur[(i, i)] < -NEGATIVE_BY_ROUNDING * k);
        match negative {
            Some((i, _)) => Err(ReferenceError::NotPositiveDefinite { unknown: matrix.free + i }),
            None => Ok(Self { cholesky, springs, schur }),
        }
    }

    /// Condenses the load r = (r_F, r_C).
    pub fn condense(&self, load: &[f64]) -> Result<CondensedLoad, ReferenceError> {
        let free = load.len() - self.springs.len();
        let mut response = load.to_vec();
        response[free..].fill(0.0);
        self.cholesky.solve_in_place(&mut response, load.len())?;
        let mut condensed = self.sprung_schur_times(&response[free..]);
        condensed.iter_mut().zip(&load[free..]).for_each(|(entry, own)| *entry += own);
        Ok(CondensedLoad { load: condensed, response })
    }

    /// The u with u_C = `contact` and K_FF u_F = r_F − K_FC u_C, for the load r that was condensed.
    pub fn extend(&self, load: CondensedLoad, contact: &[f64]) -> Result<Vec<f64>, ReferenceError> {
        let mut u = load.response;
        let free = u.len() - contact.len();
        let missing: Vec<f64> =
            contact.iter().zip(&u[free..]).map(|(wanted, present)| wanted - present).collect();
        let mut change = vec![0.0; free];
        change.extend(self.sprung_schur_times(&missing));
        self.cholesky.solve_in_place(&mut change, u.len())?;
        u.iter_mut().zip(&change).for_each(|(entry, change)| *entry += change);
        u[free..].copy_from_slice(contact);
        Ok(u)
    }

    /// (S + D) v.
    fn sprung_schur_times(&self, v: &[f64]) -> Vec<f64> {
        let mut sum: Vec<f64> = self.springs.iter().zip(v).map(|(spring, v)| spring * v).collect();
        multiply_add(self.schur.as_ref(), v, &mut sum);
        sum
    }
}

/// `sum` += M v.
pub(super) fn multiply_add(matrix: MatRef<'_, f64>, v: &[f64], sum: &mut [f64]) {
    matmul(ColMut::from_slice_mut(sum), Accum::Add, matrix, ColRef::from_slice(v), 1.0, Par::Seq);
}

/// Refuses a pivot L_jj² that is nothing but the rounding of a zero.
pub(super) fn check_pivots(
    cholesky: &SparseCholesky,
    matrix: &Matrix,
) -> Result<(), ReferenceError> {
    for (_, column, value) in cholesky.entries().filter(|(row, column, _)| row == column) {
        let unknown = cholesky.unknown_at(column);
        if value * value <= SINGULAR_PIVOT * matrix.values[matrix.diagonal(unknown)?] {
            return Err(ReferenceError::NotPositiveDefinite { unknown });
        }
    }
    Ok(())
}

/// S = L_CC L_CCᵀ − D, both triangles.
fn schur_complement(cholesky: &SparseCholesky, springs: &[f64], free: usize) -> Mat<f64> {
    let contact = springs.len();
    let mut lower = Mat::zeros(contact, contact);
    for (row, column, value) in cholesky.entries().filter(|&(_, column, _)| column >= free) {
        lower[(row - free, column - free)] = value;
    }
    let mut schur = Mat::zeros(contact, contact);
    triangular::matmul(
        &mut schur,
        BlockStructure::TriangularLower,
        Accum::Replace,
        &lower,
        BlockStructure::TriangularLower,
        lower.transpose(),
        BlockStructure::TriangularUpper,
        1.0,
        Par::Seq,
    );
    for column in 0..contact {
        schur[(column, column)] -= springs[column];
        for row in column + 1..contact {
            schur[(column, row)] = schur[(row, column)];
        }
    }
    schur
}

//! Many rows as few: the triangular factor of a matrix.

/// A remainder below this part of its column is the rounding of a dependent one. A row more than needed does no harm: at
/// each step |c|² = (q·c)² + |c − (q·c)q|² for any unit vector q.
const DEPENDENT: f64 = 16.0 * f64::EPSILON;

/// |x|
pub fn norm(x: &[f64]) -> f64 {
    x.iter().map(|entry| entry * entry).sum::<f64>().sqrt()
}

/// The rows of R in the QR factorisation of `columns` by modified Gram–Schmidt: Q is not kept, and a
/// column that depends on those before it adds no row.
pub fn triangular(mut columns: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    let sizes: Vec<f64> = columns.iter().map(|column| norm(column)).collect();
    let mut rows = Vec::new();
    for at in 0..columns.len() {
        let remainder = norm(&columns[at]);
        if remainder <= DEPENDENT * sizes[at] {
            continue;
        }
        let unit: Vec<f64> = columns[at].iter().map(|entry| entry / remainder).collect();
        let mut row = vec![0.0; columns.len()];
        row[at] = remainder;
        for (entry, column) in row.iter_mut().zip(&mut columns).skip(at + 1) {
            *entry = unit.iter().zip(&*column).map(|(q, c)| q * c).sum();
            column.iter_mut().zip(&unit).for_each(|(c, q)| *c -= *entry * q);
        }
        rows.push(row);
    }
    rows
}

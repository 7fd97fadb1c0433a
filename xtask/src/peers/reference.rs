//! What the solvers should have found: the same problems in f64, by a primal-dual active set.
//!
//! Edges with x < 0 become active, active ones with (S x − b) < 0 inactive, until nothing changes: then
//! all conditions hold, whatever path led there.

use std::fs;
use std::path::Path;

/// A condensed problem, as the header has it: f32 entries, taken as exact.
#[derive(Debug, Clone, PartialEq)]
pub struct Problem {
    /// Rows.
    s: Vec<Vec<f64>>,
    /// The load of each input, the constant part first.
    columns: Vec<Vec<f64>>,
}

/// How far the answers to all ticks are from right, at most; both relative to max |x*| of the tick.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Deviation {
    /// max |x − x*|.
    pub error: f64,
    /// max |min(x, S x − b)|: negative openings, negative forces, and products of both.
    pub violation: f64,
}

impl Problem {
    /// Reads a header.
    pub fn read(header: &Path) -> Result<Self, String> {
        let text = fs::read_to_string(header).map_err(|error| error.to_string())?;
        Self::parse(&text).ok_or_else(|| format!("{} is no condensed problem", header.display()))
    }

    fn parse(text: &str) -> Option<Self> {
        let size: usize =
            text.split_once("#define N ")?.1.split_whitespace().next()?.parse().ok()?;
        let rows = |name| {
            let entries = array(text, name)?;
            let whole = size > 0 && entries.len() % size == 0;
            whole.then(|| entries.chunks(size).map(<[f64]>::to_vec).collect::<Vec<_>>())
        };
        let problem = Self { s: rows("S[")?, columns: rows("B[")? };
        (problem.s.len() == size).then_some(problem)
    }

    /// Contact edges.
    pub fn size(&self) -> usize {
        self.s.len()
    }

    fn load(&self, inputs: &[f64]) -> Vec<f64> {
        let entry = |i: usize| self.columns.iter().zip(inputs).map(|(b, p)| b[i] * p).sum();
        (0..self.size()).map(entry).collect()
    }

    /// S x − b.
    fn residual(&self, x: &[f64], b: &[f64]) -> Vec<f64> {
        let row = |(row, b): (&Vec<f64>, &f64)| dot(row, x) - b;
        self.s.iter().zip(b).map(row).collect()
    }

    /// The solution, found from the active edges given, which are left as they are in the end.
    fn solve(&self, b: &[f64], active: &mut [bool]) -> Result<Vec<f64>, String> {
        for _ in 0..100 {
            let free: Vec<usize> = (0..self.size()).filter(|&i| !active[i]).collect();
            let mut x = vec![0.0; self.size()];
            for (&i, value) in free.iter().zip(self.solve_free(b, &free)) {
                x[i] = value;
            }
            let r = self.residual(&x, b);
            let next: Vec<bool> =
                (0..x.len()).map(|i| if active[i] { r[i] >= 0.0 } else { x[i] < 0.0 }).collect();
            if next == active {
                return Ok(x);
            }
            active.copy_from_slice(&next);
        }
        Err("the reference finds no active set".to_owned())
    }

    /// S x = b on the free edges, by Cholesky's factors L Lᵀ.
    fn solve_free(&self, b: &[f64], free: &[usize]) -> Vec<f64> {
        let mut factor: Vec<Vec<f64>> = Vec::new();
        let mut x: Vec<f64> = Vec::new();
        for (i, &at) in free.iter().enumerate() {
            let mut row = Vec::with_capacity(i + 1);
            for (j, &other) in free[..i].iter().enumerate() {
                row.push((self.s[at][other] - dot(&row, &factor[j])) / factor[j][j]);
            }
            let diagonal = (self.s[at][at] - dot(&row, &row)).sqrt();
            x.push((b[at] - dot(&row, &x)) / diagonal);
            row.push(diagonal);
            factor.push(row);
        }
        for i in (0..x.len()).rev() {
            x[i] /= factor[i][i];
            for j in 0..i {
                x[j] -= factor[i][j] * x[i];
            }
        }
        x
    }
}

/// Compares the answers to all ticks with the solutions.
pub fn deviation<'a>(
    problem: &Problem,
    answers: impl Iterator<Item = &'a [f32]>,
) -> Result<Deviation, String> {
    let mut draw = Draw(0x2545_f491);
    let mut active = vec![false; problem.size()];
    let mut most = Deviation { error: 0.0, violation: 0.0 };
    for answer in answers {
        let others = (1..problem.columns.len()).map(|_| draw.next());
        let inputs: Vec<f64> = [1.0].into_iter().chain(others).collect();
        let b = problem.load(&inputs);
        let exact = problem.solve(&b, &mut active)?;
        let x: Vec<f64> = answer.iter().copied().map(f64::from).collect();
        let finite = x.iter().all(|x| x.is_finite());
        if x.len() != exact.len() || !finite {
            return Err("an answer is not finite or of another size".to_owned());
        }
        let scale = largest(exact.iter().copied()).max(f64::MIN_POSITIVE);
        let error = largest(x.iter().zip(&exact).map(|(x, exact)| x - exact)) / scale;
        let r = problem.residual(&x, &b);
        let violation = largest(x.iter().zip(&r).map(|(x, r)| x.min(*r))) / scale;
        most.error = most.error.max(error);
        most.violation = most.violation.max(violation);
    }
    Ok(most)
}

/// The images' random inputs: xorshift32 and its upper 24 bits, in [−1, 1).
struct Draw(u32);

impl Draw {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 17;
        self.0 ^= self.0 << 5;
        f64::from(self.0 >> 8) / f64::from(1 << 23) - 1.0
    }
}

/// As far as the shorter goes.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn largest(numbers: impl Iterator<Item = f64>) -> f64 {
    numbers.fold(0.0, |most, number| most.max(number.abs()))
}

/// The numbers between the braces of a C array, as f32.
fn array(text: &str, name: &str) -> Option<Vec<f64>> {
    let (_, rest) = text.split_once(&format!("float {name}"))?;
    let (numbers, _) = rest.split_once('{')?.1.split_once('}')?;
    let numbers = numbers.split(',').map(str::trim).filter(|number| !number.is_empty());
    let number = |text: &str| text.trim_end_matches(['f', 'F']).parse::<f32>().ok();
    numbers.map(|text| number(text).map(f64::from)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEADER: &str = "#define N 2 /* edges */\n#define M 1\n\
        static const float S[N*N] = {1.0f, -0.5f,\n -0.5f, 1.0f};\n\
        static const float B[M*N] = {1.0f, -2.0f,};\n";

    #[test]
    fn one_edge_opens_and_one_stays() {
        let problem = Problem::parse(HEADER).unwrap();
        // x = (1, 0) and S x − b = (0, 1.5); without contact the second would be −2.
        assert_eq!(problem.solve(&[1.0, -2.0], &mut [false; 2]), Ok(vec![1.0, 0.0]));
        let right = deviation(&problem, [[1.0_f32, 0.0].as_slice()].into_iter());
        assert_eq!(right, Ok(Deviation { error: 0.0, violation: 0.0 }));
        let wrong = deviation(&problem, [[0.75_f32, -0.25].as_slice()].into_iter());
        assert_eq!(wrong, Ok(Deviation { error: 0.25, violation: 0.25 }));
    }

    #[test]
    fn both_edges_open() {
        let problem = Problem::parse(HEADER).unwrap();
        let x = problem.solve(&[1.0, 1.0], &mut [true; 2]).unwrap();
        // Two divisions, each rounded once.
        assert!(x.iter().all(|x| (x - 2.0).abs() <= 2.0 * f64::EPSILON), "{x:?}");
    }

    #[test]
    fn what_is_no_problem_is_refused() {
        assert_eq!(Problem::parse(""), None);
        assert_eq!(Problem::parse(&HEADER.replace("N 2", "N 3")), None);
        assert_eq!(Problem::parse(&HEADER.replace("1.0f", "one")), None);
    }
}

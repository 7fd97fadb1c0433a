//! What the solvers should have found: the same problems in f64, by a primal-dual active set.
//!
//! ```text
//!   x > 0:  w = min(0, m)      x = 0:  w between      x < 0:  w = max(0, m)      w = Sx − b,  m = ∞ without a limit
//! ```
//! An edge whose x has not the sign of its side touches next; one that touches with a w outside goes to the side of the end
//! that it has passed. When nothing changes any more all conditions hold, whatever path led there.

#[cfg(test)]
mod tests;

use std::fs;
use std::path::Path;

/// A condensed problem, as the header has it: f32 entries, taken as exact.
#[derive(Debug, Clone, PartialEq)]
pub struct Problem {
    /// Rows.
    s: Vec<Vec<f64>>,
    /// The load of each input, the constant part first.
    columns: Vec<Vec<f64>>,
    /// m of each edge; nothing where all are ∞.
    spans: Vec<f64>,
}

/// What an edge does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// x > 0, or may be.
    Above,
    /// x = 0.
    Touching,
    /// x < 0, or may be.
    Below,
}

/// How far the answers to all ticks are from right, at most; both relative to max |x*| of the tick.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Deviation {
    /// max |x − x*|.
    pub error: f64,
    /// max |w − P(w − x)| with P the nearest w that is allowed: without limits |min(x, w)|, negative openings, negative
    /// forces, and products of both.
    pub violation: f64,
}

impl Problem {
    /// Reads a header.
    pub fn read(header: &Path) -> Result<Self, String> {
        let text = fs::read_to_string(header).map_err(|error| error.to_string())?;
        Self::parse(&text).ok_or_else(|| format!("{} is no condensed problem", header.display()))
    }

    pub fn parse(text: &str) -> Option<Self> {
        let size: usize =
            text.split_once("#define N ")?.1.split_whitespace().next()?.parse().ok()?;
        let rows = |name| {
            let entries = array(text, name)?;
            let whole = size > 0 && entries.len() % size == 0;
            whole.then(|| entries.chunks(size).map(<[f64]>::to_vec).collect::<Vec<_>>())
        };
        // Only what does not change is a bound that peers are set up with.
        let mut columns = rows("SPANS[").unwrap_or_default().into_iter();
        let spans = columns.next().unwrap_or_default();
        let is_constant = columns.flatten().all(|span| span == 0.0);
        let problem = Self { s: rows("S[")?, columns: rows("B[")?, spans };
        (problem.s.len() == size && is_constant).then_some(problem)
    }

    /// Contact edges.
    pub fn size(&self) -> usize {
        self.s.len()
    }

    /// S by rows.
    pub fn matrix(&self) -> &[Vec<f64>] {
        &self.s
    }

    /// B by columns.
    pub fn columns(&self) -> &[Vec<f64>] {
        &self.columns
    }

    /// Whether a flux has a limit.
    pub fn is_limited(&self) -> bool {
        !self.spans.is_empty()
    }

    /// The least and the largest w of an edge.
    pub fn ends(&self, at: usize) -> [f64; 2] {
        let span = self.spans.get(at).copied().unwrap_or(f64::INFINITY);
        [span.min(0.0), span.max(0.0)]
    }

    /// The w that an x of this side has, on top of b: x is not 0 there.
    fn end(&self, at: usize, side: Side) -> f64 {
        let [least, most] = self.ends(at);
        if side == Side::Below { most } else { least }
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

    /// The solution, found from the sides given, which are left as they are in the end.
    fn solve(&self, b: &[f64], sides: &mut [Side]) -> Result<Vec<f64>, String> {
        for _ in 0..100 {
            let free: Vec<usize> =
                (0..self.size()).filter(|&i| sides[i] != Side::Touching).collect();
            let on_side = |(i, b): (usize, &f64)| b + self.end(i, sides[i]);
            let loads: Vec<f64> = b.iter().enumerate().map(on_side).collect();
            let mut x = vec![0.0; self.size()];
            for (&i, value) in free.iter().zip(self.solve_free(&loads, &free)) {
                x[i] = value;
            }
            let w = self.residual(&x, b);
            let next: Vec<Side> =
                (0..x.len()).map(|i| self.next(i, sides[i], [x[i], w[i]])).collect();
            if next == sides {
                return Ok(x);
            }
            sides.copy_from_slice(&next);
        }
        Err("the reference finds no active set".to_owned())
    }

    /// The side to try next.
    fn next(&self, at: usize, side: Side, [x, w]: [f64; 2]) -> Side {
        let [least, most] = self.ends(at);
        match side {
            Side::Above if x < 0.0 => Side::Touching,
            Side::Below if x > 0.0 => Side::Touching,
            Side::Touching if w < least => Side::Above,
            Side::Touching if w > most => Side::Below,
            side => side,
        }
    }

    /// By how much an edge violates its conditions, with a sign.
    fn violation(&self, at: usize, [x, w]: [f64; 2]) -> f64 {
        let [least, most] = self.ends(at);
        match w - x {
            below if below < least => w - least,
            above if above > most => w - most,
            _ => x,
        }
    }

    /// S⁻¹b
    pub fn without_contact(&self, b: &[f64]) -> Vec<f64> {
        let all: Vec<usize> = (0..self.size()).collect();
        self.solve_free(b, &all)
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
    let mut sides = vec![Side::Touching; problem.size()];
    let mut most = Deviation { error: 0.0, violation: 0.0 };
    for answer in answers {
        let others = (1..problem.columns.len()).map(|_| draw.next());
        let inputs: Vec<f64> = [1.0].into_iter().chain(others).collect();
        let b = problem.load(&inputs);
        let exact = problem.solve(&b, &mut sides)?;
        let x: Vec<f64> = answer.iter().copied().map(f64::from).collect();
        let finite = x.iter().all(|x| x.is_finite());
        if x.len() != exact.len() || !finite {
            return Err("an answer is not finite or of another size".to_owned());
        }
        let scale = largest(exact.iter().copied()).max(f64::MIN_POSITIVE);
        let error = largest(x.iter().zip(&exact).map(|(x, exact)| x - exact)) / scale;
        let r = problem.residual(&x, &b);
        let violations = x.iter().zip(&r).enumerate();
        let violations = violations.map(|(i, (&x, &w))| problem.violation(i, [x, w]));
        let violation = largest(violations) / scale;
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

//! The bounded quadratic problem that the peers are given, as a C header beside that of the condensed problem.
//!
//! ```text
//!   minimise ½ zᵀH z − (F p)ᵀz   over least ≤ z ≤ most
//!   no limits:  z = x              H = S      F = B          0 ≤ z
//!   limits:     z = w = Sx − B p   H = S⁻¹    F = −S⁻¹B      min(0, m) ≤ z ≤ max(0, m)
//! ```
//! With limits x has either sign, and its cost has a kink at 0, which no peer takes. The dual has none, and as many unknowns:
//! S⁻¹(z + B p) = x is its gradient, and x ≠ 0 is a multiplier, with the other sign. The peers are given S⁻¹ and S⁻¹B, which
//! is worked out here in f64 and costs their ticks nothing.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use super::reference::Problem;

/// Numbers a line.
const ACROSS: usize = 8;

/// Writes `quadratic.h` into the folder.
pub fn write(problem: &Problem, folder: &Path) -> Result<PathBuf, String> {
    let header = folder.join("quadratic.h");
    fs::write(&header, text(problem)).map_err(|error| format!("{}: {error}", header.display()))?;
    Ok(header)
}

fn text(problem: &Problem) -> String {
    let is_dual = problem.is_limited();
    let (matrix, loads) = if is_dual { dual(problem) } else { primal(problem) };
    let ends: Vec<[f64; 2]> = (0..problem.size()).map(|at| problem.ends(at)).collect();
    let mut text = format!("#include <math.h>\n#define IS_DUAL {}\n", u8::from(is_dual));
    put(&mut text, "H", "N * N", &matrix.concat());
    put(&mut text, "F", "N * M", &loads.concat());
    for (side, name) in ["LEAST", "MOST"].into_iter().enumerate() {
        let ends: Vec<f64> = ends.iter().map(|ends| ends[side]).collect();
        put(&mut text, name, "N", &ends);
    }
    text
}

/// H by rows and F by columns.
type Terms = (Vec<Vec<f64>>, Vec<Vec<f64>>);

fn primal(problem: &Problem) -> Terms {
    (problem.matrix().to_vec(), problem.columns().to_vec())
}

fn dual(problem: &Problem) -> Terms {
    let size = problem.size();
    let unit = |at: usize| (0..size).map(|i| f64::from(u8::from(i == at))).collect::<Vec<f64>>();
    let inverse: Vec<_> = (0..size).map(|at| problem.without_contact(&unit(at))).collect();
    let negative = |b: &Vec<f64>| problem.without_contact(b).iter().map(|x| -x).collect();
    (symmetric(&inverse), problem.columns().iter().map(negative).collect())
}

/// The lower triangle on both sides: rounding has made them differ.
fn symmetric(matrix: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let entry = |i: usize, j: usize| matrix[i.max(j)][i.min(j)];
    (0..matrix.len()).map(|i| (0..matrix.len()).map(|j| entry(i, j)).collect()).collect()
}

fn put(text: &mut String, name: &str, size: &str, numbers: &[f64]) {
    let lines = numbers.chunks(ACROSS).map(|line| {
        let line: Vec<_> = line.iter().map(|&x| number(x)).collect();
        line.join(", ")
    });
    let lines: Vec<_> = lines.collect();
    let _ = writeln!(text, "static const float {name}[{size}] = {{\n{}}};", lines.join(",\n"));
}

/// As C has it.
fn number(x: f64) -> String {
    match x as f32 {
        f32::INFINITY => "INFINITY".to_owned(),
        f32::NEG_INFINITY => "-INFINITY".to_owned(),
        x => format!("{x:?}f"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// S = (2, −1; −1, 1) with the inverse (1, 1; 1, 2).
    const HEADER: &str = "#define N 2\n#define M 1\n\
        static const float S[N*N] = {2.0f, -1.0f, -1.0f, 1.0f};\n\
        static const float B[M*N] = {1.0f, -3.0f};\n";

    #[test]
    fn without_limits_it_is_the_problem_itself() {
        let text = text(&Problem::parse(HEADER).unwrap());
        assert!(text.contains("#define IS_DUAL 0"));
        assert!(text.contains("H[N * N] = {\n2.0f, -1.0f, -1.0f, 1.0f}"), "{text}");
        assert!(text.contains("F[N * M] = {\n1.0f, -3.0f}"), "{text}");
        assert!(text.contains("LEAST[N] = {\n0.0f, 0.0f}"), "{text}");
        assert!(text.contains("MOST[N] = {\nINFINITY, INFINITY}"), "{text}");
    }

    #[test]
    fn with_limits_it_is_the_dual() {
        let header = format!("{HEADER}static const float SPANS[M*N] = {{0.5f, -INFINITY}};\n");
        let text = text(&Problem::parse(&header).unwrap());
        assert!(text.contains("#define IS_DUAL 1"));
        let numbers = |name: &str| -> Vec<f32> {
            let (_, rest) = text.split_once(&format!("float {name}[")).unwrap();
            let (numbers, _) = rest.split_once('{').unwrap().1.split_once('}').unwrap();
            let number = |text: &str| text.trim().trim_end_matches('f').parse().unwrap();
            numbers.split(',').map(number).collect()
        };
        // Square roots of 2 and ½ were multiplied in f64, and f32 has the integers.
        assert_eq!(numbers("H"), [1.0, 1.0, 1.0, 2.0]);
        assert_eq!(numbers("F"), [2.0, 5.0]);
        assert_eq!(numbers("LEAST"), [0.0, f32::NEG_INFINITY]);
        assert_eq!(numbers("MOST"), [0.5, 0.0]);
    }
}

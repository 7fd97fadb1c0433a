//! The table in `host/benches/solvers/record.csv`, in microseconds per unknown.

use std::fs;
use std::path::Path;

use signorini_solve::cost::Size;

/// One problem.
pub struct Row {
    pub name: String,
    /// Factor of the first entry of A.
    pub factor: f64,
    pub level: u32,
    pub size: Size,
    /// Which solvers were to be timed.
    pub asked: [bool; 4],
    /// Of each solver; `None` where it was not timed.
    pub seconds: [Option<f64>; 4],
}

impl Row {
    /// Whether each solver that was asked was timed: a part of a row is no record.
    fn is_whole(&self) -> bool {
        self.asked.iter().zip(self.seconds).all(|(asked, seconds)| !asked || seconds.is_some())
    }

    pub fn quickest(&self) -> f64 {
        self.seconds.into_iter().flatten().fold(f64::INFINITY, f64::min)
    }

    /// Its first fields.
    fn key(&self) -> String {
        format!("{},{},{},", self.name, self.factor, self.level)
    }

    fn line(&self) -> String {
        let Size { unknowns, contact, quads, stretch } = self.size;
        let micros = |seconds: Option<f64>| match seconds {
            Some(seconds) if seconds.is_finite() => {
                format!("{:.2}", 1e6 * seconds / unknowns as f64)
            }
            _ => String::new(),
        };
        let [sweeps, factor, direct, multigrid] = self.seconds.map(micros);
        let key = self.key();
        format!(
            "{key}{unknowns},{contact},{quads},{stretch:.3},{sweeps},{factor},{direct},{multigrid}"
        )
    }
}

/// All problems that were timed.
#[derive(Default)]
pub struct Record {
    pub rows: Vec<Row>,
}

impl Record {
    /// Writes the record, with the rows that were timed in the place of those that were.
    pub fn renew(&self) {
        let is_asked = |option: &str| std::env::args().any(|word| word == option);
        if !is_asked("--bench") || is_asked("--test") {
            return;
        }
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/solvers/record.csv");
        let before = fs::read_to_string(&path).unwrap_or_default();
        let line = |row: &Row| match row.is_whole() && row.quickest().is_finite() {
            true => row.line(),
            false => {
                let known = before.lines().find(|line| line.starts_with(&row.key()));
                known.unwrap_or_default().to_owned()
            }
        };
        let head =
            "scene,times,level,unknowns,contact,quads,stretch,sweeps,factor,direct,multigrid";
        let lines: Vec<String> =
            std::iter::once(head.to_owned()).chain(self.rows.iter().map(line)).collect();
        fs::write(&path, lines.join("\n") + "\n").expect("the record can be written");
        println!("written to {}", path.display());
    }
}

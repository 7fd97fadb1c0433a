//! `cargo xtask peers`: other solvers on the emulated board, on the same condensed problems and ticks.
//!
//! ```text
//!   minimise ½ xᵀS x − bᵀx over x ≥ 0,   b = Σ_j p_j B_j,   p_0 = 1, the other p_j random in [−1, 1)
//! ```
//! Where fluxes have limits, w = Sx − b lies between two ends, and x has either sign. The peers are given the dual problem then:
//! `tests/firmware/peers/problem.py`, which also works out what all should have found. Slacks, or parts of x above and below 0,
//! would leave its matrix singular, which DAQP treats by proximal steps alone. In favour of the peers, S⁻¹b is not counted;
//! against them, DAQP works out w besides x, which its interface always does.
//!
//! DAQP (MIT licence) 0.7.2 is the fastest of its releases tried: 0.8.5 takes 1 % more and 0.11.0 up to a
//! third more, for a step of refinement that f32 always asks for. It is set up on the board, outside of
//! the count. OSQP (Apache 2.0) is what its own generator writes on the host: embedded mode 1, factored.
//! Both in f32 by GCC with -O2, which here beats -O3; multiply-adds are fused; no link-time optimisation.
//! A tick is counted from b to x, starts where the last one ended, and the first is not counted.

mod image;
mod sources;

use std::path::{Path, PathBuf};

use crate::program::{scene_data, signorini};
use crate::record;
use crate::setup;
use crate::steps::Steps;
use image::Measured;
use signorini_image::cargo::{root, target_dir};
use signorini_image::files;
use signorini_image::toolchain::output;
use sources::Sources;

const RECORD: &str = "tests/firmware/peers.txt";

/// The problems: a title, the scene, and whether edges that never change sides are left out.
const PROBLEMS: [(&str, &str, bool); 7] = [
    ("random loads on 16 edges", "contact-16", false),
    ("random loads on 32 edges", "contact-32", false),
    ("random loads on 64 edges", "contact-64", false),
    ("levee, all edges", "levee", false),
    ("levee, edges that may change", "levee", true),
    ("random loads on 32 edges with limits", "limited-32", false),
    ("heater mats of limited power, all edges", "antiicing", false),
];

/// The columns.
const HEAD: &str = "\
M4F, f32     n      median       worst    code     RAM       error   violation
";

/// Ticks that are counted.
const TICKS: usize = 1000;

/// Relative errors that the solvers must keep: one that is exact up to rounding, and an iterative one. The levee's matrix, of
/// conductivities that jump by 100, magnifies the rounding of f32.
const MOST: [(&str, f64); 3] = [("kernel", 1e-4), ("DAQP", 1e-4), ("OSQP", 5e-3)];

/// The part of DAQP's median and worst that the kernel's may be at most. In the record it is less.
const SHARE: f64 = 1.0;

/// Fetches, builds, runs, prints, compares.
pub fn run(steps: &mut Steps) {
    setup::for_c(steps);
    let bless = steps.blesses();
    let mut sources = Err("not fetched".to_owned());
    steps.check("the peers' sources", || {
        sources = Sources::fetch();
        sources.as_ref().map(drop).map_err(Clone::clone)
    });
    steps.check("the reference finds what is found by hand", || sources.clone()?.check());
    steps.check("instructions, memory and error of a tick", || {
        let sources = sources.clone()?;
        let (mut table, mut rows) = (HEAD.to_owned(), Vec::new());
        for (title, scene, is_reduced) in PROBLEMS {
            println!("{title}");
            let measured = measure(scene, is_reduced, &sources)?;
            table += &format!("{title}\n{}", measured.iter().map(Row::line).collect::<String>());
            rows.push(measured);
        }
        println!("{table}");
        let versions = format!("{}, {}", record::versions_with_gcc()?, sources::VERSIONS);
        record::compare(RECORD, &versions, &table, bless)?;
        rows.iter().try_for_each(|[kernel, daqp, _]| slower(kernel, daqp))
    });
}

/// Kernel, DAQP and OSQP on one problem.
fn measure(scene: &str, is_reduced: bool, sources: &Sources) -> Result<[Row; 3], String> {
    let name = format!("{scene}{}", if is_reduced { "-reduced" } else { "" });
    let folder = target_dir("firmware").join("peers").join(name);
    let header = condense(scene, is_reduced, &folder)?;
    let quadratic = folder.join("quadratic.h");
    let [size, is_limited] = sources.problem("write", &header, &quadratic)?;
    let row = |name, measured: Measured| {
        let answers = folder.join(format!("{name}.txt"));
        files::write(&answers, measured.answers())?;
        let deviation = sources.problem("judge", &header, &answers)?;
        let row = Row::new(name, size as usize, &measured, deviation)?;
        print!("  {}", row.line());
        Ok::<_, String>(row)
    };
    Ok([
        row("kernel", image::kernel(&folder, is_limited == 1.0)?)?,
        row("DAQP", image::peer("daqp", &sources.daqp(), &folder)?)?,
        row("OSQP", image::peer("osqp", &sources.osqp(&quadratic, &folder), &folder)?)?,
    ])
}

/// The cost and error of a solver on a problem.
#[derive(Debug, Clone)]
struct Row {
    solver: &'static str,
    size: usize,
    /// Instructions of a tick.
    median: u64,
    worst: u64,
    /// Bytes.
    code: u64,
    ram: u64,
    /// max |x − x*| and max |w − P(w − x)| of all ticks, both relative to max |x*| of the tick; P is the nearest w that is
    /// allowed: without limits |min(x, w)|, negative openings, negative forces, and products of both.
    deviation: [f64; 2],
}

impl Row {
    fn new(
        solver: &'static str,
        size: usize,
        measured: &Measured,
        deviation: [f64; 2],
    ) -> Result<Self, String> {
        let mut counts: Vec<u64> = measured.ticks.iter().map(|tick| tick.instructions).collect();
        counts.sort_unstable();
        let (Some(&median), Some(&worst), TICKS) =
            (counts.get(TICKS / 2), counts.last(), counts.len())
        else {
            return Err(format!("{solver}: {} ticks instead of {TICKS}", counts.len()));
        };
        let [error, _] = deviation;
        if MOST.iter().any(|&(of, most)| of == solver && error > most) {
            return Err(format!("{solver}: an error of {error:e}"));
        }
        let Measured { code, ram, .. } = *measured;
        Ok(Self { solver, size, median, worst, code, ram, deviation })
    }

    fn line(&self) -> String {
        let Self { solver, size, median, worst, code, ram, .. } = self;
        let [error, violation] = self.deviation;
        format!(
            "{solver:<10}{size:>4}{median:>12}{worst:>12}{code:>8}{ram:>8}{error:>12.1e}{violation:>12.1e}\n"
        )
    }
}

/// `Err` where the kernel takes more than its share of DAQP's instructions.
fn slower(kernel: &Row, daqp: &Row) -> Result<(), String> {
    let is_more = |own: u64, its: u64| own as f64 > SHARE * its as f64;
    let Row { size, median, worst, .. } = *kernel;
    match is_more(median, daqp.median) || is_more(worst, daqp.worst) {
        false => Ok(()),
        true => Err(format!(
            "n = {size}: {median} and {worst} instructions, DAQP {} and {}",
            daqp.median, daqp.worst
        )),
    }
}

/// The scene's condensed problem as a C header, by the host.
fn condense(scene: &str, is_reduced: bool, folder: &Path) -> Result<PathBuf, String> {
    let header = files::folder(folder)?.join("problem.h");
    let scene = root().join(format!("tests/firmware/peers/{scene}.toml"));
    let source = folder.join("contact.rs");
    let more: &[&str] = if is_reduced { &["--reduced"] } else { &[] };
    output(scene_data(&["contact"])?.arg(&scene).arg(&header).args(more))?;
    let more: &[&str] = if is_reduced { &[] } else { &["--full-edges"] };
    let mut bake = signorini(&["bake", "--condensed"])?;
    output(bake.args(more).arg(&scene).arg("-o").arg(&source))?;
    Ok(header)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_much_as_the_peer_passes_and_more_does_not() {
        let row = |median, worst| Row {
            solver: "kernel",
            size: 7,
            median,
            worst,
            code: 8000,
            ram: 400,
            deviation: [0.0; 2],
        };
        assert_eq!(slower(&row(2000, 3000), &row(2000, 3000)), Ok(()));
        for (median, worst) in [(2001, 3000), (2000, 3001)] {
            let why = slower(&row(median, worst), &row(2000, 3000)).expect_err("slower");
            assert!(why.contains("n = 7"), "{why}");
        }
    }
}

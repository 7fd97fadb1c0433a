//! `cargo xtask peers`: other solvers on the emulated board, on the same condensed problems and ticks.
//!
//! ```text
//!   minimise ½ xᵀS x − bᵀx over x ≥ 0,   b = Σ_j p_j B_j,   p_0 = 1, the other p_j random in [−1, 1)
//! ```
//! Where fluxes have limits, w = Sx − b lies between two ends, and x has either sign. The peers are given the dual problem then:
//! `quadratic`. Slacks, or parts of x above and below 0, would leave its matrix singular, which DAQP treats by proximal steps
//! alone. In favour of the peers, S⁻¹b is not counted; against them, DAQP works out w besides x, which its interface always does.
//!
//!
//! DAQP (MIT licence) 0.7.2 is the fastest of its releases tried: 0.8.5 takes 1 % more and 0.11.0 up to a
//! third more, for a step of refinement that f32 always asks for. It is set up on the board, outside of
//! the count. OSQP (Apache 2.0) is what its own generator writes on the host: embedded mode 1, factored.
//! Both in f32 by GCC with -O2, which here beats -O3; multiply-adds are fused; no link-time optimisation.
//! A tick is counted from b to x, starts where the last one ended, and the first is not counted.

mod image;
mod quadratic;
mod reference;
mod sources;

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use crate::program::{scene_data, signorini};
use crate::record;
use crate::setup;
use crate::steps::Steps;
use image::Measured;
use reference::{Deviation, Problem, deviation};
use signorini_image::cargo::{root, target_dir};
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

/// Ticks that are counted.
const TICKS: usize = 1000;

/// Relative errors that the solvers must keep: one that is exact up to rounding, and an iterative one. The levee's matrix, of
/// conductivities that jump by 100, magnifies the rounding of f32.
const MOST: [(&str, f64); 3] = [("kernel", 1e-4), ("DAQP", 1e-4), ("OSQP", 5e-3)];

/// What the kernel's median and worst may be of DAQP's at most. In the record it is less.
const SHARE: f64 = 1.0;

/// Fetches, builds, runs, prints, compares.
pub fn run(steps: &mut Steps) {
    setup::run(steps);
    let bless = steps.blesses();
    let mut sources = Err("not fetched".to_owned());
    steps.check("the peers' sources", || {
        sources = Sources::fetch();
        sources.as_ref().map(drop).map_err(Clone::clone)
    });
    steps.check("instructions, memory and error of a tick", || {
        let sources = sources.clone()?;
        let mut table = format!(
            "{:<10}{:>4}{:>12}{:>12}{:>8}{:>8}{:>12}{:>12}\n",
            "M4F, f32", "n", "median", "worst", "code", "RAM", "error", "violation"
        );
        for (title, scene, is_reduced) in PROBLEMS {
            println!("{title}");
            table += &format!("{title}\n{}", rows(scene, is_reduced, &sources)?);
        }
        println!("{table}");
        let versions = format!("{}, {}", record::versions_with_gcc()?, sources::VERSIONS);
        record::compare(RECORD, &versions, &table, bless)?;
        slower(&table)
    });
}

/// The lines of the table for one problem.
fn rows(scene: &str, is_reduced: bool, sources: &Sources) -> Result<String, String> {
    let name = format!("{scene}{}", if is_reduced { "-reduced" } else { "" });
    let folder = target_dir("firmware").join("peers").join(name);
    let header = condense(scene, is_reduced, &folder)?;
    let problem = Problem::read(&header)?;
    let quadratic = quadratic::write(&problem, &folder)?;
    let solvers = [
        ("kernel", image::kernel(&folder, problem.is_limited())?),
        ("DAQP", image::peer("daqp", &sources.daqp(), &folder)?),
        ("OSQP", image::peer("osqp", &sources.osqp(&quadratic, &folder), &folder)?),
    ];
    let mut text = String::new();
    for (name, measured) in solvers {
        text += &row(name, &problem, &measured)?;
    }
    Ok(text)
}

fn row(name: &str, problem: &Problem, measured: &Measured) -> Result<String, String> {
    let mut counts: Vec<u64> = measured.ticks.iter().map(|tick| tick.instructions).collect();
    counts.sort_unstable();
    let (Some(median), Some(worst), TICKS) = (counts.get(TICKS / 2), counts.last(), counts.len())
    else {
        return Err(format!("{name}: {} ticks instead of {TICKS}", counts.len()));
    };
    let answers = measured.ticks.iter().map(|tick| tick.x.as_slice());
    let Deviation { error, violation } = deviation(problem, answers)?;
    if MOST.iter().any(|&(of, most)| of == name && error > most) {
        return Err(format!("{name}: an error of {error:e}"));
    }
    let Measured { code, ram, .. } = measured;
    let mut text = format!("{name:<10}{:>4}{median:>12}{worst:>12}{code:>8}", problem.size());
    let _ = writeln!(text, "{ram:>8}{error:>12.1e}{violation:>12.1e}");
    Ok(text)
}

/// `Err` where the kernel takes more than its share of DAQP's instructions.
fn slower(table: &str) -> Result<(), String> {
    let rows = |name| table.lines().filter(move |line| line.starts_with(name));
    let figures = |row: &str| -> Vec<f64> {
        row.split_whitespace().filter_map(|word| word.parse().ok()).take(3).collect()
    };
    let mut compared = 0;
    for (kernel, peer) in rows("kernel").map(figures).zip(rows("DAQP").map(figures)) {
        let ([n, median, worst], [of, its_median, its_worst]) = (&kernel[..], &peer[..]) else {
            return Err("a line of the table lacks figures".to_owned());
        };
        if n != of || *median > SHARE * its_median || *worst > SHARE * its_worst {
            return Err(format!(
                "n = {n}: {median} and {worst} instructions, DAQP {its_median} and {its_worst}"
            ));
        }
        compared += 1;
    }
    if compared == PROBLEMS.len() {
        Ok(())
    } else {
        Err(format!("{compared} problems are compared"))
    }
}

/// The scene's condensed problem as a C header, by the host.
fn condense(scene: &str, is_reduced: bool, folder: &Path) -> Result<PathBuf, String> {
    std::fs::create_dir_all(folder).map_err(|error| error.to_string())?;
    let header = folder.join("problem.h");
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
        let table = "M4F, f32 n median worst\n\
            kernel 16 4400 10280 8000\nDAQP 16 9920 23000 11924\n\
            kernel 32 14640 34360 8000\nDAQP 32 30600 87480 11924\n\
            kernel 64 60600 140000 8000\nDAQP 64 121400 407920 11924\n\
            levee\nkernel 50 40000 60000 8000\nDAQP 50 90000 100000 11924\n\
            kernel 7 2000 3000 8000\nDAQP 7 2000 3000 11924\n\
            limits\nkernel 32 50880 139160 19968\nDAQP 32 83320 215880 12036\n\
            mats\nkernel 32 92400 180240 19896\nDAQP 32 121160 354920 12036\n";
        assert_eq!(slower(table), Ok(()));
        let why = |table: String| slower(&table).unwrap_err();
        assert!(why(table.replace("60600", "121401")).contains("n = 64"));
        assert!(why(table.replace("10280", "23001")).contains("n = 16"));
        assert!(why(table.replace("92400", "121161")).contains("n = 32"));
        assert!(why(table.replace("kernel 32", "kernel 31")).contains("n = 31"));
        assert!(why(table.replace("DAQP 16", "OSQP 16")).contains("n = "));
        assert!(why(String::new()).contains("0 problems"));
    }
}

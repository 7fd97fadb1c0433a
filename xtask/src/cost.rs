//! `cargo xtask cost`: what every stage costs, counted by the emulator, against the record in git.

use std::cmp::Ordering;
use std::fmt::Write as _;

use signorini_image::board::{Board, M4, M4F, M7};
use signorini_image::record::counts::Counts;

use crate::export::stages;
use crate::record;
use crate::setup;
use crate::snapshot;
use crate::steps::Steps;

/// Boards, the first of which counts in every run.
const BOARDS: [Board; 3] = [M4F, M4, M7];
const RECORD: &str = "host/bake/records/cost.txt";

/// An image that counts.
struct Image {
    bin: &'static str,
    /// The kinds of data that its counts are of.
    kinds: &'static [&'static str],
    /// The stage that each kind counts last.
    last: &'static str,
    /// Features that the others do without.
    features: &'static [&'static str],
}

/// The stages on a mesh, those of its factor and of the condensed problem, and functions of micromath beside libm's.
const IMAGES: [Image; 5] = [
    Image {
        bin: "cost",
        kinds: &["f32 triangles", "f32 quads", "f64 triangles", "f64 quads"],
        last: "certificate, A varies",
        features: &[],
    },
    Image {
        bin: "factor",
        kinds: &["f32 triangles", "f32 quads", "f64 triangles", "f64 quads"],
        last: "substitution, entries",
        features: &[],
    },
    Image {
        bin: "dense",
        kinds: &["f32, n = 8", "f32, n = 16", "f32, n = 32", "f32, n = 64", "f64, n = 64"],
        last: "norm of the bound, half of x zero",
        features: &[],
    },
    Image {
        bin: "limits",
        kinds: &["limits, n = 8", "limits, n = 16", "limits, n = 32", "limits, n = 64"],
        last: "modes, a matrix of eight",
        features: &["limited", "transfer"],
    },
    Image { bin: "functions", kinds: &["f32 libm", "f32 micromath"], last: "powf", features: &[] },
];

/// Board, kind, what, and the count that it shall not exceed.
type Target = (&'static str, &'static str, &'static [(&'static str, f64)], &'static str, f64);

/// Unknowns a cell of the mesh that is counted on: 392 to 256.
const UNKNOWNS: f64 = 392.0 / 256.0;

/// A target bounds a sum of stages, each times a factor.
const TARGETS: [Target; 10] = [
    ("M4F", "f32 triangles", &[("sweep", 1.0)], "sweep an unknown", 23.5),
    ("M4F", "f32 quads", &[("sweep", 1.0)], "sweep an unknown", 34.5),
    ("M7", "f64 triangles", &[("sweep", 1.0)], "sweep an unknown", 21.0),
    ("M4F", "f32 triangles", &[("flux by cells", 1.0)], "flux a cell, safe code", 42.0),
    ("M4F", "f32 triangles", &[("element matrices", 1.0)], "element matrix", 61.0),
    (
        "M4F",
        "f32 triangles",
        &[("element matrices", 1.0), ("rows from cells", UNKNOWNS)],
        "assembly a cell, all in",
        125.0,
    ),
    ("M4F", "f32 triangles", &[("certificate", 1.0)], "certificate a cell, safe code", 230.0),
    ("M4F", "f32 triangles", &[("sweep, stack", 1.0)], "stack of a sweep in bytes", 256.0),
    ("M4F", "f32 triangles", &[("flux by cells, stack", 1.0)], "stack of the flux in bytes", 256.0),
    ("M4F", "f32, n = 64", &[("sweep", 1.0)], "dense sweep an entry, safe code", 2.7),
];

/// The floor of a sweep: loads of 5 row entries, 4 neighbours and u, one of offsets, 4 additions of
/// addresses, 5 multiply-adds, a store and half of a loop.
const FLOOR: f64 = 21.5;

/// Counts, prints, compares.
pub fn run(steps: &mut Steps) {
    setup::run(steps);
    let bless = steps.blesses();
    // Images with features of their own, and other boards, are built for a whole run alone.
    let is_whole = steps.is_whole();
    let boards = if is_whole { BOARDS.len() } else { 1 };
    let images = IMAGES.iter().filter(|image| is_whole || image.features.is_empty());
    steps.check("instructions of every stage", || {
        let (mut table, mut counts) = (String::new(), Counts::default());
        for image in images {
            for board in &BOARDS[..boards] {
                table += &measure(board, image, &mut counts)?;
            }
        }
        println!("{table}{}", targets(&counts));
        let versions = record::versions()?;
        let is_same = match boards {
            1 => record::compare_part(RECORD, &versions, &table)?,
            _ => record::compare(RECORD, &versions, &table, bless)?,
        };
        if is_same {
            quoted(&counts)?;
        }
        missed(&counts, &BOARDS[..boards])
    });
}

fn measure(board: &Board, image: &Image, counts: &mut Counts) -> Result<String, String> {
    let folder = stages(board, &[image.bin], image.features)?;
    let said = board.run(&folder.join(image.bin), true)?;
    let mut rows: Vec<(String, String)> = Vec::new();
    for line in said.lines() {
        let Some((kind, stage, unit, [total, units, stack])) = parse(line) else {
            return Err(format!("not a line of counts: `{line}`"));
        };
        if total >= f64::from(u32::MAX) {
            return Err(format!("{kind}, {stage}: too long for the counter"));
        }
        counts.insert(board.name, kind, stage, total / units);
        counts.insert(board.name, kind, &format!("{stage}, stack"), stack);
        if !rows.iter().any(|(known, _)| known == stage) {
            rows.push((stage.to_owned(), unit.to_owned()));
        }
    }
    if !image.kinds.iter().all(|kind| counts.get(board.name, kind, image.last).is_some()) {
        return Err(format!("{} on the {} has not counted everything", image.bin, board.name));
    }
    Ok(counts.table(board.name, image.kinds, &rows))
}

/// A line of the image: `f32 triangles | sweep | unknown | 8984 392 64`.
fn parse(line: &str) -> Option<(&str, &str, &str, [f64; 3])> {
    let [kind, stage, unit, numbers] = line.split(" | ").collect::<Vec<_>>().try_into().ok()?;
    let numbers: Option<Vec<f64>> =
        numbers.split_whitespace().map(|number| number.parse().ok()).collect();
    Some((kind, stage, unit, numbers?.try_into().ok()?))
}

/// The target's count; NaN where a stage was not counted.
fn counted(counts: &Counts, (board, kind, stages, _, _): &Target) -> f64 {
    let of = |stage: &str| counts.get(board, kind, stage);
    stages.iter().map(|(stage, factor)| of(stage).map_or(f64::NAN, |x| x * factor)).sum()
}

fn targets(counts: &Counts) -> String {
    let mut text = format!("{:<22}{:<32}{:>10}{:>10}\n", "", "target", "counted", "at most");
    for target in TARGETS {
        let (board, kind, _, what, most) = target;
        let count = counted(counts, &target);
        let met = if count <= most { "" } else { "   not met" };
        let _ = writeln!(text, "{board:<6}{kind:<16}{what:<32}{count:>10.2}{most:>10.1}{met}");
    }
    let over = on_m4f(counts, "f32 triangles", "sweep") / FLOOR;
    text + &format!(
        "A sweep takes {over:.2} times the {FLOOR} instructions that its loads and sums need.\n"
    )
}

/// Where the counts are quoted.
const PAGE: &str = "docs/firmware.md";

/// A count on the board that the page on firmware speaks of; NaN where there is none.
fn on_m4f(counts: &Counts, kind: &str, stage: &str) -> f64 {
    counts.get("M4F", kind, stage).unwrap_or(f64::NAN)
}

/// `Ok` where the page on firmware names these counts.
fn quoted(counts: &Counts) -> Result<(), String> {
    let of = |kind, stage| on_m4f(counts, kind, stage);
    let sweep = of("f32 triangles", "sweep");
    let phrases = [
        format!("{sweep:.1} instructions an unknown"),
        format!("(quads {:.1})", of("f32 quads", "sweep")),
        format!("{:.2} times", sweep / FLOOR),
        format!("takes {:.0}.", of("f32 triangles", "sweep over CSR")),
        format!("takes {:.0} a triangle", of("f32 triangles", "certificate")),
        format!("{:.2} a multiply-add", of("f32, n = 64", "sweep")),
    ];
    let page = snapshot::read(PAGE)?;
    match phrases.iter().find(|phrase| !page.contains(*phrase)) {
        Some(phrase) => Err(format!("{PAGE} does not say `{phrase}`")),
        None => Ok(()),
    }
}

/// Not reached, and known: docs/decisions has what was tried (`rows-without-csr`, `certificate-cost`).
const OPEN: [&str; 2] = ["assembly a cell, all in", "certificate a cell, safe code"];

/// `Err` where a target is missed that has been met before.
fn missed(counts: &Counts, boards: &[Board]) -> Result<(), String> {
    let misses = |target: &&Target| {
        boards.iter().any(|board| board.name == target.0)
            && !OPEN.contains(&target.3)
            && !matches!(
                counted(counts, target).partial_cmp(&target.4),
                Some(Ordering::Less | Ordering::Equal)
            )
    };
    let names: Vec<_> = TARGETS.iter().filter(misses).map(|target| target.3).collect();
    if names.is_empty() { Ok(()) } else { Err(format!("missed: {}", names.join(", "))) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_of_counts() {
        let line = "f32 quads | rows, pattern | unknown | 85354 264 236 ";
        let numbers = [85354.0, 264.0, 236.0];
        assert_eq!(parse(line), Some(("f32 quads", "rows, pattern", "unknown", numbers)));
        assert_eq!(parse("f32 quads | sweep | unknown | 85354 264"), None);
        assert_eq!(parse(""), None);
    }
}

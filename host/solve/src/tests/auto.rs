//! The choices of `auto`, and that its answers are the kernel's.

use std::path::Path;

use super::{LOOSE, distance, read, standard_scenes};
use crate::auto::by_factor;
use crate::cost::Size;
use crate::{Options, Ran, ScalarKind, Solution, SolverKind, Task, solve};
use signorini_problem::fixtures::{SMOOTH, on_grid};
use signorini_problem::scalar::Scalar;
use signorini_problem::{Parts, Problem};
use signorini_scene::error::Result;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_tolerances::Tolerance;
use signorini_tolerances::solve::{
    AGREEMENT, BOUND_OF_FACTOR, BOUND_OF_FACTOR_NARROW, FACTOR_NARROW,
};

/// The answer of the kernel's factor alone, in this scalar.
pub(super) fn factored<R: Scalar>(problem: &Problem) -> Result<Option<Solution>> {
    let parts = &Parts::examine(problem)?;
    let options = &Options { scalar: ScalarKind::of::<R>(), ..Options::default() };
    by_factor::<R>(&Task { problem, parts, options, start: &[], is_posed: true }, None)
}

/// Asserts one answer: converged, equal active edges, u and bound.
fn same(name: &str, found: &Solution, kernel: &Solution, allowed: [Tolerance; 2]) {
    assert!(found.converged() && kernel.converged(), "{name}: {:?}", found.status);
    assert_eq!(found.contact_active, kernel.contact_active, "{name}");
    let far = distance(&found.u, &kernel.u);
    allowed[0].check(name, far);
    assert_eq!(found.bound.is_some(), kernel.bound.is_some(), "{name}");
    if let Some((bound, of_kernel)) = found.bound.zip(kernel.bound) {
        let more = (bound.total - of_kernel.total).max(0.0);
        let size =
            of_kernel.total.max(1e-12 * kernel.u.iter().fold(1.0, |a: f64, u| a.max(u.abs())));
        allowed[1].check_over(name, more, size);
    }
}

#[test]
fn the_factor_alone_answers_like_the_kernel_on_every_standard_scene() -> Result<()> {
    for path in standard_scenes() {
        let (_, problem) = read(&path)?;
        let name = path.file_stem().unwrap().to_string_lossy();
        let kernel = solve(&problem, &Options::default())?;
        let found = factored::<f64>(&problem)?.expect("a factor");
        same(&name, &found, &kernel, [AGREEMENT, BOUND_OF_FACTOR]);
        let found = factored::<f32>(&problem)?.expect("a factor");
        assert!(found.converged() && found.ran == Ran::Factor, "{name}");
        let far = distance(&found.u, &kernel.u);
        FACTOR_NARROW.check(&name, far);
        let chosen = solve(&problem, &Options::by(SolverKind::Auto))?;
        same(&name, &chosen, &kernel, [AGREEMENT, BOUND_OF_FACTOR]);
    }
    Ok(())
}

#[test]
fn small_meshes_are_swept_and_large_ones_factored() -> Result<()> {
    for (cells, scalar) in [
        (Cells::Triangles, ScalarKind::F64),
        (Cells::Quads, ScalarKind::F64),
        (Cells::Mixed, ScalarKind::F32),
    ] {
        let auto = Options { scalar, ..Options::by(SolverKind::Auto) };
        let (_, problem) = on_grid(SMOOTH, grid(8, cells))?;
        let small = solve(&problem, &auto)?;
        assert_eq!((small.ran, small.factored), (Ran::Sweeps, None));
        let (_, problem) = on_grid(SMOOTH, grid(40, cells))?;
        let large = solve(&problem, &auto)?;
        let factored = large.factored.expect("a factor");
        assert_eq!((large.ran, large.sweeps), (Ran::Factor, 0), "{cells:?}");
        assert!(factored.entries > problem.topology.counts.unknowns());
        assert!(large.ending().contains("by elimination"), "{}", large.ending());
        assert!(!large.ending().contains("sweeps"), "{}", large.ending());
        let kernel = solve(&problem, &Options { scalar, ..Options::default() })?;
        let of_u = if scalar == ScalarKind::F64 { AGREEMENT } else { FACTOR_NARROW };
        same("large", &large, &kernel, [of_u, BOUND_OF_FACTOR_NARROW]);
    }
    Ok(())
}

#[test]
fn the_kernel_does_not_begin_what_it_would_not_end() -> Result<()> {
    let (_, problem) = on_grid(SMOOTH, grid(140, Cells::Triangles))?;
    let found = solve(&problem, &Options::default())?;
    assert_eq!((found.ran, found.sweeps), (Ran::Factor, 0));
    let told = solve(&problem, &Options { max_sweeps: Some(3), ..Options::default() })?;
    assert_eq!((told.ran, told.sweeps, told.converged()), (Ran::Sweeps, 3, false));
    Ok(())
}

fn text(path: &str) -> String {
    std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).unwrap()
}

/// What each solver took.
const RECORD: &str = "../benches/solvers/record.csv";

/// A row of the record.
struct Timed {
    what: String,
    size: Size,
    /// Seconds of each solver.
    taken: Vec<(Ran, f64)>,
}

fn record() -> Vec<Timed> {
    let row = |line: &str| {
        let fields: Vec<&str> = line.split(',').collect();
        let count = |at: usize| fields[at].parse().unwrap();
        let size = Size {
            unknowns: count(3),
            contact: count(4),
            quads: fields[5] == "true",
            stretch: fields[6].parse().unwrap(),
        };
        let seconds = |micros: f64| 1e-6 * micros * size.unknowns as f64;
        let all = [Ran::Sweeps, Ran::Factor, Ran::Direct, Ran::Multigrid].into_iter();
        let taken = all.zip(&fields[7..]);
        let taken = taken.filter_map(|(ran, micros)| Some((ran, seconds(micros.parse().ok()?))));
        Timed { what: fields[..3].join(" "), size, taken: taken.collect() }
    };
    text(RECORD).lines().skip(1).map(row).collect()
}

#[test]
fn the_page_quotes_rows_of_the_record() {
    let (page, record) = (text("../../docs/benchmarks.md"), text(RECORD));
    let (_, section) = page.split_once("## Solvers by size").expect("a section");
    let block = section.split("```").nth(3).expect("a block after the command");
    let quoted: Vec<&str> = block.lines().skip(1).filter(|line| !line.is_empty()).collect();
    assert!(quoted.len() > 10);
    for line in quoted {
        assert!(record.lines().any(|of| of == line), "{line}");
    }
}

/// No solver that is chosen takes 1.3 times what another one does, unless that is a twentieth of a second, which nobody waits for.
#[test]
fn the_choice_is_near_the_quickest_of_the_record() {
    const AT_ONCE: f64 = 0.05;
    let record = record();
    assert_eq!(record.len(), 60, "five scenes, three anisotropies, four sizes");
    for Timed { what, size, taken } in record {
        let single: Vec<_> = taken.iter().copied().filter(|of| of.0 != Ran::Direct).collect();
        for (all, is_double) in [(&taken, true), (&single, false)] {
            let chosen = size.quickest(is_double);
            let own = all.iter().find(|of| of.0 == chosen).map_or(f64::INFINITY, |of| of.1);
            let least = all.iter().map(|of| of.1).fold(f64::INFINITY, f64::min);
            let most = (1.3 * least).max(least + AT_ONCE);
            assert!(own <= most, "{what}: {chosen:?} {own} of {least}");
        }
    }
}

#[test]
fn what_nothing_holds_goes_to_the_direct_solver() -> Result<()> {
    let (_, problem) = on_grid(LOOSE, grid(40, Cells::Triangles))?;
    let found = solve(&problem, &Options::by(SolverKind::Auto))?;
    assert_eq!((found.ran, found.sweeps), (Ran::Direct, 0));
    let direct = solve(&problem, &Options::by(SolverKind::Direct))?;
    assert_eq!(distance(&found.u, &direct.u), 0.0);
    let single =
        solve(&problem, &Options { scalar: ScalarKind::F32, ..Options::by(SolverKind::Auto) })?;
    assert!(single.converged() && single.ran == Ran::Sweeps, "{}", single.ending());
    Ok(())
}

#[test]
fn the_direct_solver_has_steps_and_tells_a_tolerance_that_it_misses() -> Result<()> {
    let (_, problem) = on_grid(SMOOTH, grid(8, Cells::Triangles))?;
    let with = |tolerance| Options { tolerance, ..Options::by(SolverKind::Direct) };
    let found = solve(&problem, &with(None))?;
    assert_eq!((found.ran, found.sweeps), (Ran::Direct, 0));
    assert!(found.ending().contains("active-set steps") && !found.ending().contains("sweeps"));
    assert!(found.factored.expect("a factor").exchanges > 0);
    let met = solve(&problem, &with(Some(1e-9)))?;
    assert!(met.ending().starts_with("converged"), "{}", met.ending());
    let missed = solve(&problem, &with(Some(1e-30)))?;
    assert!(missed.ending().starts_with("rounding-limit"), "{}", missed.ending());
    Ok(())
}

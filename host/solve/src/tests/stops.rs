//! The bound at any stop, over all signs of both ends of the flux and with either or none of them infinite.

use super::limits::meshes;
use super::{Options, SolverKind, solve};
use crate::ScalarKind;
use signorini_certify::exact::distance as distance_to_exact;
use signorini_problem::fixtures::limited::{three_states, two_transitions};
use signorini_problem::fixtures::{SMOOTH, on_grid};
use signorini_scene::error::Result;
use signorini_scene::mesh::Mesh;
use signorini_tolerances::some;

/// Sweeps after which a solve is stopped, and as many as it takes.
const STOPS: [u32; 5] = [0, 1, 5, 20, 1_000_000];
/// Most that a converged bound is of the error, where that is no rounding.
const SHARP: f64 = 1.02;
/// Errors below this are rounding, in f64 and f32.
const ROUNDING: [f64; 2] = [1e-9, 1e-2];

/// Which ends are finite.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Ends {
    Lower,
    Upper,
    /// Both, and so far apart.
    Both(f64),
    Equal,
}

/// u = x²y + y² + x³ + cy, whose σ·n = −2.5x² − c on y = 0 has the sign of −c, at `ends` and in contact on parts of the edge.
fn smooth(c: f64, ends: Ends) -> String {
    let flux = format!("-2.5*x^2 - ({c})");
    let half = 0.5 * c;
    let (right, left) = ("max(0, x - 0.3)", "max(0, -0.3 - x)");
    let (gap, ends) = match ends {
        Ends::Lower => {
            (format!("x^3 - 2*{right}"), [format!("{flux} - max(0, 0.3 - x)"), "inf".to_owned()])
        }
        Ends::Upper => {
            (format!("x^3 + 2*{right}"), ["-inf".to_owned(), format!("{flux} + max(0, 0.3 - x)")])
        }
        Ends::Both(span) => (
            format!("x^3 - 2*{right} + 1.5*{left}"),
            [
                format!("{flux} - {span}*max(0, 0.3 - x)"),
                format!("{flux} + {span}*max(0, x + 0.3)"),
            ],
        ),
        Ends::Equal => (format!("x^3 - {right} + {left}"), [flux.clone(), flux.clone()]),
    };
    SMOOTH
        .replace("gap = \"x^3\"", &format!("gap = \"{gap}\""))
        .replace(
            "flux = \"-3.5*x^2 - 1\"",
            &format!("flux = \"{}\", limit = \"{}\"", ends[0], ends[1]),
        )
        .replace("x^2*y + y^2 + x^3", &format!("x^2*y + y^2 + x^3 + {c}*y"))
        .replace("x^2 + 2*y\"", &format!("x^2 + 2*y + {c}\""))
        .replace("5*y + 6.5", &format!("5*y + 6.5 + {half}"))
        .replace("y^2 - 1 + (3*y - 6.5)", &format!("y^2 - 1 + {c}*y + (3*y - 6.5 - {half})"))
}

/// Both ends with each pair of signs, equal and nearly equal ones, one end alone; tiny and huge. Each fourth is of another kind.
fn all() -> Vec<(String, String)> {
    let pairs = [
        [0.0, 1.5],
        [-1.5, 0.0],
        [-1.0, 1.0],
        [0.5, 2.0],
        [-2.0, -0.5],
        [-1.0, 1e6],
        [-1e6, 1.0],
        [1.0, 1.0],
        [-1.000_000_000_001, -1.0],
        [-1e-9, 1e-9],
    ];
    let transitions = pairs.map(|ends| (format!("{ends:?}"), two_transitions(ends)));
    let kinds =
        [Ends::Upper, Ends::Lower, Ends::Both(0.1), Ends::Both(1.0), Ends::Both(20.0), Ends::Equal];
    let smooth = [-3.0, 0.0, 3.0]
        .into_iter()
        .flat_map(|c| kinds.map(|ends| (format!("c = {c}, {ends:?}"), smooth(c, ends))));
    transitions.into_iter().chain(smooth).collect()
}

/// Asserts the bound of a scene on a mesh where the kernel stops after so many sweeps, in either scalar; whether it
/// `is_identity` too.
fn holds(what: &str, text: &str, mesh: Mesh, stops: &[u32], is_identity: bool) -> Result<()> {
    let (scene, problem) = on_grid(text, mesh)?;
    let exact = scene.exact.as_ref().expect("an exact solution");
    for (at, scalar) in [ScalarKind::F64, ScalarKind::F32].into_iter().enumerate() {
        for &max_sweeps in some(2, stops) {
            let solver = SolverKind::Kernel;
            let options =
                Options { solver, scalar, max_sweeps: Some(max_sweeps), ..Options::default() };
            let found = solve(&problem, &options)?;
            let what = format!("{what}, {scalar:?} after {max_sweeps}");
            // Where hi − lo varies along an edge by more than half there is none, and the reason says so.
            let Some(bound) = found.bound else {
                let reason = found.no_bound.as_ref().expect("a reason").to_string();
                assert!(reason.contains("limit") && !is_identity, "{what}: {reason}");
                continue;
            };
            let of = distance_to_exact(exact, &problem, &found.certified.admissible())?;
            assert!(bound.total >= of.combined, "{what}: {} {of:?}", bound.total);
            let identity = bound.duality_gap / of.identity;
            let is_same = (1.0 - 1e-3..1.0 + 1e-3).contains(&identity);
            assert!(is_same || !is_identity, "{what}: gap/identity = {identity}");
            if found.converged() && of.combined > ROUNDING[at] && !is_identity {
                let ratio = bound.duality_gap / of.combined;
                assert!(ratio < SHARP, "{what}: {ratio} {of:?}");
            }
        }
    }
    Ok(())
}

#[test]
fn the_bound_holds_at_any_stop_for_all_signs_of_both_ends() -> Result<()> {
    for (ends, text) in some(4, all()) {
        for (name, mesh) in meshes(4).into_iter().take(2) {
            holds(&format!("{ends}, {name}"), &text, mesh, &STOPS, false)?;
        }
    }
    Ok(())
}

/// Wherever sweeps end, the bound is the identity too; so it is for limits that hardly let anything through, and for huge ones.
#[test]
fn the_bound_is_the_identity_at_any_stop() -> Result<()> {
    let units = [1.0, 1e-12, 1e12].map(|unit| [0.0, 1.5 * unit]);
    for (name, mesh) in meshes(6) {
        for text in some(3, [three_states()].into_iter().chain(units.map(two_transitions))) {
            holds(name, &text, mesh.clone(), &[0, 2, 30], true)?;
        }
    }
    Ok(())
}

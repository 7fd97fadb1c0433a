//! The bound of condensed contact with two ends: above every error, near that of the mesh.

use std::path::Path;

use signorini_tolerances::solve::{GUARANTEE_LIMITED, IDENTITY_LIMITED, SAME_LIMITED};

use super::limits::limited;
use super::*;
use crate::{Form, Recovery, recoverable};
use signorini_certify::exact::distance;
use signorini_problem::fixtures::distorted;
use signorini_problem::fixtures::limited::{fading, three_states, two_transitions};
use signorini_scene::mesh;
use signorini_scene::mesh::structured::{Cells, grid};

/// The subject of the bound of (p, x), and its distance from the exact solution.
pub(super) struct Certified {
    pub problem: Problem,
    pub model: CondensedModel,
    pub recovery: Recovery,
}

impl Certified {
    pub fn of(problem: Problem) -> Result<Self> {
        let (model, recovery) = recoverable(&problem)?;
        Ok(Self { problem, model, recovery })
    }

    /// The bound, the combined error, and the square root of what the exact solution says the gap is, both of which it is above.
    pub fn at(&self, what: &str, x: &[f64]) -> Result<[f64; 3]> {
        let p = &self.model.defaults;
        let answer = self.recovery.admissible(&self.model, &self.problem, p, x);
        let exact = self.problem.scene.exact.as_ref().expect("an exact solution");
        let found = distance(exact, &self.problem, &answer.expect("s and τ").admissible())?;
        let bound = self.model.bound(p, x).expect("a bound");
        GUARANTEE_LIMITED.check_at_most(format_args!("{what}: combined"), found.combined, bound);
        GUARANTEE_LIMITED.check_at_most(format_args!("{what}: identity"), found.identity, bound);
        Ok([bound, found.combined, found.identity])
    }

    /// The solution and others, each on a side that there is.
    pub fn trials(&self) -> Vec<(bool, Vec<f64>)> {
        let x = self.model.solve(&self.model.defaults).expect("a solution");
        let ends = self.model.ends_of(&self.model.defaults);
        let allowed = |at: usize, x: f64| match ends[at] {
            [_, f64::INFINITY] => x.max(0.0),
            [f64::NEG_INFINITY, _] => x.min(0.0),
            _ => x,
        };
        let moved = |amount: f64| {
            let moved = |(at, x): (usize, &f64)| {
                let wild = scatter(at + (1e3 * amount) as usize);
                let other = if wild > 0.6 { 0.0 } else { x + amount * wild };
                allowed(at, other)
            };
            (false, x.iter().enumerate().map(moved).collect())
        };
        let mut all: Vec<_> = [0.0, 1e-3, 0.03, 1.0].map(moved).into();
        all.insert(0, (true, x));
        all
    }
}

/// At the solution the bound is the identity, and for any x it is above; all edges with one end infinite among them.
#[test]
fn the_bound_holds_for_any_openings() -> Result<()> {
    let meshes =
        || [grid(8, Cells::Triangles), grid(6, Cells::Quads), distorted(grid(6, Cells::Mixed))];
    for (unit, is_smooth) in [(1.0, false), (1e-9, false), (0.0, true)] {
        for mesh in meshes() {
            let text = if is_smooth { three_states() } else { two_transitions([0.0, 1.5 * unit]) };
            let certified = Certified::of(on_grid(&text, mesh)?.1)?;
            let form = certified.model.certificate.as_ref().expect("a form");
            assert!(is_smooth == (form.span_excess > 0.0), "{}", form.span_excess);
            // In the unit of energy; what is proved of u_D between points is beside it.
            let oscillates = form.oscillation[0] > 1e-4;
            assert_eq!(oscillates, is_smooth, "{:?}", form.oscillation);
            for (is_solution, x) in certified.trials() {
                let [bound, _, identity] = certified.at("any openings", &x)?;
                if is_solution && !oscillates {
                    IDENTITY_LIMITED.check_relative("identity", bound, identity);
                }
            }
        }
    }
    Ok(())
}

/// The catalogue's scenes, where sides of D meet contact above the gap and below it.
#[test]
fn the_bound_is_near_that_of_the_mesh() -> Result<()> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../meshes/limits");
    for name in ["l-tri", "l-quad"] {
        let scene = Scene::read(&folder.join(format!("{name}.toml")))?;
        let problem = Problem::new(&scene, mesh::read(&scene.mesh.value)?)?;
        compare(&problem, 0.0, 1)?;
        let certified = Certified::of(problem)?;
        let x = certified.model.solve(&[1.0]).expect("a solution");
        let counts = states(&x);
        assert!(counts.iter().all(|&count| count > 0), "{counts:?}");
        let form = certified.model.certificate.as_ref().expect("a form");
        let excess: Vec<f64> = form.corners.iter().map(|corner| corner.excess[0]).collect();
        assert!(excess.iter().any(|&e| e < 0.0) && excess.iter().any(|&e| e > 0.0), "{excess:?}");
        let [bound, combined, _] = certified.at(name, &x)?;
        let (_, solution, _) = full_at(&certified.problem, &[1.0])?;
        let of_mesh = solution.bound.expect("a bound").total;
        assert!(bound < 1.1 * of_mesh && bound >= combined && bound < 1.05 * combined);
    }
    Ok(())
}

/// Water beside contact, its level being an input of this pattern.
fn level(limit: &str, pattern: &str) -> String {
    format!(
        "mesh = \"grid\"\n[material.default]\nconductivity = \"1\"\n[boundary.dirichlet]\nkind = \"dirichlet\"\n\
         value = \"0.2*y\"\n[boundary.contact]\nkind = \"contact\"\ngap = \"0\"\nflux = \"-1\"\nlimit = \"{limit}\"\n\
         [input.level]\nof = \"dirichlet\"\nfield = \"value\"\npattern = \"{pattern}\"\n"
    )
}

/// u_D below the gap is an error where the limit is infinite, and has its price where it is not.
#[test]
fn a_dirichlet_value_below_the_gap() -> Result<()> {
    for limit in ["0.5", "inf"] {
        let (_, problem) = on_grid(&level(limit, "1"), grid(4, Cells::Triangles))?;
        let model = condense(&problem)?;
        for (level, is_bounded) in [(0.1, true), (-0.1, limit != "inf")] {
            let p = [1.0, level];
            let x = model.solve(&p).expect("a solution");
            let bound = model.bound(&p, &x);
            assert_eq!(bound.is_some(), is_bounded, "{limit} {level}");
            if let Some(bound) = bound {
                let (_, solution, _) = full_at(&problem, &p)?;
                let of_mesh = solution.bound.expect("a bound").total;
                assert!((0.3..1.1).contains(&(bound / of_mesh)), "{bound} {of_mesh}");
            }
        }
    }
    Ok(())
}

/// Ends that meet at both corners, one of them moved by an input within its range.
#[test]
fn ends_that_meet_have_a_bound() -> Result<()> {
    for mesh in [grid(8, Cells::Triangles), grid(6, Cells::Quads), distorted(grid(6, Cells::Mixed))]
    {
        let mut certified = Certified::of(on_grid(&fading(), mesh)?.1)?;
        for supply in [1.0, 0.05, 3.0] {
            certified.problem = certified.problem.with_inputs(&[supply])?;
            certified.model.defaults[1] = supply;
            for (is_solution, x) in certified.trials() {
                let [bound, combined, _] = certified.at("ends that meet", &x)?;
                assert!(!is_solution || bound < 3.0 * combined, "{supply}: {bound} {combined}");
            }
        }
    }
    Ok(())
}

/// Inputs of an end leave no bound without a range where hi − lo varies along an edge, with the place.
#[test]
fn a_span_that_inputs_change_varies_along_edges_within_ranges_alone() -> Result<()> {
    let room = "[input.room]\nof = \"contact\"\nfield = \"limit\"\npattern = \"1 + x\"\n";
    for (ends, more, is_bounded) in [
        ("flux = \"-0.1*x\", limit = \"1 - 0.1*x\"", room.replace("1 + x", "1"), true),
        ("flux = \"-0.1*x\", limit = \"1\"", room.replace("1 + x", "1"), false),
        ("flux = \"0\", limit = \"1\"", room.to_owned(), false),
        ("flux = \"0\", limit = \"1\"", room.to_owned() + "range = [0, 2]\n", true),
    ] {
        let text = limited(ends, &more)
            .replace("of = \"contact\", field = \"flux\"", "of = \"right\", field = \"flux\"");
        let model = condense(&on_grid(&text, grid(3, Cells::Triangles))?.1)?;
        match model.certificate {
            Ok(Form { span_excess, .. }) => {
                assert!(is_bounded, "{ends}");
                assert_eq!(span_excess > 0.0, more.contains("range"), "{span_excess}");
            }
            Err(reason) => assert!(!is_bounded && reason.contains("input.room"), "{reason}"),
        }
    }
    Ok(())
}

/// An input with the opposite pattern and the opposite value is the same input.
#[test]
fn the_sign_of_a_pattern_does_not_matter() -> Result<()> {
    for limit in ["0.5", "inf"] {
        let [one, other] = ["1", "-1"].map(|pattern| -> Result<f64> {
            let model = condense(&on_grid(&level(limit, pattern), grid(4, Cells::Triangles))?.1)?;
            let p = [1.0, 0.1 * pattern.parse::<f64>().expect("a number")];
            let x = model.solve(&p).expect("a solution");
            Ok(model.bound(&p, &x).expect("a bound"))
        });
        SAME_LIMITED.check_relative(limit, one?, other?);
    }
    Ok(())
}

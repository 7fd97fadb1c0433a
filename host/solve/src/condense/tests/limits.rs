//! Contact whose flux has two ends, condensed: the answers, outputs and bounds of the full solver.

use std::path::Path;

use signorini_tolerances::solve::{CONDENSED, GUARANTEE_LIMITED, IDENTITY_LIMITED, SAME_LIMITED};

use super::*;
use crate::certify::exact::distance;
use crate::condense::{CondensedModel, Form, Measure, Recovery, condense, modal, recoverable};
use crate::fixtures::distorted;
use crate::fixtures::limited::{drawn, three_states, two_transitions, wall};
use crate::reference::ReferenceError;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_scene::mesh::{Mesh, gmsh};

/// Every input of the fixture, with a limit that lets a part of the edge fall below the gap.
pub(super) fn limited(ends: &str, more: &str) -> String {
    let text = ALL.replace("flux = \"-0.1*x^2\"", ends);
    assert_ne!(text, ALL);
    let saturated = "[output.short]\nkind = \"saturated\"\nof = \"contact\"\n\
                     [output.through]\nkind = \"flux\"\nof = \"contact\"\n";
    text + saturated + more
}

/// The ends of the fixture: from below, with a base above, without a lower end, and with both finite ones.
pub(super) const ENDS: [&str; 5] = [
    "flux = \"-0.1*x^2\"\nlimit = \"0.3\"",
    "flux = \"-3\"\nlimit = \"0.2 + 0.1*x\"",
    "flux = \"-inf\"\nlimit = \"0.1*x\"",
    "flux = \"-0.4 - 0.1*x\"\nlimit = \"-0.1*x\"",
    "flux = \"-0.1\"\nlimit = \"1e9\"",
];

/// How many are open, touch, and are at their limit.
fn states(x: &[f64]) -> [usize; 3] {
    let count = |is: fn(f64) -> bool| x.iter().filter(|&&x| is(x)).count();
    [count(|x| x > 0.0), count(|x| x == 0.0), count(|x| x < 0.0)]
}

/// Openings, fluxes and outputs at some inputs of size `amount` around the defaults, and the states of all edges.
fn compare(problem: &Problem, amount: f64, rounds: usize) -> Result<[usize; 3]> {
    let model = condense(problem)?;
    let mut all = [0; 3];
    for round in 0..rounds {
        let moved = model.defaults.iter().enumerate();
        let p: Vec<f64> = moved
            .map(|(at, p)| if at == 0 { 1.0 } else { p + amount * scatter(17 * round + at) })
            .collect();
        let (full, solution, expected) = full_at(problem, &p)?;
        let x = model.solve(&p).expect("a solution");
        states(&x).into_iter().zip(&mut all).for_each(|(count, sum)| *sum += count);
        let scale = solution.largest_flux();
        let found = model.outputs(&p, &x);
        for ((found, expected), measure) in found.iter().zip(&expected).zip(&model.outputs) {
            if *measure != Measure::Bound {
                let (found, expected) = (found.expect("a value"), expected.expect("a value"));
                let size = expected.abs().max(scale);
                CONDENSED.check_over(format_args!("{measure:?}"), found - expected, size);
            }
        }
        let edges = model.edges.iter().zip(&x).zip(model.residual(&p, &x)).enumerate();
        for (at, ((&of_contact, x), r)) in edges {
            let edge = full.topology.counts.free + of_contact;
            let opening = solution.u[edge] - full.loads.gap[of_contact];
            let size = solution.u.iter().fold(0.0, |most: f64, u| most.max(u.abs()));
            CONDENSED.check_over("opening", model.opening[at] * x - opening, size);
            // The base of a model whose ends inputs change is the lower end, that of a scene the smaller one.
            let [least, most] = full.loads.flux_range(of_contact).ends();
            let base = match model.is_varying() && least.is_finite() {
                true => least,
                false if full.loads.flux_range(of_contact).base() == most => most,
                false => least,
            };
            let off = r * model.multiplier[at] - (solution.flux[edge] - base);
            CONDENSED.check_over("flux", off, scale.max(base.abs()));
        }
    }
    Ok(all)
}

#[test]
fn every_input_and_range_on_all_cells() -> Result<()> {
    let mut sums = [0; 3];
    for cells in [Cells::Triangles, Cells::Quads, Cells::Mixed] {
        for ends in ENDS {
            let text = limited(ends, "");
            // No input of an end: `rain` acts on the flux.
            let fixed = text
                .replace("of = \"contact\"\nfield = \"flux\"", "of = \"right\"\nfield = \"flux\"");
            assert_ne!(fixed, text);
            for mesh in [grid(5, cells), distorted(grid(4, cells))] {
                let (_, problem) = on_grid(&fixed, mesh)?;
                let all = compare(&problem, 0.3, 4)?;
                println!("{cells:?} {ends:?}: {all:?}");
                all.into_iter().zip(&mut sums).for_each(|(count, sum)| *sum += count);
            }
        }
    }
    assert!(sums.iter().all(|&count| count > 100), "{sums:?}");
    Ok(())
}

/// Inputs of both ends, which also turn round which end is the smaller one.
#[test]
fn inputs_of_both_ends() -> Result<()> {
    let room =
        "[input.room]\nof = \"contact\"\nfield = \"limit\"\npattern = \"1 + x\"\ndefault = 0.6\n";
    let mut sums = [0; 3];
    for cells in [Cells::Triangles, Cells::Quads] {
        for (ends, more) in [(ENDS[0], room), (ENDS[1], room), (ENDS[1], ""), (ENDS[2], room)] {
            // Without a lower end nothing can be added to it.
            let text = match ends.contains("inf") {
                true => limited(ends, more).replace(
                    "field = \"flux\"\npattern = \"1 + x\"",
                    "field = \"limit\"\npattern = \"1 + x\"",
                ),
                false => limited(ends, more),
            };
            let (_, problem) = on_grid(&text, grid(5, cells))?;
            let model = condense(&problem)?;
            assert!(ends.contains("inf") || model.is_varying(), "{ends}");
            let all = compare(&problem, 0.25, 6)?;
            all.into_iter().zip(&mut sums).for_each(|(count, sum)| *sum += count);
        }
    }
    assert!(sums.iter().all(|&count| count > 30), "{sums:?}");
    Ok(())
}

/// An input that puts the upper end below the lower one is refused.
#[test]
fn a_limit_below_the_flux_is_refused() -> Result<()> {
    let room = "[input.room]\nof = \"contact\"\nfield = \"limit\"\npattern = \"1\"\n";
    let (_, problem) =
        on_grid(&limited("flux = \"0\"\nlimit = \"1\"", room), grid(3, Cells::Triangles))?;
    let model = condense(&problem)?;
    let mut p = model.defaults.clone();
    p[2] = 0.0;
    let last = p.len() - 1;
    for (room, is_refused) in [(0.0, false), (-1.0, false), (-1.001, true)] {
        p[last] = room;
        assert_eq!(model.solve(&p).is_err(), is_refused, "{room}");
    }
    Ok(())
}

/// Ends that are equal, nearly equal, far, and infinite on either side, on two boundaries.
#[test]
fn random_problems_agree_with_the_full_solver() -> Result<()> {
    let mut sums = [0; 3];
    let mut counted = 0;
    for seed in 1..=150 {
        let (text, mesh) = drawn(seed);
        let Ok((_, problem)) = on_grid(&text, mesh) else { continue };
        let all = compare(&problem, 0.0, 1)?;
        all.into_iter().zip(&mut sums).for_each(|(count, sum)| *sum += count);
        counted += 1;
    }
    assert!(counted > 75 && sums.iter().all(|&count| count > 50), "{counted}, {sums:?}");
    Ok(())
}

/// Duvaut and Lions in one dimension.
#[test]
fn walls_heat_as_the_full_model_does() -> Result<()> {
    for (above, ends) in [
        ("2", "flux = \"0\"\nlimit = \"3\""),
        ("0.25", "flux = \"0\"\nlimit = \"3\""),
        ("-1", "flux = \"-2\"\nlimit = \"3\""),
        ("2.5", "flux = \"-inf\"\nlimit = \"0\""),
        ("-1", "flux = \"-1e16\"\nlimit = \"3\""),
        ("0", "flux = \"0.3\"\nlimit = \"1e30\""),
        ("2", "flux = \"1.5\"\nlimit = \"1.5\""),
    ] {
        let (_, problem) = on_grid(&wall(above, ends), grid(4, Cells::Mixed))?;
        compare(&problem, 0.0, 1)?;
    }
    Ok(())
}

/// What the bound of (p, x) is about, and how far it is from the exact solution.
struct Certified {
    problem: Problem,
    model: CondensedModel,
    recovery: Recovery,
}

impl Certified {
    fn new(text: &str, mesh: Mesh) -> Result<Self> {
        let (_, problem) = on_grid(text, mesh)?;
        let (model, recovery) = recoverable(&problem)?;
        Ok(Self { problem, model, recovery })
    }

    /// The bound, the combined error, and the square root of what the exact solution says the gap is.
    fn at(&self, x: &[f64]) -> Result<[f64; 3]> {
        let p = &self.model.defaults;
        let answer = self.recovery.admissible(&self.model, &self.problem, p, x);
        let exact = self.problem.scene.exact.as_ref().expect("an exact solution");
        let found = distance(exact, &self.problem, &answer.expect("s and τ").admissible())?;
        let bound = self.model.bound(p, x).expect("a bound");
        Ok([bound, found.combined, found.identity])
    }

    /// The solution and others, each on a side that there is.
    fn trials(&self) -> Vec<(bool, Vec<f64>)> {
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
            let text = if is_smooth { three_states() } else { two_transitions(unit) };
            let certified = Certified::new(&text, mesh)?;
            let form = certified.model.certificate.as_ref().expect("a form");
            assert!(is_smooth == (form.span_excess > 0.0), "{}", form.span_excess);
            let oscillates = form.oscillation[0] > 0.0;
            for (is_solution, x) in certified.trials() {
                let [bound, combined, identity] = certified.at(&x)?;
                println!(
                    "{unit} {is_solution}: bound/combined {:.4} bound/identity {:.5}",
                    bound / combined,
                    bound / identity
                );
                GUARANTEE_LIMITED.check_at_most("combined", combined, bound);
                GUARANTEE_LIMITED.check_at_most("identity", identity, bound);
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
        let problem = Problem::new(&scene, gmsh::read(&scene.mesh.value)?)?;
        let (model, recovery) = recoverable(&problem)?;
        compare(&problem, 0.0, 1)?;
        let certified = Certified { problem, model, recovery };
        let x = certified.model.solve(&[1.0]).expect("a solution");
        let counts = states(&x);
        assert!(counts.iter().all(|&count| count > 0), "{counts:?}");
        let form = certified.model.certificate.as_ref().expect("a form");
        let excess: Vec<f64> = form.corners.iter().map(|corner| corner.excess[0]).collect();
        assert!(excess.iter().any(|&e| e < 0.0) && excess.iter().any(|&e| e > 0.0), "{excess:?}");
        let [bound, combined, identity] = certified.at(&x)?;
        let (_, solution, _) = full_at(&certified.problem, &[1.0])?;
        let of_mesh = solution.bound.expect("a bound").total;
        println!(
            "{name}: {counts:?} bound/mesh {:.4} bound/combined {:.4} bound/identity {:.5}",
            bound / of_mesh,
            bound / combined,
            bound / identity
        );
        assert!(bound < 1.1 * of_mesh && bound >= combined && bound < 1.05 * combined);
    }
    Ok(())
}

/// u_D below the gap is an error where the limit is infinite, and has its price where it is not.
#[test]
fn a_dirichlet_value_below_the_gap() -> Result<()> {
    let text = |limit: &str| {
        format!(
            "mesh = \"grid\"\n[material.default]\nconductivity = \"1\"\n[boundary.dirichlet]\nkind = \"dirichlet\"\n\
             value = \"0.2*y\"\n[boundary.contact]\nkind = \"contact\"\ngap = \"0\"\nflux = \"-1\"\nlimit = \"{limit}\"\n\
             [input.level]\nof = \"dirichlet\"\nfield = \"value\"\npattern = \"1\"\n"
        )
    };
    for limit in ["0.5", "inf"] {
        let (_, problem) = on_grid(&text(limit), grid(4, Cells::Triangles))?;
        let model = condense(&problem)?;
        for (level, is_bounded) in [(0.1, true), (-0.1, limit != "inf")] {
            let p = [1.0, level];
            let x = model.solve(&p).expect("a solution");
            let bound = model.bound(&p, &x);
            assert_eq!(bound.is_some(), is_bounded, "{limit} {level}");
            if let Some(bound) = bound {
                let (_, solution, _) = full_at(&problem, &p)?;
                let of_mesh = solution.bound.expect("a bound").total;
                println!("{limit} {level}: {}", bound / of_mesh);
                assert!((0.3..1.1).contains(&(bound / of_mesh)), "{bound} {of_mesh}");
            }
        }
    }
    Ok(())
}

/// An infinite limit is none, and one that is far away is like it.
#[test]
fn without_an_end_it_is_the_model_without_limits() -> Result<()> {
    let model = |ends: &str| -> Result<CondensedModel> {
        condense(&on_grid(&ALL.replace("flux = \"-0.1*x^2\"", ends), grid(5, Cells::Mixed))?.1)
    };
    let without = condense(&on_grid(ALL, grid(5, Cells::Mixed))?.1)?;
    let infinite = model("flux = \"-0.1*x^2\"\nlimit = \"inf\"")?;
    assert_eq!(format!("{without:?}"), format!("{infinite:?}"));
    let far = model("flux = \"-0.1*x^2\"\nlimit = \"1e9 - 0.1*x^2\"")?;
    assert!(far.is_limited());
    for round in 0..4 {
        let moved = without.defaults.iter().enumerate();
        let p: Vec<f64> = moved
            .map(|(at, p)| if at == 0 { 1.0 } else { p + 0.3 * scatter(7 * round + at) })
            .collect();
        let [x, other] = [&without, &far].map(|model| model.solve(&p).expect("a solution"));
        x.iter().zip(&other).for_each(|(x, other)| SAME_LIMITED.check("opening", x - other));
        // Openings that extrapolate to below the gap at a vertex cost as much with a huge limit.
        let [a, b] =
            [without.bound(&p, &x), far.bound(&p, &x)].map(|bound| bound.expect("a bound"));
        SAME_LIMITED.check_relative("bound", a, b);
    }
    Ok(())
}

/// lo = hi is a Neumann boundary.
#[test]
fn equal_ends_are_a_given_flux() -> Result<()> {
    let contact = ALL
        .replace("flux = \"-0.1*x^2\"", "flux = \"-0.1*x^2\"\nlimit = \"-0.1*x^2\"")
        .replace("[input.rain]\nof = \"contact\"", "[input.rain]\nof = \"right\"");
    let (head, rest) = contact.split_once("[boundary.contact]\n").expect("contact");
    let (_, rest) = rest.split_once("[input.depth]").expect("an input");
    let (_, rest) = rest.split_once("[input.rain]").expect("another one");
    let neumann = format!(
        "{head}[boundary.contact]\nkind = \"neumann\"\nflux = \"-0.1*x^2\"\n[input.rain]{rest}"
    )
    .replace("[output.force]\nkind = \"force\"\n", "")
    .replace("[output.length]\nkind = \"length\"\nof = \"contact\"\n", "");
    let [one, other] = [(&contact, grid(5, Cells::Mixed)), (&neumann, grid(5, Cells::Mixed))]
        .map(|(text, mesh)| on_grid(text, mesh).and_then(|(_, problem)| condense(&problem)));
    let (one, other) = (one?, other?);
    assert_eq!((one.contact, other.contact), (10, 0));
    let x = one.solve(&one.defaults).expect("a solution");
    let found = one.outputs(&one.defaults, &x);
    let expected = other.outputs(&other.defaults, &[]);
    // Outputs without force and length, depth being an input of the gap alone.
    for (found, expected) in
        [(0, 0), (1, 1), (2, 2), (5, 3), (7, 5)].map(|(a, b)| (found[a], expected[b]))
    {
        SAME_LIMITED.check("output", found.expect("a value") - expected.expect("a value"));
    }
    let bounds = [found[6], expected[4]].map(|bound| bound.expect("a bound"));
    println!("bound with contact {} without {}", bounds[0], bounds[1]);
    assert!(bounds[0] > 0.8 * bounds[1] && bounds[0] < 3.0 * bounds[1], "{bounds:?}");
    Ok(())
}

/// A part that contact with limits alone holds: loads that its fluxes can balance.
#[test]
fn a_part_that_contact_with_limits_holds() -> Result<()> {
    let text = "mesh = \"grid\"\n[material.default]\nconductivity = \"1\"\n[boundary.default]\nkind = \"neumann\"\n\
        flux = \"0.2*sin(2*x) - 0.3\"\n[boundary.contact]\nkind = \"contact\"\ngap = \"0.02*cos(3*x)\"\nflux = \"-0.4\"\n\
        limit = \"0.9\"\n[source]\nf = \"0\"\n[input.heat]\nof = \"source\"\nfield = \"f\"\npattern = \"1 + x\"\n";
    let mut sums = [0; 3];
    for cells in [Cells::Triangles, Cells::Quads] {
        let (_, problem) = on_grid(text, grid(5, cells))?;
        let model = condense(&problem)?;
        assert_eq!(model.held_by_contact.len(), 1);
        for heat in [-0.2, 0.0, 0.5, 0.9] {
            let p = [1.0, heat];
            let x = model.solve(&p).expect("a solution");
            states(&x).into_iter().zip(&mut sums).for_each(|(count, sum)| *sum += count);
            let (_, solution, _) = full_at(&problem, &p)?;
            let of_mesh = solution.bound.expect("a bound").total;
            let bound = model.bound(&p, &x).expect("a bound");
            println!("{heat}: {:?} {}", states(&x), bound / of_mesh);
            assert!((0.5..1.1).contains(&(bound / of_mesh)), "{bound} {of_mesh}");
            compare(&problem.with_inputs(&[heat])?, 0.0, 1)?;
        }
        // ∫f = 2 heat against −1.2 at sides and top, and −0.8 to 1.8 below.
        for heat in [-0.31, 1.01] {
            assert!(
                matches!(model.solve(&[1.0, heat]), Err(ReferenceError::Unbounded { .. })),
                "{heat}"
            );
        }
    }
    assert!(sums.iter().all(|&count| count > 0), "{sums:?}");
    Ok(())
}

/// Inputs of an end leave no bound where hi − lo varies along an edge, with the place.
#[test]
fn a_span_that_inputs_change_must_be_constant_along_edges() -> Result<()> {
    let room = "[input.room]\nof = \"contact\"\nfield = \"limit\"\npattern = \"1 + x\"\n";
    for (ends, more, is_bounded) in [
        ("flux = \"-0.1*x\"\nlimit = \"1 - 0.1*x\"", room.replace("1 + x", "1"), true),
        ("flux = \"-0.1*x\"\nlimit = \"1\"", room.replace("1 + x", "1"), false),
        ("flux = \"0\"\nlimit = \"1\"", room.to_owned(), false),
    ] {
        let text = limited(ends, &more)
            .replace("of = \"contact\"\nfield = \"flux\"", "of = \"right\"\nfield = \"flux\"");
        let model = condense(&on_grid(&text, grid(3, Cells::Triangles))?.1)?;
        match model.certificate {
            Ok(Form { span_excess, .. }) => assert!(is_bounded && span_excess == 0.0, "{ends}"),
            Err(reason) => assert!(!is_bounded && reason.contains("input.room"), "{reason}"),
        }
    }
    Ok(())
}

/// A model of modes has the same spans at every coefficient.
#[test]
fn modes_keep_their_limits() -> Result<()> {
    let input = "[input.h]\nof = \"left\"\nfield = \"coefficient\"\npattern = \"1\"\ndefault = 1.5\nrange = [-1.0, 100.0]\n";
    let text = limited(ENDS[3], input)
        .replace("of = \"contact\"\nfield = \"flux\"", "of = \"right\"\nfield = \"flux\"");
    let (_, problem) = on_grid(&text, grid(4, Cells::Mixed))?;
    let (modes, _) = modal(&problem)?;
    for value in [-1.0, 1.5, 30.0] {
        let model = modes.at(value);
        let x = model.solve(&model.defaults).expect("a solution");
        let (_, solution, expected) = full_at(&problem, &model.defaults)?;
        let found = model.outputs(&model.defaults, &x);
        for ((found, expected), measure) in found.iter().zip(&expected).zip(&model.outputs) {
            if *measure != Measure::Bound {
                let off = found.expect("a value") - expected.expect("a value");
                CONDENSED.check_over(format_args!("{measure:?}"), off, solution.largest_flux());
            }
        }
    }
    Ok(())
}

//! Intervals of outputs of a step hold those of the same step on finer meshes, from the same s_old.

use std::collections::BTreeMap;
use std::path::Path;

use signorini_certify::cell::Cell;
use signorini_intervals::{Coverage, OutputBound, of_answer};
use signorini_problem::Problem;
use signorini_problem::field::CellField;
use signorini_problem::fixtures::with_four_sides;
use signorini_problem::functional::Functional;
use signorini_problem::quadrature::gauss;
use signorini_scene::mesh::structured::{Cells, Trapezoids, grid, trapezoids};
use signorini_scene::setting::ModelKind;
use signorini_scene::{Mesh, Scene};
use signorini_session::tick::{ScheduledTick, TickInterval, replay};
use signorini_solve::{Options, ScalarKind, Solution, SolverKind, solve};
use signorini_tolerances::{is_whole, some};

use super::super::finer_answer;
use super::{PLAIN, ROBIN, bound_over_error, materials, second_step};

const HELD: &str = "kind = \"dirichlet\"\nvalue = 0.1";
const WALL: &str = "kind = \"neumann\"\nflux = 0.2";

/// Outputs of every kind: the middle is a cell.
const OUTPUTS: &str = r#"
[output.force]
kind = "force"
[output.skin]
kind = "mean"
of = "contact"
[output.wall]
kind = "mean"
of = "right"
[output.through]
kind = "flux"
of = "left"
[output.roof]
kind = "flux"
of = "dirichlet"
[output.middle]
kind = "probe"
at = [0.03, 0.51]
"#;

/// f changes its sign in the second step, so that contact travels.
fn scene(dt: f64, material: &str, contact: &str, left: &str) -> Scene {
    let text = format!(
        "mesh = \"grid\"\n[material.default]\n{material}\n\
         [source]\nf = \"10*sign(1.5 - t/{dt})*(1 + x*y)\"\n\
         [boundary.dirichlet]\nkind = \"dirichlet\"\nvalue = 0.1\n[boundary.left]\n{left}\n\
         [boundary.right]\n{WALL}\n[boundary.contact]\nkind = \"contact\"\n{contact}\n\
         [time]\nstep = {dt}\ninitial = 0.05\n{OUTPUTS}"
    );
    Scene::parse(&text, Path::new("step.toml")).unwrap()
}

/// The mean of s of a finer answer over the cell of a probe on the coarser mesh.
fn mean_over(coarse: &Problem, cell: usize, (fine, answer): (&Problem, &Solution)) -> f64 {
    let none = vec![0.0; coarse.ends.len()];
    let whole = CellField::new(coarse, cell, &none, &none);
    let s = answer.certified.admissible();
    let [mut sum, mut area] = [0.0; 2];
    for at in 0..fine.cells() {
        let part = Cell::of(fine, at);
        if whole.locate(part.middle()).is_some() {
            let s = s.chordal(fine, at);
            for point in part.points(&gauss(4)) {
                sum += point.weight * s.at(&part.local(point.reference)).value;
                area += point.weight;
            }
        }
    }
    sum / area
}

/// Half-widths over the errors of the middles, and how many outputs have an interval.
fn check(scene: &Scene, mesh: Mesh, scalar: ScalarKind, sweeps: Option<u32>, of: &str) -> Vec<f64> {
    let (problem, answer) = second_step(scene, with_four_sides(mesh), scalar, sweeps);
    let (fine, truth) = finer_answer(&problem, 2).unwrap();
    let its = of_answer(&fine, &(&truth).into(), Coverage::Usual);
    let mut ratios = Vec::new();
    for (name, found) in of_answer(&problem, &(&answer).into(), Coverage::Usual) {
        let Ok(OutputBound { center, plus_minus, .. }) = found else {
            println!("  {of} {name}: {}", found.unwrap_err());
            continue;
        };
        let output = scene.outputs.iter().find(|output| output.name.value == name).unwrap();
        let [value, slack] = match (Functional::of(&problem, output).unwrap(), &its[&name]) {
            (Functional::Probe(cell, _), _) => [mean_over(&problem, cell, (&fine, &truth)), 0.0],
            (_, Ok(finer)) => [finer.center, finer.plus_minus],
            (_, Err(why)) => {
                println!("  {of} {name} on the finer mesh: {why}");
                continue;
            }
        };
        let off = (value - center).abs();
        println!(
            "  {of} {name}: {center:.6} ± {plus_minus:.2e}, truth {value:.6} ± {slack:.1e}, ratio {:.2}",
            plus_minus / off
        );
        assert!(
            off - slack <= plus_minus,
            "{of} {name}: {value} ± {slack}, {center} ± {plus_minus}"
        );
        ratios.push(plus_minus / off);
    }
    ratios
}

#[test]
fn intervals_of_steps_hold_at_every_step_length() {
    for cells in [Cells::Triangles, Cells::Quads, Cells::Mixed] {
        for (exponent, scalar) in (-4..=4).zip([ScalarKind::F64, ScalarKind::F32].iter().cycle()) {
            let scene = scene(10_f64.powi(exponent), PLAIN, "", ROBIN);
            let of = format!("{cells:?} {scalar:?} dt 1e{exponent}");
            check(&scene, grid(4, cells), *scalar, None, &of);
        }
    }
}

/// Half of the domain may store nothing, sweeps may end anywhere, and contact alone may hold the domain.
#[test]
fn intervals_of_steps_hold_with_limits_layers_and_few_sweeps() {
    let [layers, none_below] = materials();
    let mut ratios = Vec::new();
    for (name, material, contact, left) in [
        ("limits", PLAIN, "limit = 0.8", HELD),
        ("both", PLAIN, "flux = -0.4\nlimit = 0.4", ROBIN),
        ("layers", &layers, "", HELD),
        ("none below", &none_below, "limit = 0.8", ROBIN),
        ("moving gap", PLAIN, "gap = \"0.1*sin(1e3*t)\"", WALL),
    ] {
        let meshes = [
            grid(4, Cells::Triangles),
            grid(4, Cells::Mixed),
            trapezoids(4, Trapezoids::Everywhere),
        ];
        for (number, mesh) in meshes.into_iter().enumerate() {
            let ends = [(1e-4, Some(1)), (1e-2, None), (1e-2, Some(3)), (1.0, Some(10))];
            for (dt, sweeps) in some(2, ends) {
                let scene = scene(dt, material, contact, left);
                let of = format!("{name} {number} dt {dt:e} {sweeps:?}");
                ratios.extend(check(&scene, mesh.clone(), ScalarKind::F64, sweeps, &of));
            }
        }
    }
    ratios.sort_by(f64::total_cmp);
    println!("{} intervals, median {}", ratios.len(), ratios[ratios.len() / 2]);
    let least = if is_whole() { 250 } else { 125 };
    assert!(ratios.len() > least && ratios[ratios.len() / 2] < 60.0, "{ratios:?}");
}

/// The second tick of the controller that `bake` writes: the step that it is about, its answer, and the ends of each output's interval.
fn of_controller(scene: &Scene, mesh: Mesh) -> (Problem, Solution, Vec<TickInterval>) {
    let problem = Problem::new(scene, mesh).unwrap();
    let dt = scene.step().unwrap();
    let moments = [1.0, -1.0]
        .map(|heat| ScheduledTick { time: dt * (1.5 - 0.5 * heat), inputs: vec![(0, heat)] });
    let mut answers = Vec::new();
    let (model, _) =
        replay(&problem, &moments, (Some(ScalarKind::F64), false), |tick, solution| {
            answers.push((solution.unwrap().clone(), tick.intervals.clone()));
            Ok(())
        })
        .unwrap();
    let is_full = scene.setting.unwrap().model == Some(ModelKind::Full);
    assert!(model.starts_with(if is_full { "full" } else { "condensed" }), "{model}");
    let [(before, _), (last, intervals)] = answers.try_into().unwrap();
    let mut step = problem;
    step.set(&moments[1].inputs, moments[1].time).unwrap();
    (step.stepping(dt, before.state()).unwrap(), last, intervals)
}

/// f by an input that the ticks set, in the model that `setting` asks for.
fn driven(scene: &Scene, setting: &str) -> Scene {
    let source = scene.text.lines().find(|line| line.starts_with("f = ")).unwrap();
    let text = scene.text.replace(source, "f = 0");
    let input = "[input.heat]\nof = \"source\"\nfield = \"f\"\npattern = \"10*(1 + x*y)\"\ndefault = 0\nrange = [-1, 1]\n";
    Scene::parse(&format!("{text}{input}[setting]\n{setting}\n"), Path::new("step.toml")).unwrap()
}

/// Sweeps end early where contact alone holds the domain: nothing may leave it through a side that is insulated.
#[test]
fn bounds_of_controllers_hold_where_nothing_else_holds() {
    let insulated = "kind = \"neumann\"\nflux = 0";
    for contact in ["", "limit = 0.2"] {
        for (cells, dt) in [(Cells::Triangles, 0.1), (Cells::Mixed, 5.0), (Cells::Quads, 1e3)] {
            for sweeps in [1, 3, 40] {
                let scene = super::scene(dt, PLAIN, contact, insulated);
                let scene = driven(&scene, &format!("model = \"full\"\nsweeps = {sweeps}"));
                let (step, last, _) = of_controller(&scene, grid(4, cells));
                let of = format!("{contact} {cells:?} dt {dt:e} {sweeps}");
                bound_over_error(&(step, last), &of);
            }
        }
    }
}

/// Through contact may leave what cells that store nothing lack of balance, where nothing else holds: no interval of a force is told.
#[test]
fn controllers_have_no_intervals_where_nothing_else_holds() {
    let [_, none_below] = materials();
    let scene = super::scene(0.1, &none_below, "", "kind = \"neumann\"\nflux = 0");
    let scene = driven(&scene, "model = \"full\"\nsweeps = 3\n[output.force]\nkind = \"force\"");
    let (.., intervals) = of_controller(&scene, grid(4, Cells::Triangles));
    let why = intervals[0].as_ref().unwrap_err();
    assert!(why.contains("holds some part of the domain"), "{why}");
}

/// Forces and fluxes of controllers, with sweeps that end early, a limit, and a part that stores nothing.
#[test]
fn intervals_of_controllers_hold_in_steps() {
    // Through all of the boundary passes what cells store, which the norm of the storage alone weighs.
    const ALL: &str =
        "[output.all]\nkind = \"flux\"\nof = [\"dirichlet\", \"left\", \"contact\"]\n";
    let [layers, none_below] = materials();
    let mut known = BTreeMap::<&str, usize>::new();
    for (material, contact, left) in [
        (PLAIN, "limit = 0.8", HELD),
        (PLAIN, "flux = -0.4\nlimit = 0.4", ROBIN),
        (&layers, "", ROBIN),
        (&none_below, "limit = 0.8", HELD),
    ] {
        for (model, setting) in [("full", ""), ("full", "sweeps = 3"), ("condensed", "memory = 4")]
        {
            for (cells, dt) in [(Cells::Triangles, 1e-3), (Cells::Mixed, 0.03), (Cells::Quads, 1.0)]
            {
                let scene = scene(dt, material, contact, left);
                let scene = driven(&scene, &format!("model = \"{model}\"\n{setting}\n{ALL}"));
                let (step, _, intervals) = of_controller(&scene, with_four_sides(grid(4, cells)));
                let (fine, truth) = finer_answer(&step, 2).unwrap();
                let its = of_answer(&fine, &(&truth).into(), Coverage::Usual);
                for (output, found) in scene.outputs.iter().zip(intervals) {
                    let name = output.name.value.as_str();
                    let (Ok([least, most]), Ok(truth)) = (found, &its[name]) else { continue };
                    let of = format!("{model} {setting} {cells:?} {dt} {contact} {name}");
                    let [low, high] = truth.ends();
                    println!("{of}: {low} to {high} in {least} to {most}");
                    assert!(
                        low <= most && high >= least,
                        "{of}: {low} to {high}, {least} to {most}"
                    );
                    *known.entry(model).or_default() += 1;
                }
            }
        }
    }
    assert_eq!((known["full"], known["condensed"]), (12, 30));
}

/// A long step is the steady problem.
#[test]
fn intervals_of_long_steps_are_those_of_the_steady_problem() {
    for (cells, left) in [(Cells::Triangles, ROBIN), (Cells::Quads, HELD), (Cells::Mixed, ROBIN)] {
        let scene = scene(1e10, PLAIN, "", left);
        let (step, answer) =
            second_step(&scene, with_four_sides(grid(4, cells)), ScalarKind::F64, None);
        let mut steady = Problem::new(&scene, (*step.mesh).clone()).unwrap();
        steady.set_time(step.time).unwrap();
        let options = Options { solver: SolverKind::Factor, averages: true, ..Options::default() };
        let at_rest = solve(&steady, &options).unwrap();
        let expected = of_answer(&steady, &(&at_rest).into(), Coverage::Usual);
        for (name, found) in of_answer(&step, &(&answer).into(), Coverage::Usual) {
            let (found, expected) = match (found, expected[&name].clone()) {
                (Ok(found), Ok(expected)) => (found, expected),
                (found, expected) => {
                    assert_eq!(found, expected);
                    continue;
                }
            };
            let by = (found.center - expected.center)
                .abs()
                .max((found.plus_minus - expected.plus_minus).abs());
            assert!(by < 1e-6 * expected.plus_minus, "{cells:?} {name}: {found:?} {expected:?}");
        }
    }
}

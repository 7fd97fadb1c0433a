//! Forces of the standard scenes wherever a solver is stopped, in every model and scalar: never of the wrong sign,
//! and the sums that the law of contact makes of what the edges' table holds.
//!
//! ```text
//!   λ_E = max(σ·n − q, 0) |E| where u_E = ψ_E, else 0      σ·n by formula (15)
//! ```
//! The plain sum of σ·n − q, which a force is for the solution, is negative at some of these stops: a test in which
//! it never is tests nothing.

use signorini_bake::{Bakes, condensed, full};
use signorini_condense::{CondensedModel, Recovery, recoverable};
use signorini_device::tick::Limits;
use signorini_problem::Problem;
use signorini_scene::scene::{Input, Output, Quantity, Scene};
use signorini_scene::setting::Setting;
use signorini_solve::outputs::outputs;
use signorini_solve::{Options, ScalarKind, Solution, SolverKind, solve};
use signorini_tests::random::Random;
use signorini_tolerances::Tolerance;
use signorini_tolerances::twins::{
    FORCE_OF_CONDENSED, FORCE_OF_EDGES, FORCE_OF_EDGES_NARROW, LEFT_OPEN,
};

use crate::standard::{SCENES, moved, standard};

/// The first sweeps one by one, then some of the next hundreds.
fn stops(random: &mut Random) -> Vec<u32> {
    let mut late = || 9 + random.below(300);
    (1..9).chain([late(), late(), late()]).collect()
}

/// Sums of the table of edges.
#[derive(Debug)]
struct Table {
    /// Σ λ
    law: f64,
    /// Σ (σ·n − q)
    plain: f64,
    /// Σ |σ·n| + |q|
    size: f64,
}

/// `flux` is that of every edge, `touches` tells it of every contact edge.
fn table(problem: &Problem, flux: &[f64], touches: impl Fn(usize) -> bool) -> Table {
    let mut table = Table { law: 0.0, plain: 0.0, size: 0.0 };
    let on_contact = flux[problem.topology.counts.free..].iter().zip(&problem.loads.contact_flux);
    for (at, (flux, q)) in on_contact.enumerate() {
        table.law += if touches(at) { (flux - q).max(0.0) } else { 0.0 };
        table.plain += flux - q;
        table.size += flux.abs() + q.abs();
    }
    table.size = table.size.max(f64::MIN_POSITIVE);
    table
}

/// Sums of a solve's table.
fn table_of(problem: &Problem, found: &Solution) -> Table {
    let free = problem.topology.counts.free;
    table(problem, &found.flux, |at| found.u[free + at] == found.gap(problem, at))
}

/// Outputs that must not be negative: forces, and fluxes out of the levee's face, where q = 0.
fn signed<'s>(scene: &'s Scene, values: &'s [f64]) -> impl Iterator<Item = (&'s str, f64)> {
    let keeps = |quantity| matches!(quantity, Quantity::Force | Quantity::Flux);
    let pairs = scene.outputs.iter().zip(values).filter(move |(output, _)| keeps(output.quantity));
    pairs.map(|(output, value)| (output.name.value.as_str(), *value))
}

/// Values of the inputs about as large as in use, within their ranges: rain is never below 0.
fn inputs(scene: &Scene, random: &mut Random) -> Vec<f64> {
    let near = |name: &str| match name {
        "air" => 2.0,
        "depth" => 0.1,
        _ => 0.2,
    };
    let value = |input: &Input| moved(input, near(&input.name.value) * random.between(-2.0, 2.0));
    scene.inputs.iter().map(value).collect()
}

/// The problem for these inputs.
fn posed(problem: &Problem, inputs: &[f64]) -> Problem {
    problem.with_inputs(inputs).expect("data that are admissible")
}

#[test]
fn solves_that_are_cut_off() {
    let mut random = Random::new(5);
    let mut pulled = 0;
    for name in SCENES {
        let problem = standard(name);
        let kinds = [(ScalarKind::F64, FORCE_OF_EDGES), (ScalarKind::F32, FORCE_OF_EDGES_NARROW)];
        for (scalar, allowed) in kinds {
            for max_sweeps in stops(&mut random) {
                let options =
                    Options { scalar, max_sweeps: Some(max_sweeps), ..Options::default() };
                let found = solve(&problem, &options).expect("an answer");
                let table = table_of(&problem, &found);
                let what = format!("{name}, {scalar:?}, {max_sweeps} sweeps");
                let force = found.contact_force;
                assert!(force >= 0.0, "{what}: {force} {table:?}");
                allowed.check(&what, (force - table.law) / table.size);
                let values = outputs(&problem, &found).expect("outputs");
                let value = |output: &Output| values[&output.name.value].unwrap_or_default();
                let values: Vec<_> = problem.scene.outputs.iter().map(value).collect();
                for (output, value) in signed(&problem.scene, &values) {
                    assert!(value >= 0.0, "{what}, {output}: {value}");
                }
                pulled += u32::from(table.plain < 0.0);
            }
        }
    }
    assert!(pulled > 10, "{pulled}");
}

#[test]
fn solutions_have_the_forces_of_the_plain_sum() {
    for name in SCENES {
        let problem = standard(name);
        for solver in [SolverKind::Kernel, SolverKind::Direct] {
            let options = Options { solver, ..Options::default() };
            let found = solve(&problem, &options).expect("an answer");
            let table = table_of(&problem, &found);
            let what = format!("{name}, {solver:?}");
            FORCE_OF_EDGES.check(&what, (found.contact_force - table.law) / table.size);
            // As much as the solver leaves of λ on open edges.
            LEFT_OPEN.check(&what, (found.contact_force - table.plain) / table.size);
        }
    }
}

/// Ticks of a full model by its own controller; returns how often the plain sum was negative.
fn ticks<R: Bakes>(what: &str, problem: &Problem, allowed: Tolerance, random: &mut Random) -> u32 {
    let mut pulled = 0;
    let baked = full::Baked::<R>::new(problem).expect("a full model");
    let (units, free) = (baked.units(), problem.topology.counts.free);
    for sweeps in stops(random) {
        let mut controller = full::Controller::<R>::new(&baked);
        for _ in 0..3 {
            let p = inputs(&problem.scene, random);
            let narrow: Vec<R> = p.iter().map(|&p| R::narrow(p)).collect();
            let limits = Limits { sweeps, share: R::ZERO, error: R::ZERO };
            let (values, report) = controller.tick_within(&narrow, limits).expect("a tick");
            let flux: Vec<_> =
                controller.numbers().tau.iter().map(|x| x.wide() * units.flux()).collect();
            let touches = |at: usize| controller.u()[free + at] == controller.lower()[at];
            let table = table(&posed(problem, &p), &flux, touches);
            let force = report.figures.force.wide();
            let said = || format!("{what}, {sweeps} sweeps, {p:?}: {force} {values:?} {table:?}");
            assert!(force >= 0.0, "{}", said());
            allowed.check(what, (force - table.law) / table.size);
            let values: Vec<_> = values.iter().map(|value| value.wide()).collect();
            for (_, value) in signed(&problem.scene, &values) {
                assert!(value >= 0.0, "{}", said());
            }
            pulled += u32::from(table.plain < 0.0);
        }
    }
    pulled
}

fn full_models<R: Bakes>(allowed: Tolerance) {
    let mut random = Random::new(7);
    let mut pulled = [0; 2];
    for name in SCENES.into_iter().filter(|name| *name != "membrane") {
        let problem = standard(name);
        for certificate in [false, true] {
            let setting = Some(Setting { certificate, ..Setting::default() });
            let problem = problem.with_setting(setting);
            let what = format!("{name}, {}, certificate: {certificate}", R::NAME);
            pulled[usize::from(certificate)] += ticks::<R>(&what, &problem, allowed, &mut random);
        }
    }
    // τ of a certificate keeps the law itself.
    assert!(pulled[0] > 0 && pulled[1] == 0, "{pulled:?}");
}

#[test]
fn full_models_that_are_cut_off_in_f64() {
    full_models::<f64>(FORCE_OF_EDGES);
}

#[test]
fn full_models_that_are_cut_off_in_f32() {
    full_models::<f32>(FORCE_OF_EDGES_NARROW);
}

/// The effect of rounding on Σ w max(r, 0): ε of each term of r, once for every term.
fn rounding<R: Bakes>(of: &CondensedModel, p: &[f64], x: &[f64]) -> f64 {
    let size = |i: usize| {
        let row = &of.matrix[i * of.contact..(i + 1) * of.contact];
        let of_x: f64 = row.iter().zip(x).map(|(entry, x)| (entry * x).abs()).sum();
        let of_p: f64 = of.load.iter().zip(p).map(|(column, p)| (column[i] * p).abs()).sum();
        of.multiplier[i] * (of_x + of_p)
    };
    let terms = (of.contact + of.inputs + 4) as f64;
    terms * R::EPSILON.wide() * (0..of.contact).map(size).sum::<f64>()
}

/// Condensed ticks: the edges' table follows from the fields of all columns.
fn condensed_ticks<R: Bakes>(
    name: &str,
    problem: &Problem,
    (condensate, recovery): (&CondensedModel, &Recovery),
    random: &mut Random,
) -> u32 {
    let mut pulled = 0;
    for sweeps in stops(random) {
        let work = condensed::Work { pivots: None, sweeps };
        let baked = condensed::Baked::<R>::new(condensate, work, true).expect("a condensed model");
        let mut controller = condensed::Controller::new(&baked);
        for _ in 0..3 {
            let p = inputs(&problem.scene, random);
            let narrow: Vec<R> = p.iter().map(|&p| R::narrow(p)).collect();
            let (values, _) = controller.tick(&narrow).expect("a tick");
            let x: Vec<f64> = controller.x().iter().map(|x| x.wide()).collect();
            let all: Vec<f64> = std::iter::once(1.0).chain(p.iter().copied()).collect();
            let (_, flux) = recovery.field(condensate, &all, &x);
            let by_edge = condensate.by_edge(&x);
            let table = table(&posed(problem, &p), &flux, |at| by_edge[at] == 0.0);
            let size = rounding::<R>(condensate, &all, &x) + 1e-9 * table.size;
            let values: Vec<_> = values.iter().map(|value| value.wide()).collect();
            for (output, value) in signed(&problem.scene, &values) {
                let what = format!("{name}, {}, {sweeps} sweeps, {p:?}, {output}", R::NAME);
                assert!(value >= 0.0, "{what}: {value} {table:?}");
                // The levee's is about one of its two contact boundaries.
                if name != "levee" {
                    FORCE_OF_CONDENSED.check_over(&what, value - table.law, size);
                }
            }
            pulled += u32::from(table.plain < 0.0);
        }
    }
    pulled
}

#[test]
fn condensed_models_that_are_cut_off() {
    let mut random = Random::new(9);
    let mut pulled = [0; 2];
    for name in SCENES {
        let problem = standard(name);
        let (condensate, recovery) = recoverable(&problem).expect("a condensate");
        let condensed = (&condensate, &recovery);
        pulled[0] += condensed_ticks::<f64>(name, &problem, condensed, &mut random);
        pulled[1] += condensed_ticks::<f32>(name, &problem, condensed, &mut random);
    }
    assert!(pulled.iter().all(|&pulled| pulled > 0), "{pulled:?}");
}

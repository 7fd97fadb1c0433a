//! Solves that were cut off: the bound after a few sweeps, beside the true error.

use std::path::PathBuf;

use serde::Serialize;

use super::bound::Certified;
use super::checks::Check;
use signorini_draw::{Chart, Column, Curve, Strip, Table};
use signorini_problem::Problem;
use signorini_problem::threads::on_two_threads;
use signorini_scene::{Result, Scene};
use signorini_solve::adaptive::mesh_of_scene;
use signorini_solve::{Options, solve};

/// Sweeps from a cold start.
const STOPS: [u32; 5] = [1, 5, 20, 80, 320];
/// Scenes that are drawn: triangles, quads, an oblique tensor.
const DRAWN: [&str; 3] = ["h-tri", "h-quad", "t-h-tri"];

/// A scene, stopped again and again.
#[derive(Debug, Clone, Serialize)]
pub struct CutOff {
    pub name: String,
    /// After 1, 5, 20, 80 and 320 sweeps, and at convergence.
    pub stops: Vec<Certified>,
    /// gap over the energy error of u_h at each stop; `None` where both are rounding.
    pub efficiency: Vec<Option<f64>>,
    pub checks: Vec<Check>,
}

/// The scenes that have an exact solution, by their names.
pub fn planned(scenes: &[PathBuf]) -> Result<Vec<(String, Scene)>> {
    let read = |path: &PathBuf| {
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        Ok((name, Scene::read(path)?))
    };
    let mut plans = scenes.iter().map(read).collect::<Result<Vec<_>>>()?;
    plans.retain(|(_, scene)| scene.exact.is_some());
    Ok(plans)
}

/// Stops each of these scenes again and again; calls `done` after each.
pub fn run(plans: &[(String, Scene)], done: impl Fn() + Sync) -> Result<Vec<CutOff>> {
    on_two_threads(plans, |(name, scene)| stopped(name, scene), done)
}

fn stopped(name: &str, scene: &Scene) -> Result<CutOff> {
    let problem = Problem::new(scene, mesh_of_scene(scene)?.mesh)?;
    let converged = solve(&problem, &Options::default())?;
    let energy = converged.energy(&problem);
    let (mut stops, mut checks) = (Vec::new(), Vec::new());
    for max_sweeps in STOPS {
        let options = Options { max_sweeps: Some(max_sweeps), ..Options::default() };
        let stop = Certified::new(&problem, &solve(&problem, &options)?)?;
        let subject = format!("{name} after {} sweeps", stop.sweeps);
        checks.extend(stop.when_cut_off(&subject, energy));
        stops.push(stop);
    }
    stops.push(Certified::new(&problem, &converged)?);
    let efficiency = stops.iter().map(|stop| stop.efficiency(energy)).collect();
    Ok(CutOff { name: name.to_owned(), stops, efficiency, checks })
}

/// gap over the energy error of u_h: a row for each scene, a column for each stop.
pub fn table(studies: &[CutOff]) -> Table {
    let stops = STOPS.iter().map(u32::to_string).chain(["converged".to_owned()]).enumerate();
    let stop = |(at, name): (usize, String)| {
        Column::number(&name, move |study: &&CutOff| {
            study.efficiency[at].map_or("–".to_owned(), |ratio| format!("{ratio:.2}"))
        })
    };
    let scene = Column::words("scene", |study: &&CutOff| study.name.clone());
    let columns: Vec<_> = std::iter::once(scene).chain(stops.map(stop)).collect();
    Table::checked(&columns, studies, |study| study.checks.iter().all(|check| check.passed))
}

/// The pictures: the bound, the truth and what more sweeps would remove.
pub fn plots(studies: &[CutOff]) -> Vec<Chart> {
    let drawn = DRAWN.iter().filter_map(|name| studies.iter().find(|study| study.name == *name));
    drawn.map(plot).collect()
}

/// Smaller values, as parts of the largest, are out of sight: all that matters is above.
const DEPTH: f64 = 1e-4;

fn plot(study: &CutOff) -> Chart {
    let curve = |label: &str, pick: fn(&Certified) -> Option<f64>| Curve {
        label: label.to_owned(),
        values: study.stops.iter().map(pick).collect(),
        ..Curve::default()
    };
    let bound =
        curve("guaranteed bound on the error of s, τ", |stop| stop.bound.map(|bound| bound.total));
    let curves = vec![
        Curve { wide: true, ..bound },
        curve("true error of s, τ (energy norms, weighed by A and A⁻¹)", Certified::error),
        curve("algebraic part of the bound", |stop| stop.bound.map(|bound| bound.algebraic)),
    ];
    Chart {
        title: format!("{}, stopped after some sweeps", study.name),
        across: "sweeps".to_owned(),
        at: study.stops.iter().map(|stop| f64::from(stop.sweeps)).collect(),
        strips: vec![Strip { curves, depth: Some(DEPTH), ..Strip::default() }],
    }
}

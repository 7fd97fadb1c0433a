//! Data that change from tick to tick.
//!
//! * A scene with inputs: these are drawn within a tenth of their defaults, as for its firmware. One of a transfer coefficient
//!   stays at its default: it changes the matrix, and all ticks have one.
//! * One without: all its loads (f, u_D, g, ambient) take a factor c + s ξ, ξ in [−1, 1] across the domain, and
//!   what contact asks for (ψ, q, limits) another, c drawn from [0.9, 1.1] and s from [−0.4, 0.4]. One factor alone
//!   would scale the answer and, without gap, leave the contact set.
//! * A scene over time: its own t.

use std::sync::Arc;

use signorini_problem::inputs::{InputSpace, drawn};
use signorini_problem::{Loads, Problem};
use signorini_scene::{Result, Scene};

/// The tilt of loads at most, over the tenth by which inputs are drawn: less would leave the contact set of
/// a coarse mesh where it is.
const TILT: f64 = 4.0;

/// The factor level + slope (x − middle) of loads.
struct Factor {
    level: f64,
    slope: f64,
    middle: f64,
}

impl Factor {
    /// `tilt` is what it gains from the middle of the domain to its right end.
    fn across(problem: &Problem, level: f64, tilt: f64) -> Self {
        let x = || problem.mesh.vertices.iter().map(|vertex| vertex[0]);
        let (low, high) =
            (x().fold(f64::INFINITY, f64::min), x().fold(f64::NEG_INFINITY, f64::max));
        let slope = tilt / (0.5 * (high - low)).max(f64::MIN_POSITIVE);
        Self { level, slope, middle: 0.5 * (low + high) }
    }

    /// In the middle of some points.
    fn among<const N: usize>(&self, points: [[f64; 2]; N]) -> f64 {
        let x = points.iter().map(|point| point[0]).sum::<f64>() / N as f64;
        self.level + self.slope * (x - self.middle)
    }
}

/// The loads of the scene as it stands, then of `ticks` others.
pub(super) fn load_cases(problem: &Problem, ticks: usize) -> Result<Vec<Loads>> {
    if !problem.scene.inputs.is_empty() {
        let spaces = InputSpace::of(&problem.scene);
        return drawn::<f64>(&spaces, ticks).map(|values| with_inputs(problem, &values)).collect();
    }
    let spaces = [1.0, 1.0, 0.0].map(InputSpace::near);
    let scaled = |(tick, f): (usize, Vec<f64>)| {
        let tilt = if tick == 0 { 0.0 } else { TILT * f[2] };
        let mut loads = Loads::of(problem)?;
        scale(&mut loads, problem, &Factor::across(problem, f[0], tilt), f[1]);
        Ok(loads)
    };
    drawn::<f64>(&spaces, ticks).enumerate().map(scaled).collect()
}

fn with_inputs(problem: &Problem, values: &[f64]) -> Result<Loads> {
    let mut scene = Scene::clone(&problem.scene);
    let inputs = scene.inputs.iter_mut().zip(values);
    let of_loads = inputs.filter(|(input, _)| input.field.value.is_load());
    of_loads.for_each(|(input, value)| input.default = *value);
    Loads::of(&Problem { scene: Arc::new(scene), ..problem.clone() })
}

/// Multiplies f, u_D, g and the ambient by a factor that varies, and ψ, q and limits by another.
fn scale(loads: &mut Loads, problem: &Problem, factor: &Factor, of_contact: f64) {
    let corner = |vertex: u32| problem.mesh.vertices[vertex as usize];
    for (load, cell) in loads.triangles.iter_mut().zip(&problem.mesh.triangles) {
        *load *= factor.among(cell.map(corner));
    }
    for (load, cell) in loads.quads.iter_mut().zip(&problem.mesh.quads) {
        *load *= factor.among(cell.map(corner));
    }
    let on_edge = |edge: usize| factor.among(problem.segment(edge));
    let first = problem.topology.counts.unknowns();
    let given = loads.dirichlet.iter_mut().enumerate();
    given.for_each(|(at, value)| *value *= on_edge(first + at));
    loads.neumann.iter_mut().for_each(|record| record.flux *= on_edge(record.edge as usize));
    loads.robin.iter_mut().for_each(|record| record.ambient *= on_edge(record.edge as usize));
    let contact = loads.gap.iter_mut().chain(&mut loads.contact_flux).chain(&mut loads.spans);
    contact.for_each(|value| *value *= of_contact);
}

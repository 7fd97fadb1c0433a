//! Warnings on what materials store.

use super::cell::Cell;
use super::quadrature::gauss;
use super::{Problem, Sum, tensors};
use signorini_kernel::Tensor;
use signorini_scene::scene::Material;

/// Points per direction that see a capacity vary inside a cell.
const POINTS: usize = 3;

/// A capacity that varies by less than this part of itself is constant.
const CONSTANT: f64 = 1e-9;

/// k h²/α above which nothing diffuses across a cell in a step: what is stored is all that counts, sweep by sweep.
const STIFF: f64 = 1e4;

/// The sentences.
pub(super) fn warnings(problem: &Problem) -> Vec<String> {
    if !problem.scene.stores() {
        return Vec::new();
    }
    let all = [in_parts(problem), varying(problem), short_step(problem)];
    all.into_iter().flatten().collect()
}

/// Names of materials in brackets.
fn named<'m>(materials: impl Iterator<Item = &'m Material>) -> String {
    let tables = materials.map(|material| format!("[material.{}]", material.name.value));
    tables.collect::<Vec<_>>().join(", ")
}

/// Materials of cells of which some store u and some do not.
fn in_parts(problem: &Problem) -> Option<String> {
    let has_cell = |number: usize| problem.binding.materials.contains(&(number as u32));
    let all = problem.scene.materials.iter().enumerate();
    let all: Vec<_> = all.filter(|(number, _)| has_cell(*number)).map(|(_, of)| of).collect();
    let all = || all.iter().copied();
    let without = named(all().filter(|material| !material.stores()));
    (!without.is_empty()).then(|| {
        let with = named(all().filter(|material| material.stores()));
        format!("{with} has a capacity, and {without} has none: u answers at once there")
    })
}

/// A capacity that is not the same all over a cell.
fn varying(problem: &Problem) -> Option<String> {
    let rule = gauss(POINTS);
    let varies = |cell: usize, capacity: &Sum| {
        let points = Cell::of(problem, cell).points(&rule);
        let values = points.iter().map(|point| capacity.at(point.x[0], point.x[1]));
        let [least, most] =
            values.fold([f64::INFINITY, 0.0], |[least, most], c: f64| [least.min(c), most.max(c)]);
        most - least > CONSTANT * most
    };
    let counts = problem.scene.materials.iter().enumerate().map(|(number, material)| {
        let capacity = Sum::alone(&problem.scene, &material.capacity, 0.0);
        let own = |cell: &usize| problem.binding.materials[*cell] as usize == number;
        match capacity.constant() {
            Some(_) => 0,
            None => (0..problem.cells()).filter(own).filter(|&at| varies(at, &capacity)).count(),
        }
    });
    let count: usize = counts.sum();
    (count > 0).then(|| {
        format!(
            "a capacity varies inside {count} of {} cells: steps in time, their bounds and contents are those of its \
             mean over each cell",
            problem.cells()
        )
    })
}

/// A step in which nothing diffuses across any cell that stores u.
fn short_step(problem: &Problem) -> Option<String> {
    let dt = problem.scene.time.as_ref()?.step;
    let mut least = f64::INFINITY;
    for (at, &share) in problem.capacities.iter().enumerate().filter(|(_, share)| **share > 0.0) {
        let cell = Cell::of(problem, at);
        let corners = cell.corners();
        let sides = corners.iter().zip(corners.iter().cycle().skip(1));
        let h = sides.map(|(a, b)| (b[0] - a[0]).hypot(b[1] - a[1])).fold(f64::INFINITY, f64::min);
        let k = share * corners.len() as f64 / (cell.area() * dt);
        least = least.min(k * h * h / fastest(problem, at, cell.middle()));
    }
    (least.is_finite() && least > STIFF).then(|| {
        format!(
            "time.step = {dt}: no less than {least:.1e} such steps pass until anything diffuses across a cell; the mesh \
             does not resolve what happens in one"
        )
    })
}

/// The largest eigenvalue of A at a point of a cell.
fn fastest(problem: &Problem, cell: usize, point: [f64; 2]) -> f64 {
    let material = &problem.scene.materials[problem.binding.materials[cell] as usize];
    let Tensor { xx, xy, yy } = tensors::at(material, point);
    0.5 * (xx + yy) + (0.5 * (xx - yy)).hypot(xy)
}

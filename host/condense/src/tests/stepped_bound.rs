//! The bound of condensed steps: that of s and τ on the mesh, and above the error of the step.

use super::*;
use crate::{Recovery, SteppedModel, stepped};
use signorini_kernel::mesh::boundary::Robin;
use signorini_problem::State;
use signorini_scene::mesh::Mesh;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_solve::{Options, SolverKind, solve};
use signorini_tolerances::solve::STEP_FORM;

/// Affine data, all of which but the coefficient inputs change.
const SCENE: &str = r#"
mesh = "grid"
material.left = { conductivity = ["2", "0.5", "1"], capacity = "2" }
material.right = { conductivity = "1", capacity = "3" }
source.f = "-1"
boundary.dirichlet = { kind = "dirichlet", value = "0.3 + 0.1*x" }
boundary.left = { kind = "robin", coefficient = "2", ambient = "0.2" }
boundary.right = { kind = "neumann", flux = "0.2" }
boundary.contact = { kind = "contact", gap = "0.1", flux = "-0.1", limit = "0.6" }
input.depth = { of = "contact", field = "gap", pattern = "1 - x" }
input.level = { of = "dirichlet", field = "value", pattern = "1 + 0.5*x" }
input.wind = { of = "left", field = "ambient", pattern = "1" }
input.pull = { of = "right", field = "flux", pattern = "1" }
input.heat = { of = "source", field = "f", pattern = "1" }
output.force = { kind = "force" }
output.bound = { kind = "bound" }
"#;

struct Steps {
    problem: Problem,
    length: f64,
    of: SteppedModel,
    recovery: Recovery,
    past: Vec<f64>,
}

/// What a tick says of itself.
struct Said {
    /// The problem of the step, from s_old.
    step: Problem,
    vertices: Vec<f64>,
    tau: Vec<f64>,
    /// |F| and the bound.
    norm: f64,
    bound: f64,
    /// What the step changes, as the forms of the evolution take it.
    changes: Vec<f64>,
}

impl Steps {
    fn new(length: f64, size: u32, memory: usize) -> Result<Self> {
        let text = format!("{SCENE}time.step = {length}\n");
        let (_, problem) = on_grid(&text, grid(size, Cells::Triangles))?;
        let (of, recovery) = stepped(&problem, Some(memory))?;
        let past = of.start().to_vec();
        Ok(Self { problem, length, of, recovery, past })
    }

    fn tick(&mut self, at: usize, s_old: &[f64]) -> Result<Said> {
        let mut p = moved(&self.of.model, 0.3, 17 * (at / 3));
        p.truncate(self.of.inputs);
        let terms = [&p[..], &self.past].concat();
        let model = &self.of.model;
        let x = model.solve(&terms).expect("a solution");
        let form = model.certificate.as_ref().expect("a bound");
        let begin = State { vertices: s_old.to_vec(), ..State::zero(&self.problem) };
        let step = self.problem.with_inputs(&p[1..])?.stepping(self.length, begin)?;
        let fields = self.recovery.admissible(model, &step, &terms, &x).expect("s and τ");
        let mut said = Said {
            step,
            vertices: fields.vertices,
            tau: fields.tau,
            norm: model.energy_unit * model.norm(form, &form.factor, &terms, &x),
            bound: model.bound(&terms, &x).expect("a bound"),
            changes: self.past.clone(),
        };
        self.of.advance(&mut self.past, &p, &x);
        let first = self.of.inputs - 1 + self.of.model.contact;
        let states = first..first + self.of.fading.len();
        let pairs = said.changes.iter_mut().zip(&self.past).enumerate();
        let changed = pairs.filter(|(at, _)| !states.contains(at));
        changed.for_each(|(_, (was, now))| *was = now - *was);
        Ok(said)
    }
}

fn corners(mesh: &Mesh, cell: usize) -> [[f64; 2]; 3] {
    mesh.triangles[cell].map(|vertex| mesh.vertices[vertex as usize])
}

/// ∇ of the barycentric coordinates, and the area.
fn slopes([a, b, c]: [[f64; 2]; 3]) -> ([[f64; 2]; 3], f64) {
    let twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    let of = |p: [f64; 2], q: [f64; 2]| [(p[1] - q[1]) / twice, (q[0] - p[0]) / twice];
    ([of(b, c), of(c, a), of(a, b)], 0.5 * twice.abs())
}

fn gradient(slopes: &[[f64; 2]; 3], values: [f64; 3]) -> [f64; 2] {
    [0, 1].map(|k| (0..3).map(|i| slopes[i][k] * values[i]).sum())
}

/// A of the cell, and c.
fn material(problem: &Problem, cell: usize) -> ([f64; 3], f64) {
    let name = problem.binding.materials[cell] as usize;
    match problem.scene.materials[name].name.value.as_str() {
        "left" => ([2.0, 0.5, 1.0], 2.0),
        _ => ([1.0, 0.0, 1.0], 3.0),
    }
}

/// ‖A^½∇s − A^{−½}τ‖² + ∫_R (τ·n + h(s − u_ext))²/h, and ∫R²/k, cell by cell by the rule of the middles of the sides.
fn naive(said: &Said, s_old: &[f64], dt: f64) -> [f64; 2] {
    let Said { step: problem, vertices, tau, .. } = said;
    let (mesh, topology) = (&problem.mesh, &problem.topology);
    let (mut sum, mut residual) = (0.0, 0.0);
    for cell in 0..mesh.triangles.len() {
        let ([xx, xy, yy], c) = material(problem, cell);
        let (places, k) = (corners(mesh, cell), c / dt);
        let (slopes, area) = slopes(places);
        let of = |s: &[f64]| mesh.triangles[cell].map(|vertex| s[vertex as usize]);
        let (now, old) = (of(vertices), of(s_old));
        let grad = gradient(&slopes, now);
        let out: Vec<f64> = (0..3)
            .map(|side| {
                let edge = topology.of_triangles[cell][side] as usize;
                if topology.first_side(edge) == (cell, side) { tau[edge] } else { -tau[edge] }
            })
            .collect();
        let rest = (problem.loads.triangles[cell] + out.iter().sum::<f64>()) / area;
        // Side i runs from corner i to the next one: the field of a unit through it points away from the third corner.
        for side in 0..3 {
            let next = (side + 1) % 3;
            let x = [0, 1].map(|d| 0.5 * (places[side][d] + places[next][d]));
            let tau = [0, 1].map(|d| {
                (0..3).map(|i| out[i] * (x[d] - places[(i + 2) % 3][d]) / (2.0 * area)).sum::<f64>()
            });
            let off = [xx * grad[0] + xy * grad[1] - tau[0], xy * grad[0] + yy * grad[1] - tau[1]];
            let determinant = xx * yy - xy * xy;
            let energy = (yy * off[0] * off[0] - 2.0 * xy * off[0] * off[1] + xx * off[1] * off[1])
                / determinant;
            let change = 0.5 * (now[side] - old[side] + now[next] - old[next]);
            sum += area / 3.0 * energy;
            residual += area / 3.0 * (rest - k * change).powi(2) / k;
        }
    }
    for law in &problem.loads.robin {
        let edge = law.edge as usize;
        let (length, [a, b]) = (problem.lengths[edge], problem.ends[edge]);
        let h = law.coefficient / length;
        let ambient = law.ambient / law.coefficient;
        let at = |s: f64| (tau[edge] / length + h * (s - ambient)).powi(2) / h;
        let [a, b] = [a, b].map(|vertex| vertices[vertex as usize]);
        sum += length / 6.0 * (at(a) + 4.0 * at(0.5 * (a + b)) + at(b));
    }
    [sum, residual]
}

/// ‖A^½∇v‖² + ∫_R h v²
fn energy(problem: &Problem, v: &[f64]) -> f64 {
    let of_cell = |cell: usize| {
        let ([xx, xy, yy], _) = material(problem, cell);
        let (slopes, area) = slopes(corners(&problem.mesh, cell));
        let [a, b] = gradient(&slopes, problem.mesh.triangles[cell].map(|at| v[at as usize]));
        area * (xx * a * a + 2.0 * xy * a * b + yy * b * b)
    };
    let of_law = |law: &Robin<f64, u32>| {
        let [a, b] = problem.ends[law.edge as usize].map(|vertex| v[vertex as usize]);
        law.coefficient / 3.0 * (a * a + a * b + b * b)
    };
    let cells: f64 = (0..problem.mesh.triangles.len()).map(of_cell).sum();
    cells + problem.loads.robin.iter().map(of_law).sum::<f64>()
}

/// ‖Fz‖ for an upper triangle by columns.
fn packed_norm(factor: &[f64], z: &[f64]) -> f64 {
    let entry =
        |i: usize| -> f64 { (i..z.len()).map(|j| factor[j * (j + 1) / 2 + i] * z[j]).sum() };
    (0..z.len()).map(|i| entry(i).powi(2)).sum::<f64>().sqrt()
}

/// |F|² is what the mesh says of s and τ, where s_old is s of the tick before, for any states; and so are the forms of what a step changes.
#[test]
fn the_form_of_a_step_is_that_of_the_mesh() -> Result<()> {
    for (length, memory) in [(0.05, 3), (1e-4, 6), (10.0, 2), (0.05, usize::MAX)] {
        let mut steps = Steps::new(length, 4, memory)?;
        let count = steps.problem.mesh.vertices.len();
        let mut s_old = steps.tick(0, &vec![0.0; count])?.vertices;
        for at in 1..10 {
            let said = steps.tick(at, &s_old)?;
            let [gap, residual] = naive(&said, &s_old, length);
            let expected = (gap + residual).sqrt();
            let what = format!("{length} {memory} {at}");
            STEP_FORM.check_over(format_args!("{what}"), said.norm - expected, expected);
            let forms = steps.of.evolution.as_ref().expect("a bound of the evolution");
            let unit = steps.of.model.energy_unit;
            let of = |factor: &[f64]| unit * packed_norm(factor, &said.changes);
            let off = of(&forms.residual) - residual.sqrt();
            STEP_FORM.check_over(format_args!("{what}, R"), off, expected);
            let moved: Vec<f64> =
                said.vertices.iter().zip(&s_old).map(|(now, old)| now - old).collect();
            let moved = energy(&said.step, &moved).sqrt();
            STEP_FORM.check_over(format_args!("{what}, motion"), of(&forms.motion) - moved, moved);
            assert!(said.bound >= said.norm);
            s_old = said.vertices;
        }
    }
    Ok(())
}

/// s on a mesh whose triangles lie within those of `mesh`.
fn carried(mesh: &Mesh, s: &[f64], to: &Mesh) -> Vec<f64> {
    let value = |x: &[f64; 2]| {
        let inside = |cell: &usize| {
            let places = corners(mesh, *cell);
            let (slopes, _) = slopes(places);
            let own: [f64; 3] = std::array::from_fn(|i| {
                let other = places[(i + 1) % 3];
                slopes[i][0] * (x[0] - other[0]) + slopes[i][1] * (x[1] - other[1])
            });
            own.iter().all(|&part| part > -1e-9).then_some(own)
        };
        let (cell, own) =
            (0..mesh.triangles.len()).find_map(|at| Some((at, inside(&at)?))).expect("a cell");
        (0..3).map(|i| own[i] * s[mesh.triangles[cell][i] as usize]).sum()
    };
    to.vertices.iter().map(value).collect()
}

/// The bound is above the distance to the solution of the same step on a mesh 6 times finer, and near it, however much is dropped.
#[test]
fn the_bound_of_a_step_is_above_its_error() -> Result<()> {
    for (length, memory) in [(0.02, 2), (0.02, 12), (1.0, 4)] {
        let mut steps = Steps::new(length, 4, memory)?;
        let count = steps.problem.mesh.vertices.len();
        let mut s_old = steps.tick(0, &vec![0.0; count])?.vertices;
        for at in 1..7 {
            let said = steps.tick(at, &s_old)?;
            let text = format!("{SCENE}time.step = {length}\n");
            let (_, fine) = on_grid(&text, grid(24, Cells::Triangles))?;
            let values: Vec<f64> =
                said.step.scene.inputs.iter().map(|input| input.default).collect();
            let on_fine = |s: &[f64]| carried(&said.step.mesh, s, &fine.mesh);
            let (now, old) = (on_fine(&said.vertices), on_fine(&s_old));
            let means =
                fine.ends.iter().map(|ends| 0.5 * (old[ends[0] as usize] + old[ends[1] as usize]));
            let begin = State { u: means.collect(), ..State::zero(&fine) };
            let fine = fine.with_inputs(&values)?.stepping(length, begin)?;
            let u = solve(&fine, &Options::by(SolverKind::Direct))?.u;
            let distance = distance(&fine, &u, &now, length);
            assert!(said.bound >= distance, "{length} {memory} {at}: {} {distance}", said.bound);
            assert!(
                said.bound <= 3.0 * distance,
                "{length} {memory} {at}: {} {distance}",
                said.bound
            );
            s_old = said.vertices;
        }
    }
    Ok(())
}

/// (‖A^½∇_h(u − s)‖² + ∫k(u − s)² + ∫_R h(u − s)²)^½ for the means u over edges.
fn distance(problem: &Problem, u: &[f64], s: &[f64], dt: f64) -> f64 {
    let mut sum = 0.0;
    for cell in 0..problem.mesh.triangles.len() {
        let ([xx, xy, yy], c) = material(problem, cell);
        let (slopes, area) = slopes(corners(&problem.mesh, cell));
        let off: [f64; 3] = std::array::from_fn(|side| {
            let edge = problem.topology.of_triangles[cell][side] as usize;
            let [a, b] = problem.ends[edge];
            u[edge] - 0.5 * (s[a as usize] + s[b as usize])
        });
        // Side i lies between corners i and i + 1: the function of its middle is 1 − 2 times the coordinate of the third.
        let [a, b] = gradient(&slopes, std::array::from_fn(|i| -2.0 * off[(i + 1) % 3]));
        sum += area * (xx * a * a + 2.0 * xy * a * b + yy * b * b);
        sum += c / dt * area / 3.0 * off.iter().map(|x| x * x).sum::<f64>();
    }
    for law in &problem.loads.robin {
        let (edge, [a, b]) = (law.edge as usize, problem.ends[law.edge as usize]);
        sum += law.coefficient * (u[edge] - 0.5 * (s[a as usize] + s[b as usize])).powi(2);
    }
    sum.sqrt()
}

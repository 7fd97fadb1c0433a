//! Steps in time with an exact solution.

use super::*;
use signorini_problem::State;
use signorini_problem::quadrature::on_panels;
use signorini_scene::mesh::Mesh;

/// u = 1 + y − sinh(κ(1 − y))/sinh κ with κ² = 1/dt is the step from 1 + y without sources on (−1, 1) × (0, 1): given below, heat by a law
/// of transfer from above, contact on the right that stays open.
struct Slab {
    root: f64,
}

impl Slab {
    fn text(&self) -> String {
        let (dt, slope) = (self.root.powi(-2), 1.0 + self.root / self.root.sinh());
        format!(
            r#"
mesh = "grid"
material.default = {{ conductivity = "1", capacity = "1" }}
source.f = "0"
boundary.contact = {{ kind = "dirichlet", value = "0" }}
boundary.dirichlet = {{ kind = "robin", coefficient = "3", ambient = "{:?}" }}
boundary.left = {{ kind = "neumann", flux = "0" }}
boundary.right = {{ kind = "contact", gap = "-1", flux = "0" }}
time.step = {dt:?}
output.floor = {{ kind = "flux", of = "contact" }}
output.roof = {{ kind = "flux", of = "dirichlet" }}
output.top = {{ kind = "mean", of = "dirichlet" }}
output.wall = {{ kind = "mean", of = "left" }}
output.skin = {{ kind = "mean", of = "right" }}
output.middle = {{ kind = "probe", at = [0.1, 0.55] }}
"#,
            2.0 + slope / 3.0
        )
    }

    fn u(&self, y: f64) -> f64 {
        1.0 + y - (self.root * (1.0 - y)).sinh() / self.root.sinh()
    }

    /// The outputs.
    fn exact(&self, problem: &Problem) -> Result<[(&'static str, f64); 6]> {
        let k = self.root;
        let wall = 1.5 - (0.5 * k).tanh() / k;
        Ok([
            ("floor", -2.0 * (1.0 + k / k.tanh())),
            ("roof", 2.0 * (1.0 + k / k.sinh())),
            ("top", 2.0),
            ("wall", wall),
            ("skin", wall),
            ("middle", self.over_cell(problem)?),
        ])
    }

    /// The mean of u over the cell of the probe.
    fn over_cell(&self, problem: &Problem) -> Result<f64> {
        let output = problem.scene.outputs.iter().find(|of| of.name.value == "middle");
        let Functional::Probe(cell, _) = Functional::of(problem, output.expect("it"))? else {
            panic!("a cell")
        };
        let [mut sum, mut area] = [0.0; 2];
        for point in Cell::of(problem, cell).points(&on_panels(8, &gauss(8))) {
            sum += point.weight * self.u(point.x[1]);
            area += point.weight;
        }
        Ok(sum / area)
    }
}

/// The step of a slab from 1 + y.
fn step(text: &str, mesh: Mesh) -> Result<Problem> {
    let (scene, problem) = on_grid(text, mesh)?;
    let at = |place: [f64; 2]| 1.0 + place[1];
    let begin = State {
        u: (0..problem.ends.len()).map(|edge| at(problem.along(edge, 0.5))).collect(),
        vertices: problem.mesh.vertices.iter().map(|&vertex| at(vertex)).collect(),
        ..State::zero(&problem)
    };
    problem.stepping(scene.time.expect("a step").step, begin)
}

/// Half-widths on a mesh, and those over the errors of the middles.
fn checked(slab: &Slab, mesh: Mesh, of: &str) -> Result<Vec<[f64; 2]>> {
    let problem = step(&slab.text(), mesh)?;
    let found = of_answer(&problem, &(&solve(&problem, &options())?).into(), Coverage::Usual);
    let checked = slab.exact(&problem)?.map(|(name, exact)| {
        let interval = found[name].as_ref().unwrap_or_else(|why| panic!("{of} {name}: {why}"));
        check(&format!("{of} {name}"), interval, exact);
        let OutputBound { center, plus_minus, .. } = interval;
        let ratio = plus_minus / (exact - center).abs();
        println!("{of} {name}: {plus_minus:.2e}, {ratio:.1}");
        [*plus_minus, ratio]
    });
    Ok(checked.to_vec())
}

#[test]
fn intervals_of_a_step_hold_its_exact_solution() -> Result<()> {
    let mut ratios = Vec::new();
    for cells in [Cells::Triangles, Cells::Quads, Cells::Mixed] {
        for root in [100.0, 10.0, 3.0, 1.0, 0.3] {
            let of =
                |n: u32| checked(&Slab { root }, grid(n, cells), &format!("{cells:?} {root} {n}"));
            for ([coarse, _], [fine, ratio]) in of(4)?.into_iter().zip(of(8)?) {
                // Of second order where cells are not smaller too and the grid resolves the layers.
                let part = if root > 1.0 { 1.0 } else { 0.55 };
                assert!(fine < part * coarse, "{cells:?} {root}");
                ratios.push(ratio);
            }
        }
    }
    ratios.sort_by(f64::total_cmp);
    println!("median {}, most {}", ratios[ratios.len() / 2], ratios[ratios.len() - 1]);
    Ok(())
}

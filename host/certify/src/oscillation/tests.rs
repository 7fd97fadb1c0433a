//! Oscillation in closed form: of polynomials, of what no rule sees, of powers.

use std::f64::consts::PI;

use super::*;
use signorini_kernel::mesh::geometry::triangle_area;
use signorini_problem::fixtures::{self, PARABOLA, SMOOTH};
use signorini_scene::mesh::Mesh;
use signorini_scene::mesh::shape::edge_length;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_tolerances::solve::OSCILLATION;

/// [`PARABOLA`] with this source.
fn sourced(f: &str, mesh: Mesh) -> Result<Problem> {
    let text = fixtures::changed(PARABOLA, &[("f = \"0\"", &format!("f = \"{f}\""))]);
    Ok(fixtures::on_grid(&text, mesh)?.1)
}

/// Eigenvalues of [2, ½; ½, 1] are (3 ± √2)/2.
fn smallest() -> f64 {
    0.5 * (3.0 - 2.0_f64.sqrt())
}

#[test]
fn linear_data_on_triangles_in_closed_form() -> Result<()> {
    let (_, problem) = fixtures::on_grid(SMOOTH, fixtures::distorted(grid(3, Cells::Triangles)))?;
    let found = oscillation(&problem)?.of_cells;
    for (at, vertices) in problem.mesh.triangles.iter().enumerate() {
        let corners = vertices.map(|vertex| problem.mesh.vertices[vertex as usize]);
        // ∫λ_iλ_j = |T|/12 (1 + δ_ij): ‖f − f̄‖² = |T|/12 Σ (f_i − f̄)².
        let values = corners.map(|[x, y]| -(4.0 * y + 14.0 * x + 2.0));
        let mean = values.iter().sum::<f64>() / 3.0;
        let spread: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
        let square = triangle_area(corners) / 12.0 * spread;
        let diameter = (0..3).map(|k| edge_length([corners[k], corners[(k + 1) % 3]]));
        let diameter = diameter.fold(0.0, f64::max);
        let mut expected = diameter / PI * (square / smallest()).sqrt();
        for &edge in &problem.topology.of_triangles[at] {
            let (edge, length) = (edge as usize, problem.lengths[edge as usize]);
            // 1e−10 of it: u_ext is rational. Its own test is in `robin`.
            expected += missed(&problem, edge)?.iter().sum::<f64>();
            let [[x0, y0], [x1, y1]] = problem.segment(edge);
            // ‖g − ḡ‖² of a linear g is |E|/12 times its rise squared; of q = −3.5x² − 1 with the
            // middle m, ∫ = |E| 3.5² (m² l²/3 + l⁴/180).
            let square = match problem.kinds[edge] {
                EdgeKind::Neumann => length / 12.0 * (5.0 * (y1 - y0)).powi(2),
                EdgeKind::Contact => {
                    let (middle, l) = (0.5 * (x0 + x1), x1 - x0);
                    let square = middle.powi(2) * l.powi(2) / 3.0 + l.powi(4) / 180.0;
                    length * 3.5_f64.powi(2) * square
                }
                _ => 0.0,
            };
            let shape = length * diameter * diameter / triangle_area(corners);
            let trace = 1.0 / (PI * PI) + 1.0 / PI;
            expected += (shape * trace * square / smallest()).sqrt();
        }
        OSCILLATION.check_over(format_args!("cell {at}"), found[at] - expected, expected);
    }
    Ok(())
}

/// Of ‖f − f̄‖ in closed form: narrow, kinked, jumping data, which no rule on the whole cell sees.
#[test]
fn oscillations_hold_what_no_rule_sees() -> Result<()> {
    let gaussian = |width: f64| {
        let text = format!("exp(-((x - 0.31)^2 + (y - 0.43)^2)/{width}^2)");
        (text, PI / 2.0 * width * width, PI * width * width)
    };
    let cases = [
        gaussian(0.05),
        gaussian(0.002),
        ("sign(3*x + 2*y - 1.7)".to_owned(), 2.0, f64::NAN),
        ("max(0, 1 - abs(x - 0.3)/0.001)".to_owned(), 2e-3 / 3.0, 1e-3),
        ("sin(40*x)".to_owned(), 1.0 - 80.0_f64.sin() / 80.0, 0.0),
    ];
    for cells in [Cells::Triangles, Cells::Quads, Cells::Mixed] {
        for (text, square, integral) in &cases {
            let problem = sourced(text, grid(2, cells))?;
            let load = |at: usize| problem.loads.of_cell(at);
            let sum: f64 = (0..problem.cells()).map(load).sum();
            let slack = problem.loads.missed + 1e-12;
            assert!(integral.is_nan() || (sum - integral).abs() <= slack, "{text}: {sum}");
            // ‖f‖² = Σ‖f − f̄‖² + Σ|T|f̄²
            let means: f64 = (0..problem.cells())
                .map(|at| load(at).powi(2) / enclosed::region(Cell::of(&problem, at)).measure())
                .sum();
            let exact = square - means;
            let f = Sum::source(&problem.scene, 0.0);
            let found = squares(&problem, &f, &vec![1.0; problem.cells()])?;
            let [value, missed] = found
                .iter()
                .fold([0.0; 2], |[value, missed], of| [value + of.value, missed + of.missed]);
            assert!((value - exact).abs() <= missed + 1e-12, "{text}: {value} ± {missed}, {exact}");
            assert!(missed <= 0.11 * exact && slack < 1e-5, "{text}: {missed} of {exact}, {slack}");
        }
    }
    Ok(())
}

/// ∫ r^−p over (−1, 1) × (0, 1) from a point, in polar coordinates.
fn power(point: [f64; 2], p: f64) -> f64 {
    let steps = 100_000;
    let of_angle = |k: i32| {
        let angle = std::f64::consts::TAU * (f64::from(k) + 0.5) / f64::from(steps);
        let leaves = |gap: f64, speed: f64| if speed > 1e-12 { gap / speed } else { f64::INFINITY };
        let sideways =
            leaves(1.0 - point[0], angle.cos()).min(leaves(1.0 + point[0], -angle.cos()));
        let upwards = leaves(1.0 - point[1], angle.sin()).min(leaves(point[1], -angle.sin()));
        sideways.min(upwards).powf(2.0 - p) / (2.0 - p)
    };
    (0..steps).map(of_angle).sum::<f64>() * std::f64::consts::TAU / f64::from(steps)
}

/// f = r^(a − 2) at a vertex, on a side and inside a cell: square integrable for a > 1 alone, integrable for a > 0 alone.
#[test]
fn powers_of_a_distance_oscillate_as_they_do() -> Result<()> {
    let (points, mut seen) = ([[0.0, 0.0], [0.1, 0.5], [0.31, 0.43]], 0);
    for (a, cells) in [0.9, 0.99, 1.01, 1.1, 2.0]
        .into_iter()
        .flat_map(|a| [Cells::Triangles, Cells::Quads].map(|cells| (a, cells)))
    {
        for point @ [x, y] in points {
            let text = format!("((x - {x:?})^2 + (y - {y:?})^2)^{:?}", 0.5 * (a - 2.0));
            let problem = sourced(&text, grid(2, cells))?;
            let data = crate::Evaluated::new(&problem)?;
            let reason = data.no_bound.map(|reason| reason.to_string()).unwrap_or_default();
            assert_eq!(
                reason.contains("not square integrable near ("),
                a <= 1.0,
                "{text}: {reason}"
            );
            let loads: Vec<f64> =
                (0..problem.cells()).map(|at| problem.loads.of_cell(at)).collect();
            let sum: f64 = loads.iter().sum();
            let off = (sum - power(point, 2.0 - a)).abs();
            assert!(off <= problem.loads.missed + 1e-4 * sum, "{text}: {sum} {off}");
            if a <= 1.0 {
                continue;
            }
            seen += 1;
            let area = |at| enclosed::region(Cell::of(&problem, at)).measure();
            let means: f64 =
                loads.iter().enumerate().map(|(at, load)| load * load / area(at)).sum();
            let exact = power(point, 4.0 - 2.0 * a) - means;
            let all =
                squares(&problem, &Sum::source(&problem.scene, 0.0), &vec![1.0; problem.cells()])?;
            let found: f64 = all.iter().map(|of| of.value + of.missed).sum();
            let held = (1.0 - 1e-4) * exact - 1e-6..=1.2 * exact + 1e-6;
            assert!(held.contains(&found), "{text}, {cells:?}: {found} of {exact}");
        }
    }
    assert_eq!(seen, 18);
    let none = "1/((x - 0.31)^2 + (y - 0.43)^2)";
    let error = sourced(none, grid(2, Cells::Quads)).expect_err("no load");
    assert!(error.to_string().contains("no finite integral near (0.3"), "{error}");
    Ok(())
}

/// q = −r^(a − 1) on an edge: square integrable for a > ½ alone.
#[test]
fn powers_on_an_edge_have_a_bound_above_a_half() -> Result<()> {
    for a in [0.45_f64, 0.5, 0.55, 0.9] {
        for x in [0.0_f64, 0.1] {
            let flux = format!("-abs(x - {x:?})^{:?}", a - 1.0);
            let new = format!("gap = \"-x^2\", flux = \"{flux}\"");
            let (_, problem) = fixtures::on_grid(
                &PARABOLA.replace("gap = \"-x^2\"", &new),
                grid(2, Cells::Quads),
            )?;
            let sum: f64 = problem.loads.contact_flux.iter().sum();
            let exact = -((1.0 - x).powf(a) + (1.0 + x).powf(a)) / a;
            assert!((sum - exact).abs() <= problem.loads.missed + 1e-12, "{flux}: {sum} {exact}");
            let reason = crate::Evaluated::new(&problem)?.no_bound.map(|reason| reason.to_string());
            let is_refused =
                reason.unwrap_or_default().contains("the flux is not square integrable");
            assert_eq!(is_refused, a <= 0.5, "{flux}");
        }
    }
    Ok(())
}

#[test]
fn constant_data_oscillate_only_where_the_area_element_does() -> Result<()> {
    let distorted = fixtures::distorted(grid(3, Cells::Quads));
    for (f, mesh) in
        [("3", grid(3, Cells::Triangles)), ("3", grid(3, Cells::Quads)), ("0", distorted.clone())]
    {
        assert!(oscillation(&sourced(f, mesh)?)?.of_cells.iter().all(|&cell| cell == 0.0));
    }
    let found = oscillation(&sourced("3", distorted)?)?;
    assert!(found.of_cells.iter().any(|&cell| cell > 1e-3));
    Ok(())
}

#[test]
fn linear_source_on_a_square() -> Result<()> {
    // f = x on squares of side h: ‖f − f̄‖² = h⁴/12, diameter √2 h, A = I.
    let found = oscillation(&sourced("x", grid(4, Cells::Quads))?)?;
    let expected = 2.0_f64.sqrt() * 0.25 / PI * (0.25_f64.powi(4) / 12.0).sqrt();
    for cell in found.of_cells {
        OSCILLATION.check("a cell", cell - expected);
    }
    Ok(())
}

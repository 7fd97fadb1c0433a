//! Small scenes of which something is known: a polynomial, a trapezoid, a wall.

use super::*;
use signorini_scene::mesh::Mesh;
use signorini_scene::mesh::structured::{Trapezoids, trapezoids};

/// The intervals of a solution.
fn found_on(text: &str, mesh: Mesh) -> Result<BTreeMap<String, Found>> {
    let (_, problem) = on_grid(text, mesh)?;
    Ok(of_outputs(&problem, &solve(&problem, &options())?, Coverage::Usual))
}

/// The interval of an output that has one.
fn interval<'f>(found: &'f BTreeMap<String, Found>, name: &str) -> &'f OutputBound {
    found[name].as_ref().unwrap_or_else(|why| panic!("{name}: {why}"))
}

/// u = x² − y² on (−1, 1) × (0, 1), heat through the left side by a transfer law, through the right one by a given u.
const HARMONIC: &str = r#"
mesh = "grid"
material.default.conductivity = "1"
source.f = "0"
boundary.dirichlet = { kind = "neumann", flux = "-2" }
boundary.left = { kind = "robin", coefficient = "2 + y", ambient = "1 - y^2 + 2/(2 + y)" }
boundary.right = { kind = "dirichlet", value = "1 - y^2" }
boundary.contact = { kind = "neumann", flux = "0" }
output.top = { kind = "mean", of = "dirichlet" }
output.bottom = { kind = "flux", of = "contact" }
output.cold = { kind = "flux", of = "left" }
output.skin = { kind = "mean", of = "left" }
output.warm = { kind = "flux", of = "right" }
output.given = { kind = "mean", of = "right" }
output.two = { kind = "flux", of = ["contact", "left"] }
"#;

#[test]
fn they_hold_the_values_of_an_exact_solution() -> Result<()> {
    // Means of x² − 1 over (−1, 1) and of 1 − y² over (0, 1); fluxes ±2x over sides of length 1.
    let means = [("top", -2.0 / 3.0), ("skin", 2.0 / 3.0), ("given", 2.0 / 3.0)];
    let fluxes = [("bottom", 0.0), ("cold", 2.0), ("warm", 2.0), ("two", 2.0)];
    let exact: Vec<_> = means.into_iter().chain(fluxes).collect();
    for cells in [Cells::Triangles, Cells::Quads, Cells::Mixed] {
        let mut widths = Vec::new();
        for n in [4, 16] {
            let found = found_on(HARMONIC, grid(n, cells))?;
            exact.iter().for_each(|&(name, value)| check(name, interval(&found, name), value));
            let width = |name| interval(&found, name).plus_minus;
            assert!(width("two") <= width("bottom") + width("cold"), "{cells:?}: {found:?}");
            widths.push(width("warm"));
        }
        // Of first order: a quarter of the edge is a quarter of the width.
        assert!(widths[1] < 0.3 * widths[0], "{cells:?}: {widths:?}");
    }
    Ok(())
}

/// A is constant on one side of a kink inside cells: there ζ = A∇z but for rounding, which is below 0 as often as above.
#[test]
fn a_plateau_of_a_conductivity_hides_no_weight() -> Result<()> {
    const PLATEAU: &str = r#"
mesh = "grid"
material.default.conductivity = "2 + max(x, 1/3)"
source.f = "0"
boundary.dirichlet = { kind = "neumann", flux = "0" }
boundary.contact = { kind = "neumann", flux = "0" }
boundary.left = { kind = "dirichlet", value = "0" }
boundary.right = { kind = "dirichlet", value = "1" }
output.through = { kind = "flux", of = "right" }
"#;
    // 1/∫dx/A
    let exact = 1.0 / (4.0 / 7.0 + (9.0_f64 / 7.0).ln());
    for cells in [Cells::Triangles, Cells::Quads, Cells::Mixed] {
        for n in [1, 2, 4, 8] {
            let found = found_on(PLATEAU, grid(n, cells))?;
            let through = interval(&found, "through");
            check(&format!("{cells:?} {n}"), through, exact);
            assert!(through.plus_minus > 0.0, "{through:?}");
        }
    }
    Ok(())
}

/// On a trapezoid the mean over the area is not the mean in the cell's own coordinates.
#[test]
fn the_mean_over_a_trapezoid_is_that_over_its_area() -> Result<()> {
    const TRAPEZOID: &str = r#"
title = "a linear u"
mesh = "none.msh"
material.default.conductivity = "1"
boundary.default = { kind = "dirichlet", value = "x + 2*y" }
output.middle = { kind = "probe", at = [-0.2, 0.4] }
setting.element = "nonparametric"
"#;
    let mut mesh = grid(1, Cells::Quads);
    // Left of x = 0 a quad with the corners (−1, 0), (0, 0), (0, 3), (−1, 1), of the area 2 and the middle (−5/12, 13/12).
    for vertex in &mut mesh.vertices {
        *vertex = [vertex[0], if vertex[0] < 0.0 { vertex[1] } else { 3.0 * vertex[1] }];
    }
    let found = found_on(TRAPEZOID, mesh)?;
    let middle = interval(&found, "middle");
    check("the area's", middle, -5.0 / 12.0 + 2.0 * 13.0 / 12.0);
    assert!(middle.plus_minus < 1e-6, "{middle:?}");
    Ok(())
}

/// u = xy + 2x + 3y: contact below, which touches everywhere and meets a given u on the right, as a seepage face meets the tailwater;
/// a law of transfer on the left.
const TAILWATER: &str = r#"
mesh = "grid"
material.default.conductivity = "1"
source.f = "0"
boundary.contact = { kind = "contact", gap = "2*x", flux = "-5" }
boundary.right = { kind = "dirichlet", value = "2 + 4*y" }
boundary.left = { kind = "robin", coefficient = "2 + y", ambient = "2*y - 3" }
boundary.dirichlet = { kind = "neumann", flux = "x + 3" }
output.face = { kind = "flux", of = "contact" }
output.weir = { kind = "flux", of = "right" }
output.both = { kind = "flux", of = ["right", "contact"] }
output.more = { kind = "flux", of = ["dirichlet", "contact", "right"] }
output.all = { kind = "flux", of = ["left", "contact", "right"] }
output.force = { kind = "force", of = ["contact"] }
output.wet = { kind = "length", of = ["contact"] }
"#;

/// Where a boundary meets another one that takes flux too no energy tells one flux from the other: their sum has an interval, which
/// data that are given beside them do not widen.
#[test]
fn a_sum_has_an_interval_where_its_parts_have_none() -> Result<()> {
    for cells in [Cells::Triangles, Cells::Quads, Cells::Mixed] {
        let mut widths = Vec::new();
        for n in [4, 8] {
            let (scene, problem) = on_grid(TAILWATER, grid(n, cells))?;
            let solution = solve(&problem, &options())?;
            let found = of_outputs(&problem, &solution, Coverage::Usual);
            let values = outputs(&problem, &solution)?;
            for name in ["face", "weir", "force"] {
                let why = found[name].as_ref().expect_err(name);
                assert!(why.contains("from both sides"), "{name}: {why}");
                let list = if name == "weir" { ["right", "contact"] } else { ["contact", "right"] };
                assert!(why.contains(&format!("of = {list:?}")), "{name}: {why}");
            }
            // −∫(x + 3) below, ∫(y + 2) on the right, −∫(y + 2) on the left, ∫(x + 3) on top.
            for (name, exact) in [("both", -3.5), ("more", 2.5), ("all", -6.0)] {
                check(name, interval(&found, name), exact);
            }
            let [face, weir, both] =
                ["face", "weir", "both"].map(|name| values[name].expect("a value"));
            assert!((face + weir - both).abs() < 1e-12 * both.abs(), "{face} {weir} {both}");
            let width = |name| interval(&found, name).plus_minus;
            assert!((width("more") - width("both")).abs() < 1e-6, "{cells:?}: {found:?}");
            assert!(width("all") < 1e-6 && width("both") > 1e-4, "{cells:?}: {found:?}");
            assert_eq!(values["wet"], Some(2.0));
            widths.push(width("both"));
            let own = weights::of_all(&problem, true);
            for (output, weight) in scene.outputs.iter().zip(own) {
                let has = ["both", "more"].contains(&output.name.value.as_str());
                assert_eq!(weight.is_ok(), has, "{}: {weight:?}", output.name.value);
            }
        }
        assert!(widths[1] < 0.6 * widths[0], "{cells:?}: {widths:?}");
    }
    Ok(())
}

const ROOF: &str = r#"
title = "an outlet below"
mesh = "none.msh"
material.default.conductivity = "1"
source.f = "-1"
boundary.contact = { kind = "contact", gap = "0", flux = "0" }
boundary.left = { kind = "robin", coefficient = "2", ambient = "0.1" }
boundary.right = { kind = "robin", coefficient = "0", ambient = "3" }
boundary.dirichlet = { kind = "neumann", flux = "0" }
output.below = { kind = "flux", of = "contact" }
output.side = { kind = "flux", of = "left" }
"#;

/// Where no heat is transferred the condition is that of a wall.
#[test]
fn without_transfer_there_are_intervals_that_hold() -> Result<()> {
    let (_, fine) = on_grid(ROOF, grid(32, Cells::Triangles))?;
    let exact = outputs(&fine, &solve(&fine, &options())?)?;
    let found = found_on(ROOF, grid(4, Cells::Triangles))?;
    for name in ["below", "side"] {
        check(name, interval(&found, name), exact[name].expect("a value"));
    }
    Ok(())
}

/// u = x² − y² + 2x + `zero` on (−1, 1) × (0, 1), of which the left half stores `c` and the right half twice that.
fn stores(c: f64, zero: f64) -> String {
    format!(
        r#"
mesh = "grid"
material.left = {{ conductivity = "1", capacity = "{c:?}" }}
material.right = {{ conductivity = "1", capacity = "2*{c:?} + 0*x" }}
source.f = "0"
boundary.dirichlet = {{ kind = "dirichlet", value = "x^2 - y^2 + 2*x + {zero:?}" }}
boundary.contact = {{ kind = "neumann", flux = "0" }}
output.heat = {{ kind = "content" }}
output.cold = {{ kind = "content", of = "left" }}
output.both = {{ kind = "content", of = ["right", "left"] }}
output.warm = {{ kind = "mean", of = "right" }}
exact = {{ u = "x^2 - y^2 + 2*x + {zero:?}", gradient = ["2*x + 2", "-2*y"] }}
"#
    )
}

/// ∫(x² − y²) = 0 over either half, ∫2x = ∓1: with another capacity, in other units and with another zero of u.
#[test]
fn contents_and_means_over_materials_hold_and_shrink() -> Result<()> {
    for (c, zero) in [(2.0, 0.0), (2.0, 273.15), (3e6, 1e4), (1e-9, -5.0)] {
        let on = |cells| move |n: u32| grid(n, cells);
        let slanted = |n: u32| trapezoids(n, Trapezoids::InTwoRows);
        let [triangles, mixed] = [Cells::Triangles, Cells::Mixed].map(on);
        let meshes: [(&str, &dyn Fn(u32) -> Mesh); 3] =
            [("triangles", &triangles), ("mixed", &mixed), ("trapezoids", &slanted)];
        for (cells, mesh) in meshes {
            let mut widths = Vec::new();
            for n in [4, 16] {
                let (_, problem) = on_grid(&stores(c, zero), mesh(n))?;
                let solution = solve(&problem, &options())?;
                let found = of_outputs(&problem, &solution, Coverage::Usual);
                let values = outputs(&problem, &solution)?;
                for (name, exact) in [
                    ("heat", c * (1.0 + 3.0 * zero)),
                    ("cold", c * (zero - 1.0)),
                    ("both", c * (1.0 + 3.0 * zero)),
                    ("warm", 1.0 + zero),
                ] {
                    let interval = interval(&found, name);
                    check(&format!("{name}, {c}, {zero}, {cells:?}"), interval, exact);
                    let value = values[name].expect("a value");
                    let off = (value - exact).abs();
                    let size = if name == "warm" { 1.0 } else { c };
                    let stated = interval.exact.expect("an exact solution");
                    assert!((stated - exact).abs() < 1e-11 * size * (1.0 + zero.abs()), "{name}");
                    assert!(off < 0.05 * size, "{name}, {c}, {zero}, {cells:?}: {value} {exact}");
                }
                let width = |name| interval(&found, name).plus_minus;
                assert!(width("heat") < 0.6 * c && width("warm") < 0.3, "{cells:?}: {found:?}");
                widths.push([width("heat"), width("warm")]);
            }
            // Of second order.
            let is_second = |at: usize| widths[1][at] < 0.1 * widths[0][at];
            assert!(is_second(0) && is_second(1), "{c}, {zero}, {cells:?}: {widths:?}");
        }
    }
    Ok(())
}

/// A linear u is exact: over the square, its corners' mean.
#[test]
fn the_content_of_a_linear_u_is_exact() -> Result<()> {
    let text = stores(2.0, 0.0)
        .replace("x^2 - y^2 + 2*x", "x")
        .replace("\"2*x + 2\", \"-2*y\"", "1, 0")
        .replace("2*2.0 + 0*x", "2");
    let text =
        text.replace("kind = \"neumann\", flux = \"0\"", "kind = \"dirichlet\", value = \"x\"");
    for cells in [Cells::Triangles, Cells::Quads, Cells::Mixed] {
        let (_, problem) = on_grid(&text, grid(3, cells))?;
        let values = outputs(&problem, &solve(&problem, &options())?)?;
        for (name, exact) in [("heat", 0.0), ("cold", -1.0), ("both", 0.0), ("warm", 0.5)] {
            let value = values[name].expect("a value");
            assert!((value - exact).abs() < 1e-12, "{cells:?}: {name}: {value}");
        }
    }
    Ok(())
}

//! Integrals of what no rule sees, against exact ones.

use super::*;
use crate::fixtures::{PARABOLA, scene};
use signorini_scene::error::Result;
use signorini_tolerances::solve::{ENCLOSED, ENCLOSED_LINE};

const SQUARE: [[f64; 2]; 4] = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]];

fn on<T>(text: &str, found: impl Fn(&Sum) -> T) -> Result<T> {
    let scene = scene(&PARABOLA.replace("f = \"0\"", &format!("f = \"{text}\"")))?;
    Ok(found(&Sum::source(&scene, 0.0)))
}

#[test]
fn kinks_and_jumps_are_cut_off() -> Result<()> {
    let halves = [[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0]], [[0.0, 0.0], [2.0, 1.0], [0.0, 1.0]]];
    let a = 0.3711_f64;
    // By a narrow strip 2e−3 from a side, a circle of radius ½ around a corner, and a line across.
    for (text, exact, tolerance) in [
        (format!("abs(x - {a})"), 0.5 * (a * a + (2.0 - a).powi(2)), ENCLOSED),
        (format!("sign(x - {a}) + 1"), 2.0 * (2.0 - a), ENCLOSED),
        ("sign(x - 0.002) + 1".to_owned(), 2.0 * 1.998, ENCLOSED),
        ("sign(x^2 + y^2 - 0.25) + 1".to_owned(), 4.0 - std::f64::consts::PI / 8.0, ENCLOSED_LINE),
    ] {
        for cells in [vec![Cell::Quad(SQUARE)], halves.map(Cell::Triangle).to_vec()] {
            let all = on(&text, |f| over_cells(f, &cells))?;
            let sum: f64 = all.iter().map(|of| of.value).sum();
            let missed: f64 = all.iter().map(|of| of.missed).sum();
            assert!((sum - exact).abs() <= missed + 1e-13, "{text}: {sum} ± {missed}, {exact}");
            tolerance.check(&text, missed);
        }
    }
    Ok(())
}

/// sin z/z is smooth, and no enclosure says so where z = 0: its points are a value, the middle of next to everything is none.
#[test]
fn what_cannot_be_enclosed_keeps_what_its_points_see() -> Result<()> {
    let z = 0.75_f64;
    for text in [format!("sin(x - {z})/(x - {z})"), format!("(x - {z})/(x - {z})")] {
        let of = &on(&text, |f| over_cells(f, &[Cell::Quad(SQUARE)]))?[0];
        assert!((0.8 * 2.0..1.01 * 2.0).contains(&of.value), "{text}: {of:?}");
    }
    Ok(())
}

/// Of what is smooth over some cells, the rule's own bits stay, and no part is cut.
#[test]
fn the_rule_is_proved_for_waves_that_it_resolves() -> Result<()> {
    let h = 1.0 / 16.0;
    let cells = [
        Cell::Triangle([[0.5, 0.25], [0.5 + h, 0.25], [0.5 + h, 0.25 + h]]),
        Cell::Quad([[0.5, 0.25], [0.5 + h, 0.25], [0.5 + h, 0.25 + h], [0.5, 0.25 + h]]),
    ];
    for text in ["6*sin(1.2 + 4*x)", "exp(3*x - y)*cos(8*y)", "1/(2 + x)"] {
        let (all, rule) = on(text, |f| {
            (over_cells(f, &cells), cells.each_ref().map(|cell| by_rule(f, &rule_of(cell))[0]))
        })?;
        let expected = rule.map(|value| Integral { value, missed: 0.0 });
        assert_eq!(all, expected, "{text}");
    }
    Ok(())
}

#[test]
fn a_narrow_bump_is_found_and_integrated() -> Result<()> {
    for width in [0.3, 0.01, 1e-3] {
        let text = format!("exp(-((x - 0.77)^2 + (y - 0.53)^2)/{width}^2)");
        let of = on(&text, |f| over_cells(f, &[Cell::Quad(SQUARE)]))?[0];
        let exact = std::f64::consts::PI * width * width;
        // 0.3 is cut off at the sides.
        let is_held = (of.value - exact).abs() <= of.missed + 1e-12 * exact;
        assert!(width > 0.1 || is_held, "{of:?}, {exact}");
        ENCLOSED.check_over(&text, of.missed, exact);
    }
    Ok(())
}

#[test]
fn edges_are_resolved_to_the_last_jump() -> Result<()> {
    let edge = [[0.0, 0.0], [1.0, 0.0]];
    for (text, exact) in [
        ("sign(x - 0.3711)", 1.0 - 2.0 * 0.3711),
        ("max(0, 1 - abs(x - 0.3711)/1e-4)", 1e-4),
        ("sqrt(x)", 2.0 / 3.0),
    ] {
        let mean = on(text, |f| mean_on_edge(f, edge))?;
        assert!((mean.value - exact).abs() <= mean.missed + 1e-14, "{text}: {mean:?}");
        ENCLOSED.check(text, mean.missed);
    }
    Ok(())
}

#[test]
fn smooth_data_keep_the_bits_of_the_rule() -> Result<()> {
    for text in ["1 + x*y - x^3", "sin(2*x)*exp(y)", "1/(3 + x + y)", "abs(x + 1)*sqrt(y + 2)"] {
        let square = Cell::Quad(SQUARE);
        let points = square.points(f64::GAUSS[DATA_POINTS - 1]);
        let of = on(text, |f| {
            let rule = points.iter().fold(0.0, |sum, p| sum + p.weight * f.at(p.x[0], p.x[1]));
            (over_cells(f, &[square])[0], rule)
        })?;
        assert_eq!(of.0, Integral { value: of.1, missed: 0.0 }, "{text}");
    }
    Ok(())
}

#[test]
fn what_is_not_finite_stays_so() -> Result<()> {
    let of = on("1/(x - x)", |f| over_cells(f, &[Cell::Quad(SQUARE)]))?;
    assert!(!of[0].value.is_finite());
    Ok(())
}

//! Powers of distances in closed form.

use super::super::{Growth, Region};
use super::T;
use super::exact::parse;

const ONE: [[f64; 2]; 3] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];

fn growth(text: &str, region: &Region) -> Growth {
    parse(text).growth(region, T).unwrap_or_else(|| panic!("{text} grows in no known way"))
}

#[test]
fn exponents_are_read_off_the_tree() {
    let inside = Region::quad([[-1.0, -1.0], [2.0, -1.0], [2.0, 2.0], [-1.0, 2.0]]);
    let edge = Region::segment([[-1.0, 0.0], [2.0, 0.0]]);
    for (text, exponent, region) in [
        ("((x - 0.22)^2 + (y - 0.31)^2)^-0.99", -1.98, &inside),
        ("-0.0004/((x - 0.22)^2 + (y - 0.31)^2)^0.99", -1.98, &inside),
        ("1/sqrt(4*x^2 + (x + y - 1)^2)", -1.0, &inside),
        ("abs(x - 0.5*y)^-0.3*(2 + sin(x))", -0.3, &inside),
        ("-(0.02*y - 0.0062)/((x - 0.22)^2 + (y - 0.31)^2)^0.99", -0.98, &inside),
        ("ln(x^2 + y^2)", -0.0625, &inside),
        ("ln(abs(y))", -0.0625, &inside),
        ("((x - 0.22)^2 + y^2)^-0.3 + 3", -0.6, &edge),
        ("abs(x)^-0.5*exp(x)", -0.5, &edge),
    ] {
        let found = growth(text, region);
        assert!((found.exponent - exponent).abs() < 1e-12, "{text}: {found:?}");
        assert!(found.low <= found.high && found.high.is_finite(), "{text}: {found:?}");
    }
}

/// ∫r^−p from a corner, inside and on a side of triangles: in polar coordinates by a fine sum of angles.
#[test]
fn integrals_of_powers_hold_the_exact_ones() {
    for point in [[0.0, 0.0], [0.25, 0.25], [0.5, 0.0]] {
        for p in [0.5, 1.0, 1.9, 1.99] {
            let text = format!("((x - {:?})^2 + (y - {:?})^2)^{}", point[0], point[1], -0.5 * p);
            // ∫ dθ R^(2 − p)/(2 − p) with R to where the ray leaves.
            let steps = 200_000;
            let exact: f64 = (0..steps)
                .map(|k| {
                    let angle = std::f64::consts::TAU * (f64::from(k) + 0.5) / f64::from(steps);
                    let [x, y] = [angle.cos(), angle.sin()];
                    let leaves = |gap: f64, speed: f64| {
                        if speed > 1e-12 { gap / speed } else { f64::INFINITY }
                    };
                    let radius = leaves(point[0], -x)
                        .min(leaves(point[1], -y))
                        .min(leaves(1.0 - point[0] - point[1], x + y));
                    std::f64::consts::TAU / f64::from(steps) * radius.powf(2.0 - p) / (2.0 - p)
                })
                .sum();
            let mut parts = vec![Region::triangle(ONE)];
            for _ in 0..4 {
                let all = parts.iter().map(|part| part.grown(&growth(&text, part), 1.0));
                let [low, high] =
                    all.fold([0.0; 2], |[low, high], of| [low + of.low, high + of.high]);
                let is_held = low <= exact * (1.0 + 1e-4) && high >= exact * (1.0 - 1e-4);
                assert!(is_held, "{text}: {low} {high}, {exact}");
                parts = parts.iter().flat_map(Region::parts).collect();
            }
        }
    }
}

/// Between two poles that are 1e−11 apart stands a peak with an integral of its own.
#[test]
fn poles_that_are_near_each_other_are_not_one() {
    let edge = Region::segment([[-1.0, 0.0], [1.0, 0.0]]);
    for text in ["abs(x)^0.9*abs(x - 1e-11)^-0.9", "abs(x)^-0.3*abs(x - 1e-11)^-0.3"] {
        assert_eq!(parse(text).growth(&edge, T).and_then(|of| of.place), None, "{text}");
    }
    // The same place in other words.
    for text in ["abs(x)^0.9*abs(3*x)^-0.3", "abs(0.7*x - 0.07)^-0.3*abs(x - 0.1)^-0.3"] {
        assert!(parse(text).growth(&edge, T).is_some_and(|of| of.place.is_some()), "{text}");
    }
}

/// 1e−400 is not 0 where 1e390 follows.
#[test]
fn factors_that_underflow_leave_a_growth() {
    let edge = Region::segment([[0.0, 0.0], [1.0, 0.0]]);
    for text in ["1e-200*x^-0.5*1e-200*1e200*1e190", "(1e-200*x^-0.5)^2*1e200*1e190"] {
        let found = growth(text, &edge);
        assert!(found.low <= 1e-10 && found.high >= 1e-10, "{text}: {found:?}");
    }
}

#[test]
fn what_is_not_integrable_is_proved() {
    let one = Region::triangle(ONE);
    assert_eq!(one.grown(&growth("(x^2 + y^2)^-1", &one), 1.0).low, f64::INFINITY);
    assert_eq!(one.grown(&growth("(x^2 + y^2)^-0.5", &one), 2.0).low, f64::INFINITY);
    assert!(one.grown(&growth("(x^2 + y^2)^-0.495", &one), 2.0).is_finite());
    // What is 0 at the pole may be integrable after all.
    assert_eq!(one.grown(&growth("x*(x^2 + y^2)^-1.5", &one), 1.0).low, 0.0);
}

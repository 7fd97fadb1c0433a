//! Errors of Gauss rules, and how much continuations allow for.

use super::super::super::operation::Unary;
use super::super::super::program::Numbers;
use super::super::continuation::{Disc, Discs};
use super::exact::{parse, square};
use super::random::Random;
use super::{T, TREES};
use std::f64::consts::{FRAC_2_SQRT_PI, TAU};

/// Of integrals by Gauss points no more is missed than discs say, and of smooth data nearly nothing.
#[test]
fn rules_miss_no_more_than_continuations_allow() {
    let rule = [
        [0.069_431_844_202_973_71, 0.173_927_422_568_726_93],
        [0.330_009_478_207_571_87, 0.326_072_577_431_273_07],
        [0.669_990_521_792_428_1, 0.326_072_577_431_273_07],
        [0.930_568_155_797_026_3, 0.173_927_422_568_726_93],
    ];
    let mut random = Random(0xd15c);
    let mut finite = 0;
    for _ in 0..TREES / 2 {
        let (expression, region) = (random.expression(), random.region());
        let value = |[a, b]: [f64; 2]| {
            let (at, density) = match region.corners().len() {
                2 => ([2.0 * a - 1.0, 0.0], 1.0),
                3 => ([a * (1.0 - b) - 1.0 / 3.0, b - 1.0 / 3.0], 2.0 * (1.0 - b)),
                _ => {
                    let at = [2.0 * a - 1.0, 2.0 * b - 1.0];
                    (at, region.density().at(at).middle() / region.measure())
                }
            };
            let [x, y] = region.place(at);
            region.measure() * density * expression.eval(x, y, T)
        };
        let on = |[a, b]: [f64; 2], [c, d]: [f64; 2]| -> f64 {
            let points = rule.iter().flat_map(|p| rule.map(|q| (p[1] * q[1], [p[0], q[0]])));
            let at = |[p, q]: [f64; 2]| value([a + p * (b - a), c + q * (d - c)]);
            points.map(|(weight, place)| weight * (b - a) * (d - c) * at(place)).sum()
        };
        let whole = on([0.0, 1.0], [0.0, 1.0]);
        let cut = |k: usize| [k as f64 / 8.0, (k + 1) as f64 / 8.0];
        let parts: f64 = (0..64).map(|k| on(cut(k / 8), cut(k % 8))).sum();
        for rho in [2.0, 4.0, 16.0, 64.0] {
            let modulus = expression.modulus(&region, rho, T);
            if !modulus.is_finite() {
                continue;
            }
            finite += usize::from(rho == 4.0);
            let missed = region.missed(4, rho, modulus) + 1e-13 * region.measure() * modulus;
            let off = (whole - parts).abs();
            assert!(off <= missed, "{expression}, ρ = {rho}: {whole} {parts}, {missed}");
        }
    }
    assert!(finite > TREES / 10, "{finite}");
    let smooth = parse("sin(pi*x)*exp(y)");
    let region = square(0.25, 0.5, 0.125);
    assert!(region.missed(8, 16.0, smooth.modulus(&region, 16.0, T)) < 1e-13 * region.measure());
    // Beside a kink as well.
    let branch = parse("max(x - 0.5*y, 0)*exp(y)");
    let beside = square(0.25, 0.375, 0.125);
    assert!(beside.missed(8, 16.0, branch.modulus(&beside, 16.0, T)) < 1e-13 * beside.measure());
    assert_eq!(branch.modulus(&square(0.125, 0.375, 0.125), 16.0, T), f64::INFINITY);
}

/// What underflows in the middle of a cell is not 0 beside it.
#[test]
fn moduli_hold_what_the_middle_has_lost() {
    let region = square(1.0, 0.0, 1.0);
    for text in [
        "exp(600 - 600*(x - 1))*exp(-600 - 520*(x - 1))*30",
        "1e84*exp(-1120*(x - 1.5) - 750)",
        "(0.5*x)^3000.5",
        "(x - 0.25)^-3000.5*1e-300*1e-70",
        "(0.5*x)^3000",
        "(1e-200*exp(700*(x - 2)))*(1e-200*exp(300*(x - 1)))*1e200*1e70",
    ] {
        let expression = parse(text);
        for rho in [2.0, 4.0, 16.0, 64.0] {
            let most = [1.0, 1.2, 1.5, 2.0].map(|x| expression.eval(x, 0.5, T)).map(f64::abs);
            let most = most.into_iter().filter(|value| value.is_finite()).fold(0.0, f64::max);
            let modulus = expression.modulus(&region, rho, T);
            assert!(most <= modulus, "{text}, ρ = {rho}: {most:e}, {modulus:e}");
        }
    }
    // And nothing that is 0 is more.
    assert_eq!(parse("max(x - 9, 0)^2*exp(y)").modulus(&region, 4.0, T), 0.0);
}

/// erf z = 2/√π Σ (−1)ⁿz²ⁿ⁺¹/(n!(2n + 1))
fn erf([u, v]: [f64; 2]) -> [f64; 2] {
    let times = |[a, b]: [f64; 2], [c, d]: [f64; 2]| [a * c - b * d, a * d + b * c];
    let square = times([u, v], [-u, -v]);
    let (mut power, mut sum) = ([u, v].map(|part| FRAC_2_SQRT_PI * part), [0.0; 2]);
    for n in (0..100).map(f64::from) {
        sum = [0, 1].map(|k| sum[k] + power[k] / (2.0 * n + 1.0));
        power = times(power, square).map(|part| part / (n + 1.0));
    }
    sum
}

/// On the edge of each disc, where the modulus is largest; and small discs are as steep as the real function.
#[test]
fn discs_hold_the_error_function_of_complex_numbers() {
    let mut random = Random(0xe4f);
    for _ in 0..TREES {
        let (centre, radius) = (random.between(-2.0, 2.0), random.between(0.0, 2.0));
        let [of, rest] = [Unary::Erf, Unary::Erfc]
            .map(|operation| Discs(1.0).unary(operation, Disc::new(centre, radius)));
        let angle = random.between(0.0, TAU);
        let [real, imaginary] = erf([centre + radius * angle.cos(), radius * angle.sin()]);
        let off = (real - of.centre).hypot(imaginary);
        assert!(off <= of.radius + 1e-12, "{centre}, {radius}: {off}, {of:?}");
        let off = (1.0 - real - rest.centre).hypot(imaginary);
        assert!(off <= rest.radius + 1e-12, "{centre}, {radius}: {off}, {rest:?}");
        let steep = 1e-6 * Unary::Erf.derivative(centre);
        let small = Discs(1.0).unary(Unary::Erf, Disc::new(centre, 1e-6)).radius;
        assert!((small - steep).abs() < 1e-5 * steep, "{centre}: {small}, {steep}");
    }
}

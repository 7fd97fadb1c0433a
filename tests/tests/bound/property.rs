//! On random scenes with an exact solution, stopped at any time; and changes that must not move the bound: the order of the
//! cells, the units.

use signorini_kernel::element::QuadElement;
use signorini_problem::Problem;
use signorini_solve::{Options, ScalarKind};
use signorini_tests::polynomial::Polynomial;
use signorini_tests::random::Random;
use signorini_tests::written::{Side, Smooth, TwoMaterials, Units, Written};
use signorini_tolerances::twins::{
    BOUND_ROUNDING, BOUND_ROUNDING_NARROW, GUARANTEE, GUARANTEE_SMOOTH, IDENTITY, IDENTITY_SMOOTH,
    LIFTED, ORDER, UNITS,
};
use signorini_tolerances::{cases, some};

use super::run::{Certified, Run, options, run};
use crate::mesh::{KINDS, regular, relisted, scaled, scattered};

/// A scene and what to expect of the quadrature of its norms.
struct Draw {
    name: String,
    written: Written,
    smooth: bool,
}

/// A number with three digits: an expression has at most 4096 bytes.
fn between(random: &mut Random, low: f64, high: f64) -> f64 {
    (1e3 * random.between(low, high)).round() / 1e3
}

/// A power of ten between two exponents, with three digits.
fn power(random: &mut Random, low: f64, high: f64) -> f64 {
    let exponent = random.between(low, high);
    let unit = 10f64.powf(exponent.floor() - 2.0);
    (10f64.powf(exponent) / unit).round() * unit
}

fn draw(random: &mut Random) -> Draw {
    if random.below(4) == 0 {
        let smooth = Smooth::random(random);
        let name = format!("smooth, {:?}", smooth.contact);
        return Draw { name, written: smooth.written(), smooth: true };
    }
    let (case, jumps) = match random.below(5) {
        0 => (TwoMaterials::a(), false),
        1 => (TwoMaterials::b(), false),
        2 => (TwoMaterials::h(between(random, 0.2, 0.9)), false),
        3 => (TwoMaterials::h_gap(between(random, 0.2, 0.9)), false),
        _ => (TwoMaterials::jump(power(random, -4.0, 4.0)), true),
    };
    let case = match random.below(2) {
        0 => case,
        _ => case.plus(&lift(random, jumps)),
    };
    if random.below(2) == 0 {
        return Draw { name: case.name.clone(), written: case.written(), smooth: false };
    }
    // det A = 1 and tr A = κ + (s² + 1)/κ: conditions up to about 100.
    let s = if jumps { 0.0 } else { between(random, -2.0, 2.0) };
    let kappa = power(random, -0.5, 0.9);
    let name = format!("T({s:.2}, {kappa:.2}) of {}", case.name);
    Draw { name, written: case.transformed(s, kappa), smooth: false }
}

/// A random G; where A jumps without terms of odd order across the jump.
fn lift(random: &mut Random, jumps: bool) -> Polynomial {
    let g = TwoMaterials::lift([(); 4].map(|()| between(random, -1.0, 1.0)));
    let skew = Polynomial::new([([1, 2], between(random, -1.0, 1.0))]);
    if jumps { g } else { g.plus(&skew) }
}

/// Conditions on the sides, one of which holds the domain.
fn sides(random: &mut Random) -> [Side; 3] {
    let all = [Side::Dirichlet, Side::Neumann, Side::Robin];
    let mut sides = [(); 3].map(|()| all[random.below(3) as usize]);
    if sides == [Side::Neumann; 3] {
        sides[random.below(3) as usize] = Side::Dirichlet;
    }
    sides
}

/// Scenes to draw.
const SEEDS: u64 = 100;

/// A scene on its mesh, and how it is solved.
pub struct Trial {
    what: String,
    smooth: bool,
    /// Whether s is the average of u_h.
    averages: bool,
    run: Run,
}

/// Half of the scenes that are not waited for are stopped within 18 sweeps. `also` may add to the text of
/// the scene.
pub fn trial(seed: u64, also: impl Fn(String) -> String) -> Trial {
    let random = &mut Random::new(seed);
    let Draw { name, written, smooth } = draw(random);
    let (n, cells) = (3 + random.below(4), KINDS[random.below(3) as usize]);
    let moved = random.below(3) > 0;
    let mesh = if moved { scattered(random, n, cells) } else { regular(n, cells) };
    let scalar = if random.below(3) == 0 { ScalarKind::F32 } else { ScalarKind::F64 };
    let sweeps = Some(power(random, 0.0, 2.5) as u32).filter(|_| random.below(3) > 0);
    let text = also(written.scene(sides(random), Units::ONE));
    let averages = random.below(2) == 0;
    let run = run(&text, mesh, &Options { averages, ..options(scalar, sweeps) });
    let what = format!("seed {seed}: {name} on {cells:?}, {n}, {scalar:?}, {sweeps:?} sweeps");
    Trial { what, smooth, averages, run }
}

/// The guarantee and the identity.
pub fn check(Trial { what, smooth, averages, run }: &Trial) {
    let Some(found) = run.certified() else { panic!("{what}: no bound") };
    let Certified { bound, combined, identity, .. } = found;
    let (guarantee, same) =
        if *smooth { (GUARANTEE_SMOOTH, IDENTITY_SMOOTH) } else { (GUARANTEE, IDENTITY) };
    guarantee.check_at_most(what, combined, bound.total);
    same.check_relative(what, bound.duality_gap, identity);
    let rounding = match run.solution.scalar {
        ScalarKind::F64 => BOUND_ROUNDING,
        ScalarKind::F32 => BOUND_ROUNDING_NARROW,
    };
    rounding.check(what, bound.rounding / bound.total);
    guarantee.check_at_most(what, found.energy, bound.of_u);
    if *averages {
        lifted(what, &run.problem, &found);
    }
    let both = (bound.duality_gap.powi(2) + bound.oscillation.powi(2)).sqrt();
    assert!(bound.total >= bound.oscillation + both, "{what}: {bound:?}");
}

/// The bound of u_h is that of s and the norm of s − u_h. (Where s is not the average, it may be what the average has.)
fn lifted(what: &str, problem: &Problem, Certified { bound, nonconformity, .. }: &Certified) {
    let added = bound.of_u - bound.total;
    LIFTED.check_at_most(what, *nonconformity, added);
    // On bent quads the norm of a lift is added to that of the rest.
    let most = if problem.element == QuadElement::Nonparametric { 3.0 } else { 1.0 };
    let rest = (added - 4.0 * bound.rounding).max(0.0);
    LIFTED.check(what, (rest / nonconformity - most).max(0.0));
}

#[test]
fn the_bound_holds_and_is_what_the_identity_says() {
    (0..cases(SEEDS)).for_each(|seed| check(&trial(seed, |text| text)));
}

const SIDES: [Side; 3] = [Side::Neumann, Side::Robin, Side::Dirichlet];

/// With the average: sweeps over the vertices find another s in another order.
#[test]
fn cells_in_another_order() {
    let text = TwoMaterials::h_gap(0.55).written().scene(SIDES, Units::ONE);
    for cells in KINDS {
        let mesh = scattered(&mut Random::new(1), 6, cells);
        let [bound, other] = [mesh.clone(), relisted(mesh)].map(|mesh| {
            let options = Options { averages: true, ..options(ScalarKind::F64, None) };
            run(&text, mesh, &options).solution.bound.expect("held")
        });
        ORDER.check_relative(format_args!("{cells:?}"), other.total, bound.total);
    }
}

#[test]
fn units_of_length_and_of_u() {
    let written = TwoMaterials::h_gap(0.55).written();
    for cells in KINDS {
        let ratio = |units: Units| {
            let mesh = scaled(scattered(&mut Random::new(2), 4, cells), units.length);
            let run = run(&written.scene(SIDES, units), mesh, &options(ScalarKind::F32, None));
            let found = run.certified().expect("held");
            found.bound.total / found.combined
        };
        let expected = ratio(Units::ONE);
        let of = |length| [1e-6, 1.0, 1e6].map(|value| Units { length, value });
        for units in some(5, [1e-6, 1.0, 1e6].into_iter().flat_map(of)) {
            UNITS.check_relative(format_args!("{cells:?}, {units:?}"), ratio(units), expected);
        }
    }
}

//! The bound of f32 against the same form in f64, at the p and x of the target: rounding is covered.
//!
//! [`signorini_condense::CondensedModel::bound`] is what tests of the host compare with exact solutions.
//! The kernel's total without its rounding may miss it by that rounding; then the total is above it.

use signorini_bake::Bakes;
use signorini_bake::condensed::{Baked, Controller, Work};
use signorini_tests::random::Random;
use signorini_tests::written::{SIDES, Side, Smooth, TwoMaterials, Units};
use signorini_tolerances::some;
use signorini_tolerances::twins::{BOUND_ROUNDING, BOUND_ROUNDING_NARROW, OSCILLATING};

use super::scenes::{EXACT, Model};
use crate::mesh::{KINDS, regular, scaled};

/// Solved to the end, and cut off in every way.
const WORKS: [Work; 5] = [
    EXACT,
    Work { pivots: Some(1), sweeps: 0 },
    Work { pivots: Some(2), sweeps: 1 },
    Work { pivots: None, sweeps: 1 },
    Work { pivots: None, sweeps: 7 },
];

/// Random scenes to draw.
const SEEDS: u64 = 60;

/// The outcome of many bounds.
#[derive(Debug, Clone, Copy, Default)]
struct Found {
    /// The largest part of the stated rounding that there was, and that of which model.
    used: f64,
    /// The largest share of rounding in a total.
    share: f64,
    bounds: usize,
    without: usize,
}

/// Ticks at inputs `draw`n for each of them.
fn judge<R: Bakes>(model: &Model, mut draw: impl FnMut(usize) -> f64, found: &mut Found) {
    for work in WORKS {
        let baked: Baked<R> = model.baked(work);
        let mut controller = Controller::new(&baked);
        for _ in 0..3 {
            let inputs = 0..model.problem.scene.inputs.len();
            let p: Vec<R> = inputs.map(|at| R::narrow(draw(at))).collect();
            let (_, report) = controller.tick(&p).expect("a tick");
            let p: Vec<f64> = std::iter::once(1.0).chain(p.iter().map(|p| p.wide())).collect();
            let x: Vec<f64> = controller.x().iter().map(|x| x.wide()).collect();
            let (Some(certificate), Some(bound)) =
                (report.certificate().copied(), model.condensate.bound(&p, &x))
            else {
                found.without += 1;
                continue;
            };
            let of_u = model.condensate.bound_of_u(&p, &x).expect("as the other");
            assert!(certificate.of_u.wide() >= of_u, "{certificate:?} {of_u:e}");
            let (total, rounding) = (certificate.total.wide(), certificate.rounding.wide());
            // What rounding may do at corners stands in the oscillation: the kernel's may be more.
            let over = total - rounding - bound;
            let used = (-over).max(0.5 * over) / rounding;
            let what = || format!("{} {} {work:?}: {certificate:?} {bound:e}", model.what, R::NAME);
            assert!(used <= 1.0 && total >= bound, "{}", what());
            found.used = found.used.max(used);
            found.share = found.share.max(rounding / total);
            found.bounds += 1;
        }
    }
}

#[test]
fn of_random_scenes() {
    let (mut wide, mut narrow) = (Found::default(), Found::default());
    for seed in 0..signorini_tolerances::cases(SEEDS) {
        let Some(model) = Model::random(seed, 5) else { continue };
        let random = &mut Random::new(seed);
        let defaults: Vec<f64> =
            model.problem.scene.inputs.iter().map(|input| input.default).collect();
        let mut draw = |at: usize| defaults[at] + random.between(-2.0, 2.0);
        judge::<f32>(&model, &mut draw, &mut narrow);
        judge::<f64>(&model, &mut draw, &mut wide);
    }
    let least = signorini_tolerances::cases(200) as usize;
    assert!(narrow.bounds > least && wide.bounds > least);
    BOUND_ROUNDING_NARROW.check("condensed", narrow.share);
    BOUND_ROUNDING.check("condensed", wide.share);
}

/// Jumps of 10⁴, units of 10^±15, and a level of all of u that is 10⁴ times its range; corners where u_D is
/// above the gap, domains that contact alone holds.
#[test]
fn of_contrasts_units_levels_corners_and_floating_parts() {
    use Side::{Dirichlet, Neumann, Robin};
    let (mut all, mut has_corners, mut has_floating) = (Found::default(), false, false);
    let random = &mut Random::new(7);
    let [soft, stiff] = [1e4, 1e-4].map(TwoMaterials::jump);
    let cases = [soft, stiff, TwoMaterials::h(0.55), TwoMaterials::b()];
    let smooth = [(); 4].map(|()| Smooth::random(random).written());
    let all_written = cases.map(|case| case.written()).into_iter().chain(smooth);
    let all_units = [(1.0, 1.0), (1e3, 1e15), (1e-3, 1e-15), (1.0, 1e-15), (1e5, 1e-10)];
    let all_sides =
        [[Dirichlet; 3], [Dirichlet, Neumann, Robin], [Robin, Neumann, Dirichlet], [Neumann; 3]];
    let in_units = |of| all_units.map(|units| (of, units));
    let combined = |at| all_sides.map(|sides| in_units((at, sides)));
    let all_written: Vec<_> = all_written.collect();
    let combined = (0..all_written.len()).flat_map(combined).flatten();
    for ((at, sides), (length, value)) in some(7, combined) {
        let written = &all_written[at];
        let mut text = written.scene(sides, Units { length, value });
        text += &input("drop", "contact", "gap", -0.1 * value);
        // Levels of neighbouring Dirichlet sides could not change one at a time.
        if sides != [Dirichlet; 3] {
            text += &input("level", "contact", "gap", value);
            for (name, side) in SIDES.into_iter().zip(sides) {
                text += &match side {
                    Dirichlet => input(name, name, "value", value),
                    Robin => input(name, name, "ambient", value),
                    Neumann => String::new(),
                };
            }
        }
        let mesh = scaled(regular(4, KINDS[at % 3]), length);
        let what = format!("{at} in {length:e} {value:e} with {sides:?}");
        let model = match Model::of_text(what, &text, mesh) {
            // Where nothing touches, no load pushes.
            Err(error) if error.contains("no unique solution") => continue,
            model => model.unwrap_or_else(|error| panic!("{error}\n{text}")),
        };
        let form = model.condensate.certificate.as_ref();
        let form = form.unwrap_or_else(|why| panic!("{}: {why}", model.what));
        has_corners |= !form.corners.is_empty();
        has_floating |= !form.floating.is_empty();
        for level in [0.0, 1e4] {
            let draw = |at| if at == 0 { random.between(0.0, 2.0) } else { level };
            judge::<f32>(&model, draw, &mut all);
        }
    }
    assert!(has_corners && has_floating && all.bounds > all.without, "{all:?}");
}

fn input(name: &str, of: &str, field: &str, pattern: f64) -> String {
    format!("[input.{name}]\nof = \"{of}\"\nfield = \"{field}\"\npattern = {pattern:e}\n")
}

/// Sources whose mean over every cell is 0: the oscillation is all of the bound, and so is its rounding.
#[test]
fn of_nothing_but_oscillation() {
    let mut text = "mesh = \"none.msh\"\n[material.default]\nconductivity = 1\n".to_owned();
    text += "[boundary.contact]\nkind = \"contact\"\n[boundary.default]\nkind = \"dirichlet\"\nvalue = 0\n";
    for at in 0..40 {
        let pattern = format!("{}.1*sin(8*pi*x)", at % 7 + 1);
        text += &format!(
            "[input.f{at}]\nof = \"source\"\nfield = \"f\"\npattern = \"{pattern}\"\ndefault = 1\n"
        );
    }
    let model = Model::of_text("oscillation".to_owned(), &text, regular(4, KINDS[1]));
    let (model, mut found) = (model.unwrap_or_else(|error| panic!("{error}")), Found::default());
    let random = &mut Random::new(5);
    judge::<f32>(&model, |_| random.between(0.1, 1.0), &mut found);
    assert!(found.bounds > 0, "{found:?}");
    OSCILLATING.check("condensed", found.share);
}

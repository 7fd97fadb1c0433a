//! Sides, limits and affine maps of models that can be worked out on paper.

use signorini_tolerances::solve::KNOWN;

use super::super::reduced::Reduced;
use super::super::reduction::{Affine, Reduction};
use super::super::sides::{EdgeSide, Sides};
use crate::{CondensedModel, Measure};

/// The outputs are the sum of all reactions, and a length.
fn model(matrix: &[f64], load: &[&[f64]], ranges: &[[f64; 2]]) -> CondensedModel {
    let n = load[0].len();
    let force =
        Measure::Flux { of_inputs: Vec::new(), of_contact: Vec::new(), of_reaction: vec![1.0; n] };
    let length = Measure::Length { always: 0.25, of_contact: vec![1.0; n] };
    let load = load.iter().map(|column| column.to_vec()).collect();
    super::model(matrix.to_vec(), load, ranges, vec![force, length])
}

fn sides(of: &CondensedModel) -> Sides {
    Sides::new(of).expect("finite loads")
}

const DIAGONAL: [f64; 9] = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
const BOX: [[f64; 2]; 2] = [[1.0, 1.0], [-0.5, 2.0]];

#[test]
fn each_side_is_told_with_its_limits() {
    let model = model(&DIAGONAL, &[&[1.0, -3.0, 0.0], &[1.0, 1.0, 0.5]], &BOX);
    let Sides { of, kept, limits, enclosure, .. } = sides(&model);
    assert_eq!(of, [EdgeSide::Open, EdgeSide::Touching, EdgeSide::MayChange]);
    assert_eq!(kept, [false, false, true]);
    let enclosure = enclosure.expect("proved");
    let near = |found: f64, known: f64| {
        assert!((found - known).abs() < 1e-6, "{found} instead of {known}");
    };
    enclosure.lo.iter().zip([0.5, 0.0, 0.0]).for_each(|(lo, known)| near(*lo, known));
    enclosure.hi.iter().zip([3.0, 0.0, 1.0]).for_each(|(hi, known)| near(*hi, known));
    near(enclosure.reaction[1], 1.0);
    near(limits[0][0], 0.25);
    assert_eq!(limits[2][0], 0.0);
    // More than every solution, by a thousandth.
    assert!((1.0009..1.0012).contains(&limits[2][1]), "{limits:?}");
    // Of an edge that never opens, by what rounding makes of the largest.
    assert!((4e-5..6e-5).contains(&limits[1][1]), "{limits:?}");
}

/// A side that rounding of the target's scalar may reach is not told.
#[test]
fn openings_that_may_be_rounding_may_change() {
    for (opening, side) in [(9e-7, EdgeSide::MayChange), (1.2e-6, EdgeSide::Open)] {
        let model = model(&DIAGONAL, &[&[1.0, opening, -1.0]], &[[1.0, 1.0]]);
        assert_eq!(sides(&model).of[1], side, "{opening}");
    }
    // A reaction of an input that f32 may have rounded.
    for (reaction, side) in [(5e-8, EdgeSide::MayChange), (3e-7, EdgeSide::Touching)] {
        let load: [&[f64]; 2] = [&[1.0, -1.0 - reaction, -1.0], &[0.0, 1.0, 0.0]];
        let model = model(&DIAGONAL, &load, &[[1.0, 1.0], [0.0, 1.0]]);
        assert_eq!(sides(&model).of[1], side, "{reaction}");
    }
}

/// Where a limit is rounded to f32, even upwards, what was taken out stays on its side.
#[test]
fn limits_of_f32_keep_every_side() {
    let matrix = [1.0, -0.5, -0.5, 1.0];
    let mut counts = [0, 0];
    for at in 0..400 {
        let size = 1.0 + f64::from(at % 20) / 37.0;
        // r_T = −½x_U − b_T is 0 within 4e−7 of the largest x_U, p and limits being rounded outwards.
        let off = 1.0 + f64::from(at / 20 - 10) * 4e-8;
        let limit = |size: f64| size * (1.0 + 1.0 / 1024.0 + 1.0 / 65536.0);
        let of_f32 = 1.0 + f64::from(f32::EPSILON);
        let load = -0.5 * limit(size) * of_f32 * off;
        let model = model(&matrix, &[&[0.0, load], &[size, 0.0]], &[[1.0, 1.0], [-1.0, 1.0]]);
        let sides = sides(&model);
        counts[usize::from(sides.kept[1])] += 1;
        if !sides.kept[1] {
            let most = f64::from(sides.limits[0][1] as f32);
            assert!(-0.5 * most - load >= 0.0, "{at}: {most} {load}");
        }
    }
    assert!(counts.iter().all(|&count| count > 40), "{counts:?}");
}

/// S = (1, −½, −¼; −½, 1, 0; −¼, 0, 1): 0 open, 1 touching, 2 kept.
#[test]
fn affine_maps_are_those_of_elimination() {
    let matrix = [1.0, -0.5, -0.25, -0.5, 1.0, 0.0, -0.25, 0.0, 1.0];
    let whole = model(&matrix, &[&[2.0, -4.0, 0.0], &[0.5, 0.25, 1.0]], &[[1.0, 1.0], [-1.0, 1.0]]);
    let sides = sides(&whole);
    assert_eq!(sides.of, [EdgeSide::Open, EdgeSide::Touching, EdgeSide::MayChange]);
    let maps = sides.reduction(&whole).expect("positive definite");
    assert_eq!((&maps.open, &maps.touching, &maps.kept), (&vec![0], &vec![1], &vec![2]));
    // x_0 = 2 + ½p + ¼x_2
    KNOWN.check_each("x_O", &maps.x[0], &[2.0, 0.5, 0.25]);
    // −½x_0 + 4 − ¼p
    KNOWN.check_each("r_T", &maps.r[1].factors, &[3.0, -0.5, -0.125]);
    // −¼x_0 + x_2 − p
    KNOWN.check_each("r_U", &maps.r[2].factors, &[-0.5, -1.125, 0.9375]);
    KNOWN.check_each("r_O", &maps.r[0].factors, &[0.0; 3]);
    let reduced = Reduced::new(&whole, sides).expect("edges to take out");
    let s = 0.9375_f64.sqrt();
    assert_eq!((reduced.model.contact, &reduced.model.edges), (1, &vec![2]));
    KNOWN.check_each("S′", &reduced.model.matrix, &[1.0]);
    KNOWN.check_each(
        "B′",
        &[reduced.model.load[0][0], reduced.model.load[1][0]],
        &[0.5 / s, 1.125 / s],
    );
    KNOWN.check_each("d", &reduced.model.opening, &[1.0 / s]);
    KNOWN.check_each("of r", &reduced.model.multiplier, &[s]);
    KNOWN.check_each("x", &reduced.expand(&[1.0, 0.5], &[0.125 * s]), &[2.28125, 0.0, 0.125]);
    let force = Measure::Flux {
        of_inputs: vec![3.0, -0.5],
        of_contact: vec![-0.125 / s],
        of_reaction: vec![s],
    };
    let Measure::Flux { of_inputs, of_contact, of_reaction } = &reduced.model.outputs[0] else {
        panic!("{force:?}");
    };
    KNOWN.check_each("force of inputs", of_inputs, &[3.0, -0.5]);
    KNOWN.check_each("force of openings", of_contact, &[-0.125 / s]);
    KNOWN.check_each("force of reactions", of_reaction, &[s]);
    let length = Measure::Length { always: 1.25, of_contact: vec![1.0] };
    assert_eq!(reduced.model.outputs[1], length);
}

/// The rest of r_O after a solve and the skew part in S′ are counted.
#[test]
fn rounding_of_an_elimination_is_counted() {
    let affine = |factors: &[f64], noise: &[f64]| Affine {
        factors: factors.to_vec(),
        noise: noise.to_vec(),
    };
    let maps = Reduction {
        kept: vec![0, 1],
        open: vec![2],
        above: 1,
        touching: Vec::new(),
        x: Vec::new(),
        r: vec![
            affine(&[1.0, 2.0, 0.5], &[0.001, 0.0, 0.0]),
            affine(&[1.0, 0.75, 2.0], &[0.0, 0.002, 0.0]),
            affine(&[0.03, 0.0, -0.25], &[0.0, 0.0, 0.004]),
        ],
    };
    let hidden = maps.hidden(1);
    let known = [0.031, 0.002 + 0.125, 0.254 + 0.125];
    let off = hidden.iter().zip(known).map(|(hidden, known)| hidden - known);
    assert!(off.clone().all(|off| (0.0..1e-14).contains(&off)), "{hidden:?}");
}

#[test]
fn a_part_that_contact_alone_holds_proves_nothing() {
    let matrix = [1.0, -1.0 + 1e-9, -1.0 + 1e-9, 1.0];
    let mut model = model(&matrix, &[&[-1.0, -1.0]], &[[1.0, 1.0]]);
    assert_eq!(sides(&model).of, [EdgeSide::Touching; 2]);
    model.held_by_contact = vec![vec![0, 1]];
    assert_eq!(sides(&model).of, [EdgeSide::MayChange; 2]);
    assert!(sides(&model).enclosure.is_none());
}

#[test]
fn everything_kept_is_no_reduction() {
    let model = model(&DIAGONAL, &[&[0.0; 3], &[1.0; 3]], &[[1.0, 1.0], [-1.0, 1.0]]);
    let all = sides(&model);
    assert!(all.kept.iter().all(|&kept| kept));
    assert!(Reduced::new(&model, all).is_none());
}

/// Without inputs, or with all of them fixed, no edge is left: the answer is a constant.
#[test]
fn fixed_inputs_leave_no_edge() {
    let matrix = [1.0, -0.5, -0.5, 1.0];
    for load in [[1.0, 1.0], [-1.0, -1.0], [1.0, -3.0]] {
        let model = model(&matrix, &[&load], &[[1.0, 1.0]]);
        let reduced = Reduced::new(&model, sides(&model)).expect("edges to take out");
        assert_eq!(reduced.model.contact, 0);
        let none = reduced.model.solve(&[1.0]).expect("nothing to solve");
        let x = model.solve(&[1.0]).expect("a solution");
        KNOWN.check_each("x", &reduced.expand(&[1.0], &none), &x);
        let [found, known] = [reduced.model.outputs(&[1.0], &none), model.outputs(&[1.0], &x)];
        for (found, known) in found.into_iter().zip(known) {
            KNOWN.check("output", found.expect("a value") - known.expect("a value"));
        }
    }
}

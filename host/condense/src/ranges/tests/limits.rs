//! Enclosures, outputs and reduced models where fluxes have limits.

use super::super::enclosure::Enclosure;
use super::super::largest::LargestBound;
use super::super::outputs::intervals;
use super::super::reduced::Reduced;
use super::super::sides::{EdgeSide, Sides};
use super::{ALL, check_enclosed, inputs, matrix, scatter};
use crate::{CondensedModel, Measure, condense};
use signorini_problem::fixtures::on_grid;
use signorini_scene::error::Result;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_tolerances::solve::{REDUCED_LIMITED, REDUCED_LIMITED_BOUND};

/// Springs whose loads an input moves, with ends of all kinds; where they `vary` the last input moves spans as well.
fn model(case: u64, vary: bool) -> CondensedModel {
    let (n, mut random) = (4 + case as usize % 20, scatter(500 + case));
    let mut signed = |length: usize| (0..length).map(|_| 2.0 * random() - 1.0).collect::<Vec<_>>();
    let mut load: Vec<Vec<f64>> = (0..3).map(|_| signed(n)).collect();
    load[0].iter_mut().for_each(|b| *b *= 2.0);
    let kinds = signed(n);
    let span = |(kind, size): (f64, f64)| match (5.0 * (kind + 1.0)) as u32 {
        0 => f64::INFINITY,
        1 => f64::NEG_INFINITY,
        2 if !vary => -1.5 * size.abs(),
        3 => 0.0,
        _ => 2.0 * size.abs(),
    };
    let constant: Vec<f64> = kinds.iter().copied().zip(signed(n)).map(span).collect();
    let of_input =
        constant.iter().zip(signed(n)).map(|(span, by)| match vary && span.is_finite() {
            true => 0.5 * by.abs(),
            false => 0.0,
        });
    let spans = vec![constant.clone(), vec![0.0; n], of_input.collect()];
    let flux =
        Measure::Flux { of_inputs: signed(3), of_contact: signed(n), of_reaction: signed(n) };
    let lengths: Vec<f64> = signed(n).iter().map(|length| length.abs()).collect();
    let outputs = vec![
        flux,
        Measure::Linear { of_inputs: signed(3), of_contact: signed(n) },
        Measure::Length { always: 0.5, of_contact: lengths.clone() },
        Measure::Saturated { always: 0.25, of_contact: lengths },
    ];
    let ranges = [[1.0, 1.0], [-0.15, 0.1], [0.0, 0.2]];
    CondensedModel { spans, ..super::model(matrix(n, case, 0.0), load, &ranges, outputs) }
}

#[test]
fn solutions_outputs_and_sides_are_enclosed() {
    let mut counts = [0; 4];
    for case in 0..60 {
        let model = model(case, case % 2 == 1);
        assert_eq!(model.is_varying(), case % 2 == 1);
        let sides = Sides::new(&model).expect("finite loads");
        let proved = intervals(&model, &sides).expect("finite loads").expect("proved");
        ALL.iter().zip(&mut counts).for_each(|(side, sum)| *sum += sides.count(*side));
        for p in inputs(&model.ranges, 200, 40 + case) {
            check_enclosed(&model, &p, (&sides, &proved), 1e-13);
        }
    }
    assert!(counts.iter().all(|&count| count > 50), "{counts:?}");
}

/// Of one load the interval is a point, and tight at the corners of a box.
#[test]
fn enclosures_are_reached() {
    for case in 0..20 {
        let mut model = model(case, case % 2 == 1);
        model.ranges = vec![[1.0, 1.0], [0.05, 0.05], [0.1, 0.1]];
        let x = model.solve(&[1.0, 0.05, 0.1]).expect("a solution");
        let sides = Sides::new(&model).expect("finite loads");
        let Enclosure { lo, hi, .. } = sides.enclosure.expect("an M-matrix");
        for (at, x) in x.iter().enumerate() {
            let widths = [x - lo[at], hi[at] - x];
            assert!(
                widths.iter().all(|width| (-1e-13..1e-5).contains(width)),
                "{case}: {widths:?}"
            );
        }
    }
}

/// Sx = B(p) with every output: what is left and what is expanded from it are the whole.
fn compare(whole: &CondensedModel, count: usize, seed: u64) -> [usize; 2] {
    let sides = Sides::new(whole).expect("finite loads");
    let Some(reduced) = Reduced::new(whole, sides) else { return [whole.contact; 2] };
    for p in inputs(&whole.ranges, count, seed) {
        let (x, own) = (whole.solve(&p).expect("one"), reduced.model.solve(&p).expect("one"));
        for (x, found) in x.iter().zip(reduced.expand(&p, &own)) {
            REDUCED_LIMITED.check("opening", x - found);
        }
        for (at, &own) in own.iter().enumerate() {
            let [least, most] = reduced.model.limits[at];
            assert!(least <= own && own <= most, "{own} in {least} to {most}");
        }
        let found = reduced.model.outputs(&p, &own);
        for ((found, expected), measure) in
            found.iter().zip(whole.outputs(&p, &x)).zip(&whole.outputs)
        {
            let (Some(found), Some(expected)) = (*found, expected) else { continue };
            if *measure != Measure::Bound {
                REDUCED_LIMITED.check(format_args!("{measure:?}"), found - expected);
            }
        }
        let bounds = [(whole, &x), (&reduced.model, &own)].map(|(model, x)| model.bound(&p, x));
        if let [Some(expected), Some(found)] = bounds {
            REDUCED_LIMITED_BOUND.check_at_most("bound of the whole", expected, found);
            assert!(found < 1.05 * expected, "{found} {expected}");
        }
    }
    [whole.contact, reduced.model.contact]
}

#[test]
fn a_reduced_model_is_the_whole_one() {
    let mut sums = [0; 2];
    for case in 0..40 {
        let counts = compare(&model(case, case % 2 == 1), 1000, 70 + case);
        counts.into_iter().zip(&mut sums).for_each(|(count, sum)| *sum += count);
    }
    assert!(sums[1] < sums[0] / 2, "{sums:?}");
}

/// A scene on triangles without obtuse angles, with bound, corners, and inputs of loads.
fn scene(ends: &str, ranges: [&str; 2]) -> Result<CondensedModel> {
    let [level, rain] = ranges;
    let text = format!(
        "mesh = \"grid\"\n[material.default]\nconductivity = \"1\"\n[source]\nf = \"1 - 3*x\"\n[boundary.dirichlet]\n\
         kind = \"dirichlet\"\nvalue = \"0.3*x + 0.2*y\"\n[boundary.contact]\nkind = \"contact\"\ngap = \"0.6*x + 0.2\"\n{ends}\n\
         [input.level]\nof = \"dirichlet\"\nfield = \"value\"\npattern = \"1 + y\"\nrange = {level}\n\
         [input.rain]\nof = \"source\"\nfield = \"f\"\npattern = \"x\"\nrange = {rain}\n\
         [output.power]\nkind = \"flux\"\nof = \"contact\"\n[output.force]\nkind = \"force\"\n[output.short]\nkind = \"saturated\"\n\
         [output.length]\nkind = \"length\"\n[output.at]\nkind = \"probe\"\nat = [0.2, 0.3]\n[output.bound]\nkind = \"bound\"\n"
    );
    condense(&on_grid(&text, grid(8, Cells::Triangles))?.1)
}

const ENDS: [&str; 4] = [
    "flux = \"-0.1\"\nlimit = \"0.3\"",
    "flux = \"-0.2\"\nlimit = \"0.1\"",
    "flux = \"-2\"\nlimit = \"0.1\"",
    "flux = \"-0.1\"\nlimit = \"0.3 + 0.1*x\"",
];

#[test]
fn a_reduced_scene_has_the_bound_of_the_whole() -> Result<()> {
    let (mut sums, mut sides) = ([0; 2], [0; 4]);
    for ends in ENDS {
        for ranges in [["[-0.02, 0.02]", "[0, 0.1]"], ["[-0.2, 0.1]", "[0, 1]"]] {
            let whole = scene(ends, ranges)?;
            assert!(whole.certificate.is_ok() && whole.is_limited());
            let found = Sides::new(&whole).expect("finite loads");
            let of_sides = ALL.map(|side| found.count(side));
            of_sides.into_iter().zip(&mut sides).for_each(|(count, sum)| *sum += count);
            let counts = compare(&whole, 300, 5);
            counts.into_iter().zip(&mut sums).for_each(|(count, sum)| *sum += count);
        }
    }
    assert!(sums[1] < sums[0] && sides.iter().all(|&count| count > 3), "{sums:?} {sides:?}");
    Ok(())
}

#[test]
fn no_solution_has_a_larger_bound_than_the_largest() -> Result<()> {
    for ends in [ENDS[0], ENDS[3]] {
        let whole = scene(ends, ["[-0.02, 0.02]", "[0, 0.1]"])?;
        let largest = LargestBound::new(&whole).expect("finite loads").expect("proved");
        let mut reached = 0.0_f64;
        for p in inputs(&whole.ranges, 300, 8) {
            let x = whole.solve(&p).expect("a solution");
            reached = reached.max(whole.bound(&p, &x).expect("a bound"));
        }
        assert!(reached <= largest.proved && largest.is_sharp(), "{reached} {largest:?}");
    }
    Ok(())
}

/// Entries off the diagonal that push, and sides on either side of 0: nothing is proved.
#[test]
fn matrices_that_push_prove_nothing_with_limits() -> Result<()> {
    let mut model = model(3, false);
    (model.matrix[1], model.matrix[model.contact]) = (0.01, 0.01);
    let sides = Sides::new(&model).expect("finite loads");
    assert!(sides.enclosure.is_none() && sides.count(EdgeSide::MayChange) == model.contact);
    for (limits, span) in sides.limits.iter().zip(&model.spans[0]) {
        assert_eq!(limits[0] == 0.0, *span == f64::INFINITY, "{limits:?}");
        assert_eq!(limits[1] == 0.0, *span == f64::NEG_INFINITY, "{limits:?}");
    }
    assert!(Reduced::new(&model, sides).is_none());
    Ok(())
}

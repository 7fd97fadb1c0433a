//! Every declared output is that of the full model.
//!
//! A deviation is measured against the largest value that the output takes over the ticks, but at least
//! against the part [`TERMS`] of the largest sum of the sizes of its terms Y_p p + Y_x x: what is a small
//! difference of large terms is known no better than they are, and many a force is 0. A force is linear for the
//! solution, whose reactions r = Sx − Bp are 0 where it opens, and its terms are those of that form. Edges must touch
//! as they do in the full model, all of them: a random scene is never within rounding of switching.
//!
//! f32 holds S to 6e−8, which its smallest eigenvalue λ magnifies whatever solves the problem: 1e−4 of the
//! terms is asked for as far as λ ≥ 1e−3, in proportion beyond.

use signorini_bake::Bakes;
use signorini_bake::condensed::{Baked, Controller};
use signorini_bound::certificate::Verdict;
use signorini_condense::{CondensedModel, Measure};
use signorini_kernel::report::Ended;
use signorini_tests::cholesky::Envelope;
use signorini_tests::random::Random;
use signorini_tolerances::twins::{CONDENSED, CONDENSED_NARROW, SUM_OF_LENGTHS};
use signorini_tolerances::{Tolerance, cases};

use super::scenes::{EXACT, Model};
use crate::standard::{moved, standard};

/// Ticks of each controller.
const TICKS: usize = 6;
/// Scenes to draw.
const SEEDS: u64 = 60;
/// The part of its terms below which a value is no scale for its own error.
const TERMS: f64 = 0.01;

/// The largest deviations of one output and what they are to be compared with.
#[derive(Debug, Clone, Copy, Default)]
struct Output {
    off: f64,
    value: f64,
    terms: f64,
}

/// Values of the inputs that f32 holds exactly, on the other side of the default where they would leave their range.
fn inputs(model: &Model, amount: f64, random: &mut Random) -> Vec<f64> {
    let near = |input| moved(input, amount * (f64::from(random.below(256)) / 64.0 - 2.0));
    model.problem.scene.inputs.iter().map(near).collect()
}

/// Y_p and Y_x of an output, its reactions being linear in p and x.
fn linear(of: &CondensedModel, measure: &Measure) -> (Vec<f64>, Vec<f64>) {
    let (of_inputs, of_contact, of_reaction) = match measure {
        Measure::Linear { of_inputs, of_contact } => (of_inputs, of_contact, &Vec::new()),
        Measure::Flux { of_inputs, of_contact, of_reaction } => {
            (of_inputs, of_contact, of_reaction)
        }
        Measure::Length { .. } | Measure::Saturated { .. } | Measure::Bound => {
            unreachable!("neither is linear")
        }
    };
    let (mut of_inputs, mut of_contact) = (of_inputs.clone(), of_contact.clone());
    of_inputs.resize(of.inputs, 0.0);
    of_contact.resize(of.contact, 0.0);
    for (i, weight) in of_reaction.iter().enumerate() {
        of_inputs.iter_mut().zip(&of.load).for_each(|(y, load)| *y -= weight * load[i]);
        let row = &of.matrix[i * of.contact..(i + 1) * of.contact];
        of_contact.iter_mut().zip(row).for_each(|(y, entry)| *y += weight * entry);
    }
    (of_inputs, of_contact)
}

/// The outputs that are linear in the solution, over some ticks from one answer to the next.
fn linear_outputs<R: Bakes>(model: &Model, amount: f64, random: &mut Random) -> Vec<Output> {
    let baked: Baked<R> = model.baked(EXACT);
    let mut controller = Controller::new(&baked);
    let measures = &model.condensate.outputs;
    let mut all = vec![Output::default(); measures.len()];
    for _ in 0..TICKS {
        let p = inputs(model, amount, random);
        let narrow: Vec<R> = p.iter().map(|&p| R::narrow(p)).collect();
        let (found, report) = controller.tick(&narrow).expect("a tick");
        let Some((problem, solution, expected)) = model.full(&p) else {
            let reason = &model.condensate.certificate.as_ref().err();
            let is_refused = matches!(report.verdict, Verdict::BelowGap | Verdict::Unavailable);
            assert!(is_refused, "{}: {reason:?} {:?}", model.what, report.verdict);
            continue;
        };
        assert_eq!(report.ended, Ended::Exact, "{}", model.what);
        let p: Vec<f64> = std::iter::once(1.0).chain(p).collect();
        let x: Vec<f64> = controller.x().iter().map(|x| x.wide()).collect();
        let open = solution.u[problem.topology.counts.free..].iter().zip(&problem.loads.gap);
        let by_edge = model.condensate.by_edge(&x).into_iter();
        let as_in_full = by_edge.zip(open).all(|(x, (u, gap))| (x == 0.0) == (u == gap));
        assert!(as_in_full, "{}: other edges touch", model.what);
        for (((output, measure), found), expected) in
            all.iter_mut().zip(measures).zip(found).zip(expected)
        {
            let (found, lengths) = (found.wide(), || problem.lengths.iter().sum::<f64>());
            match measure {
                Measure::Bound => assert_eq!(found.is_finite(), report.certificate().is_some()),
                Measure::Length { .. } | Measure::Saturated { .. } => {
                    let off = found - expected.expect("a value");
                    let epsilon = R::EPSILON.wide() / f64::EPSILON * lengths();
                    SUM_OF_LENGTHS.check_over(&model.what, off, epsilon);
                }
                Measure::Linear { .. } | Measure::Flux { .. } => {
                    let (of_inputs, of_contact) = linear(&model.condensate, measure);
                    let expected = expected.expect("a value");
                    let products = of_inputs.iter().zip(&p).chain(of_contact.iter().zip(&x));
                    let terms = products.map(|(a, b)| (a * b).abs()).sum();
                    output.off = output.off.max((found - expected).abs());
                    output.value = output.value.max(expected.abs());
                    output.terms = output.terms.max(terms);
                }
            }
        }
    }
    all.into_iter().filter(|output| output.off > 0.0).collect()
}

/// Compares with the terms; returns the largest deviation over the values.
fn check<R: Bakes>(model: &Model, allowed: Tolerance, amount: f64, seed: u64) -> f64 {
    let outputs = linear_outputs::<R>(model, amount, &mut Random::new(seed));
    let most = |of: fn(&Output) -> f64| outputs.iter().map(of).fold(0.0, f64::max);
    let of_terms = most(|output| output.off / output.terms);
    let condition = (1e-3 * condition(&model.condensate)).max(1.0);
    allowed.check(&model.what, of_terms / condition);
    most(|output| output.off / output.value.max(TERMS * output.terms))
}

/// 1/λ_min of S, by the inverse power method; 1 where S is singular, so that nothing is forgiven.
fn condition(condensate: &CondensedModel) -> f64 {
    let n = condensate.contact;
    let entries = condensate.matrix.iter().enumerate().map(|(at, &s)| (at / n, at % n, s));
    let entries: Vec<_> = entries.collect();
    let Some(factor) = Envelope::new(n, &entries).factor() else { return 1.0 };
    let (mut x, mut size) = (vec![1.0; n], 1.0);
    for _ in 0..50 {
        x = factor.solve(x);
        size = x.iter().map(|x| x * x).sum::<f64>().sqrt();
        x.iter_mut().for_each(|x| *x /= size);
    }
    size
}

#[test]
fn random_scenes_have_the_outputs_of_the_full_model() {
    let (mut counted, all) = (0, cases(SEEDS));
    for seed in 0..all {
        let Some(model) = Model::random(seed, 5) else { continue };
        counted += 1;
        let wide = check::<f64>(&model, CONDENSED, 1.0, seed);
        check::<f32>(&model, CONDENSED_NARROW, 1.0, seed);
        CONDENSED.check(&model.what, wide);
    }
    assert!(counted > all / 2);
}

/// With inputs about as large as in use.
#[test]
fn the_standard_scenes_have_the_outputs_of_the_full_model() {
    for (name, amount) in
        [("levee", 0.2), ("slab", 2.0), ("strip", 0.1), ("membrane", 0.0), ("pit", 0.0)]
    {
        let model = Model::new(name.to_owned(), standard(name)).expect("a model");
        check::<f64>(&model, CONDENSED, amount, 1);
        check::<f32>(&model, CONDENSED_NARROW, amount, 1);
    }
}

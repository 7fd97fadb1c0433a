//! Enclosures against solutions for loads drawn from the box.

mod follow;
mod lasting;
mod leaving;
mod limits;
mod rounding;
mod sides;
mod twice;

use faer::MatRef;

use super::enclosure::{Enclosure, EndBox, LoadBox};
use super::interval::Interval;
use super::sides::{EdgeSide, Sides};
use super::split::Split;
use crate::{CondensedModel, Measure};
use signorini_reference::minimise_between;

mod outputs;

/// All sides, in the order in which tests count them.
const ALL: [EdgeSide; 4] =
    [EdgeSide::Open, EdgeSide::Touching, EdgeSide::Saturated, EdgeSide::MayChange];

/// Whether x is where its edge always is.
fn is_there(side: EdgeSide, x: f64) -> bool {
    match side {
        EdgeSide::Open => x > 0.0,
        EdgeSide::Touching => x == 0.0,
        EdgeSide::Saturated => x < 0.0,
        EdgeSide::MayChange => true,
    }
}

/// Numbers in [0, 1), as Knuth's generator draws them.
fn scatter(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// A solution lies where it is proved to, but for `room`, and so do its outputs, which are returned.
fn check_enclosed(
    model: &CondensedModel,
    p: &[f64],
    (sides, proved): (&Sides, &[Option<Interval>]),
    room: f64,
) -> Vec<f64> {
    let x = model.solve(p).expect("a solution");
    let Enclosure { lo, hi, .. } = sides.enclosure.as_ref().expect("an enclosure");
    for (at, &x) in x.iter().enumerate() {
        let (lo, hi, side, [least, most]) = (lo[at], hi[at], sides.of[at], sides.limits[at]);
        assert!(lo - room <= x && x <= hi + room, "{at}: {x} in {lo} to {hi}, {p:?}");
        assert!(is_there(side, x), "{at}: {side:?} {x}");
        assert!(least <= x && x <= most, "{at}: {x} in {least} to {most}");
    }
    let value = |(value, proved): (Option<f64>, &Option<Interval>)| {
        let (value, Interval { lo, hi }) = (value.expect("a value"), proved.expect("one"));
        assert!(lo <= value && value <= hi, "{value} in {lo} to {hi}, {p:?}");
        value
    };
    model.outputs(p, &x).into_iter().zip(proved).map(value).collect()
}

/// A chain of springs: diagonal 1, neighbours −0.4 or so; with `positive`, entries further away that push.
fn matrix(n: usize, seed: u64, positive: f64) -> Vec<f64> {
    let mut random = scatter(seed);
    let mut entries = vec![0.0; n * n];
    for i in 0..n {
        entries[i * n + i] = 1.0;
        for j in i + 1..n {
            let far = (j - i) as f64;
            let pull = -0.45 * random() / (far * far);
            let entry = if j - i > 2 { pull + positive * random() / (far * far) } else { pull };
            entries[i * n + j] = entry;
            entries[j * n + i] = entry;
        }
    }
    entries
}

/// A model of this matrix and these columns of loads, all scales 1 and without a bound.
fn model(
    matrix: Vec<f64>,
    load: Vec<Vec<f64>>,
    ranges: &[[f64; 2]],
    outputs: Vec<Measure>,
) -> CondensedModel {
    let n = load[0].len();
    CondensedModel {
        contact: n,
        edges: (0..n).collect(),
        inputs: load.len(),
        matrix,
        opening: vec![1.0; n],
        multiplier: vec![1.0; n],
        load,
        spans: Vec::new(),
        limits: Vec::new(),
        defaults: ranges.iter().map(|[lo, hi]| 0.5 * (lo + hi)).collect(),
        ranges: ranges.to_vec(),
        outputs,
        certificate: Err("none".to_owned()),
        energy_unit: 1.0,
        held_by_contact: Vec::new(),
        rooms: Vec::new(),
        balances: Vec::new(),
    }
}

/// All corners of the box, and so many points of it; the constant comes first.
fn inputs(ranges: &[[f64; 2]], count: usize, seed: u64) -> Vec<Vec<f64>> {
    let mut random = scatter(seed);
    let corner = |bits: usize| {
        let end = |(at, range): (usize, &[f64; 2])| range[((2 * bits) >> at) & 1];
        ranges.iter().enumerate().map(end).collect()
    };
    let corners = (0..1_usize << (ranges.len() - 1)).map(corner);
    corners.chain((0..count).map(|_| drawn(ranges, &mut random))).collect()
}

fn drawn(ranges: &[[f64; 2]], random: &mut impl FnMut() -> f64) -> Vec<f64> {
    let at = |[lo, hi]: &[f64; 2], t: f64| lo + t * (hi - lo);
    ranges.iter().map(|range| at(range, random())).collect()
}

fn enclosed(split: &Split, loads: LoadBox) -> Enclosure {
    let infinite = vec![f64::INFINITY; loads.lo.len()];
    let greatest = LoadBox { lo: infinite.clone(), hi: infinite };
    let found = Enclosure::new(split, &EndBox { least: loads, greatest }).expect("finite loads");
    found.expect("no limits")
}

#[test]
fn every_solution_lies_in_its_enclosure() {
    let mut proved = [0, 0];
    for case in 0..60 {
        let n = 3 + case as usize % 17;
        let positive = if case % 3 == 0 { 0.2 } else { 0.0 };
        let entries = matrix(n, case, positive);
        let Some(split) = Split::new(&entries, n) else { continue };
        proved[usize::from(split.has_all_signs())] += 1;
        let mut random = scatter(1000 + case);
        let columns: Vec<Vec<f64>> =
            (0..3).map(|_| (0..n).map(|_| 2.0 * random() - 1.0).collect()).collect();
        let ranges = [[1.0, 1.0], [-0.5, 0.25], [0.0, 0.3]];
        let enclosure = enclosed(&split, LoadBox::new(&columns, &ranges, n));
        for _ in 0..200 {
            let p = drawn(&ranges, &mut random);
            let load: Vec<f64> =
                (0..n).map(|i| columns.iter().zip(&p).map(|(b, p)| b[i] * p).sum()).collect();
            let matrix = MatRef::from_row_major_slice(&entries, n, n);
            let x = minimise_between(matrix, &[], &load, &[]).expect("a positive definite matrix");
            for i in 0..n {
                let row = &entries[i * n..][..n];
                let reaction: f64 = row.iter().zip(&x).map(|(s, x)| s * x).sum::<f64>() - load[i];
                assert!(enclosure.lo[i] <= x[i] + 1e-13 && x[i] <= enclosure.hi[i] + 1e-13);
                assert!(enclosure.reaction[i] <= 0.0 || reaction >= enclosure.reaction[i] - 1e-13);
                assert!(enclosure.reaction[i] <= 0.0 || x[i] == 0.0);
            }
        }
    }
    assert!(proved.iter().all(|&count| count >= 10), "{proved:?}");
}

#[test]
fn a_single_load_is_enclosed_to_rounding() {
    let n = 12;
    let entries = matrix(n, 5, 0.0);
    let split = Split::new(&entries, n).expect("an M-matrix");
    assert!(split.has_all_signs());
    let mut random = scatter(9);
    let column: Vec<f64> = (0..n).map(|_| 2.0 * random() - 1.0).collect();
    let loads = LoadBox::new(&[column], &[[1.0, 1.0]], n);
    let Enclosure { lo, hi, .. } = enclosed(&split, loads);
    assert!(lo.iter().zip(&hi).all(|(lo, hi)| lo <= hi && hi - lo < 1e-12));
}

#[test]
fn what_is_no_m_matrix_proves_nothing() {
    let singular = [1.0, -1.0, -1.0, 1.0];
    assert!(Split::new(&singular, 2).is_none(), "contact alone holds it");
    let indefinite = [1.0, -2.0, -2.0, 1.0];
    assert!(Split::new(&indefinite, 2).is_none());
    let nearly = -1.0 + 0.5 * f64::EPSILON;
    assert!(Split::new(&[1.0, nearly, nearly, 1.0], 2).is_none(), "definite, if rounding is right");
    let not_a_number = [1.0, f64::NAN, f64::NAN, 1.0];
    assert!(Split::new(&not_a_number, 2).is_none());
}

/// N w is 2 where w is 1: the middle of the chain overflows first.
#[test]
fn loads_that_overflow_prove_nothing() {
    let matrix = [4.0, -2.0, -2.0, 4.0];
    let split = Split::new(&matrix, 2).expect("an M-matrix");
    const ENDLESS: [f64; 2] = [f64::INFINITY; 2];
    for size in [1e308, f64::MAX] {
        let above = split.above(&[size, size], &ENDLESS).expect("finite loads");
        assert!(above.iter().all(|&x| x >= 0.5 * size), "{above:?}");
        let below = split.below(&[size, size], &ENDLESS).expect("finite loads");
        assert!(below.iter().all(|&x| (0.0..=0.5 * size).contains(&x)), "{below:?}");
        let loads = LoadBox { lo: vec![-size; 2], hi: vec![size; 2] };
        let Enclosure { lo, hi, reaction } = enclosed(&split, loads);
        assert_eq!((lo, reaction), (vec![0.0; 2], vec![0.0; 2]));
        assert!(hi.iter().all(|&x| x >= 0.5 * size), "{hi:?}");
    }
}

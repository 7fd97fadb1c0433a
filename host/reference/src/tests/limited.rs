//! The kernel's pivoting with three sides against the reference, on dense problems.

use faer::Mat;
use signorini_contact::dense::Iterate;
use signorini_contact::dense::blocks::{Block, Blocks, SIDE, count, padded};
use signorini_contact::dense::pivoting::{Found, find};
use signorini_contact::dense::ranges::Given;
use signorini_contact::dense::rule::Largest;
use signorini_contact::dense::tableau::{InitialTableau, Tableau};
use signorini_kernel::flux_range::Spans;
use signorini_tolerances::solve::THREE_SIDES;

use super::super::minimise_between;
use super::Random;

/// A positive definite matrix with a diagonal of 1: an M-matrix, or one with entries of both signs.
fn matrix(order: usize, is_m: bool, draw: &mut Random) -> Mat<f64> {
    let mut given = Mat::zeros(order, order);
    for row in 0..order {
        for column in 0..row {
            let entry = draw.part() - if is_m { 1.0 } else { 0.5 };
            given[(row, column)] = entry;
            given[(column, row)] = entry;
        }
    }
    for row in 0..order {
        let sum: f64 = (0..order).map(|column| f64::abs(given[(row, column)])).sum();
        given[(row, row)] = sum + 1e-3 + draw.part();
    }
    let scale: Vec<f64> = (0..order).map(|row| 1.0 / given[(row, row)].sqrt()).collect();
    Mat::from_fn(order, order, |row, column| given[(row, column)] * scale[row] * scale[column])
}

fn in_blocks(matrix: &Mat<f64>) -> Vec<Block<f64>> {
    let order = matrix.nrows();
    let mut blocks = Vec::with_capacity(count(order));
    for row in 0..order.div_ceil(SIDE) {
        for column in 0..=row {
            let entry = |r: usize, c: usize| match (row * SIDE + r, column * SIDE + c) {
                (r, c) if r < order && c < order => matrix[(r, c)],
                (r, c) => f64::from(u8::from(r == c)),
            };
            blocks.push(std::array::from_fn(|r| std::array::from_fn(|c| entry(r, c))));
        }
    }
    blocks
}

/// Loads that follow each other, as from tick to tick: each search begins where the last one has ended.
#[test]
fn pivoting_with_three_sides_agrees_with_the_reference() {
    let mut draw = Random(1);
    let (mut solved, mut with_all, mut most) = (0, 0, 0.0_f64);
    while solved < 10_000 {
        let order = 1 + (draw.part() * 24.0) as usize;
        let is_m = draw.part() < 0.5;
        let matrix = matrix(order, is_m, &mut draw);
        let spans: Vec<f64> = (0..order)
            .map(|_| match (draw.part() * 10.0) as u32 {
                0 => 0.0,
                1 => 1e-12,
                2 => f64::INFINITY,
                3 => f64::NEG_INFINITY,
                4 => 1e12,
                5 => -draw.part(),
                _ => draw.part(),
            })
            .collect();
        let (length, blocks) = (padded(order), in_blocks(&matrix));
        let [mut x, mut residual, mut scratch, mut a, mut b] = [(); 5].map(|()| vec![0.0; length]);
        let (mut open, mut exchanged) = (vec![false; length], vec![false; length]);
        let mut tableau_blocks = blocks.clone();
        let blocks = Blocks::new(&blocks, order).expect("as many blocks");
        let start = InitialTableau::untouched(&blocks);
        let mut tableau =
            Tableau::new(order, &mut tableau_blocks, &mut exchanged, [&mut a, &mut b])
                .expect("memory");
        let mut load = vec![0.0; length];
        for _ in 0..5 {
            load[..order].iter_mut().for_each(|b| *b += 2.0 * draw.part() - 1.0);
            let expected = minimise_between(matrix.as_ref(), &[], &load[..order], &spans)
                .expect("a positive definite matrix");
            let iterate = Iterate {
                x: &mut x,
                residual: &mut residual,
                scratch: &mut scratch,
                open: &mut open,
            };
            let spans = Spans::new(&spans).expect("spans");
            let given = Given::between(&load, spans, &[]);
            let (found, pivots) =
                find(&blocks, given, &mut tableau, &start, &mut Largest, |_| true, iterate)
                    .expect("arrays that fit");
            assert_eq!(found, Found::Exact, "{solved}: {order}");
            most = most.max(f64::from(pivots) / order as f64);
            let size = expected.iter().fold(1.0, |most: f64, x| most.max(x.abs()));
            for (x, expected) in x.iter().zip(&expected) {
                THREE_SIDES.check(format_args!("{solved}: {x} {expected}"), (x - expected) / size);
            }
            let sides = [x.iter().any(|&x| x > 0.0), x.iter().any(|&x| x < 0.0)];
            with_all += u32::from(sides == [true; 2]);
            solved += 1;
        }
    }
    assert!(with_all > solved / 2, "{with_all}");
}

/// Two unknowns that hold each other, one with λ ≥ 0 and one with λ ≤ 0: both leave at first, and one has to stay.
#[test]
fn signs_of_both_kinds_hold_a_floating_component() {
    let matrix = Mat::from_fn(2, 2, |i, j| if i == j { 1.0 } else { -1.0 });
    let spans = [f64::INFINITY, f64::NEG_INFINITY];
    for (load, expected) in [([1.0, -2.0], [0.0, -2.0]), ([2.0, -1.0], [2.0, 0.0])] {
        let found = minimise_between(matrix.as_ref(), &[vec![0, 1]], &load, &spans);
        assert_eq!(found, Ok(expected.to_vec()), "{load:?}");
    }
}

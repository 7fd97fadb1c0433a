//! Allowances for rounding, against twice as many digits: always enough, and never much more.

use super::super::enclosure::LoadBox;
use super::super::reduction::least;
use super::super::split::{Split, product};
use super::twice::Twice;
use super::{matrix, scatter};

/// Numbers of many sizes whose sum is small.
fn cancelling(n: usize, random: &mut impl FnMut() -> f64) -> [Vec<f64>; 2] {
    let mut draw = || (2.0 * random() - 1.0) * 10f64.powf(6.0 * random() - 3.0);
    let (mut a, mut b): (Vec<f64>, Vec<f64>) = (0..n).map(|_| (draw(), draw())).unzip();
    let sum: f64 = a.iter().zip(&b).map(|(a, b)| a * b).sum();
    a.push(-sum);
    b.push(1.0);
    [a, b]
}

#[test]
fn a_sum_is_off_by_no_more_than_its_noise() {
    let mut random = scatter(1);
    let mut most = 0.0_f64;
    for case in 0..2000 {
        let [a, b] = cancelling(1 + case % 40, &mut random);
        let (sum, noise) = product(&a, &b);
        let size: f64 = a.iter().zip(&b).map(|(a, b)| (a * b).abs()).sum();
        let off = Twice::dot(&a, &b).less(sum).abs();
        assert!(off <= noise && noise <= 100.0 * f64::EPSILON * size, "{off:e} {noise:e}");
        most = most.max(off / size);
    }
    assert!(most > 0.5 * f64::EPSILON, "sums that are off: {most:e}");
}

/// Each end in turn may be the worst, for either sign of the factor.
#[test]
fn the_least_value_is_that_of_a_corner() {
    let mut random = scatter(2);
    for case in 0..500 {
        let n = 1 + case % 6;
        let [mut factors, mut ends] = cancelling(n, &mut random);
        factors.truncate(n);
        ends.truncate(n);
        let intervals: Vec<[f64; 2]> = ends.iter().map(|lo| [*lo, lo + random()]).collect();
        let noise: Vec<f64> = (0..n).map(|_| 1e-3 * random()).collect();
        let [none, some] = [&vec![0.0; n], &noise].map(|noise| least(&factors, noise, &intervals));
        let corner =
            |bits: usize| -> Vec<f64> { (0..n).map(|at| intervals[at][bits >> at & 1]).collect() };
        let corners = (0..1 << n).map(corner);
        let values = corners.map(|corner| Twice::dot(&factors, &corner).less(none));
        let above = values.fold(f64::INFINITY, f64::min);
        let size: f64 = factors.iter().zip(&intervals).map(|(a, i)| a.abs() * largest(i)).sum();
        assert!((0.0..=1e-14 * size).contains(&above), "{above:e} of {size:e}");
        let off: f64 = noise.iter().zip(&intervals).map(|(noise, i)| noise * largest(i)).sum();
        assert!(some <= none - off && some >= none - 2.1 * off, "{some:e} {none:e} {off:e}");
    }
    let is_proved = |factor: f64, hi: f64| least(&[factor], &[], &[[0.0, hi]]) >= 0.0;
    assert!(is_proved(1.0, 1.0) && !is_proved(-1.0, f64::INFINITY));
    assert!(!is_proved(f64::NAN, 1.0), "a NaN proves nothing");
}

fn largest([lo, hi]: &[f64; 2]) -> f64 {
    lo.abs().max(hi.abs())
}

/// Nx ≥ b to the last bit of the one, and Nx ≤ b of the other wherever it opens.
#[test]
fn bounds_of_a_contact_problem_hold_in_every_row() {
    let (mut random, mut touched) = (scatter(3), 0);
    for case in 0..400 {
        let n = 2 + case as usize % 15;
        let entries = matrix(n, case, 0.0);
        let Some(split) = Split::new(&entries, n) else { continue };
        let load: Vec<f64> = (0..n).map(|_| 2.0 * random() - 1.0).collect();
        let endless = vec![f64::INFINITY; n];
        let found = [split.above(&load, &endless), split.below(&load, &endless)];
        let [above, below] = found.map(|x| x.expect("finite"));
        for (row, (i, b)) in entries.chunks(n).zip(load.iter().enumerate()) {
            assert!(Twice::dot(row, &above).less(*b) >= 0.0, "row {i} of {case}");
            assert!(
                below[i] == 0.0 || Twice::dot(row, &below).less(*b) <= 0.0,
                "row {i} of {case}"
            );
            assert!(below[i] <= above[i] && above[i] - below[i] < 1e-12);
            touched += usize::from(below[i] == 0.0);
        }
    }
    assert!(touched > 500, "{touched}");
}

/// Px of x ≥ 0, from both sides.
#[test]
fn a_push_is_enclosed() {
    let (n, mut random) = (9, scatter(4));
    let entries = matrix(n, 3, 0.2);
    let split = Split::new(&entries, n).expect("an M-matrix");
    assert!(!split.has_all_signs());
    for _ in 0..200 {
        let x: Vec<f64> = (0..n).map(|_| random()).collect();
        let [least, most] = split.push(&x);
        for i in 0..n {
            let positive: Vec<f64> =
                (0..n).map(|j| if i == j { 0.0 } else { entries[i * n + j].max(0.0) }).collect();
            let push = Twice::dot(&positive, &x);
            assert!(push.less(least[i]) >= 0.0 && push.less(most[i]) <= 0.0);
            assert!(most[i] - least[i] < 1e-13);
        }
    }
}

#[test]
fn a_load_box_holds_the_loads_of_its_corners() {
    let mut random = scatter(5);
    for case in 0..400 {
        let count = 1 + case % 4;
        let [mut entries, mut ends] = cancelling(count, &mut random);
        entries.truncate(count);
        ends.truncate(count);
        let columns: Vec<Vec<f64>> = entries.iter().map(|&entry| vec![entry]).collect();
        let ranges: Vec<[f64; 2]> = ends.iter().map(|lo| [*lo, lo + random()]).collect();
        let loads = LoadBox::new(&columns, &ranges, 1);
        let corners = 0..1_usize << count;
        let value = |bits: usize| {
            let p: Vec<f64> = (0..count).map(|at| ranges[at][bits >> at & 1]).collect();
            Twice::dot(&entries, &p)
        };
        let lowest = corners.clone().map(|bits| value(bits).less(loads.lo[0]));
        let highest = corners.map(|bits| -value(bits).less(loads.hi[0]));
        let size: f64 = entries.iter().zip(&ranges).map(|(b, i)| b.abs() * largest(i)).sum();
        let room = [lowest.fold(f64::INFINITY, f64::min), highest.fold(f64::INFINITY, f64::min)];
        assert!(
            room.iter().all(|room| (0.0..=1e-14 * size).contains(room)),
            "{room:?} of {size:e}"
        );
    }
}

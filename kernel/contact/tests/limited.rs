//! Contact whose flux has two ends: exchanges with three sides, by complementarity itself.

use crate::memory::{Dense, Draw, defect};
use crate::strip::Strip;
use signorini_contact::dense::blocks::padded;
use signorini_contact::dense::pivoting::{Found, find};
use signorini_contact::dense::ranges::Given;
use signorini_contact::dense::rule::Largest;
use signorini_contact::dense::tableau::InitialTableau;
use signorini_kernel::Error;
use signorini_kernel::flux_range::Spans;
use signorini_tolerances::kernel::THREE_SIDES;

const ENDLESS: f64 = f64::INFINITY;

/// Loads that follow each other, with spans that are scaled edge by edge.
#[test]
fn exchanges_find_all_three_sides() -> Result<(), Error> {
    let mut random = Draw(17);
    let mut seen = [0; 3];
    for order in [1, 5, 8, 13, 24] {
        let strip = Strip::<f64>::new(order);
        let (length, matrix) = (padded(order), strip.matrix()?);
        let spans: Vec<f64> =
            (0..order).map(|at| [0.6, 1e-9, ENDLESS, -ENDLESS, 0.0, -2.0, -0.3][at % 7]).collect();
        let mut scale = vec![0.0; length];
        scale
            .iter_mut()
            .take(order)
            .enumerate()
            .for_each(|(at, scale)| *scale = 0.5 + 0.1 * at as f64);
        let ends = |at: usize| match spans[at] * scale[at] {
            most if most < 0.0 => [most, 0.0],
            most => [0.0, most],
        };
        let start = InitialTableau::untouched(&matrix);
        let mut memory = Dense::of(&matrix, order)?;
        let mut load = vec![0.0; length];
        for _ in 0..40 {
            for b in load.iter_mut().take(order) {
                *b = 0.5 * *b + random.signed();
            }
            let given = Given::between(&load, Spans::new(&spans)?, &scale);
            let (mut tableau, iterate) = memory.parts()?;
            let (found, pivots) =
                find(&matrix, given, &mut tableau, &start, &mut Largest, |_| true, iterate)?;
            let Dense { x, residual, open, .. } = &memory;
            assert!(found == Found::Exact && pivots as usize <= 4 * order, "{order}: {pivots}");
            let size = load.iter().fold(1.0, |most: f64, b| most.max(b.abs()));
            let off = defect(order, |i, j| strip.at(i, j), [&load, x], ends);
            THREE_SIDES.check_over(format_args!("{order}"), off, size);
            for (at, &x) in x.iter().enumerate() {
                assert_eq!(open[at], x != 0.0);
                if at < order {
                    seen[usize::from(x > 0.0) + 2 * usize::from(x < 0.0)] += 1;
                    // Of a side that is exchanged nothing is left.
                    assert!(
                        x == 0.0 || residual[at].abs() < 1e-9,
                        "{order} {at}: {}",
                        residual[at]
                    );
                }
            }
        }
    }
    assert!(seen.iter().all(|&count| count > 300), "{seen:?}");
    Ok(())
}

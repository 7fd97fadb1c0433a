//! The law of contact whose flux has two ends: ranges of fluxes, and what they make of u.

use signorini_kernel::Error;
use signorini_kernel::error::Array;
use signorini_kernel::flux_range::{FluxRange, Span, Spans};
use signorini_kernel::law::{EdgeLaw, Move};

const ENDLESS: f64 = f64::INFINITY;

/// Base 1 with a span of 2, of ∞, of −∞, of 0.
const RANGES: [FluxRange<f64>; 4] = [
    FluxRange::new(1.0, Span::new(2.0)),
    FluxRange::new(1.0, Span::new(ENDLESS)),
    FluxRange::new(1.0, Span::new(-ENDLESS)),
    FluxRange::new(1.0, Span::new(0.0)),
];

#[test]
fn a_flux_is_between_its_ends() {
    let ends = [[1.0, 3.0], [1.0, ENDLESS], [-ENDLESS, 1.0], [1.0, 1.0]];
    assert_eq!(RANGES.map(FluxRange::ends), ends);
    assert_eq!(RANGES.map(FluxRange::base), [1.0; 4]);
    let fluxes = [-5.0, 0.5, 1.0, 1.5, 3.0, 3.5, f64::NAN];
    let admitted = [
        [false, false, true, true, true, false, false],
        [false, false, true, true, true, true, false],
        [true, true, true, false, false, false, false],
        [false, false, true, false, false, false, false],
    ];
    let nearest = [
        [1.0, 1.0, 1.0, 1.5, 3.0, 3.0],
        [1.0, 1.0, 1.0, 1.5, 3.0, 3.5],
        [-5.0, 0.5, 1.0, 1.0, 1.0, 1.0],
        [1.0; 6],
    ];
    for ((range, admitted), nearest) in RANGES.into_iter().zip(admitted).zip(nearest) {
        assert_eq!(fluxes.map(|flux| range.admits(flux)), admitted, "{range:?}");
        for (flux, nearest) in fluxes.into_iter().zip(nearest) {
            assert_eq!(range.nearest(flux), nearest, "{range:?} {flux}");
        }
        assert_eq!(
            range.span().length().is_finite(),
            range.ends()[0] != -ENDLESS && range.ends()[1] != ENDLESS
        );
    }
    assert_eq!(RANGES.map(|range| range.multiplier(0.25)), [-0.75, -0.75, 0.75, -0.75]);
    // A half of the range may lack half of what the range does; of none and of an endless one nothing is unseen.
    let unseen = |range: FluxRange<f64>| range.unseen(1.0, 0.5);
    assert_eq!(RANGES.map(unseen)[0], 0.25);
    assert_eq!(unseen(FluxRange::new(1.0, Span::UNLIMITED)), 0.0);
    assert_eq!(unseen(FluxRange::new(1.0, Span::new(0.0))), 0.0);
}

#[test]
fn spans_are_numbers_or_infinite() {
    let lengths = [0.0, 2.0, ENDLESS, -ENDLESS];
    let spans = Spans::new(&lengths).expect("spans");
    assert_eq!(spans.lengths(), lengths);
    assert_eq!(
        [0, 1, 2, 3, 4].map(|at| spans.on(at).length()),
        [0.0, 2.0, ENDLESS, -ENDLESS, ENDLESS]
    );
    assert_eq!((spans.check_length(4), spans.excess()), (Ok(()), 0.0));
    assert_eq!(spans.varying(0.5).excess(), 0.5);
    let wrong = Err(Error::Length { of: Array::ContactSpans, found: 4, expected: 3 });
    assert_eq!(spans.check_length(3), wrong);
    assert_eq!(Spans::<f64>::UNLIMITED.check_length(3), Ok(()));
    for at in 0..3 {
        let mut lengths = [1.0, -1.0, 0.0];
        assert!(Spans::new(&lengths).is_ok());
        lengths[at] = f64::NAN;
        let error = Spans::new(&lengths).err();
        assert_eq!(error, Some(Error::OutOfRange { of: Array::ContactSpans, at }));
    }
    let baked = Spans::baked(&lengths, 0.25);
    assert_eq!((baked.lengths(), baked.excess()), (&lengths[..], 0.25));
}

/// ψ = 2 with these spans.
fn law(span: f64) -> EdgeLaw<f64> {
    EdgeLaw::above(2.0).with_span(Span::new(span))
}

#[test]
fn u_is_on_a_side_that_there_is() {
    let u = [1.0, 2.0, 3.0, f64::NAN];
    let admitted = |span| u.map(|u| law(span).admits(u));
    assert_eq!(admitted(ENDLESS), [false, true, true, false]);
    assert_eq!(admitted(-ENDLESS), [true, true, false, false]);
    assert_eq!(admitted(0.5), [true, true, true, false]);
    let saturated = |span| u.map(|u| law(span).is_saturated(u));
    assert_eq!(saturated(0.5), [true, false, false, false]);
    assert_eq!(saturated(ENDLESS), [false; 4]);
    assert_eq!([-ENDLESS, -0.5].map(saturated), [[true, false, false, false]; 2]);
    assert_eq!(u.map(|u| law(-0.5).missing(u)), [0.0, 0.0, -0.5, 0.0]);
    assert_eq!([ENDLESS, -ENDLESS].map(|span| law(span).missing(1.0)), [0.0; 2]);
    assert_eq!(u.map(|u| law(0.5).missing(u)), [0.5, 0.0, 0.0, 0.0]);
}

/// A row with 4 on its diagonal: a unit of load moves u by ¼.
#[test]
fn a_relaxation_ends_between_both_loads() {
    let softness = 0.25;
    let ends = |span| [0.0, 1.25, 1.75, 2.0, 3.0, f64::NAN].map(|u| law(span).project(u, softness));
    assert_eq!(ends(2.0), [0.5, 1.75, 2.0, 2.0, 3.0, 2.0]);
    assert_eq!(ends(ENDLESS), [2.0, 2.0, 2.0, 2.0, 3.0, 2.0]);
    assert_eq!(ends(-ENDLESS), [0.0, 1.25, 1.75, 2.0, 2.0, 2.0]);
    assert_eq!(ends(0.0)[..5], [0.0, 1.25, 1.75, 2.0, 3.0]);
    for span in [2.0, 0.0, ENDLESS, -ENDLESS] {
        let law = law(span);
        for u in [0.5, 1.9, 2.0, 2.25, 4.0] {
            for step in [-3.0, -0.25, -0.1, 0.0, 0.1, 3.0] {
                if !law.admits(u) {
                    continue;
                }
                let by = match law.movement(law.opening(u), step, softness) {
                    Move::Row(by) => by,
                    Move::Gap(opening) => -opening,
                };
                let ends = law.project(u + step, softness);
                assert!((u + by - ends).abs() < 1e-12, "{span} {u} {step}: {by} {ends}");
            }
        }
    }
}

#[test]
fn a_step_ends_on_the_gap_from_either_side() {
    assert_eq!(law(2.0).room(3.0, -0.5), Some(2.0));
    assert_eq!(law(2.0).room(1.0, 0.25), Some(4.0));
    assert_eq!([law(2.0).room(3.0, 0.5), law(2.0).room(1.0, -0.5)], [None, None]);
    assert!(law(2.0).lands(2.1, -1.0, 0.2) && law(2.0).lands(1.9, 1.0, 0.2));
    assert!(!law(2.0).lands(2.1, 0.0, 0.2) && !law(2.0).lands(1.5, 1.0, 0.2));
    assert!(law(ENDLESS).lands(1.0, -1.0, 0.2) && !law(ENDLESS).lands(2.1, 1.0, 0.2));
}

#[test]
fn a_flux_goes_with_its_side() {
    let flux = |span: f64, u, given| law(span).flux(u, given, FluxRange::new(1.0, Span::new(span)));
    let sides = |span| [3.0, 2.0, 1.0].map(|u| flux(span, u, 1.5));
    assert_eq!(sides(2.0), [1.0, 1.5, 3.0]);
    assert_eq!(sides(ENDLESS)[..2], [1.0, 1.5]);
    assert_eq!(sides(-ENDLESS)[1..], [1.0, 1.0]);
    assert_eq!(flux(-ENDLESS, 2.0, -4.0), -4.0);
    assert_eq!([flux(2.0, 2.0, 0.0), flux(2.0, 2.0, 9.0)], [1.0, 3.0]);
    let touching = law(ENDLESS).flux(2.0, 0.5, FluxRange::from(1.0));
    assert_eq!(touching, 1.0, "it is not pulled at");
    assert!([2.0, f64::NAN].iter().all(|&u| flux(ENDLESS, u, f64::NAN).is_nan()));
    // The same range from its upper end on.
    let from_above = FluxRange::new(3.0, Span::new(-2.0));
    let sides = [3.0, 2.0, 1.0].map(|u| law(-2.0).flux(u, 1.5, from_above));
    assert_eq!((sides, from_above.ends()), ([1.0, 1.5, 3.0], [1.0, 3.0]));
    assert_eq!([0.5, 1.0, 1.5].map(|flux| from_above.multiplier(flux)), [-0.5, 0.0, 0.5]);
}

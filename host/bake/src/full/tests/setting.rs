//! A scene's setting: what its ticks do, and what is refused.

use signorini_bound::certificate::Verdict;
use signorini_device::tick::{Ended, Limits, Report};
use signorini_tolerances::bake::{SWEPT, SWEPT_NARROW};

use super::{BENT, Baked, Controller, fixtures, to_the_end};
use crate::Bakes;
use crate::full::sizes;
use signorini_problem::Problem;
use signorini_scene::error::Result;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_scene::setting::{MathKind, Omega, Setting, Start};

/// Without the output that is the bound.
pub(super) fn unbounded() -> &'static str {
    BENT.split("output.bound = ").next().unwrap_or_default()
}

pub(super) fn scene(text: &str, cells: Cells, setting: Setting) -> Result<Problem> {
    let (_, problem) = fixtures::on_grid(text, grid(4, cells))?;
    Ok(problem.with_setting(Some(setting)))
}

/// u, τ and report.
type Told<R> = (Vec<R>, Vec<R>, Report<R>);

/// Answers of ticks with these lifts of the gap.
fn ticks<R: Bakes>(setting: Setting, lifts: &[f64]) -> Result<Vec<Told<R>>> {
    let problem = scene(unbounded(), Cells::Quads, setting)?;
    let baked = Baked::<R>::new(&problem)?;
    let mut controller = Controller::<R>::new(&baked);
    let tick = |&lift: &f64| {
        let inputs = [lift, 0.7, 0.0, 0.0, 0.0, 0.0].map(R::narrow);
        let (_, report) = controller.tick(&inputs).expect("a tick");
        (controller.u().to_vec(), controller.numbers().tau.to_vec(), report)
    };
    Ok(lifts.iter().map(tick).collect())
}

#[test]
fn so_many_sweeps_are_done_and_the_certificate_does_not_touch_u() -> Result<()> {
    let twelve = Setting { sweeps: Some(12), omega: Omega::Fixed(1.4), ..Setting::default() };
    let lifts = [0.3, 0.3, 0.3, 0.3, 0.3, 0.3, 0.3, 0.3, -0.2];
    let with = ticks::<f32>(twelve, &lifts)?;
    let without = ticks::<f32>(Setting { certificate: false, ..twelve }, &lifts)?;
    for ((u, tau, report), (same, other, plain)) in with.iter().zip(&without) {
        // At the rounding floor, too.
        assert_eq!((report.sweeps, report.ended), (12, Ended::OutOfSweeps));
        assert_eq!((plain.sweeps, plain.ended), (12, Ended::OutOfSweeps));
        assert_eq!((report.figures.omega, plain.figures.omega), (1.4, 1.4));
        assert_eq!((u, report.figures.residual), (same, plain.figures.residual));
        assert!(report.verdict.certificate().is_some() && plain.verdict == Verdict::NotAsked);
        assert_ne!(tau, other);
    }
    Ok(())
}

#[test]
fn without_a_number_of_sweeps_rounding_ends_a_tick_that_has_no_bound() -> Result<()> {
    let plain = Setting { certificate: false, ..Setting::default() };
    let [(u, _, report)] = &ticks::<f64>(plain, &[0.3])?[..] else { panic!("one tick") };
    assert_eq!(report.ended, Ended::Settled);
    let exact = Setting { sweeps: Some(4000), omega: Omega::Fixed(1.5), ..plain };
    let [(exact, ..)] = &ticks::<f64>(exact, &[0.3])?[..] else { panic!("one tick") };
    SWEPT.check_each("u", u, exact);
    Ok(())
}

#[test]
fn a_share_is_kept_and_less_takes_longer() -> Result<()> {
    let sweeps = |share| -> Result<u32> {
        let found = ticks::<f64>(Setting { share: Some(share), ..Setting::default() }, &[0.3])?;
        let certificate = *found[0].2.verdict.certificate().expect("a bound");
        assert!(certificate.algebraic <= share * certificate.total);
        Ok(found[0].2.sweeps)
    };
    assert!(sweeps(0.3)? < sweeps(1e-4)?);
    Ok(())
}

#[test]
fn cold_ticks_know_nothing_of_each_other() -> Result<()> {
    for certificate in [true, false] {
        let cold = Setting { start: Start::Cold, certificate, ..Setting::default() };
        let ticks_of = |start| ticks::<f32>(Setting { start, ..cold }, &[0.3, 0.3]);
        let [first, second] = &ticks_of(Start::Cold)?[..] else { panic!("two ticks") };
        assert_eq!((&first.0, first.2.sweeps), (&second.0, second.2.sweeps));
        let [first, second] = &ticks_of(Start::Warm)?[..] else { panic!("two ticks") };
        assert!(second.2.sweeps < first.2.sweeps);
    }
    Ok(())
}

#[test]
fn the_square_root_moves_omega_and_not_the_answer() -> Result<()> {
    let of = |math| ticks::<f32>(Setting { math, share: Some(1e-4), ..Setting::default() }, &[0.3]);
    let (libm, micromath) = (of(MathKind::Libm)?, of(MathKind::Micromath)?);
    let [(u, _, report)] = &libm[..] else { panic!("one tick") };
    let [(other, _, fast)] = &micromath[..] else { panic!("one tick") };
    assert_ne!(report.figures.omega, fast.figures.omega);
    SWEPT_NARROW.check_each("u", u, other);
    Ok(())
}

#[test]
fn without_the_bound_nothing_of_it_is_kept() -> Result<()> {
    let without = Setting { certificate: false, ..Setting::default() };
    let of = |setting| -> Result<_> {
        let problem = scene(unbounded(), Cells::Mixed, setting)?;
        let baked = Baked::<f32>::new(&problem)?;
        Ok((sizes(&baked), baked.index(), baked.width(), super::source(&baked)))
    };
    let (with, without) = (of(Setting::default())?, of(without)?);
    assert!(without.0.ram < with.0.ram && without.0.flash < with.0.flash / 2);
    assert_eq!((without.1, without.2), (with.1, with.2));
    assert!(with.3.contains("\"varying\"") && !without.3.contains("\"varying\""));
    assert!(!without.3.contains("PACKED") && !without.3.contains("CURVED"));
    Ok(())
}

#[test]
fn what_no_module_can_have_is_refused_by_its_key() -> Result<()> {
    let says = |text: &str, setting: Setting, words: &[&str]| -> Result<()> {
        let problem = scene(text, Cells::Triangles, setting)?;
        let error = Baked::<f64>::new(&problem).expect_err("refused").to_string();
        assert!(words.iter().all(|word| error.contains(word)), "{error}");
        Ok(())
    };
    let plain = Setting::default();
    let words = ["output.bound", "setting.certificate"];
    says(BENT, Setting { certificate: false, ..plain }, &words)?;
    says(BENT, Setting { math: MathKind::Micromath, ..plain }, &["setting.math", "f64"])?;
    says(BENT, Setting { omega: Omega::Fixed(2.0), ..plain }, &["setting.omega"])?;
    // Rounded to f32 it is 2.
    let close = Setting { omega: Omega::Fixed(2.0 - 1e-12), ..plain };
    let problem = scene(BENT, Cells::Triangles, close)?;
    let refused = Baked::<f32>::new(&problem).expect_err("refused").to_string();
    assert!(refused.contains("is not inside (0, 2) in f32"), "{refused}");
    let baked = Baked::<f64>::new(&problem)?;
    let mut controller = Controller::<f64>::new(&baked);
    assert!(controller.tick(&[0.3, 0.7, 0.0, 0.0, 0.0, 0.0]).is_ok());
    Ok(())
}

/// u_D jumps from one side to the next.
#[test]
fn nothing_is_accurate_without_a_bound() -> Result<()> {
    let text = unbounded().replace(
        "boundary.left = { kind = \"robin\", coefficient = \"2 + y\", ambient = \"y\" }",
        "boundary.left = { kind = \"dirichlet\", value = \"9\" }",
    );
    let text = text.lines().filter(|line| !line.starts_with("input.air")).collect::<Vec<_>>();
    let problem = scene(&text.join("\n"), Cells::Quads, Setting::default())?;
    let baked = Baked::<f64>::new(&problem)?;
    let limits = Limits { error: 1e9, ..to_the_end() };
    let inputs = [0.3, 0.7, 0.0, 0.0, 0.0];
    let ticked = Controller::<f64>::new(&baked).tick_within(&inputs, limits);
    let (_, report) = ticked.expect("a tick");
    assert_eq!((report.verdict, report.ended), (Verdict::Unavailable, Ended::Settled));
    Ok(())
}

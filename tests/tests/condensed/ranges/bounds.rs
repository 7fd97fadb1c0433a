//! The bound of a reduced model against exact solutions: of its solution, of ticks that were cut off, of any x within
//! the limits.

use signorini_tolerances::{cases, some};
use std::path::Path;

use signorini_bake::condensed::{Baked, Controller, Work};
use signorini_certify::exact::distance;
use signorini_condense::{Recovery, recoverable};
use signorini_kernel::report::Ended;
use signorini_problem::Problem;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_tests::random::Random;
use signorini_tolerances::bake::GUARANTEE;
use signorini_tolerances::twins::IDENTITY;

use super::Pair;
use crate::standard::posed;

/// A scene whose exact solution is that of its default inputs.
struct Exact {
    problem: Problem,
    recovery: Recovery,
    pair: Pair,
}

impl Exact {
    /// A scene of the catalogue whose gap may sink or rise by so much.
    fn catalogue(file: &str, cells: Cells, by: f64) -> Self {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../meshes/catalogue");
        let text = std::fs::read_to_string(folder.join(format!("{file}.toml"))).expect("a file");
        let input = "[input.drop]\nof = \"contact\"\nfield = \"gap\"\npattern = \"(1 - x^2)*(1 + x/2)\"\ndefault = 0.0\n";
        let range = format!("range = [{}, {by}]\n", -by);
        let problem = posed(&(text + input + &range), grid(6, cells)).expect("a problem");
        let (whole, recovery) = recoverable(&problem).expect("a condensed model");
        let what = format!("{file} {cells:?} {by}");
        let pair = Pair::new(&what, &whole).expect("edges to take out");
        Self { problem, recovery, pair }
    }

    /// The error of s and τ of the whole model is at most `bound`.
    fn check(&self, p: &[f64], own: &[f64], bound: f64) {
        let Pair { what, whole, reduced, .. } = &self.pair;
        let x = reduced.expand(p, own);
        let answer = self.recovery.admissible(whole, &self.problem, p, &x);
        let answer = answer.expect("a certificate");
        let exact = self.problem.scene.exact.as_ref().expect("an exact solution");
        let found = distance(exact, &self.problem, &answer.admissible()).expect("finite data");
        GUARANTEE.check_at_most(format_args!("{what} combined"), found.combined, bound);
        IDENTITY.check_at_most(format_args!("{what} identity"), found.identity, bound);
    }
}

const P: [f64; 2] = [1.0, 0.0];

fn all(mut check: impl FnMut(&Exact)) {
    let (mut kept, mut dropped) = (0, 0);
    let of = |(file, by)| [Cells::Triangles, Cells::Quads].map(|cells| (file, by, cells));
    let files = ["h-tri", "j100-tri", "hg-tri"];
    let drops = files.map(|file| [0.0, 0.003, 0.1].map(|by| (file, by)));
    for (file, by, cells) in some(5, drops.as_flattened().iter().copied().flat_map(of)) {
        let exact = Exact::catalogue(file, cells, by);
        let Pair { whole, reduced, .. } = &exact.pair;
        kept += reduced.model.contact as u64;
        dropped += (whole.contact - reduced.model.contact) as u64;
        check(&exact);
    }
    assert!(kept > cases(20) && dropped > cases(100), "{kept} {dropped}");
}

#[test]
fn of_any_x_within_the_limits() {
    let random = &mut Random::new(11);
    all(|exact| {
        let Pair { what, reduced, .. } = &exact.pair;
        let limits = &reduced.model.limits;
        let own = reduced.model.solve(&P).expect("a solution");
        let ends = [0, 1].map(|end| limits.iter().map(|limits| limits[end]).collect());
        let some = [(); 3].map(|()| exact.pair.within(random));
        for x in [vec![own], ends.to_vec(), some.to_vec()].concat() {
            let bound = reduced.model.bound(&P, &x);
            exact.check(&P, &x, bound.unwrap_or_else(|| panic!("{what}: a bound")));
        }
    });
}

#[test]
fn of_ticks_that_are_cut_off() {
    let mut cut_off = 0;
    all(|exact| {
        let reduced = &exact.pair.reduced;
        let [_, [least, most]] = reduced.model.ranges[..] else { panic!("one input") };
        for work in [(Some(100), 0), (Some(0), 0), (Some(1), 0), (None, 1), (None, 3)] {
            let work = Work { pivots: work.0, sweeps: work.1 };
            let baked = Baked::<f32>::new(&reduced.model, work, true).expect("in range");
            let mut controller = Controller::new(&baked);
            // The wrong answers are those of the ends of the range.
            for before in [least, most] {
                controller.tick(&[before as f32]).expect("a tick");
                let (_, report) = controller.tick(&[0.0]).expect("a tick");
                let certificate = report.certificate().expect("a bound");
                let x: Vec<f64> = controller.x().iter().map(|&x| f64::from(x)).collect();
                exact.check(&P, &x, f64::from(certificate.total));
                cut_off += usize::from(report.ended != Ended::Exact);
            }
        }
    });
    assert!(cut_off as u64 > cases(10), "{cut_off}");
}

//! Every stage on small awkward problems, bit for bit as recorded in `replay/expected`.
//!
//! The kernel adds, multiplies and takes roots in one fixed order, so its bits are a fact: the same on every
//! machine, and changed only where somebody changes the arithmetic. That the recorded answers are right is what
//! the other tests are for. `BLESS=1 cargo test -p signorini-device --test main replay::` writes the record anew.

mod arrays;
mod bound;
mod condensed;
mod factor;
mod full;
mod journal;
mod matrix;
mod scene;
mod solve;
mod ticks;

use arrays::Arrays;
use journal::Journal;
use scene::SCENES;
use signorini_kernel::Error;

/// A stage on every scene, in both scalars.
fn replay(name: &str, narrow: Stage<f32>, wide: Stage<f64>) {
    let mut journal = Journal::beside(name);
    for scene in &SCENES {
        journal.title(scene.name, "f32");
        Arrays::new(scene).and_then(|arrays| narrow(&arrays, &mut journal)).expect("f32");
        journal.compare();
        journal.title(scene.name, "f64");
        Arrays::new(scene).and_then(|arrays| wide(&arrays, &mut journal)).expect("f64");
        journal.compare();
    }
    journal.finish();
}

type Stage<R> = fn(&Arrays<R>, &mut Journal) -> Result<(), Error>;

#[test]
fn mesh_and_matrix() {
    replay("matrix", matrix::run::<f32>, matrix::run::<f64>);
}

#[test]
fn sweeps_and_fluxes() {
    replay("sweeps", matrix::sweeps::<f32>, matrix::sweeps::<f64>);
}

#[test]
fn solves() {
    replay("solve", solve::run::<f32>, solve::run::<f64>);
}

#[test]
fn help_where_sweeps_crawl() {
    replay("help", solve::help::<f32>, solve::help::<f64>);
}

#[test]
fn exact_solves() {
    replay("factor", factor::run::<f32>, factor::run::<f64>);
}

#[test]
fn bounds() {
    replay("bound", bound::run::<f32>, bound::run::<f64>);
}

#[test]
fn ticks_from_warm_starts() {
    replay("tick", ticks::run::<f32>, ticks::run::<f64>);
}

#[test]
fn full_models() {
    replay("full", full::run::<f32>, full::run::<f64>);
}

#[test]
fn condensed_models() {
    let mut journal = Journal::beside("condensed");
    journal.title("strips", "f32");
    condensed::run::<f32>(&mut journal).expect("f32");
    journal.compare();
    journal.title("strips", "f64");
    condensed::run::<f64>(&mut journal).expect("f64");
    journal.compare();
    journal.finish();
}

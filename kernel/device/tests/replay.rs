//! Every stage on small awkward problems, bit for bit as recorded in `replay/expected`.
//!
//! The kernel adds, multiplies and takes roots in one fixed order, so its bits are a fact: the same on every
//! machine, and changed only where somebody changes the arithmetic. That the recorded answers are right is what
//! the other tests are for. `BLESS=1 cargo test -p signorini-device --test main replay::` writes the record anew.

mod arrays;
mod bound;
mod condensed;
mod full;
mod journal;
mod matrix;
mod scene;
mod solve;
mod ticks;

use journal::{Journal, replay};

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

//! Every layer timed by itself, in both scalars, on triangles and on quads, at three sizes.
//!
//! ```text
//!   cargo bench --bench kernel                             all of it
//!   cargo bench --bench kernel -- "sweep triangles/f32"    one stage in one scalar
//!   cargo bench --bench kernel -- --test                   each once, for its answer alone
//! ```
//! Throughput counts unknowns (edges not on D): a sweep at 100 Melem/s relaxes 10⁸ unknowns a second. That of
//! condensed models counts contact edges.

mod assembly;
mod certificate;
mod condensed;
mod host;
mod mesh;
mod refined;
mod solve;
mod strip;
mod sweep;

use std::time::Duration;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, BenchmarkId, Criterion, Throughput};
use signorini_kernel::rows::{QUADS, TRIANGLES};
use signorini_problem::scalar::Scalar;
use signorini_scene::mesh::structured::Cells;
use strip::{Stage, Strip};

/// Squares across the height of the domain.
const SIZES: [u32; 3] = [16, 48, 128];

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    for cells in [Cells::Triangles, Cells::Quads] {
        let strips = SIZES.map(|n| Strip::new(n, cells));
        let mut stages = Stages { criterion: &mut criterion, strips: &strips, cells };
        in_scalar::<f64>(&mut stages);
        in_scalar::<f32>(&mut stages);
        stages.wide::<f32>(
            "solve refined",
            [refined::refined::<f32, TRIANGLES>, refined::refined::<f32, QUADS>],
        );
        stages.wide::<f64>("solve to 1e-12", [refined::pure::<TRIANGLES>, refined::pure::<QUADS>]);
        stages.time::<f64>("solve to 1e-12 with sweeps in f32", refined::mixed);
        host::stages(&mut stages);
    }
    host::files(&mut criterion);
    host::refinement(&mut criterion);
    condensed::stages::<f64>(&mut criterion);
    condensed::stages::<f32>(&mut criterion);
    criterion.final_summary();
}

fn in_scalar<R: Scalar>(stages: &mut Stages) {
    stages.time::<R>("mesh check", mesh::check::<R>);
    stages.time::<R>("numbering", mesh::numbering::<R>);
    stages.time::<R>("element matrices", mesh::matrices::<R>);
    stages.time::<R>("pattern", assembly::pattern::<R>);
    stages.time::<R>("matrix", assembly::values::<R>);
    stages.time::<R>("load", assembly::load::<R>);
    stages
        .wide::<R>("rows from matrix", [assembly::set::<R, TRIANGLES>, assembly::set::<R, QUADS>]);
    stages.wide::<R>(
        "rows from cells",
        [assembly::gather::<R, TRIANGLES>, assembly::gather::<R, QUADS>],
    );
    stages.wide::<R>("sweep", [sweep::sweep::<R, TRIANGLES>, sweep::sweep::<R, QUADS>]);
    stages.time::<R>("residual", sweep::residual::<R>);
    stages
        .wide::<R>("residual by rows", [sweep::defect::<R, TRIANGLES>, sweep::defect::<R, QUADS>]);
    stages.wide::<R>("solve cold", [solve::cold::<R, TRIANGLES>, solve::cold::<R, QUADS>]);
    stages.wide::<R>("solve warm", [solve::warm::<R, TRIANGLES>, solve::warm::<R, QUADS>]);
    stages.wide::<R>(
        "solve coarse to fine",
        [solve::coarse_to_fine::<R, TRIANGLES>, solve::coarse_to_fine::<R, QUADS>],
    );
    stages.time::<R>("flux of edges", sweep::flux_of_edges::<R>);
    stages.time::<R>("flux of cells", sweep::flux_of_cells::<R>);
    stages.time::<R>("certificate", certificate::certificate::<R>);
    stages.wide::<R>("tick", [certificate::tick::<R, TRIANGLES>, certificate::tick::<R, QUADS>]);
}

/// Where stages are timed: one kind of cell, every size.
struct Stages<'a> {
    criterion: &'a mut Criterion,
    strips: &'a [Strip],
    cells: Cells,
}

impl Stages<'_> {
    /// Times what depends on how long rows are: on triangles, and where there are quads.
    fn wide<R: Scalar>(&mut self, stage: &str, [short, long]: [Stage; 2]) {
        self.time::<R>(stage, if self.cells == Cells::Quads { long } else { short });
    }

    /// Times one stage of scalar `R` at every size.
    fn time<R: Scalar>(&mut self, stage: &str, time: Stage) {
        let cells = if self.cells == Cells::Quads { "quads" } else { "triangles" };
        let mut group = group(self.criterion, &format!("{stage} {cells}/{}", R::NAME));
        for strip in self.strips {
            let unknowns = strip.unknowns();
            group.throughput(Throughput::Elements(unknowns as u64));
            group.bench_function(BenchmarkId::from_parameter(unknowns), |bencher| {
                assert_eq!(strip.problem().topology.counts.unknowns(), unknowns);
                time(bencher, strip);
            });
        }
    }
}

/// Short measurements: there are hundreds.
fn group<'a>(criterion: &'a mut Criterion, name: &str) -> BenchmarkGroup<'a, WallTime> {
    let mut group = criterion.benchmark_group(name);
    group.sample_size(20);
    group.warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_secs(1));
    group
}

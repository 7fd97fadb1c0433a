//! The condensed model: contact edges alone.

use criterion::{Bencher, BenchmarkId, Criterion, Throughput};
use signorini_bake::condensed::{Baked, Controller, Work};
use signorini_condense::{CondensedModel, condense};
use signorini_contact::candidate::Candidate;
use signorini_contact::dense::blocks::padded;
use signorini_contact::dense::ranges::Given;
use signorini_contact::dense::sor;
use signorini_problem::scalar::Scalar;
use signorini_scene::mesh::structured::Cells;

use crate::group;
use crate::strip::Strip;

/// Squares across the height: half of the contact edges.
const SIZES: [u32; 3] = [8, 16, 32];

type Stage = fn(&mut Bencher, &CondensedModel);

pub fn stages<R: Scalar>(criterion: &mut Criterion) {
    let condensates = SIZES.map(|n| {
        let strip = Strip::new(n, Cells::Triangles);
        std::cell::LazyCell::new(move || {
            condense(strip.problem()).expect("the strip can be condensed")
        })
    });
    let stages: [(&str, Stage); 4] = [
        ("condensed sweep", sweep::<R>),
        ("condensed tick", |bencher, condensate| tick::<R>(bencher, condensate, false)),
        ("condensed tick with bound", |bencher, condensate| tick::<R>(bencher, condensate, true)),
        ("condensed bound", bound::<R>),
    ];
    for (stage, time) in stages {
        let mut group = group(criterion, &format!("{stage}/{}", R::NAME));
        for (condensate, n) in condensates.iter().zip(SIZES) {
            let contact = 2 * n;
            group.throughput(Throughput::Elements(u64::from(contact)));
            group.bench_function(BenchmarkId::from_parameter(contact), |bencher| {
                assert_eq!(condensate.contact, contact as usize);
                time(bencher, condensate);
            });
        }
    }
}

/// The exact method, with sweeps to fall back on.
const EXACT: Work = Work { pivots: Some(40), sweeps: 20 };

fn baked<R: Scalar>(condensate: &CondensedModel, certified: bool) -> Baked<R> {
    Baked::new(condensate, EXACT, certified).expect("the scalar holds the model")
}

/// One dense sweep.
fn sweep<R: Scalar>(bencher: &mut Bencher, condensate: &CondensedModel) {
    baked::<R>(condensate, false).with_model(|model| {
        let matrix = model.matrix().expect("as many blocks as it takes");
        let load = vec![R::ONE; padded(condensate.contact)];
        let mut x = vec![R::ZERO; load.len()];
        bencher.iter(|| sor::sweep(&matrix, Given::above(&load), R::narrow(1.4), &mut x));
    });
}

/// A warm tick of the exact method, its outputs included; u_D is up and down by 10 %.
fn tick<R: Scalar>(bencher: &mut Bencher, condensate: &CondensedModel, certified: bool) {
    let baked = baked::<R>(condensate, certified);
    let mut controller = Controller::new(&baked);
    let mut inputs = [0.9, 1.1].map(|factor| R::narrow(factor * condensate.defaults[1]));
    bencher.iter(|| {
        inputs.reverse();
        controller.tick(&inputs[..1])
    });
}

/// The bound of a solution.
fn bound<R: Scalar>(bencher: &mut Bencher, condensate: &CondensedModel) {
    let p = &condensate.defaults;
    let x = condensate.solve(p).expect("there is a solution");
    let residual = condensate.residual(p, &x);
    let narrow = |numbers: &[f64]| numbers.iter().map(|&x| R::narrow(x)).collect::<Vec<_>>();
    let [inputs, x, residual] = [p, &x, &residual].map(|numbers| narrow(numbers));
    let answer =
        Candidate { inputs: &inputs, x: &x, residual: &residual, ranges: Given::above(&[]).ranges };
    baked::<R>(condensate, true).with_model(|model| {
        let form = model.certificate.as_ref().expect("the strip has a bound");
        let columns = inputs.len() + x.len() + form.vertices.len();
        let [mut z, mut sum] = [vec![R::ZERO; columns], vec![R::ZERO; columns]];
        bencher.iter(|| form.certify(&answer, &mut z, &mut sum));
    });
}

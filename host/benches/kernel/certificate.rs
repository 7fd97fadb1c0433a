//! The error bound alone, and a whole tick of the full model.

use criterion::Bencher;
use signorini_bake::full::{Baked, Controller};
use signorini_certify::{Certifier, Data};
use signorini_problem::scalar::Scalar;

use crate::strip::{Strip, scene};

/// The bound of an iterate.
pub fn certificate<R: Scalar>(bencher: &mut Bencher, strip: &Strip) {
    let (problem, parts) = (strip.problem(), strip.parts());
    let assembled = strip.assembled::<R>();
    let certifier = Certifier::new(problem, &parts, &assembled);
    let mut certifier = certifier.expect("D holds the strip");
    let data = Data::new(problem).expect("the data are finite");
    let u = assembled.start();
    let bound = certifier.certify(&parts, &assembled, &data, &u).expect("one mesh");
    assert!(bound.is_some());
    bencher.iter(|| certifier.certify(&parts, &assembled, &data, &u));
}

/// Data from inputs, sweeps with certificates until the bound is settled, outputs; u_D is up and down by
/// 10 % from tick to tick.
pub fn tick<R: Scalar, const WIDTH: usize>(bencher: &mut Bencher, strip: &Strip) {
    let scene = scene(1.0);
    let baked = Baked::<R>::new(strip.problem()).expect("the strip can be baked");
    let mut controller = Controller::<R, WIDTH>::new(&baked);
    let mut inputs = [0.9, 1.1].map(|factor| R::narrow(factor * scene.inputs[0].default));
    let mut tick = || {
        inputs.reverse();
        controller.tick(&inputs[..1])
    };
    assert!(tick().is_ok_and(|(_, report)| report.verdict.certificate().is_some()));
    bencher.iter(tick);
}

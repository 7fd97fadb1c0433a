//! The answer of a kernel's tick on the mesh.

use signorini_certify::admissible::Following;
use signorini_certify::{CertifiedFields, ErrorBound};
use signorini_device::full::Numbers;
use signorini_device::tick::Report;
use signorini_problem::scalar::Scalar;
use signorini_scene::scene::units::Units;
use signorini_solve::{Ending, Solution};

/// The answer in the scene's units, `left` by a tick in others; which edges are active, and why there is no bound, is for the session to add.
pub fn answer<R: Scalar>(report: &Report<R>, left: &Numbers<&[R]>, units: &Units) -> Solution {
    let wide = |numbers: &[R], unit: f64| -> Vec<f64> {
        numbers.iter().map(|x| x.wide() * unit).collect()
    };
    let u = wide(left.u, units.u);
    let tau = wide(left.tau, units.flux());
    let bubbles = match left.bubbles {
        [] => vec![0.0; u.len()],
        bubbles => wide(bubbles, units.u),
    };
    Solution {
        scalar: crate::scalar_kind::<R>(),
        status: Ending::Tick(report.ended),
        sweeps: report.sweeps,
        algebraic_residual: report.figures.residual.wide() / range(&u),
        omega: report.figures.omega.wide(),
        flux: tau.clone(),
        contact_force: report.figures.force.wide(),
        bound: report.verdict.certificate().map(ErrorBound::new),
        certified: CertifiedFields {
            vertices: wide(left.vertices, units.u),
            bubbles,
            tau,
            indicators: Vec::new(),
            following: Following::WhereNeeded,
            ..CertifiedFields::default()
        },
        u,
        ..Solution::default()
    }
}

fn range(u: &[f64]) -> f64 {
    let most = u.iter().fold(f64::NEG_INFINITY, |most, &u| most.max(u));
    let least = u.iter().fold(f64::INFINITY, |least, &u| least.min(u));
    (most - least).max(f64::MIN_POSITIVE)
}

//! Forces of contact keep their sign wherever the solver was stopped, and are those of the law of contact.

use crate::memory::{Dense, Draw, bare};
use crate::numbering::{Cut, cells, corners};
use crate::strip::Strip;
use signorini_contact::method::Sweeps;
use signorini_contact::outputs::Measure;
use signorini_contact::{Condensed, Memory};
use signorini_device::condition::{BoundaryEdge, Condition};
use signorini_device::workspace;
use signorini_kernel::limits::Deadline;
use signorini_kernel::relaxation::Relaxation;
use signorini_kernel::report::Ended;
use signorini_kernel::solver::Settings;
use signorini_kernel::stiffness::Coefficient;
use signorini_kernel::{Error, Mesh, Real, Tensor};
use signorini_tolerances::kernel::{FORCE_AT_THE_END, FORCE_BY_LAW};

/// Cells along a side of the plate.
const N: usize = 8;

type Plate<R> = workspace!(R, u16: vertices 81, triangles 128, quads 1, boundary 32);

/// Heat into the top of a plate that a heater at its bottom keeps above a gap that bends.
fn plate<R: Real>(vertices: &[[R; 2]], triangles: &[[u16; 3]]) -> Result<Box<Plate<R>>, Error> {
    let of = |x: f64| R::from_f64(x).unwrap_or(R::ZERO);
    let mesh = Mesh::new(vertices, triangles, &[])?;
    let condition = |edge: &BoundaryEdge<R, u16>| {
        let [x, y] = edge.middle();
        Some(if y == R::ZERO {
            Condition::Contact { gap: of(2.0) - x * x, flux: of(-0.125) }
        } else if y == R::ONE {
            Condition::Robin { coefficient: R::TWO, ambient: of(3.0) * x }
        } else {
            Condition::Neumann { flux: R::ZERO }
        })
    };
    let mut plate = Box::new(Plate::new());
    let a = Tensor { xx: R::ONE, xy: R::ZERO, yy: R::TWO };
    plate.build(&mesh, Coefficient::Uniform(a), condition)?;
    Ok(plate)
}

/// Every stop of a cold solve. Returns how often the plain sum of σ·n − q was negative.
fn stops<R: Real + Into<f64>>() -> Result<usize, Error> {
    let at = |x: f64| R::from_f64(x / N as f64).unwrap_or(R::ZERO);
    let vertices: Vec<_> = corners([N, N]).map(|corner| corner.map(at)).collect();
    let (triangles, _) = cells([N, N], |_, _| Cut::First);
    let mesh = Mesh::new(&vertices, &triangles, &[])?;
    let mut pulled = 0;
    for sweeps in 0..120 {
        let mut plate = plate(&vertices, &triangles)?;
        let relaxation = Relaxation::Fixed(R::ONE + R::HALF);
        plate.solve(Settings { max_sweeps: sweeps, relaxation, ..Settings::default() })?;
        let edges = plate.edges()?;
        let counts = edges.counts();
        let (mut by_law, mut plain, mut size) = (0.0_f64, 0.0, 0.0);
        for edge in counts.free..counts.unknowns() {
            let ends = edges.endpoints(&mesh, edge).map(|v| vertices[usize::from(v)][0].into());
            let middle = (ends[0] + ends[1]) / 2.0;
            let (u, flux): (f64, f64) = (plate.u()[edge].into(), plate.flux()[edge].into());
            let lambda = flux + 0.125 / N as f64;
            assert!(u >= 2.0 - middle * middle);
            by_law += if u == 2.0 - middle * middle { lambda.max(0.0) } else { 0.0 };
            plain += lambda;
            size += flux.abs() + 0.125;
        }
        let force: f64 = plate.contact_force().into();
        let epsilon = R::EPSILON.into() / f64::EPSILON * size;
        assert!(force >= 0.0, "{sweeps} sweeps: {force}");
        FORCE_BY_LAW.check_over(format_args!("{sweeps} sweeps"), force - by_law, epsilon);
        pulled += usize::from(plain < 0.0);
    }
    Ok(pulled)
}

#[test]
fn a_solve_that_is_cut_off_does_not_pull() -> Result<(), Error> {
    assert!(stops::<f32>()? > 0 && stops::<f64>()? > 0, "the flux (15) never pulled");
    Ok(())
}

/// Every stop of cold sweeps over random loads. Returns how often the linear form S x − b, whose sum the force
/// is for the solution, was negative.
fn condensed_stops<R: Real + Into<f64>>() -> Result<usize, Error> {
    let strip = Strip::<R>::new(21);
    let n = strip.order;
    let weights: Vec<R> = (0..n).map(|at| R::from_count(1 + at as u32 % 3)).collect();
    let nothing = vec![R::ZERO; n];
    let outputs = [
        Measure::Flux { of_inputs: &[], of_contact: &[], of_reaction: &weights },
        Measure::Flux { of_inputs: &[R::HALF], of_contact: &nothing, of_reaction: &weights },
    ];
    let mut random = Draw(11);
    let (mut pulled, mut ended) = (0, 0);
    for tick in 0..40 {
        let load = strip.load(0.05 * f64::from(tick % 9) - 0.2, &mut random);
        let model = Condensed {
            contact: n,
            matrix: strip.blocks(),
            load: &load,
            outputs: &outputs,
            ..bare()
        };
        for most in (0..12).chain([1000]) {
            let mut dense = Dense::new(n);
            let (_, mut memory) = dense.ticking()?;
            let tolerance = R::from_count(16) * R::EPSILON;
            let mut sweeps = Sweeps { omega: R::ONE, tolerance, most };
            let report = model.tick(&[R::ONE], &mut sweeps, &mut Deadline::never(), &mut memory)?;
            let [force, flux] = [0, 1].map(|at| model.output(at, &[R::ONE], &memory, &report));
            let (force, flux): (f64, f64) = (force?.into(), flux?.into());
            assert!(force >= 0.0 && flux >= 0.5, "{tick}, {most} sweeps: {force} {flux}");
            let (by_law, plain, size) = by_hand(&strip, &memory, &weights);
            let epsilon = R::EPSILON.into() / f64::EPSILON * size;
            let what = format!("tick {tick}, {most} sweeps");
            FORCE_BY_LAW.check_over(&what, force - by_law, epsilon);
            FORCE_BY_LAW.check_over(&what, flux - by_law - 0.5, epsilon);
            pulled += usize::from(plain < 0.0);
            if report.ended == Ended::Settled {
                ended += 1;
                FORCE_AT_THE_END.check_over(&what, force - plain, epsilon);
            }
        }
    }
    assert!(ended >= 40, "{ended}");
    Ok(pulled)
}

/// Force by the law, the sum of all r, and the size of its terms, in f64 from x alone.
fn by_hand<R: Real + Into<f64>>(
    strip: &Strip<R>,
    memory: &Memory<R>,
    weights: &[R],
) -> (f64, f64, f64) {
    let (mut by_law, mut plain, mut size) = (0.0_f64, 0.0, 0.0);
    for (i, &weight) in weights.iter().enumerate() {
        let terms = (0..strip.order).map(|j| strip.at(i, j).into() * memory.iterate.x[j].into());
        let (weight, load): (f64, f64) = (weight.into(), memory.load[i].into());
        let r = terms.clone().sum::<f64>() - load;
        size += weight * (terms.map(f64::abs).sum::<f64>() + load.abs());
        plain += weight * r;
        by_law += if memory.iterate.x[i] == R::ZERO { weight * r.max(0.0) } else { 0.0 };
    }
    (by_law, plain, size + 0.5)
}

#[test]
fn condensed_sweeps_that_are_cut_off_do_not_pull() -> Result<(), Error> {
    assert!(condensed_stops::<f32>()? > 0, "S x − b never pulled in f32");
    assert!(condensed_stops::<f64>()? > 0, "S x − b never pulled in f64");
    Ok(())
}

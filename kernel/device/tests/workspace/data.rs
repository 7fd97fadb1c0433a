//! Workspaces whose data change: what stays, what is another mesh, what is too large, and what rounding of data costs.

use super::{Edge, OPEN, SQUARE, TWO, UNIT, ZERO, beside, built, sides, sweeps};
use signorini_device::condition::Condition;
use signorini_device::tick::Deadline;
use signorini_kernel::error::Array;
use signorini_kernel::relaxation::Relaxation;
use signorini_kernel::solver::Settings;
use signorini_kernel::stiffness::Coefficient;
use signorini_kernel::{Error, Libm, Mesh, Tensor};
use signorini_tolerances::kernel::BOUND;

/// 0 on the left, `right` beyond x = 1, `rest` elsewhere.
fn bar(right: Condition<f64>, rest: Condition<f64>) -> impl Fn(&Edge) -> Option<Condition<f64>> {
    sides(2.0, [ZERO, right, rest])
}

/// Two triangles and a square, 2 long.
const NODES: [[f64; 2]; 6] =
    [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0], [2.0, 0.0], [2.0, 1.0]];
const TRIANGLES: [[u16; 3]; 2] = [[0, 2, 3], [0, 3, 1]];
const QUADS: [[u16; 4]; 1] = [[2, 4, 5, 3]];

/// A source that was set before the conditions is there after them, on the boundary as well.
#[test]
fn new_conditions_keep_the_source() -> Result<(), Error> {
    let mesh = Mesh::new(&NODES, &TRIANGLES, &QUADS)?;
    let contact = Condition::Contact { gap: 0.5, flux: 0.25 };
    let mut changed = built(&mesh, UNIT, bar(contact, OPEN))?;
    changed.set_source(&[1.0, 2.0], &[3.0])?;
    changed.set_conditions(&mesh, bar(contact, Condition::Neumann { flux: -0.5 }))?;
    let mut new = built(&mesh, UNIT, bar(contact, Condition::Neumann { flux: -0.5 }))?;
    new.set_source(&[1.0, 2.0], &[3.0])?;
    for plate in [&mut changed, &mut new] {
        plate.solve(Settings::default())?;
    }
    assert_eq!((changed.u(), changed.flux()), (new.u(), new.flux()));
    Ok(())
}

#[test]
fn a_solve_goes_on_from_the_last() -> Result<(), Error> {
    let mesh = Mesh::new(&NODES, &TRIANGLES, &QUADS)?;
    let mut plate = built(&mesh, UNIT, bar(Condition::Contact { gap: 0.5, flux: 0.25 }, OPEN))?;
    plate.set_source(&[1.0, 2.0], &[3.0])?;
    let [first, second] = [(); 2].map(|()| plate.solve(Settings::default()));
    let [first, second] = [first?.sweeps, second?.sweeps];
    assert!(4 * second < first, "{first} {second}");
    Ok(())
}

/// The right side in two edges of lengths 1 and 3, both in contact.
#[test]
fn lengths_of_contact_are_those_of_its_edges() -> Result<(), Error> {
    let corners = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [2.0, 4.0], [0.0, 4.0]];
    let mesh = Mesh::new(&corners, &[[0_u16, 1, 2], [0, 2, 4], [2, 3, 4]], &[])?;
    let mut plate = built(&mesh, UNIT, bar(Condition::Contact { gap: 1.0, flux: 0.0 }, OPEN))?;
    plate.solve(Settings::default())?;
    assert_eq!(plate.contact_length::<Libm>(&mesh)?, 4.0);
    Ok(())
}

#[test]
fn cells_that_differ_in_one_corner_are_another_mesh() -> Result<(), Error> {
    let [one, other] = [[[0_u16, 2, 3]], [[1, 2, 3]]];
    let (one, other) = (Mesh::new(&SQUARE, &one, &[])?, Mesh::new(&SQUARE, &other, &[])?);
    let limits = sweeps(1);
    let mut plate = built(&one, UNIT, |_| Some(ZERO))?;
    plate.tick(&one, limits, &mut Deadline::never())?;
    assert_eq!(plate.tick(&other, limits, &mut Deadline::never()), Err(Error::OtherMesh));
    Ok(())
}

/// Data end at ε² times the largest number, 2⁹²⁰. With A = 2⁻²⁰⁰ and ∫f = 3 · 2⁷²⁰ the load 2⁷²⁰ is far below that; on
/// the leg of the triangle that is not held K_ii = 2A, and b_i/K_ii = 2⁹¹⁹.
#[test]
fn loads_are_as_large_as_what_they_move() -> Result<(), Error> {
    let mesh = Mesh::new(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], &[[0_u16, 1, 2]], &[])?;
    let thin = Coefficient::Uniform(Tensor::scalar(2.0_f64.powi(-200)));
    let limits = sweeps(1);
    for (times, fits) in [(0.25, true), (1.0, true), (3.0, false), (16.0, false)] {
        // Rows hold ω b_i/K_ii: what is told of the load does not know ω.
        for omega in [0.5, 1.0, 1.75] {
            let mut plate = built(&mesh, thin, bar(OPEN, OPEN))?;
            plate.set_relaxation(Relaxation::Fixed(omega))?;
            plate.set_source(&[times * 3.0 * 2.0_f64.powi(720)], &[])?;
            let ticked = plate.tick(&mesh, limits, &mut Deadline::never()).map(drop);
            let solved = plate.solve(Settings { max_sweeps: 1, ..Settings::default() }).map(drop);
            for found in [ticked, solved] {
                let told = matches!(found, Err(Error::NotFinite { of: Array::Load, .. }));
                assert_eq!((found.is_ok(), told), (fits, !fits), "{times} {omega}: {found:?}");
            }
        }
    }
    Ok(())
}

/// Where u_D lies below ψ by rounding, so does s: the bound for ψ has what is missing as well.
#[test]
fn a_gap_that_rounding_lifts_costs_what_it_lifts() -> Result<(), Error> {
    let mesh = Mesh::new(&SQUARE, &TWO, &[])?;
    for steps in [0.0, 2.0, 16.0, 64.0] {
        let value = 1.0 - steps * f64::EPSILON;
        let contact = Condition::Contact { gap: 1.0, flux: 0.0 };
        let mut plate = built(&mesh, UNIT, beside(Condition::Dirichlet { value }, contact))?;
        let report = plate.tick(&mesh, sweeps(100), &mut Deadline::never())?;
        let rounding = report.verdict.certificate().expect("a bound").rounding;
        // Both edges have the cell with Σ|K| = 4. Storing moves each by 2 ε, and ψ follows s by `steps` ε.
        let moved = (2.0 + steps) * (2.0 + steps) + 4.0;
        let expected = (4.0 * 4.0 * moved).sqrt() * f64::EPSILON;
        // The rest of it are ε of what is left of u.
        BOUND.check(format_args!("{steps} ε below ψ"), rounding / expected - 1.0);
    }
    Ok(())
}

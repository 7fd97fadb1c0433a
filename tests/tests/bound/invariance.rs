//! Changes that must not move the bound: the order of the cells, the units.

use signorini_solve::ScalarKind;
use signorini_tests::random::Random;
use signorini_tests::written::{Side, TwoMaterials, Units};
use signorini_tolerances::twins::{ORDER, UNITS};

use super::run::{options, run};
use crate::mesh::{KINDS, relisted, scaled, scattered};

const SIDES: [Side; 3] = [Side::Neumann, Side::Robin, Side::Dirichlet];

#[test]
fn cells_in_another_order() {
    let text = TwoMaterials::h_gap(0.55).written().scene(SIDES, Units::ONE);
    for cells in KINDS {
        let mesh = scattered(&mut Random::new(1), 6, cells);
        let [bound, other] = [mesh.clone(), relisted(mesh)].map(|mesh| {
            let run = run(&text, mesh, &options(ScalarKind::F64, None));
            run.solution.bound.expect("held")
        });
        ORDER.check_relative(format_args!("{cells:?}"), other.total, bound.total);
    }
}

#[test]
fn units_of_length_and_of_u() {
    let written = TwoMaterials::h_gap(0.55).written();
    for cells in KINDS {
        let ratio = |units: Units| {
            let mesh = scaled(scattered(&mut Random::new(2), 4, cells), units.length);
            let run = run(&written.scene(SIDES, units), mesh, &options(ScalarKind::F32, None));
            let found = run.certified().expect("held");
            found.bound.total / found.combined
        };
        let expected = ratio(Units::ONE);
        for length in [1e-6, 1.0, 1e6] {
            for value in [1e-6, 1.0, 1e6] {
                let found = ratio(Units { length, value });
                UNITS.check_relative(
                    format_args!("{cells:?}, {length:e}, {value:e}"),
                    found,
                    expected,
                );
            }
        }
    }
}

//! The bound for u_h, which is another function than the s of the bound's total.

use signorini_scene::mesh::structured::Cells;
use signorini_solve::ScalarKind;

use super::run::{options, run};
use crate::mesh::regular;

/// u = x² + y² is an s on quads: the total sees none of what is wrong with u_h.
const PARABOLOID: &str = "
title = \"a paraboloid\"
mesh = \"none.msh\"
material.default.conductivity = \"1\"
source.f = \"-4\"
boundary.default = { kind = \"dirichlet\", value = \"x^2 + y^2\" }
boundary.contact = { kind = \"contact\", gap = \"x^2 - 1\", flux = \"0\" }
exact = { u = \"x^2 + y^2\", gradient = [\"2*x\", \"2*y\"] }
";

#[test]
fn u_h_may_be_further_off_than_s() {
    for n in [1, 2, 8] {
        let run = run(PARABOLOID, regular(n, Cells::Quads), &options(ScalarKind::F64, None));
        let found = run.certified().expect("held by Dirichlet edges");
        assert!(found.energy > found.bound.total, "n = {n}: {found:?}");
        assert!(found.energy <= found.bound.of_u, "n = {n}: {found:?}");
    }
}

//! Scenes that cannot be condensed are refused by name; data without a bound are told.

use super::*;
use signorini_problem::Approach;
use signorini_scene::mesh::structured::{Cells, grid};

fn refusal(text: &str) -> Result<String> {
    let (_, problem) = on_grid(text, grid(2, Cells::Triangles))?;
    Ok(condense(&problem).expect_err("not to be condensed").to_string())
}

fn reason(text: &str) -> Result<String> {
    let (_, problem) = on_grid(text, grid(2, Cells::Triangles))?;
    Ok(condense(&problem)?.certificate.expect_err("no bound"))
}

#[test]
fn a_load_that_changes_with_time() -> Result<()> {
    for (key, from, to) in [
        ("source.f", "f = \"-(1 + x*y)\"", "f = \"t\""),
        ("boundary.contact.gap", "gap = \"0.35 - 0.4*x^2 + 0.1*x^3\"", "gap = \"-0.05 - t\""),
        ("boundary.left.ambient", "ambient = \"y - 0.2\"", "ambient = \"y - 0.2 + 0*t\""),
    ] {
        assert!(refusal(&changed(ALL, &[(from, to)]))?.contains(key));
    }
    Ok(())
}

#[test]
fn a_part_that_nothing_holds() -> Result<()> {
    let text = "mesh = \"grid\"\nmaterial.default.conductivity = \"1\"\n\
                boundary.default = { kind = \"neumann\", flux = \"0\" }\n";
    assert!(refusal(text)?.contains("boundary"));
    Ok(())
}

/// Rounding need not tell: on quads the flux of a constant is no smaller than the others.
#[test]
fn a_part_that_a_single_edge_holds() -> Result<()> {
    let text = "mesh = \"grid\"\nmaterial.default.conductivity = \"1\"\n\
                boundary.contact = { kind = \"contact\", gap = \"0\" }\n\
                boundary.default = { kind = \"neumann\", flux = \"-1\" }\n";
    for cells in [Cells::Triangles, Cells::Quads, Cells::Mixed] {
        for one in 0..4 {
            let mut mesh = grid(2, cells);
            mesh.curves[0].edges = vec![mesh.curves[0].edges[one]];
            let (_, problem) = on_grid(text, mesh)?;
            let refusal = condense(&problem).expect_err("singular").to_string();
            assert!(refusal.contains("a single contact edge"), "{cells:?}: {refusal}");
        }
    }
    Ok(())
}

#[test]
fn more_fields_than_memory_holds() -> Result<()> {
    let (_, problem) = on_grid(ALL, grid(2, Cells::Triangles))?;
    Approach::Condensation.check(&problem)?;
    let (_, problem) = on_grid(ALL, grid(240, Cells::Quads))?;
    let refused = Approach::Condensation.check(&problem);
    let message = refused.expect_err("480 fields of 231 000 edges").to_string();
    assert!(message.contains("480 contact edges on a mesh of 231120 edges"), "{message}");
    Ok(())
}

#[test]
fn data_without_a_bound() -> Result<()> {
    let jumps = [
        ("value = \"0.3 + 0.1*sin(3*x)\"", "value = \"0.3\""),
        ("kind = \"neumann\", flux = \"0.5*y - 0.2\"", "kind = \"dirichlet\", value = \"1\""),
        ("of = \"right\", field = \"flux\"", "of = \"right\", field = \"value\""),
    ];
    let jump = changed(ALL, &jumps);
    assert!(reason(&jump)?.contains("jump"));
    let vanishing = ALL.replace("coefficient = \"2+y\"", "coefficient = \"y^4\"");
    assert!(reason(&vanishing)?.contains("transfer"));
    Ok(())
}

//! The condensed model and the full one give the same outputs.

use std::path::Path;

use super::*;
use signorini_problem::fixtures::distorted;
use signorini_scene::mesh;
use signorini_scene::mesh::structured::{Cells, grid};

#[test]
fn inputs_of_all_fields_on_all_cells() -> Result<()> {
    for cells in [Cells::Triangles, Cells::Quads, Cells::Mixed] {
        for mesh in [grid(5, cells), distorted(grid(4, cells))] {
            let (_, problem) = on_grid(ALL, mesh)?;
            let lengths = compare(&problem, 0.3, 6)?.lengths;
            assert!(lengths.iter().any(|length| (0.1..1.9).contains(length)), "{lengths:?}");
        }
    }
    Ok(())
}

#[test]
fn nonparametric_quads() -> Result<()> {
    let text = format!("{ALL}\n[setting]\nelement = \"nonparametric\"\n");
    let (_, problem) = on_grid(&text, distorted(grid(4, Cells::Quads)))?;
    compare(&problem, 0.3, 4).map(|_| ())
}

#[test]
fn a_varying_tensor_and_a_jump() -> Result<()> {
    let uniform = "material.default.conductivity = [\"2\", \"0.5\", \"1\"]";
    let halves = "material.left.conductivity = \"1000\"\n\
                  material.right.conductivity = [\"2+x\", \"0.5*y\", \"1\"]";
    let varying = changed(ALL, &[(uniform, halves)]);
    for cells in [Cells::Triangles, Cells::Quads] {
        let (_, problem) = on_grid(&varying, grid(4, cells))?;
        compare(&problem, 0.3, 4)?;
    }
    Ok(())
}

/// A scene without what contact alone has: the input of its gap, its force and its length.
pub(super) fn without_contact(text: &str) -> String {
    let of_contact = ["input.depth", "output.force", "output.length"];
    let is_left = |line: &&str| of_contact.iter().all(|name| !line.starts_with(name));
    text.lines().filter(is_left).flat_map(|line| [line, "\n"]).collect()
}

#[test]
fn without_contact_the_model_is_linear() -> Result<()> {
    let contact = "kind = \"contact\", gap = \"0.35 - 0.4*x^2 + 0.1*x^3\"";
    let linear = without_contact(&changed(ALL, &[(contact, "kind = \"neumann\"")]));
    let (_, problem) = on_grid(&linear, grid(4, Cells::Mixed))?;
    let condensate = condense(&problem)?;
    assert_eq!(condensate.contact, 0);
    compare(&problem, 0.5, 3)?;
    let bound = condensate.bound(&condensate.defaults, &[]).expect("a bound");
    assert!((0.5..2.0).contains(&(bound / condensate.energy_unit)), "{bound}");
    Ok(())
}

/// The scenes that come with the project, with inputs about as large as in use.
#[test]
fn the_standard_scenes() -> Result<()> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../meshes/scenes");
    for (name, amount) in
        [("levee", 0.4), ("slab", 5.0), ("strip", 0.2), ("membrane", 0.0), ("pit", 0.0)]
    {
        let scene = Scene::read(&folder.join(format!("{name}.toml")))?;
        let mesh = mesh::read(&scene.mesh.value)?;
        let problem = Problem::new(&scene, mesh)?;
        compare(&problem, amount, 2)?;
    }
    Ok(())
}

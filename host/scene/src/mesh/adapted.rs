//! The mesh that a scene's setting asks for: cells of one kind first, then refined.

use super::adaptive::refined;
use super::check::MOST_CELLS;
use super::cut::cut;
use super::pairing::paired;
use super::{Mesh, read};
use crate::error::{InputError, Result};
use crate::scene::Scene;
use crate::setting::CellKind;

/// The mesh of the scene's file, adapted to its setting.
///
/// # Errors
/// A file that is no mesh, or a refinement too fine.
pub fn of_scene(scene: &Scene) -> Result<Mesh> {
    let (setting, file) = (scene.setting.unwrap_or_default(), &scene.mesh.value);
    if !file.exists() {
        let error = scene.error(&scene.mesh, format!("there is no file {}", file.display()));
        return Err(error.hint("the path counts from the scene's folder").into());
    }
    adapted(read(file)?, setting.cells, setting.refine)
}

/// `mesh` with cells of this kind, then refined so many times.
///
/// # Errors
/// A refinement too fine, said before the first step.
pub fn adapted(mesh: Mesh, cells: Option<CellKind>, refine: u32) -> Result<Mesh> {
    let mut mesh = match cells {
        None => mesh,
        Some(CellKind::Triangles) => cut(&mesh),
        Some(CellKind::Quads) => paired(&mesh),
    };
    let finest = 4_usize.checked_pow(refine).and_then(|parts| parts.checked_mul(mesh.cells()));
    if finest.is_none_or(|cells| cells > MOST_CELLS) && refine > 0 {
        let message = format!(
            "setting.refine: {} cells, refined {refine} times, make more than {MOST_CELLS}",
            mesh.cells()
        );
        return Err(InputError::new(message).hint("refine less often").into());
    }
    for _ in 0..refine {
        mesh = refined(&mesh)?;
    }
    Ok(mesh)
}

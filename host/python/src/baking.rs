//! `signorini.bake`.

use pyo3::prelude::*;
use signorini_bake::Bakes;
use signorini_bake::choice::{Choice, Wanted};
use signorini_bake::emit::{Emitted, emit};
use signorini_bake::setting;
use signorini_problem::Problem;
use signorini_scene::error::Error;
use signorini_scene::setting::ModelKind;
use signorini_solve::ScalarKind;

use crate::error::raised;
use crate::posed::GivenScene;
use crate::words;
use crate::work::work;

/// The source of the module of a scene, and what was chosen as JSON.
#[pyfunction]
pub fn bake(
    py: Python<'_>,
    scene: GivenScene,
    scalar: Option<String>,
    model: Option<String>,
) -> PyResult<(String, String)> {
    let is_file = scene.is_file();
    let asked = words::scalar(scalar.as_deref())?;
    let model = words::model(model.as_deref())?;
    let found = work(py, move |_| {
        let posed = scene.read()?;
        let problem = posed.problem()?;
        match setting::scalar(&posed.scene, asked)? {
            ScalarKind::F32 => emitted::<f32>(&problem, model),
            ScalarKind::F64 => emitted::<f64>(&problem, model),
        }
    })?;
    let Emitted { source, chosen } = found.map_err(|error: Error| raised(py, error, is_file))?;
    // Numbers, names and flags: nothing here can fail.
    Ok((source, serde_json::to_string(&chosen).unwrap_or_default()))
}

fn emitted<R: Bakes>(problem: &Problem, model: Option<ModelKind>) -> Result<Emitted, Error> {
    let wanted = Wanted { model, is_compared: false, has_all_edges: false };
    Ok(emit(problem, &Choice::<R>::new(problem, wanted)?))
}

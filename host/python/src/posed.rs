//! A scene with its mesh, as Python hands them over.

use std::path::{Path, PathBuf};

use numpy::PyReadonlyArray2;
use pyo3::prelude::*;
use signorini_problem::Problem;
use signorini_scene::error::Result;
use signorini_scene::mesh::Mesh;
use signorini_scene::mesh::arrays::Arrays;
use signorini_scene::scene::Scene;
use signorini_session::tick::Moment;
use signorini_solve::adaptive::{MeshOfScene, mesh_for_scene, mesh_of_scene};

/// A scene: a file, or the text of one; another mesh file, or a mesh in arrays; inputs by name.
#[derive(FromPyObject)]
pub struct GivenScene {
    /// The file, or what stands for its name.
    path: PathBuf,
    /// The text, where there is no file.
    text: Option<String>,
    mesh_file: Option<PathBuf>,
    arrays: Option<Arrays32>,
    inputs: Vec<(String, f64)>,
}

/// Vertices, triangles, quads, named edges, named cells.
struct Arrays32(Arrays);

type Named2 = Vec<(String, Vec<[u32; 2]>)>;

/// The same as numpy has them.
type Given<'py> = (
    PyReadonlyArray2<'py, f64>,
    PyReadonlyArray2<'py, u32>,
    PyReadonlyArray2<'py, u32>,
    Vec<(String, PyReadonlyArray2<'py, u32>)>,
    Vec<(String, Vec<u32>)>,
);

impl<'py> FromPyObject<'_, 'py> for Arrays32 {
    type Error = PyErr;

    fn extract(of: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        let (points, triangles, quads, curves, surfaces): Given = of.extract()?;
        let curves: Named2 = curves
            .iter()
            .map(|(name, edges)| Ok((name.clone(), rows(edges)?)))
            .collect::<PyResult<_>>()?;
        Ok(Self(Arrays {
            points: rows(&points)?,
            triangles: rows(&triangles)?,
            quads: rows(&quads)?,
            curves,
            surfaces,
        }))
    }
}

/// The rows of an array, which lies in C's order.
fn rows<T: numpy::Element + Copy, const N: usize>(
    of: &PyReadonlyArray2<T>,
) -> PyResult<Vec<[T; N]>> {
    let (rows, []) = of.as_slice()?.as_chunks::<N>() else {
        return Err(pyo3::exceptions::PyValueError::new_err(format!(
            "expected rows of {N} numbers"
        )));
    };
    Ok(rows.to_vec())
}

/// A scene and where its mesh comes from.
pub struct PosedScene {
    /// The scene.
    pub scene: Scene,
    mesh: Option<Mesh>,
    /// Points of the arrays that have become vertices; empty where the mesh is a file's.
    pub origins: Vec<u32>,
    /// Inputs with values of the caller's.
    inputs: Vec<(usize, f64)>,
}

impl GivenScene {
    /// Whether the scene is a file.
    pub fn is_file(&self) -> bool {
        self.text.is_none()
    }

    /// The scene with these inputs.
    ///
    /// # Errors
    /// What is wrong with scene, mesh or inputs.
    pub fn read(self) -> Result<PosedScene> {
        let path: &Path = &self.path;
        let mut scene = match &self.text {
            None => Scene::read(path)?,
            Some(text) => Scene::parse(text, path)?,
        };
        if let Some(file) = self.mesh_file {
            scene.mesh.value = file;
        }
        let mut inputs = Vec::new();
        for (name, value) in &self.inputs {
            let at = scene.input_number(name)?;
            scene.check_input(at, *value)?;
            scene.inputs[at].default = *value;
            inputs.push((at, *value));
        }
        let (mesh, origins) = match self.arrays {
            None => (None, Vec::new()),
            Some(Arrays32(arrays)) => {
                scene.mesh.value = "the mesh that was given".into();
                arrays.mesh().map(|(mesh, origins)| (Some(mesh), origins))?
            }
        };
        Ok(PosedScene { scene, mesh, origins, inputs })
    }
}

impl PosedScene {
    /// Gives the inputs the values of a state, but for those of the caller.
    pub fn go_on_from(&mut self, last: &Moment) {
        for (at, value) in last.values().chain(self.inputs.iter().copied()) {
            self.scene.inputs[at].default = value;
        }
    }

    /// The mesh before the setting changes it.
    ///
    /// # Errors
    /// A file that is no mesh.
    pub fn own_mesh(&self) -> Result<Mesh> {
        match &self.mesh {
            Some(mesh) => Ok(mesh.clone()),
            None => signorini_scene::mesh::read(&self.scene.mesh.value),
        }
    }

    /// On the mesh that the setting asks for.
    ///
    /// # Errors
    /// A mesh that the scene does not fit.
    pub fn problem(&self) -> Result<Problem> {
        let MeshOfScene { mesh, .. } = match &self.mesh {
            Some(mesh) => mesh_for_scene(&self.scene, mesh.clone())?,
            None => mesh_of_scene(&self.scene)?,
        };
        Problem::new(&self.scene, mesh)
    }
}

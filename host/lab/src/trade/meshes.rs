//! The meshes of a study: the scene's own, refined, cut or paired.

use std::collections::HashMap;

use signorini_problem::Problem;
use signorini_scene::mesh::adapted::adapted;
use signorini_scene::setting::CellKind;
use signorini_scene::{Goal, Mesh, Result, Scene, Setting, mesh};
use signorini_solve::adaptive::{MOST_UNKNOWNS, Promised, Refining, promised_mesh};

/// Unknowns of the finest mesh that a study measures, if the scene's own has fewer.
const FINEST: usize = 16_000;
/// Refinements at most.
const LEVELS: u32 = 2;

/// How often the scene's mesh is refined at most.
pub(super) fn finest(problem: &Problem) -> u32 {
    let unknowns = problem.topology.counts.unknowns();
    (0..=LEVELS).rev().find(|level| unknowns << (2 * level) <= FINEST).unwrap_or(0)
}

/// The goal of a refined mesh, and the cells that it was brought to before.
type ErrorMesh = (Goal, Option<CellKind>);

/// The meshes of a study, each made once.
pub(super) struct Meshes {
    scene: Scene,
    pub own: Mesh,
    made: HashMap<(Option<CellKind>, u32), Problem>,
    /// The last one for an error in all inputs: settings in a row have the same.
    for_error: Option<(ErrorMesh, Problem)>,
}

impl Meshes {
    pub fn new(scene: &Scene) -> Result<Self> {
        let own = mesh::read(&scene.mesh.value)?;
        Ok(Self { scene: scene.clone(), own, made: HashMap::new(), for_error: None })
    }

    /// The kind of cells that the mesh is not yet made of, where it can be brought to them.
    pub fn other_cells(&self) -> Result<Option<CellKind>> {
        let kind =
            if self.own.triangles.is_empty() { CellKind::Triangles } else { CellKind::Quads };
        let other = adapted(self.own.clone(), Some(kind), 0)?;
        Ok((other.triangles.len() != self.own.triangles.len()).then_some(kind))
    }

    /// On the mesh that `setting` asks for, which may be refined until its error is small enough.
    pub fn of_setting(&mut self, setting: &Setting) -> Result<Problem> {
        let problem = match setting.error {
            Some(goal) => self.for_error(goal, setting.cells)?,
            None => self.problem(setting.cells, setting.refine)?,
        };
        Ok(problem.clone().with_setting(Some(*setting)))
    }

    fn for_error(&mut self, goal: Goal, cells: Option<CellKind>) -> Result<&Problem> {
        // A study's own settings stay small; a scene that asks for one error means it.
        let most_unknowns = if self.scene.setting.is_some() { MOST_UNKNOWNS } else { FINEST };
        let promised = Promised { goal, refining: Refining::Marked, most_unknowns };
        let wanted = (goal, cells);
        let known = self.for_error.take().filter(|(known, _)| *known == wanted);
        let made = match known {
            Some(known) => known,
            None => {
                let mesh = adapted(self.own.clone(), cells, 0)?;
                let (mesh, _) = promised_mesh(&self.scene, mesh, promised)?;
                (wanted, Problem::new(&self.scene, mesh)?)
            }
        };
        Ok(&self.for_error.insert(made).1)
    }

    pub fn problem(&mut self, cells: Option<CellKind>, level: u32) -> Result<&Problem> {
        if !self.made.contains_key(&(cells, level)) {
            let mesh = adapted(self.own.clone(), cells, level)?;
            self.made.insert((cells, level), Problem::new(&self.scene, mesh)?);
        }
        Ok(&self.made[&(cells, level)])
    }
}

//! The meshes of a study: the scene's own, refined, cut or paired.

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

/// A mesh: its cells where they are not the scene's, how often it is refined, and for which error.
type Wanted = (Option<CellKind>, u32, Option<Goal>);

/// The meshes of a study, each made once.
pub(super) struct Meshes {
    scene: Scene,
    pub own: Mesh,
    made: Vec<(Wanted, Problem)>,
}

impl Meshes {
    pub fn new(scene: &Scene) -> Result<Self> {
        let own = mesh::read(&scene.mesh.value)?;
        Ok(Self { scene: scene.clone(), own, made: Vec::new() })
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
        // One that is refined for an error begins as it is.
        let level = if setting.error.is_some() { 0 } else { setting.refine };
        let problem = self.made((setting.cells, level, setting.error))?;
        Ok(problem.clone().with_setting(Some(*setting)))
    }

    /// On the scene's own mesh.
    pub fn problem(&mut self) -> Result<&Problem> {
        self.made((None, 0, None))
    }

    fn made(&mut self, wanted: Wanted) -> Result<&Problem> {
        let known = self.made.iter().position(|(known, _)| *known == wanted);
        let at = match known {
            Some(at) => at,
            None => {
                let problem = Problem::new(&self.scene, self.mesh(wanted)?)?;
                self.made.push((wanted, problem));
                self.made.len() - 1
            }
        };
        Ok(&self.made[at].1)
    }

    fn mesh(&self, (cells, level, error): Wanted) -> Result<Mesh> {
        let mesh = adapted(self.own.clone(), cells, level)?;
        let Some(goal) = error else { return Ok(mesh) };
        // A study's own settings stay small; a scene that asks for one error means it.
        let most_unknowns = if self.scene.setting.is_some() { MOST_UNKNOWNS } else { FINEST };
        let promised = Promised { goal, refining: Refining::Marked, most_unknowns };
        Ok(promised_mesh(&self.scene, mesh, promised)?.0)
    }
}

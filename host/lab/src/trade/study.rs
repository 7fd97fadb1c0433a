//! The study of one scene: its files, its journal, what it is called; interrupted, it goes on where it was.

use std::path::{Path, PathBuf};

use super::journal::{Journal, digest, program};
use super::meshes::Meshes;
use super::shard::Shard;
use super::target::Target;
use crate::checkout::root;
use signorini_bake::module_api::ModuleApi;
use signorini_image::board::M4F;
use signorini_image::tools;
use signorini_problem::Problem;
use signorini_scene::scene::term::at_rest_warning;
use signorini_scene::setting::Precision;
use signorini_scene::{Error, Result, Scene};

/// A study: a scene, whose cost decides, where it goes, and which cases are this process's.
#[derive(Debug, Clone)]
pub struct Study {
    pub scene: Scene,
    pub name: String,
    pub target: Target,
    pub folder: PathBuf,
    /// Whether other solvers and micromath are studied too.
    pub with_peers: bool,
    /// A warning of what is left out where the scene depends on t.
    pub(super) at_rest: Option<String>,
}

impl Study {
    pub fn open(path: &Path, target: Target, folder: PathBuf, with_peers: bool) -> Result<Self> {
        if target.board().is_some() {
            // A board without the sources is no reason to leave a setting out, but all of them.
            root()?;
            tools::ensure(&[M4F.triple]).map_err(Error::Check)?;
        }
        let read = Scene::read(path)?;
        let at_rest = at_rest_warning(&read);
        let mut scene = read.at_rest();
        // What a scene declares of its device is no limit here.
        scene.target = scene.target.filter(|_| target != Target::Host);
        // On a board it is measured as it is baked: in f32 unless its setting says otherwise.
        if let (Some(_), Some(setting)) = (target.board(), &mut scene.setting) {
            setting.scalar.get_or_insert(Precision::F32);
        }
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        Ok(Self { scene, name, target, folder, with_peers, at_rest })
    }

    /// Warnings of data that may not be meant; none where the scene is wrong.
    pub(super) fn warnings(&self) -> Vec<String> {
        let problem =
            Meshes::new(&self.scene).and_then(|meshes| Problem::new(&self.scene, meshes.own));
        let warnings = problem.map(|problem| problem.warnings).unwrap_or_default();
        let named = |warning| format!("{}: {warning}", self.name);
        warnings.into_iter().chain(self.at_rest.clone()).map(named).collect()
    }

    /// Deletes what only an interrupted study needs.
    pub fn close(&self) -> Result<()> {
        self.journal(Shard::WHOLE, &mut Meshes::new(&self.scene)?)?.close()
    }

    /// Opens the journal of a shard: what it knows was measured of this scene and target, by this program.
    pub(super) fn journal(&self, shard: Shard, meshes: &mut Meshes) -> Result<Journal> {
        let hash = ModuleApi::new(meshes.problem()?).hash;
        let fingerprint = format!("{hash:016x} {} {}", self.target, program());
        // Each target has its own folder.
        let folder = self.folder.join(format!("unfinished-{}", self.target));
        Journal::open(&folder, shard, &fingerprint)
    }

    /// The name of a point's module: no other point has it, of this study or of one of the same scene elsewhere.
    pub(super) fn module(&self, point: &str) -> String {
        let folder = std::path::absolute(&self.folder).unwrap_or_else(|_| self.folder.clone());
        let whole = format!("{} {} {point}", folder.display(), self.target);
        format!("{}-{:016x}", self.name, digest(&whole))
    }

    /// Whether the scene has a setting of its own, and is measured in that alone.
    pub(super) fn is_alone(&self) -> bool {
        self.scene.setting.is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_setting_without_a_scalar_is_measured_as_it_is_baked() {
        let file = root().unwrap().join("tests/firmware/scenes/levee-plain.toml");
        let scalar = |target| {
            let study = Study::open(&file, target, "out/plain".into(), false).unwrap();
            study.scene.setting.unwrap().scalar
        };
        assert_eq!((scalar(Target::M4f), scalar(Target::Host)), (Some(Precision::F32), None));
    }

    #[test]
    fn every_point_of_a_board_has_a_module_of_its_own() {
        let file = root().unwrap().join("meshes/scenes/levee.toml");
        let study = |folder: &str| Study::open(&file, Target::M4f, folder.into(), false).unwrap();
        let names = [("out/levee", "one"), ("out/levee", "other"), ("elsewhere", "one")];
        let names = names.map(|(folder, point)| study(folder).module(point));
        assert!(names[0] != names[1] && names[0] != names[2] && names[0].starts_with("levee-"));
    }
}

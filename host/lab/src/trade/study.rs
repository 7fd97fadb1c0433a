//! The study of one scene: plan, truth, points, other solvers; interrupted, it goes on where it was.

use std::path::{Path, PathBuf};

use super::board::{self, Measured};
use super::front::{Wish, mark, recommend};
use super::journal::Journal;
use super::measured_setting::{Facts, MeasuredSetting, digest, once, overflow, program};
use super::meshes::{Meshes, finest};
use super::plan::{LARGEST_ON_BOARD, Plan, SceneFacts, TOO_LARGE};
use super::record::{FunctionCost, Recommendation, Skipped, Trade};
use super::reference::ReferenceSolution;
use super::shard::Shard;
use super::target::Target;
use super::{math, measure};
use crate::baseline;
use crate::baseline::record::Baseline;
use crate::checkout::root;
use crate::cycles::{NARROW, REGISTERS};
use signorini_bake::module_api::ModuleApi;
use signorini_problem::{Approach, Problem};
use signorini_scene::error::{Error, Result};
use signorini_scene::mesh::Mesh;
use signorini_scene::mesh::adapted::adapted;
use signorini_scene::scene::Scene;
use signorini_scene::scene::term::at_rest_warning;
use signorini_scene::setting::{ModelKind, Precision, Setting};
use signorini_solve::tuned_omega;

/// A study: a scene, whose cost decides, where it goes, and which cases are this process's.
#[derive(Debug, Clone)]
pub struct Study {
    /// The scene, its data at t = 0.
    pub scene: Scene,
    /// Its name.
    pub name: String,
    /// Whose cost decides.
    pub target: Target,
    /// The folder of its files.
    pub folder: PathBuf,
    /// Whether other solvers and micromath are studied too.
    pub with_peers: bool,
    /// What is left out where the scene depends on t.
    at_rest: Option<String>,
}

/// What of a study is known.
#[derive(Debug)]
pub enum StudyState {
    /// All of it.
    Whole(Box<Trade>),
    /// This process's cases; others have the rest.
    Part,
}

/// What a tuned ω brings the algebraic error down to, from a cold start.
const GOAL: f64 = 1e-3;

impl Study {
    /// Opens the scene at `path`.
    ///
    /// # Errors
    /// A scene that cannot be read; a board, and no checkout with its images.
    pub fn open(path: &Path, target: Target, folder: PathBuf, with_peers: bool) -> Result<Self> {
        if target.board().is_some() {
            // A board without the sources is no reason to leave a setting out, but all of them.
            root()?;
            board::ready()?;
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

    /// What of the scene may not be meant; none where it is wrong.
    pub(super) fn warnings(&self) -> Vec<String> {
        let problem =
            Meshes::new(&self.scene).and_then(|meshes| Problem::new(&self.scene, meshes.own));
        let warnings = problem.map(|problem| problem.warnings).unwrap_or_default();
        let named = |warning| format!("{}: {warning}", self.name);
        warnings.into_iter().chain(self.at_rest.clone()).map(named).collect()
    }

    /// Measures what no journal knows, and puts it together. Where cases are shared `by_scene`, all of this one are
    /// this process's. `done` hears of every case: how many there are, and what it was.
    ///
    /// # Errors
    /// Wrong input, files that cannot be written.
    pub fn run(
        &self,
        shard: Shard,
        by_scene: bool,
        wish: &Wish,
        done: &mut dyn FnMut(usize, &str),
    ) -> Result<StudyState> {
        let mut meshes = Meshes::new(&self.scene)?;
        let fingerprint = self.fingerprint(&mut meshes)?;
        let mut journal = Journal::open(&self.unfinished(), shard, &fingerprint)?;
        let plan = self.plan(&mut meshes, &mut journal)?;
        let mine = |case: usize| by_scene || shard.takes(case);
        let extras = if self.is_alone() || !self.with_peers { 0 } else { 2 };
        let all = plan.settings.len() + extras;
        let mut truth = None;
        let mut cases = Vec::new();
        for (at, setting) in plan.settings.iter().enumerate() {
            let case = self.case(setting, mine(at), &mut meshes, &mut truth, &mut journal)?;
            done(all, case.as_ref().map_or("", MeasuredSetting::name));
            cases.extend(case);
        }
        let (mut baselines, mut functions) = (Some((Vec::new(), Vec::new())), Some(Vec::new()));
        if extras > 0 {
            let problem = meshes.problem(None, 0)?;
            let solvers = || baseline::of_scene(problem);
            baselines = once(&mut journal, "baselines", mine(all - 2), solvers)?;
            done(all, "other solvers");
            let of_math = || math::of_scene(problem);
            functions = once(&mut journal, "math", mine(all - 1), of_math)?;
            done(all, "micromath");
        }
        if cases.is_empty() && plan.settings.is_empty() && shard.is_whole() {
            self.known_truth(&meshes, &mut truth, &mut journal)?;
        }
        let facts = journal.known::<Facts>("truth");
        let whole = (cases.len() == plan.settings.len(), facts, baselines, functions);
        let (true, Some(facts), Some(baselines), Some(functions)) = whole else {
            return Ok(StudyState::Part);
        };
        if !shard.is_whole() {
            return Ok(StudyState::Part);
        }
        let trade = self.together(plan.skipped, facts, cases, baselines, functions, wish);
        super::files::write(&self.folder, &self.scene, &trade)?;
        Ok(StudyState::Whole(Box::new(trade)))
    }

    /// Deletes what only an interrupted study needs.
    ///
    /// # Errors
    /// A journal that cannot be deleted.
    pub fn close(&self) -> Result<()> {
        let mut meshes = Meshes::new(&self.scene)?;
        let fingerprint = self.fingerprint(&mut meshes)?;
        Journal::open(&self.unfinished(), Shard::WHOLE, &fingerprint)?.close()?;
        // It stays where somebody else keeps something in it, such as a shard that still runs.
        let _ = std::fs::remove_dir(self.unfinished());
        Ok(())
    }

    /// The folder of the journals: each target has its own.
    fn unfinished(&self) -> PathBuf {
        self.folder.join(format!("unfinished-{}", self.target))
    }

    /// What the module of a point is called: none has that of another, of this study or of one of the same scene elsewhere.
    fn module(&self, point: &str) -> String {
        let folder = std::path::absolute(&self.folder).unwrap_or_else(|_| self.folder.clone());
        let whole = format!("{} {} {point}", folder.display(), self.target);
        format!("{}-{:016x}", self.name, digest(&whole))
    }

    /// A scene with a setting of its own is measured in that alone.
    fn is_alone(&self) -> bool {
        self.scene.setting.is_some()
    }

    fn fingerprint(&self, meshes: &mut Meshes) -> Result<String> {
        let hash = ModuleApi::new(meshes.problem(None, 0)?).hash();
        Ok(format!("{hash:016x} {} {}", self.target, program()))
    }

    fn plan(&self, meshes: &mut Meshes, journal: &mut Journal) -> Result<Plan> {
        if let Some(setting) = self.scene.setting {
            return Ok(Plan { settings: vec![setting], skipped: Vec::new() });
        }
        let other_cells = meshes.other_cells()?;
        let problem = meshes.problem(None, 0)?;
        let is_loose = Approach::Tick.lack(problem)?.is_some();
        let tuned = || match is_loose {
            true => Ok(None),
            false => tuned_omega(problem, Precision::F64, GOAL).map(Some),
        };
        let tuned: Option<f64> = once(journal, "tuned", true, tuned)?.flatten();
        Ok(Plan::new(&SceneFacts {
            target: self.target,
            other_cells,
            finest: finest(problem),
            has_inputs: !self.scene.inputs.is_empty(),
            uses_time: self.at_rest.is_some(),
            is_loose,
            unknowns: problem.topology.counts.unknowns(),
            tuned,
        }))
    }

    /// What is known of a setting, measured now where it is this process's; `None`: another has it.
    fn case(
        &self,
        setting: &Setting,
        mine: bool,
        meshes: &mut Meshes,
        truth: &mut Option<ReferenceSolution>,
        journal: &mut Journal,
    ) -> Result<Option<MeasuredSetting>> {
        let key = serde_json::to_string(setting).unwrap_or_default();
        if let Some(known) = journal.known(&key) {
            return Ok(Some(known));
        }
        if !mine {
            return Ok(None);
        }
        self.known_truth(meshes, truth, journal)?;
        let Some(truth) = truth else { return Ok(None) };
        let case = match self.measured(setting, meshes, truth) {
            Ok(case) => case,
            // What one setting does not allow for is no reason to leave the others.
            Err(Error::Input(error)) if !self.is_alone() => {
                MeasuredSetting::Left(error.message().to_owned())
            }
            Err(error) => return Err(error),
        };
        if journal.add(&key, &case).is_ok() {
            return Ok(Some(case));
        }
        let case = MeasuredSetting::Left("the numbers found overflow".to_owned());
        journal.add(&key, &case)?;
        Ok(Some(case))
    }

    /// Works out the truth, where that is not yet done, and keeps what the record says of it.
    fn known_truth(
        &self,
        meshes: &Meshes,
        truth: &mut Option<ReferenceSolution>,
        journal: &mut Journal,
    ) -> Result<()> {
        if truth.is_none() {
            let found = self.truth(meshes)?;
            let facts = Facts {
                words: found.words(),
                energy: found.energy(),
                force: found.force(),
                length: found.length(),
            };
            let kept = journal.add("truth", &facts);
            kept.map_err(|_| overflow(&self.scene))?;
            *truth = Some(found);
        }
        Ok(())
    }

    fn truth(&self, meshes: &Meshes) -> Result<ReferenceSolution> {
        let level = finest(&Problem::new(&self.scene, meshes.own.clone())?);
        let refined = |mesh: &Mesh, times| adapted(mesh.clone(), None, times);
        ReferenceSolution::new(&self.scene, &meshes.own, level, refined)
    }

    fn measured(
        &self,
        setting: &Setting,
        meshes: &mut Meshes,
        truth: &ReferenceSolution,
    ) -> Result<MeasuredSetting> {
        let problem = meshes.of_setting(setting)?;
        if self.is_too_large(setting, &problem) {
            return Ok(MeasuredSetting::Left(TOO_LARGE.to_owned()));
        }
        let mut point = measure::measure(&problem, truth)?;
        if let Some(board) = self.target.board() {
            match board::measure(&problem, &board, &self.module(&point.name))? {
                Measured::Runs(firmware) => {
                    point.instructions = Some(firmware.instructions_per_tick.median);
                    point.ram_bytes = Some(firmware.ram_bytes);
                    point.flash_bytes = Some(firmware.flash_bytes);
                }
                Measured::Impossible(reason) => return Ok(MeasuredSetting::Left(reason)),
            }
        }
        Ok(MeasuredSetting::Point(Box::new(point)))
    }

    /// A mesh refined for an error that only now tells how large it is.
    fn is_too_large(&self, setting: &Setting, problem: &Problem) -> bool {
        let on_board = self.target != Target::Host && !self.is_alone();
        let full = setting.error.is_some() && setting.model == Some(ModelKind::Full);
        on_board && full && problem.topology.counts.unknowns() > LARGEST_ON_BOARD
    }

    fn together(
        &self,
        mut skipped: Vec<Skipped>,
        facts: Facts,
        cases: Vec<MeasuredSetting>,
        (baselines, mut notes): (Vec<Baseline>, Vec<String>),
        math: Vec<FunctionCost>,
        wish: &Wish,
    ) -> Trade {
        let mut points = Vec::new();
        for case in cases {
            match case {
                MeasuredSetting::Point(point) => points.push(*point),
                MeasuredSetting::Left(reason) => {
                    match skipped.iter_mut().find(|known| known.reason == reason) {
                        Some(known) => known.count += 1,
                        None => skipped.push(Skipped { reason, count: 1 }),
                    }
                }
            }
        }
        mark(&mut points);
        notes.extend(NARROW.filter(|_| self.target == Target::Host).map(str::to_owned));
        let mut trade = Trade {
            scene: self.name.clone(),
            title: self.scene.title.clone(),
            target: self.target.to_string(),
            registers: REGISTERS.to_owned(),
            truth: facts.words,
            energy: facts.energy,
            force: facts.force,
            length: facts.length,
            points,
            skipped: skipped.iter().map(|skipped| skipped.count).sum(),
            skipped_reasons: skipped,
            baselines,
            notes,
            math,
            recommendation: Recommendation { text: String::new(), point: None },
        };
        trade.recommendation = recommend(&trade, wish);
        trade
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

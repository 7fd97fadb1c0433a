//! A study being run: what no journal knows is measured, and everything is put together.

use std::rc::Rc;

use super::board;
use super::front::{Wish, mark, recommend};
use super::journal::Journal;
use super::meshes::{Meshes, finest};
use super::plan::{LARGEST_ON_BOARD, Plan, SceneFacts, TOO_LARGE};
use super::record::{FunctionCost, Point, Recommendation, Skipped, Trade};
use super::reference::{Facts, ReferenceSolution};
use super::shard::Shard;
use super::study::Study;
use super::target::Target;
use super::{math, measure};
use crate::baseline::{self, Baseline};
use crate::cycles::{NARROW, REGISTERS};
use signorini_problem::{Approach, Problem};
use signorini_scene::setting::{ModelKind, Precision};
use signorini_scene::{Error, InputError, Result, Setting};
use signorini_solve::tuned_omega;

/// The algebraic error that a tuned ω reaches from a cold start.
const GOAL: f64 = 1e-3;

/// A setting measured, or why it could not be.
type Case = std::result::Result<Box<Point>, String>;

/// A study with what its process knows.
pub(super) struct Run<'s> {
    study: &'s Study,
    shard: Shard,
    /// Whether cases are shared by scene: then all of this one are this process's.
    by_scene: bool,
    meshes: Meshes,
    journal: Journal,
    truth: Option<Rc<ReferenceSolution>>,
}

impl Study {
    /// Measures what no journal knows, and puts it together; `None` where other processes have the rest. Where cases
    /// are shared `by_scene`, all of this one are this process's. `done` hears of every case: how many there are, and
    /// what it was.
    pub fn run(
        &self,
        shard: Shard,
        by_scene: bool,
        wish: &Wish,
        done: &mut dyn FnMut(usize, &str),
    ) -> Result<Option<Trade>> {
        let mut meshes = Meshes::new(&self.scene)?;
        let journal = self.journal(shard, &mut meshes)?;
        Run { study: self, shard, by_scene, meshes, journal, truth: None }.finish(wish, done)
    }
}

impl Run<'_> {
    fn finish(mut self, wish: &Wish, done: &mut dyn FnMut(usize, &str)) -> Result<Option<Trade>> {
        let Plan { settings, skipped } = self.plan()?;
        let has_extras = !self.study.is_alone() && self.study.with_peers;
        let all = settings.len() + if has_extras { 2 } else { 0 };
        let mut cases = Vec::new();
        for (at, setting) in settings.iter().enumerate() {
            let case = self.case(setting, self.is_mine(at))?;
            done(
                all,
                case.as_ref()
                    .map_or("", |case| case.as_ref().map_or_else(|why| why, |of| &of.name)),
            );
            cases.extend(case);
        }
        let (mut baselines, mut functions) = (Some((Vec::new(), Vec::new())), Some(Vec::new()));
        if has_extras {
            let [solvers, math] = [all - 2, all - 1].map(|at| self.is_mine(at));
            let (journal, problem) = (&mut self.journal, self.meshes.problem()?);
            baselines = journal.once("baselines", solvers, || baseline::of_scene(problem))?;
            done(all, "other solvers");
            functions = journal.once("math", math, || math::of_scene(problem))?;
            done(all, "micromath");
        }
        if settings.is_empty() && self.shard.is_whole() {
            self.find_truth()?;
        }
        let facts = self.journal.known::<Facts>("truth");
        let whole = self.shard.is_whole() && cases.len() == settings.len();
        let (true, Some(facts), Some(baselines), Some(functions)) =
            (whole, facts, baselines, functions)
        else {
            return Ok(None);
        };
        let mut trade = self.together(skipped, facts, cases, baselines, functions);
        trade.recommendation = recommend(&trade, wish);
        super::files::write(&self.study.folder, &self.study.scene, &trade)?;
        Ok(Some(trade))
    }

    fn is_mine(&self, case: usize) -> bool {
        self.by_scene || self.shard.takes(case)
    }

    fn plan(&mut self) -> Result<Plan> {
        let study = self.study;
        if let Some(setting) = study.scene.setting {
            return Ok(Plan { settings: vec![setting], skipped: Vec::new() });
        }
        let other_cells = self.meshes.other_cells()?;
        let problem = self.meshes.problem()?;
        let is_loose = Approach::Tick.lack(problem)?.is_some();
        let tuned = || match is_loose {
            true => Ok(None),
            false => tuned_omega(problem, Precision::F64, GOAL).map(Some),
        };
        let tuned: Option<f64> = self.journal.once("tuned", true, tuned)?.flatten();
        Ok(Plan::new(&SceneFacts {
            target: study.target,
            other_cells,
            finest: finest(problem),
            has_inputs: !study.scene.inputs.is_empty(),
            uses_time: study.at_rest.is_some(),
            is_loose,
            unknowns: problem.topology.counts.unknowns(),
            tuned,
        }))
    }

    /// Finds what is known of a setting, measured now where it is this process's; `None`: another has it.
    fn case(&mut self, setting: &Setting, mine: bool) -> Result<Option<Case>> {
        let key = serde_json::to_string(setting).unwrap_or_default();
        let known = self.journal.known(&key);
        if known.is_some() || !mine {
            return Ok(known);
        }
        let truth = self.find_truth()?;
        let case = match self.measured(setting, &truth) {
            // What one setting does not allow for is no reason to leave the others.
            Err(Error::Input(error)) if !self.study.is_alone() => Err(error.message().to_owned()),
            found => found?,
        };
        if self.journal.add(&key, &case).is_ok() {
            return Ok(Some(case));
        }
        let case = Err("the numbers found overflow".to_owned());
        self.journal.add(&key, &case)?;
        Ok(Some(case))
    }

    /// Works out the truth, where that is not yet done, and keeps what the record says of it.
    fn find_truth(&mut self) -> Result<Rc<ReferenceSolution>> {
        if let Some(known) = &self.truth {
            return Ok(known.clone());
        }
        let (scene, level) = (&self.study.scene, finest(self.meshes.problem()?));
        let found = Rc::new(ReferenceSolution::new(scene, &self.meshes.own, level)?);
        self.journal.add("truth", &found.facts).map_err(|_| {
            InputError::new("the energy or the contact force of the solution overflows")
                .file(&scene.path)
                .hint("scale the data so that they are neither tiny nor huge")
        })?;
        Ok(self.truth.insert(found).clone())
    }

    fn measured(&mut self, setting: &Setting, truth: &ReferenceSolution) -> Result<Case> {
        let problem = self.meshes.of_setting(setting)?;
        if is_too_large(self.study, setting, &problem) {
            return Ok(Err(TOO_LARGE.to_owned()));
        }
        let mut point = measure::measure(&problem, truth)?;
        if let Some(board) = self.study.target.board() {
            match board::measure(&problem, &board, &self.study.module(&point.name))? {
                Ok(firmware) => {
                    point.instructions = Some(firmware.instructions_per_tick.median);
                    point.ram_bytes = Some(firmware.ram_bytes);
                    point.flash_bytes = Some(firmware.flash_bytes);
                }
                Err(reason) => return Ok(Err(reason)),
            }
        }
        Ok(Ok(Box::new(point)))
    }

    /// Puts everything but the recommendation together.
    fn together(
        &self,
        mut skipped: Vec<Skipped>,
        facts: Facts,
        cases: Vec<Case>,
        (baselines, mut notes): (Vec<Baseline>, Vec<String>),
        math: Vec<FunctionCost>,
    ) -> Trade {
        let mut points = Vec::new();
        for case in cases {
            match case {
                Ok(point) => points.push(*point),
                Err(reason) => match skipped.iter_mut().find(|known| known.reason == reason) {
                    Some(known) => known.count += 1,
                    None => skipped.push(Skipped { reason, count: 1 }),
                },
            }
        }
        mark(&mut points);
        let Study { name, scene, target, .. } = self.study;
        notes.extend(NARROW.filter(|_| *target == Target::Host).map(str::to_owned));
        Trade {
            scene: name.clone(),
            title: scene.title.clone(),
            target: *target,
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
        }
    }
}

/// Whether a mesh refined for an error, whose size only now is known, is too large for a board.
fn is_too_large(study: &Study, setting: &Setting, problem: &Problem) -> bool {
    let on_board = study.target != Target::Host && !study.is_alone();
    let full = setting.error.is_some() && setting.model == Some(ModelKind::Full);
    on_board && full && problem.topology.counts.unknowns() > LARGEST_ON_BOARD
}

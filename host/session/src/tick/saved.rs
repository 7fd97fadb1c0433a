//! The state of a play after its last tick, as a file from which another play goes on bit for bit.
//!
//! A session is made for the data of one moment: units, forest, the least transfer coefficients. So the file has that moment, at which
//! the next play makes the same session, and then the numbers that ticks have left. JSON of the shortest digits restores f64, and
//! f32 in f64.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use signorini_bake::fingerprint::Fingerprint;
use signorini_certify::evolution::Evolution;
use signorini_problem::{Problem, State};
use signorini_scene::error::{Error, InputError, Result};
use signorini_scene::scene::Scene;
use signorini_scene::scene::units::Units;
use signorini_solve::ScalarKind;

use super::moments::Play;
use super::window_error::WindowError;
use crate::saved::{SavedSession, check_length};

/// The version of the file.
const VERSION: u32 = 1;

/// A moment with the values of all inputs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Moment {
    /// t
    pub time: f64,
    /// Values of the inputs, in the order of the scene.
    pub inputs: Vec<f64>,
}

impl Moment {
    /// That of `problem`.
    pub(super) fn of(problem: &Problem) -> Self {
        let inputs = problem.scene.inputs.iter().map(|input| input.default).collect();
        Self { time: problem.time, inputs }
    }

    /// Positions of the inputs with their values.
    pub fn values(&self) -> impl Iterator<Item = (usize, f64)> {
        self.inputs.iter().copied().enumerate()
    }

    fn check(&self, name: &str, scene: &Scene) -> Result<()> {
        check_length(&format!("{name}.inputs"), self.inputs.len(), scene.inputs.len())?;
        let refused = |(input, value): (usize, f64)| scene.inputs[input].refusal(value);
        match self.values().find_map(refused) {
            Some(why) => Err(InputError::new(format!("{name}.inputs: {why}")).into()),
            None => Ok(()),
        }
    }
}

/// What makes a state one of a scene, a mesh, a step and a scalar.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Origin {
    scene: String,
    mesh: String,
    step: Option<f64>,
    scalar: ScalarKind,
}

/// The state of a play.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Saved {
    version: u32,
    origin: Origin,
    /// The last moment.
    pub last: Moment,
    /// The moment that the session was made for.
    pub(super) begun: Moment,
    /// Units of all that follows.
    pub(super) units: Units,
    /// What the next step in time begins from.
    pub(super) state: Option<State>,
    /// The bound over time, where all steps had one.
    pub(super) evolution: Option<Evolution>,
    /// The sums of `window_error`, where it is known.
    #[serde(default)]
    pub(super) error: Option<[f64; 2]>,
    /// See [`Play::stated`].
    #[serde(default)]
    pub(super) stated: Option<[f64; 2]>,
    /// What the session carries; nothing before its first answer.
    pub(super) session: Option<SavedSession>,
    /// The file that it was read from.
    #[serde(skip)]
    path: PathBuf,
}

impl Saved {
    /// The state of a `play` of `given` in this scalar, whose session was made for the moment `begun`; `problem` stands at the last one.
    pub(super) fn after(
        play: Play,
        (given, scalar): (&Problem, ScalarKind),
        begun: Moment,
        problem: &mut Problem,
    ) -> Self {
        let (scene, mesh) = (of_scene(&given.scene), of_mesh(given));
        Self {
            version: VERSION,
            origin: Origin { scene, mesh, step: step(&given.scene), scalar },
            last: Moment::of(problem),
            begun,
            units: play.units,
            state: problem.loads.step.take().map(|step| step.begin),
            evolution: play.evolution.filter(Evolution::is_finite),
            error: WindowError::finite_sums(play.error.as_ref()),
            stated: play.stated,
            session: play.session.saved(),
            path: PathBuf::new(),
        }
    }

    /// Whether a file can hold its numbers.
    pub(super) fn is_finite(&self) -> bool {
        let of_state =
            self.state.iter().flat_map(|State { u, vertices, bubbles, openings, .. }| {
                u.iter().chain(vertices).chain(bubbles).chain(openings.as_flattened())
            });
        of_state.copied().all(f64::is_finite)
            && self.session.as_ref().is_none_or(SavedSession::is_finite)
    }

    /// The text of its file, a line for each part.
    ///
    /// # Errors
    /// None that is known of.
    pub fn text(&self) -> Result<String> {
        let failed = |error: serde_json::Error| Error::Check(format!("--save: {error}"));
        let serde_json::Value::Object(parts) = serde_json::to_value(self).map_err(failed)? else {
            return Err(Error::Check("--save: the state has no parts".to_owned()));
        };
        let lines: Vec<_> = parts.iter().map(|(name, part)| format!("{name:?}: {part}")).collect();
        Ok(format!("{{\n{}\n}}\n", lines.join(",\n")))
    }

    /// Reads the state in a file.
    ///
    /// # Errors
    /// A file that cannot be read, or is no state of this version; with the line.
    pub fn read(path: &Path) -> Result<Self> {
        #[derive(Deserialize)]
        struct Version {
            version: u32,
        }
        let unread = |error: std::io::Error| InputError::new(error.to_string()).file(path);
        let text = std::fs::read_to_string(path).map_err(|error| unread(error).hint(HINT))?;
        let broken = |error: serde_json::Error| {
            let message = format!("no state of ticks: {error}");
            InputError::new(message).file(path).line(error.line()).hint(HINT)
        };
        let Version { version } = serde_json::from_str(&text).map_err(broken)?;
        if version != VERSION {
            let message = format!("version: {version}, expected {VERSION}");
            return Err(InputError::new(message).file(path).hint(HINT).into());
        }
        let saved: Self = serde_json::from_str(&text).map_err(broken)?;
        Ok(Self { path: path.to_owned(), ..saved })
    }

    /// Refuses a state that is not one of this scene, its step and scalar.
    ///
    /// # Errors
    /// Such a state, with what differs.
    pub fn check_scene(&self, scene: &Scene, scalar: ScalarKind) -> Result<()> {
        let Origin { scene: text, step: length, scalar: own, .. } = &self.origin;
        let said = |step: Option<f64>| step.map_or("none".to_owned(), |step| step.to_string());
        let differs = if *text != of_scene(scene) {
            "scene: the state is one of another scene, or its text has changed".to_owned()
        } else if *length != step(scene) {
            format!(
                "step: the state is one of step {}, and not {}",
                said(*length),
                said(step(scene))
            )
        } else if *own != scalar {
            format!("scalar: the state is one in {own:?}, and not in {scalar:?}").to_lowercase()
        } else {
            self.last.check("last", scene).map_err(|error| self.blamed(error))?;
            return self.begun.check("begun", scene).map_err(|error| self.blamed(error));
        };
        Err(InputError::new(differs).file(&self.path).hint(HINT).into())
    }

    /// Refuses a state that is not one on the mesh of `problem`.
    pub(super) fn check_mesh(&self, problem: &Problem) -> Result<()> {
        let counts = problem.topology.counts;
        if self.origin.mesh != of_mesh(problem) {
            return Err(InputError::new("mesh: the state is one on another mesh")
                .hint(HINT)
                .into());
        }
        let Some(State { u, vertices, bubbles, openings, traces, .. }) = &self.state else {
            return match problem.scene.stores() {
                true => Err(InputError::new("state: missing").hint(HINT).into()),
                false => Ok(()),
            };
        };
        check_length("state.u", u.len(), counts.edges())?;
        check_length("state.vertices", vertices.len(), problem.mesh.vertices.len())?;
        check_length("state.bubbles", bubbles.len(), counts.edges())?;
        // A controller has them in its own state.
        let is_of_controller = matches!(self.session, Some(SavedSession::Controller { .. }));
        if !(is_of_controller && openings.is_empty()) {
            check_length("state.openings", openings.len(), counts.contact)?;
        }
        match traces.iter().find(|trace| trace.edge as usize >= counts.edges()) {
            Some(trace) => {
                let message = format!("state.traces: there is no edge {}", trace.edge);
                Err(InputError::new(message).hint(HINT).into())
            }
            None => Ok(()),
        }
    }

    /// An error of this state as one of its file.
    pub(super) fn blamed(&self, error: Error) -> Error {
        match error {
            Error::Input(error) if error.place().0.is_none() => error.file(&self.path).into(),
            error => error,
        }
    }
}

const HINT: &str =
    "name a file that `signorini tick --save` wrote for this scene, mesh, --step and --scalar";

fn step(scene: &Scene) -> Option<f64> {
    scene.time.as_ref().map(|time| time.step)
}

fn of_scene(scene: &Scene) -> String {
    let mut all = Fingerprint::default();
    all.take_scene(scene);
    format!("{:016x}", all.0)
}

fn of_mesh(problem: &Problem) -> String {
    let mut all = Fingerprint::default();
    all.take_mesh(&problem.mesh);
    format!("{:016x}", all.0)
}

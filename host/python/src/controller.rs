//! `signorini.Controller`: the model that firmware gets, on this machine.
//!
//! It lives on a thread of its own, to which calls come one after the other; any Python thread may make them.

use std::sync::Mutex;
use std::sync::PoisonError;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use signorini_bake::setting;
use signorini_problem::Problem;
use signorini_problem::functional::wanted;
use signorini_scene::error::{Error, Result};
use signorini_scene::scene::{Input, Scene};
use signorini_session::{Module, Session, with_module};
use signorini_solve::ScalarKind;

use crate::error::raised;
use crate::posed::GivenScene;
use crate::words;
use crate::work::work;

/// As large as that of a main thread: a controller may be.
const STACK: usize = 64 << 20;

/// A call, which sends its own answer.
type Call = Box<dyn FnOnce(&Problem, &mut dyn Session, &Module) + Send>;

/// What a tick came to: how it ended, outputs, how far each may be off and between which values it lies (∞ where nothing is
/// guaranteed), bound and its part of u, exchanges and sweeps, contact force and length.
type Told = (String, Vec<f64>, Known, Option<[f64; 2]>, u32, [f64; 2]);

/// The bounds of outputs that are known.
type Known = (Vec<f64>, Vec<[f64; 2]>);

/// The controller of a scene.
#[pyclass(module = "signorini._native", frozen)]
pub struct Controller {
    calls: Mutex<Sender<Call>>,
    /// Model, solver and scalar in a few words.
    #[pyo3(get)]
    name: String,
    #[pyo3(get)]
    scalar: &'static str,
    /// Name, default and range of each input.
    #[pyo3(get)]
    inputs: Vec<(String, f64, [f64; 2])>,
    #[pyo3(get)]
    outputs: Vec<String>,
    scene: Scene,
    is_file: bool,
}

#[pymethods]
impl Controller {
    #[new]
    fn new(py: Python<'_>, scene: GivenScene, scalar: Option<String>) -> PyResult<Self> {
        let is_file = scene.is_file();
        let asked = words::scalar(scalar.as_deref())?;
        let (send, calls) = channel();
        let found = work(py, move |_| {
            let posed = scene.read()?;
            let problem = posed.problem()?;
            let scalar = setting::scalar(&posed.scene, asked)?;
            let name = started(problem, asked, calls)?;
            Ok((posed.scene, name, scalar))
        })?;
        let (scene, name, scalar) = found.map_err(|error: Error| raised(py, error, is_file))?;
        let input = |of: &Input| (of.name.value.clone(), of.default, of.interval());
        Ok(Self {
            calls: Mutex::new(send),
            name,
            scalar: if scalar == ScalarKind::F32 { "f32" } else { "f64" },
            inputs: scene.inputs.iter().map(input).collect(),
            outputs: wanted(&scene).iter().map(|of| of.name.value.clone()).collect(),
            scene,
            is_file,
        })
    }

    fn tick(&self, py: Python<'_>, inputs: Vec<f64>) -> PyResult<Told> {
        let checked = || -> Result<()> {
            (0..).zip(&inputs).try_for_each(|(at, &value)| self.scene.check_input(at, value))
        };
        checked().map_err(|error| raised(py, error, self.is_file))?;
        let told =
            self.ask(py, move |problem, session, module| told(problem, session, module, &inputs))?;
        told.map_err(|error| raised(py, error, self.is_file))
    }

    fn reset(&self, py: Python<'_>) -> PyResult<()> {
        self.ask(py, |_, session, _| session.restart())
    }

    fn window(&self, py: Python<'_>) -> PyResult<Option<[f64; 2]>> {
        self.ask(py, |_, session, _| session.window())
    }

    fn state<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyBytes>>> {
        let state = self.ask(py, |_, session, _| session.state())?;
        Ok(state.map(|state| PyBytes::new(py, &state)))
    }

    fn restore(&self, py: Python<'_>, state: Vec<u8>) -> PyResult<()> {
        let told = self.ask(py, move |_, session, _| session.set_state(&state))?;
        told.map_err(|error| raised(py, error, self.is_file))
    }
}

impl Controller {
    /// Makes a call, and waits for its answer without the interpreter's lock.
    fn ask<T: Send + 'static>(
        &self,
        py: Python<'_>,
        answer: impl FnOnce(&Problem, &mut dyn Session, &Module) -> T + Send + 'static,
    ) -> PyResult<T> {
        let ended =
            || PyRuntimeError::new_err("the controller has ended: this is a fault of signorini");
        py.detach(|| {
            let (send, receive) = channel();
            let call: Call = Box::new(move |problem, session, module| {
                let _ = send.send(answer(problem, session, module));
            });
            self.calls.lock().unwrap_or_else(PoisonError::into_inner).send(call).ok()?;
            receive.recv().ok()
        })
        .ok_or_else(ended)
    }
}

/// Starts the thread of a controller; its name where it has begun.
fn started(problem: Problem, asked: Option<ScalarKind>, calls: Receiver<Call>) -> Result<String> {
    let (send, receive) = channel();
    let run = move || {
        let begun = send.clone();
        let lent = with_module(&problem, asked, |session, module| {
            let _ = begun.send(Ok(module.name.clone()));
            // Until nobody can make another one.
            calls.iter().for_each(|call| call(&problem, session, module));
            Ok(())
        });
        if let Err(error) = lent {
            let _ = send.send(Err(error));
        }
    };
    let thread = thread::Builder::new().stack_size(STACK).spawn(run);
    thread.map_err(|error| Error::Check(format!("no thread: {error}")))?;
    receive.recv().unwrap_or_else(|_| Err(Error::Check("the controller has not begun".to_owned())))
}

fn told(
    problem: &Problem,
    session: &mut dyn Session,
    module: &Module,
    inputs: &[f64],
) -> Result<Told> {
    session.tick(inputs)?;
    let problem = problem.with_inputs(inputs)?;
    let answer = session.answer(&problem)?;
    let plus_minus = module.plus_minus(answer.bound.as_ref());
    let plus_minus = plus_minus.into_iter().map(|by| by.unwrap_or(f64::INFINITY)).collect();
    let between = module.between(session, &answer.outputs, answer.bound.as_ref());
    let nothing = [f64::NEG_INFINITY, f64::INFINITY];
    let between = between.into_iter().map(|ends| ends.unwrap_or(nothing)).collect();
    let bound = answer.bound.map(|bound| [bound.total, bound.of_u]);
    let contact = [answer.contact_force, answer.contact_length];
    let ended = answer.status.name().to_owned();
    Ok((ended, answer.outputs, (plus_minus, between), bound, answer.sweeps, contact))
}

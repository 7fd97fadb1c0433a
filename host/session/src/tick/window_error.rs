//! The error that the bound over time is for, where the exact solution is known.
//!
//! ```text
//!   mean of ‖A^½∇(u − s)‖² + ∫_R h(u − s)²,    weights e^{−2θλ(t_n − t)},    s linear in a tick
//! ```
//! A tick holds f, fluxes, limits and ambients, and lets u_D and ψ go linearly: the exact solution of a scene is that of its ticks
//! only where the former have no t, and the latter are linear in it.

use super::ScheduledTick;
use signorini_certify::admissible::Admissible;
use signorini_certify::exact::in_energy;
use signorini_problem::Problem;
use signorini_problem::quadrature::gauss;
use signorini_scene::error::Result;
use signorini_scene::scene::{Condition, Datum, Exact, Scene};
use signorini_solve::{Solution, Start};

/// Points in a tick.
const POINTS: usize = 6;

/// Whether the exact solution of a scene is that of its ticks.
pub(super) fn has_window_error(scene: &Scene) -> bool {
    scene.stores() && scene.exact.is_some() && of_other_data(scene).is_none()
}

/// Why a scene that stores u and knows its exact solution has no `window_error`.
pub fn without_window_error(scene: &Scene) -> Option<String> {
    let key = of_other_data(scene).filter(|_| scene.stores())?;
    Some(format!(
        "no window_error: a step holds or interpolates {key}, so that [exact] is of other data"
    ))
}

/// The first datum for which the exact solution of a scene that stores u is not that of its ticks.
fn of_other_data(scene: &Scene) -> Option<String> {
    scene.exact.as_ref()?;
    let held = |datum: &Datum| datum.value.uses_time().then(|| datum.key.clone());
    let on_line = |datum: &Datum| {
        let at = |t: f64| datum.value.at_time(t);
        // Affine in t: the same second differences everywhere, 0.
        let is_affine = [[0.0, 0.5, 1.0], [0.0, 2.0, 4.0], [1.0, 1.25, 1.5]].iter().all(|times| {
            let values = times.map(at);
            [[0.1, 0.2], [-0.7, 0.3], [0.9, 0.8]].iter().all(|&[x, y]| {
                let [a, b, c] = [0, 1, 2].map(|k| values[k].eval(x, y, 0.0));
                (a - 2.0 * b + c).abs() <= 1e-12 * (a.abs() + b.abs() + c.abs())
            })
        });
        (!is_affine).then(|| datum.key.clone())
    };
    let of_boundary = |condition: &Condition| match condition {
        Condition::Dirichlet { value } => on_line(value),
        Condition::Neumann { flux } => held(flux),
        Condition::Robin { ambient, .. } => held(ambient),
        Condition::Contact { gap, flux, limit } => {
            on_line(gap).or_else(|| held(flux)).or_else(|| held(limit))
        }
    };
    held(&scene.source)
        .or_else(|| scene.boundaries.iter().find_map(|of| of_boundary(&of.condition)))
}

/// The error until now.
pub(super) struct WindowError {
    /// In the scene's units.
    problem: Problem,
    exact: Exact,
    /// 1/(2θλ)
    seconds: f64,
    integral: f64,
    weights: f64,
    /// s of the last tick.
    last: [Vec<f64>; 2],
}

impl WindowError {
    /// From the start; a steady one stood before it.
    pub(super) fn begin(
        Start { problem, solution, .. }: &Start,
        seconds: f64,
    ) -> Result<Option<Self>> {
        let scene = &problem.scene;
        let Some(exact) = scene.exact.clone().filter(|_| has_window_error(scene)) else {
            return Ok(None);
        };
        let last = [solution.certified.vertices.clone(), solution.certified.bubbles.clone()];
        let problem = problem.clone();
        let was_steady = scene.time.as_ref().is_some_and(|time| time.initial.is_none());
        let mut begun = Self { problem, exact, seconds, integral: 0.0, weights: 0.0, last };
        if was_steady {
            begun.integral = seconds * begun.square(solution, 1.0, begun.problem.time)?;
            begun.weights = seconds;
        }
        Ok(Some(begun))
    }

    /// Goes on from `sums` after the tick that has left `problem`, in the scene's units, and `s`, its vertices and bubbles.
    pub(super) fn resume(
        problem: &Problem,
        seconds: f64,
        [integral, weights]: [f64; 2],
        last: [Vec<f64>; 2],
    ) -> Option<Self> {
        let exact = problem.scene.exact.clone()?;
        Some(Self { problem: problem.clone(), exact, seconds, integral, weights, last })
    }

    /// What another run goes on from: the weighed integral of the error's square, and the weights.
    pub(super) fn finite_sums(of: Option<&Self>) -> Option<[f64; 2]> {
        let sums = of.map(|of| [of.integral, of.weights]);
        sums.filter(|sums| sums.iter().all(|sum| sum.is_finite()))
    }

    /// Goes on to the answer at `moment`, in the scene's units, and gives the error until then.
    pub(super) fn advance(&mut self, moment: &ScheduledTick, answer: &Solution) -> Result<f64> {
        let from = self.problem.time;
        let length = moment.time - from;
        moment.set(&mut self.problem)?;
        let seconds = self.seconds;
        let fading = |time: f64| (-time / seconds).exp();
        self.integral *= fading(length);
        self.weights = fading(length) * self.weights + seconds * (1.0 - fading(length));
        for [share, weight] in gauss(POINTS) {
            let square = self.square(answer, share, from + share * length)?;
            self.integral += weight * length * fading((1.0 - share) * length) * square;
        }
        self.problem.time = moment.time;
        self.last = [answer.certified.vertices.clone(), answer.certified.bubbles.clone()];
        Ok((self.integral / self.weights).sqrt())
    }

    /// The square of the error at time `t`, at which s is between the last one and that of `answer`.
    fn square(&mut self, answer: &Solution, share: f64, t: f64) -> Result<f64> {
        let now = answer.certified.admissible();
        let mix = |a: &[f64], b: &[f64]| -> Vec<f64> {
            a.iter().zip(b).map(|(a, b)| (1.0 - share) * a + share * b).collect()
        };
        let [vertices, bubbles] =
            [mix(&self.last[0], now.vertices), mix(&self.last[1], now.bubbles)];
        self.problem.time = t;
        let s = Admissible { vertices: &vertices, bubbles: &bubbles, ..now };
        in_energy(&self.exact, &self.problem, &s)
    }
}

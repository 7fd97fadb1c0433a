//! What is compiled here for each scalar, once, instead of in every crate that calls it.
//!
//! A generic function is compiled where its type is known. That of baking takes a minute, and six programs and their tests call it.

use signorini_problem::Problem;
use signorini_problem::scalar::Scalar;
use signorini_scene::error::Result;
use signorini_solve::adaptive::Promise;

use crate::choice::{self, Choice, Wanted};
use crate::emit::{self, Emitted};
use crate::intervals::{self, OutputIntervals};
use crate::{explain, promise};

/// A scalar that modules are baked in.
pub trait Bakes: Scalar {
    /// [`Choice::new`]
    ///
    /// # Errors
    /// Those of [`Choice::new`].
    fn choose(problem: &Problem, wanted: Wanted) -> Result<Choice<Self>>;

    /// [`emit::emit`]
    fn emit(problem: &Problem, choice: &Choice<Self>) -> Emitted;

    /// [`explain::explanation`]
    fn explain(problem: &Problem, choice: &Choice<Self>) -> String;

    /// [`intervals::of_choice`]
    fn intervals(problem: &Problem, choice: &Choice<Self>) -> OutputIntervals;

    /// [`promise::kept`]
    ///
    /// # Errors
    /// Those of [`promise::kept`].
    fn keep(problem: &Problem, wanted: Wanted, promise: &Promise) -> Result<(Choice<Self>, usize)>;
}

macro_rules! bakes {
    ($($scalar:ty),*) => {$(
        impl Bakes for $scalar {
            #[inline(never)]
            fn choose(problem: &Problem, wanted: Wanted) -> Result<Choice<Self>> {
                choice::choose(problem, wanted)
            }

            #[inline(never)]
            fn emit(problem: &Problem, choice: &Choice<Self>) -> Emitted {
                emit::module(problem, choice)
            }

            #[inline(never)]
            fn explain(problem: &Problem, choice: &Choice<Self>) -> String {
                explain::in_words(problem, choice)
            }

            #[inline(never)]
            fn intervals(problem: &Problem, choice: &Choice<Self>) -> OutputIntervals {
                intervals::guaranteed(problem, choice)
            }

            #[inline(never)]
            fn keep(
                problem: &Problem,
                wanted: Wanted,
                promise: &Promise,
            ) -> Result<(Choice<Self>, usize)> {
                promise::keep(problem, wanted, promise)
            }
        }
    )*};
}

bakes!(f32, f64);

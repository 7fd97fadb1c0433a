//! What is compiled here for each scalar, once, instead of in every crate that calls it.
//!
//! A generic function is compiled where its type is known. That of baking takes a minute, and six programs and their tests call it.

use signorini_condense::CondensedModel;
use signorini_kernel::report::Report;
use signorini_problem::Problem;
use signorini_problem::scalar::Scalar;
use signorini_scene::error::Result;
use signorini_solve::adaptive::Promise;

use crate::choice::{self, Choice, Wanted};
use crate::emit::{self, Emitted};
use crate::full::OnRows;
use crate::intervals::{self, OutputIntervals};
use crate::{condensed, explain, full, promise};

/// An outcome, or what the kernel says against it.
type Outcome<T> = std::result::Result<T, signorini_kernel::Error>;

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

    /// [`full::Baked::new`]
    ///
    /// # Errors
    /// Those of [`full::Baked::new`].
    fn bake_full(problem: &Problem) -> Result<full::Baked<Self>>;

    /// [`condensed::Baked::new`]
    ///
    /// # Errors
    /// Those of [`condensed::Baked::new`].
    fn bake_condensed(
        condensate: &CondensedModel,
        work: condensed::Work,
        certified: bool,
    ) -> Outcome<condensed::Baked<Self>>;

    /// A full model's controller before its first tick.
    fn on_rows<'b>(baked: &'b full::Baked<Self>) -> Box<dyn OnRows<Self> + 'b>;

    /// A condensed model's answer for these inputs.
    ///
    /// # Errors
    /// Those of [`condensed::Controller::tick`].
    fn answer(
        controller: &mut condensed::Controller<Self>,
        inputs: &[Self],
    ) -> Outcome<(Vec<Self>, Report<Self>)>;
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

            #[inline(never)]
            fn bake_full(problem: &Problem) -> Result<full::Baked<Self>> {
                full::Baked::bake(problem)
            }

            #[inline(never)]
            fn bake_condensed(
                condensate: &CondensedModel,
                work: condensed::Work,
                certified: bool,
            ) -> Outcome<condensed::Baked<Self>> {
                condensed::Baked::bake(condensate, work, certified)
            }

            #[inline(never)]
            fn on_rows<'b>(baked: &'b full::Baked<Self>) -> Box<dyn OnRows<Self> + 'b> {
                full::on_rows(baked)
            }

            #[inline(never)]
            fn answer(
                controller: &mut condensed::Controller<Self>,
                inputs: &[Self],
            ) -> Outcome<(Vec<Self>, Report<Self>)> {
                controller.answer(inputs)
            }
        }
    )*};
}

bakes!(f32, f64);

//! What is compiled here for each scalar, once, instead of in every crate that calls it.
//!
//! A generic function is compiled where its type is known. That of baking takes a minute, and six programs and their tests call it.

use signorini_condense::CondensedModel;
use signorini_device::tick::{Figures, Limits};
use signorini_kernel::report::Report;
use signorini_problem::Problem;
use signorini_problem::scalar::Scalar;
use signorini_scene::error::Result;
use signorini_solve::adaptive::Promise;

use crate::choice::{self, Choice, Wanted};
use crate::emit::{self, Emitted};
use crate::intervals::{self, OutputIntervals};
use crate::{condensed, explain, full, promise};

/// An outcome, or what the kernel says against it.
type Outcome<T> = std::result::Result<T, signorini_kernel::Error>;

/// All outputs of a tick in order, and its report.
type Answer<R, F = ()> = (Vec<R>, Report<R, F>);

/// The trait of these functions, each with the generic one that is compiled for it.
macro_rules! bakes {
    (@$scalar:ty; $(fn $own:ident($($given:ident: $type:ty),*) -> $found:ty = $generic:path;)*) => {
        impl Bakes for $scalar {
            $(
                #[inline(never)]
                fn $own($($given: $type),*) -> $found {
                    $generic($($given),*)
                }
            )*
        }
    };
    ($(
        $(#[$doc:meta])*
        fn $own:ident($($given:ident: $type:ty),*) -> $found:ty = $generic:path;
    )*) => {
        /// A scalar that modules are baked in.
        pub trait Bakes: Scalar {
            $(
                $(#[$doc])*
                fn $own($($given: $type),*) -> $found;
            )*
        }

        bakes!(@f32; $(fn $own($($given: $type),*) -> $found = $generic;)*);
        bakes!(@f64; $(fn $own($($given: $type),*) -> $found = $generic;)*);
    };
}

bakes! {
    /// [`Choice::new`]
    ///
    /// # Errors
    /// Those of [`Choice::new`].
    fn choose(problem: &Problem, wanted: Wanted) -> Result<Choice<Self>> = choice::choose;

    /// [`emit::emit`]
    fn emit(problem: &Problem, choice: &Choice<Self>) -> Emitted = emit::module;

    /// The page that `--explain` prints.
    fn explain(problem: &Problem, choice: &Choice<Self>) -> String = explain::in_words;

    /// Intervals of a chosen model.
    fn intervals(problem: &Problem, choice: &Choice<Self>) -> OutputIntervals
        = intervals::guaranteed;

    /// The model of `problem` that keeps `promise`, and with how many inputs it was ticked: the one that is chosen anyway, or the full
    /// one where a condensed one does not and none was asked for.
    ///
    /// # Errors
    /// As for [`Choice::new`] and [`promise::check`].
    fn keep(problem: &Problem, wanted: Wanted, promise: &Promise) -> Result<(Choice<Self>, usize)>
        = promise::keep;

    /// [`full::Baked::new`]
    ///
    /// # Errors
    /// Those of [`full::Baked::new`].
    fn bake_full(problem: &Problem) -> Result<full::Baked<Self>> = full::Baked::bake;

    /// [`condensed::Baked::new`]
    ///
    /// # Errors
    /// Those of [`condensed::Baked::new`].
    fn bake_condensed(
        model: &CondensedModel,
        work: condensed::Work,
        certified: bool
    ) -> Outcome<condensed::Baked<Self>> = condensed::Baked::bake;

    /// A full model's answer for these inputs, within these limits.
    ///
    /// # Errors
    /// Those of [`full::Controller::tick_within`].
    fn sweep(
        controller: &mut full::Controller<Self>,
        inputs: &[Self],
        limits: Limits<Self>
    ) -> Outcome<Answer<Self, Figures<Self>>> = full::Controller::sweep;

    /// A condensed model's answer for these inputs.
    ///
    /// # Errors
    /// Those of [`condensed::Controller::tick`].
    fn answer(
        controller: &mut condensed::Controller<Self>,
        inputs: &[Self]
    ) -> Outcome<Answer<Self>> = condensed::Controller::answer;
}

//! The guaranteed error bound, from a scene's text to the number in the summary.
//!
//! bound ≥ combined is the guarantee, bound = identity catches what is too large as well; both are
//! integrated from an exact solution by code that shares nothing with the kernel's bound.

mod catalogue;
mod nonparametric;
mod property;
mod run;
mod supports;

//! The condensed model on the target's arithmetic, from a scene's text to outputs and bound, against the
//! full model.

mod bound;
mod equality;
mod extremes;
mod ranges;
mod scenes;

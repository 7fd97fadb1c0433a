//! The steps of an expression in postfix order: operands, and operations on the topmost ones.

use super::operation::{Binary, Unary};

/// The most operands that may wait on the stack.
pub(super) const STACK: usize = 64;

/// One step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Step {
    Constant(f64),
    Variable(Variable),
    Unary(Unary),
    Binary(Binary),
}

/// A variable; the discriminant is its place in the point (x, y, t).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Variable {
    X = 0,
    Y = 1,
    T = 2,
}

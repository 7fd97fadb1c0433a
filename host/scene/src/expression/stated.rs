//! Expressions by their steps: their properties, and others that are made of them.

use super::Expression;
use super::elementary::Elementary;
use super::operation::Binary;
use super::program::Program;
use super::step::{Step, Variable};

impl Expression {
    /// The expression of x and y that it is at the time t.
    #[must_use]
    pub fn at_time(&self, t: f64) -> Self {
        self.with_program(self.program.at_time(t))
    }

    /// This times `factor`.
    #[must_use]
    pub fn times(&self, factor: f64) -> Self {
        let folded = self.program.folded * factor.abs();
        self.with_program(self.program.joined(Binary::Multiply, factor, folded))
    }

    /// This less `subtracted`.
    #[must_use]
    pub fn minus(&self, subtracted: f64) -> Self {
        let size = self.is_constant().map_or(0.0, f64::abs);
        let folded = self.program.folded + f64::EPSILON * size;
        self.with_program(self.program.joined(Binary::Subtract, subtracted, folded))
    }

    fn with_program(&self, program: Program) -> Self {
        Self { program, ..self.clone() }
    }

    /// Whether no operation of it has a kink, a jump or a pole anywhere: a polynomial, sines, exponentials.
    pub fn is_smooth(&self) -> bool {
        // The step before an operation is its last operand, where that is a constant.
        let steps = &self.program.steps;
        let before = std::iter::once(None).chain(steps.iter().map(Some));
        steps.iter().zip(before).all(|(step, before)| match (step, before) {
            (Step::Constant(_) | Step::Variable(_), _) => true,
            (Step::Unary(operation), _) => operation.is_smooth(),
            (Step::Binary(Binary::Divide), Some(Step::Constant(by))) => *by != 0.0,
            (Step::Binary(Binary::Power), Some(Step::Constant(of))) => {
                *of >= 0.0 && of.fract() == 0.0
            }
            (Step::Binary(operation), _) => operation.is_smooth(),
        })
    }

    /// How often a device calls `function` to evaluate this once.
    pub fn calls(&self, function: Elementary) -> usize {
        let calls = |step: &&Step| match step {
            Step::Unary(operation) => operation.elementary() == Some(function),
            Step::Binary(operation) => operation.elementary() == Some(function),
            Step::Constant(_) | Step::Variable(_) => false,
        };
        self.program.steps.iter().filter(calls).count()
    }

    /// Whether t occurs.
    pub fn uses_time(&self) -> bool {
        self.program.steps.contains(&Step::Variable(Variable::T))
    }
}

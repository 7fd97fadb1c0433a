//! An expression in postfix order, and the stack machine that runs it.
//!
//! `2*x + y` is `2 x * y +`: operands are pushed, an operation replaces the topmost one or two by
//! its result. The machine's stack has a fixed size, so running allocates nothing. What is said twice is computed once
//! ([`super::sharing`]).

use std::array::from_fn;

pub(super) use super::operation::Numbers;
use super::operation::{Binary, Unary};
use super::rounded::{Rounded, Roundings};
use super::sharing::{Order, orders};
use super::step::{STACK, Step, Variable};

/// Steps that leave one value.
///
/// Invariant: run from the first step, the stack never holds more than [`STACK`] values, each
/// operation finds its operands on it, and one value is left at the end.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Program {
    pub(super) steps: Vec<Step>,
    /// What the machine does for them.
    orders: Vec<Order>,
    /// Places of the stack that it needs for them.
    depth: usize,
    /// How far a constant may be off that was computed from others, at most.
    pub(super) folded: f64,
}

impl Program {
    fn new(steps: Vec<Step>, folded: f64) -> Self {
        let (orders, depth) = orders(&steps);
        Self { orders, depth, steps, folded }
    }

    pub fn constant(value: f64) -> Self {
        Self::new(vec![Step::Constant(value)], 0.0)
    }

    /// The value, if the program is a constant.
    pub fn value(&self) -> Option<f64> {
        match self.steps[..] {
            [Step::Constant(value)] => Some(value),
            _ => None,
        }
    }

    /// This program with t replaced by a number.
    pub fn at_time(&self, t: f64) -> Self {
        let mut builder = Builder { folded: self.folded, ..Builder::default() };
        for &step in &self.steps {
            let is_time = step == Step::Variable(Variable::T);
            builder.push(if is_time { Step::Constant(t) } else { step });
        }
        builder.finish()
    }

    /// This program joined with a number, by which a constant is off as `folded` says: the stack has room, since one value is all
    /// that is left on it.
    pub fn joined(&self, operation: Binary, number: f64, folded: f64) -> Self {
        match self.value() {
            Some(value) => Self { folded, ..Self::constant(operation.apply(value, number)) },
            None => {
                let last = [Step::Constant(number), Step::Binary(operation)];
                Self::new([&self.steps[..], &last].concat(), self.folded)
            }
        }
    }

    /// The result at x and y, and at a time that is a number.
    pub fn at<N: Numbers>(&self, numbers: &N, [x, y]: [N::Number; 2], t: f64) -> N::Number {
        self.run(numbers, [x, y, numbers.constant(t)])
    }

    /// The result at the point (x, y, t).
    pub fn run<N: Numbers>(&self, numbers: &N, at: [N::Number; 3]) -> N::Number {
        // Few programs need all of the stack, and to clear it would take longer than they.
        match self.depth {
            ..=SHALLOW => self.run_on(&mut [numbers.constant(0.0); SHALLOW], numbers, at),
            _ => self.run_on(&mut [numbers.constant(0.0); STACK], numbers, at),
        }
    }

    /// The result at the point (x, y, t), by a stack with room for it.
    fn run_on<N: Numbers>(
        &self,
        stack: &mut [N::Number],
        numbers: &N,
        at: [N::Number; 3],
    ) -> N::Number {
        let mut height = 0;
        for order in &self.orders {
            match *order {
                Order::Step(Step::Constant(value)) => {
                    stack[height] = numbers.constant(value);
                    height += 1;
                }
                Order::Step(Step::Variable(variable)) => {
                    stack[height] = at[variable as usize];
                    height += 1;
                }
                Order::Step(Step::Unary(operation)) => {
                    stack[height - 1] = numbers.unary(operation, stack[height - 1]);
                }
                Order::Step(Step::Binary(operation)) => {
                    height -= 1;
                    stack[height - 1] = numbers.binary(operation, stack[height - 1], stack[height]);
                }
                Order::Keep(place) => stack[place] = stack[height - 1],
                Order::Recall(place) => {
                    stack[height] = stack[place];
                    height += 1;
                }
            }
        }
        stack[0]
    }

    /// The results at many points; a coordinate −0.0 is read as 0.0.
    pub fn run_all(
        &self,
        numbers: &impl Numbers<Number = f64>,
        points: &[[f64; 2]],
        t: f64,
    ) -> Vec<f64> {
        let several = Several(numbers);
        let (mut stack, t) = (vec![several.constant(0.0); self.depth], several.constant(t));
        let mut values = Vec::with_capacity(points.len());
        for points in points.chunks(LANES) {
            // The last lanes may have no point of their own.
            let of = |lane: usize, k: usize| points[lane.min(points.len() - 1)][k] + 0.0;
            let [x, y] = [0, 1].map(|k| from_fn(|lane| numbers.constant(of(lane, k))));
            let found = self.run_on(&mut stack, &several, [x, y, t]);
            values.extend(found.into_iter().take(points.len()));
        }
        values
    }
}

/// Places of a stack that most programs have enough of.
const SHALLOW: usize = 8;

/// Points at once.
const LANES: usize = 16;

/// Numbers for many points at once: each step of a program is decoded once for all of them, and sums and products go
/// through vector units.
struct Several<'a, N>(&'a N);

impl<N: Numbers> Numbers for Several<'_, N> {
    type Number = [N::Number; LANES];

    fn constant(&self, value: f64) -> Self::Number {
        [self.0.constant(value); LANES]
    }

    #[inline]
    fn unary(&self, operation: Unary, a: Self::Number) -> Self::Number {
        a.map(|a| self.0.unary(operation, a))
    }

    #[inline]
    fn binary(&self, operation: Binary, a: Self::Number, b: Self::Number) -> Self::Number {
        from_fn(|lane| self.0.binary(operation, a[lane], b[lane]))
    }
}

/// A program under construction; what has constant operands is computed at once.
#[derive(Debug, Default)]
pub(super) struct Builder {
    steps: Vec<Step>,
    height: usize,
    folded: f64,
}

impl Builder {
    /// Adds a step; `None` if it is an operand and the stack is full.
    pub fn push(&mut self, step: Step) -> Option<()> {
        match step {
            Step::Constant(_) | Step::Variable(_) => self.height += 1,
            Step::Unary(_) => {}
            Step::Binary(_) => self.height -= 1,
        }
        let rounded = Roundings(self.folded);
        let number = |constant: f64| rounded.constant(constant);
        match (step, &mut self.steps[..]) {
            (Step::Unary(operation), [.., Step::Constant(a)]) => {
                let Rounded { value, off } = rounded.unary(operation, number(*a));
                (*a, self.folded) = (value, self.folded.max(off));
            }
            (Step::Binary(operation), [.., Step::Constant(a), Step::Constant(b)]) => {
                let Rounded { value, off } = rounded.binary(operation, number(*a), number(*b));
                (*a, self.folded) = (value, self.folded.max(off));
                self.steps.pop();
            }
            _ => self.steps.push(step),
        }
        (self.height <= STACK).then_some(())
    }

    pub fn finish(self) -> Program {
        Program::new(self.steps, self.folded)
    }
}

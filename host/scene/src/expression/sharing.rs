//! What an expression says twice is computed once: `(x-a)^2 + (x-a)*y` keeps x − a.
//!
//! ```text
//!   steps, postfix ─► nodes, equal ones being one ─► orders: steps, and beside them keep and recall
//! ```
//! The same operation on the same operands has the same value to the last bit, whatever the numbers are. Values are kept above all
//! operands that wait: those that there is no room for are computed anew.

use std::collections::HashMap;

use super::operation::{Binary, Unary};
use super::step::{STACK, Step, Variable};

/// What the stack machine does next.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Order {
    /// A step of the expression.
    Step(Step),
    /// Keeps the topmost value in this place of the stack.
    Keep(usize),
    /// Pushes the value that is kept there.
    Recall(usize),
}

/// A value of the expression: operands by their number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
enum Node {
    /// By its bits.
    Constant(u64),
    Variable(Variable),
    Unary(Unary, usize),
    Binary(Binary, [usize; 2]),
}

/// The distinct values of an expression.
#[derive(Default)]
struct Nodes {
    numbers: HashMap<Node, usize>,
    /// How many others each is an operand of.
    uses: Vec<u32>,
    waiting: Vec<usize>,
    highest: usize,
}

impl Nodes {
    /// The number of the value that a step leaves on the stack.
    fn after(&mut self, step: Step) -> usize {
        let mut operand = || self.waiting.pop().unwrap_or_default();
        let node = match step {
            Step::Constant(value) => Node::Constant(value.to_bits()),
            Step::Variable(variable) => Node::Variable(variable),
            Step::Unary(operation) => Node::Unary(operation, operand()),
            Step::Binary(operation) => {
                let b = operand();
                Node::Binary(operation, [operand(), b])
            }
        };
        let next = self.numbers.len();
        let number = *self.numbers.entry(node).or_insert(next);
        if number == next {
            self.uses.push(0);
            let operands = match node {
                Node::Constant(_) | Node::Variable(_) => &[][..],
                Node::Unary(_, a) => &[a],
                Node::Binary(_, both) => &both.clone(),
            };
            operands.iter().for_each(|&operand| self.uses[operand] += 1);
        }
        self.waiting.push(number);
        self.highest = self.highest.max(self.waiting.len());
        number
    }
}

/// The orders that leave what `steps` do, and the places of the stack that they need.
pub(super) fn orders(steps: &[Step]) -> (Vec<Order>, usize) {
    let mut nodes = Nodes::default();
    let numbers: Vec<usize> = steps.iter().map(|&step| nodes.after(step)).collect();
    // An operation needs its operands, and what it leaves.
    let mut depth = nodes.highest;
    let mut kept = vec![None; nodes.uses.len()];
    let (mut orders, mut begins) = (Vec::with_capacity(steps.len()), Vec::new());
    for (&step, number) in steps.iter().zip(numbers) {
        let begin = match step {
            Step::Constant(_) | Step::Variable(_) => {
                begins.push(orders.len());
                orders.push(Order::Step(step));
                continue;
            }
            Step::Unary(_) => begins.pop(),
            Step::Binary(_) => begins.pop().and_then(|_| begins.pop()),
        };
        let begin = begin.unwrap_or_default();
        begins.push(begin);
        if let Some(place) = kept[number] {
            orders.truncate(begin);
            orders.push(Order::Recall(place));
            continue;
        }
        orders.push(Order::Step(step));
        if nodes.uses[number] > 1 && depth < STACK {
            kept[number] = Some(depth);
            orders.push(Order::Keep(depth));
            depth += 1;
        }
    }
    (orders, depth)
}

#[cfg(test)]
mod tests {
    use super::super::tests::expression;
    use super::*;

    fn count(text: &str) -> [usize; 3] {
        let (orders, _) = orders(&expression(text).program.steps);
        let of = |is: fn(&Order) -> bool| orders.iter().filter(|order| is(order)).count();
        [
            of(|order| matches!(order, Order::Step(_))),
            of(|order| matches!(order, Order::Keep(_))),
            of(|order| matches!(order, Order::Recall(_))),
        ]
    }

    #[test]
    fn what_is_said_twice_is_kept() {
        assert_eq!(count("x*y + 1"), [5, 0, 0]);
        assert_eq!(count("sin(x-t)^2 + (x-t)*y"), [9, 1, 1]);
        // Within what is kept as a whole nothing else is: it occurs nowhere else.
        assert_eq!(count("sin(cos(x)) * sin(cos(x)) - sin(cos(x))"), [5, 1, 2]);
        // Other operands, other order.
        assert_eq!(count("(x-y) + (y-x)"), [7, 0, 0]);
    }

    #[test]
    fn there_is_room_for_some_of_many() {
        let term = |n: u32| format!("sin({n}*x)");
        let sum = |by: &str| (2..90).map(term).collect::<Vec<_>>().join(by);
        let text = format!("{} + ({})", sum("+"), sum("-"));
        let [_, kept, recalled] = count(&text);
        assert!(kept == recalled && kept > STACK / 2 && kept < STACK, "{kept} {recalled}");
        let x = 0.37_f64;
        let terms = || (2..90).map(|n| (f64::from(n) * x).sin());
        let (first, plus) = (terms().next().unwrap_or_default(), terms().skip(1));
        let expected = plus.clone().fold(first, |a, b| a + b) + plus.fold(first, |a, b| a - b);
        assert_eq!(expression(&text).eval(x, 0.0, 0.0), expected);
    }

    #[test]
    fn a_long_sum_is_no_deep_one() {
        let text = vec!["x"; 2000].join("+");
        assert_eq!(expression(&text).eval(2.0, 0.0, 0.0), 4e3);
    }
}

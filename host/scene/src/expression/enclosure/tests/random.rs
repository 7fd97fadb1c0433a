//! Random expressions, regions and points.

use super::super::super::operation::{FUNCTIONS, Function};
use super::super::super::{Expression, Variables};
use super::super::Region;

/// xorshift
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub fn below(&mut self, count: usize) -> usize {
        (self.next() * count as f64) as usize
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    /// A tree of all operations.
    fn tree(&mut self, depth: u32) -> String {
        if depth == 0 || self.next() < 0.15 {
            let number = format!("{:.2}", self.between(-3.0, 3.0));
            let leaves = ["x", "y", "x", "y", "t", "2", "3", "0.5", &number];
            return format!("({})", leaves[self.below(leaves.len())]);
        }
        let a = self.tree(depth - 1);
        if self.next() < 0.5 {
            let symbol = ["+", "-", "*", "/", "^", "^2", "^3", "^-1"][self.below(8)];
            let b = if symbol.len() == 1 { self.tree(depth - 1) } else { String::new() };
            return format!("({a}{symbol}{b})");
        }
        match FUNCTIONS[self.below(FUNCTIONS.len())] {
            (name, Function::One(_)) => format!("{name}({a})"),
            (name, _) => format!("{name}({a}, {})", self.tree(depth - 1)),
        }
    }

    pub fn expression(&mut self) -> Expression {
        loop {
            let text = self.tree(4);
            if let Ok(found) = Expression::parse(&text, Variables::SpaceTime) {
                return found;
            }
        }
    }

    /// A region of any kind; half of them have a corner on a grid, where data like to have their kinks.
    pub fn region(&mut self) -> Region {
        let size = 10.0_f64.powf(self.between(-3.0, 0.5));
        let [mut x, mut y] = [self.between(-2.0, 2.0), self.between(-2.0, 2.0)];
        if self.next() < 0.5 {
            [x, y] = [0.5 * (2.0 * x).round(), 0.5 * (2.0 * y).round()];
        }
        let mut off = || if self.next() < 0.3 { 0.0 } else { 0.4 * size * (self.next() - 0.5) };
        let corner = |p: f64, q: f64, off: &mut dyn FnMut() -> f64| {
            [x + p * size + off(), y + q * size + off()]
        };
        let a = [x, y];
        let [b, c, d] = [[1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[p, q]| corner(p, q, &mut off));
        let whole = match self.below(3) {
            0 => Region::segment([a, b]),
            1 => Region::triangle([a, b, c]),
            _ => Region::quad([a, b, c, d]),
        };
        let parts = whole.parts();
        if self.next() < 0.5 { whole } else { parts[self.below(parts.len())] }
    }

    /// Reference coordinates inside a region.
    pub fn point(&mut self, region: &Region) -> [f64; 2] {
        let [a, b] = [self.next(), self.next()];
        match region.corners().len() {
            2 => [2.0 * a - 1.0, 0.0],
            3 if a + b > 1.0 => [2.0 / 3.0 - a, 2.0 / 3.0 - b],
            3 => [a - 1.0 / 3.0, b - 1.0 / 3.0],
            _ => [2.0 * a - 1.0, 2.0 * b - 1.0],
        }
    }
}

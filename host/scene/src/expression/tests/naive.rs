//! Random texts against a naive twin.

use proptest::prelude::*;

use super::{T, X, Y, parse};

/// The grammar of the module page, read by recursive descent and evaluated on the way.
struct Naive<'a>(&'a [u8]);

impl Naive<'_> {
    fn take(&mut self, symbol: u8) -> bool {
        let found = self.0.first() == Some(&symbol);
        if found {
            self.0 = &self.0[1..];
        }
        found
    }

    fn sum(&mut self) -> f64 {
        let mut value = self.product();
        loop {
            if self.take(b'+') {
                value += self.product();
            } else if self.take(b'-') {
                value -= self.product();
            } else {
                return value;
            }
        }
    }

    fn product(&mut self) -> f64 {
        let mut value = self.signed();
        loop {
            if self.take(b'*') {
                value *= self.signed();
            } else if self.take(b'/') {
                value /= self.signed();
            } else {
                return value;
            }
        }
    }

    fn signed(&mut self) -> f64 {
        if self.take(b'-') {
            return -self.signed();
        }
        let base = self.operand();
        if self.take(b'^') { base.powf(self.signed()) } else { base }
    }

    fn operand(&mut self) -> f64 {
        let first = self.0[0];
        self.0 = &self.0[1..];
        match first {
            b'x' => X,
            b'y' => Y,
            b'(' => {
                let value = self.sum();
                assert!(self.take(b')'));
                value
            }
            digit => f64::from(digit - b'0'),
        }
    }
}

/// Well-formed texts of digits, x, y, signs, operators and parentheses.
fn well_formed() -> impl Strategy<Value = String> {
    let leaf = prop_oneof![Just("x"), Just("y"), Just("2"), Just("3"), Just("7")];
    leaf.prop_map(str::to_owned).prop_recursive(6, 40, 2, |inner| {
        let symbol = prop_oneof![Just("+"), Just("-"), Just("*"), Just("/"), Just("^")];
        prop_oneof![
            3 => (inner.clone(), symbol, inner.clone()).prop_map(|(a, o, b)| format!("{a}{o}{b}")),
            1 => inner.clone().prop_map(|a| format!("({a})")),
            1 => inner.prop_map(|a| format!("-{a}")),
        ]
    })
}

/// Texts that say the same twice, at different depths.
fn repeating() -> impl Strategy<Value = String> {
    (well_formed(), well_formed())
        .prop_map(|(a, b)| format!("(({a})*({b})-({a}))/(({b})+x*({a}))+({a})*({b})"))
}

proptest! {
    #[test]
    fn agrees_with_recursive_descent(text in prop_oneof![well_formed(), repeating()]) {
        let mut naive = Naive(text.as_bytes());
        let expected = naive.sum();
        prop_assert!(naive.0.is_empty());
        match parse(&text) {
            Ok(expression) => {
                let value = expression.eval(X, Y, T);
                prop_assert!(value == expected || value.is_nan() && expected.is_nan(), "{value} {expected}");
            }
            Err(error) => prop_assert!(
                error.message.starts_with("its value is") && !expected.is_finite(),
                "{error}"
            ),
        }
    }

    #[test]
    fn any_text_is_read_or_refused_with_a_valid_span(text in "[-+*/^(),.xyt0-9e×é ²a-z\\PC]{0,40}") {
        if let Err(error) = parse(&text) {
            prop_assert!(text.get(error.span).is_some());
        }
    }
}

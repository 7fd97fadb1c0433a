//! Expressions: read, evaluated in every arithmetic, differentiated.

use std::str;

use signorini_scene::expression::{Arithmetic, Elementary, Expression, ParseError, Variables};

use super::bytes::Bytes;

/// A byte that chooses variables and arithmetic, the point (x, y, t), then the text.
pub fn expression(data: &[u8]) {
    let mut bytes = Bytes::new(data);
    let choice = bytes.byte();
    let at = [(); 3].map(|()| bytes.real::<f64>());
    let Ok(text) = str::from_utf8(bytes.rest()) else { return };
    let variables = if choice & 1 == 0 { Variables::Space } else { Variables::SpaceTime };
    match Expression::parse(text, variables) {
        Ok(expression) => accepted(&expression, text, variables, at, choice >> 1),
        Err(error) => refused(text, &error),
    }
}

/// The message points into the text and is no longer than what it speaks of.
fn refused(text: &str, error: &ParseError) {
    let ParseError { message, span, .. } = error;
    assert!(text.get(span.clone()).is_some(), "{span:?} of {text:?}");
    assert!(!message.is_empty() && message.len() < text.len() + 200, "{message}");
}

fn accepted(
    expression: &Expression,
    text: &str,
    variables: Variables,
    [x, y, t]: [f64; 3],
    arithmetic: u8,
) {
    assert_eq!(expression.to_string(), text);
    let value = expression.eval(x, y, t);
    if let Some(constant) = expression.is_constant() {
        assert!(constant.is_finite() && constant == value, "{constant} {value}");
    }
    assert!(!(variables == Variables::Space && expression.uses_time()));
    let (same, gradient) = expression.gradient(x, y, t);
    assert!(alike(same, value), "{same} beside the gradient, else {value}");
    // What does not change has no derivative, not even an undefined one.
    assert!(expression.is_constant().is_none() || gradient == [0.0; 2]);
    let frozen = expression.at_time(t);
    assert!(!frozen.uses_time() && alike(frozen.eval(x, y, 0.0), value));
    let single = expression.with_arithmetic(Arithmetic::Single).eval(x, y, t);
    let is_constant = expression.is_constant().is_some();
    assert!(is_constant || alike(f64::from(single as f32), single), "{single}");
    let function = Elementary::ALL[usize::from(arithmetic) % Elementary::ALL.len()];
    let fast = expression.with_arithmetic(Arithmetic::Fast(function)).eval(x, y, t);
    assert!(expression.calls(function) > 0 || alike(fast, value), "{fast} {value}");
}

/// Whether both are one number, or neither is one.
fn alike(a: f64, b: f64) -> bool {
    a == b || a.is_nan() && b.is_nan()
}

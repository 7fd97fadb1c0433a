//! The look of the rewritten text.

use std::ops::Range;

use super::*;
use crate::mutant::SourcePosition;

/// The mutant of what stands between columns of the first line.
fn mutant(id: u32, genre: &str, columns: Range<usize>, replacement: &str) -> Mutant {
    let place = |column| SourcePosition { line: 1, column };
    let span = Span { start: place(columns.start), end: place(columns.end) };
    let (genre, replacement) = (genre.to_owned(), replacement.to_owned());
    Mutant { file: String::new(), span, replacement, genre, name: String::new(), id }
}

/// The rewritten text without marks and doubled blanks.
fn switched(text: &str, mutants: &[Mutant]) -> String {
    let switched = switch(text, &mutants.iter().collect::<Vec<_>>(), &BTreeSet::new()).unwrap();
    assert!(switched.without.is_empty(), "{:?}", switched.without);
    let parts = switched.text.split("/*").map(|part| part.split_once("*/").map_or(part, |p| p.1));
    let bare: String = parts.collect();
    bare.replace("crate::mutants::", "").split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn operators_nest() {
    let mutants =
        [mutant(7, "BinaryOperator", 14..15, "*"), mutant(8, "BinaryOperator", 18..19, "+")];
    assert_eq!(switched("fn f() { 1.0 + x - y }", &[]), "fn f() { 1.0 + x - y }");
    assert_eq!(
        switched("fn f() { 1.0 + x - y }", &mutants),
        "fn f() { ({ let (l, r) = (({ let (l, r) = (1.0 , x); if on(7) { l * r } else { l + r } }) \
         , y); if on(8) { l + r } else { l - r } }) }"
    );
}

#[test]
fn a_body_a_sign_and_a_sum() {
    assert_eq!(
        switched("fn f() { -x }", &[mutant(3, "UnaryOperator", 10..11, "")]),
        "fn f() { ({ let l = x; if on(3) { l } else { -l } }) }"
    );
    assert_eq!(
        switched("fn f() { g() }", &[mutant(4, "FnValue", 10..13, "None")]),
        "fn f() { if on(4) { return None; } g() }"
    );
    assert_eq!(
        switched("fn f() { x += y; }", &[mutant(5, "BinaryOperator", 12..14, "-=")]),
        "fn f() { ({ let r = y; let l = &mut x; if on(5) { *l -= r } else { *l += r } }); }"
    );
    assert_eq!(
        switched("fn f() { a && b }", &[mutant(6, "BinaryOperator", 12..14, "||")]),
        "fn f() { ({ match (a , on(6)) { (true, false) | (false, true) => b, (l, _) => l } }) }"
    );
}

#[test]
fn chains_that_bind_cannot_become_alternatives() {
    let mutant = mutant(6, "BinaryOperator", 15..17, "||");
    let switched = switch("fn f() { if a && let b = c {} }", &[&mutant], &BTreeSet::new()).unwrap();
    assert_eq!((switched.without.len(), switched.barred), (0, BTreeSet::from([6])));
}

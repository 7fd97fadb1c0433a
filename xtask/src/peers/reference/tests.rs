//! Problems of two edges, solved by hand.

use super::*;

const HEADER: &str = "#define N 2 /* edges */\n#define M 1\n\
    static const float S[N*N] = {1.0f, -0.5f,\n -0.5f, 1.0f};\n\
    static const float B[M*N] = {1.0f, -2.0f,};\n";

#[test]
fn one_edge_opens_and_one_stays() {
    let problem = Problem::parse(HEADER).unwrap();
    // x = (1, 0) and S x − b = (0, 1.5); without contact the second would be −2.
    assert_eq!(problem.solve(&[1.0, -2.0], &mut [Side::Above; 2]), Ok(vec![1.0, 0.0]));
    let right = deviation(&problem, [[1.0_f32, 0.0].as_slice()].into_iter());
    assert_eq!(right, Ok(Deviation { error: 0.0, violation: 0.0 }));
    let wrong = deviation(&problem, [[0.75_f32, -0.25].as_slice()].into_iter());
    assert_eq!(wrong, Ok(Deviation { error: 0.25, violation: 0.25 }));
}

#[test]
fn both_edges_open() {
    let problem = Problem::parse(HEADER).unwrap();
    let x = problem.solve(&[1.0, 1.0], &mut [Side::Touching; 2]).unwrap();
    // Two divisions, each rounded once.
    assert!(x.iter().all(|x| (x - 2.0).abs() <= 2.0 * f64::EPSILON), "{x:?}");
}

/// S = (1, −½; −½, 1), m = (½, ∞).
fn limited() -> Problem {
    let spans = "static const float SPANS[M*N] = {0.5f, INFINITY};\n";
    Problem::parse(&format!("{HEADER}{spans}")).unwrap()
}

#[test]
fn edges_are_open_touching_and_at_their_limit() {
    let problem = limited();
    assert!(problem.is_limited());
    for sides in [[Side::Touching; 2], [Side::Above; 2]] {
        // w₁ = 2 with x = 0 is more than ½: x₁ − ½x₂ = −2 + ½, and the second edge touches with w₂ = 2 + ¾.
        let solved = problem.solve(&[-2.0, -2.0], &mut sides.clone());
        assert_eq!(solved, Ok(vec![-1.5, 0.0]));
        // x₂ = 1 pulls w₁ down to −½ − b₁ = ¼.
        let solved = problem.solve(&[-0.75, 1.0], &mut sides.clone());
        assert_eq!(solved, Ok(vec![0.0, 1.0]));
    }
}

#[test]
fn a_violation_is_the_distance_to_what_is_allowed() {
    let problem = limited();
    // Open, at the limit, touching: all conditions hold.
    for right in [[1.0, 0.0], [-1.0, 0.5], [0.0, 0.25]] {
        assert_eq!(problem.violation(0, right), 0.0);
    }
    // Open with a flux, below the gap with less than the limit, touching with more, and with less than none.
    assert_eq!(problem.violation(0, [1.0, 0.25]), 0.25);
    assert_eq!(problem.violation(0, [-1.0, 0.25]), -0.25);
    assert_eq!(problem.violation(0, [0.0, 0.75]), 0.25);
    assert_eq!(problem.violation(0, [0.0, -0.25]), -0.25);
    assert_eq!(problem.violation(1, [-1.0, 8.0]), -1.0);
}

#[test]
fn limits_that_inputs_change_are_refused() {
    let two = HEADER.replace("M 1", "M 2").replace("{1.0f, -2.0f,}", "{1.0f, -2.0f, 0.0f, 1.0f}");
    let spans =
        |last| format!("{two}static const float SPANS[M*N] = {{1.0f, 1.0f, 0.0f, {last}}};");
    assert!(Problem::parse(&spans("0.0f")).is_some());
    assert_eq!(Problem::parse(&spans("0.5f")), None);
}

#[test]
fn what_is_no_problem_is_refused() {
    assert_eq!(Problem::parse(""), None);
    assert_eq!(Problem::parse(&HEADER.replace("N 2", "N 3")), None);
    assert_eq!(Problem::parse(&HEADER.replace("1.0f", "one")), None);
}

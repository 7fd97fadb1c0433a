//! Condensed contact with two ends, stated in another way: without an end, with equal ones, by modes.

use signorini_tolerances::solve::SAME_LIMITED;

use super::equality::without_contact;
use super::limits::{ENDS, limited};
use super::*;
use crate::modal;
use signorini_scene::mesh::structured::{Cells, grid};

/// An infinite limit is none, and one that is far away is like it.
#[test]
fn without_an_end_it_is_the_model_without_limits() -> Result<()> {
    // An input of the flux would move an end.
    let all = ALL.replace("of = \"contact\", field = \"flux\"", "of = \"right\", field = \"flux\"");
    let model = |ends: &str| -> Result<CondensedModel> {
        condense(&on_grid(&all.replace("flux = \"-0.1*x^2\"", ends), grid(5, Cells::Mixed))?.1)
    };
    let without = condense(&on_grid(&all, grid(5, Cells::Mixed))?.1)?;
    let infinite = model("flux = \"-0.1*x^2\", limit = \"inf\"")?;
    assert_eq!(format!("{without:?}"), format!("{infinite:?}"));
    let far = model("flux = \"-0.1*x^2\", limit = \"1e9\"")?;
    assert!(far.is_limited());
    for round in 0..4 {
        let p = moved(&without, 0.3, 7 * round);
        let [x, other] = [&without, &far].map(|model| model.solve(&p).expect("a solution"));
        x.iter().zip(&other).for_each(|(x, other)| SAME_LIMITED.check("opening", x - other));
        // Openings that extrapolate to below the gap at a vertex cost as much with a huge limit.
        let [a, b] =
            [without.bound(&p, &x), far.bound(&p, &x)].map(|bound| bound.expect("a bound"));
        SAME_LIMITED.check_relative("bound", a, b);
    }
    Ok(())
}

/// lo = hi is a Neumann boundary.
#[test]
fn equal_ends_are_a_given_flux() -> Result<()> {
    let contact = ALL
        .replace("flux = \"-0.1*x^2\"", "flux = \"-0.1*x^2\", limit = \"-0.1*x^2\"")
        .replace("input.rain = { of = \"contact\"", "input.rain = { of = \"right\"");
    let ends = "kind = \"contact\", gap = \"0.35 - 0.4*x^2 + 0.1*x^3\", \
                flux = \"-0.1*x^2\", limit = \"-0.1*x^2\"";
    let given = "kind = \"neumann\", flux = \"-0.1*x^2\"";
    let neumann = without_contact(&changed(&contact, &[(ends, given)]));
    let [one, other] = [(&contact, grid(5, Cells::Mixed)), (&neumann, grid(5, Cells::Mixed))]
        .map(|(text, mesh)| on_grid(text, mesh).and_then(|(_, problem)| condense(&problem)));
    let (one, other) = (one?, other?);
    assert_eq!((one.contact, other.contact), (10, 0));
    let x = one.solve(&one.defaults).expect("a solution");
    let found = one.outputs(&one.defaults, &x);
    let expected = other.outputs(&other.defaults, &[]);
    // Outputs without force and length, depth being an input of the gap alone.
    for (found, expected) in
        [(0, 0), (1, 1), (2, 2), (5, 3), (7, 5)].map(|(a, b)| (found[a], expected[b]))
    {
        SAME_LIMITED.check("output", found.expect("a value") - expected.expect("a value"));
    }
    let bounds = [found[6], expected[4]].map(|bound| bound.expect("a bound"));
    assert!(bounds[0] > 0.8 * bounds[1] && bounds[0] < 3.0 * bounds[1], "{bounds:?}");
    Ok(())
}

/// A model of modes has the same spans at every coefficient.
#[test]
fn modes_keep_their_limits() -> Result<()> {
    let input = "[input.h]\nof = \"left\"\nfield = \"coefficient\"\npattern = \"1\"\ndefault = 1.5\nrange = [-1.0, 100.0]\n";
    let text = limited(ENDS[0], input)
        .replace("of = \"contact\", field = \"flux\"", "of = \"right\", field = \"flux\"");
    let (_, problem) = on_grid(&text, grid(4, Cells::Mixed))?;
    let (modes, _) = modal(&problem, 0.0)?;
    for value in [-1.0, 1.5, 30.0] {
        let model = modes.at(value);
        let x = model.solve(&model.defaults).expect("a solution");
        let (_, solution, expected) = full_at(&problem, &model.defaults)?;
        let scale = solution.largest_flux();
        check_outputs(CONDENSED, &model, [&model.defaults, &x], &expected, scale);
    }
    Ok(())
}

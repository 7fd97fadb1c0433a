//! The page as a whole: well-formed, free of NaN, small.

mod fixtures;

use super::*;
use fixtures::{full, panel};

/// Every tag is closed, in order; no bare `<`, `>` or `&` in the text.
fn assert_well_formed(page: &str) {
    let body = page.strip_prefix("<!DOCTYPE html>").unwrap();
    let mut open = Vec::new();
    let mut pieces = body.split('<');
    assert_eq!(pieces.next().unwrap().trim(), "");
    for piece in pieces {
        let (tag, text) = piece.split_once('>').expect("a tag that does not end");
        assert!(!text.contains('>') || open.last() == Some(&"style"), "stray > in {text}");
        for entity in text.split('&').skip(1) {
            assert!(entity.contains(';'), "bare & in {text}");
        }
        assert_eq!(tag.matches('"').count() % 2, 0, "odd quotes in {tag}");
        let name = tag.split_whitespace().next().unwrap();
        if let Some(closed) = name.strip_prefix('/') {
            assert_eq!(open.pop(), Some(closed));
        } else if !tag.ends_with('/') {
            open.push(name);
        }
    }
    assert!(open.is_empty(), "left open: {open:?}");
}

fn assert_clean(report: &Report) -> String {
    let page = html(report);
    assert_well_formed(&page);
    let body = page.split_once("</style>").unwrap().1;
    assert!(!body.contains("NaN") && !body.contains("inf"));
    page
}

#[test]
fn the_page_is_well_formed_and_complete_in_itself() {
    let page = assert_clean(&full(panel(8, true)));
    for outside in ["<script", "<link", "<img", "@import", "url(", "src="] {
        assert!(!page.contains(outside), "{outside}");
    }
    assert!(page.contains("<a href=\"#scene-0\">half-disc</a>"));
    assert!(page.contains("id=\"scene-0\""));
    assert!(page.contains("Failed: 1 of 2 runs"));
    assert!(page.contains("<em>rate 2.00, expected 2</em>"));
    assert!(page.contains(">f32 &amp; &lt;fast&gt;</text>") && page.contains(">f64</text>"));
    assert!(page.contains("The total is 10.0 % of the solution’s energy norm ‖A<sup>½</sup>∇s‖."));
    assert!(page.contains("In truth s and τ are 0.190 off."));
}

#[test]
fn contents_lead_to_every_section_and_the_solutions_come_first() {
    let mut report = full(panel(4, false));
    report.scenes.insert(0, ScenePanel { is_test: true, ..panel(2, false) });
    let page = assert_clean(&report);
    let order =
        ["solutions", "tests", "runs", "checks", "convergence", "cut-off", "tradeoff", "extremes"];
    let sections: Vec<&str> = between(&page, "<section id=\"");
    assert_eq!(sections, order);
    let (contents, rest) = page.split_once("</nav>").unwrap();
    assert_eq!(between(contents, "<a href=\"#"), order);
    assert!(contents.contains("<nav") && !rest.contains("<nav"));
    let at = |text: &str| page.find(text).unwrap();
    assert!(at("</header>") < at("<nav") && at("id=\"scene-1\"") < at("id=\"scene-0\""));
    assert!(page.contains("error at most 0.200, in truth 0.190</small></summary>"));
}

#[test]
fn several_solutions_have_links_at_their_top() {
    let mut report = full(panel(4, false));
    assert!(!html(&report).contains("class=\"links\""));
    report.scenes.push(ScenePanel { name: "a < b".to_owned(), ..ScenePanel::default() });
    assert!(assert_clean(&report).contains("<li><a href=\"#scene-1\">a &lt; b</a></li>"));
}

/// The texts between each `start` and the next quote.
fn between<'p>(page: &'p str, start: &str) -> Vec<&'p str> {
    page.split(start).skip(1).map(|rest| rest.split('"').next().unwrap()).collect()
}

#[test]
fn a_page_with_nothing_to_show_is_still_a_page() {
    let page = assert_clean(&Report::default());
    assert!(!page.contains("<section") && !page.contains("<nav"));
    assert_clean(&full(ScenePanel::default()));
}

#[test]
fn a_constant_solution_without_contact_or_flux() {
    let mut constant = panel(4, false);
    constant.vertex_u.fill(3.0);
    constant.vertex_u[0] += 1e-15;
    constant.cell_flux.fill([0.0, 0.0]);
    constant.contact.clear();
    constant.bound = None;
    let page = assert_clean(&full(constant));
    assert!(page.contains("<svg") && !page.contains("class=\"arrows\""));
    // One colour for the field, the same for the bar.
    assert_eq!(page.matches("<path fill=").count(), 2);
}

#[test]
fn what_is_not_finite_is_never_written() {
    let mut broken = panel(4, true);
    broken.vertex_u[3] = f64::NAN;
    broken.vertices[7] = [f64::INFINITY, f64::NAN];
    broken.cell_flux[2] = [f64::NAN, f64::NEG_INFINITY];
    broken.contact[0].multiplier = f64::NAN;
    broken.contact[1].opening = f64::INFINITY;
    broken.contact[2].exact_multiplier[4] = f64::NAN;
    broken.contact[3].arc_length = [f64::NAN, f64::NAN];
    broken.boundary[0].ends[1] = [f64::NAN, 0.0];
    broken.indicators[5] = f64::NAN;
    broken.energy.0 = 0.0;
    assert_clean(&full(broken));

    let mut all = panel(2, false);
    all.vertex_u.fill(f64::NAN);
    all.contact.iter_mut().for_each(|edge| edge.multiplier = f64::NAN);
    assert_clean(&full(all));
}

#[test]
fn indices_out_of_range_and_missing_values_do_no_harm() {
    let mut short = panel(4, true);
    short.vertex_u.truncate(5);
    short.cell_flux.truncate(3);
    short.indicators.truncate(4);
    short.triangles[0] = [0, 1, u32::MAX];
    short.quads[0] = [0, 1, 2, u32::MAX];
    assert_clean(&full(short));
}

#[test]
fn a_fine_mesh_costs_little_more_than_a_coarse_one() {
    let page = assert_clean(&full(panel(64, true)));
    assert!(page.len() < 250_000, "{} bytes", page.len());
    assert!(page.matches("<path").count() < 400);
}

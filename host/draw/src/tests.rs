//! The page as a whole: well-formed, free of NaN, small.

use super::*;

/// The half-disc field r^{3/2} cos 3θ/2 on 2n × n squares of (−1, 1) × (0, 1); columns with x < 0
/// are cut into triangles when `mixed`.
fn panel(n: u32, mixed: bool) -> ScenePanel {
    let columns = 2 * n + 1;
    let at = |i: u32, j: u32| [f64::from(i) / f64::from(n) - 1.0, f64::from(j) / f64::from(n)];
    let vertices: Vec<[f64; 2]> =
        (0..=n).flat_map(|j| (0..columns).map(move |i| (i, j))).map(|(i, j)| at(i, j)).collect();
    let (mut triangles, mut quads) = (Vec::new(), Vec::new());
    for (i, j) in (0..n).flat_map(|j| (0..2 * n).map(move |i| (i, j))) {
        let [a, b] = [j * columns + i, j * columns + i + 1];
        let [d, c] = [a + columns, b + columns];
        if mixed && i < n {
            triangles.extend([[a, b, c], [a, c, d]]);
        } else {
            quads.push([a, b, c, d]);
        }
    }
    let polar = |[x, y]: [f64; 2]| (x.hypot(y), y.atan2(x));
    let centre = |cell: &[u32]| {
        let sum = cell.iter().fold([0.0, 0.0], |sum, &v| {
            let [x, y] = vertices[v as usize];
            [sum[0] + x, sum[1] + y]
        });
        sum.map(|part| part / cell.len() as f64)
    };
    let flux = |cell: &[u32]| {
        let (r, angle) = polar(centre(cell));
        [1.5 * r.sqrt() * (0.5 * angle).cos(), -1.5 * r.sqrt() * (0.5 * angle).sin()]
    };
    let cell_flux =
        triangles.iter().map(|cell| flux(cell)).chain(quads.iter().map(|cell| flux(cell)));
    let edge = |i: u32| {
        let [from, to] = [at(i, 0), at(i + 1, 0)];
        let exact = |x: f64| 1.5 * (-x).max(0.0).sqrt();
        let middle = 0.5 * (from[0] + to[0]);
        ContactEdge {
            ends: [from, to],
            arc_length: [from[0] + 1.0, to[0] + 1.0],
            active: middle < 0.0,
            multiplier: exact(middle),
            exact_multiplier: (0..9)
                .map(|k| exact(from[0] + f64::from(k) / f64::from(8 * n)))
                .collect(),
            opening: middle.max(0.0).powf(1.5),
        }
    };
    ScenePanel {
        name: "half-disc".to_owned(),
        title: "r^3/2 & <friends>".to_owned(),
        passed: true,
        vertex_u: vertices
            .iter()
            .map(|&point| polar(point))
            .map(|(r, angle)| r.powf(1.5) * (1.5 * angle).cos())
            .collect(),
        cell_flux: cell_flux.collect(),
        indicators: (0..triangles.len() + quads.len()).map(|cell| 1e-4 * cell as f64).collect(),
        bound: Some(bound()),
        no_bound: None,
        error: Some(0.19),
        energy: 2.0,
        contact: (0..2 * n).map(edge).collect(),
        boundary: vec![BoundaryEdge { ends: [at(0, 0), at(0, n)], kind: BoundaryKind::Dirichlet }],
        facts: vec![("unknowns".to_owned(), "6112".to_owned())],
        vertices,
        triangles,
        quads,
    }
}

fn bound() -> BoundTerms {
    BoundTerms {
        total: 0.2,
        of_u: 0.35,
        gap: 0.195,
        algebraic: 1e-9,
        oscillation: 0.005,
        rounding: 1e-12,
    }
}

fn full(panel: ScenePanel) -> Report {
    let row = |cells: &[&str], passed| TableRow {
        cells: cells.iter().map(|&cell| cell.to_owned()).collect(),
        passed,
    };
    let series = |expected_rate: f64| ConvergenceSeries {
        label: format!("rate {expected_rate}"),
        h: vec![0.25, 0.125],
        error: vec![0.25_f64.powf(expected_rate), 0.125_f64.powf(expected_rate)],
        expected_rate,
    };
    Report {
        title: "Signorini <script>".to_owned(),
        generated_by: "version \"0\"".to_owned(),
        table: Table {
            header: vec!["scene".to_owned(), "error".to_owned()],
            rows: vec![row(&["half-disc", "1e-3"], true), row(&["other", "–"], false)],
        },
        checks: vec![Check { claim: "a < b".to_owned(), found: "1 < 2".to_owned(), passed: true }],
        convergence: vec![ConvergencePlot {
            title: "L2".to_owned(),
            series: vec![series(1.0), series(2.0)],
        }],
        cut_off: Table {
            header: vec!["scene".to_owned(), "1".to_owned()],
            rows: vec![row(&["half-disc", "5.3"], true)],
        },
        sweeps: vec![SweepPlot {
            title: "half-disc".to_owned(),
            sweeps: vec![1.0, 5.0],
            curves: vec![("bound".to_owned(), vec![2.0, 1.0])],
        }],
        tradeoff: Some(tradeoff()),
        extremes: Some(Extremes::default()),
        scenes: vec![panel],
    }
}

/// Two settings on a front, one of them with a name that would be markup, and one beside it.
fn tradeoff() -> Tradeoff {
    let point = |name: &str, cost: f64, error: f64, front: bool| ParetoPoint {
        name: name.to_owned(),
        note: "<cost> & error".to_owned(),
        cost,
        error,
        bound: Some(1.5 * error),
        front,
        recommended: name == "f64",
        ..ParetoPoint::default()
    };
    let picture = ParetoPlot {
        title: "a < b".to_owned(),
        cost: "cycles".to_owned(),
        size: 1.0,
        series: vec!["level 0".to_owned()],
        points: vec![
            point("f32 & <fast>", 1e3, 1e-2, true),
            point("f64", 1e4, 1e-3, true),
            point("slow", 2e4, f64::NAN, false),
        ],
    };
    let rows = vec![vec!["f32 & <fast>".to_owned(), "1 000".to_owned()]];
    let front = Listing { header: vec!["a".to_owned(), "b".to_owned()], rows, marked: Some(0) };
    let study = TradeStudy {
        heading: "On the host".to_owned(),
        further: vec![("a < b".to_owned(), front.clone())],
        picture,
        front: front.clone(),
        ..TradeStudy::default()
    };
    let scene = TradePanel { studies: vec![study], ..TradePanel::default() };
    Tradeoff {
        summary: front,
        findings: vec!["f32 < f64".to_owned()],
        sizes: "a < b".to_owned(),
        of_sizes: vec!["a > b".to_owned()],
        scenes: vec![scene],
    }
}

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
    assert!(page.contains("10.0 % of the solution’s ‖A^½∇u‖; in truth it is 0.190 off"));
}

#[test]
fn a_page_with_nothing_to_show_is_still_a_page() {
    let page = assert_clean(&Report::default());
    assert!(!page.contains("<section>"));
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
    broken.energy = 0.0;
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

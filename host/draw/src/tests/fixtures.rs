//! A report with something in every section.

use crate::*;

/// The half-disc field r^{3/2} cos 3θ/2 on 2n × n squares of (−1, 1) × (0, 1); columns with x < 0
/// are cut into triangles when `mixed`.
pub fn panel(n: u32, mixed: bool) -> ScenePanel {
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
            boundary: "foot".to_owned(),
            ends: [from, to],
            arc_length: [from[0] + 1.0, to[0] + 1.0],
            state: if middle < 0.0 { ContactState::Touching } else { ContactState::Open },
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
        is_test: false,
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
        energy: (2.0, "‖A^½∇s‖"),
        contact: (0..2 * n).map(edge).collect(),
        boundary: vec![BoundaryEdge { ends: [at(0, 0), at(0, n)], kind: BoundaryKind::Dirichlet }],
        sentence: Some(
            "The seepage is (3.31 ± 0.15)·10⁻⁵ m2/s, guaranteed, over 6.08 m of contact on this mesh.".to_owned(),
        ),
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

pub fn full(panel: ScenePanel) -> Report {
    let series = |expected_rate: f64| Curve {
        label: format!("rate {expected_rate}"),
        values: [0.25_f64, 0.125].map(|h| Some(h.powf(expected_rate))).to_vec(),
        expected_rate: Some(expected_rate),
        ..Curve::default()
    };
    let chart = |title: &str, at: [f64; 2], curves| Chart {
        title: title.to_owned(),
        at: at.to_vec(),
        strips: vec![Strip { curves, ..Strip::default() }],
        ..Chart::default()
    };
    let bound = Curve {
        label: "bound".to_owned(),
        values: vec![Some(2.0), Some(1.0)],
        wide: true,
        ..Curve::default()
    };
    Report {
        title: "Signorini <script>".to_owned(),
        generated_by: "version \"0\"".to_owned(),
        table: Table::checked(&columns(), [["half-disc", "1e-3"], ["other", "–"]], |row| {
            row[1] != "–"
        }),
        checks: vec![Check { claim: "a < b".to_owned(), found: "1 < 2".to_owned(), passed: true }],
        convergence: vec![chart("L2", [0.25, 0.125], vec![series(1.0), series(2.0)])],
        cut_off: Table::checked(&columns(), [["half-disc", "5.3"]], |_| true),
        sweeps: vec![chart("half-disc", [1.0, 5.0], vec![bound])],
        tradeoff: Some(tradeoff()),
        extremes: Some(Extremes::default()),
        scenes: vec![panel],
    }
}

fn columns<'c>() -> [Column<'c, [&'c str; 2]>; 2] {
    let read = |at: usize| move |row: &[&str; 2]| row[at].to_owned();
    [Column::words("scene", read(0)), Column::number("error", read(1))]
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
    let front = Table::new(&columns(), [["f32 & <fast>", "1 000"]]).choosing(Some(0));
    let study = TradeStudy {
        heading: "On the host".to_owned(),
        further: vec![("a < b".to_owned(), front.clone())],
        picture,
        front: front.clone(),
        ..TradeStudy::default()
    };
    let scene = TradePanel { studies: vec![study.clone()], ..TradePanel::default() };
    Tradeoff {
        targets: vec![study],
        findings: vec!["f32 < f64".to_owned()],
        sizes: front,
        of_sizes: vec!["a > b".to_owned()],
        scenes: vec![scene],
    }
}

//! Against the definition of v by differences of its values, and in closed form.

use super::*;
use crate::NoBound;
use crate::admissible::{Admissible, Following};
use crate::conductivity::Conductivity;
use crate::data::Data;
use crate::deviation::Lift;
use signorini_problem::EdgeKind;
use signorini_problem::fixtures::{self, CURVED, PARABOLA};
use signorini_problem::quadrature::on_panels;
use signorini_scene::mesh::Mesh;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_tolerances::Tolerance;
use signorini_tolerances::solve::{
    CURVED_ENERGY, CURVED_KINK, DIFFERENCES, DIFFERENCES_COLLAPSED, LAYER, NOISE, PARABOLIC, STEEP,
};

/// A of [`CURVED`].
const TENSOR: &str = "[\"2\", \"0.5\", \"1\"]";

/// v of an edge as a function of the point, by its definition and without its gradient.
fn value(cell: &Cell, side: usize, deviation: &Deviation, reference: [f64; 3]) -> f64 {
    let side = cell.local(reference).sides[side];
    side.height * deviation.at(side.t).expect("finite data")[0]
}

/// ∫_T A∇v·∇N by differences of values: no formula for a gradient is used.
fn by_differences(
    cell: &Cell,
    a: &Conductivity,
    functions: [&dyn Fn([f64; 3]) -> f64; 2],
    points: usize,
) -> f64 {
    let step = 1e-5;
    let gradient = |function: &dyn Fn([f64; 3]) -> f64, reference: [f64; 3]| {
        // Derivatives in two reference directions, then the chain rule backwards.
        let move_by = |direction: usize, by: f64| {
            let mut moved = reference;
            match cell {
                Cell::Triangle(_) => {
                    moved[direction + 1] += by;
                    moved[0] -= by;
                }
                Cell::Quad(_) => moved[direction] += by,
            }
            moved
        };
        let slope = |f: &dyn Fn([f64; 3]) -> f64, k| {
            (f(move_by(k, step)) - f(move_by(k, -step))) / (2.0 * step)
        };
        let x = |k: usize| move |reference: [f64; 3]| cell.local(reference).x[k];
        let [xs, ys] = [[0, 1].map(|k| slope(&x(0), k)), [0, 1].map(|k| slope(&x(1), k))];
        let [fs, ft] = [0, 1].map(|k| slope(function, k));
        let determinant = xs[0] * ys[1] - xs[1] * ys[0];
        [(fs * ys[1] - ft * ys[0]) / determinant, (ft * xs[0] - fs * xs[1]) / determinant]
    };
    let sum = cell.points(&gauss(points)).into_iter().map(|point| {
        let [v, w] = functions.map(|function| gradient(function, point.reference));
        point.weight * product(&a.at(point.x), v, w)
    });
    sum.sum()
}

fn check_against_differences(mesh: Mesh, scene: &str, allowed: Tolerance) -> Result<usize> {
    let (_, problem) = fixtures::on_grid(scene, mesh)?;
    let records = curved(&problem)?;
    let deviations = Deviations::of(&problem)?;
    let mut energies = BTreeMap::new();
    for record in &records {
        let deviation = deviations.on(record.edge as usize).expect("a curved edge");
        let (at, side) = problem.topology.first_side(deviation.edge);
        let (cell, a) = (Cell::of(&problem, at), Conductivity::of(&problem, at));
        *energies.entry(at).or_insert(0.0) += record.energy;
        let v = |reference: [f64; 3]| value(&cell, side, deviation, reference);
        for (k, &found) in record.coupling.iter().enumerate() {
            let n = |reference: [f64; 3]| {
                let local = cell.local(reference);
                match (cell.corners().len(), k) {
                    (_, 0..4) => local.vertices[k].value,
                    (4, _) => {
                        let side = local.sides[k - 4];
                        4.0 * side.t * (1.0 - side.t) * side.height
                    }
                    _ => 0.0,
                }
            };
            let expected = by_differences(&cell, &a, [&v, &n], 24);
            allowed.check(format_args!("{record:?} {k}"), found - expected);
        }
    }
    for (&at, &energy) in &energies {
        let (cell, a) = (Cell::of(&problem, at), Conductivity::of(&problem, at));
        let all = |reference: [f64; 3]| {
            let sides = deviations.found.iter().map(|d| (d, problem.topology.first_side(d.edge)));
            let here = sides.filter(|&(_, (cell, _))| cell == at);
            here.map(|(deviation, (_, side))| value(&cell, side, deviation, reference)).sum()
        };
        let expected = by_differences(&cell, &a, [&all, &all], 40);
        allowed.check(format_args!("cell {at}"), energy - expected);
    }
    Ok(records.len() - energies.len())
}

/// On triangles the twin's rule collapses at one vertex, not at the apex of the side.
#[test]
fn they_agree_with_differences_of_values() -> Result<()> {
    let meshes = [
        (grid(2, Cells::Triangles), DIFFERENCES_COLLAPSED),
        (fixtures::distorted(grid(2, Cells::Quads)), DIFFERENCES),
    ];
    // On quads that are no parallelograms a polynomial below x² stands for it; x is one.
    let tensors = ["[\"2+x\", \"0.5*y\", \"1+x^2\"]", "[\"2+x\", \"0.5*y\", \"3+x\"]"];
    for ((mesh, allowed), varying) in meshes.into_iter().zip(tensors) {
        for tensor in [TENSOR, varying] {
            let scene = fixtures::changed(CURVED, &[(TENSOR, tensor)]);
            let corners = check_against_differences(mesh.clone(), &scene, allowed)?;
            assert!(corners > 0, "no cell with two curved edges was tried");
        }
    }
    Ok(())
}

#[test]
fn a_parabola_over_its_chord() -> Result<()> {
    // ψ = −x² on an edge of length l: w = l² t(1 − t), mean l²/6. On the right isosceles triangle
    // below a cut square (E the bottom, A = I): ∇λ_b + t∇λ_c = (1/l)(1, t − 1) for the apex above b.
    let n = 4;
    let (_, problem) = fixtures::on_grid(PARABOLA, grid(n, Cells::Triangles))?;
    let records = curved(&problem)?;
    let length = 1.0 / f64::from(n);
    assert_eq!(records.len(), 2 * n as usize);
    // |T| ∫ |w′ ∇λ_b + (t w′ − w) ∇λ_c|² with ∇λ_b = (1, −1)/l, ∇λ_c = (0, 1)/l, w′ = l²(1 − 2t):
    // l⁴/2 ∫ (1 − 2t)² + ((1 − 2t)(t − 1) − t(1 − t))² dt = l⁴/2 (1/3 + ∫ (1 − t)⁴ dt) = 4l⁴/15.
    for record in &records {
        PARABOLIC.check("mean", record.mean - length.powi(2) / 6.0);
        PARABOLIC.check("energy", record.energy - 4.0 * length.powi(4) / 15.0);
        // ∫∇v = |E| w̄ n, n = (0, −1), and ∇λ = (−1, 0), (1, −1), (0, 1) over l.
        let integral = [0.0, -length.powi(3) / 6.0 / length];
        let expected = [0.0, -integral[1], integral[1], 0.0, 0.0, 0.0, 0.0, 0.0];
        for (found, expected) in record.coupling.iter().zip(expected) {
            PARABOLIC.check("correction", found - expected);
        }
    }
    Ok(())
}

#[test]
fn an_input_bends_an_edge_like_its_boundarys_own_expression() -> Result<()> {
    let (input, own) = ("sin(2*x) - 0.3*x*y^2", "sin(2*x) + y^3 - 0.3*x*y^2");
    let text = CURVED.replace(own, input)
        + "[input.lift]\nof = \"default\"\nfield = \"value\"\npattern = \"2*y^3\"\ndefault = 0.5\n";
    let (_, problem) = fixtures::on_grid(&text, grid(2, Cells::Mixed))?;
    let with_input = curved(&problem)?;
    let (_, problem) = fixtures::on_grid(CURVED, grid(2, Cells::Mixed))?;
    let expected = curved(&problem)?;
    assert_eq!(with_input.len(), expected.len());
    for (found, expected) in with_input.iter().zip(&expected) {
        PARABOLIC.check("mean", found.mean - expected.mean);
        PARABOLIC.check("energy", found.energy - expected.energy);
    }
    Ok(())
}

#[test]
fn affine_data_leave_no_record() -> Result<()> {
    let affine = PARABOLA.replace("-x^2", "12.3 - 0.7*x + 3e5*y");
    for cells in [Cells::Triangles, Cells::Quads] {
        let (_, problem) = fixtures::on_grid(&affine, grid(7, cells))?;
        assert_eq!(curved(&problem)?, []);
    }
    Ok(())
}

/// [`PARABOLA`] with another gap, on triangles of edge ½.
fn gapped(gap: &str) -> Result<Problem> {
    let scene = PARABOLA.replace("-x^2", gap);
    Ok(fixtures::on_grid(&scene, grid(2, Cells::Triangles))?.1)
}

/// The record of the contact edge from 0 to 0.5, for a gap with something at 0.3.
fn with_gap(gap: &str) -> Result<Curved> {
    let problem = gapped(gap)?;
    let mut records = curved(&problem)?;
    records.retain(|record| {
        let [a, b] = problem.segment(record.edge as usize);
        (a[0] - 0.3) * (b[0] - 0.3) < 0.0
    });
    assert_eq!(records.len(), 1);
    Ok(records.remove(0))
}

/// ½∫ w′² + ((1 − t)w′ + w)² dt: the energy above, for any w, over a part of the edge.
fn energy_of(w: impl Fn(f64) -> [f64; 2], [from, to]: [f64; 2]) -> f64 {
    let term = |[t, weight]: [f64; 2]| {
        let t = from + (to - from) * t;
        let [w, slope] = w(t);
        0.5 * (to - from) * weight * (slope.powi(2) + ((1.0 - t) * slope + w).powi(2))
    };
    gauss(4).into_iter().map(term).sum()
}

#[test]
fn a_kink_inside_an_edge_is_found() -> Result<()> {
    // ψ = −30 (x − 0.3)₊ is −15 (t − 0.6)₊, its chord −6t.
    let record = with_gap("-30*max(0, x - 0.3)")?;
    let chord = 30.0 * 0.2;
    let left = |t: f64| [chord * t, chord];
    let right = |t: f64| [chord * t - 15.0 * (t - 0.6), chord - 15.0];
    let expected = energy_of(left, [0.0, 0.6]) + energy_of(right, [0.6, 1.0]);
    CURVED_KINK.check_relative("energy", record.energy, expected);
    let mean = 0.5 * chord * 0.6;
    CURVED_KINK.check_relative("mean", record.mean, mean);
    Ok(())
}

#[test]
fn a_layer_inside_an_edge_is_found() -> Result<()> {
    // w′ = sech²((t − t₀)/δ)/δ and ∫w′² = 4/(3δ), next to which w is nothing; t₀ = 0.6.
    for width in [1e-3, 1e-6] {
        let record = with_gap(&format!("tanh((x - 0.3)/{width:e})"))?;
        let expected = 0.5 * (1.0 + 0.4_f64.powi(2)) * 4.0 / 3.0 / (2.0 * width);
        // The width itself is what the other terms have.
        let size = expected * (1.0 + 2e5 * width);
        LAYER.check_over(format_args!("{width:e}"), record.energy - expected, size);
    }
    Ok(())
}

#[test]
fn a_jump_inside_an_edge_has_no_bound() -> Result<()> {
    assert!(
        with_gap("sign(x - 0.3)")?.rough.is_some() && with_gap("abs(x - 0.3)")?.rough.is_none()
    );
    for (gap, bound) in [("sign(x - 0.3)", false), ("abs(x - 0.3)", true), ("-x^2", true)] {
        assert_eq!(Data::<f64>::new(&gapped(gap)?)?.has_bound(), bound, "{gap}");
    }
    Ok(())
}

/// Data that all points of the first panels miss: a bump over 1/400 of an edge, a step of 1/300 and a hat beside a vertex.
#[test]
fn what_no_point_sees_is_found() -> Result<()> {
    // The slope of exp(−z²), z = (t − t₀)/δ: ∫w′² = √(π/2)/δ.
    let bump = |width: f64| (0.5 * std::f64::consts::PI).sqrt() / width;
    for (gap, square) in [
        ("exp(-((x - 0.3)/0.00125)^2)", bump(0.0025)),
        ("exp(-((x - 0.3)/1.25e-6)^2)", bump(2.5e-6)),
        ("max(0, 1 - abs(x - 0.3)/0.0005)", 2.0 / 0.001),
        ("1e-3*max(0, 1 - abs(x - 0.4999)/0.00002)", 2e-6 / 0.00004),
    ] {
        let record = with_gap(gap)?;
        // ∇v = (w′ ∂x, …): at least ½ ∫w′², at most all of it and a little for w.
        let most = record.energy.sqrt() + record.missed;
        assert!(most.powi(2) >= 0.5 * square, "{gap}: {record:?} {square}");
        assert!(record.energy <= 1.1 * square && record.missed < 2e-3 * most, "{gap}: {record:?}");
    }
    // The others jump where parts of the edge meet: in its middle, or at three quarters.
    for gap in [
        "sign(x - 0.3) - sign(x - 0.3001)",
        "1e-8*sign(x - 0.3) - x^2",
        "atan(1/(x - 0.25))",
        "tanh(1/(x - 0.375))",
        "(x - 0.25)/sqrt((x - 0.25)*(x - 0.25))",
        "min(1, max(-1, 1/(x - 0.25)))",
    ] {
        assert!(matches!(with_gap(gap)?.rough, Some(Rough::Jump(_))), "{gap}");
    }
    Ok(())
}

/// Terms of order 1 cancel to 1e−7: their rounding is more than 1e−9 of what is left.
#[test]
fn noise_is_no_singularity() -> Result<()> {
    let noisy = with_gap("(exp(x) + 1e-7*sin(3*x)) - exp(x)")?;
    assert_eq!(noisy.rough, None);
    let plain = with_gap("1e-7*sin(3*x)")?;
    NOISE.check_relative("energy", noisy.energy, plain.energy);
    Ok(())
}

#[test]
fn single_singular_points_do_no_harm() -> Result<()> {
    // No slope at the end of the edge, no value in its middle.
    for gap in ["-(x^2)^0.75", "-sin(x - 0.25)/(x - 0.25)"] {
        let record = with_gap(gap)?;
        assert!(
            record.energy > 0.0 && record.energy < 1.0 && record.rough.is_none(),
            "{gap}: {record:?}"
        );
    }
    Ok(())
}

#[test]
fn smooth_data_have_regular_panels() -> Result<()> {
    for cells in [Cells::Triangles, Cells::Quads] {
        let (_, problem) = fixtures::on_grid(CURVED, fixtures::distorted(grid(2, cells)))?;
        for deviation in &Deviations::of(&problem)?.found {
            assert!(Panels::along(deviation)?.is_regular());
        }
    }
    // Far from the origin the places of the points are rounded, on edges of 10⁻⁶ to a few digits.
    let far = PARABOLA.replace("-x^2", "-(x - 1e3)^2").replace("1e6*y", "1e6*(y - 1e3)/1e-6");
    let mut mesh = grid(2, Cells::Triangles);
    mesh.vertices.iter_mut().for_each(|x| *x = [1e3 + 1e-6 * x[0], 1e3 + 1e-6 * x[1]]);
    let (_, problem) = fixtures::on_grid(&far, mesh)?;
    for deviation in &Deviations::of(&problem)?.found {
        assert!(Panels::along(deviation)?.is_regular());
    }
    assert_eq!(Panels::regular().rule(), on_panels(PANELS, &gauss(POINTS)));
    Ok(())
}

#[test]
fn nothing_is_above_its_peak() -> Result<()> {
    let gaps = [
        ("-x^2", 1.2),
        ("0.3*sin(40*x)", 4.0),
        ("-3*max(0, x - 0.1)", 1.6),
        ("-3*abs(x - 0.25)", 1.01),
        ("0.2*tanh((x - 0.4)/1e-4)", 60.0),
        ("-(1.001 - x)^0.6", 2.5),
    ];
    for (gap, most) in gaps {
        let scene = PARABOLA.replace("-x^2", gap).replace("20 + 1e6*y", "20");
        let (_, problem) = fixtures::on_grid(&scene, grid(2, Cells::Triangles))?;
        let records = curved(&problem)?;
        let alone = |record: &&Curved| record.peak.is_finite();
        assert!(records.iter().filter(alone).count() > 0, "{gap}");
        for record in records.iter().filter(alone) {
            let deviations = Deviations::of(&problem)?;
            let deviation = deviations.on(record.edge as usize).expect("a curved edge");
            let values = (0..=20_000).map(|k| deviation.value(f64::from(k) / 20_000.0).abs());
            let largest = values.fold(0.0, f64::max);
            assert!(record.peak >= largest && record.peak <= most * largest, "{gap}: {record:?}");
        }
    }
    Ok(())
}

/// A quad's bubble makes up for w, a corner cell has products of two extensions.
#[test]
fn s_leaves_a_curve_out_where_it_is_clear_of_it() -> Result<()> {
    let scene = PARABOLA.replace("-x^2", "-x^2 - 0.01").replace("20 + 1e6*y", "x*y");
    // At height 0 it is too near in the two edges beside x = 0.
    for (cells, left) in [(Cells::Triangles, [2, 0, 0]), (Cells::Quads, [8; 3])] {
        let (_, problem) = fixtures::on_grid(&scene, grid(4, cells))?;
        let all = Deviations::of(&problem)?.found.len();
        for (height, left) in [0.0, 10.0, -10.0].into_iter().zip(left) {
            let vertices = &vec![height; problem.mesh.vertices.len()][..];
            let following = &Following::WhereNeeded;
            let s = Admissible { vertices, bubbles: &[], tau: &[], following };
            assert_eq!(followed(&problem, &s)?.found.len(), left, "{cells:?} at {height}");
            let s = Admissible { following: &Following::default(), ..s };
            assert_eq!(followed(&problem, &s)?.found.len(), all);
            let first = Deviations::of(&problem)?.found[0].edge as u32;
            let s = Admissible { following: &Following::Except(vec![first]), ..s };
            assert_eq!(followed(&problem, &s)?.found.len(), all - 1);
        }
    }
    let (_, problem) = fixtures::on_grid(CURVED, grid(2, Cells::Triangles))?;
    let edges = Deviations::of(&problem)?.found.iter().map(|of| of.edge).collect::<Vec<_>>();
    let alone = |edge: usize| {
        let cell = |edge: usize| problem.topology.first_side(edge).0;
        edges.iter().filter(|&&other| cell(other) == cell(edge)).count() == 1
    };
    let may = may_be_cleared(&problem, edges.iter().copied());
    for (&edge, &may) in edges.iter().zip(&may) {
        assert_eq!(may, alone(edge) && problem.kinds[edge] == EdgeKind::Contact, "edge {edge}");
    }
    assert!(may.contains(&true) && may.contains(&false));
    Ok(())
}

/// Kinks, on quads on opposite sides as well; and waves along an edge, as many as panels for smooth data find, and twice as many in
/// a product of two.
#[test]
fn data_on_two_sides_of_a_cell_meet() -> Result<()> {
    let kinks = [
        "abs(x - 0.31) + 2*max(0, y - 0.62) + max(0, x + 0.57)",
        "-3 - abs(x - 0.43) - max(x, -0.83)",
    ];
    let waves = ["sin(31.5*x + 4.8) + sin(31.5*y + 4.8)", "-3 + sin(31.5*x + 4.8)"];
    for (tensor, [value, gap]) in
        [(TENSOR, kinks), ("[\"1\", \"-0.95\", \"1\"]", waves), ("\"1\"", waves)]
    {
        let data = [("sin(2*x) + y^3 - 0.3*x*y^2", value), ("-2 + exp(x)*(1 + x^2)/20", gap)];
        let scene = fixtures::changed(&fixtures::changed(CURVED, &data), &[(TENSOR, tensor)]);
        energies_of_pairs(&scene)?;
    }
    Ok(())
}

/// The energies of all lifts into a cell against a fine rule, on cells of edge 1 with two curved sides.
fn energies_of_pairs(scene: &str) -> Result<()> {
    for cells in [Cells::Triangles, Cells::Quads] {
        let (_, problem) = fixtures::on_grid(scene, grid(1, cells))?;
        let deviations = Deviations::of(&problem)?;
        let (records, mut pairs) = (curved(&problem)?, 0);
        for at in 0..problem.cells() {
            let here =
                records.iter().filter(|of| problem.topology.first_side(of.edge as usize).0 == at);
            let (found, sides) = here.fold((0.0, 0), |(sum, n), of| (sum + of.energy, n + 1));
            pairs += usize::from(sides > 1);
            let (cell, a) = (Cell::of(&problem, at), Conductivity::of(&problem, at));
            let lift = Lift::on_cell(&problem, at, &deviations);
            let mut expected = 0.0;
            for point in cell.points(&on_panels(300, &gauss(2))) {
                let gradient = lift.at(&cell.local(point.reference))?.gradient;
                expected += point.weight * product(&a.at(point.x), gradient, gradient);
            }
            CURVED_ENERGY.check_relative(format_args!("cell {at}"), found, expected);
        }
        assert!(pairs > 1, "no cells with two curved sides were tried");
    }
    Ok(())
}

/// Whether data on y = 0 or x = 0 allow for a bound, and why not.
fn refusal(text: &str) -> Result<Option<NoBound>> {
    let (_, problem) = fixtures::on_grid(text, grid(2, Cells::Triangles))?;
    Ok(Data::<f64>::new(&problem)?.no_bound().cloned())
}

#[test]
fn data_of_infinite_energy_have_no_bound() -> Result<()> {
    for gap in [
        "-1/abs(x - 0.3)",
        "-1/(x - 0.3)",
        "abs(x - 0.3)^0.1",
        "abs(x - 0.25)^0.1",
        "abs(x - 0.3)^0.4",
        "abs(x - 0.3)^0.5",
        "sqrt(max(0, x - 0.5))",
        "ln(abs(x - 0.3))",
        "sqrt(1 - x)",
    ] {
        let (problem, text) = (gapped(gap)?, PARABOLA.replace("-x^2", gap));
        let reason = refusal(&text)?.map_or_else(String::new, |reason| reason.to_string());
        assert!(reason.contains("the gap of boundary.contact near ("), "{gap}: {reason}");
        let place = |of: &Curved| match of.rough {
            Some(Rough::Steep(t)) => Some(problem.along(of.edge as usize, t)),
            _ => None,
        };
        let at = curved(&problem)?.iter().find_map(place).expect("a steep place");
        assert!(at[1] == 0.0 && reason.contains("rises too steeply"), "{gap}: {reason}");
        let near = [0.3, 0.25, 0.5, 1.0].map(|x| (at[0] - x).abs());
        STEEP.check(format_args!("{gap}: {reason}"), near.into_iter().fold(1.0, f64::min));
    }
    for gap in ["abs(x - 0.3)^0.6", "abs(x - 0.3)^0.75", "abs(x - 0.3)^1.5", "abs(x - 0.25)^0.7"] {
        assert_eq!(refusal(&PARABOLA.replace("-x^2", gap))?, None, "{gap}");
    }
    Ok(())
}

/// √(x + 1) is constant on x = −1, where its derivative across is infinite.
#[test]
fn a_derivative_across_the_edge_does_not_matter() -> Result<()> {
    let text = CURVED.replace("sin(2*x) + y^3 - 0.3*x*y^2", "sqrt(x + 1) + y^3 + y*x^2");
    assert_ne!(text, CURVED);
    // On y = 1 it is √t from the corner on.
    let found = refusal(&text)?;
    assert!(found.is_some_and(|found| found.to_string().contains("rises too steeply")));
    let text = CURVED
        .replace("sin(2*x) + y^3 - 0.3*x*y^2", "sqrt(x + 1)^3*(1 - y) + sqrt(x + 1)*y*(1 - y)");
    assert_eq!(refusal(&text)?, None);
    Ok(())
}

/// The bound has the part of |x − 0.3|^0.6 that points miss: finer panels do not find more than was said.
#[test]
fn what_the_points_miss_is_told() -> Result<()> {
    // w′ = 0.6·2^-0.6 |t − 0.6|^-0.4 − chord on the edge from 0 to 0.5, whose ∫w′² is known.
    let record = with_gap("2^0.6*abs(x - 0.3)^0.6")?;
    let chord = 0.4_f64.powf(0.6) - 0.6_f64.powf(0.6);
    // ∫₀^d (0.6 s^−0.4)² ds = 0.36 d^0.2/0.2
    let square = |d: f64| 0.36 * d.powf(0.2) / 0.2;
    let energy = square(0.6) + square(0.4) - chord * chord;
    // ∇v = (w′ ∂x, …): at least ½ ∫w′².
    let found = (record.energy.sqrt() + record.missed).powi(2);
    assert!(found > 0.5 * energy, "{found} {energy}");
    assert!(record.missed > 0.0 && record.missed < record.energy.sqrt(), "{record:?}");
    Ok(())
}

/// A kink of the gap right beside a vertex, where Gmsh has put it: its energy is that of w in closed form, however near it is.
#[test]
fn a_kink_right_beside_a_vertex_is_found() -> Result<()> {
    for by in [1e-9, 1e-11, 1.256e-12, 1e-13] {
        for at in [-by, by] {
            let mut mesh = grid(2, Cells::Triangles);
            mesh.vertices[2] = [at, 0.0];
            let text = fixtures::changed(PARABOLA, &[("-x^2", "min(-x, 0)"), ("20 + 1e6*y", "1")]);
            let (_, problem) = fixtures::on_grid(&text, mesh.clone())?;
            assert_eq!(Data::<f64>::new(&problem)?.no_bound(), None, "{at}");
            let records = curved(&problem)?;
            let crosses = |of: &&Curved| {
                let [[a, _], [b, _]] = problem.segment(of.edge as usize);
                a * b < 0.0
            };
            let record = records.iter().find(crosses).expect("the edge over x = 0");
            let edge = record.edge as usize;
            let ([[a, _], [b, _]], (cell, side)) =
                (problem.segment(edge), problem.topology.first_side(edge));
            let (kink, ends) = (a / (a - b), [a, b].map(|x| (-x).min(0.0)));
            let sample = |[t, weight]: [f64; 2]| {
                let x = a + t * (b - a);
                let w = (-x).min(0.0) - (ends[0] + t * (ends[1] - ends[0]));
                let slope = if x > 0.0 { a - b } else { 0.0 } - (ends[1] - ends[0]);
                Sample { t, weight, w, slope }
            };
            let part = |[start, end]: [f64; 2]| {
                let rule = gauss(POINTS).into_iter();
                rule.map(move |[t, w]| [start + t * (end - start), w * (end - start)])
            };
            let samples: Vec<_> =
                [[0.0, kink], [kink, 1.0]].into_iter().flat_map(part).map(sample).collect();
            let expected = CellEnergy::of(&problem, cell).of_extension(side, &samples);
            let (found, missed) = (record.energy.sqrt(), record.missed);
            // The place of the kink is rounded as coordinates are.
            let most = 1.01 * missed + 1e-5 * expected;
            assert!((found - expected).abs() <= most, "{at}: {found} {expected} {missed}");
            assert!(missed < 0.5 * expected, "{at}: {missed} {expected}");
            // A jump is one however small it is.
            let text = text.replace("min(-x, 0)", "min(-x, 0) + 1e-9*sign(x + 0.7)");
            let (_, problem) = fixtures::on_grid(&text, mesh)?;
            let reason = Data::<f64>::new(&problem)?.no_bound().cloned().expect("a jump");
            assert!(reason.to_string().contains("jumps"), "{reason}");
        }
    }
    Ok(())
}

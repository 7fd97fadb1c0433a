//! The bound is a bound, for any x ≥ 0, and sharp at convergence.

use signorini_tolerances::bake::{
    CORNER, GUARANTEE, IDENTITY, IDENTITY_BOUNDED, IDENTITY_KINKED, JUMP, SAME_BOUND, WAVES,
};
use signorini_tolerances::{Tolerance, some};
use std::path::Path;

use super::direct::to_the_end;
use super::exact;
use crate::choice::{Choice, Wanted};
use crate::condensed::{Baked, Controller, Work};
use crate::full;
use signorini_certify::admissible::Following;
use signorini_certify::curved::followed;
use signorini_certify::exact::{Distance, distance};
use signorini_certify::{CertifiedFields, ErrorBound};
use signorini_condense::{CondensedModel, Recovery, condense, recoverable};
use signorini_problem::fixtures::{
    EVERY_INPUT, PARABOLA, SMOOTH, distorted, on_grid, scatter, scene, with_four_sides,
};
use signorini_problem::{Problem, Sum};
use signorini_scene::error::Result;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_scene::mesh::{Curve, Mesh};
use signorini_scene::scene::{Exact, Field, Scene};
use signorini_scene::setting::ModelKind;
use signorini_session::tick::{ScheduledTick, replay};
use signorini_solve::energy_norm::nonconformity;
use signorini_solve::fixtures::full_at;
use signorini_solve::norms::errors;
use signorini_solve::{Options, ScalarKind, solve};

/// The text of a scene of the catalogue.
fn catalogue(file: &str) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../meshes/catalogue");
    std::fs::read_to_string(folder.join(format!("{file}.toml"))).expect("a scene")
}

struct Model {
    scene: Scene,
    problem: Problem,
    condensate: CondensedModel,
    recovery: Recovery,
}

impl Model {
    fn new(text: &str, mesh: Mesh) -> Result<Self> {
        let (scene, problem) = on_grid(text, mesh)?;
        let (condensate, recovery) = recoverable(&problem)?;
        Ok(Self { scene, problem, condensate, recovery })
    }

    fn catalogue(file: &str, mesh: Mesh) -> Result<Self> {
        Self::new(&catalogue(file), mesh)
    }

    fn exact(&self) -> &Exact {
        self.scene.exact.as_ref().expect("an exact solution")
    }

    /// s and the mended τ of (p, x).
    fn fields(&self, p: &[f64], x: &[f64]) -> CertifiedFields {
        let answer = self.recovery.admissible(&self.condensate, &self.problem, p, x);
        answer.expect("a certificate")
    }

    /// The distance of s and the mended τ of (p, x).
    fn distance(&self, p: &[f64], x: &[f64]) -> Result<Distance> {
        distance(self.exact(), &self.problem, &self.fields(p, x).admissible())
    }

    /// `bound` is no less than the distance and the identity of (p, x).
    fn check_bound(&self, what: &str, p: &[f64], x: &[f64], bound: f64) -> Result<()> {
        let found = self.distance(p, x)?;
        GUARANTEE.check_at_most(what, found.combined, bound);
        IDENTITY_BOUNDED.check_at_most(what, found.identity, bound);
        Ok(())
    }

    /// x after some sweeps of projected Gauss–Seidel from nothing.
    fn swept(&self, p: &[f64], sweeps: usize) -> Vec<f64> {
        let n = self.condensate.contact;
        let mut x = vec![0.0; n];
        for _ in 0..sweeps {
            for i in 0..n {
                let residual = self.condensate.residual(p, &x);
                x[i] = (x[i] - residual[i]).max(0.0);
            }
        }
        x
    }

    /// The bound for u_h of (p, x) is the other one and the distance of s from u_h, or more, and it bounds.
    fn check_bound_of_u(&self, p: &[f64], x: &[f64]) -> Result<()> {
        let (u, flux) = self.recovery.field(&self.condensate, p, x);
        let energy = errors(self.exact(), &self.problem, &u, &flux)?.energy;
        let jump = nonconformity(&self.problem, &self.fields(p, x).admissible(), &u)?;
        let bound = self.condensate.bound(p, x).expect("a bound");
        let of_u = self.condensate.bound_of_u(p, x).expect("a bound");
        GUARANTEE.check_at_most("energy", energy, of_u);
        let form = self.condensate.certificate.as_ref().expect("a form");
        match form.jump {
            Some(_) => {
                // The gradient of a lift has no limit at the opposite vertex.
                JUMP.check_relative("of u, less the bound", of_u - bound, jump);
            }
            None => JUMP.check_at_most("of u, less the bound", jump, of_u - bound),
        }
        Ok(())
    }

    /// Energy error of u_h, combined error, identity, and the bound at the solution.
    fn at_solution(&self) -> Result<[f64; 4]> {
        let p = &self.condensate.defaults;
        let x = self.condensate.solve(p).expect("a solution");
        let bound = self.condensate.bound(p, &x).expect("a bound");
        let (problem, solution, _) = full_at(&self.problem, p)?;
        let energy = errors(self.exact(), &problem, &solution.u, &solution.flux)?.energy;
        let found = self.distance(p, &x)?;
        self.check_bound_of_u(p, &x)?;
        Ok([energy, found.combined, found.identity, bound])
    }
}

#[test]
fn sharp_at_convergence() -> Result<()> {
    let meshes = [Cells::Triangles, Cells::Quads].map(|cells| [8, 16].map(|n| (cells, n)));
    let files = ["h-tri", "j100-tri", "a-tri", "hg-tri", "t-h-tri"].into_iter();
    let all = files.flat_map(|file| meshes.into_iter().flatten().map(move |on| (file, on)));
    for (file, (cells, n)) in some(3, all) {
        let model = Model::catalogue(file, grid(n, cells))?;
        let [energy, combined, _, bound] = model.at_solution()?;
        GUARANTEE.check_at_most(format_args!("{file} {cells:?} {n}"), combined, bound);
        assert!(bound <= 1.05 * combined || file == "a-tri", "{file} {cells:?} {n}");
        assert!(bound <= 2.2 * energy || file == "t-h-tri", "{file} {cells:?} {n}");
    }
    Ok(())
}

/// Without oscillation the bound is the identity, to the quadrature of the exact solution.
#[test]
fn the_bound_is_the_identity() -> Result<()> {
    for file in ["h-tri", "hg-tri"] {
        for mesh in [grid(6, Cells::Mixed), distorted(grid(6, Cells::Quads))] {
            let [_, _, identity, bound] = Model::catalogue(file, mesh)?.at_solution()?;
            IDENTITY_KINKED.check_relative(file, bound, identity);
        }
    }
    Ok(())
}

/// Robin, Neumann, full tensor, curved gap and value, corners: the gap, as osc comes on top.
#[test]
fn every_term_for_a_smooth_solution() -> Result<()> {
    for mesh in [grid(6, Cells::Triangles), grid(6, Cells::Quads), distorted(grid(6, Cells::Mixed))]
    {
        let mut model = Model::new(SMOOTH, mesh)?;
        let form = model.condensate.certificate.as_mut().expect("a certificate");
        let oscillation = std::mem::replace(&mut form.oscillation, vec![0.0]);
        assert!(oscillation[0] > 0.0);
        let [_, _, identity, gap] = model.at_solution()?;
        IDENTITY.check_relative("every term", gap, identity);
        model.condensate.certificate.as_mut().expect("a certificate").oscillation = oscillation;
        let [_, combined, _, bound] = model.at_solution()?;
        assert!(bound >= combined && bound > gap);
    }
    Ok(())
}

/// Sweeps from nothing, and x that has nothing to do with the solution.
#[test]
fn of_any_iterate() -> Result<()> {
    for file in some(2, ["h-tri", "j100-tri", "hg-tri"]) {
        for cells in [Cells::Triangles, Cells::Quads] {
            let model = Model::catalogue(file, grid(6, cells))?;
            let p = &model.condensate.defaults;
            let wild: Vec<f64> =
                (0..model.condensate.contact).map(|i| scatter(i).max(0.0)).collect();
            let swept = [0, 1, 2, 4, 8, 16].map(|sweeps| model.swept(p, sweeps));
            for x in swept.into_iter().chain([wild]) {
                let bound = model.condensate.bound(p, &x).expect("a bound");
                model.check_bound_of_u(p, &x)?;
                model.check_bound(&format!("{file} {cells:?}"), p, &x, bound)?;
            }
        }
    }
    Ok(())
}

/// u = −y(2 + x), held by contact alone.
const HELD_BY_CONTACT: &str = r#"
mesh = "grid"
material.default.conductivity = "1"
boundary.dirichlet = { kind = "neumann", flux = "-(2 + x)" }
boundary.left = { kind = "neumann", flux = "y" }
boundary.right = { kind = "neumann", flux = "-y" }
boundary.contact = { kind = "contact" }
exact = { u = "-y*(2 + x)", gradient = ["-y", "-(2 + x)"] }
"#;

#[test]
fn of_a_part_that_contact_alone_holds() -> Result<()> {
    for cells in [Cells::Triangles, Cells::Quads] {
        let model = Model::new(HELD_BY_CONTACT, grid(5, cells))?;
        let p = &model.condensate.defaults;
        let form = model.condensate.certificate.as_ref().expect("a certificate");
        assert!(!form.floating.is_empty());
        let n = model.condensate.contact;
        let some = |amount: f64| (0..n).map(move |i| (amount * scatter(i)).max(0.0)).collect();
        for x in [vec![0.0; n], some(1e-3), some(0.1), some(-1.0)] {
            let bound = model.condensate.bound(p, &x).expect("a bound");
            let found = model.distance(p, &x)?;
            assert!(bound >= found.combined && bound >= found.identity, "{bound} {found:?}");
        }
        assert_eq!(model.condensate.bound(p, &vec![1.0; n]), None, "no way out");
    }
    Ok(())
}

/// A tick in f32, cut off after the gap has moved or led to the end: its total is above the true error.
#[test]
fn of_a_tick_in_f32() -> Result<()> {
    let catalogue = ["h-tri", "j100-tri", "hg-tri"].map(catalogue);
    let drop =
        "[input.drop]\nof = \"contact\"\nfield = \"gap\"\npattern = \"-0.2\"\ndefault = 1.0\n";
    let own = [HELD_BY_CONTACT, SMOOTH].map(str::to_owned);
    let works = [(Some(100), 0), (Some(1), 0), (Some(3), 2), (None, 1), (None, 6)];
    let mut cut_off = 0;
    for text in catalogue.into_iter().chain(own) {
        for cells in [Cells::Triangles, Cells::Quads] {
            let mut model = Model::new(&(text.clone() + drop), grid(5, cells))?;
            // The exact solution is that of the gap as it was.
            model.problem = model.problem.with_inputs(&[0.0])?;
            for (pivots, sweeps) in works {
                let work = Work { pivots, sweeps };
                let baked = Baked::<f32>::new(&model.condensate, work, true).expect("in range");
                let mut controller = Controller::new(&baked);
                let (_, report) = controller.tick(&[0.0]).expect("a tick");
                let x: Vec<f64> = controller.x().iter().map(|&x| f64::from(x)).collect();
                let Some(&bound) = report.certificate() else { continue };
                let what = format!("{cells:?} {work:?}");
                model.check_bound(&what, &[1.0, 0.0], &x, bound.total.into())?;
                cut_off += usize::from(bound.algebraic > 0.1 * bound.duality_gap);
            }
        }
    }
    assert!(cut_off > 10, "{cut_off}");
    Ok(())
}

/// A corner whose u_D lies above ψ is felt where its edge touches.
#[test]
fn an_input_that_lifts_the_corner() -> Result<()> {
    let (_, problem) = on_grid(EVERY_INPUT, grid(4, Cells::Triangles))?;
    let condensate = condense(&problem)?;
    let form = condensate.certificate.as_ref().expect("a certificate");
    assert!(form.corners.is_empty(), "the sides are Robin and Neumann");
    // With u_D all round.
    let sides = "boundary.left boundary.right input.wind input.pull output.right output.left";
    let of_sides = |line: &&str| !sides.split(' ').any(|name| line.starts_with(name));
    let text: String = EVERY_INPUT.lines().filter(of_sides).flat_map(|line| [line, "\n"]).collect();
    let (_, problem) = on_grid(&text, grid(4, Cells::Triangles))?;
    let condensate = condense(&problem)?;
    let form = condensate.certificate.as_ref().expect("a certificate");
    assert_eq!(form.corners.len(), 2);
    // u_D = 0.3 + 0.1 sin(3x) and ψ = 0.35 − 0.4x² + 0.1x³ at x = ±1; level adds 1 + 0.5x, depth nothing.
    for corner in &form.corners {
        let d = condensate.opening[corner.edge];
        let x = (corner.excess[3] * d - 1.0) / 0.5;
        CORNER.check("x", x.abs() - 1.0);
        let base = 0.35 + 0.1 * (3.0 * x).sin() - 0.1 * x;
        CORNER.check("level and source", corner.excess[0] * d - base);
        CORNER.check("level and source", corner.excess[1]);
    }
    let mut sunk = condensate.defaults.clone();
    sunk[3] = -2.0;
    assert_eq!(condensate.bound(&sunk, &vec![0.0; condensate.contact]), None);
    Ok(())
}

/// One part held by contact alone beside one that its sides hold: y > 2, where nothing touches the first.
const BESIDE: &str = r#"
mesh = "grid"
material.default.conductivity = "1"
boundary.dirichlet = { kind = "neumann", flux = "-(2 + x)" }
boundary.left = { kind = "neumann", flux = "y - 3*max(0, y - 1.5)" }
boundary.right = { kind = "neumann", flux = "-y + 3*max(0, y - 1.5)" }
boundary.contact = { kind = "contact", gap = "0" }
boundary.held = { kind = "dirichlet", value = "0" }
boundary.above = { kind = "contact", gap = "0", flux = "-1" }
"#;

/// `grid` twice, the second time 2 higher: its bottom is `above`, the other sides are `held`.
fn two_parts(n: u32, cells: Cells) -> Mesh {
    let mut mesh = with_four_sides(grid(n, cells));
    let upper = mesh.clone();
    let shift = mesh.vertices.len() as u32;
    mesh.vertices.extend(upper.vertices.iter().map(|[x, y]| [*x, y + 2.0]));
    mesh.triangles.extend(upper.triangles.iter().map(|cell| cell.map(|vertex| vertex + shift)));
    mesh.quads.extend(upper.quads.iter().map(|cell| cell.map(|vertex| vertex + shift)));
    for curve in upper.curves {
        let name = if curve.name == "contact" { "above" } else { "held" };
        let edges = curve.edges.iter().map(|edge| edge.map(|vertex| vertex + shift));
        match mesh.curves.iter_mut().find(|known| known.name == name) {
            Some(known) => known.edges.extend(edges),
            None => mesh.curves.push(Curve { name: name.to_owned(), edges: edges.collect() }),
        }
    }
    mesh
}

#[test]
fn of_one_part_held_by_contact_alone_among_others() -> Result<()> {
    for cells in [Cells::Triangles, Cells::Quads] {
        let problem = Problem::new(&scene(BESIDE)?, two_parts(4, cells))?;
        let (condensate, _) = recoverable(&problem)?;
        let alone = Model::new(HELD_BY_CONTACT, grid(4, cells))?;
        let form = condensate.certificate.as_ref().expect("a certificate");
        assert_eq!(form.floating.len(), alone.condensate.contact);
        let p = &condensate.defaults;
        let n = condensate.contact;
        // At the solution the parts add up: that above is u = 0, whose bound is that of q alone.
        let x = condensate.solve(p).expect("a solution");
        let bound = condensate.bound(p, &x).expect("a bound");
        let of_alone = alone.condensate.solve(&[1.0]).expect("a solution");
        let known = alone.condensate.bound(&[1.0], &of_alone).expect("a bound");
        SAME_BOUND.check_relative(format_args!("{cells:?}, in two parts"), bound, known);
        // Cut off in both parts: a bound, as long as something touches in the first.
        let some: Vec<f64> = (0..n).map(|i| (0.1 * scatter(i)).max(0.0)).collect();
        let wide = condensate.bound(p, &some).expect("a bound");
        assert!(wide > bound, "{wide} {bound}");
        let is_floating = |i| f64::from(u8::from(form.floating.contains(&i)));
        let open: Vec<f64> = (0..n).map(is_floating).collect();
        assert_eq!(condensate.bound(p, &open), None, "no way out");
        let mut above: Vec<f64> = vec![1.0; n];
        form.floating.iter().for_each(|&i| above[i] = 0.0);
        assert!(condensate.bound(p, &above).is_some(), "the other part has its sides");
        let baked = exact::<f64>(&problem)?;
        let (_, report) = Controller::new(&baked).tick(&[]).expect("a tick");
        let total = report.certificate().expect("a bound").total;
        SAME_BOUND.check_relative(format_args!("{cells:?}, baked"), total, bound);
    }
    Ok(())
}

/// Where the defaults make everything 0, the units are those of the inputs: what a large one makes stays in range, in either model.
#[test]
fn of_a_large_input_after_defaults_of_zero() -> Result<()> {
    let text = "mesh = \"grid\"\n[material.default]\nconductivity = \"1e-9\"\n[boundary.dirichlet]\nkind = \"dirichlet\"\n\
                value = \"0\"\n[boundary.contact]\nkind = \"contact\"\n[input.heat]\nof = \"source\"\nfield = \"f\"\n\
                pattern = \"1e9*x\"\n[output.bound]\nkind = \"bound\"\n";
    let (_, problem) = on_grid(text, grid(4, Cells::Triangles))?;
    let (small, large) = (exact::<f32>(&problem)?, full::Baked::<f32>::new(&problem)?);
    for heat in [1.0_f32, 1e6, -1e6, 1e10, 1e12] {
        let (_, report) = Controller::new(&small).tick(&[heat]).expect("a tick");
        let mut bounds = vec![report.certificate().copied()];
        if heat < 1e12 {
            let mut controller = full::Controller::<f32>::new(&large);
            let (_, report) = controller.tick_within(&[heat], to_the_end()).expect("a tick");
            bounds.push(report.verdict.certificate().copied());
        }
        for bound in bounds.into_iter().map(|of| of.expect("a bound").total) {
            assert!(bound.is_finite() && bound > 0.0, "{heat}: {bound}");
        }
    }
    Ok(())
}

/// A kink inside contact edges is integrated where it is, and a jump there has no bound.
#[test]
fn of_gaps_with_kinks_and_jumps() -> Result<()> {
    let smooth = "gap = \"0.35 - 0.4*x^2 + 0.1*x^3\"";
    let with = |gap: &str| EVERY_INPUT.replace(smooth, &format!("gap = \"{gap}\""));
    for gap in ["sign(x - 0.3)", "0.01/abs(x - 0.3)", "abs(x - 0.3)^0.1"] {
        let model = Model::new(&with(gap), grid(3, Cells::Triangles))?;
        let reason = model.condensate.certificate.expect_err(gap);
        assert!(reason.contains("boundary.contact near (0.3, 0)"), "{gap}: {reason}");
    }
    Ok(())
}

#[test]
fn the_bound_is_the_identity_for_a_gap_with_a_kink() -> Result<()> {
    let text = PARABOLA
        .replace("20 + 1e6*y", "y^2 - x^2 + 1")
        .replace("\"-x^2\"", "\"-0.5 - 30*max(0, x - 0.85)\"")
        + "[exact]\nu = \"y^2 - x^2 + 1\"\ngradient = [\"-2*x\", \"2*y\"]\n";
    for cells in [Cells::Triangles, Cells::Quads] {
        // Without what panels may miss, which is added to the oscillation.
        let mut model = Model::new(&text, grid(4, cells))?;
        model.condensate.certificate.as_mut().expect("a certificate").oscillation = vec![0.0];
        let [_, _, identity, gap] = model.at_solution()?;
        IDENTITY_KINKED.check_relative(format_args!("{cells:?}"), gap, identity);
    }
    Ok(())
}

/// Where all contact edges at a vertex are open for every input, s is free there, and follows no curve between two such vertices: the
/// bound is sharper, is still the identity, and holds for whatever a tick leaves unfinished.
#[test]
fn where_nothing_touches_s_follows_no_curve() -> Result<()> {
    let input = "\n[input.depth]\nof = \"contact\"\nfield = \"gap\"\npattern = \"1\"\ndefault = 0.0\nrange = [-0.002, 0.002]\n";
    for cells in [Cells::Triangles, Cells::Quads] {
        let mut plain = Model::catalogue("hg-tri", grid(16, cells))?;
        plain.scene = scene(&(catalogue("hg-tri") + input))?;
        let problem = Problem::new(&plain.scene, grid(16, cells))?;
        let choice = Choice::<f64>::new(&problem, Wanted::model(ModelKind::Condensed))?;
        let (_, origin) = choice.condensed().expect("a condensed model");
        let (model, p) = (origin.model(), &origin.whole.defaults);
        let of_plain = plain.condensate.solve(&[1.0]).expect("a solution");
        let of_plain = plain.condensate.bound(&[1.0], &of_plain).expect("a bound");
        let solution = model.solve(p).expect("a solution");
        let limits = model.limits.clone();
        let clamped = |x: Vec<f64>| -> Vec<f64> {
            x.into_iter().zip(&limits).map(|(x, [lo, hi])| x.clamp(*lo, *hi)).collect()
        };
        let halved = clamped(solution.iter().map(|x| 0.5 * x).collect());
        let nothing = clamped(vec![0.0; solution.len()]);
        for (at, x) in [solution, halved, nothing].into_iter().enumerate() {
            let bound = model.bound(p, &x).expect("a bound");
            let whole = origin.expand(p, x);
            let answer = origin.recovery.admissible(&origin.whole, &problem, p, &whole);
            let answer = answer.expect("a certificate");
            assert!(matches!(&answer.following, Following::Except(edges) if edges.len() > 2));
            let s = answer.admissible();
            let found = distance(plain.exact(), &problem, &s)?;
            GUARANTEE.check_at_most(format_args!("{cells:?} {at}"), found.combined, bound);
            if at == 0 {
                assert!(bound < of_plain && bound < 1.02 * found.combined, "{cells:?}");
            }
            let deviations = followed(&problem, &s)?;
            for edge in problem.topology.counts.free..problem.topology.counts.unknowns() {
                let gap = Sum::on_edge(&problem, edge, Field::Gap).expect("a gap");
                let [a, b] = problem.segment(edge);
                for k in 0..=64 {
                    let t = f64::from(k) / 64.0;
                    let psi = gap.at(a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]));
                    let s = s.on_edge(&problem, edge, deviations.on(edge), t)?;
                    let what = format!("{cells:?} {at} {edge} {t}");
                    GUARANTEE.check_at_most(what, psi + 1.0, s + 1.0);
                }
            }
        }
    }
    Ok(())
}

/// Waves that an input bends the gap by, beside a curved u_D in one triangle: their product has twice as many.
#[test]
fn waves_beside_a_curved_value_are_bounded() -> Result<()> {
    let u = "y + 0.3*y^2";
    for waves in ["12*x + 1", "18*x + 3", "31*x + 4.8"] {
        let text = PARABOLA
            .replace("f = \"0\"", "f = \"-0.6\"")
            .replace("20 + 1e6*y", u)
            .replace("gap = \"-x^2\"", &format!("gap = \"{u} - 1.1\", flux = \"-1\""))
            + &format!(
                "[input.p]\nof = \"contact\"\nfield = \"gap\"\npattern = \"sin({waves})\"\ndefault = 0\nrange = [-1, 1]\n\
                 [exact]\nu = \"{u}\"\ngradient = [\"0\", \"1 + 0.6*y\"]\n"
            );
        let (_, problem) = on_grid(&text, grid(1, Cells::Triangles))?;
        // Nowhere is s clear of such a gap. A solve integrates each curve by panels of its own: nearly all of both
        // bounds is what the curves cost.
        let model = replayed(&problem, &[-1.0, 1.0], Some(ScalarKind::F64), WAVES)?;
        assert!(model.contains("condensed"), "{model}");
    }
    Ok(())
}

/// Compares the bounds of a controller's ticks with those of solves; its name.
fn replayed(
    problem: &Problem,
    inputs: &[f64],
    scalar: Option<ScalarKind>,
    allowed: Tolerance,
) -> Result<String> {
    let moment = |(at, p): (usize, &f64)| ScheduledTick { time: at as f64, inputs: vec![(0, *p)] };
    let moments: Vec<_> = inputs.iter().enumerate().map(moment).collect();
    let (model, ticks) = replay(problem, &moments, (scalar, false), |_, _| Ok(()))?;
    for (tick, p) in ticks.iter().zip(inputs) {
        let solved = solve(&problem.with_inputs(&[*p])?, &Options::default())?;
        let bound = |found: Option<ErrorBound>| found.expect("a bound").total;
        allowed.check_relative(format_args!("p = {p}"), bound(tick.bound), bound(solved.bound));
    }
    Ok(model)
}

/// An input that takes back what the gap has above its chords: the sum of both bends nothing where it is 1.
#[test]
fn an_input_may_take_back_a_curve_of_the_gap() -> Result<()> {
    let text = PARABOLA.replace("20 + 1e6*y", "1 + y").replace("\"-x^2\"", "\"x^2 - 1\"")
        + "[input.p]\nof = \"contact\"\nfield = \"gap\"\npattern = \"1 - x^2\"\ndefault = 0\nrange = [-1, 1]\n\
           [setting]\nmodel = \"full\"\nsolver = \"factor\"\nscalar = \"f64\"\n";
    let (_, problem) = on_grid(&text, grid(3, Cells::Quads))?;
    let model = replayed(&problem, &[-1.0, -0.2, 0.0, 0.3, 1.0], None, SAME_BOUND)?;
    assert!(model.contains("factor"), "{model}");
    Ok(())
}

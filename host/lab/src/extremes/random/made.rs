//! Scenes made for a solution that was chosen: whatever u, A and p are, with
//! ```text
//!   f = −∇·(A∇u),   u_D = u,   g = σ·n,   u_ext = u + σ·n/h,   ψ = u − max(p, 0),   q = σ·n − max(−p, 0)
//! ```
//! u solves the problem, and contact is where p ≤ 0: kinked gaps and loads, curved ones, or none at all. Where the flux has
//! two ends, u is above the gap for p > c, below it for p < −c, and at it between them, with any flux from one end to the other.

use std::f64::consts::PI;
use std::fmt::Write;

use super::function::{Function, Rough};
use super::mesh::{self, Drawn, MeshPlan, Outline, Regions};
use super::posed::{self, Ends, Hold, Posed, span};
use signorini_problem::random::Random;

/// u with ∇u, σ = A∇u and f as texts, and the materials.
struct Chosen {
    u: String,
    gradient: [String; 2],
    flux: [String; 2],
    f: String,
    materials: String,
}

pub(super) fn draw(random: &mut Random, plan: &MeshPlan) -> Posed {
    let contrast = random.chance(0.4);
    let plan = match contrast {
        // On a side along x = 0 the expressions below would be those of neither half.
        true => MeshPlan { regions: Regions::Halves, outline: Outline::Whole, ..*plan },
        false => MeshPlan { map: turned(random), ..*plan },
    };
    let drawn = mesh::draw(random, &plan);
    let steepest = random.pick(&[1.5, 1.5, 3.0, 8.0]);
    let chosen = if contrast { halves(random, steepest) } else { uniform(random, steepest) };
    let Chosen { u, gradient: [ux, uy], f, materials, .. } = &chosen;
    let mut scene = format!("title = \"made\"\nmesh = \"mesh.msh\"\n{materials}");
    let _ = writeln!(scene, "[source]\nf = \"{f}\"");
    let hold = boundaries(random, &drawn, &chosen, steepest, &mut scene);
    let _ = writeln!(scene, "[exact]\nu = \"{u}\"\ngradient = [\"{ux}\", \"{uy}\"]");
    Posed { scene, mesh: drawn.mesh, hold, inputs: Vec::new() }
}

/// Turned and sheared, with a positive determinant.
fn turned(random: &mut Random) -> [[f64; 2]; 2] {
    if random.chance(0.6) {
        return [[1.0, 0.0], [0.0, 1.0]];
    }
    let (sin, cos) = random.between(0.0, 2.0 * PI).sin_cos();
    let [stretch, lean] = [random.log(0.3, 3.0), random.between(-0.7, 0.7)];
    [[stretch * cos, lean * cos - sin], [stretch * sin, lean * sin + cos]]
}

/// A = a(x, y) T with a symmetric T: ∇·(A∇u) = a T:∇∇u + T∇u·∇a.
fn uniform(random: &mut Random, steepest: f64) -> Chosen {
    let u = Function::draw(random, 1.0, Rough::Smooth, steepest);
    let [p, q] = [random.log(0.1, 10.0), random.log(0.1, 10.0)];
    let size = if random.chance(0.2) { random.log(1e-10, 1e10) } else { 1.0 };
    let along = random.between(0.0, PI).sin_cos();
    let [xx, xy, yy] = posed::turned([p, q], along).map(|entry| size * entry);
    // a = exp(b·x), ∇a = a b.
    let [b, c] = match random.chance(0.3) {
        true => [random.between(-1.0, 1.0), random.between(-1.0, 1.0)],
        false => [0.0; 2],
    };
    let a = format!("exp({b:e}*x+{c:e}*y)");
    let times = |text: String| if [b, c] == [0.0; 2] { text } else { format!("{a}*{text}") };
    let gradient = [u.slope(0), u.slope(1)];
    let [ux, uy] = &gradient;
    let flux =
        [times(format!("({xx:e}*{ux}+{xy:e}*{uy})")), times(format!("({xy:e}*{ux}+{yy:e}*{uy})"))];
    let [along, across] = [xx * b + xy * c, xy * b + yy * c];
    let mut f = format!("{xx:e}*{}+{:e}*{}", u.second([0, 0]), 2.0 * xy, u.second([0, 1]));
    let _ = write!(f, "+{yy:e}*{}", u.second([1, 1]));
    if [b, c] != [0.0; 2] {
        let _ = write!(f, "+{along:e}*{ux}+{across:e}*{uy}");
    }
    let entries = [xx, xy, yy].map(|entry| format!("\"{}\"", times(format!("{entry:e}"))));
    Chosen {
        u: u.value(),
        gradient: gradient.clone(),
        flux,
        f: format!("-{}", times(format!("({f})"))),
        materials: format!("[material.default]\nconductivity = [{}]\n", entries.join(", ")),
    }
}

/// A = k left of x = 0 and 1 right of it; u = F(y) + X G(y) with X = x/k left and x right: σ₁ = G on both sides.
fn halves(random: &mut Random, steepest: f64) -> Chosen {
    let k = random.log(1e-10, 1e10);
    let [one, other] = [0, 1].map(|_| Function::draw_along(random, 1, steepest));
    let [right, left] = ["(0.5+0.5*sign(x))", "(0.5-0.5*sign(x))"];
    let a = format!("({right}+{k:e}*{left})");
    let slope = format!("({right}+{left}/{k:e})");
    let (g, gy) = (other.value(), other.slope(1));
    // On the stiff side F is divided by k, or the energy there would drown all else.
    let share = if k > 1.0 { 1.0 / k } else { 1.0 };
    let one = if random.chance(0.7) { one.times(share) } else { one };
    let (f, fy) = (one.value(), one.slope(1));
    Chosen {
        u: format!("{f}+x*{slope}*{g}"),
        gradient: [format!("{slope}*{g}"), format!("{fy}+x*{slope}*{gy}")],
        flux: [g.clone(), format!("({a}*{fy}+x*{gy})")],
        f: format!("-({a}*{}+x*{})", one.second([1, 1]), other.second([1, 1])),
        materials: format!(
            "[material.left]\nconductivity = \"{k:e}\"\n[material.right]\nconductivity = \"1\"\n"
        ),
    }
}

fn boundaries(
    random: &mut Random,
    drawn: &Drawn,
    chosen: &Chosen,
    steepest: f64,
    scene: &mut String,
) -> Hold {
    let held = random.below(10);
    let mut hold = Hold::Contact;
    let rough = random.pick(&[Rough::Smooth, Rough::Kinked]);
    for (curve, [nx, ny]) in drawn.mesh.curves.iter().zip(&drawn.normals) {
        let u = &chosen.u;
        let flux = format!("({nx:e}*{}+{ny:e}*{})", chosen.flux[0], chosen.flux[1]);
        let body = match (held, random.below(6)) {
            (0..6, 0..2) => {
                hold = Hold::Dirichlet;
                format!("kind = \"dirichlet\"\nvalue = \"{u}\"")
            }
            (0..8, 2) => {
                hold = if hold == Hold::Contact { Hold::Robin } else { hold };
                let h = random.log(1e-4, 1e4);
                let ambient = format!("{u}+{flux}/{h:e}");
                format!("kind = \"robin\"\ncoefficient = \"{h:e}\"\nambient = \"{ambient}\"")
            }
            (_, 3) => format!("kind = \"neumann\"\nflux = \"{flux}\""),
            _ => {
                let p = Function::draw(random, 1.0, rough, steepest).value();
                format!("kind = \"contact\"\n{}", contact(random, u, &flux, &p))
            }
        };
        let _ = writeln!(scene, "[boundary.{}]\n{body}", curve.name);
    }
    hold
}

/// Contact on which p decides whether u is above, at or below the gap.
fn contact(random: &mut Random, u: &str, flux: &str, p: &str) -> String {
    match Ends::draw(random) {
        Ends::Above => format!("gap = \"{u}-max({p},0)\"\nflux = \"{flux}-max(-{p},0)\""),
        Ends::Below => {
            format!("gap = \"{u}+max({p},0)\"\nflux = \"-inf\"\nlimit = \"{flux}+max(-{p},0)\"")
        }
        Ends::Both => {
            // At the gap for |p| ≤ c.
            let c = if random.chance(0.3) { 0.0 } else { random.log(0.01, 1.0) };
            let [down, up] = [(); 2].map(|()| span(random));
            format!(
                "gap = \"{u}-max({p}-{c:e},0)+max(-{p}-{c:e},0)\"\n\
                 flux = \"{flux}-{down:e}*max({c:e}-{p},0)\"\nlimit = \"{flux}+{up:e}*max({p}+{c:e},0)\""
            )
        }
    }
}

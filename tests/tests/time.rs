//! Steps in time against exact solutions whose contact opens, closes and travels: rates in h and dt.

use std::path::Path;

use signorini_problem::{Problem, State};
use signorini_scene::error::Result;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_scene::scene::Scene;
use signorini_session::with_session;
use signorini_solve::norms::errors;
use signorini_tolerances::twins::STORED;

/// An exact solution u of c = A = 1 with u ≥ 0 and a flux ≥ 0 on y = 0, and its source.
struct Exact {
    u: String,
    f: String,
}

/// All of the contact boundary changes sides at t = ½.
fn breathing() -> Exact {
    let (s, open) = ("sin(2*pi*t)", "(1 + sign(sin(2*pi*t)))/2");
    let (above, below) = ("(1-y)^2*(1+2*y)", "y*(1-y)^2");
    Exact {
        u: format!("max({s},0)*{above} + min({s},0)*{below}"),
        f: format!(
            "2*pi*cos(2*pi*t)*({open}*{above} + (1 - {open})*{below}) - max({s},0)*(12*y - 6) - min({s},0)*(6*y - 4)"
        ),
    }
}

/// The front of contact travels to the right with speed 1, without a source.
fn travelling() -> Exact {
    let xi = "(x + 0.3 - t)";
    let r = format!("sqrt({xi}^2 + y^2)");
    let (sigma, tau2) = (format!("sqrt(max(({r} + {xi})/2, 0))"), format!("(({r} - {xi})/2)"));
    let f = format!("((1 + 2*{sigma}^2)*erf({sigma}) + 2/sqrt(pi)*{sigma}*exp(-{sigma}^2))");
    Exact { u: format!("{f}*(1 - 2*{tau2}) - 2*erf({sigma})"), f: "0".to_owned() }
}

/// The end of contact oscillates along the boundary.
fn oscillating() -> Exact {
    let x = "(x - 0.3*sin(2*pi*t))";
    let (r2, theta) = (format!("({x}^2 + y^2)"), format!("atan2(y, {x})"));
    Exact {
        u: format!("-({r2}^0.75*sin(1.5*{theta}))"),
        f: format!("0.9*pi*cos(2*pi*t)*{r2}^0.25*sin(0.5*{theta})"),
    }
}

/// The largest ‖u − u_h‖ at the ends of the steps of length `dt` up to `end`, from the exact u at the start.
fn largest_error(exact: &Exact, (n, cells): (u32, Cells), dt: f64, end: f64) -> Result<f64> {
    let Exact { u, f } = exact;
    let text = format!(
        "mesh = \"grid\"\n[material.default]\nconductivity = 1\ncapacity = 1\n[source]\nf = \"{f}\"\n\
         [boundary.dirichlet]\nkind = \"dirichlet\"\nvalue = \"{u}\"\n[boundary.contact]\nkind = \"contact\"\n\
         [setting]\ncertificate = false\nmodel = \"full\"\n[exact]\nu = \"{u}\"\ngradient = [0, 0]\n"
    );
    let scene = Scene::parse(&text, Path::new("time.toml"))?;
    let mut problem = Problem::new(&scene, grid(n, cells))?;
    let exact = scene.exact.clone().expect("it is stated");
    let mean = |edge: usize| {
        let points = signorini_problem::quadrature::gauss(8);
        let of = |[t, weight]: &[f64; 2]| {
            let [x, y] = problem.along(edge, *t);
            weight * exact.u.value.eval(x, y, 0.0)
        };
        points.iter().map(of).sum::<f64>()
    };
    let start: Vec<f64> = (0..problem.ends.len()).map(mean).collect();
    problem = problem.stepping(dt, State { u: start, ..State::default() })?;
    let mut largest = 0.0_f64;
    let posed = problem.clone();
    with_session(&posed, |session| {
        for step in 1..=(end / dt).round() as u32 {
            problem.set_time(f64::from(step) * dt)?;
            session.play(&problem)?;
            let solution = session.answer(&problem)?;
            largest = largest.max(errors(&exact, &problem, &solution.u, &solution.flux)?.l2);
            problem.advance(solution.state());
        }
        Ok(())
    })?;
    Ok(largest)
}

/// The fluxes out of a cell add up to what it stores less ∫f.
#[test]
fn every_cell_is_in_balance() {
    for cells in [Cells::Triangles, Cells::Quads, Cells::Mixed] {
        let text = "mesh = \"grid\"\n[material.default]\nconductivity = [2, 0.5, 1]\ncapacity = \"1 + x^2\"\n[source]\nf = \"x - t\"\n\
             [boundary.dirichlet]\nkind = \"robin\"\ncoefficient = 2\nambient = \"y\"\n[boundary.contact]\nkind = \"contact\"\n\
             [setting]\ncertificate = false\nmodel = \"full\"\n";
        let scene = Scene::parse(text, Path::new("balance.toml")).unwrap();
        let problem = Problem::new(&scene, grid(4, cells)).unwrap();
        let start = vec![0.25; problem.ends.len()];
        let mut problem = problem.stepping(0.01, State { u: start, ..State::default() }).unwrap();
        let posed = problem.clone();
        with_session(&posed, |session| {
            for step in 1..=5 {
                problem.set_time(0.01 * f64::from(step))?;
                session.play(&problem)?;
                let solution = session.answer(&problem)?;
                let stored: f64 = problem.stored(0, &solution.u).iter().sum();
                let defect = solution.conservation_defect(&problem) * solution.largest_flux();
                STORED.check("balance", defect / stored.abs().max(1.0));
                problem.advance(solution.state());
            }
            Ok(())
        })
        .unwrap();
    }
}

fn rate([coarse, fine]: [f64; 2]) -> f64 {
    (coarse / fine).log2()
}

/// With dt ~ h² the error falls like h², on triangles and quads.
#[test]
fn errors_fall_like_the_square_of_h() {
    for (exact, until) in [(breathing(), 0.625), (travelling(), 0.5), (oscillating(), 0.125)] {
        for cells in [Cells::Triangles, Cells::Quads, Cells::Mixed] {
            let of = |n: u32| largest_error(&exact, (n, cells), 0.5 / f64::from(n * n), until);
            let all = [4, 8].map(|n| of(n).unwrap());
            println!("{cells:?}: {all:?}, rate {:.2}", rate(all));
            assert!(rate(all) > 1.85, "{cells:?}: {all:?}");
        }
    }
}

/// The implicit Euler method is of first order in dt, also where contact changes.
#[test]
fn errors_fall_like_dt() {
    for (exact, least) in [(breathing(), 0.9), (travelling(), 0.85)] {
        let of = |dt: f64| largest_error(&exact, (16, Cells::Triangles), dt, 0.75);
        let all = [0.125, 0.0625].map(|dt| of(dt).unwrap());
        println!("{all:?}, rate {:.2}", rate(all));
        assert!(rate(all) > least, "{all:?}");
    }
}

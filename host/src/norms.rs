//! Errors against an exact solution at the time of the problem, integrated with 16×16 Gauss points a cell.
//!
//! A lower rule comes out up to 0.5 % too small where the exact gradient has a kink.

use serde::Serialize;

use crate::certify::exact::{Distance, distance};
use crate::error::{Error, Result};
use crate::expression::Expression;
use crate::field::CellField;
use crate::problem::Problem;
use crate::quadrature::{Point, gauss, on_quad, on_triangle};
use crate::scene::{Exact, Located, Material, Scene};
use crate::solve::Solution;

/// Points a direction.
pub(crate) const POINTS: usize = 16;

/// Distances between the discrete and the exact solution.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Errors {
    /// Broken |u − u_h|₁
    pub h1: f64,
    /// ‖u − u_h‖
    pub l2: f64,
    /// ‖σ − σ_h‖
    pub flux: f64,
    /// ‖A^½ ∇_h(u − u_h)‖
    pub energy: f64,
    /// Distance of the error bound's S and τ to the solution, for whoever has them: see
    /// [`crate::certify::exact`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub combined: Option<f64>,
    /// What the bound should be, from the same place.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub identity: Option<f64>,
}

/// All errors of a solution, where the scene has an exact one.
///
/// # Errors
/// An exact solution that is not finite at a quadrature point.
pub fn of_solution(
    scene: &Scene,
    problem: &Problem,
    solution: &Solution,
) -> Result<Option<Errors>> {
    let Some(exact) = &scene.exact else { return Ok(None) };
    let errors = errors(scene, exact, problem, &solution.u, &solution.flux)?;
    if solution.bound.is_none() {
        return Ok(Some(errors));
    }
    Ok(Some(errors.with(distance(scene, exact, problem, &solution.certified.admissible())?)))
}

/// Integrates the errors of edge means `u` and edge fluxes `flux`.
///
/// # Errors
/// An exact solution that is not finite at a quadrature point.
pub fn errors(
    scene: &Scene,
    exact: &Exact,
    problem: &Problem,
    u: &[f64],
    flux: &[f64],
) -> Result<Errors> {
    let rule = gauss(POINTS);
    let corner = |vertex: u32| problem.mesh.vertices[vertex as usize];
    let triangles = problem.mesh.triangles.len();
    let mut sums = Errors::default();
    for cell in 0..triangles + problem.mesh.quads.len() {
        let field = CellField::new(problem, cell, u, flux);
        let material = &scene.materials[problem.binding.materials[cell] as usize];
        let mut add = |point: Point| {
            let exact = Values::at(scene, exact, material, point.x, problem.time)?;
            sums.add(&exact, &field, &point);
            Ok::<(), Error>(())
        };
        if cell < triangles {
            let corners = problem.mesh.triangles[cell].map(corner);
            on_triangle(corners, &rule).try_for_each(&mut add)?;
        } else {
            let corners = problem.mesh.quads[cell - triangles].map(corner);
            on_quad(corners, &rule).try_for_each(&mut add)?;
        }
    }
    let Errors { h1, l2, flux, energy, .. } = sums;
    let [h1, l2, flux, energy] = [h1, l2, flux, energy].map(f64::sqrt);
    Ok(Errors { h1, l2, flux, energy, ..Errors::default() })
}

/// u and ∇u of the exact solution at a point and a time.
///
/// # Errors
/// A value that is not finite.
pub(crate) fn exact_at(
    scene: &Scene,
    exact: &Exact,
    [x, y]: [f64; 2],
    time: f64,
) -> Result<(f64, [f64; 2])> {
    let value = |key: &Located<Expression>| {
        let value = key.value.eval(x, y, time);
        if value.is_finite() {
            return Ok(value);
        }
        let message = format!("not finite at ({x}, {y})");
        Err(Error::from(scene.error(key, message).hint("see [exact]")))
    };
    let [along_x, along_y] = &exact.gradient;
    Ok((value(&exact.u)?, [value(along_x)?, value(along_y)?]))
}

/// The exact solution and A at one point.
struct Values {
    u: f64,
    gradient: [f64; 2],
    tensor: [f64; 3],
}

impl Values {
    fn at(
        scene: &Scene,
        exact: &Exact,
        material: &Material,
        [x, y]: [f64; 2],
        time: f64,
    ) -> Result<Self> {
        let (u, gradient) = exact_at(scene, exact, [x, y], time)?;
        let tensor = material.conductivity.each_ref().map(|a| a.value.eval(x, y, 0.0));
        Ok(Self { u, gradient, tensor })
    }
}

impl Errors {
    /// With the distance of S and τ.
    #[must_use]
    pub fn with(self, Distance { combined, identity }: Distance) -> Self {
        Self { combined: Some(combined), identity: Some(identity), ..self }
    }

    /// Adds one point's squares.
    fn add(&mut self, exact: &Values, field: &CellField, point: &Point) {
        let ([ux, uy], [xx, xy, yy]) = (exact.gradient, exact.tensor);
        let sample = field.sample(point);
        let (ex, ey) = (ux - sample.gradient[0], uy - sample.gradient[1]);
        let (sx, sy) = (xx * ux + xy * uy, xy * ux + yy * uy);
        let weight = point.weight;
        self.h1 += weight * (ex * ex + ey * ey);
        self.l2 += weight * (exact.u - sample.u).powi(2);
        self.flux += weight * ((sx - sample.flux[0]).powi(2) + (sy - sample.flux[1]).powi(2));
        self.energy += weight * (xx * ex * ex + 2.0 * xy * ex * ey + yy * ey * ey);
    }
}

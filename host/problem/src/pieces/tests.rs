//! A is where its pieces say, in all of a cell, and integrals see what no rule of the cell does.

use super::*;
use crate::fixtures::{PARABOLA, distorted, on_grid};
use crate::quadrature::gauss;
use crate::random::Random;
use crate::tensors;
use signorini_kernel::Tensor;
use signorini_scene::error::Result;
use signorini_scene::mesh::structured::{Cells, grid};

/// Bumps and steps that 64 points of a cell do not see, waves, kinks, and an anisotropy that turns.
const FIELDS: [[&str; 3]; 10] = [
    ["0.3*(1 + 999*(1 + STEP))", "0.2*(1 + 999*(1 + STEP))", "0.4*(1 + 999*(1 + STEP))"],
    // From diag(100, 1) to the same turned by 45°, and a quotient.
    ["100 - 49.5*(0.5 + 0.5*STEP)", "49.5*(0.5 + 0.5*STEP)", "1 + 49.5*(0.5 + 0.5*STEP)"],
    ["3/(1 + 99*exp(-((x - 0.12)/0.004)^2))", "0.02", "1/(1 + 99*exp(-((x - 0.12)/0.004)^2))*2"],
    ["1 + 10*(0.5 + 0.5*sign(x - 0.002))", "0", "1 + 10*(0.5 + 0.5*sign(x - 0.002))"],
    ["1 + 1000*exp(-((x - 0.12)/0.004)^2)", "0", "1"],
    ["1 + 0.9*sin(16*x + 5*y)", "0", "2 + cos(16*x)"],
    ["1 + abs(x - 0.3*y - 0.1)", "0.1*y", "1 + x^2"],
    ["1 + 99*sin(x)^2", "99*sin(x)*cos(x)", "1 + 99*cos(x)^2"],
    ["1 + 100*(0.5 + 0.5*sign(x^2 + y^2 - 0.5))", "0", "1"],
    ["exp(x + y)", "0.2*exp(x)", "1 + y"],
];

fn least(a: &Tensor<f64>, b: &Tensor<f64>) -> f64 {
    let (xx, xy, yy) = (a.xx - b.xx, a.xy - b.xy, a.yy - b.yy);
    0.5 * (xx + yy) - (0.5 * (xx - yy)).hypot(xy)
}

#[test]
fn a_is_between_p_and_what_is_above_it_at_every_point() -> Result<()> {
    let mut random = Random::of_case(41, 2);
    for [xx, xy, yy] in FIELDS {
        for cells in [Cells::Triangles, Cells::Quads] {
            let a = format!("conductivity = [\"{xx}\", \"{xy}\", \"{yy}\"]");
            let a = a.replace("STEP", "sign(x - 0.1*y)");
            let text = PARABOLA.replace("conductivity = \"1\"", &a);
            let (scene, problem) = on_grid(&text, distorted(grid(3, cells)))?;
            for (&at, pieces) in &problem.coefficients.pieces {
                let cell = Cell::of(&problem, at);
                assert_eq!(pieces.unproved(), None, "{xx}");
                for piece in &pieces.all {
                    let reference = [random.between(0.0, 1.0), random.between(0.0, 1.0)];
                    let (x, below) = piece.place(reference);
                    let a = tensors::at(&scene.materials[0], x);
                    let slack = 1e-14 * (a.xx + a.yy);
                    assert!(least(&a, &below) >= -slack, "{a:?} below {below:?} at {x:?}");
                    let most = tensors::sum(&below, &piece.above);
                    assert!(least(&below, &piece.floor()) >= -slack, "{piece:?}");
                    assert!(least(&most, &a) >= -slack, "{a:?} above {most:?} at {x:?}");
                }
                let area: f64 = cell.points(&gauss(2)).iter().map(|p| p.weight).sum();
                let of_pieces: f64 = pieces.points(cell).map(|of| of.point.weight).sum();
                assert!((area - of_pieces).abs() < 1e-12 * area, "{area} {of_pieces}");
            }
        }
    }
    Ok(())
}

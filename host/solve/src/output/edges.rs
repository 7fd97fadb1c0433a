//! `edges.csv`: one line an edge, in the order of the kernel's unknowns.

use crate::problem::Problem;
use crate::solve::{ScalarKind, Solution};

/// The text of `edges.csv`: `x0,y0,x1,y1,kind,u_mean,flux_normal`.
///
/// The normal is the direction (x0, y0) → (x1, y1) turned clockwise, outward on the boundary.
pub fn edges_csv(problem: &Problem, solution: &Solution) -> csv::Result<Vec<u8>> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(["x0", "y0", "x1", "y1", "kind", "u_mean", "flux_normal"])?;
    for edge in 0..problem.ends.len() {
        let [a, b] = problem.segment(edge);
        let flux = solution.flux[edge] / problem.lengths[edge];
        let numbers = [a[0], a[1], b[0], b[1]].map(|x| x.to_string());
        let kind = problem.kinds[edge].name();
        let (u, flux) = (digits(solution, solution.u[edge]), digits(solution, flux));
        let fields = numbers.iter().map(String::as_str).chain([kind, &u, &flux]);
        writer.write_record(fields)?;
    }
    writer.into_inner().map_err(|error| error.into_error().into())
}

/// The shortest text that reads back as the same number of the solution's scalar type; −0 is 0.
fn digits(solution: &Solution, x: f64) -> String {
    let x = x + 0.0;
    match solution.scalar {
        ScalarKind::F64 => format!("{x:?}"),
        ScalarKind::F32 => format!("{:?}", x as f32),
    }
}

//! The dense contact problem as a C header: for other solvers.

use std::fmt::Write as _;

use signorini_scene::scene::Scene;
use signorini_solve::condense::CondensedModel;

/// Numbers a line.
const ACROSS: usize = 8;

/// minimise ½xᵀSx − (Bp)ᵀx over x ≥ 0: N, M, S by rows, B by columns and the default p, in f32; and which
/// contact edge each unknown is on.
pub fn header(scene: &Scene, condensate: &CondensedModel) -> String {
    let CondensedModel { contact, inputs, matrix, load, defaults, edges, .. } = condensate;
    let edges: Vec<_> = edges.chunks(2 * ACROSS).map(|line| format!("{line:?}")).collect();
    let edges = edges.join("\n   ").replace(['[', ']'], "");
    let mut text = format!(
        "/* {}\n   minimise 1/2 x'Sx - (Bp)'x over x >= 0, p[0] = 1.\n   \
         The unknowns follow the boundary: on the contact edges of edges.csv, counted from 0,\n   \
         {edges}.\n   Written by `signorini \
         condense` {}; do not edit. */\n#define N {contact} /* contact edges */\n#define M {inputs} \
         /* inputs, the constant included, first */\n",
        scene.title.replace("*/", "* /").replace('\n', " "),
        env!("CARGO_PKG_VERSION")
    );
    let all: Vec<f64> = load.iter().flatten().copied().collect();
    for (name, size, numbers) in
        [("S", "N * N", matrix), ("B", "N * M", &all), ("DEFAULTS", "M", defaults)]
    {
        let lines = numbers.chunks(ACROSS).map(|line| {
            let line: Vec<_> = line.iter().map(|&x| format!("{:?}f", x as f32)).collect();
            line.join(", ")
        });
        let lines: Vec<_> = lines.collect();
        let _ = writeln!(text, "static const float {name}[{size}] = {{\n{}}};", lines.join(",\n"));
    }
    text
}

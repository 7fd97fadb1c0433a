//! The dense contact problem as a C header: for other solvers.

use std::fmt::Write as _;

use signorini_condense::CondensedModel;
use signorini_scene::scene::Scene;

/// What is asked for.
const PLAIN: &str = "minimise 1/2 x'Sx - (Bp)'x over x >= 0, p[0] = 1";
const LIMITED: &str = "w = Sx - Bp, m = SPANS p, p[0] = 1: x > 0 where w = min(0, m), x < 0 where w = max(0, m),\n   \
                       x = 0 where w lies between; which minimises 1/2 x'Sx - (Bp)'x - sum min(0, m) max(x, 0)\n   \
                       + sum max(0, m) max(-x, 0)";

/// Numbers a line.
const ACROSS: usize = 8;

/// minimise ½xᵀSx − (Bp)ᵀx over x ≥ 0: N, M, S by rows, B by columns and the default p, in f32; and which
/// contact edge each unknown is on. With limits x has either sign, and spans follow by columns.
pub fn header(scene: &Scene, condensate: &CondensedModel) -> String {
    let CondensedModel { contact, inputs, matrix, load, defaults, edges, .. } = condensate;
    let edges: Vec<_> = edges.chunks(2 * ACROSS).map(|line| format!("{line:?}")).collect();
    let edges = edges.join("\n   ").replace(['[', ']'], "");
    let mut text = format!(
        "/* {}\n   {}.\n   \
         The unknowns follow the boundary: on the contact edges of edges.csv, counted from 0,\n   \
         {edges}.\n   Written by scene_data {}; do not edit. */\n#define N {contact} /* contact edges */\n#define M {inputs} \
         /* inputs, the constant included, first */\n",
        scene.title.replace("*/", "* /").replace('\n', " "),
        if condensate.is_limited() { LIMITED } else { PLAIN },
        env!("CARGO_PKG_VERSION")
    );
    let all: Vec<f64> = load.iter().flatten().copied().collect();
    let spans: Vec<f64> = condensate.spans.iter().flatten().copied().collect();
    if condensate.is_limited() {
        text += "#include <math.h>\n";
    }
    for (name, size, numbers) in [
        ("S", "N * N", matrix),
        ("B", "N * M", &all),
        ("DEFAULTS", "M", defaults),
        ("SPANS", "N * M", &spans),
    ] {
        if numbers.is_empty() && name == "SPANS" {
            continue;
        }
        let lines = numbers.chunks(ACROSS).map(|line| {
            let line: Vec<_> = line.iter().map(|&x| number(x)).collect();
            line.join(", ")
        });
        let lines: Vec<_> = lines.collect();
        let _ = writeln!(text, "static const float {name}[{size}] = {{\n{}}};", lines.join(",\n"));
    }
    text
}

/// As C has it.
fn number(x: f64) -> String {
    match x {
        f64::INFINITY => "INFINITY".to_owned(),
        f64::NEG_INFINITY => "-INFINITY".to_owned(),
        x => format!("{:?}f", x as f32),
    }
}

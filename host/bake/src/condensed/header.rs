//! The dense contact problem as a C header: for other solvers.

use std::fmt::Write as _;

use signorini_scene::scene::Scene;
use signorini_solve::condense::CondensedModel;

/// Numbers a line.
const ACROSS: usize = 8;

/// minimise ½xᵀSx − (Bp)ᵀx over x ≥ 0: N, M, S by rows, B by columns and the default p, in f32; and which
/// contact edge each unknown is on. Where fluxes have limits x has any sign, and SPANS p is what it costs on the other side.
pub fn header(scene: &Scene, condensate: &CondensedModel) -> String {
    let CondensedModel { contact, inputs, matrix, load, defaults, edges, .. } = condensate;
    let edges: Vec<_> = edges.chunks(2 * ACROSS).map(|line| format!("{line:?}")).collect();
    let edges = edges.join("\n   ").replace(['[', ']'], "");
    let minimised = match condensate.is_limited() {
        false => "1/2 x'Sx - (Bp)'x over x >= 0, p[0] = 1",
        true => {
            "1/2 x'Sx - (Bp)'x + sum of m max(0, -x), or of -m max(0, x) where m < 0,\n   \
             over x, m = SPANS p, p[0] = 1; INFINITY is that of math.h"
        }
    };
    let mut text = format!(
        "/* {}\n   minimise {minimised}.\n   \
         The unknowns follow the boundary: on the contact edges of edges.csv, counted from 0,\n   \
         {edges}.\n   Written by `signorini \
         condense` {}; do not edit. */\n#define N {contact} /* contact edges */\n#define M {inputs} \
         /* inputs, the constant included, first */\n",
        scene.title.replace("*/", "* /").replace('\n', " "),
        env!("CARGO_PKG_VERSION")
    );
    let all: Vec<f64> = load.iter().flatten().copied().collect();
    let spans: Vec<f64> = condensate.spans.iter().flatten().copied().collect();
    let numbers = [
        ("S", "N * N", matrix),
        ("B", "N * M", &all),
        ("SPANS", "N * M", &spans),
        ("DEFAULTS", "M", defaults),
    ];
    let is_there = |name: &str| name != "SPANS" || condensate.is_limited();
    for (name, size, numbers) in numbers.into_iter().filter(|(name, ..)| is_there(name)) {
        let lines = numbers.chunks(ACROSS).map(|line| {
            let line: Vec<_> = line.iter().map(|&x| number(x)).collect();
            line.join(", ")
        });
        let lines: Vec<_> = lines.collect();
        let _ = writeln!(text, "static const float {name}[{size}] = {{\n{}}};", lines.join(",\n"));
    }
    text
}

/// A number as C has it.
fn number(x: f64) -> String {
    match x as f32 {
        f32::INFINITY => "INFINITY".to_owned(),
        f32::NEG_INFINITY => "-INFINITY".to_owned(),
        x => format!("{x:?}f"),
    }
}

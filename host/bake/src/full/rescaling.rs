//! The text with which a module in other units answers in the scene's: see [`super::scale`].

use std::fmt::Write as _;

use super::arrays::Baked;
use super::output::Output;
use super::scale::Scale;
use signorini_problem::scalar::Scalar;

/// Pieces of the module; all empty where it works in the scene's units.
#[derive(Debug, Default)]
pub(super) struct Rescaling {
    /// Before the kernel's tick.
    pub before: String,
    /// After it.
    pub after: String,
    /// Beside the controller.
    pub items: String,
}

/// Those of `baked`.
pub(super) fn rescaling<R: Scalar>(baked: &Baked<R>) -> Rescaling {
    let Some(scale) = &baked.scale else { return Rescaling::default() };
    let before = "        let limits = Limits { error: limits.error / ENERGY_UNIT, ..limits };\n";
    Rescaling {
        before: before.to_owned(),
        after: after(scale, &baked.outputs),
        items: items(scale),
    }
}

fn after<R: Scalar>(scale: &Scale<R>, outputs: &[Output<R>]) -> String {
    let mut text = "        let report = in_units_of_the_scene(report);\n".to_owned();
    for (at, output) in outputs.iter().enumerate() {
        let _ = match scale.unit(output) {
            Some(unit) if unit == R::ONE => Ok(()),
            Some(unit) => writeln!(text, "        outputs[{at}] *= {unit:?};"),
            None => writeln!(
                text,
                "        if let Verdict::Certified(certificate) = report.verdict {{
            outputs[{at}] = certificate.total;
        }}"
            ),
        };
    }
    text
}

fn items<R: Scalar>(scale: &Scale<R>) -> String {
    format!(
        "
/// What 1 stands for in `data`, of energy norms.
const ENERGY_UNIT: Scalar = {:?};

fn in_units_of_the_scene(report: Report<Scalar>) -> Report<Scalar> {{
    let verdict = match report.verdict {{
        Verdict::Certified(of) => Verdict::Certified(Certificate {{
            duality_gap: of.duality_gap * ENERGY_UNIT,
            algebraic: of.algebraic * ENERGY_UNIT,
            oscillation: of.oscillation * ENERGY_UNIT,
            rounding: of.rounding * ENERGY_UNIT,
            total: no_less_than_normal(of.total * ENERGY_UNIT),
            of_u: no_less_than_normal(of.of_u * ENERGY_UNIT),
        }}),
        other => other,
    }};
    Report {{ verdict, ..report }}
}}

/// Next to underflow a product is less than it should be.
fn no_less_than_normal(total: Scalar) -> Scalar {{
    if total < Scalar::MIN_POSITIVE {{ Scalar::MIN_POSITIVE }} else {{ total }}
}}
",
        scale.energy
    )
}

//! The text as the compiler sees it: no warnings, and the bits of the same arrays on the host.

use super::setting::{scene, unbounded};
use super::{BENT, Baked, Controller, NONPARAMETRIC, fixtures, source};
use crate::Bakes;
use crate::compiled::{printed, ran};
use crate::tests::{self, FIRMWARE};
use signorini_problem::Problem;
use signorini_scene::error::Result;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_scene::setting::{MathKind, Method, Omega, Setting, Start};

/// Of the module and of the host's controller, in a cold and a warm tick.
pub(super) fn same_bits_of<R: Bakes>(problem: &Problem) -> Result<()> {
    let baked = Baked::<R>::new(problem)?;
    let mut controller = Controller::<R>::new(&baked);
    let defaults = || problem.scene.inputs.iter().skip(1).map(|input| input.default);
    let log = [0.3, -0.2].map(|lift| std::iter::once(lift).chain(defaults()).collect());
    let tick = |inputs: &[R]| controller.tick(inputs).map(|(outputs, _)| outputs);
    let lines = tests::same_bits(problem, source(&baked), &log, tick);
    assert!(lines.iter().all(|line| line.starts_with("Ok(")), "{lines:?}");
    Ok(())
}

#[test]
fn a_kernel_of_another_version_is_refused() -> Result<()> {
    let (_, problem) = fixtures::on_grid(BENT, grid(2, Cells::Triangles))?;
    let text = source(&Baked::<f32>::new(&problem)?) + "fn main() {}\n";
    let own = format!("is_version({:?})", signorini_device::VERSION);
    assert!(text.contains(&own), "{}", signorini_device::VERSION);
    assert_eq!(ran(&text), Ok(String::new()));
    let said = ran(&text.replace(&own, "is_version(\"0.0.9\")")).expect_err("another version");
    assert!(said.contains("baked for signorini-device"), "{said}");
    assert!(said.contains("bake the scene again"), "{said}");
    Ok(())
}

#[test]
fn modules_have_the_same_bits() -> Result<()> {
    let wind = "[input.wind]\nof = \"left\"\nfield = \"coefficient\"\npattern = \"1 - y/3\"\n";
    let supply = "[input.supply]\nof = \"contact\"\nfield = \"limit\"\npattern = \"3\"\n";
    let limited =
        BENT.replace("flux = \"-0.5*x^2\"", "flux = \"-0.5*x^2\", limit = \"1 - 0.5*x^2\"");
    let limited = format!("{limited}{supply}default = 0.5\nrange = [0, 2]\n")
        .replace("pattern = \"-1 - x\"", "pattern = \"-1\"");
    let triangles = || grid(3, Cells::Triangles);
    for (text, mesh) in [
        (BENT, triangles()),
        (&format!("{BENT}{NONPARAMETRIC}"), fixtures::distorted(grid(3, Cells::Quads))),
        (&format!("{BENT}{wind}default = 0.5\nrange = [0, 3]\n"), triangles()),
        (&limited, triangles()),
    ] {
        same_bits_of::<f32>(&fixtures::on_grid(text, mesh)?.1)?;
    }
    same_bits_of::<f64>(&fixtures::on_grid(BENT, grid(3, Cells::Mixed))?.1)
}

#[test]
fn with_a_setting() -> Result<()> {
    let fast = Setting { math: MathKind::Micromath, share: Some(0.3), ..Setting::default() };
    let problem = scene(BENT, Cells::Mixed, fast)?;
    same_bits_of::<f32>(&problem)?;
    let plain = Setting {
        start: Start::Cold,
        omega: Omega::Fixed(1.4),
        sweeps: Some(12),
        certificate: false,
        ..Setting::default()
    };
    let problem = scene(unbounded(), Cells::Mixed, plain)?;
    same_bits_of::<f32>(&problem)
}

#[test]
fn a_firmware_need_not_know_the_model() -> Result<()> {
    let factored = Setting { solver: Some(Method::Factor), ..Setting::default() };
    for setting in [Setting::default(), factored] {
        let problem = scene(BENT, Cells::Mixed, setting)?;
        let text = source(&Baked::<f32>::new(&problem)?) + FIRMWARE;
        assert_eq!(printed(&text), "true [true, true, true] OutOfTime true\n", "{setting:?}");
    }
    Ok(())
}

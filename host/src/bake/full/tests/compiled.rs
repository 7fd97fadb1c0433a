//! The text as the compiler sees it: no warnings, and the bits of the same arrays on the host.

use signorini_kernel::rows;

use super::{BENT, Baked, Controller, fixtures, source};
use crate::bake::compiled::printed;
use crate::error::Result;
use crate::mesh::structured::{Cells, grid};
use crate::scalar::Scalar;

/// Prints the outputs of a cold and a warm tick as bits.
const MAIN: &str = "
fn main() {
    let mut controller = Box::new(Controller::new());
    for lift in [0.3, -0.2] {
        let inputs = Inputs { lift, ..Inputs::DEFAULT };
        let outputs = controller.tick(inputs).map(|answer| answer.outputs.to_array());
        println!(\"{:?}\", outputs.map(|outputs| outputs.map(Scalar::to_bits)));
    }
}
";

fn same_bits<R: Scalar, const WIDTH: usize>(cells: Cells, bits: impl Fn(R) -> u64) -> Result<()> {
    let (scene, problem) = fixtures::on_grid(BENT, grid(3, cells))?;
    let baked = Baked::<R>::new(&scene, &problem)?;
    let mut controller = Controller::<R, WIDTH>::new(&baked);
    let lines = [0.3, -0.2].map(|lift| {
        let defaults = scene.inputs.iter().skip(1).map(|input| R::narrow(input.default));
        let inputs: Vec<R> = std::iter::once(R::narrow(lift)).chain(defaults).collect();
        let (outputs, _) = controller.tick(&inputs, crate::bake::full::limits()).expect("a tick");
        format!("Ok({:?})\n", outputs.into_iter().map(&bits).collect::<Vec<_>>())
    });
    assert_eq!(printed(&(source(&baked) + MAIN)), lines.concat());
    Ok(())
}

#[test]
fn triangles_in_f32() -> Result<()> {
    same_bits::<f32, { rows::TRIANGLES }>(Cells::Triangles, |x| x.to_bits().into())
}

#[test]
fn both_kinds_of_cells_in_f64() -> Result<()> {
    same_bits::<f64, { rows::QUADS }>(Cells::Mixed, f64::to_bits)
}

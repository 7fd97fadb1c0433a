//! The cost of a setting on a microcontroller: its module is baked here, and its image built and run by the library for
//! images.

use std::path::Path;

use signorini_bake::Bakes;
use signorini_bake::choice::{Choice, Wanted};
use signorini_bake::emit::{Emitted, emit};
use signorini_bake::setting;
use signorini_files::atomic::write_atomically;
use signorini_image::board::Board;
use signorini_image::firmware::Firmware;
use signorini_image::module::Module;
use signorini_image::room::NoResult;
use signorini_problem::Problem;
use signorini_scene::{Error, Result};
use signorini_solve::ScalarKind;

/// Bakes a problem with its setting, builds its image under the name `name`, plays it: what ran, with the bits of
/// this machine, or why there is no image for this scene and board: no model for its setting, or no room.
///
/// # Errors
/// No checkout of the sources; a tool that fails; bits that differ from this machine's.
pub fn measure(
    problem: &Problem,
    board: &Board,
    name: &str,
) -> Result<std::result::Result<Firmware, String>> {
    match module(problem, name) {
        Ok(module) => judged(Firmware::measure(&module, board)),
        Err(Error::Input(refused)) => Ok(Err(refused.message().to_owned())),
        Err(error) => Err(error),
    }
}

fn module(problem: &Problem, name: &str) -> Result<Module> {
    let Emitted { source, chosen } = match setting::scalar(&problem.scene, None)? {
        ScalarKind::F32 => emitted::<f32>(problem)?,
        ScalarKind::F64 => emitted::<f64>(problem)?,
    };
    let write = |file: &Path| match write_atomically(file, source.as_bytes()) {
        Ok(()) => Ok(chosen),
        Err(error) => Err(error.to_string()),
    };
    Module::new(name, write).map(Module::quietly).map_err(Error::Check)
}

fn emitted<R: Bakes>(problem: &Problem) -> Result<Emitted> {
    Ok(emit(problem, &Choice::<R>::new(problem, Wanted::default())?))
}

fn judged(
    found: std::result::Result<Firmware, NoResult>,
) -> Result<std::result::Result<Firmware, String>> {
    match found {
        Ok(firmware) => firmware.verdict().map(|()| Ok(firmware)).map_err(Error::Check),
        Err(why @ (NoResult::NoRoom { .. } | NoResult::BeyondCounter)) => Ok(Err(why.to_string())),
        Err(why) => Err(Error::Check(why.to_string())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_room_and_no_count_are_reasons_and_nothing_else_is() {
        let reason = judged(Err(NoResult::NoRoom { memory: "RAM", missing: 77 }));
        let said = "no room in RAM: 77 bytes are missing".to_owned();
        assert!(matches!(reason, Ok(Err(why)) if why == said));
        let reason = judged(Err(NoResult::BeyondCounter));
        assert!(matches!(reason, Ok(Err(why)) if why.contains("counter")));
        let failed = judged(Err(NoResult::Failed("QEMU: status 3".to_owned())));
        assert!(matches!(failed, Err(Error::Check(why)) if why == "QEMU: status 3"));
    }
}

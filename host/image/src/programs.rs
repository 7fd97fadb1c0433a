//! The two programs that hold a module.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::thread;

use crate::board::Board;
use crate::module::Module;
use crate::room::NoImage;
use crate::toolchain::output;

/// An image, and the same for the desk. The module that they are of is held meanwhile: nobody else replaces the two.
#[derive(Debug)]
pub struct Programs<'a> {
    board: &'a Board,
    module: &'a Module,
    image: PathBuf,
    desk: PathBuf,
}

impl<'a> Programs<'a> {
    /// Builds both.
    ///
    /// # Errors
    /// No room on the board, a build that fails.
    pub fn build(module: &'a Module, board: &'a Board) -> Result<Self, NoImage> {
        // Two builds in two folders: neither waits for the other.
        let (image, desk) = thread::scope(|scope| {
            let desk = scope.spawn(|| module.desk());
            let image = module.image(board, &[]);
            (image, desk.join().unwrap_or_else(|_| Err("the desk's build panicked".to_owned())))
        });
        Ok(Self { board, module, image: image?, desk: desk.map_err(NoImage::Failed)? })
    }

    /// What the board prints.
    ///
    /// # Errors
    /// It fails.
    pub fn on_board(&self) -> Result<String, String> {
        self.board.run(&self.image, true)
    }

    /// What the desk prints.
    ///
    /// # Errors
    /// It fails.
    pub fn on_desk(&self) -> Result<String, String> {
        let mut command = Command::new(&self.desk);
        if !self.module.is_quiet() {
            // It says why a tick has no answer.
            command.stderr(Stdio::inherit());
        }
        output(&mut command)
    }

    /// The image.
    pub fn image(&self) -> &Path {
        &self.image
    }
}

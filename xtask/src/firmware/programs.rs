//! A scene baked, and the two programs that hold it.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::thread;

use super::Options;
use crate::baked::{Baked, Failure};
use crate::board::Board;
use crate::toolchain::output;

/// An image, and the same for the desk.
#[derive(Debug)]
pub struct Programs {
    board: Board,
    /// As long as it is there nobody else replaces the two.
    baked: Baked,
    image: PathBuf,
    desk: PathBuf,
}

impl Programs {
    /// Bakes the scene and builds both.
    pub fn build(options: &Options) -> Result<Self, Failure> {
        let board = options.board()?;
        let baked = options.recipe.bake()?;
        // Two builds in two folders: neither waits for the other.
        let (image, desk) = thread::scope(|scope| {
            let desk = scope.spawn(|| baked.desk());
            let image = baked.image(&board, &[]);
            (image, desk.join().unwrap_or_else(|_| Err("the desk's build panicked".to_owned())))
        });
        let image =
            image.map_err(|why| format!("{why}: no image for {}, see above", options.board))?;
        Ok(Self { board, baked, image, desk: desk? })
    }

    /// What the board prints.
    pub fn on_board(&self) -> Result<String, String> {
        self.board.run(&self.image, true)
    }

    /// What the desk prints.
    pub fn on_desk(&self) -> Result<String, String> {
        // It says why a tick has no answer.
        output(Command::new(&self.desk).stderr(Stdio::inherit()))
    }

    /// Features of the kernel that both are built with.
    pub fn features(&self) -> &[String] {
        &self.baked.features
    }

    /// The image.
    pub fn image(&self) -> &Path {
        &self.image
    }
}

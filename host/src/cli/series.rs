//! A folder of VTU files, and the `.pvd` file that ParaView plays them by.

use std::fs;
use std::path::{Path, PathBuf};

use signorini_files::atomic::write_atomically;
use signorini_files::pvd::{Frame, pvd};
use signorini_scene::error::{Error, Result};

/// `NAME.pvd` and `NAME/0000.vtu`, …, in a folder.
pub(super) struct Series {
    out: PathBuf,
    name: &'static str,
    /// Digits of the number of a file at least.
    digits: usize,
    frames: Vec<Frame>,
}

impl Series {
    pub fn new(out: &Path, name: &'static str, digits: usize) -> Self {
        Self { out: out.to_owned(), name, digits, frames: Vec::new() }
    }

    /// The file of one frame, seen from the folder.
    fn file(&self, at: usize) -> String {
        format!("{}/{at:0digits$}.vtu", self.name, digits = self.digits)
    }

    /// Writes the next frame.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn add(&mut self, time: f64, vtu: &str) -> Result<()> {
        let file = self.file(self.frames.len());
        write_atomically(&self.out.join(&file), vtu.as_bytes())?;
        self.frames.push(Frame { time, file });
        Ok(())
    }

    /// Writes the series, and removes frames that an earlier run has left behind.
    ///
    /// # Errors
    /// A file that cannot be written or removed.
    pub fn close(self) -> Result<()> {
        write_atomically(&self.index(), pvd(&self.frames).as_bytes())?;
        self.remove_left()
    }

    /// Removes all that an earlier run has left behind, where there is a series of it; whether there was one.
    ///
    /// # Errors
    /// A file that cannot be removed.
    pub fn forget(self) -> Result<bool> {
        let index = self.index();
        if !index.exists() {
            return Ok(false);
        }
        remove(&index)?;
        self.remove_left()?;
        // A folder with files of somebody else stays.
        let _ = fs::remove_dir(self.out.join(self.name));
        Ok(true)
    }

    fn index(&self) -> PathBuf {
        self.out.join(format!("{}.pvd", self.name))
    }

    /// Removes the frames of an earlier run behind the last one of this.
    fn remove_left(&self) -> Result<()> {
        let left = (self.frames.len()..).map(|at| self.out.join(self.file(at)));
        let left: Vec<_> = left.take_while(|file| file.exists()).collect();
        left.iter().try_for_each(|file| remove(file))
    }
}

/// Removes a file.
pub(super) fn remove(file: &Path) -> Result<()> {
    fs::remove_file(file).map_err(Error::io(file))
}

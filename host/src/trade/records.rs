//! The committed records, as `signorini trade` without arguments writes them.
//!
//! ```text
//! meshes/trade/SCENE/trade.json        on the host
//! meshes/trade/m4f/SCENE/trade.json    on the Cortex-M4F
//! ```

use std::path::{Path, PathBuf};

use super::record::Trade;
use crate::error::{Error, Result};

/// The folder of all records, below that of the scenes.
pub const FOLDER: &str = "trade";

/// What was found in it, by the names of the scenes.
#[derive(Debug, Clone, Default)]
pub struct Records {
    /// Costs on the host.
    pub host: Vec<Trade>,
    /// Costs on the Cortex-M4F.
    pub m4f: Vec<Trade>,
}

/// Reads whatever records there are below the folder of the scenes.
///
/// # Errors
/// A record that cannot be read, with its name.
pub fn read(meshes: &Path) -> Result<Records> {
    let folder = meshes.join(FOLDER);
    Ok(Records { host: read_folder(&folder)?, m4f: read_folder(&folder.join("m4f"))? })
}

fn read_folder(folder: &Path) -> Result<Vec<Trade>> {
    let Ok(entries) = std::fs::read_dir(folder) else { return Ok(Vec::new()) };
    let paths =
        entries.map(|entry| Ok(entry.map_err(Error::io(folder))?.path().join("trade.json")));
    let mut paths: Vec<PathBuf> = paths.collect::<Result<_>>()?;
    paths.retain(|path| path.is_file());
    paths.sort();
    paths.iter().map(|path| read_record(path)).collect()
}

fn read_record(path: &Path) -> Result<Trade> {
    let text = std::fs::read_to_string(path).map_err(Error::io(path))?;
    serde_json::from_str(&text).map_err(|cause| {
        let name = path.display();
        Error::Check(format!(
            "{name}: no record of a trade study: {cause}; run `signorini trade` again"
        ))
    })
}

#[cfg(test)]
mod tests {
    use super::super::fixtures::trade;
    use super::*;

    fn write(folder: &Path, trade: &Trade) -> PathBuf {
        let path = folder.join(&trade.scene).join("trade.json");
        let text = serde_json::to_string(trade).unwrap();
        crate::output::atomic::write_atomically(&path, text.as_bytes()).unwrap();
        path
    }

    #[test]
    fn what_is_there_is_read_by_target_and_name() {
        let meshes = tempfile::tempdir().unwrap();
        let none = read(meshes.path()).unwrap();
        assert!(none.host.is_empty() && none.m4f.is_empty());
        let folder = meshes.path().join("trade");
        let (pit, levee) = (trade("pit", 3), trade("levee", 5));
        let board = Trade { target: "m4f".to_owned(), ..trade("pit", 2) };
        write(&folder, &pit);
        write(&folder, &levee);
        write(&folder.join("m4f"), &board);
        std::fs::write(folder.join("sizes.json"), "{}").unwrap();
        let found = read(meshes.path()).unwrap();
        let known = |trades: &[Trade]| {
            let known = trades.iter().map(|t| (t.scene.clone(), t.target.clone(), t.points.len()));
            known.collect::<Vec<_>>()
        };
        assert_eq!(known(&found.host), known(&[levee, pit]));
        assert_eq!(known(&found.m4f), known(&[board]));
    }

    #[test]
    fn a_broken_record_fails_with_its_name() {
        let meshes = tempfile::tempdir().unwrap();
        let path = write(&meshes.path().join("trade"), &trade("pit", 1));
        std::fs::write(&path, "{\"scene\": \"pit\"").unwrap();
        let error = read(meshes.path()).unwrap_err();
        assert!(error.to_string().starts_with(&path.display().to_string()), "{error}");
        assert_eq!(error.exit_status(), 1);
    }
}

//! The committed records, as `signorini trade` without arguments writes them.
//!
//! ```text
//! host/SCENE/trade.json    on this machine
//! m4f/SCENE/trade.json     on the Cortex-M4F
//! sizes.json               other solvers over the size of the problem
//! ```

use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;

use super::record::Trade;
use crate::baseline::Sizes;
use crate::record_file;
use signorini_scene::{Error, Result};

/// The folder of all records, from the root of the checkout.
pub const RECORD: &str = "host/benches/trade";

/// The study of sizes, in that folder.
pub const SIZES: &str = "sizes.json";

/// The studies in that folder, by the names of the scenes.
#[derive(Debug, Clone, Default)]
pub struct Records {
    pub host: Vec<Trade>,
    pub m4f: Vec<Trade>,
    /// Other solvers over the size of the problem.
    pub sizes: Option<Sizes>,
}

/// Reads whatever records there are in `folder`.
pub fn read(folder: &Path) -> Result<Records> {
    Ok(Records {
        host: read_folder(&folder.join("host"))?,
        m4f: read_folder(&folder.join("m4f"))?,
        sizes: read_record(&folder.join(SIZES))?,
    })
}

fn read_folder(folder: &Path) -> Result<Vec<Trade>> {
    let Ok(entries) = std::fs::read_dir(folder) else { return Ok(Vec::new()) };
    let paths =
        entries.map(|entry| Ok(entry.map_err(Error::io(folder))?.path().join("trade.json")));
    let mut paths: Vec<PathBuf> = paths.collect::<Result<_>>()?;
    paths.sort();
    paths.iter().filter_map(|path| read_record(path).transpose()).collect()
}

fn read_record<T: DeserializeOwned>(path: &Path) -> Result<Option<T>> {
    record_file::read(path, "a trade study", "signorini trade")
}

#[cfg(test)]
mod tests {
    use super::super::target::Target;
    use super::super::tests::trade;
    use super::*;

    fn write(folder: &Path, trade: &Trade) {
        let path = folder.join(&trade.scene).join("trade.json");
        let text = serde_json::to_string(trade).unwrap();
        signorini_files::atomic::write_atomically(&path, text.as_bytes()).unwrap();
    }

    #[test]
    fn what_is_there_is_read_by_target_and_name() {
        let folder = tempfile::tempdir().unwrap();
        let none = read(folder.path()).unwrap();
        assert!(none.host.is_empty() && none.m4f.is_empty());
        let (pit, levee) = (trade("pit", 3), trade("levee", 5));
        let board = Trade { target: Target::M4f, ..trade("pit", 2) };
        write(&folder.path().join("host"), &pit);
        write(&folder.path().join("host"), &levee);
        write(&folder.path().join("m4f"), &board);
        std::fs::write(folder.path().join("host/sizes.json"), "{}").unwrap();
        let found = read(folder.path()).unwrap();
        let known = |trades: &[Trade]| {
            let known = trades.iter().map(|t| (t.scene.clone(), t.target, t.points.len()));
            known.collect::<Vec<_>>()
        };
        assert_eq!(known(&found.host), known(&[levee, pit]));
        assert_eq!(known(&found.m4f), known(&[board]));
    }
}

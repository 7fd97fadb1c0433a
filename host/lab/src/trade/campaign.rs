//! Many studies: scenes by scenes, in one process or shared among several.
//!
//! Cases are shared by scenes where there are as many of them as processes, else by settings. A process with a
//! share of its own only leaves journals in the folders of the studies; one without reads the journals of all,
//! measures what is missing, and writes the results.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::files::FRAGMENT;
use super::front::Wish;
use super::mpi::on_ranks;
use super::record::Trade;
use super::records::{RECORD, SIZES};
use super::shard::Shard;
use super::study::Study;
use super::target::Target;
use crate::baseline;
use crate::checkout::{root, scenes};
use crate::record_file::json;
use signorini_files::atomic::{writable, write_atomically};
use signorini_scene::{InputError, Result, Scene};

/// Studies, and whether the study of sizes goes with them.
#[derive(Debug)]
pub struct Campaign {
    studies: Vec<Study>,
    sizes: Option<PathBuf>,
}

/// Called with each case that is done: its number in all studies, how many there are as far as planned, its name.
pub type Done<'d> = dyn FnMut(usize, usize, &str) + 'd;

/// The outcome of a campaign.
#[derive(Debug, Default)]
pub struct Ended {
    /// The studies that are whole, each with its folder.
    pub trades: Vec<(PathBuf, Trade)>,
    /// How many are not.
    pub left: usize,
    /// The exit status of a rank that failed, else 0.
    pub status: u8,
}

impl Campaign {
    /// Studies of `paths`: one scene goes to `out` itself, several to a folder each in it.
    ///
    /// # Errors
    /// A scene that cannot be read; two of the same name.
    pub fn of(
        paths: &[PathBuf],
        target: Target,
        out: Option<&Path>,
        with_peers: bool,
    ) -> Result<Self> {
        let mut names = BTreeMap::new();
        let mut studies = Vec::new();
        for path in paths {
            let name = path.file_stem().unwrap_or_default().to_owned();
            if let Some(other) = names.insert(name.clone(), path) {
                let message =
                    format!("{} and {}: two scenes of one name", other.display(), path.display());
                let hint =
                    "their results would go to one folder: study them one by one, with --out";
                return Err(InputError::new(message).hint(hint).into());
            }
            let folder = folder_of(path, paths.len(), out);
            writable("--out", &folder)?;
            refuse_own(path, &folder)?;
            studies.push(Study::open(path, target, folder, with_peers)?);
        }
        Ok(Self { studies, sizes: None })
    }

    /// The record of every standard scene, by default on the host and on the M4F.
    pub fn standard(target: Option<Target>, out: Option<&Path>, with_peers: bool) -> Result<Self> {
        let root = root()?;
        let paths = scenes(&root.join("meshes"))?;
        let record = out.map_or_else(|| root.join(RECORD), Path::to_owned);
        let targets = target.map_or(vec![Target::Host, Target::M4f], |target| vec![target]);
        let mut studies = Vec::new();
        for target in targets {
            let folder = record.join(target.to_string());
            let peers = with_peers && target == Target::Host;
            studies.extend(Self::of(&paths, target, Some(&folder), peers)?.studies);
        }
        let on_host = studies.iter().any(|study| study.target == Target::Host);
        let sizes = (on_host && with_peers).then(|| record.join(SIZES));
        Ok(Self { studies, sizes })
    }

    /// Warnings of data that may not be meant; where a scene is wrong, the run says so.
    pub fn warnings(&self) -> Vec<String> {
        let mut warnings: Vec<_> = self.studies.iter().flat_map(Study::warnings).collect();
        // A scene is studied once for each target.
        warnings.dedup();
        warnings
    }

    /// Runs this process's cases. Under MPI each rank has its share, and the first puts the parts together.
    pub fn run(&self, shard: Option<Shard>, wish: &Wish, done: &mut Done) -> Result<Ended> {
        if let Some(shard) = shard {
            return self.share(shard, wish, done);
        }
        let mut whole = None;
        let status = on_ranks(|shard| {
            let found = self.share(shard, wish, done)?;
            whole = Some(found).filter(|_| shard.is_whole());
            Ok(())
        })?;
        Ok(Ended { status, ..whole.unwrap_or_default() })
    }

    fn share(&self, shard: Shard, wish: &Wish, done: &mut Done) -> Result<Ended> {
        let by_scene = !shard.is_whole() && self.studies.len() >= shard.count();
        let mut ended = Ended::default();
        let mut before = 0;
        for (at, study) in self.studies.iter().enumerate() {
            if by_scene && !shard.takes(at) {
                ended.left += 1;
                continue;
            }
            let (mut number, mut of) = (0, 0);
            let mut tell = |all: usize, name: &str| {
                (number, of) = (number + 1, all);
                done(before + number, before + all, &format!("{}: {name}", study.name));
            };
            match study.run(shard, by_scene, wish, &mut tell)? {
                Some(trade) => ended.trades.push((study.folder.clone(), trade)),
                None => ended.left += 1,
            }
            before += of;
        }
        if let (Some(file), true) = (&self.sizes, shard.is_whole()) {
            let sizes = baseline::sizes(|name| done(before, before + 1, name))?;
            write_atomically(file, json(&sizes).as_bytes())?;
        }
        // Last of all: journals that are gone cannot tell what an interrupted campaign has measured.
        if ended.left == 0 {
            self.studies.iter().try_for_each(Study::close)?;
        }
        Ok(ended)
    }
}

/// The folder of a scene's files among so many: `out` itself for one alone, else one in it.
pub fn folder_of(scene: &Path, count: usize, out: Option<&Path>) -> PathBuf {
    match out {
        Some(out) if count == 1 => out.to_owned(),
        out => out.unwrap_or(Path::new("out")).join(scene.file_stem().unwrap_or_default()),
    }
}

/// Refuses a folder in which the results would replace the scene itself.
fn refuse_own(scene: &Path, folder: &Path) -> Result<()> {
    let own = [Some(scene.to_owned()), Scene::read(scene).ok().map(|scene| scene.path)];
    let own: Vec<_> =
        own.into_iter().flatten().filter_map(|path| path.canonicalize().ok()).collect();
    let written = folder.join(FRAGMENT);
    if !written.canonicalize().is_ok_and(|written| own.contains(&written)) {
        return Ok(());
    }
    let message = format!("--out {}: the scene is {FRAGMENT} there", folder.display());
    Err(InputError::new(message).hint("name another folder: this file would be replaced").into())
}

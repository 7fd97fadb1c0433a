//! `signorini trade`: speed against accuracy, measured.

use std::path::{Path, PathBuf};

use clap::Args;

use signorini_files::atomic::write_atomically;
use signorini_lab::checkout::root;
use signorini_lab::trade::Trade;
use signorini_lab::trade::campaign::{Campaign, Ended, folder_of};
use signorini_lab::trade::front::Wish;
use signorini_lab::trade::promised;
use signorini_lab::trade::shard::Shard;
use signorini_lab::trade::table::text;
use signorini_lab::trade::target::Target;
use signorini_problem::progress::{say, steps, warn};
use signorini_scene::error::{InputError, Result};
use signorini_scene::goal::Goal;
use signorini_scene::scene::Scene;

const EXAMPLES: &str = "\
Examples:
  signorini trade meshes/scenes/levee.toml
  signorini trade meshes/scenes/levee.toml --target m4f --budget-cycles 100000
  signorini trade bar.toml --max-error 1% --out out/bar
  signorini trade bar.toml --promise 20%,10%,5%        which firmware such an error takes
  signorini trade scenes/*.toml --shard 2/4

A study plans up to 60 settings of a scene (number format, mesh, its refinement, cells, sweeps, start, ω, model, bound), measures each, \
and recommends one. It leaves trade.json, trade.csv, trade.svg and recommended.toml, a fragment of a \
scene that solve, bake and `cargo xtask firmware` take. A scene with a [setting] is measured in that alone. \
Without a scene it renews the record of every standard scene (host/benches/trade), on the host and on the M4F.

What is built runs on every x86-64; with RUSTFLAGS=\"-C target-feature=+avx2,+fma\" it measures with AVX2, and the record says which.

Interrupted, the same command goes on where it was. --shard 1/4 … 4/4 share the work among processes that see the same \
folder; the same command without --shard then puts their parts together.";

/// Arguments of `trade`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// Scene files (TOML) [default: every standard scene]
    scenes: Vec<PathBuf>,
    /// The most that a tick may cost: cycles on the host, instructions on m4f and m7
    #[arg(long, value_name = "N", value_parser = budget, allow_hyphen_values = true)]
    budget_cycles: Option<f64>,
    /// The largest energy error, absolute or (with %) as a part of the solution's energy norm
    #[arg(long, value_name = "E", allow_hyphen_values = true)]
    max_error: Option<Goal>,
    /// Whose cost decides: this machine's, or that of an emulated Cortex-M4F or M7 [default: host]
    #[arg(long, value_enum)]
    target: Option<Target>,
    /// Where the files go, for several scenes in a folder each [default: out/SCENE]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Leave out the other solvers and the study of micromath
    #[arg(long)]
    no_peers: bool,
    /// Instead: the firmware that these errors take for all inputs, on a mesh refined where its bound asks for it and on one
    /// refined everywhere; promised.txt
    #[arg(
        long,
        value_name = "E,E,…",
        value_delimiter = ',',
        conflicts_with_all = ["budget_cycles", "max_error", "target", "shard"]
    )]
    promise: Vec<Goal>,
    /// This process's share of the cases, i of n
    #[arg(long, value_name = "i/n")]
    shard: Option<Shard>,
}

fn budget(text: &str) -> std::result::Result<f64, String> {
    match text.parse::<f64>() {
        Ok(budget) if budget.is_finite() && budget > 0.0 => Ok(budget),
        _ => Err("expected a positive number, such as 200000".to_owned()),
    }
}

impl Arguments {
    pub(super) fn run(self) -> Result<u8> {
        if !self.promise.is_empty() {
            return self.promised();
        }
        let wish = Wish { budget: self.budget_cycles, error: self.max_error };
        if self.no_peers && self.scenes.is_empty() && self.out.is_none() {
            let message =
                "--no-peers without a scene: the record of the standard scenes has all solvers";
            return Err(InputError::new(message)
                .hint("name scenes, or a folder with --out")
                .into());
        }
        let campaign = match self.scenes.is_empty() {
            true => Campaign::standard(self.target, self.out.as_deref(), !self.no_peers)?,
            false => Campaign::of(
                &self.scenes,
                self.target.unwrap_or(Target::Host),
                self.out.as_deref(),
                !self.no_peers,
            )?,
        };
        warn(&campaign.warnings());
        let bar = steps(0);
        let ended = campaign.run(self.shard, &wish, &mut |number, of, name| {
            bar.set_length(of as u64);
            bar.set_position(number as u64);
            bar.set_message(name.to_owned());
        });
        bar.finish_and_clear();
        let Ended { trades, left, status } = ended?;
        for (folder, trade) in &trades {
            say(text(trade));
            say(format_args!("written to {}", folder.display()));
        }
        if left > 0 {
            say(format_args!(
                "{left} of the scenes wait for other processes: the same command without --shard puts the parts together"
            ));
        }
        refused(&trades, &wish).map(|refused| refused.max(status))
    }

    /// The table of each scene in its folder; without a scene those of the standard ones in the record.
    fn promised(&self) -> Result<u8> {
        if self.scenes.is_empty() {
            let at = root()?;
            let table = |path: &&str| self.table(&at.join(path));
            let tables: Vec<_> = promised::STANDARD.iter().map(table).collect::<Result<_>>()?;
            let file = match &self.out {
                Some(folder) => folder.join(promised::FILE),
                None => at.join(promised::RECORD),
            };
            return written(&file, &tables.join("\n"));
        }
        for path in &self.scenes {
            let folder = folder_of(path, self.scenes.len(), self.out.as_deref());
            written(&folder.join(promised::FILE), &self.table(path)?)?;
        }
        Ok(0)
    }

    /// That of one scene, which is said as well.
    fn table(&self, path: &Path) -> Result<String> {
        let scene = Scene::read(path)?;
        let bar = steps(2 * self.promise.len());
        bar.set_message(scene.title.clone());
        let table = promised::table(&scene, &self.promise, &mut || bar.inc(1));
        bar.finish_and_clear();
        let table = table?;
        say(&table);
        Ok(table)
    }
}

fn written(file: &Path, text: &str) -> Result<u8> {
    write_atomically(file, text.as_bytes())?;
    say(format_args!("written to {}", file.display()));
    Ok(0)
}

/// A wish that nothing meets is wrong input; the studies are written all the same.
fn refused(trades: &[(PathBuf, Trade)], wish: &Wish) -> Result<u8> {
    let unmet = trades.iter().find(|(_, trade)| trade.recommendation.point.is_none());
    match unmet {
        Some((_, trade)) if wish.budget.is_some() || wish.error.is_some() => {
            let message = format!("{}: {}", trade.scene, trade.recommendation.text);
            let advice = match (wish.budget, wish.error) {
                (Some(_), Some(_)) => "allow more cycles or a larger error",
                (Some(_), None) => "allow more cycles",
                _ => "allow a larger error, or refine the mesh",
            };
            let hint = format!("{advice}: every setting measured is in trade.csv");
            Err(InputError::new(message).hint(hint).into())
        }
        _ => Ok(0),
    }
}

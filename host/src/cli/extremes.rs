//! `signorini extremes`: every scale pushed, every outcome named.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use clap::Args;

use signorini_files::atomic::{writable, write_atomically};
use signorini_lab::extremes::random::in_time;
use signorini_lab::extremes::{Findings, Kept, cases, random, run};
use signorini_problem::progress::{say, steps};
use signorini_scene::error::{InputError, Result};

const EXAMPLES: &str = "\
Examples:
  signorini extremes
  signorini extremes --only contrast --out /tmp/contrast
  signorini extremes --random 20000 --seed 18            whole scenes; random.json
  signorini extremes --random 1 --seed 18 --case 7       one of them, with its files
  signorini extremes --random 2000 --seed 5 --in-time    scenes over time; trajectories.json

Scenes with exact solutions are posed at every scale, read, solved with the default options in f64 and f32, and \
judged at scale 1: correct, certified-poor, typed-error or wrong, as extremes.json defines them. Leaves \
extremes.json, extremes.csv and extremes.html, a page with a map a study. Two threads, a few minutes. Interrupted, the \
same command goes on where it was.

With --random N whole scenes are drawn instead: materials, loads, conditions, cells, solver, scalar and a limit on sweeps. \
Odd ones have a feature that fixed rules miss, such as a narrow source or a step of A inside a cell. \
Each is measured against its exact solution or a finer solve that counts with its own bound. Leaves random.json (counts, \
the largest ratios, all that is broken), random.csv (a line a case) and the scene and mesh of every case that breaks a \
promise. 20 000 cases take about three hours; this too goes on where it was interrupted.

With --in-time these scenes store u, and logs drive them: each is played again on a mesh twice finer with a quarter of the \
step, which judges the bound over time at every tick, and the bound of the last step. Leaves trajectories.json and \
trajectories.csv.

Exit status 0 where nothing is worse than certified-poor or refused with a typed error, else 1.";

/// Arguments of `extremes`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The cases whose name contains this [default: all]
    #[arg(long, value_name = "TEXT")]
    only: Option<String>,
    /// Draw so many whole scenes at random instead
    #[arg(long, value_name = "N", conflicts_with = "only", value_parser = clap::value_parser!(u32).range(1..))]
    random: Option<u32>,
    /// What the random scenes are drawn from: equal seeds, equal scenes
    #[arg(long, value_name = "S", default_value_t = 18, requires = "random")]
    seed: u64,
    /// This random scene alone, counted from 0
    #[arg(long, value_name = "K", requires = "random")]
    case: Option<u32>,
    /// Scenes that store u instead, played by logs: their bounds of steps and over time
    #[arg(long, requires = "random")]
    in_time: bool,
    /// Where the files go
    #[arg(long, value_name = "DIR", default_value = "out/extremes")]
    out: PathBuf,
}

impl Arguments {
    pub(super) fn run(self) -> Result<u8> {
        if let Some(count) = self.random {
            return self.at_random(count);
        }
        let cases = cases(self.only.as_deref());
        if cases.is_empty() {
            let only = self.only.unwrap_or_default();
            let error = InputError::new(format!("--only {only}: no case has this in its name"));
            return Err(error.hint("leave it out for a table of all studies").into());
        }
        self.leaving(cases.len(), |kept, done| run(&cases, kept, done), |_, _| Ok(()))
    }

    /// Whole scenes.
    fn at_random(self, count: u32) -> Result<u8> {
        let seed = self.seed;
        let cases = self.case.map_or(0..=count - 1, |case| case..=case);
        let number = cases.clone().count();
        if self.in_time {
            let write = |case, out: &Path| {
                in_time::write(seed, case, &out.join(format!("trajectory-{case}")))
            };
            return self.leaving(number, |kept, done| in_time::run(seed, cases, kept, done), write);
        }
        let write = |case, out: &Path| random::write(seed, case, &out.join(format!("case-{case}")));
        self.leaving(number, |kept, done| random::run(seed, cases, kept, done), write)
    }

    /// Leaves the files of a run, and those of each case that is wrong or was asked for.
    fn leaving(
        &self,
        cases: usize,
        run: impl FnOnce(&Kept, &(dyn Fn() + Sync)) -> Result<Findings>,
        write: impl Fn(u32, &Path) -> Result<()>,
    ) -> Result<u8> {
        let out = &self.out;
        writable("--out", out)?;
        let bar = steps(cases);
        let kept = Kept::open(out)?;
        let found = run(&kept, &|| bar.inc(1));
        bar.finish_and_clear();
        let Findings { files, text, wrong } = found?;
        for (name, bytes) in files {
            write_atomically(&out.join(name), &bytes)?;
        }
        let written: BTreeSet<u32> = wrong.iter().copied().chain(self.case).collect();
        written.into_iter().try_for_each(|case| write(case, out))?;
        // Last of all: what is gone cannot tell what an interrupted run has found.
        kept.close()?;
        say(text);
        say(format_args!("written to {}", out.display()));
        Ok(u8::from(!wrong.is_empty()))
    }
}

//! `signorini extremes`: every scale pushed, every outcome named.

use std::collections::BTreeSet;
use std::path::PathBuf;

use clap::Args;

use signorini_draw::extremes_page;
use signorini_files::atomic::{writable, write_atomically};
use signorini_lab::extremes::judge::Outcome;
use signorini_lab::extremes::kept::Kept;
use signorini_lab::extremes::random::in_time;
use signorini_lab::extremes::random::record::Record;
use signorini_lab::extremes::section::section;
use signorini_lab::extremes::{cases, random, run, text};
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
        writable("--out", &self.out)?;
        let bar = steps(cases.len());
        let kept = Kept::open(&self.out)?;
        let record = run(&cases, &kept, || bar.inc(1));
        bar.finish_and_clear();
        let record = record?;
        let made_by = format!("signorini {}; {:.0} s", env!("CARGO_PKG_VERSION"), record.seconds);
        let page = extremes_page(&section(&record), &made_by);
        let files = [
            ("extremes.json", record.json().into_bytes()),
            ("extremes.csv", record.csv()?),
            ("extremes.html", page.into_bytes()),
        ];
        for (name, bytes) in files {
            write_atomically(&self.out.join(name), &bytes)?;
        }
        // Last of all: what is gone cannot tell what an interrupted run has found.
        kept.close()?;
        say(text(&record));
        say(format_args!("written to {}", self.out.display()));
        Ok(u8::from(record.count(Outcome::Wrong) > 0))
    }

    /// Whole scenes.
    fn at_random(self, count: u32) -> Result<u8> {
        let (seed, out) = (self.seed, &self.out);
        writable("--out", out)?;
        let cases = self.case.map_or(0..=count - 1, |case| case..=case);
        let bar = steps(cases.clone().count());
        let kept = Kept::open(out)?;
        if self.in_time {
            let rows = in_time::run(seed, cases, &kept, || bar.inc(1));
            bar.finish_and_clear();
            let rows = rows?;
            let record = in_time::Record::new(seed, &rows);
            write_atomically(&out.join("trajectories.json"), record.json().as_bytes())?;
            write_atomically(&out.join("trajectories.csv"), &in_time::csv(&rows)?)?;
            for case in record.violations.keys().copied().chain(self.case) {
                in_time::write(seed, case, &out.join(format!("trajectory-{case}")))?;
            }
            kept.close()?;
            say(record.text());
            say(format_args!("written to {}", out.display()));
            return Ok(u8::from(!record.violations.is_empty()));
        }
        let rows = random::run(seed, cases, &kept, || bar.inc(1));
        bar.finish_and_clear();
        let rows = rows?;
        let record = Record::new(seed, kept.seconds(), &rows);
        write_atomically(&out.join("random.json"), record.json().as_bytes())?;
        write_atomically(&out.join("random.csv"), &random::row::csv(&rows)?)?;
        let broken = record.violations.iter().map(|violation| violation.case);
        let written: BTreeSet<u32> = broken.chain(self.case).collect();
        for case in written {
            random::write(seed, case, &out.join(format!("case-{case}")))?;
        }
        kept.close()?;
        say(record.text());
        say(format_args!("written to {}", out.display()));
        Ok(u8::from(!record.violations.is_empty()))
    }
}

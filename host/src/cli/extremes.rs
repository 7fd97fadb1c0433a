//! `signorini extremes`: every scale pushed, every outcome named.

use std::path::PathBuf;

use clap::Args;

use crate::error::{InputError, Result};
use crate::extremes::judge::Outcome;
use crate::extremes::section::section;
use crate::extremes::{Plan, text};
use crate::output::atomic::write_atomically;
use crate::progress::{say, steps};
use crate::report::extremes_page;

const EXAMPLES: &str = "\
Examples:
  signorini extremes
  signorini extremes --only contrast --out /tmp/contrast

Scenes with exact solutions are posed at every scale, read, solved with the default options in f64 and f32, and
judged at scale 1: correct, certified-poor, typed-error or wrong, as extremes.json defines them. Leaves
extremes.json, extremes.csv and extremes.html, a page with a map a study. Two threads, a few minutes.

Exit status 0 where nothing is worse than certified-poor or refused with a typed error, else 1.";

/// Arguments of `extremes`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The cases whose name contains this [default: all]
    #[arg(long, value_name = "TEXT")]
    only: Option<String>,
    /// Where the files go
    #[arg(long, value_name = "DIR", default_value = "out/extremes")]
    out: PathBuf,
}

impl Arguments {
    pub(super) fn run(self) -> Result<u8> {
        let plan = Plan::new(self.only.as_deref());
        if plan.is_empty() {
            let only = self.only.unwrap_or_default();
            let error = InputError::new(format!("--only {only}: no case has this in its name"));
            return Err(error.hint("leave it out for a table of all studies").into());
        }
        super::place::writable(&self.out)?;
        let bar = steps(plan.len());
        let record = plan.run(|| bar.inc(1));
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
        say(text(&record));
        say(format_args!("written to {}", self.out.display()));
        Ok(u8::from(record.count(Outcome::Wrong) > 0))
    }
}

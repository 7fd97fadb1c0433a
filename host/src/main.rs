//! The `signorini` command: see `signorini --help`.

use std::process::ExitCode;

use clap::Parser;
mod cli;

use cli::Cli;

fn main() -> ExitCode {
    signorini_scene::error::install_handler();
    match Cli::parse().run() {
        Ok(status) => ExitCode::from(status),
        Err(error) => {
            let status = error.exit_status();
            // One report each: that of all together would have a header for all but the first.
            for fault in error.each() {
                eprintln!("{:?}", miette::Report::new(fault));
            }
            ExitCode::from(status)
        }
    }
}

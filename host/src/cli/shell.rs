//! What shells and manuals take from the command line's own description.

use std::io::{self, Write as _};

use clap::{Args, CommandFactory as _};
use clap_complete::Shell;
use clap_mangen::Man;

use signorini_scene::error::{InputError, Result};

use super::Cli;

/// Arguments of `completions`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  signorini completions bash > /etc/bash_completion.d/signorini
  signorini completions zsh > ~/.zfunc/_signorini")]
pub struct Arguments {
    /// The shell
    shell: Shell,
}

/// Arguments of `man`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  signorini man | man -l -
  signorini man solve > /usr/local/share/man/man1/signorini-solve.1")]
pub struct Page {
    /// The command [default: signorini itself]
    command: Option<String>,
}

impl Arguments {
    pub(super) fn run(self) -> Result<u8> {
        let mut script = Vec::new();
        clap_complete::generate(self.shell, &mut Cli::command(), "signorini", &mut script);
        printed(&script)
    }
}

impl Page {
    pub(super) fn run(self) -> Result<u8> {
        let mut whole = Cli::command();
        whole.build();
        let described = match &self.command {
            None => whole,
            Some(name) => whole.find_subcommand(name).cloned().ok_or_else(|| {
                let error = InputError::new(format!("man {name}: there is no such command"));
                error.hint("`signorini --help` lists them")
            })?,
        };
        let mut page = Vec::new();
        // Writing to memory cannot fail.
        let _ = Man::new(described).render(&mut page);
        printed(&page)
    }
}

/// Writes bytes to standard output; a reader who has gone away is no error.
pub(super) fn printed(bytes: &[u8]) -> Result<u8> {
    let _ = io::stdout().write_all(bytes);
    Ok(0)
}

//! The project's task runner: `cargo xtask --help`. A file per verb; it runs tools and needs none of the project's crates but
//! the one for images, so it compiles in seconds.

mod audit;
mod baked;
mod boards;
mod c;
mod caught;
mod cost;
mod counted;
mod crates;
mod cross;
mod export;
mod firmware;
mod flight;
mod fuzz;
mod house;
mod installs;
mod logs;
mod modules;
mod mutants;
mod no_std;
mod oldest;
mod osqp;
mod package;
mod peers;
mod program;
mod python;
mod quick;
mod ranks;
mod record;
mod replay;
mod results;
mod sanitize;
mod seen;
mod setup;
mod size;
mod snapshot;
mod stamps;
mod steps;
mod test;

use std::process::ExitCode;

use clap::{Parser, Subcommand};
use signorini_image::cargo::target_dir;
use signorini_image::checkout;
use signorini_image::lock::hold;

use baked::Failure;
use steps::{Mode, Steps};

const EXAMPLES: &str = "\
Examples:
  cargo xtask test         before every commit, and what CI runs
  cargo xtask test --all   fuzzing, sanitizer, mutants, MPI, OSQP, old processors, PyVista, what is installed, every board, too
  cargo xtask no-std    after a change of the kernel's dependencies
  cargo xtask cost --bless    writes the record anew (boards, c, cost, house, logs, peers and size have one)
  cargo xtask firmware meshes/scenes/levee.toml    and `cargo xtask firmware --help`
  cargo xtask fuzz --runs 1000000 mesh    goes on fuzzing the mesh reader

Each verb but `firmware`, `fuzz`, `mutants` and `osqp` runs all its steps, whichever fail. The last line is `N passed, N failed`; the exit
status is 0 only where nothing failed, 2 for a wrong command line. A missing tool is a failure.";

/// The project's task runner
#[derive(Debug, Parser)]
#[command(bin_name = "cargo xtask", after_help = EXAMPLES)]
struct Cli {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Debug, Subcommand)]
enum Verb {
    /// Formatting, clippy, tests, boards; with --all what need not run each time, too
    Test(Mode),
    /// Format, clippy and tests of the packages that the working tree changes
    Quick(Mode),
    /// Rules of the house that no compiler holds, with those that break them
    House(Mode),
    /// The kernel links without std and without an allocator; breaches are caught
    NoStd(Mode),
    /// Sweeps under AddressSanitizer: no access outside of an array
    Sanitize(Mode),
    /// meshio and PyVista read the files of a solve and of ticks (Python, from its registry)
    Results(Mode),
    /// The Python module: built by pip in a fresh environment, tested beside the command line
    Python(Mode),
    /// An archive of each crate, and each builds from its own; nothing is published
    Package(Mode),
    /// What users install works away from the checkout, or says what it lacks
    Installs(Mode),
    /// Installs the tools for microcontrollers (Debian, as root)
    Setup(Mode),
    /// The kernel and all images for Cortex-M4 and M7
    Cross(Mode),
    /// The images on emulated boards, bit for bit as on the desk
    Boards(Mode),
    /// No allocator, panic, formatting, f64, unused code in the images
    Audit(Mode),
    /// Flash, RAM and stack by kind of scene
    Size(Mode),
    /// Instructions of every stage, against record and targets
    Cost(Mode),
    /// Instructions of ticks over recorded inputs, bit for bit as on the desk, against the record
    Logs(Mode),
    /// Controllers from C: bits, instructions, headers, states, examples
    C(Mode),
    /// Any scene on an emulated board: bits, instructions, RAM, flash, stack
    ///
    /// Bakes a scene, puts it on an emulated board, plays 101 ticks there and on this machine, and compares them bit for bit.
    ///
    /// Tick 1 has all inputs at their defaults, from a cold start or, of a scene in time, from its start; in each of the others every
    /// input is drawn from its range, two of four ticks at a corner of all ranges; without a range from within a tenth of its default
    /// (±0.1 where that is 0). They are the same on both.
    Firmware(Box<firmware::Options>),
    /// Arbitrary bytes into readers, constructors and ticks; a record of how many
    ///
    /// Feeds arbitrary bytes, guided by coverage, to the targets. Without --runs the corpora and all cases ever found are replayed,
    /// and mutations of them up to 10000 executions a target, the same every time; nothing is written unless something is found.
    Fuzz(fuzz::Options),
    /// Other solvers on the same board and problems; not part of `test`
    Peers(Mode),
    /// Builds OSQP for the trade study; the last line is the program's path
    Osqp(osqp::Options),
    /// Does a test fail for every single change of the kernel? (minutes)
    ///
    /// Mutates sources of the kernel that have changed since tests/mutants/record.json, and judges each mutant by its tests. Mutants
    /// that live are listed in tests/mutants/survivors.json, where a person writes a reason beside each.
    ///
    /// Exit status: 0 where 95 % are killed and each survivor has its reason; 1 otherwise; 2 for wrong words.
    Mutants(mutants::Options),
}

fn main() -> ExitCode {
    let verb = Cli::parse().verb;
    if let Err(why) = checkout::find() {
        return ended(Err(Failure { why, status: 2 }));
    }
    let (mode, run): (Mode, fn(&mut Steps)) = match verb {
        Verb::Firmware(options) => return ended(firmware::run(&options)),
        Verb::Fuzz(options) => return ended(fuzz::run(&options)),
        Verb::Osqp(options) => return ended(osqp::run(&options)),
        Verb::Mutants(options) => return ended(mutants::run(&options)),
        Verb::Test(mode) => (mode, test::run),
        Verb::Quick(mode) => (mode, quick::run),
        Verb::House(mode) => (mode, house::run),
        Verb::NoStd(mode) => (mode, no_std::run),
        Verb::Sanitize(mode) => (mode, sanitize::run),
        Verb::Results(mode) => (mode, results::run),
        Verb::Python(mode) => (mode, python::run),
        Verb::Package(mode) => (mode, package::verify),
        Verb::Installs(mode) => (mode, installs::run),
        Verb::Setup(mode) => (mode, setup::run),
        Verb::Cross(mode) => (mode, cross::run),
        Verb::Boards(mode) => (mode, boards::run),
        Verb::Audit(mode) => (mode, audit::run),
        Verb::Size(mode) => (mode, size::run),
        Verb::Cost(mode) => (mode, cost::run),
        Verb::Logs(mode) => (mode, logs::run),
        Verb::C(mode) => (mode, c::run),
        Verb::Peers(mode) => (mode, peers::run),
    };
    // Images of one name differ from verb to verb.
    let _turn = match hold(&target_dir("firmware").join("steps.lock")) {
        Ok(turn) => turn,
        Err(why) => return ended(Err(Failure { why, status: 2 })),
    };
    let mut steps = Steps::new(mode);
    run(&mut steps);
    steps.finish()
}

/// The status of a verb without steps.
fn ended(done: Result<(), Failure>) -> ExitCode {
    let Err(Failure { why, status }) = done else { return ExitCode::SUCCESS };
    eprintln!("error: {why}");
    ExitCode::from(status)
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory as _;

    #[test]
    fn the_command_line_is_sound() {
        super::Cli::command().debug_assert();
    }
}

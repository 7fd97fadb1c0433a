//! The project's task runner: `cargo xtask --help`. A file per verb; it runs tools and needs none of the project's crates but
//! the one for images, so it compiles in seconds.

mod archive;
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
  cargo xtask test --only boards    one part of it: house, host, no-std, python, boards or rest
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
    Test(test::Options),
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
    /// The program with its pages and scenes as one file, in target/dist; it solves a scene out of there
    Archive(Mode),
    /// The Python module as a wheel, in target/dist; it solves a scene where pip has installed it
    Wheel(Mode),
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
        Verb::Test(test::Options { mode, only }) => {
            return stepped(mode, |steps| test::run(steps, only));
        }
        Verb::Quick(mode) => (mode, quick::run),
        Verb::House(mode) => (mode, house::run),
        Verb::NoStd(mode) => (mode, no_std::run),
        Verb::Sanitize(mode) => (mode, sanitize::run),
        Verb::Results(mode) => (mode, results::run),
        Verb::Python(mode) => (mode, python::run),
        Verb::Archive(mode) => (mode, archive::run),
        Verb::Wheel(mode) => (mode, python::wheel),
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
    stepped(mode, run)
}

/// The status of a verb with steps.
fn stepped(mode: Mode, run: impl FnOnce(&mut Steps)) -> ExitCode {
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
    use clap::{CommandFactory as _, Parser as _, ValueEnum as _};
    use signorini_image::cargo::root;
    use signorini_image::files;

    use super::{Cli, test::Part};

    #[test]
    fn the_command_line_is_sound() {
        Cli::command().debug_assert();
    }

    /// The verbs that a workflow names in lines `verb: …`, one or a list.
    fn verbs(workflow: &str) -> Vec<String> {
        let page = root().join(".github/workflows").join(workflow);
        let text = files::text(&page).expect("a workflow");
        let lists = text
            .lines()
            .filter_map(|line| line.trim_start_matches([' ', '-']).strip_prefix("verb: "));
        lists
            .flat_map(|list| list.trim_matches(['[', ']']).split(", "))
            .map(str::to_owned)
            .collect()
    }

    #[test]
    fn jobs_of_continuous_integration_are_verbs() {
        for workflow in ["test.yml", "nightly.yml", "release.yml"] {
            let verbs = verbs(workflow);
            assert!(!verbs.is_empty(), "{workflow}");
            for verb in verbs {
                let words = ["cargo xtask"].into_iter().chain(verb.split(' '));
                assert!(Cli::try_parse_from(words).is_ok(), "{workflow}: {verb}");
            }
        }
    }

    #[test]
    fn each_part_of_the_tests_is_a_job() {
        for (workflow, more) in [("test.yml", ""), ("nightly.yml", " --all")] {
            let parts = Part::value_variants().iter().filter_map(Part::to_possible_value);
            let expected: Vec<_> =
                parts.map(|part| format!("test{more} --only {}", part.get_name())).collect();
            assert_eq!(verbs(workflow), expected, "{workflow}");
        }
    }
}

//! The project's task runner: `cargo xtask --help`. A file per verb; it runs tools and needs none of the project's crates but
//! the one for images, so it compiles in seconds.

mod audit;
mod baked;
mod boards;
mod c;
mod caught;
mod command;
mod cost;
mod counted;
mod crates;
mod cross;
mod export;
mod firmware;
mod flight;
mod fuzz;
mod house;
mod modules;
mod mutants;
mod no_std;
mod oldest;
mod osqp;
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

use signorini_image::cargo::target_dir;
use signorini_image::checkout;
use signorini_image::lock::hold;

use steps::{Mode, Steps};

/// What a verb of the command line does.
enum Work {
    /// Steps, all of them whichever fail, with no argument but `--bless` and `--all`.
    Steps(fn(&mut Steps)),
    /// One thing, with arguments and a help of its own.
    Command(fn(&[&str]) -> ExitCode),
}

const VERBS: [(&str, Work); 19] = [
    ("test", Work::Steps(test::run)),
    ("quick", Work::Steps(quick::run)),
    ("house", Work::Steps(house::run)),
    ("no-std", Work::Steps(no_std::run)),
    ("sanitize", Work::Steps(sanitize::run)),
    ("results", Work::Steps(results::run)),
    ("python", Work::Steps(python::run)),
    ("setup", Work::Steps(setup::run)),
    ("cross", Work::Steps(cross::run)),
    ("boards", Work::Steps(boards::run)),
    ("audit", Work::Steps(audit::run)),
    ("size", Work::Steps(size::run)),
    ("cost", Work::Steps(cost::run)),
    ("c", Work::Steps(c::run)),
    ("firmware", Work::Command(firmware::run)),
    ("fuzz", Work::Command(fuzz::run)),
    ("peers", Work::Steps(peers::run)),
    ("osqp", Work::Command(osqp::run)),
    ("mutants", Work::Command(mutants::run)),
];

const HELP: &str = "\
Usage: cargo xtask VERB

Verbs:
  test      formatting, clippy, tests, boards; with --all what need not run each time, too
  quick     format, clippy and tests of the packages that the working tree changes
  house     rules of the house that no compiler holds, with those that break them
  no-std    the kernel links without std and without an allocator; breaches are caught
  sanitize  sweeps under AddressSanitizer: no access outside of an array
  results   meshio and PyVista read the files of a solve and of ticks (Python, from its registry)
  python    the Python module: built by pip in a fresh environment, tested beside the command line
  setup     installs the tools for microcontrollers (Debian, as root)
  cross     the kernel and all images for Cortex-M4 and M7
  boards    the images on emulated boards, bit for bit as on the desk
  audit     no allocator, panic, formatting, f64, unused code in the images
  size      flash, RAM and stack by kind of scene
  cost      instructions of every stage, against record and targets
  c         controllers from C: bits, instructions, headers, states, examples
  firmware  any scene on an emulated board: bits, instructions, RAM, flash, stack
  fuzz      arbitrary bytes into readers, constructors and ticks; a record of how many
  peers     other solvers on the same board and problems; not part of `test`
  osqp      builds OSQP for the trade study; the last line is the program's path
  mutants   does a test fail for every single change of the kernel? (minutes)

Examples:
  cargo xtask test         before every commit, and what CI runs
  cargo xtask test --all   fuzzing, sanitizer, mutants, MPI, OSQP, old processors, PyVista, every board, too
  cargo xtask no-std    after a change of the kernel's dependencies
  cargo xtask cost --bless    writes the record anew (boards, c, cost, peers and size have one)
  cargo xtask firmware meshes/scenes/levee.toml    and `cargo xtask firmware --help`
  cargo xtask fuzz --runs 1000000 mesh    goes on fuzzing the mesh reader

Each verb but `firmware`, `fuzz`, `mutants` and `osqp` runs all its steps, whichever fail. The last line is `N passed, N failed`; the exit
status is 0 only where nothing failed, 2 for a wrong command line. A missing tool is a failure.";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let Some((&name, arguments)) = words.split_first() else { return wrong("no verb given") };
    if let Err(why) = checkout::find() {
        eprintln!("error: {why}");
        return ExitCode::from(2);
    }
    match VERBS.iter().find(|(verb, _)| *verb == name).map(|(_, work)| work) {
        Some(Work::Command(command)) => command(arguments),
        _ if words.iter().any(|word| ["--help", "-h", "help"].contains(word)) => {
            println!("{HELP}");
            ExitCode::SUCCESS
        }
        Some(Work::Steps(work)) => match arguments {
            [] | ["--bless"] | ["--all"] => {
                // Images of one name differ from verb to verb.
                let _turn = match hold(&target_dir("firmware").join("steps.lock")) {
                    Ok(turn) => turn,
                    Err(why) => return wrong(&why),
                };
                let bless = arguments == ["--bless"];
                // A record is written whole.
                let mut steps = Steps::new(Mode { bless, is_whole: !arguments.is_empty() });
                work(&mut steps);
                steps.finish()
            }
            [extra, ..] => wrong(&format!(
                "`{name}` takes no argument but `--bless` or `--all`, not `{extra}`"
            )),
        },
        None => wrong(&format!("no verb `{name}`")),
    }
}

fn wrong(message: &str) -> ExitCode {
    eprintln!("error: {message}\n\n{HELP}");
    ExitCode::from(2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_help_has_a_line_for_each_verb() {
        let (_, rest) = HELP.split_once("Verbs:\n").expect("a list");
        let (list, _) = rest.split_once("\n\n").expect("its end");
        let named: Vec<_> =
            list.lines().filter_map(|line| line.split_whitespace().next()).collect();
        assert_eq!(named, VERBS.map(|(name, _)| name));
    }
}

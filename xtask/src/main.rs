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
mod venv;

use std::process::ExitCode;

use signorini_image::cargo::target_dir;
use signorini_image::checkout;
use signorini_image::lock::hold;

use steps::{Mode, Steps};

/// A verb of the command line.
struct Verb {
    name: &'static str,
    about: &'static str,
    work: Work,
}

/// What a verb does.
enum Work {
    /// Steps, all of them whichever fail, with no argument but `--bless` and `--all`.
    Steps(fn(&mut Steps)),
    /// One thing, with arguments and a help of its own.
    Command(fn(&[&str]) -> ExitCode),
}

const VERBS: [Verb; 19] = [
    Verb {
        name: "test",
        about: "formatting, clippy, tests, boards; with --all what need not run each time, too",
        work: Work::Steps(test::run),
    },
    Verb {
        name: "quick",
        about: "format, clippy and tests of the packages that the working tree changes",
        work: Work::Steps(quick::run),
    },
    Verb {
        name: "house",
        about: "rules of the house that no compiler holds, with those that break them",
        work: Work::Steps(house::run),
    },
    Verb {
        name: "no-std",
        about: "the kernel links without std and without an allocator; breaches are caught",
        work: Work::Steps(no_std::run),
    },
    Verb {
        name: "sanitize",
        about: "sweeps under AddressSanitizer: no access outside of an array",
        work: Work::Steps(sanitize::run),
    },
    Verb {
        name: "results",
        about: "meshio and PyVista read the files of a solve and of ticks (Python, from its registry)",
        work: Work::Steps(results::run),
    },
    Verb {
        name: "python",
        about: "the Python module: built by pip in a fresh environment, tested beside the command line",
        work: Work::Steps(python::run),
    },
    Verb {
        name: "setup",
        about: "installs the tools for microcontrollers (Debian, as root)",
        work: Work::Steps(setup::run),
    },
    Verb {
        name: "cross",
        about: "the kernel and all images for Cortex-M4 and M7",
        work: Work::Steps(cross::run),
    },
    Verb {
        name: "boards",
        about: "the images on emulated boards, bit for bit as on the desk",
        work: Work::Steps(boards::run),
    },
    Verb {
        name: "audit",
        about: "no allocator, panic, formatting, f64, unused code in the images",
        work: Work::Steps(audit::run),
    },
    Verb {
        name: "size",
        about: "flash, RAM and stack by kind of scene",
        work: Work::Steps(size::run),
    },
    Verb {
        name: "cost",
        about: "instructions of every stage, against record and targets",
        work: Work::Steps(cost::run),
    },
    Verb {
        name: "c",
        about: "controllers from C: bits, instructions, headers, states, examples",
        work: Work::Steps(c::run),
    },
    Verb {
        name: "firmware",
        about: "any scene on an emulated board: bits, instructions, RAM, flash, stack",
        work: Work::Command(firmware::run),
    },
    Verb {
        name: "fuzz",
        about: "arbitrary bytes into readers, constructors and ticks; a record of how many",
        work: Work::Command(fuzz::run),
    },
    Verb {
        name: "peers",
        about: "other solvers on the same board and problems; not part of `test`",
        work: Work::Steps(peers::run),
    },
    Verb {
        name: "osqp",
        about: "builds OSQP for the trade study; the last line is the program's path",
        work: Work::Command(osqp::command),
    },
    Verb {
        name: "mutants",
        about: "does a test fail for every single change of the kernel? (minutes)",
        work: Work::Command(mutants::command),
    },
];

const EXAMPLES: &str = "\
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
    match find(name).map(|verb| &verb.work) {
        Some(Work::Command(command)) => command(arguments),
        _ if words.iter().any(|word| ["--help", "-h", "help"].contains(word)) => {
            println!("{}", help());
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

fn find(name: &str) -> Option<&'static Verb> {
    VERBS.iter().find(|verb| verb.name == name)
}

fn wrong(message: &str) -> ExitCode {
    eprintln!("error: {message}\n\n{}", help());
    ExitCode::from(2)
}

fn help() -> String {
    let verb = |verb: &Verb| format!("  {:<10}{}\n", verb.name, verb.about);
    let verbs: String = VERBS.iter().map(verb).collect();
    format!("Usage: cargo xtask VERB\n\nVerbs:\n{verbs}\n{EXAMPLES}")
}

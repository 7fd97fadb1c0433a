//! The project's task runner: `cargo xtask --help`. A file per verb; it runs tools and needs none
//! of the project's crates, so it compiles in seconds.

mod audit;
mod board;
mod boards;
mod cargo;
mod cost;
mod cross;
mod export;
mod no_std;
mod peers;
mod record;
mod replay;
mod setup;
mod size;
mod snapshot;
mod steps;
mod symbols;
mod test;
mod toolchain;

use std::process::ExitCode;

use steps::Steps;

/// A verb of the command line.
struct Verb {
    name: &'static str,
    about: &'static str,
    run: fn(&mut Steps),
}

const VERBS: [Verb; 9] = [
    Verb {
        name: "test",
        about: "everything: formatting, clippy, tests, and all that follows",
        run: test::run,
    },
    Verb {
        name: "no-std",
        about: "the kernel links without std and without an allocator; breaches are caught",
        run: no_std::run,
    },
    Verb {
        name: "setup",
        about: "installs the tools for microcontrollers (Debian, as root)",
        run: setup::run,
    },
    Verb {
        name: "cross",
        about: "the kernel and all images for Cortex-M4 and M7",
        run: cross::run,
    },
    Verb {
        name: "boards",
        about: "the images on emulated boards, bit for bit as on the desk",
        run: boards::run,
    },
    Verb {
        name: "audit",
        about: "no allocator, panic, formatting, f64, unused code in the images",
        run: audit::run,
    },
    Verb { name: "size", about: "flash, RAM and stack by kind of scene", run: size::run },
    Verb {
        name: "cost",
        about: "instructions of every stage, against record and targets",
        run: cost::run,
    },
    Verb {
        name: "peers",
        about: "other solvers on the same board and problems; not part of `test`",
        run: peers::run,
    },
];

const EXAMPLES: &str = "\
Examples:
  cargo xtask test      before every commit, and what CI runs
  cargo xtask no-std    after a change of the kernel's dependencies
  cargo xtask cost --bless    writes the record anew (boards, cost, peers and size have one)

Each verb runs all its steps, whichever fail. The last line is `N passed, N failed`; the exit status
is 0 only where nothing failed, 2 for a wrong command line. A missing tool is a failure.";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    if words.iter().any(|word| ["--help", "-h", "help"].contains(word)) {
        println!("{}", help());
        return ExitCode::SUCCESS;
    }
    match (words.as_slice(), words.first().and_then(|name| find(name))) {
        ([_] | [_, "--bless"], Some(verb)) => {
            let mut steps = Steps::new(words.contains(&"--bless"));
            (verb.run)(&mut steps);
            steps.finish()
        }
        ([], _) => wrong("no verb given"),
        ([name, ..], None) => wrong(&format!("no verb `{name}`")),
        ([name, extra, ..], Some(_)) => {
            wrong(&format!("`{name}` takes no argument but `--bless`, not `{extra}`"))
        }
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
    let verb = |verb: &Verb| format!("  {:<8}{}\n", verb.name, verb.about);
    let verbs: String = VERBS.iter().map(verb).collect();
    format!("Usage: cargo xtask VERB\n\nVerbs:\n{verbs}\n{EXAMPLES}")
}

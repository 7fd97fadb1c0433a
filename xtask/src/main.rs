//! The project's task runner: `cargo xtask --help`. A file per verb; it runs tools and needs none
//! of the project's crates, so it compiles in seconds.

mod cargo;
mod no_std;
mod steps;
mod symbols;
mod test;

use std::process::ExitCode;

use steps::Steps;

/// A verb of the command line.
struct Verb {
    name: &'static str,
    about: &'static str,
    run: fn(&mut Steps),
}

const VERBS: [Verb; 2] = [
    Verb {
        name: "test",
        about: "formatting, clippy, all tests, documentation, and what no-std checks",
        run: test::run,
    },
    Verb {
        name: "no-std",
        about: "the kernel links without std and without an allocator; breaches are caught",
        run: no_std::run,
    },
];

const EXAMPLES: &str = "\
Examples:
  cargo xtask test      before every commit, and what CI runs
  cargo xtask no-std    after a change of the kernel's dependencies

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
        ([_], Some(verb)) => {
            let mut steps = Steps::default();
            (verb.run)(&mut steps);
            steps.finish()
        }
        ([], _) => wrong("no verb given"),
        ([name, ..], None) => wrong(&format!("no verb `{name}`")),
        ([name, extra, ..], Some(_)) => {
            wrong(&format!("`{name}` takes no argument, not `{extra}`"))
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

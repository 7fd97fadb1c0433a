//! The command line of `cargo xtask fuzz`.

use super::target::Target;

/// What to fuzz, and how long.
#[derive(Debug)]
pub struct Options {
    /// The targets.
    pub targets: Vec<Target>,
    /// Executions of each target that count for the record; none: a bounded run that changes nothing.
    pub runs: Option<u64>,
}

pub const HELP: &str = "\
Usage: cargo xtask fuzz [--runs N] [TARGET…]

Feeds arbitrary bytes, guided by coverage, to the targets: mesh, scene, expression, constructors, tick [all].
Without --runs the corpora and all cases ever found are replayed, and mutations of them up to 10000
executions a target, the same every time; nothing is written unless something is found.

Options:
  --runs N    N executions of each target; adds them to tests/fuzz/record.txt and keeps the smallest corpus
              of the coverage reached

Examples:
  cargo xtask fuzz
  cargo xtask fuzz --runs 1000000 mesh scene
  target/fuzz/…/release/mesh tests/fuzz/found/mesh/crash-…    runs one case

What is found stands in tests/fuzz/found/TARGET. The exit status is 0 where nothing is, 2 for a wrong command
line. `cargo fuzz` works in tests too, with a nightly toolchain and its sanitizers.
";

impl Options {
    /// Reads the words after the verb.
    pub fn parse(words: &[&str]) -> Result<Self, String> {
        let (mut targets, mut runs) = (Vec::new(), None);
        let mut words = words.iter();
        while let Some(&word) = words.next() {
            match word {
                "--runs" => {
                    let count = words.next().and_then(|count| count.parse().ok());
                    runs = Some(count.filter(|&count| count > 0).ok_or("--runs takes a number")?);
                }
                option if option.starts_with('-') => return Err(format!("no option `{option}`")),
                name => {
                    let found = Target::ALL.into_iter().find(|target| target.name == name);
                    targets.push(found.ok_or_else(|| format!("no target `{name}`"))?);
                }
            }
        }
        if targets.is_empty() {
            targets.extend(Target::ALL);
        }
        Ok(Self { targets, runs })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn targets_and_runs_stand_in_any_order() {
        let options = Options::parse(&["mesh", "--runs", "7", "tick"]).unwrap();
        let names: Vec<_> = options.targets.iter().map(|target| target.name).collect();
        assert_eq!((names, options.runs), (vec!["mesh", "tick"], Some(7)));
        let all = Options::parse(&[]).unwrap();
        assert_eq!((all.targets.len(), all.runs), (Target::ALL.len(), None));
    }

    #[test]
    fn wrong_words_are_named() {
        let why = |words: &[&str]| Options::parse(words).map(drop).unwrap_err();
        assert!(why(&["meshes"]).contains("`meshes`"));
        assert!(why(&["--fast"]).contains("`--fast`"));
        assert!(why(&["--runs"]).contains("--runs") && why(&["--runs", "0"]).contains("--runs"));
    }
}

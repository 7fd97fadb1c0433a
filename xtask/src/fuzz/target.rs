//! A target: its program, its cases, its runs.

use std::fs;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use signorini_image::cargo::{root, target_dir};
use signorini_image::files::{self, emptied, folder, within};
use signorini_image::toolchain::host;

/// An entry function of `signorini_tests::hostile` under libFuzzer.
#[derive(Debug, Clone, Copy)]
pub struct Target {
    /// Its name.
    pub name: &'static str,
    /// Most bytes of an input.
    longest: u32,
}

/// The counts of a run.
#[derive(Debug)]
pub struct Run {
    /// Executions.
    pub executions: u64,
    /// Edges reached.
    pub edges: u64,
}

/// Seconds that one execution may take: a hang is a finding.
const PATIENCE: u32 = 20;

impl Target {
    /// All targets.
    pub const ALL: [Self; 5] = [
        Self { name: "mesh", longest: 4096 },
        Self { name: "scene", longest: 2048 },
        Self { name: "expression", longest: 512 },
        Self { name: "constructors", longest: 1024 },
        Self { name: "tick", longest: 1024 },
    ];

    /// The target of this name.
    pub fn named(name: &str) -> Result<Self, String> {
        let found = Self::ALL.into_iter().find(|target| target.name == name);
        found.ok_or_else(|| "no such target".to_owned())
    }

    /// Replays all cases, and goes on from there until so many executions; the same every time.
    pub fn bounded(&self, runs: u64) -> Result<Run, String> {
        let scratch = emptied(&self.scratch("bounded"))?;
        self.run(runs, &["-seed=1"], &[&scratch, &self.folder("corpus"), &self.folder("found")])
    }

    /// Goes on from all cases for so many executions, then leaves the smallest corpus that covers as much.
    pub fn long(&self, runs: u64) -> Result<Run, String> {
        let (grown, corpus) = (self.scratch("grown"), self.folder("corpus"));
        folder(&grown)?;
        let run = self.run(runs, &[], &[&grown, &corpus, &self.folder("found")])?;
        let smallest = emptied(&self.scratch("smallest"))?;
        // By edges alone: how often each is passed would keep thousands of inputs.
        let mut merge = self.command(&["-set_cover_merge=1", "-use_counters=0"])?;
        merge.args([&smallest, &grown, &corpus]).stdout(Stdio::null()).stderr(Stdio::null());
        if !merge.status().is_ok_and(|status| status.success()) {
            return Err(format!("{}: its corpus could not be merged", self.name));
        }
        emptied(&corpus)?;
        for file in within(&smallest)? {
            let name = file.file_name().unwrap_or_default();
            fs::copy(&file, corpus.join(name)).map_err(|error| error.to_string())?;
        }
        Ok(run)
    }

    /// Cases of the corpus, and cases found.
    pub fn cases(&self) -> Result<[u64; 2], String> {
        let count = |kind| Ok::<_, String>(within(&folder(&self.folder(kind))?)?.len() as u64);
        Ok([count("corpus")?, count("found")?])
    }

    /// Runs it on these folders, the first of which takes what is new.
    fn run(&self, runs: u64, more: &[&str], folders: &[&Path]) -> Result<Run, String> {
        println!("{}: {runs} executions", self.name);
        let found = self.folder("found");
        for folder in folders.iter().copied().chain([found.as_path()]) {
            files::folder(folder)?;
        }
        let mut command = self.command(more)?;
        command.arg(format!("-runs={runs}")).args(["-print_final_stats=1", "-reduce_inputs=0"]);
        command.arg(format!("-artifact_prefix={}/", found.display())).args(folders);
        let mut child =
            command.stderr(Stdio::piped()).spawn().map_err(|error| error.to_string())?;
        let mut tally = Tally::default();
        for line in
            child.stderr.take().into_iter().flat_map(|pipe| BufReader::new(pipe).split(b'\n'))
        {
            let line = line.map_err(|error| error.to_string())?;
            tally.read(&String::from_utf8_lossy(&line));
        }
        let status = child.wait().map_err(|error| error.to_string())?;
        match tally.run() {
            Some(run) if status.success() => {
                println!("{}: clean, {} edges", self.name, run.edges);
                Ok(run)
            }
            _ => {
                let last = tally.last.join("\n");
                Err(format!("{}: {status}; the case is in {}\n{last}", self.name, found.display()))
            }
        }
    }

    fn command(&self, more: &[&str]) -> Result<Command, String> {
        let program = target_dir("fuzz").join(host()?).join("release").join(self.name);
        let mut command = Command::new(program);
        command.current_dir(root()).args(more);
        command.args([format!("-max_len={}", self.longest), format!("-timeout={PATIENCE}")]);
        let dictionary = root().join(format!("tests/fuzz/dictionaries/{}.txt", self.name));
        if dictionary.is_file() {
            command.arg(format!("-dict={}", dictionary.display()));
        }
        Ok(command)
    }

    fn folder(&self, kind: &str) -> PathBuf {
        root().join("tests/fuzz").join(kind).join(self.name)
    }

    fn scratch(&self, kind: &str) -> PathBuf {
        target_dir("fuzz").join(kind).join(self.name)
    }
}

/// The counts that libFuzzer tells of a run.
#[derive(Debug, Default)]
struct Tally {
    executions: Option<u64>,
    edges: Option<u64>,
    /// The last lines, in which a failure stands.
    last: Vec<String>,
}

impl Tally {
    /// Takes lines like `#8192 pulse  cov: 1234 ft: …` and `stat::number_of_executed_units: 10000`.
    fn read(&mut self, line: &str) {
        if let Some(count) = line.strip_prefix("stat::number_of_executed_units:") {
            self.executions = count.trim().parse().ok();
        }
        if let Some((_, rest)) = line.split_once(" cov: ").filter(|_| line.starts_with('#')) {
            self.edges = rest.split(' ').next().and_then(|count| count.parse().ok());
        } else {
            self.last.push(line.to_owned());
            let excess = self.last.len().saturating_sub(40);
            self.last.drain(..excess);
        }
    }

    fn run(&self) -> Option<Run> {
        Some(Run { executions: self.executions?, edges: self.edges? })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn executions_and_edges_are_read_off_the_output() {
        let mut tally = Tally::default();
        for line in [
            "#2 INITED cov: 120 ft: 121 corp: 1/1b exec/s: 0 rss: 30Mb",
            "#10000 DONE   cov: 345 ft: 400 corp: 9/90b lim: 20 exec/s: 0 rss: 31Mb",
            "panicked at cov: 7 is no line of it",
            "stat::number_of_executed_units: 10000",
        ] {
            tally.read(line);
        }
        let run = tally.run().unwrap();
        assert_eq!((run.executions, run.edges), (10_000, 345));
        assert!(Tally::default().run().is_none());
        assert_eq!(tally.last.len(), 2);
    }
}

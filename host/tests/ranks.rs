//! Campaigns on two ranks of MPI: `cargo test --package signorini --features mpi --test ranks`.

use std::env;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::thread::sleep;
use std::time::Duration;

use signorini_files::atomic::write_atomically;
use signorini_lab::trade::Trade;
use signorini_lab::trade::journal::Journal;
use signorini_lab::trade::mpi::on_ranks;
use signorini_lab::trade::shard::Shard;
use signorini_scene::error::{Error, Result};
use tempfile::tempdir;

const FOLDER: &str = "SIGNORINI_TEST_FOLDER";
const FATE: &str = "SIGNORINI_TEST_FATE";
const CASES: usize = 11;

/// `program` on two ranks; one that hangs is ended.
fn two_ranks(program: &Path) -> Command {
    let mut command = Command::new("mpirun");
    command.args(["--allow-run-as-root", "--oversubscribe", "--timeout", "100", "-n", "2"]);
    command.arg(program);
    command
}

/// Runs [`rank`] twice; `fate` is what happens to the second.
fn campaign(folder: &Path, fate: &str) -> Output {
    let mut command = two_ranks(&env::current_exe().unwrap());
    command.args(["rank", "--exact", "--ignored", "--nocapture", "--test-threads=1"]);
    command.env(FOLDER, folder).env(FATE, fate).output().expect("mpirun starts")
}

fn shown(output: &Output) -> String {
    let [stdout, stderr] =
        [&output.stdout, &output.stderr].map(|text| String::from_utf8_lossy(text));
    format!("{stdout}{stderr}")
}

#[test]
#[ignore = "one rank of the campaigns below"]
fn rank() {
    let folder = PathBuf::from(env::var_os(FOLDER).expect("started by a test below"));
    let fate = env::var(FATE).unwrap();
    let mut own = String::new();
    let ended = on_ranks(|shard| {
        if shard.is_whole() {
            return merge(&folder);
        }
        own = shard.to_string();
        let failing = own == "2/2";
        assert!(failing || own == "1/2", "{own}");
        assert!(!(failing && fate == "panics"), "as asked");
        measure(&folder, shard, |case| {
            let fails = failing && fate == "fails" && case > CASES / 2;
            if fails { Err(Error::Check(format!("case {case} fails"))) } else { Ok(()) }
        })
    });
    let status = ended.unwrap_or_else(|error| error.exit_status());
    println!("\nshard {own} ends with {status}");
    assert_eq!(status, 0);
}

/// Cases of a shard: a case's square root is what is found.
fn measure(folder: &Path, shard: Shard, check: impl Fn(usize) -> Result<()>) -> Result<()> {
    let mut journal = Journal::open(folder, shard, "roots")?;
    for case in (0..CASES).filter(|&case| shard.takes(case)) {
        check(case)?;
        journal.add(&case.to_string(), &(case as f64).sqrt())?;
    }
    Ok(())
}

/// Writes what is known, case by case, with gaps where nothing is. It takes its time: a launcher would
/// kill it by then if a failed rank did not wait.
fn merge(folder: &Path) -> Result<()> {
    sleep(Duration::from_millis(500));
    let journal = Journal::open(folder, Shard::WHOLE, "roots")?;
    let roots = (0..CASES).map(|case| journal.known(&case.to_string()));
    let roots: Vec<Option<f64>> = roots.collect();
    write_atomically(&folder.join("roots.json"), serde_json::json!(roots).to_string().as_bytes())?;
    journal.close()
}

/// The journal that rank 0 merged; the others are gone.
fn merged(folder: &Path) -> Vec<Option<f64>> {
    let names = folder.read_dir().unwrap().map(|entry| entry.unwrap().file_name());
    assert_eq!(names.collect::<Vec<_>>(), ["roots.json"]);
    serde_json::from_slice(&std::fs::read(folder.join("roots.json")).unwrap()).unwrap()
}

fn roots(known: impl Fn(usize) -> bool) -> Vec<Option<f64>> {
    (0..CASES).map(|case| known(case).then(|| (case as f64).sqrt())).collect()
}

#[test]
fn two_ranks_share_the_cases() {
    let folder = tempdir().unwrap();
    let output = campaign(folder.path(), "is well");
    assert!(output.status.success(), "{}", shown(&output));
    assert_eq!(merged(folder.path()), roots(|_| true));
}

#[test]
fn a_rank_that_fails_hangs_none_and_what_there_is_is_merged() {
    let folder = tempdir().unwrap();
    let output = campaign(folder.path(), "fails");
    assert!(!output.status.success());
    for shard in ["1/2", "2/2"] {
        let ends = format!("shard {shard} ends with 1");
        assert!(shown(&output).contains(&ends), "{}", shown(&output));
    }
    assert_eq!(merged(folder.path()), roots(|case| case % 2 == 0 || case <= CASES / 2));
}

#[test]
fn a_rank_that_panics_hangs_none() {
    let folder = tempdir().unwrap();
    let output = campaign(folder.path(), "panics");
    assert!(!output.status.success());
    assert!(shown(&output).contains("shard 1/2 ends with 101"), "{}", shown(&output));
    assert_eq!(merged(folder.path()), roots(|case| case % 2 == 0));
}

/// The points of a study, without what a measurement of time leaves in them.
fn points(folder: &Path) -> Vec<(String, String, String)> {
    let path = folder.join("trade.json");
    let text = std::fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let trade: Trade = serde_json::from_slice(&text).unwrap();
    let points = trade.points.into_iter();
    points.map(|p| (p.name, format!("{:?}", p.setting), format!("{:?}", p.error))).collect()
}

/// One scene is shared by its settings, two are shared as wholes.
#[test]
fn a_trade_study_on_two_ranks_is_that_of_one_process() {
    let signorini = Path::new(env!("CARGO_BIN_EXE_signorini"));
    let meshes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../meshes/catalogue");
    for scenes in [&["b-quad"][..], &["b-quad", "patch-mixed"]] {
        let files: Vec<_> =
            scenes.iter().map(|name| meshes.join(name).with_extension("toml")).collect();
        let [alone, shared] = [tempdir().unwrap(), tempdir().unwrap()];
        for (mut command, out) in
            [(Command::new(signorini), &alone), (two_ranks(signorini), &shared)]
        {
            command.args(["trade", "--no-peers"]).args(&files).arg("--out").arg(out.path());
            let output = command.output().unwrap();
            assert!(output.status.success(), "{}", shown(&output));
        }
        for scene in scenes {
            let folder =
                |root: &Path| if scenes.len() > 1 { root.join(scene) } else { root.to_owned() };
            let [alone, shared] = [&alone, &shared].map(|root| points(&folder(root.path())));
            assert!(!alone.is_empty());
            assert_eq!(alone, shared, "{scene}");
        }
    }
}

//! The peers' sources, from Debian's packages and the Python registry, into the target folder.

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::python::environment;
use signorini_image::cargo::{root, run, target_dir};
use signorini_image::files;
use signorini_image::toolchain::output;

/// Versions as `requirements.txt` pins them, with checksums.
pub const VERSIONS: &str = "DAQP 0.7.2, OSQP 1.1.3";

const DAQP: &str = "daqp-0.7.2";

/// Packages that OSQP's generator imports and the metadata of DAQP's source asks for; none of it reaches a board.
const TOOLS: [&str; 8] = [
    "setuptools==80.9.0",
    "wheel==0.45.1",
    "Cython==3.1.4",
    "numpy==2.4.6",
    "scipy==1.17.1",
    "Jinja2==3.1.6",
    "MarkupSafe==3.0.4",
    "joblib==1.6.0",
];

/// The files to compile for a solver, beside its adapter.
#[derive(Debug, Clone)]
pub struct Code {
    /// C files.
    pub files: Vec<PathBuf>,
    /// Folders of headers.
    pub headers: Vec<PathBuf>,
    /// Further flags of the compiler.
    pub flags: &'static [&'static str],
}

/// The folder with the fetched sources, and the Python that fetched them.
#[derive(Debug, Clone)]
pub struct Sources {
    folder: PathBuf,
    python: PathBuf,
}

impl Sources {
    /// Fetches what is not there yet.
    pub fn fetch() -> Result<Self, String> {
        let folder = files::folder(&target_dir("firmware").join("peers"))?;
        let python = environment("peers", &[&["--no-deps"][..], &TOOLS].concat(), &[])?;
        let sources = Self { folder, python };
        let complete = sources.folder.join("complete");
        if fs::read_to_string(&complete).ok().as_deref() != Some(VERSIONS) {
            println!("fetching {VERSIONS}");
            sources.pinned()?;
            files::write(&complete, VERSIONS)?;
        }
        Ok(sources)
    }

    /// DAQP as source, OSQP as a wheel, both with the checksums of `requirements.txt`.
    fn pinned(&self) -> Result<(), String> {
        let list = root().join("tests/firmware/peers/requirements.txt");
        let download = "-m pip download --quiet --no-deps --no-build-isolation --require-hashes";
        let download = download.split(' ').chain(["--no-binary", "daqp", "--only-binary", "osqp"]);
        let folder = self.folder.as_os_str();
        let places = [OsStr::new("-r"), list.as_os_str(), OsStr::new("-d"), folder];
        self.python(download.map(OsStr::new).chain(places))?;
        let offline = "-m pip install --quiet --no-deps --no-index osqp --find-links";
        self.python(offline.split(' ').map(OsStr::new).chain([folder]))?;
        let mut unpack = Command::new("tar");
        unpack.arg("xzf").arg(self.folder.join(format!("{DAQP}.tar.gz"))).arg("-C").arg(folder);
        run(unpack)
    }

    /// The two numbers that `problem.py` prints of a header and another file.
    pub fn problem(&self, verb: &str, header: &Path, file: &Path) -> Result<[f64; 2], String> {
        let said =
            output(Command::new(&self.python).arg(script()).arg(verb).arg(header).arg(file))?;
        let numbers: Vec<f64> = said.split_whitespace().filter_map(|x| x.parse().ok()).collect();
        numbers.try_into().map_err(|_| format!("problem.py says `{said}`"))
    }

    /// `Ok` where it solves what is solved by hand.
    pub fn check(&self) -> Result<(), String> {
        output(Command::new(&self.python).arg(script()).arg("check")).map(drop)
    }

    fn python<'a>(&self, words: impl IntoIterator<Item = &'a OsStr>) -> Result<(), String> {
        let mut command = Command::new(&self.python);
        command.args(words);
        run(command)
    }

    /// DAQP, with the flags of its own build.
    pub fn daqp(&self) -> Result<Code, String> {
        let folder = self.folder.join(DAQP).join("csrc");
        Ok(Code {
            files: c_files(&folder.join("src"))?,
            headers: vec![folder.join("include")],
            flags: &[
                "-DDAQP_SINGLE_PRECISION",
                "-fassociative-math",
                "-fno-signed-zeros",
                "-fno-trapping-math",
            ],
        })
    }

    /// OSQP, written by its generator for the problem in `header`.
    pub fn osqp(&self, header: &Path, folder: &Path) -> Result<Code, String> {
        let script = root().join("tests/firmware/peers/osqp_workspace.py");
        let code = folder.join("osqp");
        self.python([script.as_os_str(), header.as_os_str(), code.as_os_str()])?;
        let mut files = c_files(&code.join("src"))?;
        files.push(code.join("workspace.c"));
        let headers = vec![code.clone(), code.join("inc/public"), code.join("inc/private")];
        Ok(Code { files, headers, flags: &[] })
    }
}

fn script() -> PathBuf {
    root().join("tests/firmware/peers/problem.py")
}

/// The C files of a folder, in order: the image is to be the same every time.
fn c_files(folder: &Path) -> Result<Vec<PathBuf>, String> {
    let mut files = files::within(folder)?;
    files.retain(|file| file.extension() == Some(OsStr::new("c")));
    files.sort();
    Ok(files)
}

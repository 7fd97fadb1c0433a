//! Results of a stage, in lines: short things in full, arrays as a digest of their digits.
//!
//! Rust prints the shortest digits that give a float back, so equal text is equal bits.

use std::fmt::{Debug, Write as _};
use std::fs;
use std::path::{Path, PathBuf};

use signorini_device::tick::{Figures, Report};
use signorini_kernel::Error;
use signorini_kernel::report::Ended;

use super::arrays::Arrays;
use super::scene::SCENES;

/// A stage on every scene, in both scalars.
pub fn replay(name: &str, narrow: Stage<f32>, wide: Stage<f64>) {
    let mut journal = Journal::beside(name);
    for scene in &SCENES {
        journal.title(scene.name, "f32");
        Arrays::new(scene).and_then(|arrays| narrow(&arrays, &mut journal)).expect("f32");
        journal.compare();
        journal.title(scene.name, "f64");
        Arrays::new(scene).and_then(|arrays| wide(&arrays, &mut journal)).expect("f64");
        journal.compare();
    }
    journal.finish();
}

type Stage<R> = fn(&Arrays<R>, &mut Journal) -> Result<(), Error>;

pub struct Journal {
    path: PathBuf,
    text: String,
    recorded: String,
}

impl Journal {
    /// Empty, beside the record of that name.
    pub fn beside(name: &str) -> Self {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/replay/expected");
        let path = folder.join(name).with_extension("txt");
        let recorded = fs::read_to_string(&path).unwrap_or_default();
        Self { path, text: String::new(), recorded }
    }

    pub fn title(&mut self, scene: &str, scalar: &str) {
        writeln!(self.text, "# {scene}, {scalar}").unwrap();
    }

    pub fn line(&mut self, name: &str, value: impl Debug) {
        writeln!(self.text, "{name} {value:?}").unwrap();
    }

    /// FNV-1a over the digits.
    pub fn digest(&mut self, name: &str, value: impl Debug) {
        let mix = |hash: u64, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        let hash = nameless(&format!("{value:?}")).bytes().fold(0xcbf2_9ce4_8422_2325, mix);
        writeln!(self.text, "{name} {hash:016x}").unwrap();
    }

    /// A digest of what a tick on a mesh reports, in the order of the record.
    pub fn report<R: Copy + Debug>(&mut self, of: Report<R>) {
        #[derive(Debug)]
        #[expect(dead_code, reason = "read by Debug alone")]
        struct Recorded<R, V> {
            ended: Ended,
            sweeps: u32,
            residual: R,
            active: u32,
            changes: u32,
            force: R,
            verdict: V,
            omega: R,
        }
        let Figures { residual, changes, force, omega } = of.figures;
        let (ended, sweeps, active, verdict) = (of.ended, of.sweeps, of.active, of.verdict);
        let recorded = Recorded { ended, sweeps, residual, active, changes, force, verdict, omega };
        self.digest("report", recorded);
    }

    /// Compares what there is with the record.
    pub fn compare(&self) {
        if std::env::var_os("BLESS").is_some() {
            return;
        }
        let mut title = "";
        for (line, expected) in self.text.lines().zip(self.recorded.lines()) {
            if line.starts_with('#') {
                title = line;
            }
            assert_eq!(nameless(line), nameless(expected), "{title}");
        }
        assert!(self.text.lines().count() <= self.recorded.lines().count(), "longer than recorded");
    }

    /// Compares the end, too; or writes the record, where that is asked for.
    pub fn finish(&self) {
        if std::env::var_os("BLESS").is_some() {
            fs::write(&self.path, &self.text).expect("a file that can be written");
            return;
        }
        let [own, recorded] = [&self.text, &self.recorded].map(|text| text.lines().count());
        assert_eq!(own, recorded, "the record is longer");
    }
}

/// Without the names of types and fields, which may change where no bit does.
fn nameless(text: &str) -> String {
    let ends = |letter: char| !(letter.is_alphanumeric() || letter == '_' || letter == '.');
    let is_value = |word: &str| matches!(word, "true" | "false" | "inf" | "NaN");
    let is_name = |word: &str| word.starts_with(char::is_alphabetic) && !is_value(word);
    let words = text.split_inclusive(ends).map(|word| match word.split_at(word.len() - 1) {
        (name, end) if is_name(name) && end.starts_with([':', ' ', '(']) => end,
        _ => word,
    });
    words.collect()
}

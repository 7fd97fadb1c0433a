//! Images of the solvers: built, run, and what they print.

use std::path::Path;
use std::process::Command;

use super::sources::Code;
use signorini_image::board::{Build, M4F};
use signorini_image::cargo::{root, run};
use signorini_image::objects::{ARM, sections, symbols};

/// Instructions a count of the board's clock.
const UNIT: u64 = 40;

/// The core of the board, with its unit for f32. Constants without a suffix are f32, as is all else.
const FLAGS: [&str; 9] = [
    "-mcpu=cortex-m4",
    "-mthumb",
    "-mfloat-abi=hard",
    "-mfpu=fpv4-sp-d16",
    "-O2",
    "-ffunction-sections",
    "-fdata-sections",
    "-fsingle-precision-constant",
    "-fno-math-errno",
];

/// One tick.
#[derive(Debug, Clone, PartialEq)]
pub struct PeerTick {
    /// From the load to the solution.
    pub instructions: u64,
    /// The solution.
    pub x: Vec<f32>,
}

/// The ticks that an image tells, and the memory that it takes.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// Bytes of the solver's code.
    pub code: u64,
    /// Bytes of its memory, the heap included, the stack not.
    pub ram: u64,
    /// All ticks in order.
    pub ticks: Vec<PeerTick>,
}

impl Measured {
    /// x of every tick, a line each.
    pub fn answers(&self) -> String {
        let words = |tick: &PeerTick| tick.x.iter().map(|x| format!("{x:?} ")).collect::<String>();
        self.ticks.iter().map(|tick| words(tick) + "\n").collect()
    }
}

/// Builds and runs a peer.
pub fn peer(name: &str, code: &Result<Code, String>, folder: &Path) -> Result<Measured, String> {
    let code = code.as_ref().map_err(Clone::clone)?;
    let own = root().join("tests/firmware/peers");
    let gcc = || {
        let mut command = Command::new("arm-none-eabi-gcc");
        command.args(FLAGS).args(["-Wl,--gc-sections", "-I"]).arg(folder).arg("-I").arg(&own);
        command
    };
    // The solver by itself, with what its adapter reaches: its sections are what it takes.
    let solver = folder.join(format!("{name}.o"));
    let mut link = gcc();
    code.headers.iter().for_each(|headers| {
        link.arg("-I").arg(headers);
    });
    link.args(code.flags).args(["-r", "-nostdlib", "-Wl,-u,set_up,-e,solve"]);
    link.arg(own.join(format!("{name}.c"))).args(&code.files).arg("-o").arg(&solver);
    run(link)?;
    let image = folder.join(format!("{name}.elf"));
    let mut link = gcc();
    link.args(["-nostartfiles", "--specs=nosys.specs", "-T"]).arg(own.join("board.ld"));
    link.arg(own.join("board.c")).arg(own.join("main.c")).arg(&solver);
    link.args(["-lm", "-o"]).arg(&image);
    run(link)?;
    let (heap, ticks) = parse(&M4F.run(&image, true)?)?;
    let sections = sections(&solver)?;
    // Bytes of code, of initialised and of zeroed memory.
    let [code, data, bss] = [".text", ".data", ".bss"].map(|kind| {
        sections
            .iter()
            .filter(|(name, _)| name.starts_with(kind))
            .map(|(_, size)| size)
            .sum::<u64>()
    });
    Ok(Measured { code, ram: data + bss + heap, ticks })
}

/// Builds and runs the kernel's image: `exact` takes the scene baked from the same problem, prints the same
/// lines as the peers, and has its tick in a function `solve`.
pub fn kernel(folder: &Path, is_limited: bool) -> Result<Measured, String> {
    let (package, bins) = ("signorini-scene", &["exact"]);
    let scenes = folder.join("contact.rs");
    let features: &[&str] =
        if is_limited { &["exact", "signorini-device/limited"] } else { &["exact"] };
    let what = Build { package, bins, features, scenes: &scenes };
    let (mut command, built) = M4F.build(what)?;
    command.env("SIGNORINI_SCENE", &scenes);
    run(command)?;
    let image = built.join("exact");
    let (ram, ticks) = parse(&M4F.run(&image, true)?)?;
    let own = |name: &str| {
        ["signorini_kernel", "signorini_contact", "5solve"].iter().any(|part| name.contains(part))
    };
    let symbols = symbols(ARM, &image)?;
    let code = symbols.iter().filter(|symbol| own(&symbol.name)).map(|symbol| symbol.size).sum();
    Ok(Measured { code, ram, ticks })
}

/// Lines of an image: `@ heap BYTES`, then `COUNTS BITS BITS …` for every tick.
fn parse(said: &str) -> Result<(u64, Vec<PeerTick>), String> {
    let mut lines = said.lines();
    let heap = lines.next().and_then(|line| line.strip_prefix("@ heap ")?.parse().ok());
    let ticks: Option<_> = lines.map(tick).collect();
    heap.zip(ticks).ok_or_else(|| "the image prints something else than ticks".to_owned())
}

fn tick(line: &str) -> Option<PeerTick> {
    let (counts, bits) = line.split_once(' ')?;
    let counts: u32 = counts.parse().ok()?;
    let scalar = |bits| Some(f32::from_bits(u32::from_str_radix(bits, 16).ok()?));
    let x: Option<_> = bits.split(' ').map(scalar).collect();
    // The clock says u32::MAX where it went round.
    (counts < u32::MAX).then_some(PeerTick { instructions: UNIT * u64::from(counts), x: x? })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_counts_and_bits() {
        let said = "@ heap 4096\n215 3f800000 bf000000\n";
        let tick = PeerTick { instructions: 8600, x: vec![1.0, -0.5] };
        assert_eq!(parse(said), Ok((4096, vec![tick])));
        let refused = Err("the image prints something else than ticks".to_owned());
        assert_eq!(parse("@ heap 4096\n4294967295 3f800000\n"), refused);
        assert_eq!(parse("@ heap 4096\n215 3f800000\na tick fails\n"), refused);
        assert_eq!(parse(""), refused);
    }
}

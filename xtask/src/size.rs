//! `cargo xtask size`: what the images of baked scenes take, by what the scenes contain.

use std::fs;

use crate::baked::Recipe;
use crate::record;
use crate::setup;
use crate::steps::Steps;
use signorini_image::board::{M4F_192K, emulator};
use signorini_image::cargo::root;
use signorini_image::footprint::Footprint;
use signorini_image::record::sizes;
use signorini_image::ticks::Ticks;
use signorini_image::toolchain::Toolchain;

const RECORD: &str = "tests/firmware/size.txt";

/// A kind of scene.
struct Kind {
    what: &'static str,
    scene: &'static str,
    model: &'static str,
    /// Bytes of code that its image may have.
    most: u64,
}

/// What is condensed, then what is solved on its mesh; the leanest first.
const KINDS: [Kind; 10] = [
    Kind {
        what: "linear, condensed",
        scene: "tests/firmware/scenes/linear.toml",
        model: "--condensed",
        most: 8 * 1024,
    },
    Kind {
        what: "strip, condensed, swept",
        scene: "meshes/scenes/strip.toml",
        model: "--condensed",
        most: 34 * 1024,
    },
    Kind {
        what: "levee, condensed",
        scene: "meshes/scenes/levee.toml",
        model: "--condensed",
        most: 34 * 1024,
    },
    Kind {
        what: "levee on 50 000 unknowns, condensed",
        scene: "tests/firmware/scenes/levee-96.toml",
        model: "--condensed",
        most: 34 * 1024,
    },
    Kind {
        what: "slab, condensed, on quads",
        scene: "meshes/scenes/slab.toml",
        model: "--condensed",
        most: 34 * 1024,
    },
    Kind {
        what: "anti-icing, limits and modes",
        scene: "meshes/scenes/antiicing.toml",
        model: "--condensed",
        most: 48 * 1024,
    },
    Kind {
        what: "levee, on triangles",
        scene: "tests/firmware/scenes/levee-swept.toml",
        model: "--full",
        most: 30 * 1024,
    },
    Kind {
        what: "slab, on quads, transfer laws",
        scene: "tests/firmware/scenes/slab-swept.toml",
        model: "--full",
        most: 38 * 1024,
    },
    Kind {
        what: "strip, on both",
        scene: "tests/firmware/scenes/strip-swept.toml",
        model: "--full",
        most: 38 * 1024,
    },
    Kind {
        what: "strip, by a factor",
        scene: "tests/firmware/scenes/strip-factored.toml",
        model: "--full",
        most: 58 * 1024,
    },
];

/// Bakes, builds, runs and prints.
pub fn run(steps: &mut Steps) {
    setup::run(steps);
    let bless = steps.blesses();
    steps.check("flash, RAM and stack", || {
        let rows: Result<Vec<_>, String> =
            KINDS.iter().map(|kind| Ok((kind.what, footprint(kind)?))).collect();
        let table = sizes::write(&rows?);
        println!("{table}");
        let versions =
            format!("{}, {}", Toolchain::find("thumbv7em-none-eabihf")?.version()?, emulator()?);
        if record::compare(RECORD, &versions, &table, bless)? { quoted(&table) } else { Ok(()) }
    });
}

/// Bakes a scene, builds its image and plays it.
fn footprint(kind: &Kind) -> Result<Footprint, String> {
    let Kind { what, scene, model, most } = kind;
    let module = Recipe::of(scene, model).bake()?;
    let image = module.image(&M4F_192K, &[])?;
    let of = Footprint::new(&image, &Ticks::parse(&M4F_192K.run(&image, false)?))?;
    match of.statics.code {
        code if code > *most => Err(format!("{what}: {code} bytes of code, {most} are allowed")),
        _ => Ok(of),
    }
}

/// `Ok` where the page on firmware shows this table, up to what records may differ by: the folder of a clone
/// moves constants by a few bytes.
fn quoted(table: &str) -> Result<(), String> {
    const PAGE: &str = "docs/firmware.md";
    let page = fs::read_to_string(root().join(PAGE)).map_err(|error| error.to_string())?;
    let head = table.lines().next().unwrap_or_default();
    let (_, shown) = page.split_once(head).ok_or(format!("{PAGE} does not show the table"))?;
    let shown: Vec<_> = shown.lines().take(table.lines().count()).collect();
    let differs = record::differences(&format!("{head}{}", shown.join("\n")), table)?;
    if differs.is_empty() { Ok(()) } else { Err(format!("{PAGE}: {}", differs.join("; "))) }
}

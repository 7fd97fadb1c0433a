//! The Rust text of the full model: header, memory of exactly the scene's size, the method of its ticks, and data.

use std::fmt::Write as _;

use signorini_kernel::limits::Limits;

use super::arrays::Baked;
use super::listing::{self, listed};
use super::options::TickOptions;
use super::sizes::sizes;
use crate::Bakes;
use crate::controller::{self, Parts, state};
use crate::text::imports;
use signorini_problem::scalar::Scalar;

/// The module.
pub fn source<R: Bakes>(baked: &Baked<R>) -> String {
    let index = baked.index();
    let (features, sizes, counts) = (baked.features(), sizes(baked), baked.counts);
    let about = format!(
        "The full model in {}: {} unknowns, {} of them contact edges, on {} triangles and {} quads{}{}. \
         {} bytes of RAM in a [`Controller`], {} bytes of data in flash.",
        R::NAME,
        counts.unknowns(),
        counts.contact,
        baked.of_triangles.len(),
        baked.of_quads.len(),
        if baked.factored.is_some() { ", solved by a factor" } else { "" },
        if baked.how.certified {
            ""
        } else {
            ", without an error bound (certificate = false leaves it out)"
        },
        sizes.ram,
        sizes.flash
    );
    let mut text = baked.face.source::<R>("full", about, &features);
    let _ = write!(text, "\n/// Positions in the arrays.\ntype Index = {index};\n");
    let mut own = lengths(baked) + &controller(baked);
    if baked.stored.is_some() {
        own += &state("{ LENGTHS.handed_on() }");
    }
    text += &(required(&features) + &imports(NAMES, &own, "") + &own);
    text + &listed(baked).module(listing::NAMES, "Index, Scalar")
}

/// The build fails, and says why, where the kernel lacks code for the scene.
fn required(features: &[&str]) -> String {
    let assertion = |name: &&str| {
        let constant = name.to_ascii_uppercase();
        format!(
            "const _: () = assert!(signorini_device::kernel::features::{constant}, \"signorini-device \
             lacks its feature `{name}`\");\n"
        )
    };
    "\n".to_owned() + &features.iter().map(assertion).collect::<String>()
}

/// Items of the kernel that the controller may use.
const NAMES: &str = "\
    kernel::Libm kernel::Micromath full::ArrayStorage full::controller::ByFactor \
    full::controller::ControllerStorage full::controller::Setup full::Lengths full::Units sparse \
    tick::CertifiedSweeps tick::UncertifiedSweeps";

/// The scene with its memory, and the alias.
fn controller<R: Bakes>(baked: &Baked<R>) -> String {
    let how = &baked.how;
    let (storage, zeros) = memory(baked);
    let Limits { error, share, sweeps } = how.limits;
    let factored = if baked.factored.is_some() { "Some(&data::FACTORED)" } else { "None" };
    let setup = format!(
        "Setup {{ lengths: &LENGTHS, factored: {factored}, units: {:?} }}",
        baked.kernel_units()
    );
    let parts = Parts {
        first: "starts cold",
        from: if how.cold { "from a cold start" } else { "from where the last tick ended" },
        ends: ends(baked),
        limits: &format!("Limits {{ error: {error:?}, share: {share:?}, sweeps: {sweeps} }}"),
        is_cold: how.cold,
        storage: &storage,
        zeros: &zeros,
        lent: ["data::FULL", &setup],
    };
    controller::controller(&parts, &baked.face, &baked.exclusions)
}

/// How long its memory is: the kernel works it out of the statics, when the module is compiled.
fn lengths<R: Scalar>(baked: &Baked<R>) -> String {
    let own = "
/// How long the arrays are that change.
const LENGTHS: Lengths = Lengths::of(&data::FULL);
";
    let exchanges = "
/// Blocks, numbers and flags of the exchanges on contact edges.
const EXCHANGES: [usize; 3] = sparse::storage::lengths(LENGTHS.active);
";
    own.to_owned() + if baked.factored.is_some() { exchanges } else { "" }
}

/// The type of the memory, and what it is before the first tick.
fn memory<R: Scalar>(baked: &Baked<R>) -> (String, String) {
    let width = baked.width();
    let own = format!(
        "ArrayStorage<
            Scalar,
            Index,
            {width},
            {{ LENGTHS.rows }},
            {{ LENGTHS.numbers.sum() }},
            {{ LENGTHS.active }},
            {{ LENGTHS.neumann }},
            {{ LENGTHS.robin }},
            {{ LENGTHS.curved }},
        >"
    );
    let TickOptions { fast, certified, .. } = baked.how;
    let math = if fast { "Micromath" } else { "Libm" };
    let sweeps = if certified { "CertifiedSweeps" } else { "UncertifiedSweeps" };
    let (mut solver, mut zeros) = (format!("{sweeps}<{math}>"), format!("{sweeps}({math})"));
    if baked.factored.is_some() {
        let sizes = "{ EXCHANGES[0] }, { EXCHANGES[1] }, { EXCHANGES[2] }";
        solver = format!("ByFactor<sparse::ArrayStorage<Scalar, {sizes}>, {solver}>");
        zeros = format!("ByFactor {{ exchanges: sparse::ArrayStorage::zeros(), sweeps: {zeros} }}");
    }
    (
        format!(
            "ControllerStorage<\n        {own},\n        {solver},\n        [Scalar; OUTPUTS],\n        Index,\n        {width},\n    >"
        ),
        format!("ControllerStorage::of(ArrayStorage::zeros(), {zeros}, [0.0; OUTPUTS])"),
    )
}

/// The limits of a tick.
fn ends<R: Scalar>(baked: &Baked<R>) -> &'static str {
    let how = &baked.how;
    match (how.limits.share > R::ZERO, how.certified) {
        _ if baked.factored.is_some() => {
            "with the solution; where the factor does not find it, after these sweeps"
        }
        (false, _) => "after exactly so many sweeps",
        (true, false) => "once the residual is down to rounding",
        (true, true) => {
            "once sweeps have brought the algebraic part of the error bound down to this share of it"
        }
    }
}

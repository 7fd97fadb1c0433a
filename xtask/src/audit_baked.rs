//! Kinds of code that the images of baked scenes lack, functions that were inlined included.
//!
//! Each kind of code is looked for where it must not be, and by the same names where it must be: a renamed
//! function, or a list that misses, fails one of the two.

use std::path::Path;

use crate::absence::{ALLOCATOR, Absence, DOUBLE, FORMATTING, PANIC};
use crate::symbols::{inlined, sized};

const ALWAYS: [Absence; 4] = [FORMATTING, ALLOCATOR, PANIC, DOUBLE];

/// Mesh, rows, assembly, sweeps over them, the forest, and the error bound of cells.
const FULL: Absence = Absence {
    what: "code of the full model",
    is: |name| {
        let modules = [
            "kernel4mesh",
            "kernel7element",
            "kernel8assembly",
            "kernel3csr",
            "kernel4rows",
            "kernel6system",
            "kernel3law",
            "kernel4psor",
            "kernel4flux",
            "kernel7contact",
            "bound5cells",
            "bound6forest",
            "bound8averages",
            "bound10conforming",
            "bound11equilibrium",
            "device4tick",
            "device4full",
        ];
        let own = |rest: &str| modules.iter().any(|module| rest.starts_with(module));
        let parts = ["4walk", "4quad", "8triangle", "8boundary", "5parts"];
        let bound = |rest: &str| {
            let part = rest.strip_prefix("bound11certificate");
            part.is_some_and(|rest| parts.iter().any(|part| rest.starts_with(part)))
        };
        name.split("signorini_").skip(1).any(|rest| own(rest) || bound(rest))
    },
};
/// All that solves a condensed problem.
const SOLVER: Absence = Absence {
    what: "code for contact",
    is: |name| {
        ["dense3sor", "dense8pivoting", "dense7tableau", "dense6blocks12multiply_add"]
            .iter()
            .any(|part| name.contains(part))
    },
};
const TRIANGLES_CODE: Absence = Absence {
    what: "triangle code",
    is: |name| {
        [
            "averages12of_triangles",
            "gather_triangles",
            "over_triangles",
            "certificate8triangle",
            "flux11on_triangle",
            "crouzeix",
        ]
        .iter()
        .any(|part| name.contains(part))
    },
};
const QUADS_CODE: Absence = Absence {
    what: "quad code",
    is: |name| {
        [
            "averages8of_quads",
            "gather_cells",
            "add_quads",
            "certificate4quad",
            "flux7on_quad",
            "rannacher",
        ]
        .iter()
        .any(|part| name.contains(part))
    },
};
/// The error bound on a mesh. (That of a condensed model is its own.)
const BOUND: Absence = Absence {
    what: "code of the error bound",
    is: |name| {
        let modules = ["bound8averages", "bound10conforming", "bound11equilibrium"];
        let certificate = ["7certify", "4walk", "8boundary", "4quad", "8triangle", "5parts"]
            .map(|part| format!("bound11certificate{part}"));
        let names = || modules.iter().copied().chain(certificate.iter().map(String::as_str));
        let own = |rest: &str| names().any(|part| rest.starts_with(part));
        name.split("signorini_").skip(1).any(own)
    },
};
const ROBIN: Absence = Absence { what: "Robin code", is: |name| name.contains("E5robin") };

/// Kinds of code that an image is free of, and kinds that are found in it by the same names.
#[derive(Debug, Clone, Copy)]
pub struct Audit {
    lacks: &'static [Absence],
    holds: &'static [Absence],
}

impl Audit {
    /// Condensed, with nothing in contact.
    pub const LINEAR: Self =
        Self { lacks: &[FULL, TRIANGLES_CODE, QUADS_CODE, ROBIN, SOLVER], holds: &[] };
    /// Condensed, solved by exchanges.
    pub const EXCHANGES: Self =
        Self { lacks: &[FULL, TRIANGLES_CODE, QUADS_CODE, ROBIN], holds: &[SOLVER] };
    /// Swept on triangles.
    pub const TRIANGLES: Self =
        Self { lacks: &[SOLVER, QUADS_CODE, ROBIN], holds: &[FULL, TRIANGLES_CODE, BOUND] };
    /// Swept on triangles without a bound.
    pub const PLAIN: Self =
        Self { lacks: &[SOLVER, QUADS_CODE, ROBIN, BOUND], holds: &[FULL, TRIANGLES_CODE] };
    /// Swept on quads, with transfer laws.
    pub const QUADS: Self =
        Self { lacks: &[SOLVER, TRIANGLES_CODE], holds: &[FULL, QUADS_CODE, ROBIN] };
    /// Swept on both kinds of cells.
    pub const BOTH: Self =
        Self { lacks: &[SOLVER, ROBIN], holds: &[FULL, TRIANGLES_CODE, QUADS_CODE] };
    /// By a factor, on both kinds of cells.
    pub const FACTOR: Self =
        Self { lacks: &[ROBIN], holds: &[SOLVER, FULL, TRIANGLES_CODE, QUADS_CODE] };
}

/// `Ok` where the image is free of what it must not have, and has what it must.
pub fn check(audit: &Audit, image: &Path) -> Result<(), String> {
    judge(audit, &functions(image)?)
}

fn judge(image: &Audit, names: &[String]) -> Result<(), String> {
    for absence in ALWAYS.iter().chain(image.lacks) {
        if let Some(name) = names.iter().find(|name| (absence.is)(name)) {
            return Err(format!("{}: {name}", absence.what));
        }
    }
    match image.holds.iter().find(|held| !names.iter().any(|name| (held.is)(name))) {
        Some(held) => Err(format!("no {} is found, which must be there", held.what)),
        None => Ok(()),
    }
}

/// All functions of the image, and those of the kernel that were inlined.
fn functions(image: &Path) -> Result<Vec<String>, String> {
    let is_own = |name: &str| {
        ["kernel", "contact", "device"]
            .iter()
            .any(|part| name.contains(&format!("signorini_{part}")))
    };
    let kernel = inlined(image)?.into_iter().filter(|name| is_own(name));
    let mut names: Vec<_> = sized(image)?.into_iter().map(|(name, _)| name).collect();
    let own = names.len();
    names.extend(kernel);
    // Without these names the image shows little.
    if names.len() > own { Ok(names) } else { Err("no inlined function of the kernel".to_owned()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_must_not_and_what_must_be_there_are_both_asked_for() {
        let solver = "_RNvNtNtCs1_17signorini_contact5dense3sor5sweepf".to_owned();
        let mesh = "_RNvNtCs1_16signorini_kernel8assembly4loadft".to_owned();
        let (linear, levee) = (&Audit::LINEAR, &Audit::EXCHANGES);
        assert_eq!(judge(linear, &[]), Ok(()));
        let refused = |image, names: &[String]| judge(image, names).expect_err("refused");
        assert!(refused(linear, std::slice::from_ref(&solver)).contains(&solver));
        assert_eq!(judge(levee, std::slice::from_ref(&solver)), Ok(()));
        assert_eq!(
            refused(levee, &[]),
            format!("no {} is found, which must be there", SOLVER.what)
        );
        assert!(refused(levee, &[solver, mesh.clone()]).contains(&mesh));
    }

    #[test]
    fn the_bound_of_a_condensed_model_is_its_own() {
        let of = |path: &str| (FULL.is)(&format!("_RNvCs1_{path}"));
        assert!(of("15signorini_bound11certificate4walk10over_cells"));
        assert!(
            !of("15signorini_bound11certificate11Certificatef")
                && !of("17signorini_contact11certificate4Form")
        );
        let bound = |path: &str| (BOUND.is)(&format!("_RNvCs1_{path}"));
        assert!(bound("15signorini_bound11certificate7certifyft"));
        assert!(bound("15signorini_bound11equilibrium6impose"));
        assert!(!bound("16signorini_kernel4psor5sweep"));
        assert!(!bound("17signorini_contact11certificate7certify"));
    }
}

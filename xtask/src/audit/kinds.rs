//! Kinds of code by the names of functions, and what an image has of them and has not.
//!
//! Each kind of code is looked for where it must not be, and by the same names where it must be: a renamed
//! function, or a list that misses, fails one of the two.

/// A kind of code.
#[derive(Debug)]
pub struct Kind {
    /// For a person.
    pub what: &'static str,
    /// By the mangled name of a function.
    pub is: fn(&str) -> bool,
}

/// Whether a name holds one of these.
fn has(name: &str, parts: &[&str]) -> bool {
    parts.iter().any(|part| name.contains(part))
}

/// Text of values.
pub const FORMATTING: Kind = Kind { what: "formatting", is: |name| name.contains("3fmt") };
/// A heap: Rust's allocator, mangled or not, or C's.
pub const ALLOCATOR: Kind = Kind {
    what: "allocator",
    is: |name| {
        let of_c = ["malloc", "calloc", "realloc", "free"];
        let rust = ["__rust_alloc", "__rust_realloc", "__rust_dealloc"];
        has(name, &rust) || of_c.contains(&name.trim_start_matches('_'))
    },
};
/// Ways out that the kernel has no need of.
pub const PANIC: Kind = Kind { what: "panic", is: |name| name.contains("panic") };
/// The compiler's helpers for f64, by the run-time ABI's names and by their own.
pub const DOUBLE: Kind = Kind {
    what: "f64 helper",
    is: |name| {
        let abi = name.strip_prefix("__aeabi_").is_some_and(|rest| {
            rest.starts_with('d') || rest.starts_with("cd") || rest.ends_with("2d")
        });
        let own = name.rsplit_once("__").is_some_and(|(_, own)| {
            let ends = ["df3", "df2", "dfsf2", "dfsi", "dfdi", "sidf", "didf"];
            own.bytes().all(|byte| byte.is_ascii_alphanumeric())
                && ends.iter().any(|end| own.ends_with(end))
        });
        abi || own
    },
};

/// The functions that only quads need; none is inlined in images of stages.
pub const QUAD_STAGES: Kind = Kind {
    what: "quad code",
    is: |name| {
        let parts =
            ["of_quads", "gather_cells", "add_quads", "fill_quads", "7recover", "rannacher"];
        has(name, &parts)
    },
};
/// `psor::sweep` as its mangled name has it, and not `psor::sweep_free`.
pub const CONTACT: Kind = Kind { what: "contact code", is: |name| name.contains("4psor5sweep") };

/// Mesh, rows, assembly, sweeps over them, the forest, and the error bound of cells.
const FULL: Kind = Kind {
    what: "code of the full model",
    is: |name| {
        let modules = [
            "signorini_kernel4mesh",
            "signorini_kernel7element",
            "signorini_kernel8assembly",
            "signorini_kernel3csr",
            "signorini_kernel4rows",
            "signorini_kernel6system",
            "signorini_kernel3law",
            "signorini_kernel4psor",
            "signorini_kernel4flux",
            "signorini_kernel7contact",
            "signorini_bound5cells",
            "signorini_bound6forest",
            "signorini_device4tick",
            "signorini_device4full",
        ];
        has(name, &modules) || has(name, &BOUND_MODULES) || has(name, &CERTIFICATE)
    },
};
/// Modules of the error bound on a mesh.
const BOUND_MODULES: [&str; 3] =
    ["signorini_bound8averages", "signorini_bound10conforming", "signorini_bound11equilibrium"];
/// Functions of its certificate.
const CERTIFICATE: [&str; 5] = [
    "signorini_bound11certificate4walk",
    "signorini_bound11certificate4quad",
    "signorini_bound11certificate8triangle",
    "signorini_bound11certificate8boundary",
    "signorini_bound11certificate5parts",
];
/// The error bound on a mesh. (That of a condensed model is its own.)
const BOUND: Kind = Kind {
    what: "code of the error bound",
    is: |name| {
        let certify = name.contains("signorini_bound11certificate7certify");
        certify || has(name, &BOUND_MODULES) || has(name, &CERTIFICATE)
    },
};
/// All that solves a condensed problem.
const SOLVER: Kind = Kind {
    what: "code for contact",
    is: |name| {
        let parts = ["dense3sor", "dense8pivoting", "dense7tableau", "dense6blocks12multiply_add"];
        has(name, &parts)
    },
};
const TRIANGLES: Kind = Kind {
    what: "triangle code",
    is: |name| {
        let parts = [
            "averages12of_triangles",
            "gather_triangles",
            "over_triangles",
            "certificate8triangle",
            "flux11on_triangle",
            "crouzeix",
        ];
        has(name, &parts)
    },
};
const QUADS: Kind = Kind {
    what: "quad code",
    is: |name| {
        let parts = [
            "averages8of_quads",
            "gather_cells",
            "add_quads",
            "certificate4quad",
            "flux7on_quad",
            "rannacher",
        ];
        has(name, &parts)
    },
};
/// A method, mangled by either scheme.
const ROBIN: Kind = Kind { what: "Robin code", is: |name| has(name, &["E5robin", "$GT$5robin"]) };

/// Kinds of code that an image is free of, beside those of [`Audit::ALWAYS`], and kinds that are found in it by the same names.
#[derive(Debug, Clone, Copy)]
pub struct Audit {
    lacks: &'static [Kind],
    holds: &'static [Kind],
}

impl Audit {
    /// Symbols that no image has.
    const ALWAYS: [Kind; 4] = [FORMATTING, ALLOCATOR, PANIC, DOUBLE];

    /// Stages on triangles alone.
    pub const TRIANGLE_STAGES: Self = Self { lacks: &[QUAD_STAGES], holds: &[] };
    /// Stages on triangles with nothing in contact.
    pub const LINEAR_STAGES: Self = Self { lacks: &[QUAD_STAGES, CONTACT], holds: &[] };
    /// Stages on both kinds of cells.
    pub const MIXED_STAGES: Self = Self { lacks: &[], holds: &[QUAD_STAGES] };

    /// Condensed, with nothing in contact.
    pub const LINEAR: Self = Self { lacks: &[FULL, TRIANGLES, QUADS, ROBIN, SOLVER], holds: &[] };
    /// Condensed, solved by exchanges.
    pub const EXCHANGES: Self = Self { lacks: &[FULL, TRIANGLES, QUADS, ROBIN], holds: &[SOLVER] };
    /// Swept on triangles.
    pub const TRIANGLES: Self =
        Self { lacks: &[SOLVER, QUADS, ROBIN], holds: &[FULL, TRIANGLES, BOUND] };
    /// Swept on triangles without a bound.
    pub const PLAIN: Self =
        Self { lacks: &[SOLVER, QUADS, ROBIN, BOUND], holds: &[FULL, TRIANGLES] };
    /// Swept on quads, with transfer laws.
    pub const QUADS: Self = Self { lacks: &[SOLVER, TRIANGLES], holds: &[FULL, QUADS, ROBIN] };
    /// Swept on both kinds of cells.
    pub const BOTH: Self = Self { lacks: &[SOLVER, ROBIN], holds: &[FULL, TRIANGLES, QUADS] };
    /// By a factor, on both kinds of cells.
    pub const FACTOR: Self = Self { lacks: &[ROBIN], holds: &[SOLVER, FULL, TRIANGLES, QUADS] };

    /// `Ok` where functions of these names are free of what must not be, and have what must be.
    pub fn judge(&self, names: &[String]) -> Result<(), String> {
        free_of(names, &Self::ALWAYS)?;
        free_of(names, self.lacks)?;
        match self.holds.iter().find(|held| !names.iter().any(|name| (held.is)(name))) {
            Some(held) => Err(format!("no {} is found, which must be there", held.what)),
            None => Ok(()),
        }
    }
}

/// `Err` with the first name that is of one of these kinds.
pub fn free_of(names: &[String], kinds: &[Kind]) -> Result<(), String> {
    for kind in kinds {
        if let Some(name) = names.iter().find(|name| (kind.is)(name)) {
            return Err(format!("{}: {name}", kind.what));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinds_are_known_by_name() {
        let abi =
            ["__aeabi_dmul", "__aeabi_ddiv", "__aeabi_f2d", "__aeabi_ui2d", "__aeabi_cdcmple"];
        let own = ["__truncdfsf2", "__muldf3", "__fixdfsi"];
        let others = [
            "__aeabi_uldivmod",
            "__aeabi_memcpy",
            "__aeabi_fmul",
            "__mulsf3",
            "__udivmoddi4",
            // A number in a name, which ends as a helper's does.
            "linear_between_of_b318f3a05e7897bc_5295ddf2",
            "a__b_between_of_b318f3a05e7897bc_5295ddf2",
        ];
        let heap = ["_RNvCsfLfy6EI15iL_7___rustc12___rust_alloc", "__rust_dealloc", "_malloc"];
        let no_heap = ["memcpy", "force_f32_u16", "_ZN4core5alloc6layout"];
        for (kind, names, is) in [
            (DOUBLE, &[&abi[..], &own].concat()[..], true),
            (DOUBLE, &others, false),
            (ALLOCATOR, &heap, true),
            (ALLOCATOR, &no_heap, false),
        ] {
            names.iter().for_each(|name| assert_eq!((kind.is)(name), is, "{name}"));
        }
    }

    #[test]
    fn what_must_not_and_what_must_be_there_are_both_asked_for() {
        let solver = "_RNvNtNtCs1_17signorini_contact5dense3sor5sweepf".to_owned();
        let mesh = "_RNvNtCs1_16signorini_kernel8assembly4loadft".to_owned();
        let (linear, levee) = (Audit::LINEAR, Audit::EXCHANGES);
        assert_eq!(linear.judge(&[]), Ok(()));
        let refused = |audit: Audit, names: &[String]| audit.judge(names).expect_err("refused");
        assert!(refused(linear, std::slice::from_ref(&solver)).contains(&solver));
        assert_eq!(levee.judge(std::slice::from_ref(&solver)), Ok(()));
        assert_eq!(refused(levee, &[]), "no code for contact is found, which must be there");
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

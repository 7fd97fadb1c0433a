//! The factor of a scene's matrix, worked out in f64 and rounded once: what solves a tick without sweeps.

use std::fmt::Write as _;

use signorini_contact::dense::blocks::{Block, padded};
use signorini_contact::dense::tableau::InitialTableau;
use signorini_device::sparse::factor::normalise;
use signorini_device::sparse::{self, Factor};
use signorini_kernel::Index;

use crate::narrow::narrow;
use crate::statics::Statics;
use signorini_problem::scalar::Scalar;
use signorini_problem::{Assembled, Problem};
use signorini_scene::error::Result;
use signorini_solve::{Ldlt, unfit};

/// L, D and S as the target takes them.
#[derive(Debug, Clone)]
pub(super) struct Factored<R> {
    ldlt: Ldlt<R>,
    scale: Vec<R>,
    /// Exchanges begin with none.
    none: Vec<bool>,
}

impl<R: Scalar> Factored<R> {
    /// That of `problem`; nothing where its matrix is singular, or its factor too large, in f64.
    pub fn new(problem: &Problem) -> Result<Option<Self>> {
        let unfit = unfit::<f64>(&problem.scene);
        let assembled = Assembled::<f64>::new(problem).map_err(&unfit)?;
        let system = assembled.system().map_err(&unfit)?;
        let Some(mut ldlt) = Ldlt::new(&system).map_err(&unfit)? else { return Ok(None) };
        let contact = ldlt.counts.contact;
        let mut scale = vec![0.0; padded(contact)];
        if !normalise(&mut ldlt.schur, &mut scale, contact) {
            return Ok(None);
        }
        let block = |block: &Block<f64>| block.map(|row| row.map(R::narrow));
        let Ldlt { counts, places, pointers, rows, values, inverse, schur } = ldlt;
        let (values, inverse) = (narrow(&values), narrow(&inverse));
        let schur = schur.iter().map(block).collect();
        let ldlt = Ldlt { counts, places, pointers, rows, values, inverse, schur };
        Ok(Some(Self { ldlt, scale: narrow(&scale), none: vec![false; padded(contact)] }))
    }

    /// As the kernel takes it.
    pub fn view(&self) -> sparse::Factored<'_, R, u32> {
        let Self { ldlt, scale, none } = self;
        let factor: Factor<R, u32> = ldlt.factor();
        let start = InitialTableau { blocks: &ldlt.schur, exchanged: none };
        sparse::Factored { factor, schur: &ldlt.schur, scale, start }
    }

    /// Entries of L.
    pub fn entries(&self) -> usize {
        self.ldlt.values.len()
    }

    /// Writes everything in flash, in the index type `I`.
    #[rustfmt::skip] // A table.
    pub fn write<I: Index>(&self, to: &mut Statics) {
        let Self { ldlt: Ldlt { counts, places, pointers, rows, values, inverse, schur }, scale, none } = self;
        let places = to.array::<I>("PLACES", "When each interior, Neumann or Robin edge is eliminated.", "Index", places);
        let pointers = to.array::<u32>("COLUMNS", "Where the columns of L start, and the last one ends.", "u32", pointers);
        let rows = to.array::<I>("ROWS", "The row of each entry of L.", "Index", rows);
        let values = to.array::<R>("ENTRIES", "The entries of L.", "Scalar", values);
        let inverse = to.array::<R>("INVERSE", "1/D", "Scalar", inverse);
        let schur = to.array::<Block<R>>("SCHUR", "S on the contact edges, the lower triangle of its blocks, scaled to a diagonal of 1.", "[[Scalar; 8]; 8]", schur);
        let scale = to.array::<R>("SCALE", "1/√S_ii of each contact edge.", "Scalar", scale);
        let none = to.array::<bool>("NONE", "Exchanges begin with no edge exchanged.", "bool", none);
        let _ = write!(
            to.text,
            "
    /// The matrix by its factor.
    pub(super) static FACTORED: Factored<'static, Scalar, Index> = Factored {{
        factor: Factor::baked({places}, {pointers}, {rows}, {values}, {inverse}, {counts:?}),
        schur: {schur},
        scale: {scale},
        start: InitialTableau {{ blocks: {schur}, exchanged: {none} }},
    }};
"
        );
    }
}

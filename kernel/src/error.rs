//! Input that has no answer. Each error names the culprit by its number in the caller's arrays.

use core::fmt;

/// Reason why an input was refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Error {
    /// The index type or a fixed capacity is too small.
    Capacity {
        /// The array that is too long.
        of: Array,
        /// How many there are.
        needed: usize,
        /// How many fit.
        limit: usize,
    },
    /// Two arrays that must match do not.
    Length {
        /// The array with the wrong length.
        of: Array,
        /// Its length.
        found: usize,
        /// The length that the other arrays ask for.
        expected: usize,
    },
    /// A number is infinite or NaN.
    NotFinite {
        /// The array that holds it.
        of: Array,
        /// Its position there.
        at: usize,
    },
    /// An index points outside the array that it refers to.
    OutOfRange {
        /// The array that holds the index.
        of: Array,
        /// Its position there.
        at: usize,
    },
    /// A cell names a vertex twice.
    RepeatedVertex(CellId),
    /// The area of a cell is zero, as far as the scalar type can tell.
    Degenerate(CellId),
    /// The vertices of a cell run clockwise.
    Clockwise(CellId),
    /// A quad has a corner of 180° or more, or crosses itself.
    NotConvex(CellId),
    /// The coefficient tensor of a cell is not symmetric positive definite.
    NotPositiveDefinite(CellId),
    /// Shape and coefficient tensor of this cell together are so oblique that its element matrix, rounded to
    /// the scalar, cannot be told from a singular one.
    Oblique(CellId),
    /// Three cells share the edge between these vertices.
    SharedByThree([u32; 2]),
    /// Two cells lie on the same side of the edge between these vertices: they overlap.
    Overlap([u32; 2]),
    /// The boundary edge between these vertices has no condition.
    NoCondition([u32; 2]),
    /// The condition on the boundary edge between these vertices has become one that asks for another
    /// pattern: contact and Dirichlet edges stay what they are, Neumann and Robin may interchange.
    ConditionChanged([u32; 2]),
    /// The transfer coefficient of a Robin edge is negative.
    NegativeRobin {
        /// The edge.
        edge: usize,
    },
    /// A connected part with neither Dirichlet nor Robin edges is pushed off its contact edges
    /// (or, without contact edges, its loads do not balance): no solution exists.
    NoSolution {
        /// A cell of the part.
        cell: usize,
    },
    /// A connected part with neither Dirichlet nor Robin edges is in balance without any contact
    /// force: the solution is not unique.
    NotUnique {
        /// A cell of the part.
        cell: usize,
    },
    /// A connected part has no boundary edge whose flux may change: nothing can take its surplus.
    NoWayOut {
        /// A cell of the part.
        cell: usize,
    },
    /// An input lies outside the range that the scene declares for it, or is not a number.
    InputOutOfRange {
        /// Its number.
        input: usize,
    },
    /// Inputs bring the limit of a contact flux below its least value.
    EmptyRange {
        /// The number of the input that leaves it least room.
        input: usize,
    },
    /// Where two boundary edges meet, one asks for a u that the other excludes.
    Excluded {
        /// The vertex, or its number among those where inputs can do so.
        at: usize,
    },
    /// The relaxation factor is not inside (0, 2).
    Relaxation,
    /// A workspace holds no problem: it has not been built, or not since an error left it half done.
    NotBuilt,
    /// A mesh with other cells than the one that a workspace was built for.
    OtherMesh,
    /// The state of another scene, or of a controller that was baked otherwise.
    ForeignState,
    /// A state of which some numbers have changed since it was sealed.
    DamagedState,
}

/// A cell, by kind and number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CellId {
    /// Position in the array of triangles.
    Triangle(usize),
    /// Position in the array of quads.
    Quad(usize),
}

/// The arrays that the kernel reads and writes, by the names used in its documentation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Array {
    Vertices,
    Triangles,
    Quads,
    Edges,
    HalfEdges,
    Coefficients,
    Stiffness,
    CellLoads,
    Boundary,
    Neumann,
    Robin,
    Storage,
    Contact,
    Dirichlet,
    RowPointers,
    ColumnIndices,
    MatrixValues,
    Rows,
    Load,
    LowerBounds,
    Unknowns,
    Fluxes,
    Scratch,
    Inputs,
    Outputs,
    ContactSpans,
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Capacity { of, needed, limit } => {
                write!(f, "{of:?}: {needed} are needed, {limit} fit")
            }
            Self::Length { of, found, expected } => {
                write!(f, "{of:?}: length {found}, expected {expected}")
            }
            Self::NotFinite { of, at } => write!(f, "{of:?}[{at}] is not a finite number"),
            Self::OutOfRange { of, at } => write!(f, "{of:?}[{at}] points outside its array"),
            Self::RepeatedVertex(cell) => write!(f, "{cell} names a vertex twice"),
            Self::Degenerate(cell) => write!(f, "{cell} has no area"),
            Self::Clockwise(cell) => write!(f, "{cell} runs clockwise: reverse its vertices"),
            Self::NotConvex(cell) => write!(f, "{cell} is not convex"),
            Self::NotPositiveDefinite(cell) => {
                write!(f, "the coefficient tensor of {cell} is not positive definite")
            }
            Self::Oblique(cell) => {
                write!(f, "shape and coefficient tensor of {cell} are too oblique for this scalar")
            }
            Self::SharedByThree([a, b]) => write!(f, "edge {a}-{b} is shared by three cells"),
            Self::Overlap([a, b]) => write!(f, "two cells lie on the same side of edge {a}-{b}"),
            Self::NoCondition([a, b]) => write!(f, "boundary edge {a}-{b} has no condition"),
            Self::ConditionChanged([a, b]) => {
                write!(f, "the condition on boundary edge {a}-{b} asks for another pattern")
            }
            Self::NegativeRobin { edge } => {
                write!(f, "edge {edge} has a negative Robin coefficient")
            }
            Self::NoSolution { cell } => write!(
                f,
                "no solution: the loads push the part around cell {cell} away and nothing holds it"
            ),
            Self::NotUnique { cell } => write!(
                f,
                "no unique solution: the loads on the part around cell {cell} balance by themselves"
            ),
            Self::NoWayOut { cell } => {
                write!(f, "no edge can take the surplus of the part around cell {cell}")
            }
            Self::InputOutOfRange { input } => write!(f, "input {input} is outside its range"),
            Self::EmptyRange { input } => {
                write!(
                    f,
                    "with input {input} the limit of a contact flux is less than its least value"
                )
            }
            Self::Excluded { at } => {
                write!(f, "two boundary edges exclude each other's values of u at vertex {at}")
            }
            Self::Relaxation => write!(f, "the relaxation factor must lie between 0 and 2"),
            Self::NotBuilt => write!(f, "the workspace holds no problem: build it"),
            Self::OtherMesh => write!(f, "the workspace was built for a mesh with other cells"),
            Self::ForeignState => write!(f, "the state is that of another scene"),
            Self::DamagedState => write!(f, "the state has changed since it was sealed"),
        }
    }
}

impl fmt::Display for CellId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Triangle(at) => write!(f, "triangle {at}"),
            Self::Quad(at) => write!(f, "quad {at}"),
        }
    }
}

impl core::error::Error for Error {}

/// Refuses things of a kind for which there is no code.
pub fn known(of: Array, has_code: bool, needed: usize) -> Result<(), Error> {
    if has_code || needed == 0 { Ok(()) } else { Err(Error::Capacity { of, needed, limit: 0 }) }
}

/// `Ok` when an array is as long as the others ask for.
pub fn same_length(of: Array, found: usize, expected: usize) -> Result<(), Error> {
    if found == expected { Ok(()) } else { Err(Error::Length { of, found, expected }) }
}

/// Checks the length of an array that may be left out.
pub fn same_length_or_empty(of: Array, found: usize, expected: usize) -> Result<(), Error> {
    if found == 0 { Ok(()) } else { same_length(of, found, expected) }
}

/// `Ok` when every number of an array is finite.
pub fn all_finite<R: crate::Real>(of: Array, numbers: &[R]) -> Result<(), Error> {
    match numbers.iter().position(|x| !x.finite()) {
        Some(at) => Err(Error::NotFinite { of, at }),
        None => Ok(()),
    }
}

/// max |x| of numbers whose answer has room in the scalar: 1/ε² times as large they are still finite.
pub fn all_moderate<R: crate::Real>(
    of: Array,
    numbers: impl Iterator<Item = R>,
) -> Result<R, Error> {
    let mut most = R::ZERO;
    for (at, x) in numbers.enumerate() {
        // A NaN is taken over as well.
        if !(x.magnitude() <= most) {
            most = x.magnitude();
            if !(most / (R::EPSILON * R::EPSILON)).finite() {
                return Err(Error::NotFinite { of, at });
            }
        }
    }
    Ok(most)
}

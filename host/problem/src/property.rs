//! Properties of a problem that not every approach can treat.

use std::fmt;

use signorini_kernel::mesh::components::PartCounts;

use super::Problem;
use signorini_scene::scene::term::first_in_time;

/// Numbers that the fields behind a condensed model may hold together: 1.6 GB.
pub(super) const MOST_NUMBERS: usize = 200_000_000;

/// Defines the properties with the list of all of them: none is left out.
macro_rules! properties {
    ($($(#[$about:meta])+ $name:ident,)+) => {
        /// Such a property of a problem; its text names what has it. A scene that can state a new one has a variant here: the compiler
        /// then asks [`super::Approach`] what each approach makes of it.
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub enum Property {
            $($(#[$about])+ $name,)+
        }

        impl Property {
            /// In the order in which they are looked for.
            pub(super) const ALL: &[Self] = &[$(Self::$name,)+];
        }
    };
}

properties! {
    /// No edge is in contact.
    NoContact,
    /// The fields of all contact edges and inputs do not fit into memory together.
    ManyContactEdges,
    /// Neither a Dirichlet, Robin nor contact edge belongs to a part of the domain.
    FloatingPart,
    /// Contact edges alone hold a part of the domain.
    PartHeldByContact,
    /// A load depends on t.
    LoadInTime,
    /// An input adds to a transfer coefficient, which stands in the matrix.
    TransferInput,
    /// The flux of a contact boundary has a limit, or no least value.
    Limit,
    /// The problem is a step in time.
    Step,
}

impl Property {
    /// Whether it is read off the connected parts.
    pub(super) const fn is_of_parts(self) -> bool {
        matches!(self, Self::FloatingPart | Self::PartHeldByContact)
    }

    /// Whether `problem` has it; `parts` are those of the problem.
    pub(super) fn is_in(self, problem: &Problem, parts: PartCounts) -> bool {
        match self {
            Self::NoContact => problem.topology.counts.contact == 0,
            Self::ManyContactEdges => numbers_of_fields(problem) > MOST_NUMBERS,
            Self::FloatingPart => parts.floating > 0,
            Self::PartHeldByContact => parts.contact > 0,
            Self::LoadInTime => first_in_time(&problem.scene).is_some(),
            Self::TransferInput => problem.scene.transfer_input().is_some(),
            Self::Limit => problem.scene.limited().is_some(),
            Self::Step => problem.loads.step.is_some(),
        }
    }
}

impl fmt::Display for Property {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NoContact => "a problem without contact",
            Self::ManyContactEdges => "a problem with so many contact edges",
            Self::FloatingPart => "a domain with a part that nothing holds",
            Self::PartHeldByContact => "a domain that contact alone holds",
            Self::LoadInTime => "a load that depends on t",
            Self::TransferInput => "a transfer coefficient that an input changes",
            Self::Limit => "a contact boundary whose flux has a limit",
            Self::Step => "a step in time",
        })
    }
}

/// u and σ·n of a field for every contact edge and input, and the matrix on the contact edges.
fn numbers_of_fields(problem: &Problem) -> usize {
    let counts = problem.topology.counts;
    let fields = counts.contact + problem.scene.inputs.len() + 2;
    fields.saturating_mul(2 * counts.edges() + counts.contact)
}

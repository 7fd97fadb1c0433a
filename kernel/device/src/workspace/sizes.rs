//! The size of a workspace, from numbers that a person knows.

/// The type of a [`Workspace`](crate::Workspace) for meshes of at most this many vertices, triangles, quads and
/// boundary edges, with numbers in `f32` or `f64` and indices in `u16` or `u32`. The other capacities follow:
///
/// * edges: each side of a cell is half of an inner edge or the whole of a boundary edge;
/// * matrix entries: the diagonal, and for each side of a cell the cell's other sides;
/// * entries of a packed row: [`rows::TRIANGLES`](signorini_kernel::rows::TRIANGLES), with quads [`rows::QUADS`](signorini_kernel::rows::QUADS).
///
/// With `ticks only` there is no room for the matrix in rows of a sparse format: it ticks, and does not
/// [`solve`](crate::Workspace::solve).
/// ```
/// use signorini_device::workspace;
///
/// // Four vertices, two triangles, four boundary edges.
/// type Plate = workspace!(f32, u16: vertices 4, triangles 2, quads 0, boundary 4);
/// type Lean = workspace!(f32, u16: vertices 4, triangles 2, quads 0, boundary 4, ticks only);
/// assert!(size_of::<Lean>() < size_of::<Plate>());
/// ```
#[macro_export]
macro_rules! workspace {
    (@ $R:ty, $I:ty, $v:expr, $t:expr, $q:expr, $b:expr, $entries:expr) => {
        $crate::Workspace<
            $R, $I, { $v }, { $t }, { $q }, { $b }, { $t + $q },
            { usize::div_ceil(3 * $t + 4 * $q + $b, 2) + 1 }, { $entries },
            { if $q == 0 { $crate::kernel::rows::TRIANGLES } else { $crate::kernel::rows::QUADS } }
        >
    };
    ($R:ty, $I:ty: vertices $v:expr, triangles $t:expr, quads $q:expr, boundary $b:expr, ticks only) => {
        $crate::workspace!(@ $R, $I, $v, $t, $q, $b, 0)
    };
    ($R:ty, $I:ty: vertices $v:expr, triangles $t:expr, quads $q:expr, boundary $b:expr) => {
        $crate::workspace!(
            @ $R, $I, $v, $t, $q, $b,
            usize::div_ceil(3 * $t + 4 * $q + $b, 2) + 6 * $t + 12 * $q
        )
    };
}

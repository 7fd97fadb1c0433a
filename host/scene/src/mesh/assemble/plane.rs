//! The plane of a mesh: all its vertices have one z, whatever it is.

/// How far from their plane vertices may lie, as part of the size of the mesh: what rotations and
/// CAD kernels leave.
const TOLERANCE: f64 = 1e-9;

/// Two of the `used` points that are not in one plane z = constant, up to a part of the extent in x or y.
pub(in crate::mesh) fn apart(used: &[u32], point: impl Fn(u32) -> [f64; 3]) -> Option<[u32; 2]> {
    let extent = |axis: usize| {
        let range = |(low, high): (f64, f64), &at: &u32| {
            (low.min(point(at)[axis]), high.max(point(at)[axis]))
        };
        let (low, high) = used.iter().fold((f64::INFINITY, f64::NEG_INFINITY), range);
        high - low
    };
    let tolerance = TOLERANCE * extent(0).max(extent(1));
    let &first = used.first()?;
    let is_apart = |&&at: &&u32| (point(at)[2] - point(first)[2]).abs() > tolerance;
    used.iter().find(is_apart).map(|&other| [other, first])
}

/// The fault of these two points and their z, in words.
pub(in crate::mesh) fn why([(name, z), (first, at)]: [(String, f64); 2]) -> String {
    format!("{name} has z = {z}, {first} has z = {at}, expected a mesh in a plane z = constant")
}

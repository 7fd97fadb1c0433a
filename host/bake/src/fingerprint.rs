//! FNV-1a: a number that other bytes hardly have, the same in every build.

use signorini_scene::mesh::Mesh;
use signorini_scene::scene::Scene;

/// The number of no bytes.
const OFFSET: u64 = 0xcbf2_9ce4_8422_2325;
const PRIME: u64 = 0x0000_0100_0000_01b3;

/// A sum that bytes are added to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Fingerprint(pub u64);

impl Default for Fingerprint {
    fn default() -> Self {
        Self(OFFSET)
    }
}

impl Fingerprint {
    /// Adds more bytes.
    pub fn take(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(PRIME);
        }
    }

    /// Adds what a scene says, beside its mesh and the values of its inputs.
    pub fn take_scene(&mut self, scene: &Scene) {
        self.take(scene.text.as_bytes());
        // A fragment's setting is no part of that text.
        scene.setting.iter().for_each(|setting| self.take(format!("{setting:?}").as_bytes()));
    }

    /// Adds a mesh with its names.
    pub fn take_mesh(&mut self, mesh: &Mesh) {
        mesh.vertices.as_flattened().iter().for_each(|x| self.take(&x.to_le_bytes()));
        let corners = mesh.triangles.as_flattened().iter().chain(mesh.quads.as_flattened());
        corners.for_each(|vertex| self.take(&vertex.to_le_bytes()));
        for surface in &mesh.surfaces {
            self.take(surface.name.as_bytes());
            surface.cells.iter().for_each(|cell| self.take(&cell.to_le_bytes()));
        }
        for curve in &mesh.curves {
            self.take(curve.name.as_bytes());
            curve.edges.as_flattened().iter().for_each(|vertex| self.take(&vertex.to_le_bytes()));
        }
    }

    /// The fingerprint of these bytes alone.
    pub fn of(bytes: &[u8]) -> Self {
        let mut all = Self::default();
        all.take(bytes);
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Test vectors of the draft that describes FNV (Fowler, Noll, Vo, Eastlake).
    #[test]
    fn it_is_fnv_1a() {
        let known = [("", OFFSET), ("a", 0xaf63_dc4c_8601_ec8c), ("foobar", 0x8594_4171_f739_67e8)];
        for (text, number) in known {
            assert_eq!(Fingerprint::of(text.as_bytes()), Fingerprint(number), "{text}");
        }
    }
}

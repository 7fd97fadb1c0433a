//! Results on the meshes that were used last.

use std::hash::{DefaultHasher, Hash, Hasher};
use std::sync::{Arc, Mutex, PoisonError};

use signorini_scene::error::Result;
use signorini_scene::mesh::Mesh;

/// Something for each of the last `most` meshes, the newest first.
#[derive(Debug)]
pub(super) struct Kept<T> {
    most: usize,
    recent: Mutex<Vec<(u64, Arc<T>)>>,
}

impl<T> Kept<T> {
    pub(super) fn new(most: usize) -> Self {
        Self { most, recent: Mutex::default() }
    }

    /// Gives what is known on a mesh, or `make`s it.
    pub(super) fn on(&self, mesh: &Mesh, make: impl FnOnce() -> Result<T>) -> Result<Arc<T>> {
        let mut recent = self.recent.lock().unwrap_or_else(PoisonError::into_inner);
        let key = fingerprint(mesh);
        let known = match recent.iter().position(|(other, _)| *other == key) {
            Some(at) => recent.remove(at).1,
            None => {
                // First, so that there is never one more than is kept.
                recent.truncate(self.most - 1);
                Arc::new(make()?)
            }
        };
        recent.insert(0, (key, known.clone()));
        Ok(known)
    }

    #[cfg(test)]
    pub(super) fn count(&self) -> usize {
        self.recent.lock().unwrap().len()
    }
}

/// A number that two meshes hardly share.
fn fingerprint(mesh: &Mesh) -> u64 {
    let mut hasher = DefaultHasher::new();
    for x in mesh.vertices.as_flattened() {
        x.to_bits().hash(&mut hasher);
    }
    (&mesh.triangles, &mesh.quads).hash(&mut hasher);
    hasher.finish()
}

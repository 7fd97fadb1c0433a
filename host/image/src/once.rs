//! Results that are made once per name, and kept.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

/// Values made, by name.
#[derive(Debug)]
pub struct Once<T>(Mutex<BTreeMap<String, T>>);

impl<T> Default for Once<T> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T> Once<T> {
    /// Nothing is made yet.
    pub const fn new() -> Self {
        Self(Mutex::new(BTreeMap::new()))
    }

    /// The number of results that are kept.
    pub fn count(&self) -> usize {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).len()
    }
}

impl<T: Clone> Once<T> {
    /// The result of this name, which `make` makes where there is none. What fails is not kept.
    ///
    /// # Errors
    /// Those of `make`.
    pub fn get<E>(&self, name: &str, make: impl FnOnce() -> Result<T, E>) -> Result<T, E> {
        let kept = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = kept().get(name) {
            return Ok(known.clone());
        }
        let made = make()?;
        kept().insert(name.to_owned(), made.clone());
        Ok(made)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_name_is_made_once_and_a_failure_again() {
        let kept = Once::default();
        assert_eq!(kept.get("a", || Err("no")), Err("no"));
        assert_eq!(kept.get("a", || Ok::<_, &str>(1)), Ok(1));
        assert_eq!(kept.get("a", || Ok::<_, &str>(2)), Ok(1));
        assert_eq!(kept.get("b", || Ok::<_, &str>(3)), Ok(3));
        assert_eq!(kept.count(), 2);
    }
}

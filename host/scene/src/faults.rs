//! All that is wrong with an input: who reads it goes on after a fault, so that one run tells of every one.

use std::cell::RefCell;
use std::ops::Range;

use crate::error::{Error, InputError, Result};

/// The faults found so far.
#[derive(Debug, Default)]
pub struct Faults(RefCell<Vec<InputError>>);

impl Faults {
    /// Adds a fault.
    pub fn note(&self, fault: InputError) {
        self.0.borrow_mut().push(fault);
    }

    /// The value that was read, or nothing: then its fault is noted.
    pub fn keep<T>(&self, read: Result<T>) -> Option<T> {
        read.map_err(|error| self.add(error)).ok()
    }

    /// Adds all that an error tells.
    pub fn add(&self, error: Error) {
        match error {
            Error::Input(fault) => self.0.borrow_mut().extend(fault.each()),
            other @ (Error::Io { .. } | Error::Check(_)) => {
                self.note(InputError::new(other.to_string()));
            }
        }
    }

    /// Whether one of them underlines exactly these bytes.
    pub fn underline(&self, bytes: &Range<usize>) -> bool {
        self.0.borrow().iter().any(|fault| fault.underlines(bytes))
    }

    /// How many there are so far.
    pub fn count(&self) -> usize {
        self.0.borrow().len()
    }

    /// All faults in the order in which they were found.
    pub fn into_vec(self) -> Vec<InputError> {
        self.0.into_inner()
    }

    /// `Ok` where there is none.
    ///
    /// # Errors
    /// The first fault, with all others behind it.
    pub fn into_result(self) -> Result<()> {
        let mut all = self.into_vec().into_iter();
        all.next().map_or(Ok(()), |first| Err(first.with_others(all.collect()).into()))
    }
}

impl From<Vec<InputError>> for Faults {
    fn from(all: Vec<InputError>) -> Self {
        Self(RefCell::new(all))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_faults_are_told_in_the_order_in_which_they_were_found() {
        let faults = Faults::default();
        assert_eq!(faults.count(), 0);
        assert_eq!(faults.keep(Ok(3)), Some(3));
        let read: Result<u8> =
            Err(InputError::new("one").with_others(vec![InputError::new("two")]).into());
        assert_eq!(faults.keep(read), None);
        faults.note(InputError::new("three"));
        let Err(Error::Input(first)) = faults.into_result() else { panic!("faults") };
        let names: Vec<_> = first.each().iter().map(|fault| fault.message().to_owned()).collect();
        assert_eq!(names, ["one", "two", "three"]);
    }
}

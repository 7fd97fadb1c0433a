//! Values by name, as `firmware.json` has them.

use serde::ser::SerializeMap as _;
use serde::{Serialize, Serializer};

/// Values by name, in their order; null where one is no number.
#[derive(Debug, Clone, PartialEq)]
pub struct Values(pub Vec<(String, Option<f64>)>);

impl Values {
    /// Each name with its value; null where there is none.
    pub fn new(names: &[String], values: impl IntoIterator<Item = Option<f64>>) -> Self {
        let mut values = values.into_iter();
        Self(names.iter().map(|name| (name.clone(), values.next().flatten())).collect())
    }
}

impl Serialize for Values {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.0.len()))?;
        self.0.iter().try_for_each(|(name, value)| map.serialize_entry(name, value))?;
        map.end()
    }
}

//! Arrays of a VTK file in XML: binary, in base64.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

/// Vectors of the plane; nothing where there are not as many as expected.
pub fn in_space(name: &str, expected: usize, vectors: &[[f64; 2]]) -> String {
    match vectors.len() == expected {
        true => array::<f64>("Float64", name, 3, vectors.iter().flat_map(|&[x, y]| [x, y, 0.0])),
        false => String::new(),
    }
}

/// Symmetric tensors; nothing where there are not as many as expected.
pub fn tensors(name: &str, expected: usize, tensors: &[[f64; 3]]) -> String {
    match tensors.len() == expected {
        true => array::<f64>("Float64", name, 3, tensors.iter().flatten().copied()),
        false => String::new(),
    }
}

/// One number for each cell or vertex; nothing where there are not as many as expected.
pub fn reals(name: &str, expected: usize, values: &[f64]) -> String {
    match values.len() == expected {
        true => array::<f64>("Float64", name, 1, values.iter().copied()),
        false => String::new(),
    }
}

/// A number that VTK reads in binary.
pub trait Binary: Copy {
    /// Its bytes.
    type Bytes: AsRef<[u8]>;

    /// The lowest first.
    fn bytes(self) -> Self::Bytes;
}

macro_rules! binary {
    ($($number:ty),*) => {
        $(impl Binary for $number {
            type Bytes = [u8; size_of::<$number>()];

            fn bytes(self) -> Self::Bytes {
                self.to_le_bytes()
            }
        })*
    };
}

binary!(f64, i64, i32, i8, u8);

/// An array of cells or points, each with so many parts.
pub fn array<T: Binary>(
    kind: &str,
    name: &str,
    parts: usize,
    values: impl Iterator<Item = T>,
) -> String {
    // One part is what readers take for granted; meshio makes a table of a column where it is said.
    let parts = match parts {
        1 => String::new(),
        parts => format!(" NumberOfComponents=\"{parts}\""),
    };
    written(kind, name, &parts, values)
}

/// An array of the file as a whole, which has to say its length.
pub fn of_file(name: &str, values: &[i32]) -> String {
    let length = format!(" NumberOfTuples=\"{}\"", values.len());
    written("Int32", name, &length, values.iter().copied())
}

/// The count of bytes as u64, then the bytes.
fn written<T: Binary>(
    kind: &str,
    name: &str,
    shape: &str,
    values: impl Iterator<Item = T>,
) -> String {
    const COUNT: usize = size_of::<u64>();
    let mut bytes = vec![0; COUNT];
    values.for_each(|value| bytes.extend_from_slice(value.bytes().as_ref()));
    let count = (bytes.len() - COUNT) as u64;
    bytes[..COUNT].copy_from_slice(&count.to_le_bytes());
    let mut text = format!(
        "<DataArray type=\"{kind}\" Name=\"{}\"{shape} format=\"binary\">\n",
        escaped(name)
    );
    STANDARD.encode_string(bytes, &mut text);
    text + "\n</DataArray>\n"
}

/// A name as the value of an attribute.
fn escaped(name: &str) -> String {
    name.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

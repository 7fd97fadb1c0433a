//! Arrays of a VTK file in XML: binary, in base64.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use signorini_draw::escape;

/// So many parts for each cell or vertex; nothing where there are not as many as expected.
pub fn full<T: Binary, const N: usize>(
    name: &str,
    expected: usize,
    values: impl ExactSizeIterator<Item = [T; N]>,
) -> String {
    if values.len() == expected { array(name, N, values.flatten()) } else { String::new() }
}

/// Vectors of the plane, as [`full`].
pub fn in_space(name: &str, expected: usize, vectors: &[[f64; 2]]) -> String {
    full(name, expected, vectors.iter().map(|&[x, y]| [x, y, 0.0]))
}

/// One number for each cell or vertex, as [`full`].
pub fn reals(name: &str, expected: usize, values: &[f64]) -> String {
    full(name, expected, values.iter().map(|&value| [value]))
}

/// A number that VTK reads in binary.
pub trait Binary: Copy {
    /// Its name in VTK.
    const KIND: &str;

    /// Its bytes.
    type Bytes: AsRef<[u8]>;

    /// The lowest first.
    fn bytes(self) -> Self::Bytes;
}

macro_rules! binary {
    ($($number:ty: $kind:literal),*) => {
        $(impl Binary for $number {
            const KIND: &str = $kind;
            type Bytes = [u8; size_of::<$number>()];

            fn bytes(self) -> Self::Bytes {
                self.to_le_bytes()
            }
        })*
    };
}

binary!(f64: "Float64", i64: "Int64", i32: "Int32", i8: "Int8", u8: "UInt8");

/// An array of cells or points, each with so many parts.
pub fn array<T: Binary>(name: &str, parts: usize, values: impl Iterator<Item = T>) -> String {
    // One part is what readers take for granted; meshio makes a table of a column where it is said.
    let parts = match parts {
        1 => String::new(),
        parts => format!(" NumberOfComponents=\"{parts}\""),
    };
    written(name, &parts, values)
}

/// An array of the file as a whole, which has to say its length.
pub fn of_file(name: &str, values: &[i32]) -> String {
    let length = format!(" NumberOfTuples=\"{}\"", values.len());
    written(name, &length, values.iter().copied())
}

/// The count of bytes as u64, then the bytes.
fn written<T: Binary>(name: &str, shape: &str, values: impl Iterator<Item = T>) -> String {
    const COUNT: usize = size_of::<u64>();
    let mut bytes = vec![0; COUNT];
    values.for_each(|value| bytes.extend_from_slice(value.bytes().as_ref()));
    let count = (bytes.len() - COUNT) as u64;
    bytes[..COUNT].copy_from_slice(&count.to_le_bytes());
    let (kind, name) = (T::KIND, escape(name));
    let mut text =
        format!("<DataArray type=\"{kind}\" Name=\"{name}\"{shape} format=\"binary\">\n");
    STANDARD.encode_string(bytes, &mut text);
    text + "\n</DataArray>\n"
}

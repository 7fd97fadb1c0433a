//! A field as a VTK unstructured grid in XML, which ParaView opens.
//!
//! The arrays are binary, in base64: every f64 survives, NaN too, and a large file is read and written as fast as its bytes go.
//! The plane is z = 0.

use std::iter::repeat_n;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

/// The cell types of VTK: a line, and a triangle and a quad with counterclockwise vertices.
const VTK_LINE: u8 = 3;
const VTK_TRIANGLE: u8 = 5;
const VTK_QUAD: u8 = 9;

/// What the file shows. Cells are numbered triangles first, then quads.
#[derive(Debug, Clone, Copy)]
pub struct Field<'a> {
    /// Vertex coordinates, as in the mesh file.
    pub vertices: &'a [[f64; 2]],
    /// Vertices of the triangles.
    pub triangles: &'a [[u32; 3]],
    /// Vertices of the quads.
    pub quads: &'a [[u32; 4]],
    /// The mean of u over each cell.
    pub cell_u: &'a [f64],
    /// The flux σ = A∇u at the centre of each cell.
    pub cell_flux: &'a [[f64; 2]],
    /// The number of the material region of each cell.
    pub region: &'a [u32],
    /// The conforming u at each vertex.
    pub vertex_u: &'a [f64],
}

/// The text of the `.vtu` file. An array that does not have a value for every cell (vertex) is left out, and the rest of the file
/// stays readable.
pub fn vtu(field: &Field) -> String {
    let cells = field.triangles.len() + field.quads.len();
    let points = field.vertices.len();
    let mut file = begin(points, cells);
    section(&mut file, "Points", "", &[in_space("points", points, field.vertices)]);
    section(&mut file, "Cells", "", &topology(field));
    let u = reals("u", cells, field.cell_u);
    let region = match field.region.len() == cells {
        true => {
            array::<i32>("Int32", "region", 1, field.region.iter().map(|&region| region as i32))
        }
        false => String::new(),
    };
    let of_cells = [u, in_space("flux", cells, field.cell_flux), region];
    section(&mut file, "CellData", " Scalars=\"u\" Vectors=\"flux\"", &of_cells);
    section(&mut file, "PointData", " Scalars=\"u\"", &[reals("u", points, field.vertex_u)]);
    file + END
}

/// The contact edges, each a line.
#[derive(Debug, Clone, Default)]
pub struct Contact {
    /// Both ends of each edge.
    pub ends: Vec<[[f64; 2]; 2]>,
    /// λ
    pub lambda: Vec<f64>,
    /// u − ψ
    pub gap: Vec<f64>,
    /// 1 where the edge is open, 0 where it touches, −1 where its flux is at its limit.
    pub state: Vec<i8>,
    /// The boundary's place among the tables of the scene, from 0.
    pub boundary: Vec<usize>,
}

/// The text of `contact.vtu`, with two points an edge.
pub fn contact_vtu(contact: &Contact) -> String {
    let edges = contact.ends.len();
    let mut file = begin(2 * edges, edges);
    let points = in_space("points", 2 * edges, contact.ends.as_flattened());
    section(&mut file, "Points", "", &[points]);
    let ends = (1..=edges as i64).map(|edge| 2 * edge);
    let topology = [
        array::<i64>("Int64", "connectivity", 1, 0..2 * edges as i64),
        array::<i64>("Int64", "offsets", 1, ends),
        array::<u8>("UInt8", "types", 1, repeat_n(VTK_LINE, edges)),
    ];
    section(&mut file, "Cells", "", &topology);
    let boundary = contact.boundary.iter().map(|&boundary| boundary as i32);
    let data = [
        reals("lambda", edges, &contact.lambda),
        reals("gap", edges, &contact.gap),
        array::<i8>("Int8", "state", 1, contact.state.iter().copied()),
        array::<i32>("Int32", "boundary", 1, boundary),
    ];
    section(&mut file, "CellData", " Scalars=\"lambda\"", &data);
    file + END
}

const END: &str = "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";

fn begin(points: usize, cells: usize) -> String {
    format!(
        "<?xml version=\"1.0\"?>\n\
         <VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n\
         <UnstructuredGrid>\n<Piece NumberOfPoints=\"{points}\" NumberOfCells=\"{cells}\">\n"
    )
}

fn section(file: &mut String, name: &str, attributes: &str, arrays: &[String]) {
    *file += &format!("<{name}{attributes}>\n");
    arrays.iter().for_each(|array| *file += array);
    *file += &format!("</{name}>\n");
}

/// Connectivity, the end of each cell in it, and the type of each cell.
fn topology(field: &Field) -> [String; 3] {
    let (triangles, quads) = (field.triangles.len(), field.quads.len());
    let corners = field.triangles.as_flattened().iter().chain(field.quads.as_flattened());
    let corners = corners.map(|&vertex| i64::from(vertex));
    let ends = (1..=triangles).map(|cell| 3 * cell);
    let ends = ends.chain((1..=quads).map(|cell| 3 * triangles + 4 * cell)).map(|end| end as i64);
    let types = repeat_n(VTK_TRIANGLE, triangles).chain(repeat_n(VTK_QUAD, quads));
    [
        array::<i64>("Int64", "connectivity", 1, corners),
        array::<i64>("Int64", "offsets", 1, ends),
        array::<u8>("UInt8", "types", 1, types),
    ]
}

/// Vectors of the plane; nothing where there are not as many as expected.
fn in_space(name: &str, expected: usize, vectors: &[[f64; 2]]) -> String {
    match vectors.len() == expected {
        true => array::<f64>("Float64", name, 3, vectors.iter().flat_map(|&[x, y]| [x, y, 0.0])),
        false => String::new(),
    }
}

/// One number for each cell or vertex; nothing where there are not as many as expected.
fn reals(name: &str, expected: usize, values: &[f64]) -> String {
    match values.len() == expected {
        true => array::<f64>("Float64", name, 1, values.iter().copied()),
        false => String::new(),
    }
}

/// A number that VTK reads in binary.
trait Binary: Copy {
    type Bytes: AsRef<[u8]>;

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

/// The count of bytes as u64, then the bytes.
fn array<T: Binary>(
    kind: &str,
    name: &str,
    parts: usize,
    values: impl Iterator<Item = T>,
) -> String {
    const COUNT: usize = size_of::<u64>();
    let mut bytes = vec![0; COUNT];
    values.for_each(|value| bytes.extend_from_slice(value.bytes().as_ref()));
    let count = (bytes.len() - COUNT) as u64;
    bytes[..COUNT].copy_from_slice(&count.to_le_bytes());
    let mut text = format!(
        "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{parts}\" format=\"binary\">\n"
    );
    STANDARD.encode_string(bytes, &mut text);
    text + "\n</DataArray>\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    const MIXED: Field = Field {
        vertices: &[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [2.0, 1e-7]],
        triangles: &[[1, 4, 2]],
        quads: &[[0, 1, 2, 3]],
        cell_u: &[0.1, -1.0 / 3.0],
        cell_flux: &[[1.0, 2.0], [-3.0, 1e300]],
        region: &[7, 1],
        vertex_u: &[0.0, 1.0, 2.0, 3.0, 4.0],
    };

    /// The numbers of the array `name` in the section `section`.
    fn array(file: &str, section: &str, name: &str) -> Option<Vec<f64>> {
        let (_, rest) = file.split_once(&format!("<{section}"))?;
        let (section, _) = rest.split_once(&format!("</{section}>"))?;
        let (before, array) = section.split_once(&format!("Name=\"{name}\""))?;
        let (_, kind) = before.rsplit_once("type=\"")?;
        let (_, numbers) = array.split_once(">\n")?;
        let (numbers, _) = numbers.split_once("\n</DataArray>")?;
        let bytes = STANDARD.decode(numbers).unwrap();
        let (count, bytes) = bytes.split_first_chunk::<8>().unwrap();
        assert_eq!(u64::from_le_bytes(*count), bytes.len() as u64);
        Some(match kind.split_once('"')?.0 {
            "Float64" => bytes.as_chunks().0.iter().map(|&b| f64::from_le_bytes(b)).collect(),
            "Int64" => bytes.as_chunks().0.iter().map(|&b| i64::from_le_bytes(b) as f64).collect(),
            "Int32" => bytes.as_chunks().0.iter().map(|&b| i32::from_le_bytes(b).into()).collect(),
            "Int8" => bytes.iter().map(|&b| (b as i8).into()).collect(),
            "UInt8" => bytes.iter().map(|&b| b.into()).collect(),
            _ => return None,
        })
    }

    #[test]
    fn every_number_reads_back_the_same() {
        let file = vtu(&MIXED);
        let points = array(&file, "Points", "points").unwrap();
        assert_eq!(points.len(), 15);
        assert_eq!(points[12..], [2.0, 1e-7, 0.0]);
        assert_eq!(array(&file, "CellData", "u").unwrap(), MIXED.cell_u);
        let flux = array(&file, "CellData", "flux").unwrap();
        assert_eq!(flux, [1.0, 2.0, 0.0, -3.0, 1e300, 0.0]);
        assert_eq!(array(&file, "CellData", "region").unwrap(), [7.0, 1.0]);
        assert_eq!(array(&file, "PointData", "u").unwrap(), MIXED.vertex_u);
    }

    #[test]
    fn contact_edges_are_lines_with_their_states() {
        let contact = Contact {
            ends: vec![[[0.0, 0.0], [1.0, 0.5]], [[1.0, 0.5], [2.0, 0.0]]],
            lambda: vec![0.25, 0.0],
            gap: vec![0.0, -1.5],
            state: vec![0, -1],
            boundary: vec![2, 2],
        };
        let file = contact_vtu(&contact);
        assert_eq!(array(&file, "Points", "points").unwrap()[3..9], [1.0, 0.5, 0.0, 1.0, 0.5, 0.0]);
        assert_eq!(array(&file, "Cells", "connectivity").unwrap(), [0.0, 1.0, 2.0, 3.0]);
        assert_eq!(array(&file, "Cells", "types").unwrap(), [3.0, 3.0]);
        assert_eq!(array(&file, "CellData", "gap").unwrap(), [0.0, -1.5]);
        assert_eq!(array(&file, "CellData", "state").unwrap(), [0.0, -1.0]);
        assert_eq!(array(&file, "CellData", "lambda").unwrap(), [0.25, 0.0]);
        assert_eq!(array(&file, "CellData", "boundary").unwrap(), [2.0, 2.0]);
        assert!(contact_vtu(&Contact::default()).contains("NumberOfCells=\"0\""));
    }

    #[test]
    fn triangles_come_before_quads() {
        let file = vtu(&MIXED);
        let corners = [1.0, 4.0, 2.0, 0.0, 1.0, 2.0, 3.0];
        assert_eq!(array(&file, "Cells", "connectivity").unwrap(), corners);
        assert_eq!(array(&file, "Cells", "offsets").unwrap(), [3.0, 7.0]);
        assert_eq!(array(&file, "Cells", "types").unwrap(), [5.0, 9.0]);
    }

    #[test]
    fn an_array_with_a_gap_is_left_out_and_the_rest_stays() {
        let broken = Field { cell_u: &[0.0, f64::NAN], region: &[1], ..MIXED };
        let file = vtu(&broken);
        assert!(array(&file, "CellData", "region").is_none());
        let u = array(&file, "CellData", "u").unwrap();
        assert!(u[0] == 0.0 && u[1].is_nan());
        assert_eq!(file.matches("<DataArray").count(), file.matches("</DataArray>").count());
    }

    #[test]
    fn an_empty_mesh_is_still_a_file() {
        let empty = Field {
            vertices: &[],
            triangles: &[],
            quads: &[],
            cell_u: &[],
            cell_flux: &[],
            region: &[],
            vertex_u: &[],
        };
        assert!(vtu(&empty).contains("NumberOfPoints=\"0\" NumberOfCells=\"0\""));
    }
}

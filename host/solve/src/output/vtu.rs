//! A field as a VTK unstructured grid in XML, which ParaView opens.
//!
//! The data are plain text: a person can read them, two runs can be compared by `diff`, and every
//! f64 survives the round trip. The plane is z = 0.

use std::fmt::Write;

/// The cell types of VTK: a line, and a triangle and a quad with counterclockwise vertices.
const VTK_LINE: u32 = 3;
const VTK_TRIANGLE: u32 = 5;
const VTK_QUAD: u32 = 9;

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

/// The text of the `.vtu` file.
///
/// VTK reads no NaN from text: an array that holds one, or does not have a value for every cell
/// (vertex), is left out, and the rest of the file stays readable.
pub fn vtu(field: &Field) -> String {
    let cells = field.triangles.len() + field.quads.len();
    let points = field.vertices.len();
    let mut file = begin(points, cells);
    section(&mut file, "Points", "", &in_space("points", points, field.vertices));
    section(&mut file, "Cells", "", &topology(field));

    let means: Vec<[f64; 1]> = field.cell_u.iter().map(|&u| [u]).collect();
    let mut cell_data = reals("u", cells, &means);
    cell_data += &in_space("flux", cells, field.cell_flux);
    if field.region.len() == cells {
        cell_data += &integers("region", "Int32", field.region.iter());
    }
    section(&mut file, "CellData", " Scalars=\"u\" Vectors=\"flux\"", &cell_data);

    let values: Vec<[f64; 1]> = field.vertex_u.iter().map(|&u| [u]).collect();
    section(&mut file, "PointData", " Scalars=\"u\"", &reals("u", points, &values));
    file + END
}

/// The contact edges, each a line.
#[derive(Debug, Clone, Default)]
pub struct Contact {
    /// Both ends of each edge.
    pub ends: Vec<[[f64; 2]; 2]>,
    /// λ
    pub lambda: Vec<[f64; 1]>,
    /// u − ψ
    pub gap: Vec<[f64; 1]>,
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
    section(&mut file, "Points", "", &points);
    let topology = integers("connectivity", "Int64", 0..2 * edges)
        + &integers("offsets", "Int64", (1..=edges).map(|edge| 2 * edge))
        + &integers("types", "UInt8", std::iter::repeat_n(VTK_LINE, edges));
    section(&mut file, "Cells", "", &topology);
    let data = reals("lambda", edges, &contact.lambda)
        + &reals("gap", edges, &contact.gap)
        + &integers("state", "Int8", contact.state.iter())
        + &integers("boundary", "Int32", contact.boundary.iter());
    section(&mut file, "CellData", " Scalars=\"lambda\"", &data);
    file + END
}

const END: &str = "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";

fn begin(points: usize, cells: usize) -> String {
    format!(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\">\n<UnstructuredGrid>\n\
         <Piece NumberOfPoints=\"{points}\" NumberOfCells=\"{cells}\">\n"
    )
}

/// Vectors of the plane.
fn in_space(name: &str, expected: usize, vectors: &[[f64; 2]]) -> String {
    let space: Vec<[f64; 3]> = vectors.iter().map(|&[x, y]| [x, y, 0.0]).collect();
    reals(name, expected, &space)
}

fn section(file: &mut String, name: &str, attributes: &str, arrays: &str) {
    let _ = write!(file, "<{name}{attributes}>\n{arrays}</{name}>\n");
}

/// Connectivity, the end of each cell in it, and the type of each cell.
fn topology(field: &Field) -> String {
    let triangles = field.triangles.len();
    let corners = field.triangles.as_flattened().iter().chain(field.quads.as_flattened());
    let ends = (1..=triangles)
        .map(|cell| 3 * cell)
        .chain((1..=field.quads.len()).map(|cell| 3 * triangles + 4 * cell));
    let types = std::iter::repeat_n(VTK_TRIANGLE, triangles)
        .chain(std::iter::repeat_n(VTK_QUAD, field.quads.len()));
    integers("connectivity", "Int64", corners)
        + &integers("offsets", "Int64", ends)
        + &integers("types", "UInt8", types)
}

fn integers<T: ToString>(name: &str, kind: &str, values: impl Iterator<Item = T>) -> String {
    let values: Vec<String> = values.map(|value| value.to_string()).collect();
    let lines: Vec<String> = values.chunks(12).map(|line| line.join(" ")).collect();
    format!(
        "<DataArray type=\"{kind}\" Name=\"{name}\" format=\"ascii\">\n{}\n</DataArray>\n",
        lines.join("\n")
    )
}

/// One tuple a line, each number in its shortest form that reads back the same.
fn reals<const N: usize>(name: &str, expected: usize, tuples: &[[f64; N]]) -> String {
    if tuples.len() != expected || tuples.as_flattened().iter().any(|value| !value.is_finite()) {
        return String::new();
    }
    let mut array = format!(
        "<DataArray type=\"Float64\" Name=\"{name}\" NumberOfComponents=\"{N}\" format=\"ascii\">\n"
    );
    for tuple in tuples {
        let line: Vec<String> = tuple.iter().map(|value| format!("{value:?}")).collect();
        let _ = writeln!(array, "{}", line.join(" "));
    }
    array + "</DataArray>\n"
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
        let (_, array) = section.split_once(&format!("Name=\"{name}\""))?;
        let (_, numbers) = array.split_once(">\n")?;
        let (numbers, _) = numbers.split_once("</DataArray>")?;
        Some(numbers.split_whitespace().map(|number| number.parse().unwrap()).collect())
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
            lambda: vec![[0.25], [0.0]],
            gap: vec![[0.0], [-1.5]],
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
    fn an_array_with_nan_or_a_gap_is_left_out_and_the_rest_stays() {
        let broken = Field { cell_u: &[0.0, f64::NAN], region: &[1], ..MIXED };
        let file = vtu(&broken);
        assert!(!file.contains("NaN") && !file.contains("region"));
        let cell_data =
            file.split_once("<CellData").unwrap().1.split_once("</CellData>").unwrap().0;
        assert_eq!(cell_data.matches("<DataArray").count(), 1);
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

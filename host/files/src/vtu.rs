//! A field as a VTK unstructured grid in XML, which ParaView opens.
//!
//! The arrays are binary, in base64: every f64 survives, NaN too, and a large file is read and written as fast as its bytes go.
//! The plane is z = 0.

mod arrays;
#[cfg(test)]
mod tests;

use std::iter::repeat_n;

use arrays::{array, full, in_space, of_file, reals};

/// The cell types of VTK: a line, and a triangle and a quad with counterclockwise vertices.
const VTK_LINE: u8 = 3;
const VTK_TRIANGLE: u8 = 5;
const VTK_QUAD: u8 = 9;

/// Contents of the file. Cells are numbered triangles first, then quads.
#[derive(Debug, Clone, Copy, Default)]
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
    /// Share of each cell in the error bound: the root of its part of the bound's square.
    pub indicator: &'a [f64],
    /// A at the centre of each cell: xx, xy, yy.
    pub conductivity: &'a [[f64; 3]],
    /// The number of the material region of each cell.
    pub region: &'a [u32],
    /// The names of these regions.
    pub materials: &'a [&'a str],
    /// The continuous s at each vertex.
    pub vertex_s: &'a [f64],
}

/// The text of the `.vtu` file. An array that does not have a value for every cell (vertex) is left out, and the rest of the file
/// stays readable.
pub fn vtu(field: &Field) -> String {
    let cells = field.triangles.len() + field.quads.len();
    let points = field.vertices.len();
    let mut file = begin(points, cells, &named(field.materials.iter().copied(), PLANE));
    section(&mut file, "Points", "", &[in_space("points", points, field.vertices)]);
    section(&mut file, "Cells", "", &topology(field));
    let of_cells = [
        reals("u", cells, field.cell_u),
        in_space("flux", cells, field.cell_flux),
        reals("indicator", cells, field.indicator),
        full("conductivity", cells, field.conductivity.iter().copied()),
        full("region", cells, field.region.iter().map(|&region| [region as i32])),
    ];
    section(&mut file, "CellData", " Scalars=\"u\" Vectors=\"flux\"", &of_cells);
    let s = reals("u_continuous", points, field.vertex_s);
    section(&mut file, "PointData", " Scalars=\"u_continuous\"", &[s]);
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
    /// The names of these tables.
    pub names: Vec<String>,
}

/// The text of `contact.vtu`, with two points an edge.
pub fn contact_vtu(contact: &Contact) -> String {
    let edges = contact.ends.len();
    let names = contact.names.iter().map(String::as_str);
    let mut file = begin(2 * edges, edges, &named(names, LINE));
    let points = in_space("points", 2 * edges, contact.ends.as_flattened());
    section(&mut file, "Points", "", &[points]);
    let ends = (1..=edges as i64).map(|edge| 2 * edge);
    let topology = [
        array("connectivity", 1, 0..2 * edges as i64),
        array("offsets", 1, ends),
        array("types", 1, repeat_n(VTK_LINE, edges)),
    ];
    section(&mut file, "Cells", "", &topology);
    let boundary = contact.boundary.iter().map(|&boundary| boundary as i32);
    let data = [
        reals("lambda", edges, &contact.lambda),
        reals("gap", edges, &contact.gap),
        array("state", 1, contact.state.iter().copied()),
        array("boundary", 1, boundary),
    ];
    section(&mut file, "CellData", " Scalars=\"lambda\"", &data);
    file + END
}

const END: &str = "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";

/// Dimensions of what has a name.
const LINE: i32 = 1;
const PLANE: i32 = 2;

/// Of each name the number that cells have, and the dimension, as meshio has names of a Gmsh file.
fn named<'a>(names: impl Iterator<Item = &'a str>, dimension: i32) -> String {
    names.enumerate().map(|(number, name)| of_file(name, &[number as i32, dimension])).collect()
}

fn begin(points: usize, cells: usize, names: &str) -> String {
    format!(
        "<?xml version=\"1.0\"?>\n\
         <VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n\
         <UnstructuredGrid>\n<FieldData>\n{names}</FieldData>\n<Piece NumberOfPoints=\"{points}\" NumberOfCells=\"{cells}\">\n"
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
    [array("connectivity", 1, corners), array("offsets", 1, ends), array("types", 1, types)]
}

//! A field as a VTK unstructured grid in XML, which ParaView opens.
//!
//! The data are plain text: a person can read them, two runs can be compared by `diff`, and every
//! f64 survives the round trip. The plane is z = 0.

use std::fmt::Write;

/// The cell types of VTK: a triangle and a quad, both with counterclockwise vertices.
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
    let mut file = String::new();
    file.push_str("<?xml version=\"1.0\"?>\n");
    file.push_str("<VTKFile type=\"UnstructuredGrid\" version=\"0.1\">\n<UnstructuredGrid>\n");
    let _ = writeln!(file, "<Piece NumberOfPoints=\"{points}\" NumberOfCells=\"{cells}\">");

    let space: Vec<[f64; 3]> = field.vertices.iter().map(|&[x, y]| [x, y, 0.0]).collect();
    section(&mut file, "Points", "", &reals("points", points, &space));
    section(&mut file, "Cells", "", &topology(field));

    let means: Vec<[f64; 1]> = field.cell_u.iter().map(|&u| [u]).collect();
    let flux: Vec<[f64; 3]> = field.cell_flux.iter().map(|&[x, y]| [x, y, 0.0]).collect();
    let mut cell_data = reals("u", cells, &means);
    cell_data += &reals("flux", cells, &flux);
    if field.region.len() == cells {
        cell_data += &integers("region", "Int32", field.region.iter());
    }
    section(&mut file, "CellData", " Scalars=\"u\" Vectors=\"flux\"", &cell_data);

    let values: Vec<[f64; 1]> = field.vertex_u.iter().map(|&u| [u]).collect();
    section(&mut file, "PointData", " Scalars=\"u\"", &reals("u", points, &values));
    file.push_str("</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
    file
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

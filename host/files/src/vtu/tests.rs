//! Files read back by hand: every number keeps its bits.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use super::*;

const MIXED: Field = Field {
    vertices: &[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [2.0, 1e-7]],
    triangles: &[[1, 4, 2]],
    quads: &[[0, 1, 2, 3]],
    cell_u: &[0.1, -1.0 / 3.0],
    cell_flux: &[[1.0, 2.0], [-3.0, 1e300]],
    indicator: &[0.25, 0.5],
    conductivity: &[[1.0, 0.0, 1.0], [3.0, -0.5, 2.0]],
    region: &[0, 1],
    materials: &["clay", "sand & <silt>"],
    vertex_s: &[0.0, 1.0, 2.0, 3.0, 4.0],
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
    assert_eq!(array(&file, "CellData", "indicator").unwrap(), MIXED.indicator);
    let conductivity = array(&file, "CellData", "conductivity").unwrap();
    assert_eq!(conductivity, MIXED.conductivity.as_flattened());
    assert_eq!(array(&file, "CellData", "region").unwrap(), [0.0, 1.0]);
    assert_eq!(array(&file, "PointData", "u_continuous").unwrap(), MIXED.vertex_s);
}

#[test]
fn contact_edges_are_lines_with_their_states() {
    let contact = Contact {
        ends: vec![[[0.0, 0.0], [1.0, 0.5]], [[1.0, 0.5], [2.0, 0.0]]],
        lambda: vec![0.25, 0.0],
        gap: vec![0.0, -1.5],
        state: vec![0, -1],
        boundary: vec![1, 1],
        names: vec!["river".to_owned(), "face".to_owned()],
    };
    let file = contact_vtu(&contact);
    assert_eq!(array(&file, "Points", "points").unwrap()[3..9], [1.0, 0.5, 0.0, 1.0, 0.5, 0.0]);
    assert_eq!(array(&file, "Cells", "connectivity").unwrap(), [0.0, 1.0, 2.0, 3.0]);
    assert_eq!(array(&file, "Cells", "types").unwrap(), [3.0, 3.0]);
    assert_eq!(array(&file, "CellData", "gap").unwrap(), [0.0, -1.5]);
    assert_eq!(array(&file, "CellData", "state").unwrap(), [0.0, -1.0]);
    assert_eq!(array(&file, "CellData", "lambda").unwrap(), [0.25, 0.0]);
    assert_eq!(array(&file, "CellData", "boundary").unwrap(), [1.0, 1.0]);
    assert_eq!(array(&file, "FieldData", "face").unwrap(), [1.0, 1.0]);
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
    assert!(vtu(&Field::default()).contains("NumberOfPoints=\"0\" NumberOfCells=\"0\""));
}

#[test]
fn names_of_materials_have_their_numbers_and_survive() {
    let file = vtu(&MIXED);
    assert_eq!(array(&file, "FieldData", "clay").unwrap(), [0.0, 2.0]);
    assert_eq!(array(&file, "FieldData", "sand &amp; &lt;silt&gt;").unwrap(), [1.0, 2.0]);
}

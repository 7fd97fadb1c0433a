//! Files that people take for a mesh that is read: what they are, and what to do with them.

use crate::error::InputError;

/// How many bytes of a text are looked at.
const LOOKED_AT: usize = 4096;

const CONVERT: &str =
    "convert it: `gmsh FILE -save -format msh41 -o mesh.msh`, or `meshio convert FILE mesh.msh`";
const SOLUTION: &str =
    "give the .msh file that it was made from, or convert it: `meshio convert FILE mesh.msh`";
const UNPACK: &str = "unpack it first";
const MESH_IT: &str = "mesh it: `gmsh -2 FILE -format msh41 -o mesh.msh`";
const SURFACE: &str = "it holds triangles without physical groups: mesh the plane domain in Gmsh and name its curves there";
const OLD: &str = "save it anew: `gmsh FILE -save -format msh41 -o mesh.msh`";
const SAVE: &str = "save as MSH 4.1 (`gmsh FILE -save -format msh41 -o mesh.msh`)";
const UTF16: &str = "save it as UTF-8, or as plain ASCII";
const SCENE: &str = "give the scene as the command's argument; its key `mesh` names the mesh";

/// Beginnings of files of a kind, blanks left out, with the kind and a hint.
const BEGINNINGS: [(&[&[u8]], &str, &str); 25] = [
    (&[b"\xff\xfe", b"\xfe\xff"], "a text in UTF-16", UTF16),
    (&[b"$NOD\n", b"$NOD\r"], "a Gmsh mesh of format 1 (`$NOD`, `$ELM`)", OLD),
    (&[b"$PostFormat"], "a Gmsh post-processing view", OLD),
    (&[b"<VTKFile"], "a VTK file (XML: .vtu, .vtp, .pvd)", SOLUTION),
    (&[b"# vtk DataFile"], "a VTK file (legacy .vtk)", SOLUTION),
    (&[b"<Xdmf"], "an XDMF file", SOLUTION),
    (&[b"<"], "an XML file", SOLUTION),
    (&[b"\x89HDF"], "an HDF5 file (MED, XDMF's data, CGNS)", CONVERT),
    (&[b"CDF\x01", b"CDF\x02"], "a NetCDF file (Exodus)", CONVERT),
    (&[b"\x1f\x8b"], "compressed by gzip", UNPACK),
    (&[b"BZh"], "compressed by bzip2", UNPACK),
    (&[b"\xfd7zXZ"], "compressed by xz", UNPACK),
    (&[b"\x28\xb5\x2f\xfd"], "compressed by zstd", UNPACK),
    (&[b"PK\x03\x04"], "a ZIP archive", UNPACK),
    (&[b"solid"], "an STL surface", SURFACE),
    (&[b"ply"], "a PLY surface", SURFACE),
    (&[b"OFF"], "an OFF surface", SURFACE),
    (&[b"ISO-10303-21"], "a STEP geometry", MESH_IT),
    (&[b"DBRep_DrawableShape", b"CASCADE Topology"], "a BREP geometry", MESH_IT),
    (&[b"MeshVersionFormatted"], "a Medit mesh (.mesh)", CONVERT),
    (&[b"NDIME"], "an SU2 mesh", CONVERT),
    (&[b"*HEADING", b"*NODE"], "an Abaqus mesh (.inp)", CONVERT),
    (&[b"$#"], "an LS-DYNA mesh (.key)", CONVERT),
    (&[b"$ ", b"BEGIN BULK"], "a Nastran mesh (.bdf)", CONVERT),
    (&[b"-1\n"], "an I-DEAS mesh (.unv)", CONVERT),
];

/// Beginnings of lines of a Gmsh geometry, and of a scene.
const GEOMETRY: [&str; 7] =
    ["SetFactory(", "Point(", "Point (", "Rectangle(", "Disk(", "Merge \"", "Include \""];
const TABLES: [&str; 2] = ["[boundary.", "[material."];

/// The error that names what a file of no format that is read is, as far as it is known.
pub(super) fn refused(bytes: &[u8]) -> InputError {
    let unknown = match bytes.trim_ascii() {
        b"" => ("empty", SAVE),
        _ => ("of no known kind", SAVE),
    };
    let (found, hint) = known(bytes).unwrap_or(unknown);
    let message = format!("the file is {found}, expected a Gmsh mesh (MSH 2.0 to 2.2, or 4.1)");
    InputError::new(message).hint(hint)
}

fn known(bytes: &[u8]) -> Option<(&'static str, &'static str)> {
    let start = bytes.trim_ascii_start();
    // Behind its declaration an XML file says what it is.
    let start = match start.strip_prefix(b"<?xml").and_then(after_declaration) {
        Some(rest) => rest.trim_ascii_start(),
        None => start,
    };
    let begins =
        |text: &[u8]| start.get(..text.len()).is_some_and(|start| start.eq_ignore_ascii_case(text));
    let beginning = BEGINNINGS.iter().find(|(texts, ..)| texts.iter().any(|text| begins(text)));
    beginning.map(|&(_, found, hint)| (found, hint)).or_else(|| stl(bytes)).or_else(|| lines(start))
}

fn after_declaration(text: &[u8]) -> Option<&[u8]> {
    let end = text.iter().take(LOOKED_AT).position(|&byte| byte == b'>')?;
    text.get(end + 1..)
}

/// A binary STL file is 80 bytes of anything, a number n, and 50 bytes for each of n triangles.
fn stl(bytes: &[u8]) -> Option<(&'static str, &'static str)> {
    let count = bytes.get(80..)?.first_chunk().copied().map(u32::from_le_bytes)?;
    (bytes.len() as u64 == 84 + 50 * u64::from(count)).then_some(("an STL surface", SURFACE))
}

fn lines(start: &[u8]) -> Option<(&'static str, &'static str)> {
    if start.starts_with(b"$") {
        return None;
    }
    let text = String::from_utf8_lossy(&start[..start.len().min(LOOKED_AT)]);
    text.lines().map(str::trim_start).find_map(|line| {
        let begins = |words: &[&str]| words.iter().any(|word| line.starts_with(word));
        let geometry = begins(&GEOMETRY).then_some(("a Gmsh geometry (.geo)", MESH_IT));
        geometry.or(begins(&TABLES).then_some(("a scene", SCENE)))
    })
}

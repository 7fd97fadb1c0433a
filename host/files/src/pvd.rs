//! A series of VTU files, as ParaView plays it.

use std::fmt::Write as _;

/// One of the files.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    /// Its time, or what stands for it.
    pub time: f64,
    /// Its path, seen from the series.
    pub file: String,
}

/// The text of a `.pvd` file.
pub fn pvd(frames: &[Frame]) -> String {
    let mut text = String::from(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n",
    );
    for Frame { time, file } in frames {
        let _ = writeln!(text, "    <DataSet timestep=\"{time}\" part=\"0\" file=\"{file}\"/>");
    }
    text + "  </Collection>\n</VTKFile>\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_series_names_its_files_in_order() {
        let frame = |at: u8| Frame { time: f64::from(at), file: format!("levels/{at:02}.vtu") };
        let text = pvd(&[frame(0), frame(1)]);
        let files: Vec<_> = text.lines().filter(|line| line.contains("<DataSet")).collect();
        assert_eq!(
            files,
            [
                "    <DataSet timestep=\"0\" part=\"0\" file=\"levels/00.vtu\"/>",
                "    <DataSet timestep=\"1\" part=\"0\" file=\"levels/01.vtu\"/>"
            ]
        );
    }
}

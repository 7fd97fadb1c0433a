//! Sources that vary across thin cells, or along the direction in which A conducts: what their means leave out.

use std::f64::consts::PI;

use super::{Options, SolverKind, judged};
use signorini_problem::fixtures::on_grid;
use signorini_scene::error::Result;
use signorini_scene::mesh::Mesh;
use signorini_scene::mesh::structured::{Cells, grid};

/// A = diag(a, 1), u = (w/π)² sin(πξ/w)/a of a coordinate ξ that is (x, y) turned by `angle`, u on the whole boundary.
fn wave(a: f64, along: [f64; 2], width: f64, angle: f64) -> String {
    let (sin, cos) = angle.sin_cos();
    let turned = |[x, y]: [f64; 2]| [cos * x - sin * y, sin * x + cos * y];
    let [p, q] = turned(along);
    let phase = format!("pi*({p:e}*x + {q:e}*y)/{width:e}");
    let of_wave = along[0] * along[0] * a + along[1] * along[1];
    let (size, slope) = (width * width / of_wave / PI / PI, width / of_wave / PI);
    let (xx, xy, yy) =
        (a * cos * cos + sin * sin, (a - 1.0) * sin * cos, a * sin * sin + cos * cos);
    format!(
        "
mesh = \"grid\"
material.default.conductivity = [\"{xx:e}\", \"{xy:e}\", \"{yy:e}\"]
source.f = \"sin({phase})\"
boundary.default = {{ kind = \"dirichlet\", value = \"{size:e}*sin({phase})\" }}
boundary.contact = {{ kind = \"dirichlet\", value = \"{size:e}*sin({phase})\" }}
exact = {{ u = \"{size:e}*sin({phase})\", gradient = [\"{:e}*cos({phase})\", \"{:e}*cos({phase})\"] }}
",
        slope * p,
        slope * q
    )
}

fn placed(mut mesh: Mesh, angle: f64, to: impl Fn([f64; 2]) -> [f64; 2]) -> Mesh {
    let (sin, cos) = angle.sin_cos();
    for vertex in &mut mesh.vertices {
        let [x, y] = to(*vertex);
        *vertex = [cos * x - sin * y, sin * x + cos * y];
    }
    mesh
}

/// Total over the true error.
fn ratio(text: &str, mesh: Mesh) -> Result<f64> {
    let (found, of) = judged(&on_grid(text, mesh)?.1, &Options::by(SolverKind::Direct))?;
    let bound = found.bound.expect("a bound");
    assert!(bound.total >= of.combined, "{bound:?} {of:?}");
    Ok(bound.total / of.combined)
}

/// u = sin(πx) cos y/(10⁶π²), which is no wave along one direction: what means leave out adds up along rows of cells.
#[test]
fn nor_do_they_where_the_source_varies_both_ways() -> Result<()> {
    let (a, size) = (1e6, 1e-6 / PI / PI);
    let text = format!(
        "
mesh = \"grid\"
material.default.conductivity = [\"{a:e}\", \"0\", \"1\"]
source.f = \"{:e}*sin(pi*x)*cos(y)\"
boundary.default = {{ kind = \"dirichlet\", value = \"{size:e}*sin(pi*x)*cos(y)\" }}
boundary.contact = {{ kind = \"dirichlet\", value = \"{size:e}*sin(pi*x)*cos(y)\" }}
exact = {{ u = \"{size:e}*sin(pi*x)*cos(y)\", gradient = [\"{:e}*cos(pi*x)*cos(y)\", \"{:e}*sin(pi*x)*sin(y)\"] }}
",
        size * (a * PI * PI + 1.0),
        size * PI,
        -size
    );
    for shear in [0.0, 0.3] {
        let found = ratio(&text, placed(grid(6, Cells::Quads), 0.0, |[x, y]| [x + shear * y, y]))?;
        assert!(found < 3.0, "{shear}: {found}");
    }
    Ok(())
}

/// Levels of the wave run through parallelograms aslant: what their means leave out passes from one to the next.
#[test]
fn nor_do_they_on_parallelograms_aslant() -> Result<()> {
    for angle in [0.0, PI / 6.0] {
        for shear in [0.3, -1.0] {
            let slanted = |[x, y]: [f64; 2]| [x + shear * y, y];
            let slanted = placed(grid(6, Cells::Quads), angle, slanted);
            let found = ratio(&wave(1e6, [1.0, 0.0], 1.0, angle), slanted)?;
            assert!(found < 3.0, "A, {angle} {shear}: {found}");
            let strip = |[x, y]: [f64; 2]| [0.5 * (x + 1.0), 1e-4 * (y + shear * x)];
            let strip = placed(grid(6, Cells::Quads), angle, strip);
            let found = ratio(&wave(1.0, [0.0, 1.0], 1e-4, angle), strip)?;
            assert!(found < 3.0, "strip, {angle} {shear}: {found}");
        }
    }
    Ok(())
}

/// f = sin πx, A = diag(10⁶, 1); f = sin(πy/ε) on a strip of ε = 10⁻⁴, also on parallelograms. On axes and turned.
#[test]
fn means_leave_out_no_more_than_the_error() -> Result<()> {
    let thin = 1e-4;
    for angle in [0.0, PI / 6.0] {
        for cells in [Cells::Triangles, Cells::Quads] {
            for n in [4, 8] {
                let square = placed(grid(n, cells), angle, |x| x);
                let found = ratio(&wave(1e6, [1.0, 0.0], 1.0, angle), square)?;
                assert!(found < 3.0, "A, {angle} {cells:?} {n}: {found}");
                for shear in [0.0, 1.0] {
                    let strip = |[x, y]: [f64; 2]| [0.5 * (x + 1.0) + shear * thin * y, thin * y];
                    let strip = placed(grid(n, cells), angle, strip);
                    let found = ratio(&wave(1.0, [0.0, 1.0], thin, angle), strip)?;
                    assert!(found < 3.0, "strip, {angle} {cells:?} {n} {shear}: {found}");
                }
            }
        }
    }
    Ok(())
}

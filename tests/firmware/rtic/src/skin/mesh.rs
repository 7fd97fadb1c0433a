//! The skin's mesh, computed by the compiler: it lies in flash.
//!
//! ```text
//!   y = H ┌──┬──┬──┬──┐   contact
//!         │ ╱│ ╱│ ╱│ ╱│
//!         ├──┼──┼──┼──┤   vertex `row · (COLUMNS + 1) + column`, from the lower left
//!         │ ╱│ ╱│ ╱│ ╱│
//!   y = 0 └──┴──┴──┴──┘   Dirichlet
//! ```

/// Squares along the surface and across the skin; each is cut into two triangles.
pub const COLUMNS: usize = 16;
const ROWS: usize = 8;
/// Of a square, in m.
pub const SIDE: f32 = 0.0025;

pub const TRIANGLES: usize = 2 * COLUMNS * ROWS;
pub const NODES: usize = (COLUMNS + 1) * (ROWS + 1);
pub const BOUNDARY: usize = 2 * (COLUMNS + ROWS);

/// Of the skin, in m.
pub const WIDTH: f32 = SIDE * COLUMNS as f32;
/// Of the skin, in m.
pub const HEIGHT: f32 = SIDE * ROWS as f32;

/// In m.
pub static VERTICES: [[f32; 2]; NODES] = {
    let mut vertices = [[0.0; 2]; NODES];
    let mut at = 0;
    while at < NODES {
        let (column, row) = (at % (COLUMNS + 1), at / (COLUMNS + 1));
        vertices[at] = [SIDE * column as f32, SIDE * row as f32];
        at += 1;
    }
    vertices
};

/// Counterclockwise.
pub static CELLS: [[u16; 3]; TRIANGLES] = {
    let mut cells = [[0; 3]; TRIANGLES];
    let mut square = 0;
    while square < COLUMNS * ROWS {
        let (column, row) = (square % COLUMNS, square / COLUMNS);
        let left = (row * (COLUMNS + 1) + column) as u16;
        let above = left + COLUMNS as u16 + 1;
        cells[2 * square] = [left, left + 1, above + 1];
        cells[2 * square + 1] = [left, above + 1, above];
        square += 1;
    }
    cells
};

//! A heated skin, and all that this program knows of the kernel.
//!
//! ```text
//!         wind: takes `loss` W/m² from every segment of the surface
//!   y = H ┌──┬──┬──┬──┬──┬──┬──┬──┐   contact: the heater holds at least 2 °C and only ever heats
//!         │ ╱│ ╱│ ╱│ ╱│ ╱│ ╱│ ╱│ ╱│   sides: insulated
//!   y = 0 └──┴──┴──┴──┴──┴──┴──┴──┘   structure: 5 °C
//! ```
//! u is the temperature and A∇u·n the heat that flows in, so the wind is q = −loss and the multiplier
//! A∇u·n − q is what the heater has to give: the contact force is its power, in W per metre of span.

use signorini_kernel::condition::{BoundaryEdge, Condition};
use signorini_kernel::edges::Block;
use signorini_kernel::solver::{Settings, Status};
use signorini_kernel::stiffness::Coefficient;
use signorini_kernel::{Error, Mesh, Relaxation, Tensor, Workspace};

/// Squares along the surface and across the skin; each is cut into two triangles.
pub const COLUMNS: usize = 8;
const ROWS: usize = 4;
/// m
const SIDE: f32 = 0.005;
/// W/mK
const CONDUCTIVITY: f32 = 15.0;
/// °C
const STRUCTURE: f32 = 5.0;
/// °C
pub const MINIMUM: f32 = 2.0;

/// Sweeps between two looks at the clock.
const SWEEPS: u32 = 16;
/// The best relaxation factor for this mesh, found by trying; new loads hardly move it.
const OMEGA: f32 = 1.75;
/// Residual relative to the range of temperatures: so tight that a few ticks are cut short. With 0, an
/// overloaded tick never ends by itself.
const TOLERANCE: f32 = if cfg!(feature = "overload") { 0.0 } else { 5e-7 };

const TRIANGLES: usize = 2 * COLUMNS * ROWS;
const NODES: usize = (COLUMNS + 1) * (ROWS + 1);
const BOUNDARY: usize = 2 * (COLUMNS + ROWS);
const EDGES: usize = (3 * TRIANGLES + BOUNDARY) / 2;

/// The kernel's memory.
pub type Memory =
    Workspace<f32, u16, NODES, TRIANGLES, 0, BOUNDARY, { EDGES + 1 }, { 5 * EDGES }, 4>;

/// Computed by the compiler: the mesh lies in flash.
static VERTICES: [[f32; 2]; NODES] = {
    let mut vertices = [[0.0; 2]; NODES];
    let mut at = 0;
    while at < NODES {
        let (column, row) = (at % (COLUMNS + 1), at / (COLUMNS + 1));
        vertices[at] = [SIDE * column as f32, SIDE * row as f32];
        at += 1;
    }
    vertices
};

static CELLS: [[u16; 3]; TRIANGLES] = {
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

/// What a block of sweeps came to.
pub struct Progress {
    /// Sweeps done.
    pub sweeps: u32,
    /// Whether no more are needed.
    pub solved: bool,
}

/// The skin with its present loads and temperatures.
pub struct Plant {
    memory: &'static mut Memory,
    mesh: Mesh<'static, f32, u16>,
    /// Where the heated segments begin among the edges.
    first: usize,
}

impl Plant {
    /// Numbers and assembles: once, before the ticks.
    pub fn new(memory: &'static mut Memory) -> Result<Self, Error> {
        let mesh = Mesh::new(&VERTICES, &CELLS, &[])?;
        let coefficient = Coefficient::Uniform(Tensor::scalar(CONDUCTIVITY));
        let counts =
            memory.build(&mesh, coefficient, |edge| Some(condition(edge, &[0.0; COLUMNS])))?;
        Ok(Self { memory, mesh, first: counts.start(Block::Contact) })
    }

    /// New heat losses in W/m², one a segment; the temperatures stay, so the solve starts warm.
    pub fn set_losses(&mut self, losses: &[f32; COLUMNS]) -> Result<(), Error> {
        self.memory.set_conditions(&self.mesh, |edge| Some(condition(edge, losses)))
    }

    /// A few more sweeps, which leave temperatures that are feasible in any case.
    pub fn advance(&mut self) -> Result<Progress, Error> {
        let outcome = self.memory.solve(Settings {
            relaxation: Relaxation::Fixed(OMEGA),
            tolerance: TOLERANCE,
            max_sweeps: SWEEPS,
            ..Settings::default()
        })?;
        let solved = matches!(outcome.status, Status::Converged | Status::RoundingLimit);
        Ok(Progress { sweeps: outcome.sweeps, solved })
    }

    /// What the heater gives, in W/m.
    pub fn force(&self) -> f32 {
        self.memory.contact_force()
    }

    /// Temperatures of the heated segments.
    pub fn surface(&self) -> [f32; COLUMNS] {
        let mut surface = [f32::NAN; COLUMNS];
        for (mean, &u) in surface.iter_mut().zip(self.memory.u().iter().skip(self.first)) {
            *mean = u;
        }
        surface
    }
}

fn condition(edge: &BoundaryEdge<f32, u16>, losses: &[f32; COLUMNS]) -> Condition<f32> {
    const TOP: f32 = SIDE * ROWS as f32;
    match edge.middle() {
        [_, 0.0] => Condition::Dirichlet { value: STRUCTURE },
        [x, TOP] => {
            let loss = losses.get((x / SIDE) as usize).copied().unwrap_or_default();
            Condition::Contact { gap: MINIMUM, flux: -loss }
        }
        _ => Condition::Neumann { flux: 0.0 },
    }
}

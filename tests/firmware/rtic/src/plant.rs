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
//! A is the same everywhere, and loss and gap are constant along each segment: the bound of the error
//! leaves nothing out.

use signorini_bound::certificate::Verdict;
use signorini_device::condition::{BoundaryEdge, Condition};
use signorini_device::tick::{Deadline, Ended, Limits};
use signorini_device::workspace;
use signorini_kernel::mesh::edges::{Block, EdgeCounts};
use signorini_kernel::relaxation::Relaxation;
use signorini_kernel::stiffness::Coefficient;
use signorini_kernel::{Error, Mesh, Tensor};

use crate::mesh::{CELLS, COLUMNS, HEIGHT, NODES, SIDE, TRIANGLES, VERTICES, WIDTH};

/// Memory of the skin.
pub type Skin = workspace!(f32, u16: vertices NODES, triangles TRIANGLES, quads 0,
                           boundary crate::mesh::BOUNDARY, ticks only);

/// W/mK
const CONDUCTIVITY: f32 = 15.0;
/// °C
const STRUCTURE: f32 = 5.0;
/// °C
pub const MINIMUM: f32 = 2.0;

/// The best relaxation factor for this mesh, found by trying; new losses hardly move it.
const OMEGA: f32 = 1.8;

/// A tick goes on until more sweeps would buy nothing, or the bound is 0.1 √(WK/m), less than a
/// hundredth of what the energy norm mostly is: a surface that the heater holds everywhere is solved
/// exactly, and there a share would never be small. Sweeps end a tick only should the clock stand still.
pub const LIMITS: Limits<f32> = Limits { error: 0.1, share: 0.1, sweeps: 256 };

/// The result of one tick.
#[derive(Clone, Copy)]
pub struct Answer {
    /// What ended it.
    pub ended: Ended,
    /// Sweeps that it took.
    pub sweeps: u32,
    /// Power of the heater in W/m.
    pub force: f32,
    /// How wrong the temperatures can be, in the energy norm.
    pub verdict: Verdict<f32>,
    /// ∫τ·∇u, with the flux τ of the certificate: the square of the energy norm, once solved.
    pub energy: f32,
    /// Temperatures of the heated segments in °C.
    pub surface: [f32; COLUMNS],
}

/// The skin with its present losses and temperatures.
pub struct Plant {
    mesh: Mesh<'static, f32, u16>,
    skin: &'static mut Skin,
    counts: EdgeCounts,
}

impl Plant {
    /// Numbers and fills in all that stays: once, before the ticks.
    pub fn new(skin: &'static mut Skin) -> Result<Self, Error> {
        let mesh = Mesh::new(&VERTICES, &CELLS, &[])?;
        let steel = Coefficient::Uniform(Tensor::scalar(CONDUCTIVITY));
        let counts = skin.build(&mesh, steel, |edge| Some(condition(edge, &[0.0; COLUMNS])))?;
        skin.set_relaxation(Relaxation::Fixed(OMEGA))?;
        Ok(Self { mesh, skin, counts })
    }

    /// Takes new losses in W/m², one a segment.
    pub fn set(&mut self, losses: &[f32; COLUMNS]) -> Result<(), Error> {
        self.skin.set_conditions(&self.mesh, |edge| Some(condition(edge, losses)))
    }

    /// The answer to the losses, from where the last one was.
    pub fn answer(
        &mut self,
        limits: Limits<f32>,
        deadline: &mut Deadline<impl FnMut() -> u32>,
    ) -> Result<Answer, Error> {
        let report = self.skin.tick(&self.mesh, limits, deadline)?;
        Ok(Answer {
            ended: report.ended,
            sweeps: report.sweeps,
            force: report.figures.force,
            verdict: report.verdict,
            energy: self.energy(),
            surface: self.surface(),
        })
    }

    /// Temperatures of the heated segments.
    fn surface(&self) -> [f32; COLUMNS] {
        let mut surface = [f32::NAN; COLUMNS];
        let first = self.counts.start(Block::Contact);
        for (mean, &u) in surface.iter_mut().zip(self.skin.u().iter().skip(first)) {
            *mean = u;
        }
        surface
    }

    /// By Green's formula: nothing is lost inside or at the sides, so that all heat from the
    /// structure leaves through the surface.
    fn energy(&self) -> f32 {
        let first = self.counts.start(Block::Contact);
        let on_surface = self.skin.u().iter().zip(self.skin.flux()).skip(first).take(COLUMNS);
        on_surface.fold(0.0, |sum, (&u, &tau)| sum + (u - STRUCTURE) * tau)
    }
}

/// What holds on a boundary edge.
fn condition(edge: &BoundaryEdge<f32, u16>, losses: &[f32; COLUMNS]) -> Condition<f32> {
    match edge.middle() {
        [x, _] if x <= 0.0 || x >= WIDTH => Condition::Neumann { flux: 0.0 },
        [_, y] if y < 0.5 * HEIGHT => Condition::Dirichlet { value: STRUCTURE },
        [x, _] => {
            let loss = losses.get((x / SIDE) as usize).copied().unwrap_or_default();
            Condition::Contact { gap: MINIMUM, flux: -loss }
        }
    }
}

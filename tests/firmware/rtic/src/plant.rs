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

use signorini_kernel::assembly::CellLoads;
use signorini_kernel::boundary::Boundary;
use signorini_kernel::certificate::{Given, Verdict};
use signorini_kernel::conforming::VertexData;
use signorini_kernel::edges::{Block, Edges};
use signorini_kernel::rows;
use signorini_kernel::tick::{Data, Deadline, Ended, Limits, Tick};
use signorini_kernel::{Error, Relaxation};

use crate::mesh::{COLUMNS, SIDE};
use crate::start::{self, Memory};

/// W/mK
pub const CONDUCTIVITY: f32 = 15.0;
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

static GAP: [f32; COLUMNS] = [MINIMUM; COLUMNS];
static GAP_AT_ENDS: [[f32; 2]; COLUMNS] = [[MINIMUM; 2]; COLUMNS];
static GIVEN: [f32; COLUMNS] = [STRUCTURE; COLUMNS];
static GIVEN_AT_ENDS: [[f32; 2]; COLUMNS] = [[STRUCTURE; 2]; COLUMNS];

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
    tick: Tick<'static, f32, u16, { rows::TRIANGLES }>,
    edges: Edges<'static, u16>,
}

impl Plant {
    /// Numbers and fills in all that stays: once, before the ticks.
    pub fn new(memory: &'static mut Memory) -> Result<Self, Error> {
        let (ground, memory) = start::build(memory)?;
        let tick = Tick::new(ground, memory, Relaxation::Fixed(OMEGA))?;
        Ok(Self { tick, edges: ground.edges })
    }

    /// Nothing but the start of an answer.
    pub fn begin(&mut self, losses: &[f32; COLUMNS]) -> Result<(), Error> {
        let flux = fluxes(losses);
        self.tick.begin(data(&self.edges, &flux)?).map(drop)
    }

    /// The answer to new losses in W/m², one a segment, from where the last one was.
    pub fn answer(
        &mut self,
        losses: &[f32; COLUMNS],
        limits: Limits<f32>,
        deadline: &mut Deadline<impl FnMut() -> u32>,
    ) -> Result<Answer, Error> {
        let flux = fluxes(losses);
        let report = self.tick.begin(data(&self.edges, &flux)?)?.advance(limits, deadline)?;
        Ok(Answer {
            ended: report.ended,
            sweeps: report.sweeps,
            force: report.force,
            verdict: report.verdict,
            energy: self.energy(),
            surface: self.surface(),
        })
    }

    /// Temperatures of the heated segments.
    fn surface(&self) -> [f32; COLUMNS] {
        let mut surface = [f32::NAN; COLUMNS];
        let first = self.edges.counts().start(Block::Contact);
        for (mean, &u) in surface.iter_mut().zip(self.tick.u().iter().skip(first)) {
            *mean = u;
        }
        surface
    }

    /// By Green's formula: nothing is lost inside or at the sides, so that all heat from the
    /// structure leaves through the surface.
    fn energy(&self) -> f32 {
        let first = self.edges.counts().start(Block::Contact);
        let on_surface = self.tick.u().iter().zip(self.tick.tau()).skip(first).take(COLUMNS);
        on_surface.fold(0.0, |sum, (&u, &tau)| sum + (u - STRUCTURE) * tau)
    }
}

/// ∫q of the contact edges, which are numbered as the cells are: from left to right.
fn fluxes(losses: &[f32; COLUMNS]) -> [f32; COLUMNS] {
    losses.map(|loss| -SIDE * loss)
}

fn data<'a>(
    edges: &Edges<'static, u16>,
    flux: &'a [f32; COLUMNS],
) -> Result<Data<'a, f32, u16>, Error> {
    let given = Given {
        loads: CellLoads { triangles: &[], quads: &[] },
        boundary: Boundary::new(edges, &[], &[], flux)?,
        ends: VertexData { gap: &GAP_AT_ENDS, given: &GIVEN_AT_ENDS },
        curved: &[],
        transfer: &[],
        oscillation: 0.0,
    };
    Ok(Data { given, lower: &GAP, dirichlet: &GIVEN })
}

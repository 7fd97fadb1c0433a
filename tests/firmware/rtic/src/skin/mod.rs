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

mod mesh;
mod sensor;

use signorini_board::draw::Draw;
use signorini_board::journal::Journal;
use signorini_device::condition::{BoundaryEdge, Condition};
use signorini_device::tick::{Deadline, Limits, Report};
use signorini_device::workspace;
use signorini_kernel::mesh::edges::{Block, EdgeCounts};
use signorini_kernel::relaxation::Relaxation;
use signorini_kernel::stiffness::Coefficient;
use signorini_kernel::{Error, Libm, Math, Mesh, Tensor};

use mesh::{BOUNDARY, CELLS, COLUMNS, HEIGHT, NODES, SIDE, TRIANGLES, VERTICES, WIDTH};

/// Ticks of a run.
pub const TICKS: u32 = 10_000;

/// A sweep of this mesh: 8 920 instructions on a Cortex-M4F are 223 counts, with the search for ω now and then.
/// Every run counts it before the first tick (`Costs::measure`), and fails where it is more.
pub const SWEEP: u32 = 225;

/// A certificate of this mesh and the report after it: 107 900 instructions are 2 698 counts. Every tick
/// counts it, from the last look at the clock to the answer.
pub const CERTIFICATE: u32 = 2720;

/// From one tick to the next: so short that the deadline ends one tick in five. An overloaded tick
/// has no time for a certificate, let alone a sweep.
pub const PERIOD: u32 = if cfg!(feature = "overload") { CERTIFICATE / 2 } else { 13_100 };

/// Memory of the skin.
pub type Memory = workspace!(f32, u16: vertices NODES, triangles TRIANGLES, quads 0,
                             boundary BOUNDARY, ticks only);

/// W/mK
const CONDUCTIVITY: f32 = 15.0;
/// °C
const STRUCTURE: f32 = 5.0;
/// °C
const MINIMUM: f32 = 2.0;

/// The best relaxation factor for this mesh, found by trying; new losses hardly move it.
const OMEGA: f32 = 1.8;

/// A tick goes on until more sweeps would buy nothing, or the bound is 0.1 √(WK/m), less than a
/// hundredth of what the energy norm mostly is: a surface that the heater holds everywhere is solved
/// exactly, and there a share would never be small. Sweeps end a tick only should the clock stand still.
pub const LIMITS: Limits<f32> = Limits { error: 0.1, share: 0.1, sweeps: 256 };

/// The result of one tick.
#[derive(Clone, Copy)]
pub struct Answer {
    /// What the kernel says of it; the force is the power of the heater in W/m.
    pub report: Report<f32>,
    /// ∫τ·∇u, with the flux τ of the certificate: the square of the energy norm, once solved.
    energy: f32,
    /// Temperatures of the heated segments in °C.
    surface: [f32; COLUMNS],
}

/// The skin with its present losses and temperatures.
pub struct Plant {
    mesh: Mesh<'static, f32, u16>,
    skin: &'static mut Memory,
    counts: EdgeCounts,
    /// Of the losses.
    draw: Draw,
}

impl Plant {
    /// Numbers and fills in all that stays: once, before the ticks.
    pub fn new(skin: &'static mut Memory) -> Result<Self, Error> {
        let mesh = Mesh::new(&VERTICES, &CELLS, &[])?;
        let steel = Coefficient::Uniform(Tensor::scalar(CONDUCTIVITY));
        let counts = skin.build(&mesh, steel, |edge| Some(condition(edge, &[0.0; COLUMNS])))?;
        skin.set_relaxation(Relaxation::Fixed(OMEGA))?;
        Ok(Self { mesh, skin, counts, draw: Draw::from_seed(1) })
    }

    /// Reads new losses in W/m², one a segment.
    pub fn advance(&mut self) -> Result<(), Error> {
        let losses = sensor::read(&mut self.draw);
        self.skin.set_conditions(&self.mesh, |edge| Some(condition(edge, &losses)))
    }

    /// The answer to the losses, from where the last one was.
    pub fn answer(
        &mut self,
        limits: Limits<f32>,
        deadline: &mut Deadline<impl FnMut() -> u32>,
    ) -> Result<Answer, Error> {
        let report = self.skin.tick(&self.mesh, limits, deadline)?;
        Ok(Answer { report, energy: self.energy(), surface: self.surface() })
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

/// What the answers were like.
pub struct Judge {
    answers: u32,
    /// The largest bound of the error, in thousandths of the energy norm.
    worst: u32,
    /// The sum of the same.
    sum: u32,
}

impl Judge {
    /// No answers.
    pub const NEW: Self = Self { answers: 0, worst: 0, sum: 0 };

    /// Whether it is finite, nowhere too cold, and has a bound of its error: one that was cut short has to keep
    /// this too.
    pub fn is_sound(&mut self, answer: &Answer) -> bool {
        let Answer { report, energy, surface } = answer;
        let feasible = surface.iter().all(|&u| u.is_finite() && u >= MINIMUM);
        // The wind never rests, so heat flows.
        let sound = report.figures.force.is_finite() && *energy > 0.0;
        let bound = report.verdict.certificate().filter(|bound| bound.total.is_finite());
        let Some(bound) = bound.filter(|_| feasible && sound) else { return false };
        let thousandths = (1000.0 * bound.total / Libm::sqrt(*energy)) as u32;
        self.answers += 1;
        self.worst = self.worst.max(thousandths);
        self.sum += thousandths;
        true
    }

    /// Prints bounds and the last force; whether the run has seen what it should.
    pub fn tell(&self, last: &Answer, journal: &mut Journal) -> bool {
        journal.count("worst bound, thousandths", self.worst);
        journal.count("mean bound, thousandths", self.sum / self.answers.max(1));
        journal.scalar("force", last.report.figures.force);
        true
    }
}

//! The leanest arrangement of the kernel's layers: matrices in flash, packed rows in RAM, no CSR.
//!
//! ```text
//!   RAM = N·(row + scalar) + E·scalar + T·3·scalar + Q·4·scalar      N unknowns, E edges,
//!         row in f32: 28 bytes on triangles, 40 elsewhere            T triangles, Q quads
//!         row in f64: 48 bytes on triangles, 72 elsewhere
//! ```

use signorini_device::model::Model;
use signorini_kernel::law::Law;
use signorini_kernel::mesh::diagonal::DiagonalTerms;
use signorini_kernel::rows::{Row, Rows, TRIANGLES};
use signorini_kernel::{Error, assembly, contact, flux, psor};

use crate::journal::{Bits, Journal};

/// Memory of a scene of exactly this size; `CONTACT` tells whether it has contact edges.
pub struct Tick<
    R,
    const WIDTH: usize,
    const CONTACT: bool,
    const N: usize,
    const E: usize,
    const T: usize,
    const Q: usize,
> {
    rows: [Row<R, u16, WIDTH>; N],
    load: [R; N],
    u: [R; E],
    of_triangles: [[R; 3]; T],
    of_quads: [[R; 4]; Q],
}

impl<
    R: Bits,
    const WIDTH: usize,
    const CONTACT: bool,
    const N: usize,
    const E: usize,
    const T: usize,
    const Q: usize,
> Tick<R, WIDTH, CONTACT, N, E, T, Q>
{
    /// Zeros; can initialise a `static`.
    pub const fn new() -> Self {
        Self {
            rows: [Row::EMPTY; N],
            load: [R::ZERO; N],
            u: [R::ZERO; E],
            of_triangles: [[R::ZERO; 3]; T],
            of_quads: [[R::ZERO; 4]; Q],
        }
    }

    /// Assembles, sweeps, recovers the flux. Returns the contact force.
    ///
    /// # Errors
    /// A model of another size.
    #[inline(never)]
    pub fn run(&mut self, model: &Model<R, u16>, omega: R, sweeps: u32) -> Result<R, Error> {
        let (edges, boundary) = (model.edges()?, model.boundary()?);
        let u = super::stages::cut(&mut self.u, model.start.len())?;
        u.copy_from_slice(model.start);
        if WIDTH == TRIANGLES {
            let loads = model.loads.triangles;
            assembly::load_of_triangles(&edges, loads, &boundary, &mut self.load)?;
        } else {
            assembly::load(&edges, model.loads, &boundary, &mut self.load)?;
        }
        let mut rows = Rows::new(&edges, &mut self.rows)?;
        rows.gather(&edges, model.stiffness, DiagonalTerms::new(&boundary), &self.load, omega)?;
        for _ in 0..sweeps {
            if CONTACT {
                psor::sweep(&rows, Law::above(model.gap), u)?;
            } else {
                psor::sweep_free(&rows, u)?;
            }
        }
        let k = model.stiffness;
        flux::of_triangles(&edges, k, model.loads.triangles, u, &mut self.of_triangles)?;
        if WIDTH != TRIANGLES {
            flux::of_quads(&edges, k, model.loads.quads, u, &mut self.of_quads)?;
        }
        let (triangles, quads) = (&self.of_triangles, &self.of_quads);
        Ok(if CONTACT {
            contact::force_of_cells(&edges, &boundary, Law::above(model.gap), u, triangles, quads)
        } else {
            R::ZERO
        })
    }

    /// The bytes that `docs/embedding.md` promises.
    pub fn formula() -> u32 {
        let wide = size_of::<R>() == 8;
        let row = match (wide, WIDTH == TRIANGLES) {
            (false, true) => 28,
            (false, false) => 40,
            (true, true) => 48,
            (true, false) => 72,
        };
        let scalar = if wide { 8 } else { 4 };
        (N * (row + scalar) + E * scalar + T * 3 * scalar + Q * 4 * scalar) as u32
    }

    /// Runs and prints what came of it.
    pub fn show(&mut self, model: &Model<R, u16>, journal: &mut Journal) {
        match self.run(model, R::ONE + R::HALF + R::QUARTER, 100) {
            Ok(force) => journal.scalar("contact force", force),
            Err(_) => journal.text("refused"),
        }
        journal.digest("u", self.u);
        let fluxes = self.of_triangles.as_flattened().iter().chain(self.of_quads.as_flattened());
        journal.digest("flux by cells", fluxes.copied());
    }
}

/// The type for a module of [`crate::scenes`].
#[macro_export]
macro_rules! tick {
    ($scene:ident, $scalar:ty, $width:expr, $contact:expr) => {
        $crate::tick::Tick<
            $scalar, { $width }, $contact,
            { $crate::scenes::$scene::UNKNOWNS }, { $crate::scenes::$scene::EDGES },
            { $crate::scenes::$scene::TRIANGLES }, { $crate::scenes::$scene::QUADS },
        >
    };
}

/// The `main` of an image that holds one scene and nothing else.
#[cfg(target_os = "none")]
#[macro_export]
macro_rules! tick_image {
    ($scene:ident, $scalar:ty, $width:expr, $contact:expr) => {
        type Tick = $crate::tick!($scene, $scalar, $width, $contact);

        #[cortex_m_rt::entry]
        fn main() -> ! {
            // Of cortex-m-rt: the entry gets a reference to it. Initialised by its type, not by code
            // that would build it on the stack first.
            static mut TICK: Tick = Tick::new();
            use $crate::scenes::$scene::MODEL;
            $crate::board::run(|journal| {
                TICK.show(&MODEL, journal);
                let mut force = Ok(0.0);
                let run = || force = TICK.run(&MODEL, 1.75, 1);
                journal.count("@ stack", $crate::board::stack::depth(STACK, run));
                journal.row(&["@ memory"], &[size_of::<Tick>() as u32, Tick::formula()]);
                $crate::breach::commit(&MODEL, force.unwrap_or_default());
            })
        }

        /// Bytes of stack that are watched.
        const STACK: u32 = 4096;
    };
}

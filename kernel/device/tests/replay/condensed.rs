//! Condensed models of a strip, with forms of the bound drawn at random.

use signorini_contact::certificate::{Corner, Form, Vertex};
use signorini_contact::dense::Iterate;
use signorini_contact::dense::blocks::padded;
use signorini_contact::dense::ranges::Given;
use signorini_contact::dense::tableau::InitialTableau;
use signorini_contact::factor::Factor;
use signorini_contact::method::{Method, Pivots, Sweeps};
use signorini_contact::outputs::Measure;
use signorini_contact::sides::Sides;
use signorini_contact::spans::{SpanBuffer, SpanColumns};
use signorini_contact::{Condensed, Memory};
use signorini_kernel::Error;
use signorini_kernel::limits::Deadline;

use super::journal::Journal;
use super::scene::{Draw, Scalar};
use crate::memory::Dense;
use crate::strip::Strip;

/// The constant among them.
const INPUTS: usize = 3;

/// Arrays that a model borrows.
struct Model<R> {
    strip: Strip<R>,
    load: Vec<R>,
    vertices: Vec<Vertex<R>>,
    columns: Vec<R>,
    norms: Vec<R>,
    excess: [Vec<R>; 2],
    floating: Vec<R>,
    lengths: Vec<R>,
    nothing: Vec<bool>,
}

impl<R: Scalar> Model<R> {
    fn new(order: usize, floats: bool) -> Self {
        let mut draw = Draw(order as u64);
        let mut numbers = |length: usize, size: f64| -> Vec<R> {
            (0..length).map(|_| R::of(size * draw.signed())).collect()
        };
        let mut load = numbers(INPUTS * padded(order), 1.0);
        load.iter_mut().enumerate().for_each(|(at, load)| {
            if at % padded(order) >= order {
                *load = R::ZERO;
            }
        });
        let vertex = |at: usize| {
            let [a, b] = [at.saturating_sub(1), at.min(order - 1)].map(|edge| edge as u16);
            // An end extrapolates.
            let weights = if a == b { [R::ONE, R::ZERO] } else { [R::of(1.25), R::of(-0.25)] };
            let edges = if at % 3 == 2 { [b, a] } else { [a, b] };
            Vertex { edges, weights, beside: [a, b] }
        };
        let vertices: Vec<_> = (0..=order).map(vertex).collect();
        let size = INPUTS + order + vertices.len();
        let norms = numbers(size, 1.0).into_iter().map(|x| x.magnitude() + R::ONE).collect();
        let excess = [numbers(INPUTS, 1.0), vec![R::ONE, R::HALF, R::QUARTER]];
        let excess = excess.map(|mut excess| {
            excess[0] = R::TWO + R::ONE;
            excess
        });
        let mut floating: Vec<_> = numbers(order, 1.0).into_iter().map(|x| x.magnitude()).collect();
        floating.iter_mut().for_each(|flux| *flux += R::QUARTER);
        Self {
            strip: Strip::new(order),
            columns: numbers(size * (size + 1) / 2, 1.0),
            lengths: numbers(order, 1.0),
            floating: if floats { floating } else { Vec::new() },
            nothing: vec![false; padded(order)],
            load,
            vertices,
            norms,
            excess,
        }
    }

    /// Hands the model on.
    fn with(
        &self,
        unit: R,
        work: impl FnOnce(&Condensed<R>) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let order = self.strip.order;
        let [first, last] = &self.excess;
        let corner = |edge, excess| Corner { edge, excess, energy: R::ZERO };
        let corners = [corner(0, &first[..]), corner(order as u16 - 1, last)];
        let certificate = Form {
            jump: None,
            factor: Factor { columns: &self.columns, norms: &self.norms },
            vertices: &self.vertices,
            corners: &corners,
            sides: Sides::UNLIMITED,
            stability: R::of(1.5),
            floating: &self.floating,
            oscillation: &[R::of(0.125), R::of(0.25), R::of(0.0625)],
            row_sum: R::of(2.5),
            largest_load: &[R::ONE, R::HALF, R::QUARTER],
            unit,
        };
        let (of_inputs, of_contact) = (&self.excess[0], &self.lengths);
        let huge = [R::of(3.5) / R::TINY; INPUTS];
        let outputs = [
            Measure::Linear { of_inputs, of_contact },
            Measure::Length { always: R::ZERO, of_contact },
            Measure::Bound,
            Measure::Linear { of_inputs: &huge, of_contact },
        ];
        work(&Condensed {
            contact: order,
            matrix: self.strip.blocks(),
            x: &[],
            start: InitialTableau { blocks: self.strip.blocks(), exchanged: &self.nothing },
            load: &self.load,
            limits: &[],
            spans: SpanColumns::UNLIMITED,
            parts: &[],
            outputs: &outputs,
            certificate: Some(certificate),
            has_bound: true,
        })
    }
}

pub fn run<R: Scalar>(journal: &mut Journal) -> Result<(), Error> {
    for (order, floats) in [(1, false), (4, true), (9, false), (17, true), (30, false)] {
        journal.line("edges", (order, floats));
        Model::<R>::new(order, floats).with(R::of(3.0), |model| {
            let mut dense = Dense::new(order);
            for most in [1000, 4] {
                let (mut tableau, _) = dense.parts()?;
                tableau.reset(&model.start)?;
                let sweeps = Sweeps { omega: R::of(1.25), tolerance: R::of(1e-3), most: 5 };
                let mut pivots = Pivots { tableau, start: model.start, most, sweeps };
                ticks(model, &mut pivots, journal)?;
            }
            for (omega, tolerance, most) in [(1.375, 0.0, 40), (1.0, 1e-4, 400), (1.75, 1e-2, 7)] {
                let (omega, tolerance) = (R::of(omega), R::of(tolerance));
                ticks(model, &mut Sweeps { omega, tolerance, most }, journal)?;
            }
            Ok(())
        })?;
    }
    // In units next to the smallest and the largest number.
    for unit in [R::TINY, R::ONE / (R::TINY * R::of(4.0)), R::of(3.5) / R::TINY] {
        Model::<R>::new(6, false).with(unit, |model| {
            let (omega, tolerance) = (R::of(1.25), R::of(1e-4));
            ticks(model, &mut Sweeps { omega, tolerance, most: 30 }, journal)
        })?;
    }
    worn(&Strip::<R>::new(16), journal)?;
    worn(&Strip::<R>::partly_loose(12), journal)
}

/// A tableau that is off by ever more, and loads that nothing bears.
fn worn<R: Scalar>(strip: &Strip<R>, journal: &mut Journal) -> Result<(), Error> {
    let (order, size) = (strip.order, padded(strip.order));
    let (mut dense, nothing) = (Dense::new(order), vec![false; size]);
    let start = InitialTableau { blocks: strip.blocks(), exchanged: &nothing };
    let mut draw = Draw(29);
    for at in 0..30 {
        let pull = [-0.25, 0.01, -0.125, 0.5, 1e4][at % 5];
        let mut entry = |i| R::of(if i < order { pull + 0.5 * draw.signed() } else { 0.0 });
        let load: Vec<_> = (0..size).map(&mut entry).collect();
        let (mut tableau, iterate) = dense.parts()?;
        if at == 0 {
            tableau.reset(&start)?;
        }
        let sweeps = Sweeps { omega: R::ONE, tolerance: R::ZERO, most: 3 };
        let mut pivots = Pivots { tableau, start, most: 1000, sweeps };
        let (given, never) = (Given::above(&load), &mut Deadline::never());
        journal.line("worn", pivots.solve(&strip.matrix()?, given, iterate, never)?);
        journal.digest("x and residual", [&dense.x, &dense.residual]);
        // By 4 ε at first, then by more.
        let off = R::ONE + R::EPSILON * R::of(4.0_f64.powi(1 + at as i32 / 2));
        let entries = dense.blocks.as_flattened_mut().as_flattened_mut();
        entries.iter_mut().for_each(|entry| *entry *= off);
    }
    Ok(())
}

fn ticks<R: Scalar, M: Method<R>>(
    model: &Condensed<R>,
    method: &mut M,
    journal: &mut Journal,
) -> Result<(), Error> {
    let size = padded(model.contact);
    let columns = 2 * model.contact + 1 + INPUTS;
    let mut numbers = [size, size, size, size, columns, columns].map(|n| vec![R::ZERO; n]);
    let [x, residual, scratch, load, combination, sum] = &mut numbers;
    let open = &mut vec![false; size];
    let iterate = Iterate { x, residual, scratch, open };
    let mut memory = Memory { iterate, load, spans: SpanBuffer::new(&mut []), combination, sum };
    let of_reaction: &Vec<_> = &(0..model.contact).map(|at| R::of((at % 3) as f64)).collect();
    let outputs = [
        Measure::Flux { of_inputs: &[], of_contact: &[], of_reaction },
        Measure::Flux { of_inputs: &[R::HALF; INPUTS], of_contact: of_reaction, of_reaction },
    ];
    let pressed = Condensed { outputs: &outputs, ..*model };
    let mut draw = Draw(3);
    // The last output overflows: most ticks would be refused for its sake.
    let held = Condensed { outputs: &model.outputs[..3], ..*model };
    for _ in 0..8 {
        let inputs = [R::ONE, R::of(2.0 * draw.signed()), R::of(draw.signed())];
        let report = held.tick(&inputs, method, &mut Deadline::never(), &mut memory)?;
        journal.line("tick", (report.ended, report.exchanges, report.sweeps, report.active));
        journal.line("bound", report.certificate().map(|certificate| certificate.total));
        let outputs = [0, 1, 2, 3, 4].map(|at| model.output(at, &inputs, &memory, &report));
        let iterate = &memory.iterate;
        journal.digest("bound and outputs", (report.certificate(), outputs));
        journal.digest("x and residual", (&*iterate.x, &iterate.residual));
        let forces = [0, 1].map(|at| pressed.output(at, &inputs, &memory, &report));
        journal.digest("forces", forces);
    }
    Ok(())
}

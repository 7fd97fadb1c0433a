//! Condensed models: of any arrays, and of sound scenes with any inputs.

use signorini_bake::condensed::{Baked, Controller, Work};
use signorini_contact::certificate::{Corner, Form, Vertex};
use signorini_contact::dense::Iterate;
use signorini_contact::dense::blocks::{Block, Blocks, SIDE, count, padded};
use signorini_contact::dense::tableau::{InitialTableau, Tableau};
use signorini_contact::factor::Factor;
use signorini_contact::method::{Linear, Pivots, Sweeps};
use signorini_contact::outputs::Measure;
use signorini_contact::sides::{self, Sides};
use signorini_contact::spans::{SpanBuffer, SpanColumns};
use signorini_contact::{Condensed, Memory};
use signorini_kernel::Error;
use signorini_kernel::limits::Deadline;
use signorini_kernel::report::{Ended, Report};

use super::bytes::{Bits, Bytes, bits, check_settled};
use super::certified::is_bound;
use super::scenes::{self, Kept};

/// Contact edges, at most.
const MOST: usize = 18;

/// S: any numbers, or a unit diagonal and little beside it.
fn matrix<R: Bits>(bytes: &mut Bytes, order: usize) -> Vec<Block<R>> {
    let blocks = if bytes.below(16) == 0 { bytes.below(8) } else { count(order) };
    if bytes.flag() {
        let mut any = || [(); SIDE].map(|()| [(); SIDE].map(|()| bytes.real()));
        return (0..blocks).map(|_| any()).collect();
    }
    let diagonal = |at: usize| (0..SIDE).any(|row| row * (row + 3) / 2 == at);
    let small = bytes.reals::<R>(8).into_iter().map(|x| if x.finite() { x } else { R::ZERO });
    let small: Vec<R> =
        small.map(|x| x.or_smaller(R::TWO).or_larger(-R::TWO) * R::narrow(0.01)).collect();
    let entry = |block: usize, r: usize, c: usize| match diagonal(block) && r == c {
        true => R::ONE,
        false if diagonal(block) => small[(r * c) % 8],
        false => small[(block + r + 3 * c) % 8],
    };
    let filled = |block| std::array::from_fn(|r| std::array::from_fn(|c| entry(block, r, c)));
    (0..blocks).map(filled).collect()
}

/// A model of any arrays, some of them of the wrong length, ticked by each method.
pub fn of_any_arrays<R: Bits>(bytes: &mut Bytes) -> Result<(), Error> {
    let (n, m) = (bytes.below(MOST), 1 + bytes.below(3));
    let matrix = matrix::<R>(bytes, n);
    Blocks::new(&matrix, n)?;
    let corner_excess = bytes.reals(m);
    let index = |bytes: &mut Bytes| u16::from(bytes.byte()) % (n as u16 + 1);
    let vertex = |bytes: &mut Bytes| Vertex {
        edges: [(); 2].map(|()| index(bytes)),
        weights: [(); 2].map(|()| bytes.real()),
        beside: [(); 2].map(|()| index(bytes)),
    };
    let vertices: Vec<_> = (0..bytes.below(4)).map(|_| vertex(bytes)).collect();
    let corners = [Corner { edge: index(bytes), excess: &corner_excess, energy: bytes.real() }];
    let columns = m + n + vertices.len();
    let (entries, norms) = (bytes.reals::<R>(columns * (columns + 1) / 2), bytes.reals(columns));
    let (floating, oscillation) = (bytes.reals(n), bytes.reals(m));
    let largest_load = bytes.reals(m);
    let factor = Factor { columns: &entries, norms: &norms };
    let ends: Vec<_> = (0..n).map(|_| [(); 2].map(|()| u16::from(bytes.byte()) % 8)).collect();
    let (scale, largest, excess) = (bytes.reals(n), bytes.reals(m), bytes.real());
    let sides = sides::Baked { ends: &ends, scale: &scale, excess, largest: &largest };
    let form = Form {
        factor,
        jump: (m > 1).then_some(factor),
        vertices: &vertices,
        corners: &corners[..bytes.below(2)],
        sides: if bytes.flag() { Sides::new(sides) } else { Sides::UNLIMITED },
        stability: bytes.real(),
        floating: if bytes.flag() { &floating } else { &[] },
        oscillation: &oscillation,
        row_sum: bytes.real(),
        largest_load: &largest_load,
        unit: bytes.real(),
    };
    let (of_inputs, of_contact) = (bytes.reals(m), bytes.given(n, false));
    let outputs = [
        Measure::Linear { of_inputs: &of_inputs, of_contact: &of_contact },
        Measure::Length { always: bytes.real(), of_contact: &of_contact },
        Measure::Saturated { always: bytes.real(), of_contact: &of_contact },
        Measure::Flux { of_inputs: &of_inputs, of_contact: &[], of_reaction: &of_contact },
        Measure::Bound,
    ];
    let exchanged: Vec<_> = (0..padded(n)).map(|_| bytes.flag()).collect();
    let load = bytes.reals(padded(n) * m);
    let start = InitialTableau { blocks: &matrix, exchanged: &exchanged };
    let certificate = bytes.flag().then_some(form);
    let x = bytes.reals(padded(n));
    let limits = if bytes.flag() { bytes.groups(n) } else { Vec::new() };
    let columns_of_spans = [0, 1, m][bytes.below(3)];
    let spans = bytes.reals(padded(n) * columns_of_spans);
    let model = Condensed {
        contact: n,
        matrix: &matrix,
        x: &x,
        start,
        load: &load,
        limits: &limits,
        spans: SpanColumns::new(&spans),
        parts: &[],
        outputs: &outputs,
        certificate,
        has_bound: true,
    };
    ticked(bytes, &model, columns, m)
}

fn ticked<R: Bits>(
    bytes: &mut Bytes,
    model: &Condensed<R>,
    columns: usize,
    inputs: usize,
) -> Result<(), Error> {
    let zeros = |length: usize| vec![R::ZERO; length];
    let n = padded(model.contact);
    let columns = if model.certificate.is_some() { columns } else { 0 };
    let (mut x, mut residual, mut scratch, mut load) =
        (model.x.to_vec(), zeros(n), zeros(n), zeros(n));
    let (mut combination, mut sum, mut open) = (zeros(columns), zeros(columns), vec![false; n]);
    let mut blocks = model.matrix.to_vec();
    let (mut exchanged, mut column, mut next) = (vec![false; n], zeros(n), zeros(n));
    let mut spans = zeros(n);
    let mut tableau =
        Tableau::new(model.contact, &mut blocks, &mut exchanged, [&mut column, &mut next])?;
    tableau.reset(&model.start)?;
    let most = bytes.below(40) as u32;
    let sweeps = Sweeps { omega: bytes.real(), tolerance: bytes.real(), most };
    let mut pivots = Pivots { tableau, start: model.start, most, sweeps };
    for _ in 0..1 + bytes.below(4) {
        let p = bytes.reals::<R>(inputs);
        let iterate =
            Iterate { x: &mut x, residual: &mut residual, scratch: &mut scratch, open: &mut open };
        let mut memory = Memory {
            iterate,
            load: &mut load,
            spans: SpanBuffer::new(&mut spans),
            combination: &mut combination,
            sum: &mut sum,
        };
        let never = &mut Deadline::never();
        let report = match bytes.below(3) {
            0 => model.tick(&p, &mut Linear, never, &mut memory),
            1 => model.tick(&p, &mut { sweeps }, never, &mut memory),
            _ => model.tick(&p, &mut pivots, never, &mut memory),
        };
        let Ok(report) = report else { continue };
        for number in 0..6 {
            if let Ok(value) = model.output(number, &p, &memory, &report) {
                assert!(!value.wide().is_nan(), "output {number}: {value:?} {report:?}");
            }
        }
    }
    Ok(())
}

/// A scene's controller, tick after tick, with inputs of any bits; a second one is never asked for what the first
/// refuses, and a third begins anew for every ordinary tick.
pub fn controlled<R: Bits + Kept>(bytes: &mut Bytes) {
    let all = R::condensed();
    let baked = &all[bytes.below(all.len())];
    let (mut controller, mut spared) = (Controller::new(baked), Controller::new(baked));
    for _ in 0..1 + bytes.below(6) {
        let before = bits(controller.x());
        let inputs = bytes.reals::<R>(scenes::INPUTS);
        match controller.tick(&inputs) {
            Ok(answer) => {
                answered(&inputs, &answer, controller.x());
                let other = spared.tick(&inputs).expect("the same answer");
                assert_eq!(bits(&answer.0), bits(&other.0), "{inputs:?} after what was refused");
            }
            Err(_) => assert_eq!(bits(controller.x()), before, "a refused tick has moved x"),
        }
        if bytes.flag() {
            ordinary(bytes, baked, &mut controller, &mut spared);
        }
    }
}

/// Outputs, and the report beside them.
type Answer<R> = (Vec<R>, Report<R>);

fn answered<R: Bits>(inputs: &[R], (values, report): &Answer<R>, x: &[R]) {
    let [values @ .., bound] = &values[..] else { return };
    let said = || format!("{inputs:?} {values:?} {bound:?} {report:?}");
    assert!(values.iter().all(|value| value.finite()), "{}", said());
    assert!(*bound >= R::ZERO, "{}", said());
    assert!(x.iter().all(|x| *x >= R::ZERO && x.finite()), "{}", said());
    report.certificate().iter().for_each(|found| is_bound(found));
}

/// Inputs of ordinary size: what is called the solution is the one that a cold start finds, whatever came before.
fn ordinary<R: Bits>(
    bytes: &mut Bytes,
    baked: &Baked<R>,
    controller: &mut Controller<R>,
    spared: &mut Controller<R>,
) {
    let inputs: Vec<R> =
        (0..scenes::INPUTS).map(|_| R::narrow(f64::from(bytes.byte() as i8) / 16.0)).collect();
    let answer = controller.tick(&inputs).expect("an ordinary tick");
    let other = spared.tick(&inputs).expect("an ordinary tick");
    assert_eq!(bits(&answer.0), bits(&other.0), "{inputs:?}");
    answered(&inputs, &answer, controller.x());
    let work = Work { pivots: baked.work.pivots.map(|_| 100), sweeps: 10_000 };
    let generous = baked.clone().with_work(work);
    let mut cold = Controller::new(&generous);
    let (_, expected) = cold.tick(&inputs).expect("an ordinary tick");
    if [answer.1.ended, expected.ended].contains(&Ended::OutOfSweeps) {
        return;
    }
    let said = format!("{inputs:?}: {:?} after {:?}", answer.1, expected);
    check_settled(&said, controller.x(), cold.x());
}

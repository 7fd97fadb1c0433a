//! What the condensed problem costs for 8, 16, 32 and 64 contact edges, as `cost` prints it.
//!
//! Half of the edges of the model matrix are open. Of the two answers counted in whole, one changes no edge and the other two. What worst cases are made of has all
//! edges open, from the start or one after the other.
#![no_std]
#![no_main]

use core::hint::black_box;

use cortex_m_rt::entry;
use signorini_contact::dense::blocks::{self, Blocks, SIDE};
use signorini_contact::dense::ranges::Given;
use signorini_contact::dense::rule::{Largest, Phases};
use signorini_contact::dense::tableau::{InitialTableau, Tableau};
use signorini_contact::dense::{Iterate, pivoting, sor};
use signorini_contact::factor::Factor;
use signorini_firmware::journal::Bits;
use signorini_firmware::meter::{Meter, run};
use signorini_firmware::plate::fill;
use signorini_firmware::stages::cut;
use signorini_kernel::Error;

const MOST: usize = 64;
const BLOCKS: usize = blocks::count(MOST);
const COLUMNS: usize = MOST + 3;
/// Numbers in a triangle with so many columns.
const fn triangle(order: usize) -> usize {
    order * (order + 1) / 2
}

#[entry]
fn main() -> ! {
    run(|meter| {
        stages::<f32>(meter.kind("f32, n = 8"), 8)?;
        stages::<f32>(meter.kind("f32, n = 16"), 16)?;
        stages::<f32>(meter.kind("f32, n = 32"), 32)?;
        stages::<f32>(meter.kind("f32, n = 64"), 64)?;
        stages::<f64>(meter.kind("f64, n = 64"), 64)
    })
}

#[inline(never)]
fn stages<R: Bits>(meter: &mut Meter, n: usize) -> Result<(), Error> {
    let mut own = [[[R::ZERO; SIDE]; SIDE]; BLOCKS];
    let own = cut(&mut own, blocks::count(n))?;
    fill(own);
    let matrix = Blocks::new(black_box(&*own), n)?;
    let (mut x, mut load) = ([R::ZERO; MOST], [R::ZERO; MOST]);
    let (x, load) = (cut(&mut x, n)?, cut(&mut load, n)?);
    load.iter_mut().take(n / 2).for_each(|load| *load = R::ONE);
    load.iter_mut().skip(n / 2).for_each(|load| *load = -R::ONE);
    let mut residual = [R::ZERO; MOST];
    let residual = cut(&mut residual, n)?;
    let mut scratch = [R::ZERO; MOST];
    let scratch = cut(&mut scratch, n)?;
    meter.count("sweep", "n²", n * n, || {
        sor::sweep(&matrix, Given::above(load), R::ONE, x).map(|_| ())
    })?;
    let mut open = [false; MOST];
    let open = cut(&mut open, n)?;
    open.iter_mut().zip(&*x).for_each(|(open, x)| *open = *x > R::ZERO);
    meter.count("product, half of x zero", "n²", n * n, || {
        blocks::multiply_add(&matrix, black_box(&*x), open, residual)
    })?;
    let mut room = [[[R::ZERO; SIDE]; SIDE]; BLOCKS];
    let (mut exchanged, mut columns) = ([false; MOST], [[R::ZERO; MOST]; 2]);
    let [column, next] = &mut columns;
    let exchanged = cut(&mut exchanged, n)?;
    let room = cut(&mut room, blocks::count(n))?;
    let mut tableau = Tableau::new(n, room, exchanged, [cut(column, n)?, cut(next, n)?])?;
    let nothing = [false; MOST];
    let exchanged = nothing.get(..n).unwrap_or_default();
    let start = InitialTableau { blocks: matrix.blocks(), exchanged };
    tableau.reset(&start)?;
    let mut solve = |load: &[R]| {
        let iterate = Iterate {
            x: &mut *x,
            residual: &mut *residual,
            scratch: &mut *scratch,
            open: &mut *open,
        };
        pivoting::find(
            &matrix,
            Given::above(load),
            &mut tableau,
            &start,
            &mut Largest,
            |_| true,
            iterate,
        )
        .map(|_| ())
    };
    meter.count("exact, no edge changes", "n²", n * n, || solve(load))?;
    let mut other = [R::ZERO; MOST];
    let other = cut(&mut other, n)?;
    other.iter_mut().zip(load.iter()).for_each(|(other, load)| *other = *load);
    other.iter_mut().skip(n / 2).take(1).for_each(|load| *load = R::ONE);
    meter.count("exact, an edge there and back", "n²", n * n, || {
        solve(other)?;
        solve(load)
    })?;
    let mut z = [R::ZERO; MOST];
    let z = cut(&mut z, n)?;
    meter.count("answer", "n²", n * n, || tableau.answer(load, z))?;
    let mut turn = 0;
    meter.count("exchange", "n²", n * n, || {
        turn = if turn + 7 < n { turn + 7 } else { turn + 7 - n };
        tableau.exchange(turn, z).map(|_| ())
    })?;
    // Soft floats take more or less with their operands: a worst case is told of f32 alone.
    if size_of::<R>() == size_of::<f32>() {
        other.fill(R::ONE);
        all_open(meter, &matrix, other, &mut tableau, ([x, residual, z], open))?;
    }
    norm::<R>(meter, n)
}

/// Numbers and flags of an iterate.
type Arrays<'a, R> = ([&'a mut [R]; 3], &'a mut [bool]);

/// What a worst case is made of: from nothing open to all, and nothing changed then.
fn all_open<R: Bits>(
    meter: &mut Meter,
    matrix: &Blocks<R>,
    load: &[R],
    tableau: &mut Tableau<R>,
    ([x, residual, scratch], open): Arrays<R>,
) -> Result<(), Error> {
    let n = matrix.order();
    let start = InitialTableau::untouched(matrix);
    let mut solve = |tableau: &mut Tableau<R>| {
        let iterate = Iterate {
            x: &mut *x,
            residual: &mut *residual,
            scratch: &mut *scratch,
            open: &mut *open,
        };
        let rule = &mut Phases::default();
        pivoting::find(matrix, Given::above(load), tableau, &start, rule, |_| true, iterate)
            .map(|_| ())
    };
    meter.count("two phases, all edges come in", "n²", n * n, || {
        tableau.reset(&start)?;
        solve(tableau)
    })?;
    meter.count("two phases, all edges stay open", "n²", n * n, || solve(tableau))
}

/// ‖Fz‖ with half of z zero.
#[inline(never)]
fn norm<R: Bits>(meter: &mut Meter, n: usize) -> Result<(), Error> {
    let order = n + 3;
    let columns = [R::HALF; triangle(COLUMNS)];
    let columns = columns.get(..triangle(order)).unwrap_or_default();
    let norms = [R::ONE; COLUMNS];
    let factor =
        Factor { columns: black_box(columns), norms: norms.get(..order).unwrap_or_default() };
    let (mut z, mut sum) = ([R::ZERO; COLUMNS], [R::ZERO; COLUMNS]);
    let (z, sum) = (cut(&mut z, order)?, cut(&mut sum, order)?);
    z.iter_mut().take(n / 2 + 3).for_each(|z| *z = R::ONE);
    meter.count("norm of the bound, half of x zero", "n²", n * n, || {
        black_box(factor.norm(black_box(z), sum)?);
        Ok(())
    })
}

//! Ticks of a condensed model that steps in time, and what of them outlives the program.

use super::{ControllerStorage, Effort, Read, Solver};
use crate::controller::{self, Answer, Outputs, Window};
use crate::state::State;
use signorini_contact::method::Sweeps;
use signorini_contact::steps::{StepStorage, Stepped};
use signorini_kernel::limits::{Deadline, Limits};
use signorini_kernel::{Error, Real};

impl<R, Numbers, Flags, Columns, Spans, Terms, M> controller::Storage<R>
    for ControllerStorage<StepStorage<Numbers, Flags, Columns, Spans, Terms>, M>
where
    R: Real,
    Numbers: AsMut<[R]>,
    Flags: AsMut<[u8]>,
    Columns: AsMut<[R]> + AsRef<[R]>,
    Spans: AsMut<[R]>,
    Terms: AsRef<[R]> + AsMut<[R]>,
    M: Solver<R>,
{
    type Model<'m> = Stepped<'m, R>;
    type Setup<'m> = Effort<R>;

    fn reset(&mut self) {
        self.iterate.reset();
        self.solver.reset();
    }

    fn combination(&self) -> &[R] {
        self.iterate.shared().combination()
    }

    fn window(&self, stepped: &Self::Model<'_>, _: &Self::Setup<'_>) -> Option<Window<R>> {
        let [energy, seconds] = stepped.window(self.iterate.terms())?;
        Some(Window { energy, seconds })
    }

    #[inline(always)]
    fn tick<O: Outputs<R>, F: FnMut() -> u32>(
        &mut self,
        stepped: &Self::Model<'_>,
        &Effort { pivots, sweeps }: &Self::Setup<'_>,
        terms: &impl AsRef<[R]>,
        limits: Limits<R>,
        deadline: &mut Deadline<F>,
    ) -> Result<Answer<O, R>, Error> {
        let sweeps = Sweeps { most: limits.sweeps, ..sweeps };
        let system = &stepped.model;
        let mut method = self.solver.method(system, pivots, sweeps)?;
        let memory = &mut self.iterate.memory(stepped);
        let report = &stepped.tick(terms.as_ref(), &mut method, deadline, memory)?;
        let (terms, shared) = (stepped.seen(memory.terms), &memory.shared);
        let outputs = O::read(&Read { system, terms, memory: shared, report })?;
        let answer = Answer { outputs, report: *report };
        stepped.advance(memory, report);
        Ok(answer)
    }
}

impl<Numbers, Flags, Columns, Spans, Terms, M>
    ControllerStorage<StepStorage<Numbers, Flags, Columns, Spans, Terms>, M>
{
    /// Lays whether there was a tick, the terms, and what the method keeps into `to`: 0 before the first tick.
    pub fn hand_on<R: Real>(&self, to: &mut [R])
    where
        Terms: AsRef<[R]>,
        M: Solver<R>,
    {
        to.iter_mut().for_each(|to| *to = R::ZERO);
        let mut places = to.iter_mut();
        let mut put = |number: R| places.by_ref().take(1).for_each(|to| *to = number);
        if let Some(terms) = self.iterate.terms() {
            put(R::ONE);
            terms.iter().for_each(|&term| put(term));
            self.solver.save(&mut put);
        }
    }

    /// Goes on from what [`ControllerStorage::hand_on`] has laid there.
    pub fn take_over<R: Real>(&mut self, numbers: &[R])
    where
        Terms: AsMut<[R]>,
        M: Solver<R>,
    {
        let mut from = numbers.iter().copied();
        let has_begun = from.next().is_some_and(|flag| flag != R::ZERO);
        self.solver.reset();
        self.iterate.restore(has_begun.then_some(from.by_ref()));
        if has_begun {
            self.solver.restore(|| from.next().unwrap_or(R::ZERO));
        }
    }
}

impl<R, Numbers, Flags, Columns, Spans, Terms, M, const N: usize> controller::Saving<R, State<R, N>>
    for ControllerStorage<StepStorage<Numbers, Flags, Columns, Spans, Terms>, M>
where
    R: Real,
    Self: controller::Storage<R>,
    Terms: AsRef<[R]> + AsMut<[R]>,
    M: Solver<R>,
{
    fn save(&self, _: &Self::Setup<'_>, scene: u64) -> State<R, N> {
        let mut numbers = [R::ZERO; N];
        self.hand_on(&mut numbers);
        State::seal(scene, numbers)
    }

    fn restore(
        &mut self,
        _: &Self::Setup<'_>,
        state: &State<R, N>,
        scene: u64,
    ) -> Result<(), Error> {
        // Where N is that of another scene, so is its hash.
        self.take_over(state.open(scene)?);
        Ok(())
    }
}

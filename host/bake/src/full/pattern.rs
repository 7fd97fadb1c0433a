//! What a unit of an input's value adds, place by place, narrowed: nothing where that is 0.

use signorini_device::full::{
    self, AmbientShare, Contribution, EdgeTrace, Points, TransferPattern,
};

use signorini_certify::TermData;
use signorini_problem::scalar::Scalar;
use signorini_scene::scene::Field;

/// The arrays of a [`full::Pattern`], owned; those that its field does not have are empty.
#[derive(Debug, Clone)]
pub(super) struct Pattern<R> {
    pub field: Field,
    /// Whether a flux acts on contact edges.
    on_contact: bool,
    /// The integrals that it adds to; of f those of triangles, of contact edges ∫lo.
    pub integrals: Vec<Contribution<R, u32>>,
    /// ∫f of quads; ∫(hi − lo) of contact edges.
    more: Vec<Contribution<R, u32>>,
    /// ∫h u_ext of a coefficient, with the number of that part of u_ext.
    ambient: Vec<(u16, Vec<Contribution<R, u32>>)>,
    /// ψ or u_D.
    traces: Vec<EdgeTrace<R, u32>>,
    /// h or u_ext, where the law is not constant along every edge; read by the certificate alone.
    pub points: Vec<Points<R, u32>>,
}

impl<R: Scalar> Pattern<R> {
    /// Of an input's term; `neumann` are the edges with a record of their flux.
    pub fn new(field: Field, part: &TermData, neumann: &[u32], is_uniform: bool) -> Self {
        let loads = part.loads();
        let mut new = Self {
            field,
            on_contact: field == Field::Limit || loads.contact_flux.iter().any(|&q| q != 0.0),
            integrals: Vec::new(),
            more: Vec::new(),
            ambient: Vec::new(),
            traces: Vec::new(),
            points: Vec::new(),
        };
        match field {
            Field::Source => {
                (new.integrals, new.more) = (shares(&loads.triangles), shares(&loads.quads));
            }
            Field::Flux if !new.on_contact => new.integrals = shares(&fluxes(neumann, part)),
            Field::Flux | Field::Limit => {
                (new.integrals, new.more) = (shares(&loads.contact_flux), shares(&part.spans));
            }
            Field::Gap => new.traces = chords(&loads.gap, &part.ends.gap),
            Field::Value => new.traces = chords(&loads.dirichlet, &part.ends.given),
            Field::Ambient => {
                let integrals: Vec<f64> = loads.robin.iter().map(|law| law.ambient).collect();
                let edges = part.transfer.iter().map(|edge| edge.map(|[_, u]| u));
                (new.integrals, new.points) = (shares(&integrals), points(edges, is_uniform));
            }
            Field::Coefficient => {
                let Some(of) = &part.coefficient else { return new };
                let ambient = of.ambient.iter().map(|(term, all)| (*term as u16, shares(all)));
                new.integrals = shares(&of.integrals);
                new.ambient = ambient.filter(|(_, all)| !all.is_empty()).collect();
                new.points = points(of.points.iter().copied(), is_uniform);
            }
        }
        new
    }

    /// Whether it adds to the loads of contact edges.
    pub fn moves_contact_flux(&self) -> bool {
        let is_flux = matches!(self.field, Field::Flux | Field::Limit) && self.on_contact;
        is_flux && (self.more.is_empty() || !self.integrals.is_empty())
    }

    /// Every number of it.
    pub fn weights(&self) -> Vec<R> {
        let ambient = self.ambient.iter().flat_map(|(_, all)| all);
        let shares = self.integrals.iter().chain(&self.more).chain(ambient);
        let ends = |of: &EdgeTrace<R, u32>| [of.mean, of.ends[0], of.ends[1]];
        let traces = self.traces.iter().flat_map(ends);
        let points = self.points.iter().flat_map(|point| point.values);
        shares.map(|share| share.weight).chain(traces).chain(points).collect()
    }

    /// The products of a coefficient, as the kernel takes them.
    pub fn ambient(&self) -> Vec<AmbientShare<'_, R, u32>> {
        let all = self.ambient.iter();
        all.map(|(input, integrals)| AmbientShare { input: *input, integrals }).collect()
    }

    /// The whole law of a coefficient, with its own `ambient` shares.
    pub fn transfer<'a>(
        &'a self,
        ambient: &'a [AmbientShare<'a, R, u32>],
    ) -> TransferPattern<'a, R, u32> {
        TransferPattern { integrals: &self.integrals, ambient, points: &self.points }
    }

    /// As the kernel takes it, with its own `transfer`.
    pub fn view<'a>(
        &'a self,
        transfer: &'a TransferPattern<'a, R, u32>,
    ) -> full::Pattern<'a, R, u32> {
        let Self { integrals, more, traces, points, .. } = self;
        match self.field {
            Field::Source => full::Pattern::Source { triangles: integrals, quads: more },
            Field::Flux if !self.on_contact => full::Pattern::Neumann(integrals),
            Field::Flux | Field::Limit => match more.is_empty() {
                true => full::Pattern::ContactFlux(integrals),
                false => full::Pattern::ContactRange { fluxes: integrals, spans: more },
            },
            Field::Gap => full::Pattern::Gap(traces),
            Field::Value => full::Pattern::Value(traces),
            Field::Ambient => full::Pattern::Ambient { integrals, points },
            Field::Coefficient => full::Pattern::Coefficient(transfer),
        }
    }
}

/// The weights other than 0.
fn shares<R: Scalar>(weights: &[f64]) -> Vec<Contribution<R, u32>> {
    let entries = weights.iter().zip(0..).filter(|(weight, _)| **weight != 0.0);
    entries.map(|(&weight, at)| Contribution { at, weight: R::narrow(weight) }).collect()
}

/// Means and end values of edges where one is not 0.
fn chords<R: Scalar>(means: &[f64], ends: &[[f64; 2]]) -> Vec<EdgeTrace<R, u32>> {
    let edges = means.iter().zip(ends).zip(0..);
    let acts = edges.filter(|((mean, ends), _)| **mean != 0.0 || **ends != [0.0; 2]);
    acts.map(|((&mean, ends), at)| EdgeTrace {
        at,
        mean: R::narrow(mean),
        ends: ends.map(R::narrow),
    })
    .collect()
}

/// Values along edges where one is not 0, for laws that are not all constant there.
fn points<R: Scalar>(
    edges: impl Iterator<Item = [f64; 8]>,
    is_uniform: bool,
) -> Vec<Points<R, u32>> {
    let edges = edges.zip(0..).filter(|_| !is_uniform);
    let points = edges.map(|(edge, at)| Points { at, values: edge.map(R::narrow) });
    points.filter(|points| points.values.iter().any(|&x| x != R::ZERO)).collect()
}

/// The flux of a part on each of these edges.
pub(super) fn fluxes(edges: &[u32], part: &TermData) -> Vec<f64> {
    let mut fluxes = vec![0.0; edges.len()];
    for record in &part.loads().neumann {
        if let Ok(at) = edges.binary_search(&record.edge) {
            fluxes[at] += record.flux;
        }
    }
    fluxes
}

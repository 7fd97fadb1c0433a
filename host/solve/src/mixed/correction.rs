//! Correction of u as a contact problem in f32.

use signorini_kernel::flux_range::Spans;
use signorini_kernel::law::Law;
use signorini_kernel::mesh::edges::EdgeCounts;
use signorini_kernel::system::System;

use super::Refused;

/// A contact problem for the rest of u, in f32 and in the unit s.
#[derive(Debug)]
pub(super) struct Correction {
    load: Vec<f32>,
    lower: Vec<f32>,
    spans: Vec<f32>,
    /// One entry an edge, 0 on Dirichlet edges.
    v: Vec<f32>,
}

impl Correction {
    pub fn new(counts: EdgeCounts) -> Self {
        Self {
            load: vec![0.0; counts.unknowns()],
            lower: vec![0.0; counts.contact],
            spans: Vec::new(),
            v: vec![0.0; counts.edges()],
        }
    }

    /// Starts from v = 0.
    pub fn pose(&mut self, system: &System<f64, u32>, unit: f64, u: &[f64]) {
        let rows = system.matrix().iter().zip(system.load());
        for (load, (row, &b)) in self.load.iter_mut().zip(rows) {
            *load = ((b - row.dot(u)) / unit) as f32;
        }
        let on_contact = u.iter().skip(system.counts().free);
        for (lower, (law, &own)) in self.lower.iter_mut().zip(system.law().edges().zip(on_contact))
        {
            *lower = ((law.gap() - own) / unit) as f32;
        }
        self.pose_spans(system, unit, u);
        self.v.fill(0.0);
    }

    /// Where u is off its gap and the flux at an end, f32 would not see what is left beside that: there the end itself is in the
    /// load, and v stays on this side. What that holds back is what the next correction begins with.
    fn pose_spans(&mut self, system: &System<f64, u32>, unit: f64, u: &[f64]) {
        let (law, free) = (system.law(), system.counts().free);
        let spans = law.spans().lengths().iter();
        self.spans.clear();
        self.spans.extend(spans.map(|&span| (span / unit) as f32));
        let rows = system.matrix().iter().zip(system.load()).skip(free);
        let edges = rows.zip(law.edges()).zip(u.iter().skip(free)).enumerate();
        for (at, (((row, &b), law), &own)) in edges {
            if !law.touches(own) && self.spans.get(at).is_some_and(|span| span.is_finite()) {
                self.load[free + at] = ((b + law.missing(own) - row.dot(u)) / unit) as f32;
                self.spans[at] = f32::INFINITY.copysign(law.opening(own) as f32);
            }
        }
    }

    /// The problem that the kernel solves with the matrix of `narrow`, and v.
    pub fn posed<'c>(
        &'c mut self,
        narrow: &System<'c, f32, u32>,
    ) -> Refused<(System<'c, f32, u32>, &'c mut [f32])> {
        let Self { load, lower, spans, v } = self;
        let law = Law::above(lower).with_spans(Spans::new(spans)?);
        Ok((narrow.with_data(load, law)?, v))
    }

    /// Adds it to u.
    pub fn add_to(&self, system: &System<f64, u32>, unit: f64, u: &mut [f64]) {
        for (u, &v) in u.iter_mut().zip(&self.v) {
            *u += unit * f64::from(v);
        }
        let free = system.counts().free;
        let bounds = self.v.iter().skip(free).zip(&self.lower).zip(system.law().edges());
        for (u, ((v, lower), law)) in u.iter_mut().skip(free).zip(bounds) {
            if v == lower || !law.admits(*u) {
                *u = law.gap();
            }
        }
    }
}

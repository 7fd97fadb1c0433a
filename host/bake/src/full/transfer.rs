//! An input's pattern of a transfer coefficient, owned and narrowed: see [`TransferPattern`].

use signorini_device::full::{AmbientShare, Contribution, Points, TransferPattern};

use super::shares::shares;
use signorini_problem::scalar::Scalar;

/// The arrays of a [`TransferPattern`].
#[derive(Debug, Clone, Default)]
pub(super) struct Transfer<R> {
    pub integrals: Vec<Contribution<R, u32>>,
    pub ambient: Vec<(u16, Vec<Contribution<R, u32>>)>,
    pub points: Vec<Points<R, u32>>,
}

impl<R: Scalar> Transfer<R> {
    /// Points are for laws that are not constant along every edge.
    pub fn new(of: &signorini_problem::TransferPattern, is_uniform: bool) -> Self {
        let products = of.ambient.iter().map(|(term, all)| (*term as u16, shares(all)));
        let edges = of.points.iter().zip(0..).filter(|_| !is_uniform);
        let points = edges.map(|(edge, at)| Points { at, values: edge.map(R::narrow) });
        let acts = |points: &Points<R, u32>| points.values.iter().any(|&h| h != R::ZERO);
        Self {
            integrals: shares(&of.integrals),
            ambient: products.filter(|(_, all)| !all.is_empty()).collect(),
            points: points.filter(acts).collect(),
        }
    }

    /// Every number of it.
    pub fn weights(&self) -> Vec<R> {
        let ambient = self.ambient.iter().flat_map(|(_, all)| all);
        let integrals = self.integrals.iter().chain(ambient).map(|share| share.weight);
        integrals.chain(self.points.iter().flat_map(|point| point.values)).collect()
    }

    /// The products, as the kernel takes them.
    pub fn shares(&self) -> Vec<AmbientShare<'_, R, u32>> {
        let all = self.ambient.iter();
        all.map(|(input, integrals)| AmbientShare { input: *input, integrals }).collect()
    }

    /// The whole law, with its own `ambient` shares.
    pub fn view<'a>(
        &'a self,
        ambient: &'a [AmbientShare<'a, R, u32>],
    ) -> TransferPattern<'a, R, u32> {
        TransferPattern { integrals: &self.integrals, ambient, points: &self.points }
    }
}

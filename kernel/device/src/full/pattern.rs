//! What one input adds to the data for each unit of its value, and the memory that it is added in.

use signorini_bound::certificate::Curved;
use signorini_kernel::mesh::boundary::{Neumann, Robin};
use signorini_kernel::{Index, Real, features};

/// An integral or mean at one place of an array.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contribution<R, I> {
    /// The place.
    pub at: I,
    /// What one unit of the input adds there.
    pub weight: R,
}

/// What one unit of an input adds to ψ or u_D on an edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EdgeTrace<R, I> {
    /// The place of the edge in its block.
    pub at: I,
    /// To the mean.
    pub mean: R,
    /// To the values at the two ends.
    pub ends: [R; 2],
}

/// What one unit of an input adds to u_ext, or to ∫h, at the 8 Gauss points of an edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Points<R, I> {
    /// The place of the transfer law.
    pub at: I,
    /// The additions.
    pub values: [R; 8],
}

/// What one unit of an input adds to h and, with it, to ∫h u_ext.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TransferPattern<'a, R, I> {
    /// ∫π, by number of the transfer law.
    pub integrals: &'a [Contribution<R, I>],
    /// ∫π u_ext, in parts.
    pub ambient: &'a [AmbientShare<'a, R, I>],
    /// |E|π at points, where h and u_ext are not constant along every edge.
    pub points: &'a [Points<R, I>],
}

/// The part of ∫π u_ext that the base, or one unit of an input, makes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AmbientShare<'a, R, I> {
    /// 0 for the base, else 1 more than the number of the input.
    pub input: u16,
    /// ∫π u₀ or ∫π w, by number of the transfer law.
    pub integrals: &'a [Contribution<R, I>],
}

/// A pattern by the field that it acts on: nothing elsewhere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Pattern<'a, R, I> {
    /// ∫f of triangles and of quads.
    Source {
        /// By number of the triangle.
        triangles: &'a [Contribution<R, I>],
        /// By number of the quad.
        quads: &'a [Contribution<R, I>],
    },
    /// ∫g, by number of the record.
    Neumann(&'a [Contribution<R, I>]),
    /// ∫q, by number of the contact edge.
    ContactFlux(&'a [Contribution<R, I>]),
    /// An end of a range of fluxes whose both ends are finite, by number of the contact edge.
    ContactRange {
        /// ∫lo
        fluxes: &'a [Contribution<R, I>],
        /// ∫(hi − lo)
        spans: &'a [Contribution<R, I>],
    },
    /// ψ
    Gap(&'a [EdgeTrace<R, I>]),
    /// u_D
    Value(&'a [EdgeTrace<R, I>]),
    /// u_ext
    Ambient {
        /// ∫h u_ext, by number of the transfer law.
        integrals: &'a [Contribution<R, I>],
        /// At points, where that is not constant along every edge.
        points: &'a [Points<R, I>],
    },
    /// h
    Coefficient(&'a TransferPattern<'a, R, I>),
}

/// Memory for the data: each array is as long as its base where an input changes it, and else empty.
#[derive(Debug, Default)]
#[allow(missing_docs)]
pub struct DataMemory<'a, R, I> {
    pub triangles: &'a mut [R],
    pub quads: &'a mut [R],
    pub neumann: &'a mut [Neumann<R, I>],
    pub robin: &'a mut [Robin<R, I>],
    pub contact_flux: &'a mut [R],
    pub gap: &'a mut [R],
    pub gap_ends: &'a mut [[R; 2]],
    pub dirichlet: &'a mut [R],
    pub dirichlet_ends: &'a mut [[R; 2]],
    pub curved: &'a mut [Curved<R, I>],
    pub transfer: &'a mut [[[R; 2]; 8]],
    pub spans: &'a mut [R],
}

impl<R: Real, I: Index> Pattern<'_, R, I> {
    /// Adds `p` times the pattern.
    pub(super) fn add(&self, p: R, data: &mut DataMemory<R, I>) {
        match *self {
            Self::Source { triangles, quads } => {
                add(triangles, p, data.triangles);
                if features::QUADS {
                    add(quads, p, data.quads);
                }
            }
            Self::Neumann(shares) => each(shares, |at, weight| {
                if let Some(record) = data.neumann.get_mut(at) {
                    record.flux += p * weight;
                }
            }),
            Self::ContactFlux(shares) if features::CONTACT => add(shares, p, data.contact_flux),
            Self::ContactRange { fluxes, spans } if features::LIMITED => {
                add(fluxes, p, data.contact_flux);
                add(spans, p, data.spans);
            }
            Self::Gap(chords) if features::CONTACT => {
                add_chords(chords, p, data.gap, data.gap_ends);
            }
            Self::Value(chords) => add_chords(chords, p, data.dirichlet, data.dirichlet_ends),
            Self::Ambient { integrals, points } if features::ROBIN => {
                each(integrals, |at, weight| {
                    if let Some(law) = data.robin.get_mut(at) {
                        law.ambient += p * weight;
                    }
                });
                for Points { at, values } in points {
                    let Some(edge) = data.transfer.get_mut(at.at()) else { break };
                    edge.iter_mut().zip(values).for_each(|(point, &add)| point[1] += p * add);
                }
            }
            // Coefficients need all inputs at once: see `super::transfer`.
            Self::ContactFlux(_)
            | Self::ContactRange { .. }
            | Self::Gap(_)
            | Self::Ambient { .. }
            | Self::Coefficient(_) => {}
        }
    }
}

pub(super) fn each<R: Real, I: Index>(
    shares: &[Contribution<R, I>],
    mut each: impl FnMut(usize, R),
) {
    shares.iter().for_each(|share| each(share.at.at(), share.weight));
}

fn add<R: Real, I: Index>(shares: &[Contribution<R, I>], p: R, sums: &mut [R]) {
    each(shares, |at, weight| {
        if let Some(sum) = sums.get_mut(at) {
            *sum += p * weight;
        }
    });
}

fn add_chords<R: Real, I: Index>(
    chords: &[EdgeTrace<R, I>],
    p: R,
    means: &mut [R],
    ends: &mut [[R; 2]],
) {
    for EdgeTrace { at, mean, ends: [first, second] } in chords {
        let (Some(of_mean), Some(pair)) = (means.get_mut(at.at()), ends.get_mut(at.at())) else {
            break;
        };
        *of_mean += p * *mean;
        pair[0] += p * *first;
        pair[1] += p * *second;
    }
}

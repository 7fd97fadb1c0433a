//! What fading modes leave, lag by lag, split by sign.
//!
//! With 1 > ρ_1 ≥ ρ_2 ≥ … ≥ 0, lag i = 0, 1, … has a_i = Σ_j c_j ρ_j^i. The first lags are added up one by one. Of those from L on the
//! partial sums s_k = Σ_{j≤k} c_j ρ_j^L tell the sign, since by parts
//! ```text
//!   a_{L+i} = Σ_k s_k (ρ_k^i − ρ_{k+1}^i)          every factor ≥ 0:    a_{L+i} ≥ min(0, min s_k) ρ_1^i
//! ```
//! So once no partial sum is negative, no later lag is.

/// Lags that are added up one by one, at most.
const MOST: u32 = 1 << 14;

/// Part of Σ_j |c_j|/(1 − ρ_j) that no longer matters.
const NEGLIGIBLE: f64 = 1e-12;

/// At least Σ_i max(−a_i, 0), rounding counted; `fading` is ρ, which falls.
pub fn backward(weights: &[f64], fading: &[f64]) -> f64 {
    let whole: f64 = weights.iter().zip(fading).map(|(c, rho)| c.abs() / (1.0 - rho)).sum();
    let mut left = weights.to_vec();
    let (mut sum, mut lag) = (0.0, 0);
    loop {
        sum += forgotten(&mut left, fading, 1e-2 * NEGLIGIBLE * whole);
        let tail = Tail::new(&left, &fading[..left.len()]);
        if tail.off <= NEGLIGIBLE * whole || lag >= MOST {
            return (sum + tail.most) * (1.0 + 1e-12);
        }
        let block = (lag / 2).max(4);
        for step in 0..block {
            sum += (noise(&left, step) - left.iter().sum::<f64>()).max(0.0);
            left.iter_mut().zip(fading).for_each(|(c, rho)| *c *= rho);
        }
        lag += block;
        let power = |(c, rho): (&f64, &f64)| c * rho.powf(f64::from(lag));
        left = weights.iter().zip(fading).take(left.len()).map(power).collect();
    }
}

/// Takes the fastest modes away as long as all that they may still add up to is `most`, and returns that.
fn forgotten(left: &mut Vec<f64>, fading: &[f64], most: f64) -> f64 {
    let mut lost = 0.0;
    while let Some(c) = left.last() {
        let more = lost + c.abs() / (1.0 - fading[left.len() - 1]);
        if more > most {
            break;
        }
        lost = more;
        left.pop();
    }
    lost
}

/// By how much rounding may put a sum of these off, each of which was multiplied so many times.
fn noise(terms: &[f64], multiplied: u32) -> f64 {
    let roundings = terms.len() as f64 + f64::from(multiplied) + 8.0;
    roundings * f64::EPSILON * terms.iter().map(|c| c.abs()).sum::<f64>()
}

/// Lags from some L on.
struct Tail {
    /// At least Σ max(−a_i, 0).
    most: f64,
    /// By how much more than it that may be.
    off: f64,
}

impl Tail {
    /// Of terms c_j ρ_j^L.
    fn new(terms: &[f64], fading: &[f64]) -> Self {
        let Some(slowest) = fading.first() else { return Self { most: 0.0, off: 0.0 } };
        let (mut partial, mut ends) = (0.0_f64, [0.0_f64; 2]);
        for c in terms {
            partial += c;
            ends = [ends[0].min(partial), ends[1].max(partial)];
        }
        let [below, above] =
            [-ends[0], ends[1]].map(|end| (end + noise(terms, 0)) / (1.0 - slowest));
        let sums = || terms.iter().zip(fading).map(|(c, rho)| c / (1.0 - rho));
        let negative: f64 = sums().map(|sum| (-sum).max(0.0)).sum();
        let size: f64 = sums().map(f64::abs).sum();
        // −a_i + max(a_i, 0), where all but nothing is positive.
        let all = above - sums().sum::<f64>() + 1e-12 * size;
        let most = below.min(negative).min(all).max(0.0);
        Self { most, off: below.min(negative).min(above) }
    }
}

//! Comparisons of the crate `tests`: twins, exact solutions, bounds.

table! {
    FLUX_CONTINUITY: "normal flux from both sides of an edge, over the terms it is the sum of", 2e-14,
        "measured in f64 on 64 × 128 cells, the rounding of the solve";
    CONSERVATION: "sum of an element's fluxes plus its source, over the terms they are sums of", 7e-15,
        "holds for any u, so only the rounding of one element enters";
    STORED: "fluxes out of a cell in a step of time less what it stores, over what it stores or 1", 1e-12,
        "means of the fluxes from both sides of an edge: as good as the solve";
    BOUNDARY_FLUX: "mean flux on Neumann and Robin edges, over the terms it is the sum of", 1e-14,
        "measured in f64 on 64 × 128 cells";
    CONTACT_SIGN: "violation of u ≥ ψ, σ·n ≥ q or of their product, over the largest values", 1e-12,
        "active edges are exact, open ones are as good as the solve";
    CLOSED_FORM: "recovered flux against Marini's formula, over the terms it is the sum of", 1e-14,
        "an identity of exact arithmetic; rounding grows with the condition of A";
    PATCH: "patch solution, over its largest value", 1e-12,
        "the solution lies in the space: only the rounding of the solve is left";
    CATALOGUE: "error norm or force against the target table, relative", 5e-4,
        "0.05 %: the targets have six digits, two quadratures of the errors differ by less";
    TOTAL_FORCE: "contact force against the target table, relative", 2e-6,
        "the table has six digits and the forces do not depend on the quadrature of errors";
    RATE: "observed order of an error over n = 8 … 64, relative to the theory's", 0.05,
        "the free points of H move against the grid, which makes l2 scatter";
    KERNEL_AGREEMENT: "edge means of kernel and twin, over the largest one", 1e-9,
        "the kernel stops when it takes the error for 1e−10";
    KERNEL_FLUX: "edge fluxes of kernel and twin, over the largest one", 1e-8,
        "differences of u times entries of K, which are large on distorted cells";
    NARROW_AGREEMENT: "edge means in f32 against the twin, over the largest one", 1e-3,
        "coordinates and tensors are rounded to f32, and jumps of 10⁴ from cell to cell amplify that: \
         4.7e-4 at worst over 1500 seeds, 4.6e-4 with another formula for areas";
    TRAPEZOID_RATE: "observed order of an error on trapezoids against its limit", 0.1,
        "orders between n = 16 and 32 are still on their way to the limit";
    GUARANTEE: "how far the error is above its bound, relative, kinked or singular", 2e-6 worst 4.9e-7,
        "quadrature of the norms at points where the gradient is singular: 4.9e-7 at worst over 2500 \
         seeds, where no contact term and no oscillation lie between bound and error";
    GUARANTEE_SMOOTH: "how far the error is above its bound, relative, smooth in each cell", 2e-14,
        "the norms are exact but for rounding";
    IDENTITY: "bound without oscillation against the identity, relative, kinked or singular", 5e-4,
        "quadrature of the norms where contact ends within a cell: 2.4e-4 at worst over 2500 seeds, in \
         f32 as in f64";
    IDENTITY_SMOOTH: "bound without oscillation against the identity, relative, smooth", 2e-5,
        "in triangles the gradient of an extension has no limit at the opposite vertex, where the 16×16 \
         points of the norms lose digits: 1.1e-5 at worst over 2500 seeds, 15 times less with 32×32";
    LIFTED: "what the bound for u_h has above that for s, beside the norm of s − u_h, relative", 2e-4,
        "for lifts in triangles, whose gradient has no limit at the opposite vertex, the norm's 16×16 points lose \
         digits: 5.1e-5 at worst over 100 seeds; else rounding";
    BOUND_ROUNDING: "what rounding adds to the bound in f64, over the bound", 1e-9,
        "the condition of the matrix times 1e−15: 2.8e-10 at worst, for a jump of 9·10³";
    BOUND_ROUNDING_NARROW: "what rounding adds to the bound in f32, over the bound", 0.1 worst 0.038,
        "3.8 % at worst, for a jump of 2·10³; without jumps 1e-4";
    SHARPNESS: "bound without oscillation over the error of s and τ, minus 1, at convergence", 0.02,
        "what the contact terms are at n = 16: 0.7 % for H on quads, less elsewhere";
    EDGE_MEAN: "edge mean of u in contact against that of a quadratic gap, absolute", 1e-14,
        "8 Gauss points are exact: only rounding is left";
    ORDER: "bound of the same mesh with its cells in another order, relative", 2e-11,
        "other roundings and, among equal ways out, other choices for a residual of 1e−13";
    CONDENSED: "output of the condensed model in f64 against the full one, over its terms", 3e-11 worst 3e-12,
        "two exact solves of one problem: 3e-12 at worst over 600 seeds";
    CONDENSED_NARROW: "output of the condensed model in f32 against the full one, over its terms", 1e-4 worst 4.2e-5,
        "what rounding S to f32 costs: 1e-5 at worst over 600 seeds where λ_min(S) is above 1e-3";
    REDUCED_OPENINGS: "openings without edges that never change sides against those with all, over loads and openings", 5e-13 worst 2.2e-14,
        "two exact solves of one problem";
    REDUCED_OUTPUTS: "outputs without edges that never change sides against those with all, over their terms", 1e-12 worst 3.9e-14,
        "two exact solves of one problem";
    REDUCED_BOUND: "the bound without edges that never change sides below that with all, or needlessly above, over its terms", 2e-13 worst 6.5e-15,
        "the same form in fewer variables: the rounding of its triangular factor";
    REDUCED_TICK: "outputs of a controller without edges that never change sides in f64, over their terms", 1e-12 worst 4.1e-14,
        "4√n ε, times the condition of their matrices";
    REDUCED_TICK_NARROW: "outputs of a controller without edges that never change sides in f32, over their terms", 2e-5,
        "what rounding S to f32 costs";
    REDUCED_VALUES: "outputs of a controller without edges that never change sides in f64, over their largest value", 1e-13,
        "on standard scenes, whose outputs are sums of few large terms";
    REDUCED_VALUES_NARROW: "outputs of a controller without edges that never change sides in f32, over their largest value", 5e-5,
        "on standard scenes, whose outputs are sums of few large terms";
    FORCE_OF_EDGES: "force against the law of contact on the table of edges in f64, over its terms", 1e-14,
        "both sum the same fluxes: only the rounding of sums of a hundred terms enters";
    FORCE_OF_EDGES_NARROW: "force against the law of contact on the table of edges in f32, over its terms", 5e-6,
        "ε = 1.2e-7 for each of at most a hundred terms, not all of one sign, and q rounded once";
    AFTER_EXTREMES: "answer after extreme ticks against one from a cold start, over its size, in ε of f64", 5e-13,
        "two solves down to 4√n ε, times the condition of their matrices";
    UNITS: "bound over error in f32, in other units, relative", 1e-6,
        "some roundings of data that are no longer powers of two apart";
    AGAIN: "outputs of a tick that is repeated, over its inputs, in ε as of f64", 7.2e-15,
        "32 ε: the same exchanges, in another order";
    SUM_OF_LENGTHS: "length of contact, over all lengths, in ε as of f64", 1.8e-15,
        "8 ε: a sum of a dozen lengths";
    OSCILLATING: "what rounding adds to a bound that oscillation dominates, in f32, over the bound", 1e-4,
        "rounding of the small terms alone";
    SLENDER: "entries of an element matrix on slender cells, over the largest and the slenderness", 5e-14,
        "corners rounded to f64";
    LEFT_OPEN: "what a solver leaves of λ on open edges, over the fluxes", 2e-9,
        "the kernel stops when it takes the error for 1e−10";
    FORCE_OF_CONDENSED: "force of a condensed tick against the law, over what rounding may do", 0.1,
        "rounding is counted term by term";
    ONE_SWEEP: "one sweep against a naive one, over the largest u, in ε as of f64", 2e-14,
        "sums of at most 7 terms on matrices with large jumps";
    ALGEBRAIC: "algebraic part of the bound at convergence, over the bound", 1e-6,
        "sweeps end far below it";
    SAME_ON_SQUARES: "u of both elements on squares", 1e-14,
        "the same matrix, but for rounding";
    OWN_SOLVE: "the twins' own solver against a known solution", 1e-14,
        "a diagonally dominant matrix";
    OWN_RULES: "the twins' own quadrature against integrals on paper", 1e-14,
        "sums of at most 20 terms";
}

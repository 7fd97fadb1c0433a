//! Comparisons in the tests of `host/solve`.

table! {
    RANGE_TERMS: "ends of ranges as sums over inputs", 1e-14,
        "means of the same rule, added up";
    FOUND: "reference coordinates of a point that was put there", 2e-14,
        "Newton's method ends within rounding";
    CONDENSED: "condensed outputs, openings and forces against a full solve, over the largest", 2e-12,
        "two exact solves of one problem, each as good as its condition";
    STEPPED: "u and fluxes of condensed steps against full ones, over the largest", 1e-11,
        "exact solves of one problem whose modes span many decades";
    SETTLED: "steps without the edges that keep their side against steps with all, sizes near 1", 2e-14,
        "exact solves of one problem in two orders";
    SETTLED_FLUX: "what flows through edges that are always open besides q, sizes near 1", 1e-15,
        "an elimination, and the fluxes that mend it";
    STEP_FORM: "the form of a condensed step against integrals on its mesh, relative", 1e-11,
        "columns that cancel at short steps";
    STEPPED_START: "a steady state in condensed steps, over the largest", 2e-14,
        "two exact solves of one problem, and the steps' own";
    LAGS: "sums over all lags against many of them, and rows of memories, over sizes near 1", 1e-10,
        "modes whose loads cancel, and tails that are counted twice at most";
    LASTING_KNOWN: "boxes for all times, known on paper", 1e-6,
        "ranges are widened by what f32 rounds";
    KNOWN: "solutions and forces of springs, known on paper", 1e-14,
        "a factorisation of at most 100 springs";
    PRESSED: "forces of springs whose stiffness spans many decades", 1e-14,
        "differences of neighbours times the stiffest of springs";
    ENUMERATED: "solution against all contact sets enumerated, over its size", 5e-13,
        "random matrices of at most 12 unknowns, some of condition 10⁶";
    SHARED_SOLVER: "intervals by multigrid against those by the factor, over their half-widths", 1e-6,
        "weights whose equations are solved to 1e-13";
    SCHUR: "entries of S against elimination by hand", 2e-14,
        "a matrix of condition 10⁴";
    OPTIMAL: "equations and complementarity, over the largest displacement", 1e-14,
        "rows of at most 5 entries, after refinement";
    WARM: "change of a solution by a warm start, over the largest displacement", 1e-15,
        "refinement ends at ε";
    BISECTED: "integral of a jump by bisection", 1e-5,
        "panels of 2⁻¹⁷ around it";
    BISECTED_KINK: "integral of a kink by bisection", 1e-9,
        "two levels agree to 1e-9";
    ENCLOSED: "what is missed of integrals over cells and edges, of sizes near 1", 3e-12,
        "1e-13 of ∫|f| in each of some parts, and rounding";
    ENCLOSED_LINE: "what is missed of a jump along a circle", 1e-4,
        "the number of parts is limited";
    GUARANTEE: "how far the distance is above the bound, relative", 1e-14,
        "none is seen above it: rounding alone";
    POINTS: "Robin data at the points of an edge", 1e-14,
        "sums of 8 points";
    NARROW_BUMP: "what 8 points miss of a bump or layer, relative", 2e-3,
        "an estimate by panels, asked for two digits";
    PARABOLIC: "mean, energy and coupling of a parabola over its chord", 1e-14,
        "polynomials: exact rules";
    CURVED_KINK: "a kink inside an edge, relative", 1e-9,
        "panels around the kink";
    LAYER: "energy of a layer inside an edge over that without w, relative", 1e-4,
        "panels around the layer";
    NOISE: "energy of a deviation of 1e-7 beneath terms of 1, relative", 1e-9,
        "1e-16 of 1 in a difference of 1e-7, times the panels";
    CURVED_ENERGY: "energy of lifts against a fine rule, relative", 2e-4,
        "the fine rule has 300 panels a direction";
    DIFFERENCES: "couplings and energies of lifts against differences of values", 2e-10,
        "steps of 1e-5";
    DIFFERENCES_COLLAPSED: "couplings and energies of lifts against differences, on triangles", 2e-5,
        "the twin's rule collapses at a vertex that is not the apex";
    STEEP: "the place of infinite slope that is named", 5e-8,
        "bisection of the edge";
    IDENTITY: "bound of any iterate without oscillation against the identity, relative, smooth", 1e-5,
        "quadrature of lifts in triangles";
    IDENTITY_SINGULAR: "bound without oscillation against the identity, relative, singular", 1e-3,
        "quadrature of the norms where contact ends within a cell";
    ENDS: "values at the ends of an edge", 1e-15,
        "one evaluation of the same expression";
    OUTPUT_WEIGHTS: "weights of outputs of a bar against resistances on paper, relative", 5e-15,
        "linear functions on few cells";
    OSCILLATION: "oscillation of a cell against integrals on paper", 1e-14,
        "exact rules for polynomials";
    LOCAL_FLUX: "fluxes inside a cell against their definition", 1e-12,
        "sums of 64 polynomials of degree 8, whose values are below 100";
    MULTIGRID_NARROW: "u and fluxes of multigrid in f32 against those of the kernel's factor, over their range", 9e-5,
        "two roundings of one solution";
    MULTIGRID: "u by multigrid against the direct solver, over the largest", 1e-10,
        "a residual of 1e-13, times what the condition makes of it; 1e-9 is promised";
    MULTIGRID_RELAXED: "u by multigrid against projected relaxation, u of size 1", 2e-13,
        "sweeps end at changes of 1e-15, with rates near 1";
    MULTIGRID_MATRIX: "entries of coarse matrices and prolongations against dense arithmetic, of size 10", 1e-14,
        "sums of at most 100 products";
    IN_SINGLE: "products and corrections in f32 of numbers of size 1", 2e-5,
        "roundings of 6e-8 in some sweeps";
    AGREEMENT: "u of mixed precision and of the factor against other solvers, over the largest", 1e-10,
        "as good as the solves, of condition up to 10⁵";
    FACTOR_NARROW: "u of the factor in f32 against f64, over the largest", 2e-6,
        "data rounded to f32, times what the condition makes of it";
    BOUND_OF_FACTOR: "how far the factor's bound is above the kernel's, relative", 7e-11,
        "the kernel stops where sweeps change little";
    BOUND_OF_FACTOR_NARROW: "how far the factor's bound is above the kernel's on large meshes, relative", 1e-12,
        "the kernel stops where sweeps change little";
    HARD: "u by the factor where sweeps do not end, over the largest", 7e-9,
        "a matrix of condition 10⁸";
    HARD_BOUND: "the bound there, relative", 6e-9,
        "a matrix of condition 10⁸";
    RULE: "Gauss rules on edges and cells", 1e-14,
        "sums of at most 20 weights";
    CATALOGUE: "errors on other meshes against the catalogue, relative", 5e-4,
        "quadrature of the norms";
    MODES: "matrix and loads by modes against a fresh condensation, over the largest", 5e-14,
        "rounding times the condition of the mesh";
    IDENTITY_OF_MODES: "the residual in the bound of a model of modes against the identity, relative", 2e-5,
        "quadrature of lifts in triangles";
    MODES_OUTPUTS: "outputs of a model of modes against the direct solver, over the largest flux", 1e-13,
        "rounding times the condition of the mesh";
    CARRIED: "an affine u carried to a finer mesh, its mean over an edge", 2e-12,
        "a residual of 1e-13 of the range of u, 6, times the condition of a small mesh";
    ZERO: "figures with a constant added to every datum of u, relative", 1e-9,
        "the constant is a thousand ranges, of which rounding is 1e-13, times the condition of a small mesh";
    ZERO_SWEPT: "figures of ticks with a constant added to every datum of u, relative", 1e-7,
        "sweeps end at a share of the bound, one of them earlier or later";
    ZERO_NARROW: "figures in f32 with a constant of twenty ranges added to every datum of u, relative", 1e-3,
        "the data are narrowed with another zero: 6e-8, times the condition of a small mesh";
    TRANSFER: "a wall with a transfer coefficient that an input sets, against its resistances in series", 3e-12,
        "u is affine, and exact in the elements: sweeps end at 4√n ε = 1e-14 of its size 2, times the condition of a small mesh, 100";
    DUVAUT: "a wall above a heater with a limit, against its closed form", 1e-11,
        "u is affine, and exact in the elements";
    LIMITED: "contact with a limit by sweeps against the reference, relative to the range of u", 1e-10,
        "sweeps end at a scaled residual of 1e-13";
    LIMITED_RANDOM: "random contact with a limit by sweeps and by the factor against the reference, relative to the range of u", 1e-10,
        "sweeps end at a scaled residual of 1e-13, times the condition of what is weakly held";
    LIMITED_NARROW: "the same by the factor in f32", 5e-6,
        "data are rounded to 1e-7, times the same";
    THREE_SIDES: "pivoting with three sides against the reference, relative to the largest x or 1", 5e-14,
        "rounding times the condition of matrices that are dominated by 1e-3 of their diagonal";
    GUARANTEE_LIMITED: "how far an error is above the bound of condensed contact with limits, relative", 1e-14,
        "none is: rounding alone";
    IDENTITY_LIMITED: "bound of condensed contact with limits against the identity, relative, singular", 1e-3,
        "quadrature of the norms where contact ends within a cell";
    SAME_LIMITED: "condensed contact with limits against another statement of it", 1e-14,
        "two exact solves of one problem";
    REDUCED_LIMITED: "openings and outputs with limits without edges that never change sides against those with all", 1e-13,
        "two exact solves of one problem";
    REDUCED_LIMITED_BOUND: "how far the bound of such a model is below that with all edges, relative", 1e-13,
        "rounding of the elimination";
    REACHED_INTERVAL: "ends of a proved interval beyond what corners reach, over its width", 1e-6,
        "ranges are widened by ε of f32";
    ENDED_STEPS: "u of steps that end by a tolerance against the direct solver, over its range and the tolerance", 20.0,
        "the residual is by K_ii, and errors add up over some steps";
}

//! Comparisons in the tests of `host/bake`.

table! {
    TICK: "outputs and gap of a full controller against the solver, over the largest fluxes", 2e-9,
        "sweeps end at 1e-9 of the bound";
    TICK_NARROW: "outputs and gap of a full controller in f32, over the largest fluxes", 1e-4,
        "ε = 1.2e-7 times the condition";
    OSCILLATION: "how far the solver's oscillation is above that of a sum, relative", 1e-9,
        "the triangle inequality, but for what is proved between points: each sum has ellipses of its own";
    SWEPT: "u of ticks without a bound against 4000 sweeps", 3e-14,
        "all that rounding allows";
    SWEPT_NARROW: "u in f32 with another square root", 1e-4,
        "a tick ends at 1e-4 of the bound";
    FACTORED: "u of a factored controller against the direct solver, over the largest", 5e-15,
        "a contrast of a million";
    FACTORED_NARROW: "u of a factored controller in f32, over the largest", 5e-7,
        "a contrast of a million";
    FACTORED_OBLIQUE: "u of a factored controller for an anisotropy of 10⁸, over the largest", 7e-9,
        "a matrix of that condition";
    FACTORED_GAP: "gap of a factored controller against the direct solver's, relative", 1e-3,
        "f32";
    WITHOUT_UNITS: "gap of a controller in f32 without units, in numbers near 2⁻⁴⁰, relative", 1e-4,
        "ε = 1.2e-7 in sums of squares";
    COSTS: "counted costs against curves through them, relative", 5e-15,
        "curves of as many coefficients as counts";
    LENGTH: "length of contact, condensed and full", 1e-14,
        "f32 in the condensed one";
    MEANS: "mean of an affine u over a boundary in f64", 1e-11,
        "the elements are exact for it: sweeps leave 1e-14 of its size 4, times the condition of a small mesh, 100";
    MEANS_NARROW: "mean of an affine u over a boundary in f32", 2e-5,
        "sweeps end at 4√n ε = 3e-6 of its size there";
    TRANSFER: "heat through a wall and its bound in ticks with another coefficient, against resistances", 1e-11,
        "u is affine: sweeps end in rounding, times a condition of 100";
    TRANSFER_NARROW: "heat through such a wall and its bound in f32", 2e-3,
        "ε = 1.2e-7 times u = 1 and a condition of 100";
    LIMITED_TICK: "outputs of ticks with limits against the direct solver, relative", 5e-9,
        "ticks end at a share of 1e-9 of the bound";
    LIMITED_TICK_NARROW: "the same in f32", 1e-3,
        "rounding, and lengths that change by an edge where one is next to its limit";
    LIMITED_BOUND: "bounds of condensed ticks with limits against those of the same answers, relative", 1e-13,
        "the rounding part is in the first alone";
    LIMITED_BOUND_NARROW: "bounds of condensed ticks with limits in f32 against those of the same answers, relative", 1e-4,
        "rounding of the forms and of the residuals";
    LIMITED_INPUT_TICK: "outputs of ticks with inputs of a limit against the direct solver, relative", 1e-8,
        "ticks end at a share of 1e-9 of the bound";
    LIMITED_INPUT_TICK_NARROW: "the same of a limit's inputs in f32", 1e-4,
        "rounding, and lengths that change by an edge where one is next to its limit";
    LIMITED_DESK: "outputs of ticks on the desk against the direct solver, relative", 2e-2,
        "such a tick ends where a tenth of its error bound is left to sweeps";
    TRANSFER_TICK: "outputs of ticks with other coefficients against the direct solver, over the largest flux", 1e-8,
        "sweeps end at 1e-9 of the bound";
    TRANSFER_TICK_NARROW: "outputs of such ticks in f32, over the largest flux", 1e-3,
        "ε = 1.2e-7 times the condition";
    TRANSFER_WARM: "outputs of warm solves with other coefficients against the direct solver", 1e-10,
        "the tolerance of a solve, 1e-13, times the condition";
    MODAL: "outputs and u of a condensed tick by modes against the direct solver, over the largest", 1e-13,
        "rounding times a condition of 1000";
    MODAL_NARROW: "models by modes in f32, the same", 3e-5,
        "ε = 1.2e-7 times such a condition";
    MODAL_BOUND: "bound of a tick by modes against the host's for its exact solution, relative", 1e-9,
        "rounding";
    MODAL_BEST: "bound of a tick by modes against that of the model of one coefficient, relative", 0.12,
        "s is the best one at a tenth of a range of 1 to 60";
    GUARANTEE: "how far an error is above its bound, relative", 1e-3 worst 1.05e-5,
        "quadrature of the norms";
    IDENTITY: "bound of a condensed model against the identity, relative, smooth", 1e-5,
        "quadrature of lifts in triangles";
    IDENTITY_KINKED: "bound of a condensed model where contact ends within a cell, relative", 2e-3,
        "quadrature of the norms";
    IDENTITY_BOUNDED: "how far the identity is above the bound of any x, relative", 1e-14,
        "quadrature of the norms";
    JUMP: "what the bound for u_h has above that for s, against their distance, relative", 2e-5,
        "lifts have no gradient at the opposite vertex";
    CORNER: "what corners know of given values and gaps", 1e-14,
        "data of two evaluations";
    WAVES: "bound of a condensed model against the solve's where the gap's waves are nearly all of it, relative", 2e-3,
        "its s is the best, that of the solve is not";
    SAME_BOUND: "bound of one problem by another way, relative", 1e-10,
        "two solves";
}

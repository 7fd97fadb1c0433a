//! Comparisons in the tests of `host/bake`.

table! {
    TICK: "outputs and gap of a full controller against the solver, over the largest fluxes", 1e-7,
        "sweeps end at 1e-9 of the bound";
    TICK_NARROW: "the same in f32", 1e-3,
        "ε = 1.2e-7 times the condition";
    OSCILLATION: "how far the solver's oscillation is above that of a sum, relative", 1e-6,
        "the triangle inequality, but for rounding";
    SWEPT: "u of ticks without a bound against 4000 sweeps", 1e-12,
        "all that rounding allows";
    SWEPT_NARROW: "u in f32 with another square root", 1e-3,
        "a tick ends at 1e-4 of the bound";
    FACTORED: "u of a factored controller against the direct solver, over the largest", 1e-9,
        "a contrast of a million";
    FACTORED_NARROW: "the same in f32", 1e-4,
        "a contrast of a million";
    FACTORED_OBLIQUE: "the same for an anisotropy of 10⁸", 1e-7,
        "a matrix of that condition";
    FACTORED_GAP: "gap of a factored controller against the direct solver's, relative", 1e-3,
        "f32";
    WITHOUT_UNITS: "gap of a controller in f32 without units, in numbers near 2⁻⁴⁰, relative", 1e-4,
        "ε = 1.2e-7 in sums of squares";
    COSTS: "counted costs against curves through them, relative", 1e-9,
        "curves of as many coefficients as counts";
    LENGTH: "length of contact, condensed and full", 1e-6,
        "f32 in the condensed one";
    GUARANTEE: "how far an error is above its bound, relative", 1e-3,
        "quadrature of the norms";
    IDENTITY: "bound of a condensed model against the identity, relative, smooth", 1e-5,
        "quadrature of lifts in triangles";
    IDENTITY_KINKED: "the same where contact ends within a cell", 2e-3,
        "quadrature of the norms";
    IDENTITY_BOUNDED: "how far the identity is above the bound of any x, relative", 1e-3,
        "quadrature of the norms";
    JUMP: "what the bound for u_h has above that for s, against their distance, relative", 2e-5,
        "lifts have no gradient at the opposite vertex";
    CORNER: "what corners know of given values and gaps", 1e-12,
        "data of two evaluations";
    SAME_BOUND: "bound of one problem by another way, relative", 1e-6,
        "two solves";
}

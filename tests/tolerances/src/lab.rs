//! Comparisons in the tests of `host/lab`.

table! {
    PIVOTING: "algebraic error of exact solvers", 3e-15,
        "rounding alone";
    PIVOTING_LIMITED: "algebraic error of exact solvers with limits, over the energy norm of the solution", 3e-13,
        "exchanges may leave 48 roundings, and condensing materials whose conductivities differ by 178 loses a digit or two";
    CLARABEL_LIMITED: "u of contact with limits by Clarabel against the kernel's, over the largest", 1e-9,
        "an interior point ends at a gap of 1e-12, to which u goes with its square root";
    AS_BAKED: "matrix and load of the condensed problem against the baked one", 3e-13,
        "two condensations";
    RESIDUAL: "residual of an answer and its distance from itself", 1e-14,
        "rounding alone";
    MADE: "bound against the identity for scenes made for a solution, relative", 2e-3,
        "quadrature of the norms";
    ASPECT: "the first of graded rows, relative", 1e-14,
        "a root found by bisection";
    DERIVATIVE: "gradients of exact solutions against central differences", 3e-9,
        "steps of 1e-5";
    DERIVATIVE_SECOND: "sources against central differences of gradients", 1e-8,
        "steps of 1e-5";
    CONTACT: "contact laws of exact solutions", 1e-15,
        "rounding of values near 1";
    JUMP: "the halves of a jump where they meet, relative", 1e-9,
        "rounding of ratios up to 10¹²";
    FORCE: "forces of the exact solutions, relative", 2e-5,
        "quadrature on edges of the grid";
    LENGTH: "lengths of contact of the exact solutions, relative", 1e-3,
        "ends of contact are found by bisection of edges";
    CATALOGUE: "norms against the catalogue, relative", 3e-5,
        "its targets have six digits";
    FORCE_ERROR: "error of the force and energy of the solution, relative", 1e-3,
        "a difference of numbers ten times as large with six digits";
    LENGTH_ERROR: "error of the length of contact, relative", 2e-2,
        "a difference of numbers fifty times as large";
    SAME_NORMS: "norms after answers on other meshes, relative", 1e-14,
        "the same sums";
    REFERENCE: "errors by a reference against the exact solution, relative", 5e-3,
        "the reference has an error of its own";
    REFERENCE_L2: "L2 errors by a reference, relative", 0.03,
        "the reference has an error of its own, a sixteenth";
    REFERENCE_L2_QUADS: "L2 errors by a reference on triangles of an answer on quads, relative", 0.05,
        "the reference has an error of its own";
    ITSELF: "error of the force of a scene that is its own reference, relative", 1e-14,
        "the same solve";
}

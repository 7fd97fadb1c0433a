//! Comparisons in the tests of the command line, `host/tests`.

table! {
    MOVING_FORCE: "force of a moving contact against πa², relative", 0.02,
        "the error of the mesh";
    REPLAYED: "force of a second tick with the same inputs, relative", 1e-3,
        "ticks end at a share of the bound";
    LIMIT_OF_TICKS: "power and lengths of ticks with a limit that changes against solves, of 1 to 2", 2e-2,
        "ticks end at a share of the bound";
    BAKED: "outputs of the baked controller against the full model, relative", 1e-2,
        "ticks of the full model end at a share of the bound";
    STATED: "power of ticks where an input sets a coefficient, against the scene that states it, relative", 1e-3,
        "ticks end at a share of the bound";
    COARSE_START: "bound of a tick from a coarse mesh against one without, relative", 0.05,
        "both end at a share of the bound";
    PROMISED: "error of a fragment that is solved again, relative", 1e-14,
        "the digits in the file";
    KEPT: "errors of fragments in git, relative", 2e-5,
        "they were measured on other machines, perhaps";
    PRINTED: "force in the summary against the catalogue", 1e-6,
        "six digits are given";
    REFINED: "the bound of the last level against that on its mesh as it was written, relative", 1e-14,
        "two starts of one solve, each to a residual of 1e-13, and sweeps for s from both";
    DIRECT: "force by sweeps against the direct solver, relative", 2e-11,
        "the kernel stops when it takes the error for 1e-10";
    DIRECT_NARROW: "force by sweeps in f32 against the direct solver, relative", 2e-6,
        "data rounded to f32";
    GUARANTEE: "how far the error is above its bound at grazing and switching contact, relative", 1e-14,
        "quadrature of the norms";
}

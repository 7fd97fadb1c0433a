//! Comparisons in the tests of the kernel.

table! {
    BASIS: "basis functions, gradients and fluxes of a cell against closed forms", 1e-14,
        "sums of four terms near 1";
    LINEAR: "a linear function on quads, at vertices and inside", 8e-14,
        "values near 50, on a quad of side 0.004 far from the origin";
    GRADIENT: "the gradient of a linear function on quads", 4e-12,
        "values near 50 over sides of 0.004";
    LINEAR_FLUX: "flux of a linear function through the sides, over the largest entry of the matrix", 3e-14,
        "differences of values near 50";
    STIFFNESS: "element matrices by another rule or element, over the largest entry", 5e-15,
        "sums of 64 points against sums of 4";
    WEIGHTED: "s in corners of a cell that says 0 with a weight of 10⁹", 1e-7,
        "the other cells say 10 with a weight of 1";
    SOLVED: "solutions of meshes of a few cells, known on paper", 1e-13,
        "what the stopping test leaves, 1e-13 of the range";
    FAST_ROOT: "the fast square root, relative", 0.06,
        "what micromath promises";
    FORCE_OF_FLUX: "force of a report against the law of contact on recovered fluxes", 3e-15,
        "the same fluxes, summed in another order";
    FORCE_BY_LAW: "force and flux against the law of contact, over the terms, in ε as of f64", 3.6e-15,
        "the same terms, summed in another order and in f64";
    FORCE_AT_THE_END: "force against the sum of all r at the end, over the terms, in ε as of f64", 3e-15,
        "sweeps stop at 16 ε, and the matrix amplifies what is left";
    RESIDUAL: "what is left of a residual, a correction or the algebraic part", 1e-13,
        "all that rounding allows";
    ALGEBRAIC: "algebraic part of the bound where sweeps end, over the bound", 5e-14,
        "sweeps end far below the error of the mesh";
    SWEPT: "answers of ticks against sweeps to the end", 1e-9,
        "sweeps end at 1e-12 of the bound, on data up to 10⁹ times larger";
    FACTORED: "u and τ of factored ticks against sweeps to the end", 5e-12,
        "sweeps end at 1e-12 of the bound";
    BOUND: "gap and its sum over cells against an integration from coordinates, relative", 1e-12,
        "both are sums over a dozen cells";
    BALANCE: "surplus of a cell after the walk", 7e-15,
        "the walk hands surpluses through all cells in single steps of rounding";
    SCHUR: "springs in a row against the sum of compliances, relative", 1e-15,
        "three pivots";
    CANCELLED: "the soft spring seen from the far end of springs 10¹² times as stiff", 5e-15,
        "a difference of numbers 10¹² times as large";
    THREE_SIDES: "complementarity of exchanges with three sides, over the load or 1", 1e-13,
        "a tableau of at most 24 edges";
    THREE_PHASES_SWEPT: "openings of either sign by sweeps against three phases", 1e-14,
        "sweeps end at 1e-15 of the load";
    LIMITED_FORM: "bounds of drawn condensed answers with limits against the formulas, relative", 1e-8,
        "means of parts of s − ψ by 20 000 points";
    CONDENSED: "complementarity of exact condensed solves in f64, over the largest opening", 1e-13,
        "a tableau of at most 33 edges";
    CONDENSED_NARROW: "complementarity of exact condensed solves in f32, over the largest opening", 1e-5,
        "a tableau of at most 33 edges, with ε = 1.2e-7";
    CONDENSED_SWEPT: "openings by sweeps against pivots, over 1 and their size", 1e-12,
        "sweeps end at 1e-14 of the load";
    EXTREME_DEFECT: "complementarity over the whole range of loads, over the largest load, in ε as of f64", 2.2e-13,
        "sweeps end at 20 ε, and the matrix amplifies what is left";
    TABLEAU: "entries after exchanges that undo each other, and sweeps against naive ones", 1e-14,
        "a dozen operations on numbers near 1";
}

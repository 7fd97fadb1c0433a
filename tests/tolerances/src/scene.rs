//! Comparisons in the tests of `host/scene`.

table! {
    MEASURE: "areas of surfaces and lengths of curves, before and after, relative", 5e-15,
        "sums over thousands of cells, by halves";
    PLACE: "areas and edges of new cells in old ones, relative to the old ones", 1e-12,
        "midpoints are rounded by ε of the size of the mesh, a hundred cells or more";
    DIGITS: "coordinates in text against binary files", 1e-15,
        "Gmsh prints 16 digits";
    VALUE: "values of expressions against another calculator, relative", 8.9e-16,
        "4 ε: few operations, correctly rounded or nearly";
    DERIVATIVE: "gradients of expressions against central differences, over 1 and their size", 1e-8,
        "steps of 1e-5 have errors of 1e-10, and rounding of 1e-11";
    SINGLE: "expressions in single precision, relative", 3e-7,
        "2.5 ε of f32";
    ENCLOSED: "integrals of monomials by enclosures, and their widths", 2e-13,
        "widths of a few dozen ε of the terms, doubled at each operation";
}

//! Comparisons in the tests of `host/draw`.

table! {
    AREA: "area of an outline, over that of the picture", 1e-14,
        "outlines are simplified within 0.12 of a pixel, which straight ones do not feel";
    ROUND_AREA: "area beside a disc, relative", 2e-3,
        "a disc of 64 cells across is a polygon, simplified to 0.12 of a pixel";
    POSITION: "places on a picture, in pixels", 1e-12,
        "no eye sees a millionth";
    SLOPE: "slope of three points in a double logarithmic picture", 1e-14,
        "three logarithms";
}

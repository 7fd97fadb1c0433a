//! What a map of outcomes cannot say of its axes.

/// A few words; empty where the names of the axes say it all.
pub(super) fn remark(axis: &str, across: Option<&str>) -> &'static str {
    match (axis.split(':').next().unwrap_or(axis), across) {
        ("contrast", None) => "k of J(k): A is k left of x = 0 and 1 right of it",
        ("anisotropy", None) => {
            "κ of T(0, κ) with A = diag(κ, 1/κ): layers at C are κ times thinner than the domain"
        }
        ("obliqueness", None) => "s of T(s, 1)",
        ("anisotropy", Some("obliqueness")) => {
            "beyond s/κ = 2¹² in f32 and 2²⁶ in f64 the stored tensor is singular"
        }
        ("aspect ratio", None) => {
            "width over height of the flattest cells; rows grow from C upwards"
        }
        ("slivers", None) => "flat cells with angles near 180°",
        ("collapsed quads", None) => {
            "one side over the others; 0 is a triangle with four corners, below it the cell crosses itself"
        }
        ("trapezoids", None) => "rows of a grid whose cells never become parallelograms",
        ("grazing length", None) => "length of the part of C with neither force nor gap",
        ("length of C", None) => "none, one edge, the lower side, the whole boundary",
        ("length of D", None) => {
            "none (contact alone holds the domain), one tiny edge, one side, three sides"
        }
        ("transfer coefficient", None) => "the upper side transfers, no side is held",
        ("switching edges", None) => {
            "ticks: every contact edge opens or closes from each to the next"
        }
        ("span of the flux", None) => {
            "hi − lo over lo where lo ≤ σ·n ≤ hi on C, which is above, at and below the gap"
        }
        ("ends of the flux", None) => "hi = −lo over the flux that the wall asks for",
        ("potential above", None) => "of a wall whose flux is between −2 and 3",
        ("greatest flux", _) => "hi over the largest flux: a limit that is not reached",
        ("least flux", _) => "the same with all signs turned",
        ("infinite end", None) => "the lower one, both, the upper one",
        ("switching limits", None) => "ticks: a wall at either end of its flux in turn",
        ("fixed relaxation", _) => "an ω from the scene's setting",
        ("cells", None) => "beyond 10⁵ cells a solve is cut off after 3·10⁸ updates of unknowns",
        _ => "",
    }
}

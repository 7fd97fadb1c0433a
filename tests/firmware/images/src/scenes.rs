//! The scenes, as the host's exporter wrote them, in both scalars.

macro_rules! scenes {
    ($($name:ident: $file:literal,)*) => {
        $(
            #[allow(missing_docs, clippy::all)]
            #[rustfmt::skip]
            pub mod $name {
                include!(concat!(env!("SIGNORINI_SCENES"), "/", $file));
            }
        )*
    };
}

scenes! {
    linear_f32: "linear_f32.rs",
    levee_f32: "levee_f32.rs",
    levee_f64: "levee_f64.rs",
    slab_f32: "slab_f32.rs",
    slab_f64: "slab_f64.rs",
    strip_f32: "strip_f32.rs",
    strip_f64: "strip_f64.rs",
    membrane_f32: "membrane_f32.rs",
    membrane_f64: "membrane_f64.rs",
}

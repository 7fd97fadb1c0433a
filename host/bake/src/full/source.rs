//! The Rust text of the full model.

use std::fmt::Write as _;

use super::arrays::Baked;
use super::driver::controller;
use super::listing::listing;
use super::sizes::sizes;
use crate::module_api::About;
use signorini_problem::scalar::Scalar;

/// The module.
pub fn source<R: Scalar>(baked: &Baked<R>) -> String {
    let index = baked.index();
    let (features, sizes, counts) = (baked.features(), sizes(baked), baked.counts);
    let about = format!(
        "The full model in {}: {} unknowns, {} of them contact edges, on {} triangles and {} quads{}{}. \
         {} bytes of RAM in a [`Controller`], {} bytes of data in flash.",
        R::NAME,
        counts.unknowns(),
        counts.contact,
        baked.of_triangles.len(),
        baked.of_quads.len(),
        if baked.factored.is_some() { ", solved by a factor" } else { "" },
        if baked.how.certified {
            ""
        } else {
            ", without an error bound (certificate = false leaves it out)"
        },
        sizes.ram,
        sizes.flash
    );
    let about = About { model: "full", text: &about, features: &features };
    let mut text = baked.face.source::<R>(&about);
    let _ = write!(text, "\n/// Positions in the arrays.\ntype Index = {index};\n");
    text += &required(&features);
    text += &controller(baked);
    text + &listing(baked)
}

/// The build fails, and says why, where the kernel lacks code for the scene.
fn required(features: &[&str]) -> String {
    let assertion = |name: &&str| {
        let constant = name.to_ascii_uppercase();
        format!(
            "const _: () = assert!(signorini_device::kernel::features::{constant}, \"signorini-device \
             lacks its feature `{name}`\");\n"
        )
    };
    "\n".to_owned() + &features.iter().map(assertion).collect::<String>()
}

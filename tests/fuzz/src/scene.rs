//! The scene parser, and what a scene is on a mesh.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| signorini_tests::hostile::scene(data));

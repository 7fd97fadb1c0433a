//! The Gmsh reader.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| signorini_tests::hostile::mesh(data));

//! The kernel's public constructors.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| signorini_tests::hostile::constructors(data));

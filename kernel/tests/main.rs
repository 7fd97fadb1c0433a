//! The tests of the kernel as one program: `cargo test -p signorini-kernel --test main NAME`.

mod elements;
mod exact;
mod law;
mod nonparametric;

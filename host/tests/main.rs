//! The tests of the command as one program: `cargo test -p signorini --test main NAME`.

mod bake;
mod begin;
mod cli;
mod command;
mod extremes;
#[cfg(unix)]
mod interrupted;
mod logs;
mod max_error;
mod pages;
mod paths;
mod ranges;
mod records;
mod scales;
mod settings;
mod tick;
mod tick_state;
mod trade;
mod warnings;

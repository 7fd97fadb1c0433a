//! The tests of baked models as one program: `cargo test -p signorini-bake --test main NAME`.

mod condensed_bound;
mod condensed_length;
mod condensed_limits;
mod crossed_ends;
mod direct;
mod excluded;
mod limit_inputs;
mod means;
mod plus_minus;
mod promise;
mod transfer;
mod unsolvable;
mod warm_inputs;

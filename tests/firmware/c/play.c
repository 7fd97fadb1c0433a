/* A controller from C: the ticks of `scene/src/play.rs`, line by line the same, whatever the scene.
 *
 *   @ instructions 6612      of a call, the call included, where COUNTED: 1 NAME_tick with outputs and report, and in a library
 *                            that has them 2 the tick and its intervals as Rust calls them, 3 the tick alone
 */
#include <string.h>

#include "board.h"
#include "journal.h"
#include "loads.h"

#ifdef COUNTED
#include "counter.h"
#endif

static NAMED(state) state;

#ifndef COUNTED
static void tell_values(const char *name, const output_values values) {
    for (int at = 0; at < OUTPUTS; at++) {
        tell_scalar(name, values[at]);
    }
}

/* What ended the tick, in the words of `scene/src/figures.rs`. */
static const char *ended(NAMED(status) status) {
    switch (status) {
    case CODE(EXACT):
        return "exact";
    case CODE(ACCURATE):
        return "accurate";
    case CODE(SETTLED):
        return "settled";
    case CODE(OUT_OF_SWEEPS):
        return "out of sweeps";
    case CODE(OUT_OF_TIME):
        return "out of time";
    case CODE(NOT_FINITE):
        return "not finite";
    default:
        return "?";
    }
}

static const char *no_bound(NAMED(bounded) why) {
    switch (why) {
    case CODE(UNPRESSED):
        return "no bound: unpressed";
    case CODE(BELOW_GAP):
        return "no bound: below the gap";
    case CODE(UNAVAILABLE):
        return "no bound: unavailable";
    case CODE(BOUND_NOT_FINITE):
        return "no bound: not finite";
    case CODE(NOT_ASKED):
        return "no bound: not asked";
    default:
        return "?";
    }
}

static void tell_bound(const NAMED(report) *report) {
    if (report->bounded == CODE(PULLED)) {
        tell_count("pulled", report->pulled);
    } else if (report->bounded != CODE(CERTIFIED)) {
        tell(no_bound(report->bounded));
    } else {
        tell_scalar("gap", report->gap);
        tell_scalar("algebraic", report->algebraic);
        tell_scalar("oscillation", report->oscillation);
        tell_scalar("rounding", report->rounding);
        tell_scalar("total", report->bound);
        tell_scalar("of u", report->of_u);
    }
}

static void tell_answer(const NAMED(outputs) *outputs, const NAMED(report) *report) {
    output_values values;
    memcpy(values, outputs, sizeof *outputs);
    tell_values("output", values);
#if CODE(OUTPUTS) > 0
    memcpy(values, &report->plus_minus, sizeof *outputs);
    tell_values("plus-minus", values);
#endif
    tell(ended(report->status));
    tell_count("exchanges", report->exchanges);
    tell_count("sweeps", report->sweeps);
    tell_count("active", report->active);
    tell_bound(report);
#ifdef IN_TIME
    {
        scalar energy;
        if (NAMED(window)(&state, &energy, NULL) == CODE(OK) && energy - energy == 0) {
            tell_scalar("window", energy);
        }
    }
#endif
}
#endif

#ifdef COUNTED
void NAMED(answered)(NAMED(state) *state, const NAMED(inputs) *inputs);
void NAMED(ticked)(NAMED(state) *state, const NAMED(inputs) *inputs);

static void tick(const NAMED(inputs) *inputs) {
    uint32_t before, empty, after;
    before = counted();
    empty = counted() - before;
#if COUNTED == 1
    static NAMED(outputs) outputs;
    static NAMED(report) report;
    before = counted();
    (void)NAMED(tick)(&state, inputs, &outputs, &report);
#elif COUNTED == 2
    before = counted();
    NAMED(answered)(&state, inputs);
#else
    before = counted();
    NAMED(ticked)(&state, inputs);
#endif
    after = counted();
    tell_count("@ instructions", after - before - empty);
}
#else
static void start_counter(void) {
}

static void tick(const NAMED(inputs) *inputs) {
    static NAMED(outputs) outputs;
    static NAMED(report) report;
    if (NAMED(tick)(&state, inputs, &outputs, &report) == CODE(OK)) {
        tell_answer(&outputs, &report);
    } else {
        tell("refused");
    }
}
#endif

int main(void) {
    NAMED(inputs) inputs;
    if (NAMED(init)(&state) != CODE(OK)) {
        return 1;
    }
    start_counter();
    first_inputs();
    for (uint32_t at = 1; at <= TICKS; at++) {
        next_inputs(&inputs);
        tell_count("tick", at);
        tick(&inputs);
    }
    return 0;
}

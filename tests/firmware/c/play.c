/* A controller from C: the ticks of `scene/src/play.rs`, line by line the same, whatever the scene.
 *
 *   @ instructions 6612      of a call of NAME_tick with outputs and report, where COUNTED
 */
#include <string.h>

#include "board.h"
#include "journal.h"
#include "loads.h"

#ifdef COUNTED
#include "counter.h"
#else
static void start_counter(void) {
}
static uint32_t counted(void) {
    return 0;
}
#endif

static NAMED(state) state;

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
}

/* One tick; its count in instructions. */
static uint32_t tick(const NAMED(inputs) *inputs, uint32_t empty) {
    static NAMED(outputs) outputs;
    static NAMED(report) report;
    uint32_t before = counted();
    NAMED(error) error = NAMED(tick)(&state, inputs, &outputs, &report);
    uint32_t after = counted();
#ifdef COUNTED
    tell_count("@ instructions", after - before - empty);
#endif
    if (error != CODE(OK)) {
        tell("refused");
    } else {
        tell_answer(&outputs, &report);
    }
    return after - before - empty;
}

int main(void) {
    NAMED(inputs) inputs;
    uint32_t before, empty;
    if (NAMED(init)(&state) != CODE(OK)) {
        return 1;
    }
    start_counter();
    before = counted();
    empty = counted() - before;
    first_inputs();
    for (uint32_t at = 1; at <= TICKS; at++) {
        next_inputs(&inputs);
        tell_count("tick", at);
        (void)tick(&inputs, empty);
    }
    return 0;
}

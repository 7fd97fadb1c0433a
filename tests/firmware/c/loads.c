#include "loads.h"

#include <stdint.h>
#include <string.h>

static uint32_t tick;

#ifdef LOG
/* The inputs of each tick, in the order of the scene. */
static const input_values logged[] = {
#include LOG
};

void next_inputs(NAMED(inputs) *inputs) {
    memcpy(inputs, logged[tick++], sizeof *inputs);
}

void first_inputs(void) {
    tick = 0;
}
#elif CODE(INPUTS) > 0
/* Marsaglia's xorshift of 32 bits. */
static uint32_t state;

/* Evenly from [0, 1), in steps that both scalars hold. */
static scalar part(void) {
    state ^= state << 13;
    state ^= state >> 17;
    state ^= state << 5;
    return (scalar)(state >> 8) * ((scalar)1 / (scalar)(1 << 24));
}

static int is_finite(scalar value) {
    return value - value == 0;
}

static scalar value(scalar drawn, scalar given, scalar lo, scalar hi) {
    if (!is_finite(lo) || !is_finite(hi)) {
        scalar unit = given == 0 ? (scalar)1 : given;
        return given + unit * ((scalar)0.2 * drawn - (scalar)0.1);
    }
    if (tick % 4 < 2) {
        return lo + (hi - lo) * drawn;
    }
    return drawn < (scalar)0.5 ? lo : hi;
}

void next_inputs(NAMED(inputs) *inputs) {
    input_values values, least, most;
    *inputs = NAMED(default_inputs);
    if (tick > 0) {
        memcpy(values, inputs, sizeof *inputs);
        memcpy(least, &NAMED(least_inputs), sizeof *inputs);
        memcpy(most, &NAMED(most_inputs), sizeof *inputs);
        for (int at = 0; at < INPUTS; at++) {
            values[at] = value(part(), values[at], least[at], most[at]);
        }
        memcpy(inputs, values, sizeof *inputs);
        NAMED(clamp)(inputs);
    }
    tick++;
}

void first_inputs(void) {
    tick = 0;
    state = 0x51690e1du;
}
#else
void next_inputs(NAMED(inputs) *inputs) {
    memset(inputs, 0, sizeof *inputs);
    tick++;
}

void first_inputs(void) {
    tick = 0;
}
#endif

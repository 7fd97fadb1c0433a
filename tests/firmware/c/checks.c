/* One controller by itself: compiled for each scene. */
#include "checks.h"

#include <string.h>

#include "loads.h"

struct answer {
    NAMED(outputs) outputs;
    NAMED(report) report;
};

static NAMED(state) state, other, saved;
static struct answer answers[TICKS], answer;

static NAMED(error) ticked(NAMED(state) *of, const NAMED(inputs) *inputs, struct answer *to) {
    memset(to, 0, sizeof *to);
    return NAMED(tick)(of, inputs, &to->outputs, &to->report);
}

static int equal(const struct answer *one, const struct answer *two) {
    return memcmp(one, two, sizeof *one) == 0;
}

/* All answers from a cold start: what is compared below. */
static void play_once(void) {
    NAMED(inputs) inputs;
    first_inputs();
    CHECK(NAMED(init)(&state) == OK);
    for (int at = 0; at < TICKS; at++) {
        next_inputs(&inputs);
        CHECK(ticked(&state, &inputs, &answers[at]) == OK);
    }
    CHECK(TICKS < 3 || !equal(&answers[0], &answers[1]) || !equal(&answers[1], &answers[2]) || INPUTS == 0);
}

static void seals(void) {
    NAMED(inputs) inputs;
    first_inputs();
    next_inputs(&inputs);
    fill(&state, sizeof state, 7);
    CHECK(NAMED(init)(&state) == OK && NAMED(check_state)(&state) == OK);
    CHECK(ticked(&state, &inputs, &answer) == OK && NAMED(check_state)(&state) == UNSEALED);
    CHECK(NAMED(seal_state)(&state) == OK && NAMED(check_state)(&state) == OK);
    CHECK(NAMED(seal_state)(&state) == OK && NAMED(check_state)(&state) == OK);
    CHECK(equal(&answer, &answers[0]));
}

/* Every byte of a small state; of a large one the first, and others in even steps. */
static void damaged(void) {
    unsigned char *bytes = (unsigned char *)&state;
    size_t step = 1 + sizeof state / 2048;
    for (size_t at = 0; at < sizeof state; at += at < 64 ? 1 : step) {
        for (unsigned bit = 0; bit < 8; bit += 3) {
            bytes[at] = (unsigned char)(bytes[at] ^ 1u << bit);
            CHECK(NAMED(check_state)(&state) != OK);
            bytes[at] = (unsigned char)(bytes[at] ^ 1u << bit);
        }
    }
    CHECK(NAMED(check_state)(&state) == OK);
}

/* Kept, gone on with, put elsewhere, gone on with again. */
static void restored(void) {
    NAMED(inputs) inputs;
    int half = TICKS / 2;
    first_inputs();
    CHECK(NAMED(init)(&state) == OK);
    for (int at = 0; at < TICKS; at++) {
        next_inputs(&inputs);
        if (at == half) {
            CHECK(NAMED(seal_state)(&state) == OK);
            memcpy(&saved, &state, sizeof saved);
        }
        CHECK(ticked(&state, &inputs, &answer) == OK && equal(&answer, &answers[at]));
    }
    first_inputs();
    memcpy(&other, &saved, sizeof other);
    CHECK(NAMED(check_state)(&other) == OK);
    for (int at = 0; at < TICKS; at++) {
        next_inputs(&inputs);
        if (at >= half) {
            CHECK(ticked(&other, &inputs, &answer) == OK && equal(&answer, &answers[at]));
        }
    }
    CHECK(NAMED(reset)(&other) == OK && NAMED(check_state)(&other) == OK);
    first_inputs();
    for (int at = 0; at < 9; at++) {
        next_inputs(&inputs);
        CHECK(ticked(&other, &inputs, &answer) == OK && equal(&answer, &answers[at]));
    }
}

/* One plays from the start, one is always a tick behind, one stays. */
static void side_by_side(void) {
    NAMED(inputs) inputs, before;
    first_inputs();
    CHECK(NAMED(init)(&state) == OK && NAMED(init)(&other) == OK && NAMED(init)(&saved) == OK);
    for (int at = 0; at < TICKS; at++) {
        next_inputs(&inputs);
        CHECK(ticked(&state, &inputs, &answer) == OK && equal(&answer, &answers[at]));
        if (at > 0) {
            CHECK(ticked(&other, &before, &answer) == OK && equal(&answer, &answers[at - 1]));
        }
        before = inputs;
    }
    CHECK(NAMED(check_state)(&saved) == OK);
}

static void null_pointers(void) {
    NAMED(inputs) inputs;
    first_inputs();
    next_inputs(&inputs);
    CHECK(NAMED(init)(NULL) == NULL_POINTER);
    CHECK(NAMED(tick)(NULL, &inputs, &answer.outputs, &answer.report) == NULL_POINTER);
    CHECK(NAMED(tick)(&state, NULL, &answer.outputs, &answer.report) == NULL_POINTER);
    CHECK(NAMED(tick_within)(NULL, &inputs, NULL, NULL, NULL, NULL) == NULL_POINTER);
    CHECK(NAMED(tick_within)(&state, NULL, NULL, NULL, NULL, NULL) == NULL_POINTER);
    CHECK(NAMED(reset)(NULL) == NULL_POINTER && NAMED(seal_state)(NULL) == NULL_POINTER);
    CHECK(NAMED(check_state)(NULL) == NULL_POINTER && NAMED(culprit)(NULL) == 0);
    NAMED(clamp)(NULL);
    CHECK(NAMED(init)(&state) == OK);
    CHECK(NAMED(tick)(&state, &inputs, NULL, NULL) == OK && NAMED(init)(&state) == OK);
    memset(&answer, 0, sizeof answer);
    CHECK(NAMED(tick)(&state, &inputs, &answer.outputs, NULL) == OK);
    CHECK(memcmp(&answer.outputs, &answers[0].outputs, sizeof answer.outputs) == 0);
    CHECK(NAMED(init)(&state) == OK && NAMED(tick)(&state, &inputs, NULL, &answer.report) == OK);
    CHECK(equal(&answer, &answers[0]));
}

#if CODE(INPUTS) > 0
static int is_finite(scalar value) {
    return value - value == 0;
}

/* Refused, with nothing changed but the culprit. */
static void refuses(const input_values values, int at, scalar value, int why) {
    input_values wrong;
    NAMED(inputs) inputs;
    struct answer before;
    memcpy(wrong, values, sizeof wrong);
    wrong[at] = value;
    memcpy(&inputs, wrong, sizeof inputs);
    fill(&answer, sizeof answer, 3);
    memcpy(&before, &answer, sizeof before);
    memcpy(&other, &state, sizeof other);
    CHECK(NAMED(tick)(&state, &inputs, &answer.outputs, &answer.report) == why);
    CHECK(NAMED(culprit)(&state) == (uint32_t)at);
    CHECK(NAMED(tick_within)(&state, &inputs, NULL, NULL, &answer.outputs, &answer.report) == why);
    CHECK(NAMED(culprit)(&state) == (uint32_t)at);
    CHECK(equal(&answer, &before) && NAMED(check_state)(&state) == OK);
    /* The last words of the header are checksum and culprit. */
    CHECK(memcmp(state.words, other.words, 16) == 0);
    CHECK(memcmp(state.words + 3, other.words + 3, sizeof state - 24) == 0);
}

static void refusals(void) {
    NAMED(inputs) inputs;
    input_values values, least, most;
    scalar zero = 0, one = 1;
    memset(values, 0, sizeof values);
    memcpy(least, &NAMED(least_inputs), sizeof inputs);
    memcpy(most, &NAMED(most_inputs), sizeof inputs);
    first_inputs();
    next_inputs(&inputs);
    memcpy(values, &inputs, sizeof inputs);
    CHECK(NAMED(init)(&state) == OK);
    CHECK(ticked(&state, &inputs, &answer) == OK && NAMED(seal_state)(&state) == OK);
    for (int at = 0; at < INPUTS; at++) {
        int is_free = !is_finite(least[at]) || !is_finite(most[at]);
        int why = is_free ? NOT_FINITE : OUT_OF_RANGE;
        CHECK(least[at] <= values[at] && values[at] <= most[at]);
        refuses(values, at, zero / zero, why);
        refuses(values, at, one / zero, why);
        refuses(values, at, -one / zero, why);
        if (!is_free) {
            refuses(values, at, most[at] + one, OUT_OF_RANGE);
            refuses(values, at, least[at] - one, OUT_OF_RANGE);
        }
    }
    next_inputs(&inputs);
    CHECK(ticked(&state, &inputs, &answer) == OK && equal(&answer, &answers[1]));
}

static void clamped(void) {
    NAMED(inputs) inputs;
    input_values values, least, most, now;
    memcpy(least, &NAMED(least_inputs), sizeof inputs);
    memcpy(most, &NAMED(most_inputs), sizeof inputs);
    for (int at = 0; at < INPUTS; at++) {
        values[at] = is_finite(most[at]) ? most[at] + 1 : (scalar)7;
    }
    memcpy(&inputs, values, sizeof inputs);
    NAMED(clamp)(&inputs);
    memcpy(now, &inputs, sizeof inputs);
    for (int at = 0; at < INPUTS; at++) {
        CHECK(now[at] == (is_finite(most[at]) ? most[at] : (scalar)7));
        values[at] = is_finite(least[at]) ? least[at] - 1 : (scalar)-7;
    }
    memcpy(&inputs, values, sizeof inputs);
    NAMED(clamp)(&inputs);
    memcpy(now, &inputs, sizeof inputs);
    for (int at = 0; at < INPUTS; at++) {
        CHECK(now[at] == (is_finite(least[at]) ? least[at] : (scalar)-7));
    }
}
#else
static void refusals(void) {
}
static void clamped(void) {
}
#endif

static uint32_t asked;
static int mark;

/* Time that is always over, or never. */
static uint32_t remaining(void *context) {
    CHECK(context == &mark);
    asked++;
    return mark ? UINT32_MAX : 0;
}

static void deadlines(void) {
    NAMED(inputs) inputs;
    NAMED(limits) limits = {0, 0, 1};
    NAMED(deadline) deadline;
    deadline.remaining = remaining;
    deadline.context = &mark;
    deadline.sweep = 1000;
    deadline.certificate = 1000;
    first_inputs();
    CHECK(NAMED(init)(&state) == OK && NAMED(init)(&other) == OK);
    /* Without a limit: the plain tick. */
    for (int at = 0; at < 5; at++) {
        next_inputs(&inputs);
        memset(&answer, 0, sizeof answer);
        CHECK(NAMED(tick_within)(&state, &inputs, NULL, NULL, &answer.outputs, &answer.report) == OK);
        CHECK(equal(&answer, &answers[at]));
        /* Time without end is none, but that a certificate is not taken as often as one may be: whatever the model, an answer. */
        mark = 1;
        CHECK(NAMED(tick_within)(&other, &inputs, NULL, &deadline, &answer.outputs, &answer.report) == OK);
        CHECK(answer.report.status != OUT_OF_TIME);
    }
    mark = 0;
    asked = 0;
    CHECK(NAMED(init)(&state) == OK);
    first_inputs();
    next_inputs(&inputs);
    next_inputs(&inputs);
    CHECK(NAMED(tick_within)(&state, &inputs, NULL, &deadline, &answer.outputs, &answer.report) == OK);
#ifdef SWEPT
    CHECK(asked > 0 && answer.report.status == OUT_OF_TIME && answer.report.sweeps == 0);
    CHECK(NAMED(init)(&state) == OK);
    CHECK(NAMED(tick_within)(&state, &inputs, &limits, NULL, &answer.outputs, &answer.report) == OK);
    CHECK(answer.report.status == OUT_OF_SWEEPS && answer.report.sweeps == 1);
#endif
    /* A deadline without a function is none. */
    deadline.remaining = NULL;
    CHECK(NAMED(init)(&state) == OK);
    first_inputs();
    next_inputs(&inputs);
    memset(&answer, 0, sizeof answer);
    CHECK(NAMED(tick_within)(&state, &inputs, NULL, &deadline, &answer.outputs, &answer.report) == OK);
    CHECK(answer.report.status == answers[0].report.status);
    (void)limits;
}

static void words(void) {
    CHECK(strcmp(NAMED(error_name)(OK), "OK") == 0);
    CHECK(strcmp(NAMED(error_name)(CODE(FOREIGN_STATE)), "FOREIGN_STATE") == 0);
    CHECK(strcmp(NAMED(error_name)(CODE(INCONSISTENT)), "INCONSISTENT") == 0);
    CHECK(strcmp(NAMED(error_name)(CODE(EXCLUDED)), "EXCLUDED") == 0);
    CHECK(strcmp(NAMED(error_name)(CODE(EXCLUDED) + 1), "UNKNOWN") == 0);
    CHECK(strcmp(NAMED(error_name)(-1), "UNKNOWN") == 0);
    CHECK(strcmp(NAMED(status_name)(CODE(OUT_OF_TIME)), "OUT_OF_TIME") == 0);
    CHECK(strcmp(NAMED(status_name)(99), "UNKNOWN") == 0);
    CHECK(strcmp(NAMED(bounded_name)(CODE(CERTIFIED)), "CERTIFIED") == 0);
    CHECK(strcmp(NAMED(bounded_name)(INT32_MIN), "UNKNOWN") == 0);
}

#ifdef IN_TIME
void NAMED(in_time)(void);
#endif

static void run(void) {
    play_once();
    seals();
    damaged();
    restored();
    side_by_side();
    null_pointers();
    refusals();
    clamped();
    deadlines();
    words();
#ifdef IN_TIME
    NAMED(in_time)();
#endif
}

static int32_t init_any(void *of) {
    return NAMED(init)((NAMED(state) *)of);
}

static int32_t check_any(const void *of) {
    return NAMED(check_state)((const NAMED(state) *)of);
}

static int32_t seal_any(void *of) {
    return NAMED(seal_state)((NAMED(state) *)of);
}

static int32_t reset_any(void *of) {
    return NAMED(reset)((NAMED(state) *)of);
}

static int32_t tick_any(void *of) {
    NAMED(inputs) inputs;
    first_inputs();
    next_inputs(&inputs);
    return NAMED(tick)((NAMED(state) *)of, &inputs, &answer.outputs, &answer.report);
}

#define WORD(scene) #scene
#define WORD_OF(scene) WORD(scene)

extern const struct controller NAMED(controller);
const struct controller NAMED(controller) = {
    WORD_OF(SCENE), sizeof(NAMED(state)), init_any, check_any, seal_any, reset_any, tick_any, run,
};

/* What a controller that steps in time has beside its ticks: a saved state, and the bound of the evolution. */
#include "checks.h"

#include <string.h>

#include "loads.h"

enum { HALF = 4, ALL = 9 };

struct answer {
    NAMED(outputs) outputs;
    NAMED(report) report;
    scalar energy, seconds;
};

static NAMED(state) state, before;
static NAMED(saved) saved, start, wrong;
static struct answer answers[ALL];

/* The next tick, and what is known after it. */
static struct answer next(void) {
    NAMED(inputs) inputs;
    struct answer answer;
    memset(&answer, 0, sizeof answer);
    next_inputs(&inputs);
    CHECK(NAMED(tick)(&state, &inputs, &answer.outputs, &answer.report) == OK);
    CHECK(NAMED(window)(&state, &answer.energy, &answer.seconds) == OK);
    return answer;
}

/* The ticks from `first` on are those that were played. */
static void goes_on(int first) {
    NAMED(inputs) inputs;
    first_inputs();
    for (int at = 0; at < first; at++) {
        next_inputs(&inputs);
    }
    for (int at = first; at < ALL; at++) {
        struct answer answer = next();
        CHECK(memcmp(&answer, &answers[at], sizeof answer) == 0);
    }
}

static void play_once(void) {
    scalar energy, seconds;
    CHECK(NAMED(init)(&state) == OK && NAMED(save)(&state, &start) == OK);
    CHECK(NAMED(window)(&state, &energy, &seconds) == OK);
    first_inputs();
    for (int at = 0; at < ALL; at++) {
        if (at == HALF) {
            CHECK(NAMED(save)(&state, &saved) == OK);
        }
        answers[at] = next();
        CHECK(answers[at].energy > 0 && answers[at].energy - answers[at].energy == 0);
        CHECK(answers[at].energy != energy && answers[at].seconds == answers[0].seconds && answers[0].seconds > 0);
    }
    CHECK(memcmp(&answers[HALF], &answers[ALL - 1], sizeof *answers) != 0);
}

/* From another place in time, from none, and from the start. */
static void restored(void) {
    scalar energy;
    CHECK(NAMED(restore)(&state, &saved) == OK && NAMED(check_state)(&state) == OK);
    CHECK(NAMED(window)(&state, &energy, NULL) == OK && energy == answers[HALF - 1].energy);
    goes_on(HALF);
    CHECK(NAMED(init)(&state) == OK && NAMED(restore)(&state, &saved) == OK);
    goes_on(HALF);
    CHECK(NAMED(restore)(&state, &start) == OK);
    goes_on(0);
    CHECK(NAMED(reset)(&state) == OK && NAMED(check_state)(&state) == OK);
    goes_on(0);
}

/* Refused as `why`, or as `or`, with nothing changed. */
static void refused(const NAMED(saved) *by, NAMED(error) why, NAMED(error) or) {
    NAMED(error) found;
    memcpy(&before, &state, sizeof before);
    found = NAMED(restore)(&state, by);
    CHECK(found == why || found == or);
    CHECK(memcmp(&before, &state, sizeof before) == 0);
}

static void wrong_bytes(void) {
    unsigned char *bytes = (unsigned char *)&wrong;
    CHECK(NAMED(restore)(&state, &saved) == OK);
    for (uint32_t seed = 1; seed < 5; seed++) {
        fill(&wrong, sizeof wrong, seed);
        refused(&wrong, FOREIGN, FOREIGN);
    }
    memset(&wrong, 0, sizeof wrong);
    refused(&wrong, FOREIGN, FOREIGN);
    memcpy(&wrong, &saved, sizeof wrong);
    /* The last four bytes may be none of its. */
    for (size_t at = 0; at < sizeof wrong - 4; at += at < 64 ? 1 : 1 + sizeof wrong / 512) {
        bytes[at] = (unsigned char)(bytes[at] ^ 1u << at % 8);
        refused(&wrong, DAMAGED, at < 8 ? FOREIGN : DAMAGED);
        bytes[at] = (unsigned char)(bytes[at] ^ 1u << at % 8);
    }
    CHECK(NAMED(check_state)(&state) == OK);
    goes_on(HALF);
    /* The seal of a tick that has just ended is broken, and stays so. */
    fill(&wrong, sizeof wrong, 7);
    refused(&wrong, FOREIGN, FOREIGN);
    CHECK(NAMED(check_state)(&state) == UNSEALED);
}

static void wrong_calls(void) {
    CHECK(NAMED(save)(NULL, &wrong) == NULL_POINTER && NAMED(save)(&state, NULL) == NULL_POINTER);
    CHECK(NAMED(restore)(NULL, &saved) == NULL_POINTER && NAMED(restore)(&state, NULL) == NULL_POINTER);
    CHECK(NAMED(window)(NULL, NULL, NULL) == NULL_POINTER && NAMED(window)(&state, NULL, NULL) == OK);
    fill(&state, sizeof state, 3);
    refused(&saved, FOREIGN, FOREIGN);
    CHECK(NAMED(save)(&state, &wrong) == FOREIGN && NAMED(window)(&state, NULL, NULL) == FOREIGN);
}

void NAMED(in_time)(void);
void NAMED(in_time)(void) {
    play_once();
    restored();
    wrong_bytes();
    wrong_calls();
}

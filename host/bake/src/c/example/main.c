/* A controller in firmware. A timer gives the pace; the controller's state outlives a reset; a watchdog resets the board where a
 * step does not end.
 *
 *   timer interrupt ─► step: sensors ─► @name@_tick ─► actuators ─► @name@_seal_state ─► watchdog fed
 *   reset ─► @name@_check_state ─► goes on with the state, or begins anew
 */
#include <stdio.h>

#include "@name@.h"
#include "board.h"

@pace@enum { PERIOD = 10000, STEPS = 40, HANGS_AT = 20 };

/* What a reset leaves: the state itself, and how many steps it has made. Sealed after each step: a reset within one finds the seal
 * broken. Who must go on even then keeps two states and seals them in turns. */
static @name@_state state RETAINED;
static uint32_t steps RETAINED;
static uint32_t resets RETAINED;

/* Goes on after a reset, or begins. */
static void begin(void) {
    @name@_error found = @name@_check_state(&state);
    if (found == @NAME@_OK) {
        resets++;
        printf("reset %lu: the state is whole, going on after step %lu\n", (unsigned long)resets, (unsigned long)steps);
        return;
    }
    printf("begin: %s\n", @name@_error_name(found));
    (void)@name@_init(&state);
    steps = 0;
    resets = 0;
}

/* Between two values, there and back in 16 steps. */
static @name@_scalar swing(@name@_scalar lo, @name@_scalar hi) {
    uint32_t place = steps % 16;
    return lo + (hi - lo) * (@name@_scalar)(place < 8 ? place : 16 - place) / 8;
}

/* Your sensors. Here every input swings within its range, or within 0.1 of its default. */
static void read_sensors(@name@_inputs *inputs) {
@sensors@}

/* Your actuators. Here a line of what would be set; what an output may be off by is infinite where nothing is guaranteed. */
static void set_actuators(const @name@_outputs *outputs, const @name@_report *report) {
    printf("step %lu %s, %lu exchanges, bound %g\n", (unsigned long)steps, @name@_status_name(report->status),
           (unsigned long)report->exchanges, (double)report->bound);
@actuators@}

/* One step; 0 where it went well. */
static int step(void) {
    @name@_inputs inputs;
    @name@_outputs outputs;
    @name@_report report;
    @name@_error error;
    read_sensors(&inputs);
    @name@_clamp(&inputs);
    error = @name@_tick(&state, &inputs, &outputs, &report);
    if (error != @NAME@_OK) {
        /* The last answer still stands: leave the actuators as they are. */
        printf("refused: %s, %lu\n", @name@_error_name(error), (unsigned long)@name@_culprit(&state));
        return 1;
    }
    steps++;
    set_actuators(&outputs, &report);
    return @name@_seal_state(&state) == @NAME@_OK ? 0 : 1;
}

int main(void) {
    begin();
    board_start(PERIOD);
    while (steps < STEPS) {
        uint32_t came = board_wait();
        if (came > 1) {
            printf("%lu steps were missed\n", (unsigned long)(came - 1));
        }
        if (steps == HANGS_AT && resets == 0 && board_can_bite()) {
            printf("a fault: this step never ends\n");
            for (;;) {
            }
        }
        if (step() != 0) {
            board_end(1);
        }
        board_feed();
    }
    printf("done: %lu steps, %lu resets\n", (unsigned long)steps, (unsigned long)resets);
    return 0;
}

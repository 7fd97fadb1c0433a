/* The desk: time passes as fast as it can, and nothing resets. */
#include "board.h"

#include <stdlib.h>

void board_start(uint32_t period) {
    (void)period;
}

uint32_t board_wait(void) {
    return 1;
}

void board_feed(void) {
}

int board_can_bite(void) {
    return 0;
}

void board_end(int status) {
    exit(status);
}

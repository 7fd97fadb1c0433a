/* What the example asks of a board: a timer, a watchdog, memory that outlives a reset, and a console. */
#ifndef BOARD_H
#define BOARD_H

#include <stdint.h>

/* Memory that a reset leaves as it is. Its contents are any where power has been off. */
#define RETAINED @retained@

/* Starts the timer interrupt, which comes every so many microseconds, and the watchdog, which resets the board where it is not
 * fed for five times as long. */
void board_start(uint32_t period);

/* Sleeps until the timer interrupt has come; how many have come since the last call: more than 1 where steps were missed. */
uint32_t board_wait(void);

/* Feeds the watchdog. */
void board_feed(void);

/* Whether there is a watchdog that can be shown to bite. */
int board_can_bite(void);

/* The end of the emulation; 0 is success. */
void board_end(int status);

#endif

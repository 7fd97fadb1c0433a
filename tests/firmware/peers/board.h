/* The emulated board: its console, its end, its counter and its heap. */
#ifndef BOARD_H
#define BOARD_H

#include <stdint.h>

/* Prints on the debugger's console. */
void print(const char *text);

/* Ends the emulation; 0 is success. */
void end(int status) __attribute__((noreturn));

/* Starts the counter at 0. */
void restart(void);

/* Counts since then: 40 instructions each under `-icount shift=0`; UINT32_MAX where it went round. */
uint32_t elapsed(void);

/* Bytes that the heap has taken so far. */
uint32_t heap(void);

#endif

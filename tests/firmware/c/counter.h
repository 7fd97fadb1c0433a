/* A counter that counts every instruction under `-icount shift=0`. */
#ifndef COUNTER_H
#define COUNTER_H

#include <stdint.h>

/* TIM2 of the netduinoplus2, which QEMU runs at 1 GHz: registers as in `board/src/clock/tim2.rs`. */
#define TIM2 ((volatile uint32_t *)0x40000000)

static inline void start_counter(void) {
    TIM2[10] = 0;          /* PSC: every one */
    TIM2[11] = UINT32_MAX; /* ARR */
    TIM2[5] = 1;           /* EGR */
    TIM2[0] = 1;           /* CR1 */
}

static inline uint32_t counted(void) {
    return TIM2[9]; /* CNT */
}

#endif

/* QEMU's @machine@: a Cortex-M at @megahertz@ MHz, CMSDK timer and watchdog, and the debugger's console. */
#include "board.h"

#include <stddef.h>

extern char bss_start[], bss_end[], stack_top[];
extern int main(void);

static volatile uint32_t ticks;

/* Registers of CMSDK's timer 0 and watchdog. */
struct timer {
    uint32_t control, value, reload, clear;
};
struct watchdog {
    uint32_t load, value, control, clear;
};
#define TIMER ((volatile struct timer *)@timer@)
#define WATCHDOG ((volatile struct watchdog *)@watchdog@)
#define WATCHDOG_LOCK (*(volatile uint32_t *)(@watchdog@ + 0xC00))
#define ENABLE_INTERRUPTS (*(volatile uint32_t *)0xE000E100)
#define COPROCESSORS (*(volatile uint32_t *)0xE000ED88)

enum { PER_MICROSECOND = @megahertz@, TIMER_INTERRUPT = @timer-interrupt@ };

static void reset_handler(void) {
    /* The floating-point unit, where there is one: coprocessors 10 and 11. */
    COPROCESSORS |= 0xFu << 20;
    __asm__ volatile("dsb\n\tisb");
    for (char *at = bss_start; at < bss_end; at++) {
        *at = 0;
    }
    board_end(main());
}

static void fault_handler(void) {
    board_end(1);
}

static void timer_handler(void) {
    TIMER->clear = 1;
    ticks++;
}

/* The first time that the watchdog is not fed it asks; nobody answers, and the second time it resets. */
static void watchdog_handler(void) {
    for (;;) {
    }
}

typedef void (*handler)(void);
__attribute__((section(".vectors"), used)) static const handler vectors[16 + TIMER_INTERRUPT + 1] = {
    (handler)(uintptr_t)stack_top,
    reset_handler,
    watchdog_handler, /* not maskable */
    fault_handler,
    fault_handler,
    fault_handler,
    fault_handler,
    [16 + TIMER_INTERRUPT] = timer_handler,
};

void board_start(uint32_t period) {
    TIMER->reload = PER_MICROSECOND * period - 1;
    TIMER->value = PER_MICROSECOND * period - 1;
    TIMER->control = 9; /* on, with its interrupt */
    ENABLE_INTERRUPTS = 1u << TIMER_INTERRUPT;
    WATCHDOG_LOCK = 0x1ACCE551;
    WATCHDOG->load = PER_MICROSECOND * period * 5;
    WATCHDOG->control = 3; /* asks, then resets */
}

uint32_t board_wait(void) {
    uint32_t came;
    __asm__ volatile("cpsid i");
    while (ticks == 0) {
        /* Wakes although interrupts are masked: none is missed between the question and the sleep. */
        __asm__ volatile("wfi\n\tcpsie i\n\tcpsid i");
    }
    came = ticks;
    ticks = 0;
    __asm__ volatile("cpsie i");
    return came;
}

void board_feed(void) {
    WATCHDOG->clear = 1;
}

int board_can_bite(void) {
    return 1;
}

/* Semihosting: the debugger does what register 0 asks with what register 1 points to. */
static int ask(int what, const void *with) {
    register int operation __asm__("r0") = what;
    register const void *argument __asm__("r1") = with;
    __asm__ volatile("bkpt 0xAB" : "+r"(operation) : "r"(argument) : "memory");
    return operation;
}

void board_end(int status) {
    ask(0x18, (const void *)(uintptr_t)(status == 0 ? 0x20026u : 0x20023u)); /* SYS_EXIT */
    for (;;) {
    }
}

/* What newlib has no answer for by itself: a console, and a heap, which printf takes for its buffers. */
int _write(int file, const char *text, int length);
int _write(int file, const char *text, int length) {
    (void)file;
    for (int at = 0; at < length; at++) {
        ask(0x03, text + at); /* SYS_WRITEC */
    }
    return length;
}

void *_sbrk(ptrdiff_t bytes);
void *_sbrk(ptrdiff_t bytes) {
    static char heap[4096];
    static ptrdiff_t used;
    char *start = heap + used;
    if (used + bytes > (ptrdiff_t)sizeof heap) {
        return (void *)-1;
    }
    used += bytes;
    return start;
}

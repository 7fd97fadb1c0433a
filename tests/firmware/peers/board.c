#include "board.h"

#include <errno.h>
#include <stddef.h>

extern char bss_start[], bss_end[], heap_start[], stack_top[];
extern int main(void);

static char *heap_end = heap_start;

void reset(void) {
    /* Full access to the floating-point unit: coprocessors 10 and 11 of CPACR. */
    *(volatile uint32_t *)0xE000ED88 |= 0xFu << 20;
    __asm volatile("dsb\nisb");
    for (char *at = bss_start; at < bss_end; at++) {
        *at = 0;
    }
    end(main());
}

static void fault(void) {
    end(1);
}

__attribute__((section(".vectors"), used)) static void *const vectors[16] = {
    stack_top, (void *)reset, (void *)fault, (void *)fault, (void *)fault, (void *)fault, (void *)fault,
};

/* Semihosting: the debugger does what register 0 asks with what register 1 points to. */
static int ask(int what, const void *with) {
    register int operation __asm("r0") = what;
    register const void *argument __asm("r1") = with;
    __asm volatile("bkpt 0xAB" : "+r"(operation) : "r"(argument) : "memory");
    return operation;
}

void print(const char *text) {
    ask(0x04, text); /* SYS_WRITE0 */
}

void end(int status) {
    ask(0x18, (void *)(status == 0 ? 0x20026 : 0x20023)); /* SYS_EXIT: application exit, run-time error */
    for (;;) {
    }
}

/* SysTick: control and status, reload value, current value. */
static volatile uint32_t *const SYSTICK = (volatile uint32_t *)0xE000E010;
enum { CONTROL, RELOAD, CURRENT };
static const uint32_t LAST = 0xFFFFFF;

void restart(void) {
    SYSTICK[RELOAD] = LAST;
    SYSTICK[CONTROL] = 5; /* the core's clock, on */
    SYSTICK[CURRENT] = 0; /* any write; takes effect with the next count */
    while (SYSTICK[CURRENT] == 0) {
    }
    (void)SYSTICK[CONTROL]; /* forgets that it went round */
}

uint32_t elapsed(void) {
    uint32_t counts = LAST - SYSTICK[CURRENT];
    return SYSTICK[CONTROL] & 1u << 16 ? UINT32_MAX : counts;
}

/* The heap's growth, as newlib's malloc asks for it. */
void *_sbrk(ptrdiff_t bytes) {
    char *start = heap_end;
    if (heap_end + bytes > stack_top - 65536) {
        errno = ENOMEM;
        return (void *)-1;
    }
    heap_end += bytes;
    return start;
}

uint32_t heap(void) {
    return (uint32_t)(heap_end - heap_start);
}

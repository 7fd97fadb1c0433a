/* What is tried on the controllers of one program, each by functions of its own. */
#ifndef CHECKS_H
#define CHECKS_H

#include <stddef.h>
#include <stdint.h>

/* A controller, whatever scene it is of. */
struct controller {
    const char *name;
    /* Bytes of a state. */
    size_t size;
    int32_t (*init)(void *state);
    int32_t (*check)(const void *state);
    int32_t (*seal)(void *state);
    int32_t (*reset)(void *state);
    /* With default inputs. */
    int32_t (*tick)(void *state);
    /* Everything that needs no other controller. */
    void (*run)(void);
};

/* The numbers that all headers share. */
enum { OK = 0, NULL_POINTER = 1, FOREIGN = 2, UNSEALED = 3, DAMAGED = 4, OUT_OF_RANGE = 5, NOT_FINITE = 6, OUT_OF_TIME = 4, OUT_OF_SWEEPS = 3 };

/* Says where it went wrong, and remembers. */
#define CHECK(what) checked((what), __FILE__, __LINE__, #what)
void checked(int is_right, const char *file, int line, const char *what);

/* Bytes of no meaning, the same every time. */
void fill(void *bytes, size_t size, uint32_t seed);

#endif

/* The inputs of every tick: those of a log, or those of `scene/src/loads.rs` in the same arithmetic. */
#ifndef LOADS_H
#define LOADS_H

#include "scene.h"

/* Ticks that are played. */
#ifndef TICKS
#define TICKS 101
#endif

/* The inputs of the next tick; the first has the defaults. */
void next_inputs(NAMED(inputs) *inputs);

/* The next tick is the first again. */
void first_inputs(void);

#endif

/* Lines of a name and a number, bit for bit as `board/src/journal.rs` has them. */
#ifndef JOURNAL_H
#define JOURNAL_H

#include <stdint.h>

#include "scene.h"

/* A line of text. */
void tell(const char *text);

/* A count, in decimal digits. */
void tell_count(const char *name, uint32_t count);

/* The bits of a scalar. */
void tell_scalar(const char *name, scalar value);

#endif

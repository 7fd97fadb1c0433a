#include "journal.h"

#include <string.h>

#include "board.h"

static char line[160];

static void begin(const char *text) {
    line[0] = 0;
    strncat(line, text, 100);
}

static void put(char character) {
    size_t end = strlen(line);
    line[end] = character;
    line[end + 1] = 0;
}

static void finish(void) {
    put('\n');
    print(line);
}

static void digits(uint32_t bits) {
    for (int shift = 28; shift >= 0; shift -= 4) {
        put("0123456789abcdef"[bits >> shift & 15]);
    }
}

void tell(const char *text) {
    begin(text);
    finish();
}

void tell_count(const char *name, uint32_t count) {
    uint32_t power = 1;
    begin(name);
    put(' ');
    while (count / power > 9) {
        power *= 10;
    }
    for (; power > 0; power /= 10) {
        put((char)('0' + count / power % 10));
    }
    finish();
}

void tell_scalar(const char *name, scalar value) {
    uint32_t words[sizeof value / 4];
    memcpy(words, &value, sizeof value);
    begin(name);
    strcat(line, sizeof value == 4 ? " f32 " : " f64 ");
    /* The boards and the desk keep the low word first. */
    for (size_t word = sizeof value / 4; word > 0; word--) {
        digits(words[word - 1]);
    }
    finish();
}

/* Several controllers in one program: each by itself, then what one makes of the states of another. */
#include <string.h>

#include "board.h"
#include "checks.h"

extern const struct controller levee_controller, levee_double_controller, levee_full_controller, levee_swept_controller,
    slab_controller, words_controller, antiicing_warm_controller;
static const struct controller *const all[] = {
    &levee_controller, &levee_double_controller, &levee_full_controller, &levee_swept_controller,
    &slab_controller, &words_controller, &antiicing_warm_controller,
};
enum { ALL = sizeof all / sizeof *all, LARGEST = 1 << 18 };

static int wrong;
static uint64_t bytes[LARGEST / 8], before[LARGEST / 8];

void checked(int is_right, const char *file, int line, const char *what) {
    char digits[12] = "          \n";
    if (is_right) {
        return;
    }
    wrong++;
    for (int at = 9; line > 0; at--, line /= 10) {
        digits[at] = (char)('0' + line % 10);
    }
    print(file);
    print(": ");
    print(what);
    print(digits);
}

void fill(void *to, size_t size, uint32_t seed) {
    unsigned char *at = (unsigned char *)to;
    while (size-- > 0) {
        seed = seed * 1664525u + 1013904223u;
        *at++ = (unsigned char)(seed >> 24);
    }
}

/* Refused whatever is asked, and left alone. */
static void refused(const struct controller *by) {
    memcpy(before, bytes, sizeof before);
    CHECK(by->check(bytes) == FOREIGN && by->tick(bytes) == FOREIGN);
    CHECK(by->seal(bytes) == FOREIGN && by->reset(bytes) == FOREIGN);
    CHECK(memcmp(before, bytes, sizeof before) == 0);
}

static void foreign(const struct controller *by) {
    for (int of = 0; of < ALL; of++) {
        if (all[of] != by) {
            memset(bytes, 0, sizeof bytes);
            CHECK(all[of]->init(bytes) == OK && all[of]->tick(bytes) == OK && all[of]->seal(bytes) == OK);
            refused(by);
        }
    }
    memset(bytes, 0, sizeof bytes);
    refused(by);
    memset(bytes, 0xff, sizeof bytes);
    refused(by);
    for (uint32_t seed = 1; seed < 5; seed++) {
        fill(bytes, sizeof bytes, seed);
        refused(by);
    }
}

int main(void) {
    for (int at = 0; at < ALL; at++) {
        int known = wrong;
        CHECK(all[at]->size <= sizeof bytes);
        all[at]->run();
        foreign(all[at]);
        print(all[at]->name);
        print(wrong == known ? ": as it should\n" : ": not as it should\n");
    }
    return wrong == 0 ? 0 : 1;
}

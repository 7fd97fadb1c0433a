/* Ticks with random inputs. Each line: counts of the clock, the bits of x.
 *
 *   @ heap 4096                    bytes that the set-up took
 *   215 3f800000 00000000 ...      40 instructions a count; from f to x, the load's sum left out
 */
#include <string.h>

#include "board.h"
#include "peer.h"
#include "problem.h"
#include "quadratic.h"

enum { TICKS = 1000 };

static float p[M], f[N], x[N];

/* Uniform in [-1, 1): xorshift32 and its upper 24 bits. The same bits come from the board's `draw.rs`. */
static float draw(void) {
    static uint32_t state = 0x2545F491;
    state ^= state << 13;
    state ^= state >> 17;
    state ^= state << 5;
    return (float)((int32_t)(state >> 8) - (1 << 23)) * 0x1p-23f;
}

/* f = sum over j of p_j times column j. */
static void load(void) {
    memset(f, 0, sizeof f);
    for (int j = 0; j < M; j++) {
        for (int i = 0; i < N; i++) {
            f[i] += p[j] * F[j * N + i];
        }
    }
}

static char *decimal(char *at, uint32_t number) {
    char digits[10];
    int count = 0;
    do {
        digits[count++] = (char)('0' + number % 10);
        number /= 10;
    } while (number > 0);
    while (count > 0) {
        *at++ = digits[--count];
    }
    return at;
}

static char *hexadecimal(char *at, float number) {
    uint32_t bits;
    memcpy(&bits, &number, sizeof bits);
    for (int shift = 28; shift >= 0; shift -= 4) {
        *at++ = "0123456789abcdef"[bits >> shift & 15];
    }
    return at;
}

static void report(uint32_t counts) {
    static char line[16 + 9 * N];
    char *at = decimal(line, counts);
    for (int i = 0; i < N; i++) {
        *at++ = ' ';
        at = hexadecimal(at, x[i]);
    }
    memcpy(at, "\n", 2);
    print(line);
}

int main(void) {
    if (set_up() != 0) {
        print("the set-up fails\n");
        return 1;
    }
    char line[32] = "@ heap ";
    memcpy(decimal(line + strlen(line), heap()), "\n", 2);
    print(line);
    /* Not counted: a controller starts once, at its default inputs. */
    memcpy(p, DEFAULTS, sizeof p);
    load();
    int failed = solve(f, x);
    for (int k = 0; k < TICKS && !failed; k++) {
        for (int j = 1; j < M; j++) {
            p[j] = draw();
        }
        load();
        restart();
        failed = solve(f, x);
        uint32_t counts = elapsed();
        report(counts);
    }
    if (failed) {
        print("a tick fails\n");
    }
    return failed;
}

"""The condensed problem that all solvers are given, in f64: what the peers need of it, and what they should have found.

    problem.py write PROBLEM.h QUADRATIC.h   the bounded quadratic problem as a C header; prints N, and 1 where fluxes have limits
    problem.py judge PROBLEM.h ANSWERS       x of every tick, a line each; prints the largest error and violation
    problem.py check                         problems of two edges, solved by hand

A condensed problem has S x - B p = w, p_0 = 1, the other p_j random in [-1, 1), and m of each edge, infinite without a limit:

    x > 0:  w = min(0, m)      x = 0:  w between      x < 0:  w = max(0, m)

It is solved by a primal-dual active set. An edge whose x has not the sign of its side touches next; one that touches with a w
outside goes to the side of the end that it has passed. When nothing changes any more all conditions hold, whatever path led
there. The peers are given

    minimise 1/2 z'H z - (F p)'z   over least <= z <= most
    no limits:  z = x              H = S      F = B          0 <= z
    limits:     z = w = Sx - B p   H = S^-1   F = -S^-1 B    min(0, m) <= z <= max(0, m)

With limits x has either sign, and its cost has a kink at 0, which no peer takes. The dual has none, and as many unknowns:
S^-1 (z + B p) = x is its gradient, and x != 0 is a multiplier, with the other sign. The peers are given S^-1 and S^-1 B, which
costs their ticks nothing.
"""

import re
import sys

import numpy

ACROSS = 8  # numbers a line


class Problem:
    """A header: f32 entries, taken as exact."""

    def __init__(self, text):
        self.size = int(re.search(r"#define N (\d+)", text)[1])
        self.matrix, self.loads = rows(text, "S", self.size), rows(text, "B", self.size)
        spans = rows(text, "SPANS", self.size)
        self.is_limited = len(spans) > 0
        if len(self.matrix) != self.size or len(self.loads) == 0:
            raise ValueError("no condensed problem")
        # Only what does not change is a bound that peers are set up with.
        if numpy.any(spans[1:] != 0):
            raise ValueError("inputs change a limit")
        most = spans[0] if self.is_limited else numpy.full(self.size, numpy.inf)
        self.least, self.most = numpy.minimum(most, 0.0), numpy.maximum(most, 0.0)

    def solve(self, b, sides):
        """The solution, found from these sides (1, 0, -1 as the sign of x), which are left as they are in the end."""
        for _ in range(100):
            free = numpy.flatnonzero(sides)
            load = b + numpy.where(sides < 0, self.most, self.least)
            x = numpy.zeros(self.size)
            x[free] = numpy.linalg.solve(self.matrix[numpy.ix_(free, free)], load[free])
            w = self.matrix @ x - b
            after = numpy.where(sides * x < 0, 0, sides)
            after[(sides == 0) & (w < self.least)] = 1
            after[(sides == 0) & (w > self.most)] = -1
            if numpy.array_equal(after, sides):
                return x
            sides[:] = after
        raise ValueError("the reference finds no active set")

    def violation(self, x, w):
        """w - P(w - x) of each edge, P the nearest w that is allowed: min(x, w) without limits."""
        outside = numpy.where(w - x > self.most, w - self.most, x)
        return numpy.where(w - x < self.least, w - self.least, outside)

    def deviation(self, answers):
        """max |x - x*| and the largest violation of the answers to all ticks, both relative to max |x*| of the tick."""
        draws, sides = draw(), numpy.zeros(self.size, dtype=int)
        error = violation = 0.0
        for x in answers:
            inputs = [1.0] + [next(draws) for _ in self.loads[1:]]
            b = numpy.array(inputs) @ self.loads
            exact = self.solve(b, sides)
            if len(x) != self.size or not numpy.all(numpy.isfinite(x)):
                raise ValueError("an answer is not finite or of another size")
            scale = max(numpy.max(numpy.abs(exact)), numpy.finfo(float).tiny)
            error = max(error, numpy.max(numpy.abs(x - exact)) / scale)
            off = self.violation(x, self.matrix @ x - b)
            violation = max(violation, numpy.max(numpy.abs(off)) / scale)
        return error, violation

    def quadratic(self):
        """The header for the peers."""
        matrix, loads = self.matrix, self.loads
        if self.is_limited:
            lower = numpy.tril(numpy.linalg.inv(matrix))
            # The lower triangle on both sides: rounding has made them differ.
            matrix, loads = lower + numpy.tril(lower, -1).T, -numpy.linalg.solve(matrix, loads.T).T
        arrays = [("H", "N * N", matrix), ("F", "N * M", loads), ("LEAST", "N", self.least), ("MOST", "N", self.most)]
        text = f"#include <math.h>\n#define IS_DUAL {int(self.is_limited)}\n"
        return text + "".join(array(name, size, numbers.ravel()) for name, size, numbers in arrays)


def rows(text, name, size):
    """Rows of so many numbers of an array in the header; none where there is no such array."""
    found = re.search(rf"float {name}\[[^{{]*\{{(.*?)\}}", text, re.DOTALL)
    entries = [entry.strip() for entry in found[1].split(",")] if found else []
    numbers = [float(entry.removesuffix("f")) for entry in entries if entry]
    return numpy.array(numbers, dtype=numpy.float32).astype(float).reshape(-1, size)


def array(name, size, numbers):
    """As C has it."""
    words = [number(x) for x in numbers]
    lines = [", ".join(words[at : at + ACROSS]) for at in range(0, len(words), ACROSS)]
    return f"static const float {name}[{size}] = {{\n" + ",\n".join(lines) + "};\n"


def number(x):
    return f"{numpy.float32(x)!s}f" if numpy.isfinite(x) else "-INFINITY" if x < 0 else "INFINITY"


def draw():
    """The images' random inputs: xorshift32 and its upper 24 bits, in [-1, 1)."""
    state = 0x2545F491
    while True:
        state ^= state << 13 & 0xFFFFFFFF
        state ^= state >> 17
        state ^= state << 5 & 0xFFFFFFFF
        yield (state >> 8) / (1 << 23) - 1.0


def check():
    """S = (1, -1/2; -1/2, 1) without limits, and with m = (1/2, infinity)."""
    plain = "#define N 2 /* edges */\nfloat S[N*N] = {1.0f, -0.5f,\n -0.5f, 1.0f};\nfloat B[M*N] = {1.0f, -2.0f,};\n"
    limits = plain + "float SPANS[M*N] = {0.5f, INFINITY};\n"
    problem, limited = Problem(plain), Problem(limits)
    for start in ([1, 1], [0, 0]):
        # One edge opens and one stays: S x - b = (0, 1.5); without contact the second would be -2. Both open.
        for of, b, x in [
            (problem, [1.0, -2.0], [1.0, 0.0]),
            (problem, [1.0, 1.0], [2.0, 2.0]),
            # w_1 = 2 with x = 0 is more than 1/2: x_1 - x_2 / 2 = -2 + 1/2, and the second edge touches with w_2 = 2 + 3/4.
            (limited, [-2.0, -2.0], [-1.5, 0.0]),
            # x_2 = 1 pulls w_1 down to -1/2 - b_1 = 1/4.
            (limited, [-0.75, 1.0], [0.0, 1.0]),
        ]:
            assert numpy.allclose(of.solve(numpy.array(b), numpy.array(start)), x, rtol=1e-15, atol=0), (b, x)
    assert problem.deviation([numpy.array([1.0, 0.0])]) == (0.0, 0.0)
    assert problem.deviation([numpy.array([0.75, -0.25])]) == (0.25, 0.25)
    # Open, at the limit, touching: all conditions hold. Then open with a flux, below the gap with less than the limit, touching
    # with more, and with less than none; the other edge is far below its gap.
    for x, w, off in [
        (1.0, 0.0, 0.0), (-1.0, 0.5, 0.0), (0.0, 0.25, 0.0),
        (1.0, 0.25, 0.25), (-1.0, 0.25, -0.25), (0.0, 0.75, 0.25), (0.0, -0.25, -0.25),
    ]:
        assert list(limited.violation(numpy.array([x, -1.0]), numpy.array([w, 8.0]))) == [off, -1.0], (x, w)
    refused(limits.replace("INFINITY}", "INFINITY, 0.0f, 0.5f}"), "inputs change a limit")
    Problem(limits.replace("INFINITY}", "INFINITY, 0.0f, 0.0f}"))
    refused(plain.replace("N 2", "N 3"), "reshape")
    refused(plain.replace("1.0f", "one"), "one")
    refused("#define N 2", "no condensed problem")
    assert "H[N * N] = {\n1.0f, -0.5f, -0.5f, 1.0f}" in problem.quadratic()
    assert "LEAST[N] = {\n0.0f, 0.0f}" in problem.quadratic() and "MOST[N] = {\nINFINITY, INFINITY}" in problem.quadratic()
    # S = (2, -1; -1, 1) with the inverse (1, 1; 1, 2).
    dual = "#define N 2\nfloat S[4] = {2.0f, -1.0f, -1.0f, 1.0f};\nfloat B[2] = {1.0f, -3.0f};\nfloat SPANS[2] = {0.5f, -INFINITY};\n"
    dual = Problem(dual).quadratic()
    for name, numbers in [("H", [1, 1, 1, 2]), ("F", [2, 5]), ("LEAST", [0, -numpy.inf]), ("MOST", [0.5, 0])]:
        assert numpy.array_equal(rows(dual, name, len(numbers))[0], numbers), (name, dual)


def refused(text, why):
    try:
        Problem(text)
    except ValueError as error:
        assert why in str(error), error
    else:
        raise AssertionError(f"not refused: {why}")


def main(verb, header=None, file=None):
    if verb == "check":
        return check()
    with open(header, encoding="utf-8") as read:
        problem = Problem(read.read())
    if verb == "write":
        with open(file, "w", encoding="utf-8") as written:
            written.write(problem.quadratic())
        print(problem.size, int(problem.is_limited))
    else:
        with open(file, encoding="utf-8") as read:
            answers = (numpy.array(line.split(), dtype=numpy.float32) for line in read)
            print(*problem.deviation(x.astype(float) for x in answers))


main(*sys.argv[1:])

/* A solver of: minimise z'Hz/2 - f'z over LEAST <= z <= MOST, with the data of `quadratic.h`.
 *
 * x is z, or where IS_DUAL the gradient Hz - f: it is 0 wherever no bound holds z, and else a multiplier. */
#ifndef PEER_H
#define PEER_H

/* All that may be done once; 0 where it succeeds. */
int set_up(void);

/* One tick, from the load f to x, starting where the last one ended; 0 where it succeeds. */
int solve(const float *f, float *x);

#endif

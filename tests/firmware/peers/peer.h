/* A solver of: minimise x'Sx/2 - b'x over x >= 0, with the S of `problem.h`. */
#ifndef PEER_H
#define PEER_H

/* All that may be done once; 0 where it succeeds. */
int set_up(void);

/* One tick, from the load b to the solution x, starting where the last one ended; 0 where it succeeds. */
int solve(const float *b, float *x);

#endif

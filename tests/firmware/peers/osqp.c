/* OSQP's embedded code, generated and factored on the host: a tick gives it another linear term. */
#include "osqp.h"
#include "peer.h"
#include "problem.h"
#include "quadratic.h"
#include "workspace.h"

int set_up(void) {
    return 0;
}

int solve(const float *f, float *x) {
    OSQPFloat q[N];
    for (int i = 0; i < N; i++) {
        q[i] = -f[i];
    }
    if (osqp_update_data_vec(&solver, q, OSQP_NULL, OSQP_NULL) != 0 || osqp_solve(&solver) != 0) {
        return 1;
    }
    for (int i = 0; i < N; i++) {
        /* Its multipliers are above 0 at upper bounds. */
        x[i] = IS_DUAL ? -solver.solution->y[i] : solver.solution->x[i];
    }
    return solver.info->status_val != OSQP_SOLVED;
}

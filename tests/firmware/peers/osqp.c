/* OSQP's embedded code, generated and factored on the host: a tick gives it another linear term. */
#include "osqp.h"
#include "peer.h"
#include "problem.h"
#include "workspace.h"

int set_up(void) {
    return 0;
}

int solve(const float *b, float *x) {
    OSQPFloat q[N];
    for (int i = 0; i < N; i++) {
        q[i] = -b[i];
    }
    if (osqp_update_data_vec(&solver, q, OSQP_NULL, OSQP_NULL) != 0 || osqp_solve(&solver) != 0) {
        return 1;
    }
    for (int i = 0; i < N; i++) {
        x[i] = solver.solution->x[i];
    }
    return solver.info->status_val != OSQP_SOLVED;
}

/* DAQP, set up once: a tick gives it another linear term and starts from its last working set. */
#include <stddef.h>

#include "api.h"
#include "peer.h"
#include "problem.h"
#include "quadratic.h"
#include "utils.h"

static c_float linear[N], upper[N], lower[N];
static DAQPProblem problem = {
    .n = N, .m = N, .ms = N, .H = (c_float *)H, .f = linear, .bupper = upper, .blower = lower,
};
static DAQPSettings settings;
static DAQPWorkspace workspace = {.settings = &settings};
static DAQPResult result; /* multipliers where x is made of them */
#if IS_DUAL
static c_float z[N];
#endif

int set_up(void) {
    for (int i = 0; i < N; i++) {
        lower[i] = fmaxf(LEAST[i], -DAQP_INF);
        upper[i] = fminf(MOST[i], DAQP_INF);
    }
    daqp_default_settings(&settings);
    /* The defaults are made for f64 and below the rounding of f32. Up to 1e-4 the counts stay. */
    settings.primal_tol = 1e-5f;
    settings.dual_tol = 1e-6f;
    settings.zero_tol = 1e-7f;
    settings.pivot_tol = 1e-4f;
    settings.sing_tol = 1e-7f;
    settings.refactor_tol = 1e-7f;
    settings.progress_tol = 1e-7f;
    return setup_daqp(&problem, &workspace, NULL) < 0;
}

int solve(const float *f, float *x) {
    for (int i = 0; i < N; i++) {
        linear[i] = -f[i];
    }
    if (update_ldp(UPDATE_v, &workspace, &problem) < 0) {
        return 1;
    }
#if IS_DUAL
    result.x = z;
    result.lam = x;
#else
    result.x = x;
#endif
    daqp_solve(&result, &workspace);
#if IS_DUAL
    /* Its multipliers are above 0 at upper bounds. */
    for (int i = 0; i < N; i++) {
        x[i] = -x[i];
    }
#endif
    return result.exitflag != EXIT_OPTIMAL;
}

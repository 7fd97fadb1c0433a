/* The headers of two controllers, each twice, in whatever C or C++ it is compiled as. */
#include "levee.h"
#include "slab.h"

#include "levee.h"
#include "slab.h"

#ifdef __cplusplus
extern "C" {
#endif
int both(void);
#ifdef __cplusplus
}
#endif

static levee_state levee;
static slab_state slab;

static uint32_t never(void *context) {
    (void)context;
    return 0;
}

/* Something of everything. */
int both(void) {
    levee_inputs inputs = levee_default_inputs;
    levee_outputs outputs, least, most;
    levee_report report;
    levee_limits limits;
    levee_deadline deadline;
    slab_inputs air = slab_most_inputs;
    slab_outputs power;
    limits.error = 0;
    limits.share = 0;
    limits.sweeps = LEVEE_STATE_BYTES;
    deadline.remaining = never;
    deadline.context = &levee;
    deadline.sweep = LEVEE_INPUTS;
    deadline.certificate = LEVEE_OUTPUTS;
    levee_clamp(&inputs);
    if (levee_init(&levee) != LEVEE_OK || slab_init(&slab) != SLAB_OK) {
        return 1;
    }
    if (levee_tick(&levee, &inputs, &outputs, &report) != LEVEE_OK || report.status != LEVEE_EXACT) {
        return levee_error_name(LEVEE_OVERFLOW)[0] + levee_status_name(report.status)[0];
    }
    if (levee_between(&levee, &outputs, 0, 0, 0) != LEVEE_NULL_POINTER || levee_between(&levee, &outputs, &report, &least, &most) != LEVEE_OK
        || !(least.seepage < most.seepage && least.wet < outputs.wet)
        || !(most.seepage - least.seepage < report.plus_minus.seepage)) {
        return 6;
    }
    if (levee_tick_within(&levee, &inputs, &limits, &deadline, &outputs, &report) != LEVEE_OK) {
        return levee_bounded_name(report.bounded)[0] + (levee_culprit(&levee) == 0 ? 4 : 5);
    }
    if (slab_tick(&slab, &air, &power, 0) != SLAB_OK || slab_seal_state(&slab) != SLAB_OK) {
        return 2;
    }
    return levee_check_state(&levee) == LEVEE_UNSEALED_STATE && levee_reset(&levee) == LEVEE_OK ? 0 : 3;
}

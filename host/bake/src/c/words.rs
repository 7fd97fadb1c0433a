//! What stands in every header, whatever the scene: `NAME` and `name_` become the scene's name.

pub(super) const SYMBOLS: &str = "On contact edges u is at least the gap ψ and the flux σ·n is at least q; one of both holds as an equation. Where the flux \
                       has a limit u may fall below ψ. The error bound is in the energy norm, in which the errors of u and σ are \
                       weighed together; plus_minus is in the unit of each output.";

pub(super) const USE: &str = "Memory is the caller's: one name_state for each controller of this kind that runs, however many. Nothing is \
                   allocated, nothing is static, and no function blocks. Calls with different states may run at the same time; \
                   two calls with one state may not, so that an interrupt must not tick a state in the middle of its tick.";

/// An assertion of the compiler, with whatever the language has for it.
pub(super) const ASSERT: &str = "
#if defined(__cplusplus) && __cplusplus >= 201103L
#define NAME_ASSERT(what, why) static_assert(what, #why)
#elif !defined(__cplusplus) && defined(__STDC_VERSION__) && __STDC_VERSION__ >= 201112L
#define NAME_ASSERT(what, why) _Static_assert(what, #why)
#else
#define NAME_ASSERT(what, why) typedef char name_##why[(what) ? 1 : -1]
#endif

#ifdef __cplusplus
extern \"C\" {
#endif

";

pub(super) const REPORT: &str = "
/* What a tick came to. Where there is no bound, all numbers below `pulled` are infinite, but `distance`. */
typedef struct name_report {
    /* What ended the tick. */
    name_status status;
    /* Whether there is a bound, or why there is none. */
    name_bounded bounded;
    /* Edges that changed sides, one by one, on the way to the exact solution. */
    uint32_t exchanges;
    /* Sweeps; 0 where the exact method came to its end. */
    uint32_t sweeps;
    /* Contact edges that touch. */
    uint32_t active;
    /* The edge that would be pulled at, where `bounded` says so; else 0. */
    uint32_t pulled;
    /* The error in the energy norm is at most this. */
    name_scalar bound;
    /* Parts of it: the duality gap (no gap of the scene), what more sweeps would remove, data between the points, rounding. */
    name_scalar gap;
    name_scalar algebraic;
    name_scalar oscillation;
    name_scalar rounding;
    /* A bound on the error of the edge means, in the energy norm cell by cell. */
    name_scalar of_u;
    /* How far apart the two fluxes are at least that the bound compares; 0 where nothing is said of it. */
    name_scalar distance;
";

pub(super) const PLUS_MINUS: &str = "    /* How far each output may be from its value for the exact solution, in its own unit; infinite where nothing is
     * guaranteed. */
    name_outputs plus_minus;
";

pub(super) const STATE: &str = "
/* The memory of one controller. It depends on no address: it may be copied, kept over a reset, put elsewhere, or written to a file.
 * Bytes between its fields may be any, so that two states that are alike may differ in them.
 * To keep one: name_seal_state, then take its bytes. To go on with it: put the bytes back, name_check_state, tick.
 * A tick trusts its state. Where memory may have been damaged, check first: a tick on damaged bytes may answer wrongly, though it reads
 * and writes nowhere else. */
";

pub(super) const SAVED: &str = "
/* What one tick hands on to the next, sealed: less than a state, and good for another controller of the same scene, too, in Rust or
 * in C. It depends on no address, and goes with its bytes. */
";

pub(super) const MARKS: &str = "
/* The names in the library: a program with the header of one bake and the library of another does not link. */
";

pub(super) const FUNCTIONS: &str = "
/* Makes a state: before the first tick, and sealed. */
name_error name_init(name_state *state);

/* Answers for these inputs, from where the last tick ended. `outputs` and `report` may be null. Where a tick is refused neither
 * changes and the next one begins where the last answer did; name_culprit tells which input it was for. A state that is refused
 * an input stays sealed. NAME_OK says that there is an
 * answer; how good it is, say `status` and `bounded` of the report. */
name_error name_tick(name_state *state, const name_inputs *inputs, name_outputs *outputs, name_report *report);

/* When a tick ends, where it has sweeps: the exact method of a condensed model needs no limits. */
typedef struct name_limits {
    /* The error bound that is small enough; 0 leaves it to the others. */
    name_scalar error;
    /* What the algebraic part may be of the whole; 0 leaves it to the others. */
    name_scalar share;
    /* Most sweeps. */
    uint32_t sweeps;
} name_limits;

/* Time left, in a unit of the caller's. A step is begun only while there is time for it and a certificate after it. */
typedef struct name_deadline {
    /* Time left now; called with `context`. Null: there is no deadline. */
    uint32_t (*remaining)(void *context);
    void *context;
    /* Most that a sweep or an exchange takes, and most that the certificate takes. */
    uint32_t sweep;
    uint32_t certificate;
} name_deadline;

/* The same with limits and until a deadline; null is: the library's own limits, no deadline. Whatever ends the tick, the answer
 * is feasible and the report says how wrong it can be. It has code and constants of its own: a program that calls this tick alone,
 * or the other alone, has them in flash once. */
name_error name_tick_within(name_state *state, const name_inputs *inputs, const name_limits *limits,
                            const name_deadline *deadline, name_outputs *outputs, name_report *report);

/* Between which values each output lies for the exact solution, in its own unit, where `outputs` and `report` are those of the last
 * tick of this state; infinite where nothing is guaranteed. It is narrower than plus_minus, which knows the bound alone, and takes a
 * few products for each number of a condensed model. `least` and `most` may be null. */
name_error name_between(const name_state *state, const name_outputs *outputs, const name_report *report,
                        name_outputs *least, name_outputs *most);

/* Forgets all ticks: the next one is the first again, and a step in time begins from the start. The state is sealed. */
name_error name_reset(name_state *state);

/* Puts the checksum into a state, so that name_check_state can tell it from any other bytes. A tick breaks the seal. */
name_error name_seal_state(name_state *state);

/* NAME_OK where the bytes are those of a state that was sealed, by a library of this scene, model and version: else
 * NAME_FOREIGN_STATE, NAME_UNSEALED_STATE or NAME_DAMAGED_STATE. It may be asked of any bytes. */
name_error name_check_state(const name_state *state);

/* The number of what the last refused tick was refused for, as the error says; inputs count from 0 in the order of their struct. */
uint32_t name_culprit(const name_state *state);

/* Moves inputs to the nearest values within their ranges, for a caller who wants no refusal. What is not a number
 * stays so, and is refused. */
void name_clamp(name_inputs *inputs);

/* The words behind NAME_ above. */
const char *name_error_name(name_error error);
const char *name_status_name(name_status status);
const char *name_bounded_name(name_bounded bounded);
";

pub(super) const IN_TIME: &str = "
/* Puts what the next tick takes from the last one into `saved`. Before the first tick that is the start. */
name_error name_save(const name_state *state, name_saved *saved);

/* Goes on from there, with the bits that the controller would have had that was saved, in the bound of the evolution too. The state,
 * which name_init has made, is sealed then. NAME_FOREIGN_STATE says that `saved` is one of another scene, or any other bytes, and
 * NAME_DAMAGED_STATE that its bytes have changed: then the state has not, and goes on as if nobody had asked. */
name_error name_restore(name_state *state, const name_saved *saved);

/* The bound of the evolution from the start until the end of the last tick, in the unit of the report's: the mean over time of
 * the square of the energy error of u is at most energy * energy. Its weights fade into the past, and reach back `seconds`. Both
 * are infinite where there is no such bound. Either may be null. */
name_error name_window(const name_state *state, name_scalar *energy, name_scalar *seconds);
";

pub(super) const INPUT_VALUES: &str = "
/* The values that the scene gives, and the ends of the ranges, infinite where there are none. */
extern const name_inputs name_default_inputs;
extern const name_inputs name_least_inputs;
extern const name_inputs name_most_inputs;
";

pub(super) const CLOSING: &str = "
#ifdef __cplusplus
}
#endif

#endif
";

/* The names of a controller's header, whatever scene it is of: compiled with -DSCENE=levee -DCONSTANTS=LEVEE -include levee.h. */
#ifndef SCENE_H
#define SCENE_H

#define JOINED(scene, own) scene##_##own
#define JOINED_NAMES(scene, own) JOINED(scene, own)

/* A type, function or constant of the scene: NAMED(tick) is levee_tick. */
#define NAMED(own) JOINED_NAMES(SCENE, own)
/* A macro or a number with a name: CODE(OK) is LEVEE_OK. */
#define CODE(own) JOINED_NAMES(CONSTANTS, own)

typedef NAMED(scalar) scalar;

/* Inputs and outputs as arrays, which have a place even where there is nothing in them. */
enum { INPUTS = CODE(INPUTS), OUTPUTS = CODE(OUTPUTS) };
typedef scalar input_values[CODE(INPUTS) + 1];
typedef scalar output_values[CODE(OUTPUTS) + 1];

#endif

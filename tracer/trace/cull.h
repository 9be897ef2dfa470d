#ifndef WF_TRACER_TRACE_CULL_H
#define WF_TRACER_TRACE_CULL_H

#include "tracer/trace/bounds.h"

/* What a shaft of rays can meet: parts, each with what is left of its program when the solids
 * that the shaft cannot reach are taken out. That is a proof, not a guess: outside a solid's
 * bounds its place in the program is empty, and emptiness goes up through the operations. */

/* A part of the picture: an object, or an operand of its outermost unions. */
typedef struct wf_part {
    int object, first_step, step_count;
    bool moves;
} wf_part;

typedef struct wf_culled {
    int part;
    double near;        /* no ray meets it before this s */
    size_t step, solid; /* where its steps and solids begin in the list's */
    int step_count, solid_count;
} wf_culled;

/* A list of culled parts, whose steps of kind WF_STEP_SOLID count that part's solids. */
typedef struct wf_culls {
    wf_culled *part;
    wf_step *step;
    int *solid; /* the scene's solids */
    size_t part_count, part_capacity, step_count, step_capacity, solid_count, solid_capacity;
} wf_culls;

/* What culling looks at. */
typedef struct wf_cull_scene {
    const wf_step *steps;
    const wf_part *parts;
    const wf_bounds *part_bounds; /* in the world */
    const wf_shaft *shaft;        /* NULL: nothing is left out */
    /* Whether the rays may be in a solid, and where. */
    bool (*meets)(void *user, int solid, wf_stretch *stretch);
    void *user;
} wf_cull_scene;

/* Stack entry of the simplification; most_stack of the scene's objects are needed. */
typedef struct wf_cull_operand {
    size_t step, solid; /* where the operand begins in the list */
    wf_stretch stretch; /* where rays may be in it */
} wf_cull_operand;

void wf_culls_free(wf_culls *culls);
void wf_culls_clear(wf_culls *culls); /* keeps the memory */

/* Adds a part of the scene as far as the shaft can meet it. False: no memory. */
bool wf_cull_part(const wf_cull_scene *scene, int part, wf_cull_operand *stack, wf_culls *out);

/* Adds what the shaft can meet of a list made for a wider one. */
bool wf_cull_again(const wf_cull_scene *scene, const wf_culls *from, wf_cull_operand *stack,
                   wf_culls *out);

/* Nearest first. */
void wf_culls_sort(wf_culls *culls);

/* Makes out a list of one part: the union of all parts of an object that are in a list. False:
 * no memory. */
bool wf_culls_join(const wf_culls *from, const wf_part *parts, int object, wf_culls *out);

#endif

/* Whether something stands between surfaces and a light. */
#include "tracer/trace/shadow.h"

#include "tracer/trace/carry.h"
#include "tracer/trace/find.h"
#include "tracer/trace/nearest.h"
#include "tracer/trace/seek.h"

static void find_kinds(const wf_tracer *t, const int64_t *solid, int count, uint8_t *dark) {
    for (int i = 0; i < count; i++) dark[i] = solid[i] < 0 ? WF_SHADOW_NONE : WF_SHADOW_OPAQUE;
    for (int i = 0; t->media && i < count; i++)
        if (solid[i] >= 0 && t->lets_light[t->object_of[solid[i]]]) dark[i] = WF_SHADOW_CLEAR;
}

bool wf_shadow(const wf_tracer *t, wf_trace_scratch *s, const wf_packet *packet, double far,
               uint8_t *dark) {
    wf_hits hits;
    bool few;
    wf_hits_clear(&hits);
    for (int i = 0; i < WF_PACKET; i++) hits.s[i] = far;
    wf_shaft shaft = wf_shaft_of_rays(&packet->rays, far);
    wf_carry_begin(s);
    if (!wf_find_few(t, s, packet, &shaft, wf_seek_above(t, WF_SEEK_ANY), &few, &s->shadow))
        return false;
    bool good = few ? wf_nearest(t, s, packet, &s->shadow, false, &hits)
                    : wf_seek(t, s, packet, WF_SEEK_ANY, &hits);
    find_kinds(t, hits.solid, packet->rays.count, dark);
    return good;
}

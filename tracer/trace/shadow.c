/* Whether something stands between surfaces and a light. */
#include "tracer/trace/shadow.h"

#include "tracer/trace/carry.h"
#include "tracer/trace/find.h"
#include "tracer/trace/nearest.h"
#include "tracer/trace/seek.h"

static uint8_t kind_of(const wf_tracer *t, int64_t solid) {
    if (solid < 0) return WF_SHADOW_NONE;
    return t->media && t->lets_light[t->object_of[solid]] ? WF_SHADOW_CLEAR : WF_SHADOW_OPAQUE;
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
    for (int i = 0; i < packet->rays.count; i++) dark[i] = kind_of(t, hits.solid[i]);
    return good;
}

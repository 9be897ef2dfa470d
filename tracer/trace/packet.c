#include "tracer/trace/packet.h"

#include "filters/base/isa.h"

static const wf_packet_ops *const levels[] = {
    &wf_packet_v1,
#if defined(__x86_64__)
    &wf_packet_v3,
    &wf_packet_v4,
#endif
};

const wf_packet_ops *wf_packet_at(size_t level) {
    return level < (size_t)wf_isa_levels() ? levels[level] : NULL;
}

const wf_packet_ops *wf_packet_best(void) {
    return levels[wf_isa_levels() - 1];
}

/* The tables by which residuals are packed. unpack.js does the same, number by number. */
#include "convert/page/model.h"

#include <string.h>

static const int wide_base[] = {24, 32, 48, 80, 144, 256, 512, 1024},
                 wide_bits[] = {3, 4, 5, 6, 7, 8, 9};

int wf_model_symbol(int residual) {
    if (residual < WF_MODEL_DIRECT) return residual;
    int wide = 0;
    while (residual >= wide_base[wide + 1]) wide++;
    return WF_MODEL_DIRECT + wide;
}

int wf_model_extra_bits(int symbol) {
    return symbol < WF_MODEL_DIRECT ? 0 : wide_bits[symbol - WF_MODEL_DIRECT];
}

int wf_model_base(int symbol) {
    return symbol < WF_MODEL_DIRECT ? symbol : wide_base[symbol - WF_MODEL_DIRECT];
}

static int level(int sum, const int *ends, int count) {
    int at = 0;
    while (at < count && sum >= ends[at]) at++;
    return at;
}

int wf_model_context(int varies, int beside, int alike) {
    static const int ends[] = {1, 2, 4, 7, 12, 20, 40}, alike_ends[] = {1, 3, 8};
    return (level(varies, ends, 7) * 8 + level(beside, ends, 7)) * 4 +
           level(alike, alike_ends, 3);
}

/* Shares in the ratio of counts, the rest of rounding to the most frequent symbol. */
static void share_out(wf_model *m, int context) {
    const uint32_t *count = m->count[context];
    uint64_t total = 0;
    uint32_t left = 1u << WF_MODEL_BITS, most = 0, before = 0;
    for (int s = 0; s < WF_MODEL_SYMBOLS; s++) total += count[s];
    for (uint32_t s = 0; s < WF_MODEL_SYMBOLS; s++) {
        uint64_t part = count[s] * (uint64_t)((1 << WF_MODEL_BITS) - WF_MODEL_SYMBOLS) / total;
        m->share[context][s] = (uint16_t)(1 + part);
        left -= m->share[context][s];
        if (count[s] > count[most]) most = s;
    }
    m->share[context][most] = (uint16_t)(m->share[context][most] + left);
    for (int s = 0; s < WF_MODEL_SYMBOLS; s++) {
        m->before[context][s] = (uint16_t)before;
        before += m->share[context][s];
    }
}

/* What is expected before anything was seen: large residuals where it varies. */
void wf_model_init(wf_model *m) {
    memset(m, 0, sizeof *m);
    for (int context = 0; context < WF_MODEL_CONTEXTS; context++) {
        uint32_t spread = (uint32_t)(context / 32 + context / 4 % 8),
                 wide = spread * spread / 2 + 1;
        for (int s = 0; s < WF_MODEL_SYMBOLS; s++) {
            uint64_t from = (uint64_t)wf_model_base(s), all = wide + from * from;
            m->count[context][s] = (uint32_t)(1 + 256 * (uint64_t)wide * wide / (all * all));
        }
        share_out(m, context);
    }
}

void wf_model_learn(wf_model *m) {
    for (int context = 0; context < WF_MODEL_CONTEXTS; context++) {
        uint32_t seen = 0;
        for (int s = 0; s < WF_MODEL_SYMBOLS; s++) seen += m->seen[context][s];
        if (!seen) continue;
        for (int s = 0; s < WF_MODEL_SYMBOLS; s++) {
            uint32_t *count = &m->count[context][s];
            *count += 16 * m->seen[context][s] - (*count >> 2);
        }
        share_out(m, context);
    }
    memset(m->seen, 0, sizeof m->seen);
}

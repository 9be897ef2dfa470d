/* How likely which residuals are after what, as packing and unpacking learn it field by field.
 */
#ifndef WF_CONVERT_PAGE_MODEL_H
#define WF_CONVERT_PAGE_MODEL_H

#include <stdint.h>

/* A residual of 0 to 1023 is a symbol and, from WF_MODEL_DIRECT on, bits that tell which of the
 * symbol's residuals it is. */
enum {
    WF_MODEL_DIRECT = 24,
    WF_MODEL_SYMBOLS = 31,
    WF_MODEL_STRIDE = 32, /* of tables by symbol */
    WF_MODEL_CONTEXTS = 256,
    WF_MODEL_BITS = 12 /* shares of a context add up to 1 << this */
};

/* Symbols of one plane by context: how often they came, lately more than formerly, and the
 * share of each, which is never 0, with the sum of those before it. */
typedef struct wf_model {
    uint32_t count[WF_MODEL_CONTEXTS][WF_MODEL_STRIDE];
    uint32_t seen[WF_MODEL_CONTEXTS][WF_MODEL_STRIDE]; /* in the field in hand */
    uint16_t share[WF_MODEL_CONTEXTS][WF_MODEL_STRIDE];
    uint16_t before[WF_MODEL_CONTEXTS][WF_MODEL_STRIDE];
} wf_model;

void wf_model_init(wf_model *model);

/* After a field: learns from what was seen in it. */
void wf_model_learn(wf_model *model);

/* The symbol of a residual; how many bits follow it, and from which residual they count. */
int wf_model_symbol(int residual);
int wf_model_extra_bits(int symbol);
int wf_model_base(int symbol);

/* The context of a residual: how much its neighborhood varies, the sum of the residuals at the
 * left and above, and that of residuals that are elsewhere but alike. */
int wf_model_context(int varies, int beside, int alike);

#endif

/* A job settled: the way from the input's colors to the output's. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "color/space/builtin.h"
#include "color/space/decode.h"
#include "color/space/ocio/ocio.h"
#include "convert/base/module.h"
#include "convert/finish/named_display.h"
#include "convert/finish/setup.h"
#include "convert/job/colors.h"

static const char *given(const char *text) {
    return text && *text ? text : NULL;
}

/* $OCIO names the studio's configuration; a job that names its own wins. */
static const char *foreign_config(const weft_job *job) {
    return job->ocio ? job->ocio : given(secure_getenv("OCIO"));
}

static weft_status ocio_entry(const char *name, void *entry, weft_error *err) {
    void *symbol;
    weft_status status = wf_module_symbol(
        "ocio", name, "color by --ocio or $OCIO, --display, --view or --look", &symbol, err);
    if (!status) memcpy(entry, &symbol, sizeof symbol);
    return status;
}

/* ---- The input's light ---- */

/* What is summed: light of a space of the configuration, or of primaries. */
typedef struct light {
    const char *config; /* foreign; NULL: weft's own */
    bool by_ocio;       /* spaces are OpenColorIO's */
    char space[128];    /* of the configuration, or of weft; "": its scene_linear role */
    const wf_chromaticities *primaries; /* NULL: those of the space */
} light;

static weft_status refuse_encoded(const char *from, weft_error *err) {
    return wf_fail(err, WEFT_USAGE,
                   "the input cannot be in %s, which is encoded: samples are light and must be "
                   "linear; take one of lin_rec709, ACEScg, ACES2065-1, lin_rec2020, lin_p3d65",
                   from);
}

static weft_status no_memory(weft_error *err) {
    return wf_fail(err, WEFT_NO_MEMORY, "no memory for the color transform");
}

/* What OpenColorIO refuses, is as it was asked for; without a reason memory was out. */
static weft_status refuse(const char *why, weft_error *err) {
    return *why ? wf_fail(err, WEFT_USAGE, "%s", why) : no_memory(err);
}

/* A space of weft's own. */
static weft_status find_own(const char *from, wf_setup *s, light *l, weft_error *err) {
    char why[900];
    const wf_space *space = wf_space_find(from, why, sizeof why);
    if (!space) return wf_fail(err, WEFT_USAGE, "%s", why);
    if (space->curve && !s->decodes) return refuse_encoded(from, err);
    const wf_decoding decoding = wf_decoding_of(space->curve);
    char curve[24];
    snprintf(s->from_transfer, sizeof s->from_transfer, "%s",
             wf_decoding_name(&decoding, curve));
    s->from_curve = space->curve;
    if (space->curve && !wf_decoding_transform(&decoding, &s->decode)) return no_memory(err);
    l->primaries = &wf_chromaticities_of[space->primaries];
    const wf_space *linear = space->curve ? wf_space_linear(space->primaries) : space;
    snprintf(l->space, sizeof l->space, "%s", linear ? linear->name : "");
    return WEFT_OK;
}

/* A space of a configuration. */
static weft_status find_foreign(const char *from, wf_setup *s, light *l, weft_error *err) {
    wf_ocio_input_fn *open;
    wf_ocio_input input;
    char why[900];
    weft_status status = ocio_entry("wf_ocio_input_open", &open, err);
    if (status) return status;
    if (!open(l->config, from, &input, why, sizeof why)) return refuse(why, err);
    s->decode = input.decode;
    snprintf(s->from_transfer, sizeof s->from_transfer, "%s",
             s->decode.apply ? "encoded" : "linear");
    snprintf(l->space, sizeof l->space, "%s", input.light_space);
    return s->decode.apply && !s->decodes ? refuse_encoded(from, err) : WEFT_OK;
}

/* What files say of their primaries, in a configuration that has ACES2065-1 to say it in. */
static weft_status place_primaries(const weft_job *job, wf_setup *s, light *l,
                                   weft_error *err) {
    wf_ocio_input_fn *open;
    wf_ocio_input input;
    char why[900];
    weft_status status = ocio_entry("wf_ocio_input_open", &open, err);
    if (status) return status;
    if (!open(l->config, NULL, &input, why, sizeof why)) return refuse(why, err);
    if (input.has_ap0) {
        snprintf(l->space, sizeof l->space, "%s", WF_OCIO_AP0);
        l->primaries = s->scene_primaries;
    } else
        wf_job_warn(job,
                    "the files say what their primaries are, and the configuration has no role "
                    "%s to tell it by: they are taken as its scene_linear role; --from names "
                    "another space",
                    WF_OCIO_AP0);
    return WEFT_OK;
}

static weft_status find_light(const weft_job *job, wf_setup *s, light *l, weft_error *err) {
    if (job->from) return (l->by_ocio ? find_foreign : find_own)(job->from, s, l, err);
    if (s->scene_space) {
        snprintf(l->space, sizeof l->space, "%s", s->scene_space);
        return l->by_ocio ? WEFT_OK : find_own(s->scene_space, s, l, err);
    }
    if (l->by_ocio) return s->scene_primaries ? place_primaries(job, s, l, err) : WEFT_OK;
    if (!s->scene_primaries) return find_own("lin_rec709", s, l, err);
    l->primaries = s->scene_primaries;
    wf_primaries like = wf_primaries_like(l->primaries);
    const wf_space *linear = like < WF_PRIMARIES_COUNT ? wf_space_linear(like) : NULL;
    if (linear) snprintf(l->space, sizeof l->space, "%s", linear->name);
    return WEFT_OK;
}

void wf_setup_take_from(const weft_job *job, const wf_setup *s, wf_taken_list *taken) {
    if (!job->from) return;
    wf_take(taken, "space", job->from, "option");
    wf_take(taken, "transfer", s->from_transfer, "option");
}

/* ---- From there to the output ---- */

/* One transform after another. */
typedef struct chain {
    wf_transform first, second;
} chain;

static void apply_chain(const void *self, float *r, float *g, float *b, size_t width_px) {
    const chain *c = self;
    c->first.apply(c->first.self, r, g, b, width_px);
    c->second.apply(c->second.self, r, g, b, width_px);
}

static void free_chain(void *self) {
    chain *c = self;
    c->first.free(c->first.self);
    c->second.free(c->second.self);
    free(c);
}

/* Has s->transform begin with another, of which it becomes the owner. */
static weft_status begin_with(wf_transform first, wf_setup *s, weft_error *err) {
    chain *c = s->transform.apply ? malloc(sizeof *c) : NULL;
    if (!s->transform.apply) {
        s->transform = first;
        return WEFT_OK;
    }
    if (!c) {
        first.free(first.self);
        return no_memory(err);
    }
    *c = (chain){first, s->transform};
    s->transform = (wf_transform){apply_chain, free_chain, c};
    return WEFT_OK;
}

/* Has another transform follow s->transform. */
static weft_status end_with(wf_transform last, wf_setup *s, weft_error *err) {
    wf_transform first = s->transform;
    s->transform = last;
    return begin_with(first, s, err);
}

/* Light of other primaries becomes ACES2065-1 first. */
static weft_status mix_first(const wf_chromaticities *primaries, wf_setup *s, weft_error *err) {
    wf_transform mix;
    if (!wf_builtin_mix(primaries, &wf_chromaticities_of[WF_PRIMARIES_AP0], &mix))
        return no_memory(err);
    return begin_with(mix, s, err);
}

static void apply_gain(const void *self, float *r, float *g, float *b, size_t width_px) {
    float gain = *(const float *)self, *const plane[3] = {r, g, b};
    for (int c = 0; c < 3; c++)
        for (size_t x = 0; x < width_px; x++) plane[c][x] *= gain;
}

static weft_status expose(const weft_job *job, wf_setup *s, weft_error *err) {
    if (!job->exposure.num) return WEFT_OK;
    float *gain = malloc(sizeof *gain);
    if (!gain) return no_memory(err);
    *gain = (float)exp2(wf_ratio_value(job->exposure));
    return begin_with((wf_transform){apply_gain, free, gain}, s, err);
}

static weft_status open_ocio(const weft_job *job, const light *l, const char *to, wf_setup *s,
                             weft_error *err) {
    wf_ocio_open_fn *open;
    char why[900];
    const wf_ocio_query query = {l->config,    given(l->space), to,
                                 job->display, job->view,       job->look};
    weft_status status = ocio_entry("wf_ocio_open", &open, err);
    if (status) return status;
    if (!open(&query, &s->transform, why, sizeof why)) return refuse(why, err);
    return l->primaries ? mix_first(l->primaries, s, err) : WEFT_OK;
}

/* ---- From a view's display to the raster ---- */

static bool shows_as(const wf_named_display *d, const wf_space *space) {
    const wf_decoding own = wf_decoding_of(space->curve);
    char one[24], two[24];
    return d->primaries == &wf_chromaticities_of[space->primaries] &&
           !strcmp(wf_decoding_name(&d->decoding, one), wf_decoding_name(&own, two));
}

/* R'G'B' of a display becomes its light, and that the raster's R'G'B'. */
static weft_status encode_again(const wf_named_display *d, const wf_space *to, wf_setup *s,
                                weft_error *err) {
    wf_transform decode, encode;
    if (!wf_decoding_transform(&d->decoding, &decode)) return no_memory(err);
    weft_status status = end_with(decode, s, err);
    if (status) return status;
    if (!wf_builtin_from_light(d->primaries, to, &encode)) return no_memory(err);
    return end_with(encode, s, err);
}

/* A view is made for its display. High dynamic range stays that, and data what it is. */
static weft_status settle_view(const weft_job *job, const light *l, wf_setup *s,
                               weft_error *err) {
    wf_ocio_display_fn *display_of;
    wf_named_display display;
    wf_ocio_shown shown;
    char why[900];
    const char *raster_space = wf_colors_of(job->raster.matrix)->space;
    weft_status status = ocio_entry("wf_ocio_display_of", &display_of, err);
    if (status) return status;
    if (!display_of(l->config, job->display, job->view, &shown, why, sizeof why))
        return refuse(why, err);
    if (shown.is_data || s->output.kind->layout == WF_LINEAR) return WEFT_OK;
    if (!wf_named_display_of(shown.display, &display) &&
        !wf_named_display_of(shown.space, &display)) {
        wf_job_warn(
            job,
            "what display \"%s\" makes of codes is not known: they are written as they are",
            shown.display);
        return WEFT_OK;
    }
    const char *to = display.hdr ? display.hdr : raster_space;
    const wf_space *target = wf_space_find(to, why, sizeof why);
    snprintf(s->color_space, sizeof s->color_space, "%s", to);
    if (!target || shows_as(&display, target)) return WEFT_OK;
    return encode_again(&display, target, s, err);
}

static weft_status choose_transform(const weft_job *job, const light *l, wf_setup *s,
                                    weft_error *err) {
    bool by_display = job->display || job->view;
    const char *raster_space = wf_colors_of(job->raster.matrix)->space;
    const char *to = job->to ? job->to : l->config || by_display ? NULL : raster_space;
    snprintf(s->color_space, sizeof s->color_space, "%s",
             to             ? to
             : job->view    ? job->view
             : job->display ? job->display
                            : "");
    if (l->by_ocio) {
        weft_status status = open_ocio(job, l, to, s, err);
        return status || to ? status : settle_view(job, l, s, err);
    }
    char why[900];
    const wf_space *space = wf_space_find(to, why, sizeof why);
    if (!space) return wf_fail(err, WEFT_USAGE, "%s", why);
    return wf_builtin_from_light(l->primaries, space, &s->transform) ? WEFT_OK : no_memory(err);
}

static bool left_linear(const weft_job *job, const wf_output_kind *kind) {
    return kind->layout == WF_LINEAR && !job->to && !job->display && !job->view && !job->look;
}

/* Light is written as it came in, with its primaries. */
static void leave_linear(const light *l, wf_setup *s) {
    snprintf(s->color_space, sizeof s->color_space, "%s", l->space);
    if (!l->primaries) return;
    s->primaries = *l->primaries;
    s->output_options.primaries = &s->primaries;
}

weft_status wf_setup_color(const weft_job *job, wf_setup *s, weft_error *err) {
    bool linear = left_linear(job, s->output.kind);
    const char *config = foreign_config(job);
    light l = {.config = config,
               .by_ocio = linear ? config && job->from
                                 : config || job->display || job->view || job->look};
    weft_status status = find_light(job, s, &l, err);
    if (status) return status;
    if (linear) {
        leave_linear(&l, s);
        return expose(job, s, err);
    }
    if (job->nan_fix == WF_NAN_NONE)
        return wf_fail(err, WEFT_USAGE,
                       "--fix-nan none is for linear EXR output only: %s cannot "
                       "hold NaN; take box3, black or error",
                       job->output);
    status = choose_transform(job, &l, s, err);
    return status ? status : expose(job, s, err);
}

void wf_setup_color_of_raster(const weft_job *job, wf_setup *s) {
    snprintf(s->color_space, sizeof s->color_space, "%s",
             wf_colors_of(job->raster.matrix)->space);
}

/* What the picture is shown on, as far as its color space tells. */
weft_status wf_setup_display(const weft_job *job, wf_setup *s, weft_error *err) {
    static const struct {
        const char *space;
        wf_transfer transfer;
    } rows[] = {{"rec2100-pq", WF_TRANSFER_PQ}, {"rec2100-hlg", WF_TRANSFER_HLG}};
    wf_primaries primaries = wf_colors_of(job->raster.matrix)->primaries;
    wf_transfer transfer = WF_TRANSFER_BT1886;
    if (job->chroma != WF_CHROMA_LUMA_ADJUST || s->output.kind->layout != WF_YCBCR)
        return WEFT_OK;
    s->display = malloc(sizeof *s->display);
    if (!s->display) return wf_fail(err, WEFT_NO_MEMORY, "no memory for a display's curve");
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        if (strcmp(rows[i].space, s->color_space)) continue;
        transfer = rows[i].transfer;
        primaries = WF_PRIMARIES_2020;
    }
    wf_display_init(s->display, primaries, transfer);
    s->encoding.display = s->display;
    return WEFT_OK;
}

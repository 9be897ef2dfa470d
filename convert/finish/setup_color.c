/* A job settled: the way from the input's colors to the output's. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "color/space/builtin.h"
#include "color/space/ocio/ocio.h"
#include "convert/base/module.h"
#include "convert/job/colors.h"
#include "convert/finish/setup.h"

static const char *given(const char *text) {
    return text && *text ? text : NULL;
}

/* $OCIO names the studio's configuration; a job that names its own wins. */
static const char *foreign_config(const weft_job *job) {
    return job->ocio ? job->ocio : given(secure_getenv("OCIO"));
}

static weft_status open_ocio(const wf_ocio_query *query, wf_setup *s, weft_error *err) {
    void *symbol;
    weft_status status = wf_module_symbol("ocio", "wf_ocio_open", &symbol, err);
    if (status) return status;
    wf_ocio_open_fn *open;
    memcpy(&open, &symbol, sizeof open);
    char why[900];
    if (!open(query, &s->transform, why, sizeof why))
        return wf_fail(err, WEFT_USAGE, "%s", why);
    return WEFT_OK;
}

static const char *source_space(const weft_job *job, const wf_setup *s) {
    return job->from ? job->from : s->scene_space ? s->scene_space : "lin_rec709";
}

static weft_status choose_transform(const weft_job *job, wf_setup *s, weft_error *err) {
    const char *config = foreign_config(job),
               *raster_space = wf_colors_of(job->raster.matrix)->space;
    bool by_display = job->display || job->view;
    const char *to = job->to ? job->to : config || by_display ? NULL : raster_space;
    snprintf(s->color_space, sizeof s->color_space, "%s",
             to             ? to
             : job->view    ? job->view
             : job->display ? job->display
                            : "");
    if (!config && !by_display && !job->look) {
        char why[900];
        if (wf_builtin_transform(source_space(job, s), to, &s->transform, why, sizeof why))
            return WEFT_OK;
        return wf_fail(err, WEFT_USAGE, "%s", why);
    }
    const char *from = job->from ? job->from : s->scene_space;
    const wf_ocio_query query = {config, from, to, job->display, job->view, job->look};
    return open_ocio(&query, s, err);
}

static bool left_linear(const weft_job *job, const wf_output_kind *kind) {
    return kind->layout == WF_LINEAR && !job->to && !job->display && !job->view && !job->look;
}

weft_status wf_setup_color(const weft_job *job, wf_setup *s, weft_error *err) {
    if (left_linear(job, s->output.kind)) {
        snprintf(s->color_space, sizeof s->color_space, "%s", source_space(job, s));
        return WEFT_OK;
    }
    if (job->nan_fix == WF_NAN_NONE)
        return wf_fail(err, WEFT_USAGE,
                       "--fix-nan none is for linear EXR output only: %s cannot "
                       "hold NaN; take box3, black or error",
                       job->output);
    return choose_transform(job, s, err);
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

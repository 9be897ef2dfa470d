/* A job settled, all but its colors (setup_color.c): the output that is asked for, held against
 * what its kind takes. */
#include "convert/finish/setup.h"

#include <inttypes.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "convert/base/names.h"
#include "convert/job/audio.h"
#include "convert/job/colors.h"
#include "convert/sound/sound.h"

/* ---- Output ---- */

static int list_bits(unsigned mask, char *text, size_t size) {
    int used = 0;
    for (int bits = 1; bits < 32; bits++)
        if (mask & 1u << bits)
            used += snprintf(text + used, size - (size_t)used, "%s%d", used ? ", " : "", bits);
    return used;
}

static wf_chroma chroma_of(const weft_job *job, const wf_output_kind *kind) {
    return kind->fixed_444 ? WF_CHROMA_444 : job->chroma;
}

static bool is_subsampled(const weft_job *job, const wf_output_kind *kind) {
    return kind->layout == WF_YCBCR && chroma_of(job, kind) != WF_CHROMA_444;
}

static weft_status check_codes(const weft_job *job, const wf_output_kind *kind, int bits,
                               weft_error *err) {
    bool subsampled = is_subsampled(job, kind);
    if (kind->layout != WF_LINEAR && !(kind->bits_mask & 1u << bits)) {
        char there[64];
        list_bits(kind->bits_mask, there, sizeof there);
        return wf_fail(err, WEFT_USAGE, "%s: %s takes --bits %s, not %d", job->output,
                       kind->name, there, bits);
    }
    if (subsampled && job->raster.width_px % 2)
        return wf_fail(err, WEFT_USAGE,
                       "%s: 4:2:2 takes an even width, and %s is %d pixels wide; "
                       "change the raster or give --chroma 444",
                       job->output, job->raster.name, job->raster.width_px);
    if (kind->fixed_422 && !subsampled)
        return wf_fail(err, WEFT_USAGE, "%s: %s is always 4:2:2; leave out --chroma 444",
                       job->output, kind->name);
    return WEFT_OK;
}

static weft_status check_files(const weft_job *job, const wf_output_kind *kind,
                               weft_error *err) {
    wf_audio audio;
    if (wf_audio_parse(job->audio, &audio) && audio.kind != WF_AUDIO_NONE && !kind->container)
        return wf_fail(err, WEFT_USAGE,
                       "%s: %s has no sound; --audio is for .mov, .mxf and .mkv", job->output,
                       kind->name);
    if (job->separate_fields && !kind->sequence)
        return wf_fail(err, WEFT_USAGE,
                       "%s: %s holds frames; --fields separate is for image sequences, such as "
                       "out.####.dpx",
                       job->output, kind->name);
    if (job->separate_fields && job->raster.scan == WF_PROGRESSIVE)
        return wf_fail(err, WEFT_USAGE,
                       "--fields separate: %s is progressive and has no fields; leave it out",
                       job->raster.name);
    if (job->chunk_count > 1 && !kind->joins)
        return wf_fail(err, WEFT_USAGE,
                       "%s: chunks of %s cannot be joined; write an image sequence, "
                       ".y4m, .v210 or .uyvy",
                       job->output, kind->name);
    return WEFT_OK;
}

/* OpenEXR and PNG say once for all how color lies beside alpha; for other kinds it is
 * premultiplied unless asked otherwise. */
static wf_fill fill_of(const weft_job *job, const wf_output_kind *kind) {
    if (job->fill) return job->fill;
    return kind->fills & 1u << WF_FILL_PREMULTIPLIED ? WF_FILL_PREMULTIPLIED : WF_FILL_STRAIGHT;
}

static weft_status check_alpha(const weft_job *job, const wf_output_kind *kind,
                               weft_error *err) {
    bool beside = job->alpha_out || kind->layout == WF_LINEAR;
    if (!wf_job_writes_alpha(job) || !beside || kind->fills & 1u << fill_of(job, kind)) {
        bool lit = kind->layout == WF_LINEAR && job->key_law == WF_KEY_CHOICE_ENCODED;
        return lit ? wf_fail(err, WEFT_USAGE,
                             "%s: %s holds light; --key-law encoded is for codes", job->output,
                             kind->name)
                   : WEFT_OK;
    }
    if (!kind->fills)
        return wf_fail(err, WEFT_USAGE,
                       "%s: %s holds no alpha; --alpha-out is for .exr, .png, .tif, .dpx, "
                       ".mov (--codec prores-4444) and .mkv, and --key writes it by itself",
                       job->output, kind->name);
    return wf_fail(err, WEFT_USAGE,
                   "%s: beside alpha, color in %s is always %s; leave out --fill", job->output,
                   kind->name, job->fill == WF_FILL_STRAIGHT ? "premultiplied" : "straight");
}

static void tell_changes(const weft_job *job, const wf_output *output,
                         const wf_output_options *options) {
    char text[512] = "";
    if (output->ops->tell) output->ops->tell(options, text, sizeof text);
    if (*text) wf_job_warn(job, "%s", text);
    if (output->kind->layout == WF_LINEAR && job->legalize != WF_LEGAL_NONE)
        wf_job_warn(job, "%s: --legalize is for codes; float samples stay as they are",
                    job->output);
}

static wf_output_options describe_sink(const weft_job *job, const wf_setup *s,
                                       const wf_output_kind *kind, int bits, bool full) {
    return (wf_output_options){
        .output = job->output,
        .raster = &s->raster,
        .layout = kind->layout,
        .bits = kind->layout == WF_LINEAR ? 32 : bits,
        .full_range = full,
        .subsampled = is_subsampled(job, kind),
        .alpha = job->alpha_out,
        .straight = job->fill == WF_FILL_STRAIGHT ||
                    (job->alpha_out && fill_of(job, kind) == WF_FILL_STRAIGHT),
        .separate_fields = job->separate_fields,
        .stream_header = job->chunk == 1,
        .chunked = job->chunk_count > 1,
        .timecode = job->timecode ? job->timecode : "00:00:00:00",
        .date = job->date,
        .color_space = s->color_space,
        .codec = job->codec,
        .sound = s->sound ? wf_sound_feed_of(s->sound) : (wf_sound_feed){0},
        .threads = job->threads,
        .overwrite = job->overwrite,
        .resume = job->resume,
    };
}

static void describe_codes(const weft_job *job, wf_setup *s, int bits, bool full) {
    const wf_colors *colors = wf_colors_of(job->raster.matrix);
    s->encoding = (wf_encoding){
        .luma = colors->luma,
        .chroma = chroma_of(job, s->output.kind),
        .legalize = job->legalize,
        .dither = job->dither,
        .ycbcr = s->output.kind->layout == WF_YCBCR,
        .full_range = full,
        .bits = bits,
        .width_px = job->raster.width_px,
    };
}

/* ---- The key ---- */

/* Two names of one file, or of one sequence. */
static bool same_files(const char *a, const char *b) {
    char *one = wf_name_place(a), *other = wf_name_place(b);
    bool same = one && other && !strcmp(one, other);
    free(one);
    free(other);
    return same;
}

/* The job of the key: as that of the fill where its kind takes that, and as the kind has it
 * where not. Its codes are of narrow range in Y'CbCr. */
static weft_job job_of_key(const weft_job *job, wf_output *output, weft_error *err) {
    weft_job own = *job;
    own.output = job->key;
    own.audio = NULL;
    own.alpha_out = false;
    own.legalize = WF_LEGAL_NONE;
    *output = job->codec ? wf_output_for(job->key, job->codec, NULL) : (wf_output){0};
    if (!output->kind) {
        own.codec = NULL;
        *output = wf_output_for(job->key, NULL, err);
    }
    const wf_output_kind *kind = output->kind;
    if (!kind) return own;
    if (own.bits && !(kind->bits_mask & 1u << own.bits)) own.bits = 0;
    if (!own.bits) own.bits = kind->default_bits;
    if (kind->fixed_422) own.chroma = WF_CHROMA_BOX;
    if (kind->layout == WF_YCBCR) own.range = WF_RANGE_NARROW;
    return own;
}

static weft_status check_key(const weft_job *job, const wf_setup *s, weft_error *err) {
    if (same_files(job->key, job->output))
        return wf_fail(err, WEFT_USAGE,
                       "%s: the key and the fill would be one file; give --key another name",
                       job->key);
    if (job->resume && s->key.kind->sequence != s->output.kind->sequence)
        return wf_fail(err, WEFT_USAGE,
                       "--resume: %s and %s are made again frame by frame only where both are "
                       "sequences; give --overwrite",
                       job->output, job->key);
    return WEFT_OK;
}

static weft_status settle_key(const weft_job *job, wf_setup *s, weft_error *err) {
    if (!job->key) return WEFT_OK;
    const weft_job own = job_of_key(job, &s->key, err);
    const wf_output_kind *kind = s->key.kind;
    if (!kind) return WEFT_USAGE;
    bool full = own.range == WF_RANGE_UNSET ? kind->full_range : own.range == WF_RANGE_FULL;
    weft_status status = check_key(job, s, err);
    if (!status) status = check_codes(&own, kind, own.bits, err);
    if (!status) status = check_files(&own, kind, err);
    if (status) return status;
    s->key_options = describe_sink(&own, s, kind, own.bits, full);
    s->key_options.straight = false;
    s->key_options.sound = (wf_sound_feed){0};
    if (s->key.ops->check) status = s->key.ops->check(&s->key_options, err);
    if (!status) tell_changes(&own, &s->key, &s->key_options);
    return status;
}

/* ---- The output ---- */

/* The sink and the codes, but for what depends on colors. */
static weft_status settle_sink(const weft_job *job, wf_setup *s, weft_error *err) {
    s->output = wf_output_for(job->output, job->codec, err);
    if (!s->output.kind) return WEFT_USAGE;
    const wf_output_kind *kind = s->output.kind;
    int bits = job->bits ? job->bits : kind->default_bits;
    bool full = job->range == WF_RANGE_UNSET ? kind->full_range : job->range == WF_RANGE_FULL;
    weft_status status = check_codes(job, kind, bits, err);
    if (!status) status = check_files(job, kind, err);
    if (!status) status = check_alpha(job, kind, err);
    if (status) return status;
    s->raster = job->raster;
    s->raster.all_lines = s->raster.whole_frames = false;
    s->made = job->raster;
    s->made.all_lines = false;
    s->output_options = describe_sink(job, s, kind, bits, full);
    describe_codes(job, s, bits, full);
    if (s->output.ops->check) status = s->output.ops->check(&s->output_options, err);
    if (!status) tell_changes(job, &s->output, &s->output_options);
    return status ? status : settle_key(job, s, err);
}

/* The matrix that goes with the colors of the codes. */
static void settle_matrix(wf_setup *s) {
    s->raster.matrix = wf_color_matrix_of(s->color_space, s->raster.matrix);
    s->encoding.luma = wf_colors_of(s->raster.matrix)->luma;
}

/* Spaces without a name of weft's are shown as the raster's own. */
static bool is_bt1886(const char *space) {
    char why[900];
    const wf_space *found = wf_space_find(space, why, sizeof why);
    return !found || found->curve == &wf_curve_bt1886;
}

/* Video is for mixers, which lay codes over codes; pictures and light are not. */
static weft_status settle_law(const weft_job *job, wf_setup *s, weft_error *err) {
    bool mixed = (s->output.kind->container || job->key) && s->output.kind->layout != WF_LINEAR;
    bool asked = job->key_law == WF_KEY_CHOICE_ENCODED;
    bool encoded = asked || (!job->key_law && mixed);
    bool known = is_bt1886(s->color_space);
    s->key_law = encoded && known ? WF_KEY_ENCODED : WF_KEY_LIGHT;
    if (!wf_job_writes_alpha(job) || !encoded || known) return WEFT_OK;
    if (asked)
        return wf_fail(
            err, WEFT_USAGE,
            "--key-law encoded is worked out for the curve of BT.1886, and codes are "
            "in %s; take light",
            s->color_space);
    wf_job_warn(job,
                "%s: alpha is by the law of light; that of mixers is worked out for the curve "
                "of BT.1886, and codes are in %s",
                job->output, s->color_space);
    return WEFT_OK;
}

weft_status wf_setup_output(const weft_job *job, wf_setup *s, weft_error *err) {
    weft_status status = settle_sink(job, s, err);
    if (!status) status = wf_setup_color(job, s, err);
    if (!status) status = settle_law(job, s, err);
    settle_matrix(s);
    if (!status) wf_setup_flicker(job, s);
    return status ? status : wf_setup_display(job, s, err);
}

weft_status wf_setup_video(const weft_job *job, wf_setup *s, weft_error *err) {
    weft_status status = settle_sink(job, s, err);
    if (status) return status;
    wf_setup_color_of_raster(job, s);
    return wf_setup_display(job, s, err);
}

/* ---- Frames and fields ---- */

void wf_setup_tell_frames(wf_setup *s) {
    s->output_options.first_frame = s->first_frame;
    s->output_options.frame_count = s->endless ? -1 : s->end_frame - s->first_frame;
    s->key_options.first_frame = s->output_options.first_frame;
    s->key_options.frame_count = s->output_options.frame_count;
}

void wf_setup_frames(const weft_job *job, wf_setup *s, int64_t first, int64_t end) {
    int64_t frames = end - first;
    s->first_frame = first + frames * (job->chunk - 1) / job->chunk_count;
    s->end_frame = first + frames * job->chunk / job->chunk_count;
    wf_setup_tell_frames(s);
}

weft_status wf_setup_chosen_frames(const weft_job *job, wf_setup *s, int64_t given,
                                   weft_error *err) {
    int64_t end = job->output_end ? job->output_end : given;
    wf_setup_frames(job, s, job->output_first, end);
    if (end <= given) return WEFT_OK;
    return wf_fail(err, WEFT_USAGE,
                   "--output-frames: there is no frame %" PRId64
                   "; %s gives frames 0 to %" PRId64,
                   end - 1, job->inputs[0], given - 1);
}

wf_rational wf_setup_width(const weft_job *job) {
    return wf_ratio_given(job->temporal_width) ? job->temporal_width
                                               : job->aperture.kind->default_width;
}

wf_gather_desc wf_setup_gather(const weft_job *job) {
    return (wf_gather_desc){.raster = &job->raster,
                            .aperture = job->aperture,
                            .width = wf_setup_width(job),
                            .position = job->shutter_position,
                            .skew = job->scan_skew,
                            .alpha = wf_job_writes_alpha(job)};
}

/* ---- Report ---- */

wf_report_legal wf_setup_legal(const weft_job *job, const wf_setup *s) {
    if (!s->output.kind || s->output.kind->layout == WF_LINEAR) return (wf_report_legal){0};
    static const char *const legalize[] = {"none", "clip", "r103"};
    return (wf_report_legal){.legalize = legalize[job->legalize],
                             .dither = job->dither == WF_DITHER_TPDF ? "tpdf" : "none",
                             .range = s->output_options.full_range ? "full" : "narrow",
                             .bits = s->output_options.bits};
}

void wf_setup_free(wf_setup *s) {
    wf_sequence_free(&s->sequence);
    if (s->transform.free) s->transform.free(s->transform.self);
    if (s->decode.free) s->decode.free(s->decode.self);
    wf_sound_close(s->sound);
    free(s->display);
    *s = (wf_setup){0};
}

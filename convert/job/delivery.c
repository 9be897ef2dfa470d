/* The table of deliveries. */
#include "convert/job/delivery.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "convert/job/audio.h"
#include "convert/job/choices.h"
#include "filters/base/spelling.h"

/* ---- Rasters of the codecs ---- */

#define FIELDS      (WF_SCAN_TOP | WF_SCAN_BOTTOM)
#define ANY_SCAN    (FIELDS | WF_SCAN_WHOLE)
#define RATES_I     (WF_RATE_25 | WF_RATE_29_97 | WF_RATE_30)
#define RATES_P     (WF_RATE_23_976 | WF_RATE_24 | RATES_I)
#define RATES_HIGH  (WF_RATE_50 | WF_RATE_59_94 | WF_RATE_60)
#define COUNT(list) (sizeof(list) / sizeof *(list))
#define MEGABITS    1000000

static const wf_delivery_form any_raster[] = {{.scans = ANY_SCAN}};
static const wf_delivery_form dnxhr_forms[] = {
    {.scans = WF_SCAN_WHOLE, .bits = 10, .options = "profile=dnxhr_hqx"},
    {.scans = WF_SCAN_WHOLE, .bits = 8, .options = "profile=dnxhr_hq"},
};

#define SIZE(width, height)  .width_px = (width), .lines = (height)
#define SCAN(which, at)      .scans = WF_SCAN_##which, .rates = (at)
#define TABLE(depth, number) .bits = (depth), .bit_rate = (number)*MEGABITS
#define RATES_CAMERA         (WF_RATE_23_976 | WF_RATE_25 | WF_RATE_29_97)

/* All frames of a DNxHD table have one size at any rate, and the bit rate at 25 (50) frames
 * a second names the table. */
static const wf_delivery_form dnxhd_forms[] = {
    {SIZE(1920, 1080), SCAN(TOP, RATES_I), TABLE(10, 185)},
    {SIZE(1920, 1080), SCAN(TOP, RATES_I), TABLE(8, 120)},
    {SIZE(1920, 1080), SCAN(WHOLE, RATES_P | RATES_HIGH), TABLE(10, 185)},
    {SIZE(1920, 1080), SCAN(WHOLE, RATES_P | RATES_HIGH), TABLE(8, 120)},
    {SIZE(1280, 720), SCAN(WHOLE, RATES_P | RATES_HIGH), TABLE(10, 180)},
    {SIZE(1280, 720), SCAN(WHOLE, RATES_P | RATES_HIGH), TABLE(8, 120)},
};

static const wf_delivery_form xdcam_forms[] = {
    {SIZE(1920, 1080), SCAN(TOP, WF_RATE_25 | WF_RATE_29_97), TABLE(8, 50)},
    {SIZE(1920, 1080), SCAN(WHOLE, RATES_CAMERA), TABLE(8, 50)},
    {SIZE(1280, 720), SCAN(WHOLE, WF_RATE_50 | WF_RATE_59_94), TABLE(8, 50)},
};

static const wf_delivery_form avci_forms[] = {
    {SIZE(1920, 1080), SCAN(TOP, WF_RATE_25 | WF_RATE_29_97)},
    {SIZE(1920, 1080), SCAN(WHOLE, RATES_CAMERA)},
    {SIZE(1280, 720), SCAN(WHOLE, WF_RATE_50 | WF_RATE_59_94)},
};

/* SMPTE ST 356 codes lines from 7 and 320 of 625 and from 7 and 270 of 525. All frames have
 * one size. In 525 it is the 208540 bytes that libavformat computes from stated_rate; the
 * encoder fills them exactly at bit_rate. */
static const wf_delivery_form imx_forms[] = {
    {SIZE(720, 576), SCAN(TOP, WF_RATE_25), TABLE(8, 50), .above_lines = 32},
    {SIZE(720, 486), SCAN(TOP, WF_RATE_29_97), .bit_rate = 49999601, .stated_rate = 49999840,
     .above_lines = 26, .options = "rc_init_occupancy=1668321:bufsize=1668321"},
};

/* SMPTE ST 314 takes lines from 23 and 285 of 525 and from 23 and 335 of 625: bottom first. */
static const wf_delivery_form dv_forms[] = {
    {SIZE(720, 480), SCAN(BOTTOM, WF_RATE_29_97)},
    {SIZE(720, 486), SCAN(BOTTOM, WF_RATE_29_97), .skip_lines = 4, .kept_lines = 480},
    {SIZE(720, 486), SCAN(TOP, WF_RATE_29_97), .skip_lines = 5, .kept_lines = 480},
    {SIZE(720, 576), SCAN(BOTTOM, WF_RATE_25)},
};

/* What players decode is 4:2:0 of 8 bits; what is edited on is 4:2:2 of 10. */
static const wf_delivery_form h264_forms[] = {
    {.scans = ANY_SCAN, .bits = 8, .folds_chroma = true, .options = "profile=high"},
    {SIZE(720, 486), .scans = WF_SCAN_BOTTOM, .bits = 8, .skip_lines = 4, .kept_lines = 480,
     .folds_chroma = true, .options = "profile=high"},
    {SIZE(720, 486), .scans = WF_SCAN_TOP, .bits = 8, .skip_lines = 5, .kept_lines = 480,
     .folds_chroma = true, .options = "profile=high"},
    {.scans = ANY_SCAN, .bits = 10, .options = "profile=high422"},
};

/* ---- Codecs ---- */

#define BITS(n) (1u << (n))
#define KIND(codec, ending, about, bits, preset, always_422)                                   \
    .kind = {.name = codec,                                                                    \
             .endings = ending,                                                                \
             .help = about,                                                                    \
             .layout = WF_YCBCR,                                                               \
             .bits_mask = bits,                                                                \
             .default_bits = preset,                                                           \
             .fixed_422 = always_422,                                                          \
             .container = true}
/* Uncompressed 4:2:2 in MXF, which weft writes without libav. */
#define RAW_MXF(codec, about, bits)                                                            \
    .kind = {.name = codec,                                                                    \
             .endings = "mxf",                                                                 \
             .help = about,                                                                    \
             .layout = WF_YCBCR,                                                               \
             .bits_mask = BITS(bits),                                                          \
             .default_bits = bits,                                                             \
             .fixed_422 = true,                                                                \
             .container = true},                                                               \
    .muxer = "mxf", .sound_bytes = BITS(2) | BITS(3), .full_range = true
#define FORMS(list) .forms = (list), .form_count = COUNT(list)
/* Neither codec says how color lies beside alpha; QuickTime can. */
#define ALPHA(bits)                                                                            \
    .kind.fills = BITS(WF_FILL_PREMULTIPLIED) | BITS(WF_FILL_STRAIGHT), .alpha_bits = (bits)

#define V210   .encoder = "v210", FORMS(any_raster)
#define PRORES .encoder = "prores_ks", FORMS(any_raster)
#define DNXHD  .encoder = "dnxhd", .encoder_options = "profile=dnxhd", FORMS(dnxhd_forms)
#define DVCPRO .encoder = "dvvideo", FORMS(dv_forms)
/* With one thread the encoder's buffer is too small for the stuffing of a simple picture. */
#define MPEG2_OPTIONS                                                                          \
    "dc=10:intra_vlc=1:non_linear_quant=1:qmin=1:seq_disp_ext=always:video_format=component"
#define XDCAM                                                                                  \
    .encoder = "mpeg2video",                                                                   \
    .encoder_options = MPEG2_OPTIONS ":profile=0:level=2:qmax=28:bf=2:"                        \
                                     "sc_threshold=1000000000:bufsize=36408333:"               \
                                     "rc_max_vbv_use=1:rc_min_vbv_use=1",                      \
    FORMS(xdcam_forms), .pictures_a_group = 12, .constant = true, .threads = 2
#define IMX                                                                                    \
    .encoder = "mpeg2video",                                                                   \
    .encoder_options = MPEG2_OPTIONS ":profile=0:level=5:qmax=12:flags=+low_delay:"            \
                                     "rc_max_vbv_use=1:rc_min_vbv_use=1:"                      \
                                     "rc_init_occupancy=2000000:bufsize=2000000",              \
    FORMS(imx_forms), .constant = true, .threads = 2
#define AVCI                                                                                   \
    .encoder = "libx264", .encoder_options = "avcintra-class=100", FORMS(avci_forms),          \
    .threads = 1
/* With another number of threads x264 chooses otherwise. */
#define H264                                                                                   \
    .encoder = "libx264", .encoder_options = "preset=medium:crf=16", FORMS(h264_forms),        \
    .pictures_a_group = 24, .threads = 4
#define MOV .muxer = "mov", .sound_bytes = BITS(2) | BITS(3) | BITS(4)
#define MXF .muxer = "mxf", .sound_bytes = BITS(2) | BITS(3)
#define MKV .muxer = "matroska", .sound_bytes = BITS(2) | BITS(3) | BITS(4)
/* Samples as they are go into MP4 by ISO/IEC 23003-5 only, which hardly any player reads. */
#define MP4 .muxer = "mp4", .sound_bytes = BITS(2) | BITS(3) | BITS(4), .sound_encoder = "aac"

static const wf_delivery rows[] = {
    {KIND("v210", "mov", "uncompressed, 10 bits", BITS(10), 10, true), MOV, V210},
    {KIND("prores", "mov", "ProRes 422", BITS(10), 10, true), MOV, PRORES,
     .encoder_options = "profile=standard:vendor=apl0"},
    {KIND("prores-hq", "mov", "ProRes 422 HQ", BITS(10), 10, true), MOV, PRORES,
     .encoder_options = "profile=hq:vendor=apl0"},
    {KIND("prores-4444", "mov", "ProRes 4444, with alpha of 16 bits", BITS(10), 10, false), MOV,
     PRORES, .encoder_options = "profile=4444:vendor=apl0:alpha_bits=16",
     .kind.fixed_444 = true, ALPHA(BITS(10))},
    {KIND("dnxhd", "mov", "DNxHD, 185 to 440 Mb/s of 10 bits, 120 to 290 of 8",
          BITS(8) | BITS(10), 10, true),
     MOV, DNXHD},
    {KIND("dnxhr", "mov", "DNxHR HQX of 10 bits, HQ of 8; progressive", BITS(8) | BITS(10), 10,
          true),
     MOV, .encoder = "dnxhd", FORMS(dnxhr_forms)},
    {KIND("xdcamhd422", "mov", "MPEG-2 4:2:2 of 50 Mb/s", BITS(8), 8, true), MOV, XDCAM},
    {KIND("dvcpro50", "mov", "DV of 50 Mb/s", BITS(8), 8, true), MOV, DVCPRO},
    {KIND("avci100", "mov", "AVC-Intra 100", BITS(10), 10, true), MOV, AVCI},
    {KIND("h264", "mov", "H.264, 4:2:0 of 8 bits or 4:2:2 of 10", BITS(8) | BITS(10), 8, true),
     MOV, H264},

    {KIND("h264", "mp4", "H.264, 4:2:0 of 8 bits or 4:2:2 of 10", BITS(8) | BITS(10), 8, true),
     MP4, H264},

    {KIND("xdcamhd422", "mxf", "MPEG-2 4:2:2 of 50 Mb/s", BITS(8), 8, true), MXF, XDCAM},
    {KIND("dnxhd", "mxf", "DNxHD", BITS(8) | BITS(10), 10, true), MXF, DNXHD},
    {KIND("imx50", "mxf", "MPEG-2 D-10 of 50 Mb/s", BITS(8), 8, true), .muxer = "mxf_d10",
     .sound_bytes = BITS(2) | BITS(3), .one_audio_stream = true, IMX},
    {KIND("dvcpro50", "mxf", "DV of 50 Mb/s", BITS(8), 8, true), MXF, DVCPRO},
    {KIND("avci100", "mxf", "AVC-Intra 100", BITS(10), 10, true), MXF, AVCI},
    {RAW_MXF("v210", "uncompressed, 10 bits", 10), FORMS(any_raster)},
    {RAW_MXF("uyvy", "uncompressed, 8 bits", 8), FORMS(any_raster)},

    {KIND("ffv1", "mkv", "FFV1, lossless", BITS(8) | BITS(10) | BITS(12) | BITS(16), 10, false),
     MKV, .encoder = "ffv1", .encoder_options = "level=3:slices=4:slicecrc=1:g=1",
     FORMS(any_raster), .full_range = true, ALPHA(BITS(8) | BITS(10) | BITS(16))},
};

#define ROWS COUNT(rows)

const wf_delivery *wf_delivery_at(size_t index) {
    return index < ROWS ? &rows[index] : NULL;
}

/* ---- Finding one ---- */

static const char *ending_of(const char *output) {
    const char *slash = strrchr(output, '/'), *dot = strrchr(output, '.');
    return dot && (!slash || dot > slash) ? dot + 1 : "";
}

static bool ends_in(const wf_delivery *row, const char *ending) {
    return !strcasecmp(row->kind.endings, ending);
}

/* Writes "v210, prores, ..": the codecs of one ending, or all (NULL), each once. */
static void list_codecs(const char *ending, char *text, size_t size) {
    size_t used = 0;
    *text = '\0';
    for (size_t i = 0; i < ROWS && used < size; i++) {
        bool again = false;
        for (size_t j = 0; j < i; j++)
            again = again || (!ending && !strcmp(rows[j].kind.name, rows[i].kind.name));
        if (again || (ending && !ends_in(&rows[i], ending))) continue;
        used += (size_t)snprintf(text + used, size - used, "%s%s", used ? ", " : "",
                                 rows[i].kind.name);
    }
}

void wf_delivery_codecs(char *text, size_t size) {
    list_codecs(NULL, text, size);
}

static void refuse_codec(const char *output, const char *codec, weft_error *err) {
    char there[256], endings[64] = "";
    wf_spelling spelling = {.text = codec};
    size_t used = 0;
    for (size_t i = 0; i < ROWS; i++) {
        wf_spelling_offer(&spelling, rows[i].kind.name);
        if (!strcmp(rows[i].kind.name, codec) && used < sizeof endings)
            used += (size_t)snprintf(endings + used, sizeof endings - used, "%s.%s",
                                     used ? " and " : "", rows[i].kind.endings);
    }
    list_codecs(ending_of(output), there, sizeof there);
    if (*endings)
        wf_fail(err, WEFT_USAGE,
                "%.500s: %s does not go into .%s; it goes into %s, and .%s takes %s", output,
                codec, ending_of(output), endings, ending_of(output), there);
    else if (spelling.best)
        wf_fail(err, WEFT_USAGE, "--codec: '%.100s' is unknown; did you mean %s?", codec,
                spelling.best);
    else
        wf_fail(err, WEFT_USAGE, "--codec: '%.100s' is unknown; .%s takes %s", codec,
                ending_of(output), there);
}

const wf_delivery *wf_delivery_for(const char *output, const char *codec, bool *container,
                                   weft_error *err) {
    const char *ending = ending_of(output);
    *container = false;
    for (size_t i = 0; i < ROWS; i++) {
        if (!ends_in(&rows[i], ending)) continue;
        *container = true;
        if (!codec || !strcmp(rows[i].kind.name, codec)) return &rows[i];
    }
    if (*container) refuse_codec(output, codec, err);
    return NULL;
}

/* ---- What it takes ---- */

static const struct {
    wf_rational rate;
    unsigned bit;
} rates[] = {
    {{24000, 1001}, WF_RATE_23_976}, {{24, 1}, WF_RATE_24}, {{25, 1}, WF_RATE_25},
    {{30000, 1001}, WF_RATE_29_97},  {{30, 1}, WF_RATE_30}, {{50, 1}, WF_RATE_50},
    {{60000, 1001}, WF_RATE_59_94},  {{60, 1}, WF_RATE_60},
};

static bool rate_fits(unsigned taken, wf_rational rate) {
    for (size_t i = 0; i < COUNT(rates); i++)
        if (taken & rates[i].bit && wf_ratio_equal(rate, rates[i].rate)) return true;
    return !taken;
}

static unsigned scan_of(const wf_raster *raster) {
    if (raster->scan != WF_INTERLACED) return WF_SCAN_WHOLE;
    return raster->top_first ? WF_SCAN_TOP : WF_SCAN_BOTTOM;
}

/* In 4:2:0 a field has half as many rows of chroma as lines. */
static bool folds(const wf_delivery_form *form, const wf_raster *r) {
    int lines = form->kept_lines ? form->kept_lines : r->lines;
    return !form->folds_chroma || lines % (r->scan == WF_INTERLACED ? 4 : 2) == 0;
}

static bool fits(const wf_delivery_form *form, const wf_raster *r) {
    return folds(form, r) &&
           (!form->width_px || (form->width_px == r->width_px && form->lines == r->lines)) &&
           form->scans & scan_of(r) && rate_fits(form->rates, r->frame_rate);
}

static void tell_form(const wf_delivery_form *form, char *text, size_t size) {
    snprintf(text, size, "%s",
             form->folds_chroma ? "frames of an even number of lines, 4:2:0; interlaced "
                                  "ones of a multiple of four, or --bits 10, 4:2:2"
             : form->scans == WF_SCAN_WHOLE ? "progressive rasters of any size"
                                            : "rasters of any size and scan");
}

static const wf_delivery_form *find_form(const wf_delivery *delivery, const wf_raster *raster,
                                         int bits) {
    for (size_t i = 0; i < delivery->form_count; i++) {
        const wf_delivery_form *form = &delivery->forms[i];
        if ((!form->bits || form->bits == bits) && fits(form, raster)) return form;
    }
    return NULL;
}

/* Writes which rasters the delivery takes: "--raster 525i-dv, 625i-dv", or a description
 * where it takes any size. */
static void tell_rasters(const wf_delivery *delivery, int bits, char *text, size_t size) {
    const wf_raster *r;
    size_t used = 0;
    if (!delivery->forms->width_px) {
        tell_form(delivery->forms, text, size);
        return;
    }
    *text = '\0';
    for (size_t i = 0; (r = wf_raster_at(i)) && used < size; i++)
        if (find_form(delivery, r, bits))
            used += (size_t)snprintf(text + used, size - used, "%s%s",
                                     used ? ", " : "--raster ", r->name);
}

/* Writes "imx50, v210": the codecs of the same container that take the raster at any depth. */
static void tell_others(const wf_output_options *o, char *text, size_t size) {
    size_t used = 0;
    *text = '\0';
    for (size_t i = 0; i < ROWS && used < size; i++) {
        bool takes = false;
        for (size_t k = 0; k < rows[i].form_count; k++)
            takes = takes || fits(&rows[i].forms[k], o->raster);
        if (!takes || !ends_in(&rows[i], ending_of(o->output))) continue;
        used += (size_t)snprintf(text + used, size - used, "%s%s", used ? ", " : "",
                                 rows[i].kind.name);
    }
}

static void refuse_raster(const wf_delivery *delivery, const wf_output_options *o,
                          weft_error *err) {
    char there[512], others[256];
    tell_rasters(delivery, o->bits, there, sizeof there);
    tell_others(o, others, sizeof others);
    wf_fail(err, WEFT_USAGE,
            "%.200s: %s of %d bits does not take %s (%dx%d, %s)%s%s; it takes %s", o->output,
            delivery->kind.name, o->bits, o->raster->name, o->raster->width_px,
            o->raster->lines, wf_raster_order(o->raster),
            *others ? ", which is for --codec " : "", others, there);
}

const wf_delivery_form *wf_delivery_form_for(const wf_delivery *delivery,
                                             const wf_output_options *o, weft_error *err) {
    const wf_delivery_form *form = find_form(delivery, o->raster, o->bits);
    if (!form) refuse_raster(delivery, o, err);
    return form;
}

/* Lines of the frame belong to the fields in turn; the top line belongs to the second field
 * where the raster is bottom first. Of k lines dropped, the field of the top line loses the
 * odd one. */
wf_raster wf_delivery_raster(const wf_delivery_form *form, const wf_raster *raster) {
    wf_raster r = *raster;
    int shift = form->skip_lines - form->above_lines;
    r.lines = (form->kept_lines ? form->kept_lines : raster->lines) + form->above_lines;
    if (shift % 2) r.top_first = r.scan == WF_INTERLACED && !r.top_first;
    if (!raster->total_lines) return r;
    bool top_is_first = wf_raster_map_top_first(r.line1, r.line2, r.total_lines);
    int top = (shift + (shift > 0)) / 2, other = shift / 2;
    r.line1 += top_is_first ? top : other;
    r.line2 += top_is_first ? other : top;
    return r;
}

/* ---- Sound ---- */

weft_status wf_delivery_check_sound(const wf_delivery *d, const wf_output_options *o,
                                    weft_error *err) {
    const wf_sound_feed *sound = &o->sound;
    bool grouped = d->one_audio_stream;
    bool groups = grouped && (sound->tracks % 4 || sound->tracks > 8);
    if (sound->tracks && !d->sound_bytes)
        return wf_fail(
            err, WEFT_USAGE,
            "%.500s: sound is not written into .%s; leave out --audio, or write .mov",
            o->output, d->kind.endings);
    if (sound->tracks > WF_SOUND_TRACKS || groups)
        return wf_fail(
            err, WEFT_USAGE,
            "%.500s: %s takes %s tracks of sound, not %d; --audio-tracks says how many "
            "are written",
            o->output, d->kind.name, grouped ? "4 or 8" : "up to 16", sound->tracks);
    if (!sound->tracks || d->sound_bytes & BITS(sound->bits / 8)) return WEFT_OK;
    return wf_fail(err, WEFT_USAGE, "%.500s: .%s takes --audio-bits 16 or 24, not %d",
                   o->output, d->kind.endings, sound->bits);
}

int wf_delivery_sound_tracks(const wf_delivery *d, int channels) {
    return d->one_audio_stream && channels % 4 ? channels + 4 - channels % 4 : channels;
}

/* ---- QuickTime's names ---- */

/* libavformat 5.1 rounds 29.97 to 29 and then finds none of these codes, so they are given. */
wf_delivery_mark wf_delivery_quicktime(const wf_delivery *delivery, const wf_raster *raster) {
    static const struct {
        const char *codec;
        int lines;            /* 0: any */
        unsigned scan, rates; /* 0: any */
        wf_delivery_mark mark;
    } marks[] = {
        {"xdcamhd422", 1080, FIELDS, WF_RATE_25, {"xd5c", "XDCAM HD422 1080i50"}},
        {"xdcamhd422", 1080, FIELDS, WF_RATE_29_97, {"xd5b", "XDCAM HD422 1080i60"}},
        {"xdcamhd422", 1080, WF_SCAN_WHOLE, WF_RATE_23_976, {"xd5d", "XDCAM HD422 1080p24"}},
        {"xdcamhd422", 1080, WF_SCAN_WHOLE, WF_RATE_25, {"xd5e", "XDCAM HD422 1080p25"}},
        {"xdcamhd422", 1080, WF_SCAN_WHOLE, WF_RATE_29_97, {"xd5f", "XDCAM HD422 1080p30"}},
        {"xdcamhd422", 720, WF_SCAN_WHOLE, WF_RATE_50, {"xd5a", "XDCAM HD422 720p50"}},
        {"xdcamhd422", 720, WF_SCAN_WHOLE, WF_RATE_59_94, {"xd59", "XDCAM HD422 720p60"}},
        {"avci100", 1080, FIELDS, WF_RATE_25, {"ai15", "AVC-Intra 100 1080i50"}},
        {"avci100", 1080, FIELDS, WF_RATE_29_97, {"ai16", "AVC-Intra 100 1080i60"}},
        {"avci100", 1080, WF_SCAN_WHOLE, WF_RATE_25, {"ai12", "AVC-Intra 100 1080p25"}},
        {"avci100", 1080, WF_SCAN_WHOLE, WF_RATE_23_976, {"ai13", "AVC-Intra 100 1080p24"}},
        {"avci100", 1080, WF_SCAN_WHOLE, WF_RATE_29_97, {"ai13", "AVC-Intra 100 1080p30"}},
        {"avci100", 720, WF_SCAN_WHOLE, WF_RATE_50, {"ai1q", "AVC-Intra 100 720p50"}},
        {"avci100", 720, WF_SCAN_WHOLE, WF_RATE_59_94, {"ai1p", "AVC-Intra 100 720p60"}},
        /* libavformat takes 4:2:2 of 10 bits for AVC-Intra. */
        {"h264", 0, ANY_SCAN, 0, {"avc1", "H.264"}},
    };
    for (size_t i = 0; i < COUNT(marks); i++)
        if (!strcmp(delivery->kind.name, marks[i].codec) &&
            (!marks[i].lines || raster->lines == marks[i].lines) &&
            marks[i].scan & scan_of(raster) && rate_fits(marks[i].rates, raster->frame_rate))
            return marks[i].mark;
    return (wf_delivery_mark){"", NULL};
}

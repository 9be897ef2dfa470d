/* Samples of decoded sound as integers of 32 bits. */
#include "convert/media/libav/libav_samples.h"

#include <math.h>

static int32_t rounded(double x) {
    double scaled = x * 2147483648.0;
    if (!(scaled == scaled)) return 0;
    if (scaled >= 2147483647.0) return INT32_MAX;
    return scaled <= -2147483648.0 ? INT32_MIN : (int32_t)lrint(scaled);
}

/* Sample i of a plane. */
typedef int32_t take_fn(const void *plane, int i);

static int32_t take_u8(const void *plane, int i) {
    return (int32_t)((uint32_t)(((const uint8_t *)plane)[i] ^ 0x80) << 24);
}

static int32_t take_s16(const void *plane, int i) {
    return ((const int16_t *)plane)[i] * 65536;
}

static int32_t take_s32(const void *plane, int i) {
    return ((const int32_t *)plane)[i];
}

static int32_t take_s64(const void *plane, int i) {
    return (int32_t)(((const int64_t *)plane)[i] >> 32);
}

static int32_t take_flt(const void *plane, int i) {
    return rounded((double)((const float *)plane)[i]);
}

static int32_t take_dbl(const void *plane, int i) {
    return rounded(((const double *)plane)[i]);
}

static take_fn *take_of(int format) {
    static const struct {
        enum AVSampleFormat packed;
        take_fn *take;
    } rows[] = {{AV_SAMPLE_FMT_U8, take_u8},   {AV_SAMPLE_FMT_S16, take_s16},
                {AV_SAMPLE_FMT_S32, take_s32}, {AV_SAMPLE_FMT_S64, take_s64},
                {AV_SAMPLE_FMT_FLT, take_flt}, {AV_SAMPLE_FMT_DBL, take_dbl}};
    enum AVSampleFormat packed = av_get_packed_sample_fmt((enum AVSampleFormat)format);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (rows[i].packed == packed) return rows[i].take;
    return NULL;
}

bool wf_libav_samples(const AVFrame *f, int32_t *to) {
    take_fn *take = take_of(f->format);
    bool planar = av_sample_fmt_is_planar((enum AVSampleFormat)f->format);
    int channels = f->ch_layout.nb_channels;
    for (int c = 0; take && c < channels; c++) {
        const void *plane = f->extended_data[planar ? c : 0];
        for (int i = 0; i < f->nb_samples; i++)
            to[i * channels + c] = take(plane, planar ? i : i * channels + c);
    }
    return take;
}

/* Rates and times in EXR headers: framesPerSecond, weft:subframeRate, weft:time. */
#include "convert/media/exr_times.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

/* ---- Attributes ---- */

static const exr_attribute_t *attribute(exr_const_context_t exr, int part, const char *name) {
    const exr_attribute_t *found = NULL;
    return exr_get_attribute_by_name(exr, part, name, &found) ? NULL : found;
}

/* " 23.976 fps" is 24000/1001. */
static wf_rational ratio_of_text(const char *text) {
    char number[48];
    wf_rational ratio = {0, 0};
    text += strspn(text, " \t");
    size_t length = strcspn(text, " \tf");
    const char *rest = text + length + strspn(text + length, " \t");
    if (!strncmp(rest, "fps", 3)) rest += 3;
    rest += strspn(rest, " \t");
    if (*rest || length >= sizeof number) return ratio;
    memcpy(number, text, length);
    number[length] = '\0';
    wf_rate_parse(number, &ratio);
    return ratio;
}

static wf_rational ratio_of_real(double value) {
    if (value == 0) return wf_ratio(0, 1);
    wf_rational ratio = wf_rate_near(value < 0 ? -value : value);
    if (value < 0) ratio.num = -ratio.num;
    return ratio;
}

static wf_rational ratio_of(const exr_attribute_t *a) {
    switch (a->type) {
    case EXR_ATTR_RATIONAL:
        return wf_ratio(a->rational->num, (int64_t)a->rational->denom);
    case EXR_ATTR_V2I:
        return wf_ratio(a->v2i->x, a->v2i->y);
    case EXR_ATTR_INT:
        return wf_ratio(a->i, 1);
    case EXR_ATTR_FLOAT:
        return ratio_of_real((double)a->f);
    case EXR_ATTR_DOUBLE:
        return ratio_of_real(a->d);
    case EXR_ATTR_STRING:
        return ratio_of_text(a->string->str);
    default:
        return (wf_rational){0, 0};
    }
}

wf_rational wf_exr_ratio(exr_const_context_t exr, int part, const char *name) {
    const exr_attribute_t *found = attribute(exr, part, name);
    return found ? ratio_of(found) : (wf_rational){0, 0};
}

/* ---- Rates ---- */

/* The value as it stands in the file, for a message. */
static void value_text(const exr_attribute_t *a, char *text, size_t size) {
    switch (a->type) {
    case EXR_ATTR_RATIONAL:
        snprintf(text, size, "%" PRId32 "/%" PRIu32, a->rational->num, a->rational->denom);
        break;
    case EXR_ATTR_V2I:
        snprintf(text, size, "%" PRId32 "/%" PRId32, a->v2i->x, a->v2i->y);
        break;
    case EXR_ATTR_INT:
        snprintf(text, size, "%" PRId32, a->i);
        break;
    case EXR_ATTR_FLOAT:
        snprintf(text, size, "%.7g", (double)a->f);
        break;
    case EXR_ATTR_DOUBLE:
        snprintf(text, size, "%.9g", a->d);
        break;
    case EXR_ATTR_STRING:
        snprintf(text, size, "'%.32s'", a->string->str);
        break;
    default:
        snprintf(text, size, "of type %.24s", a->type_name);
        break;
    }
}

static bool is_rate(wf_rational rate) {
    return wf_ratio_given(rate) && wf_ratio_value(rate) >= 1e-3 && wf_ratio_value(rate) <= 1e6;
}

/* {0, 0} where there is none, and where it is absurd, which no_rate then tells. */
static wf_rational rate_of(exr_const_context_t exr, int part, const char *name,
                           wf_image_info *info) {
    const exr_attribute_t *found = attribute(exr, part, name);
    if (!found) return (wf_rational){0, 0};
    wf_rational rate = ratio_of(found);
    if (is_rate(rate)) return rate;
    char value[44];
    value_text(found, value, sizeof value);
    snprintf(info->no_rate, sizeof info->no_rate, "%s %s", name, value);
    return (wf_rational){0, 0};
}

void wf_exr_read_times(exr_const_context_t exr, int part, wf_image_info *info) {
    info->frames = rate_of(exr, part, "framesPerSecond", info);
    info->rate = rate_of(exr, part, "weft:subframeRate", info);
    info->counts_files = wf_ratio_given(info->rate);
    if (!info->counts_files) info->rate = info->frames;
    info->time_s = wf_exr_ratio(exr, part, "weft:time");
}

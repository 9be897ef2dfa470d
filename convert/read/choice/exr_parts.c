/* What parts an EXR has and which channels these have, for the choice of the picture. */
#include "convert/read/choice/exr_parts.h"

#include <stdlib.h>
#include <string.h>

const exr_attr_chlist_t *wf_exr_channels(exr_const_context_t exr, int part) {
    const exr_attr_chlist_t *list = NULL;
    return exr_get_channels(exr, part, &list) == EXR_ERR_SUCCESS ? list : NULL;
}

static bool is_flat(exr_const_context_t exr, int part) {
    exr_storage_t storage;
    return exr_get_storage(exr, part, &storage) == EXR_ERR_SUCCESS &&
           (storage == EXR_STORAGE_SCANLINE || storage == EXR_STORAGE_TILED);
}

/* The Cryptomatte specification (1.2) has its layers' names in attributes
 * cryptomatte/ID/name; channels are NAME00.R and so on. */
static void mark_cryptomatte(exr_const_context_t exr, int number, wf_channel *channel,
                             int count) {
    static const char begin[] = "cryptomatte/", end[] = "/name";
    int32_t attributes = 0;
    exr_get_attribute_count(exr, number, &attributes);
    for (int32_t i = 0; i < attributes; i++) {
        const exr_attribute_t *a = NULL;
        if (exr_get_attribute_by_index(exr, number, EXR_ATTR_LIST_FILE_ORDER, i, &a) || !a ||
            a->type != EXR_ATTR_STRING || strncmp(a->name, begin, sizeof begin - 1))
            continue;
        size_t length = strlen(a->name), name = strlen(a->string->str);
        if (length < sizeof end || strcmp(a->name + length + 1 - sizeof end, end) || !name)
            continue;
        for (int c = 0; c < count; c++)
            channel[c].ids |= !strncmp(channel[c].name, a->string->str, name);
    }
}

static int fill_part(exr_const_context_t exr, int number, wf_part *part, wf_channel *channel) {
    const exr_attr_chlist_t *list = wf_exr_channels(exr, number);
    const char *name = NULL;
    bool named = exr_get_name(exr, number, &name) == EXR_ERR_SUCCESS && name;
    *part = (wf_part){.name = named ? name : "",
                      .channel = channel,
                      .count = list ? list->num_channels : 0,
                      .flat = is_flat(exr, number)};
    for (int i = 0; i < part->count; i++) {
        const exr_attr_chlist_entry_t *c = &list->entries[i];
        channel[i] =
            (wf_channel){.name = c->name.str, .whole_numbers = c->pixel_type == EXR_PIXEL_UINT};
    }
    mark_cryptomatte(exr, number, channel, part->count);
    return part->count;
}

bool wf_exr_parts_find(exr_const_context_t exr, wf_exr_parts *out) {
    int count = 0, channels = 0;
    exr_get_count(exr, &count);
    for (int p = 0; p < count; p++) {
        const exr_attr_chlist_t *list = wf_exr_channels(exr, p);
        channels += list ? list->num_channels : 0;
    }
    *out = (wf_exr_parts){.part = calloc((size_t)count + 1, sizeof *out->part),
                          .channel = calloc((size_t)channels + 1, sizeof *out->channel),
                          .count = count};
    if (!out->part || !out->channel) {
        wf_exr_parts_free(out);
        return false;
    }
    for (int p = 0, used = 0; p < count; p++)
        used += fill_part(exr, p, &out->part[p], out->channel + used);
    return true;
}

void wf_exr_parts_free(wf_exr_parts *parts) {
    free(parts->part);
    free(parts->channel);
    *parts = (wf_exr_parts){0};
}

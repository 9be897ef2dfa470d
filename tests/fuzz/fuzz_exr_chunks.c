/* Chunks of EXR under damaged bytes. Four bytes choose compression, width, lines and channels;
 * the chunk follows. WEFT_FUZZ_CHUNK in the environment names the one compression that is
 * wanted, "piz" or "dwa". */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "convert/read/exr/decode.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

typedef struct kind {
    const char *name;
    exr_compression_t compression;
} kind;

static const kind kinds[] = {
    {"rle", EXR_COMPRESSION_RLE},  {"zip", EXR_COMPRESSION_ZIP},
    {"piz", EXR_COMPRESSION_PIZ},  {"pxr24", EXR_COMPRESSION_PXR24},
    {"dwa", EXR_COMPRESSION_DWAA},
};

/* Names and types, and the channel that is halved in both directions. */
typedef struct form {
    const char *name[6];
    wf_exr_type type[6];
    int channels, halved;
} form;

static const form forms[] = {
    {{"B", "G", "R"}, {WF_EXR_HALF, WF_EXR_HALF, WF_EXR_HALF}, 3, -1},
    {{"A", "B", "G", "R"}, {WF_EXR_FLOAT, WF_EXR_FLOAT, WF_EXR_FLOAT, WF_EXR_FLOAT}, 4, -1},
    {{"A", "B", "G", "R", "id"},
     {WF_EXR_HALF, WF_EXR_HALF, WF_EXR_FLOAT, WF_EXR_HALF, WF_EXR_UINT},
     5,
     -1},
    {{"BY", "RY", "Y"}, {WF_EXR_HALF, WF_EXR_HALF, WF_EXR_HALF}, 3, 1},
    {{"a.B", "a.G", "a.R", "b.B", "b.G", "b.R"},
     {WF_EXR_HALF, WF_EXR_HALF, WF_EXR_HALF, WF_EXR_HALF, WF_EXR_HALF, WF_EXR_HALF},
     6,
     -1},
};

static wf_exr_shape make_shape(const uint8_t *choice, wf_exr_channel *channel) {
    const form *f = &forms[choice[3] % 5];
    size_t width = 1 + choice[1] % 96, lines = 1 + choice[2] % 40;
    wf_exr_shape shape = {channel, f->channels, 0, (int)lines, 0};
    for (int c = 0; c < f->channels; c++) {
        size_t step = c == f->halved ? 2 : 1;
        wf_exr_channel *to = &channel[c];
        *to = (wf_exr_channel){.name = f->name[c],
                               .type = f->type[c],
                               .bytes = f->type[c] == WF_EXR_HALF ? 2 : 4,
                               .across = (int)step,
                               .down = (int)step,
                               .linear = choice[3] & 64,
                               .width = (width + step - 1) / step,
                               .lines = (lines + step - 1) / step};
        to->line_bytes = to->width * to->bytes;
        to->plane_bytes = to->line_bytes * to->lines;
        shape.bytes += to->plane_bytes;
    }
    return shape;
}

static wf_exr_decode_fn *choose(uint8_t choice) {
    const char *wanted = getenv("WEFT_FUZZ_CHUNK");
    for (size_t k = 0; wanted && k < 5; k++)
        if (!strcmp(kinds[k].name, wanted)) choice = (uint8_t)k;
    return wf_exr_decode_of(kinds[choice % 5].compression);
}

/* Samples and bytes lie in blocks of just their sizes, for the sanitizer to see where they end.
 */
static void decode(const uint8_t *choice, const uint8_t *data, size_t size) {
    wf_exr_decoder decoder;
    wf_exr_channel channel[6];
    weft_error err = {""};
    wf_exr_shape shape = make_shape(choice, channel);
    uint8_t *packed = malloc(size ? size : 1), *out = malloc(shape.bytes);
    if (!packed || !out || !wf_exr_decoder_init(&decoder)) abort();
    memcpy(packed, data, size);
    weft_status status = choose(choice[0])(&decoder, &shape, packed, size, out, &err);
    if (status == WEFT_FAILED && !*err.text) abort(); /* every failure says why */
    if (status != WEFT_OK && status != WEFT_FAILED) abort();
    if (decoder.inflated_capacity > 64 * shape.bytes + 65536) abort();
    if (decoder.words_capacity > 64 * shape.bytes + 65536) abort();
    wf_exr_decoder_free(&decoder);
    free(packed);
    free(out);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    if (size >= 4) decode(data, data + 4, size - 4);
    return 0;
}

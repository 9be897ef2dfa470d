/* WAV as sound of an output: its header, and all that follows, from a place that the last byte
 * says. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "convert/base/module.h"
#include "convert/media/sound_reader.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { COUNT = 1601, BLOCKS = 20 };

static const wf_sound_reader *reader_of_module(void) {
    void *symbol;
    wf_libav_sound_fn *reader;
    if (wf_module_symbol("libav", "wf_libav_sound", "sound", &symbol, NULL)) return NULL;
    memcpy(&reader, &symbol, sizeof reader);
    return reader();
}

/* What is beyond the end is 0. */
static weft_status read_all(const wf_sound_reader *reader, void *state, int channels,
                            const wf_sound_start *start, weft_error *err) {
    int32_t *to = malloc((size_t)COUNT * (size_t)channels * sizeof *to);
    int64_t got = COUNT;
    if (!to) abort();
    weft_status status = reader->begin(state, start, err);
    for (int n = 0; !status && n < BLOCKS && got == COUNT; n++) {
        status = reader->read(state, to, COUNT, &got, err);
        if (!status && (got < 0 || got > COUNT)) abort();
        for (int64_t i = got * channels; !status && i < (int64_t)COUNT * channels; i++)
            if (to[i]) abort();
    }
    free(to);
    return status;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    const wf_sound_reader *reader = reader_of_module();
    bool is_wav = size > 12 && !memcmp(data, "RIFF", 4) && !memcmp(data + 8, "WAVE", 4);
    if (!reader || !is_wav) return 0;
    const int place = data[size - 1];
    const wf_sound_start start = {.start_s = wf_ratio(place - 128, 64),
                                  .speed = place % 2 ? wf_ratio(1000, 1001) : wf_ratio(1, 1)};
    char path[64];
    int descriptor = memfd_create("sound.wav", 0);
    if (descriptor < 0 || write(descriptor, data, size) != (ssize_t)size) abort();
    snprintf(path, sizeof path, "/proc/self/fd/%d", descriptor);
    void *state = NULL;
    wf_sound_info info = {0};
    weft_error err = {""};
    weft_status status = reader->open(path, false, &state, &info, &err);
    if (!status && info.channels) status = read_all(reader, state, info.channels, &start, &err);
    if (status && !*err.text) abort(); /* every failure says why */
    reader->close(state);
    close(descriptor);
    return 0;
}

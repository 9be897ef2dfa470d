/* Reads the header of a Y4M stream. */
#include "convert/media/y4m.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static int read_size(const char *text) {
    char *end;
    long value = strtol(text, &end, 10);
    return *end || value < 1 || value > 1 << 20 ? 0 : (int)value;
}

/* Bits that follow "p", or "mono" itself; 0: that is no number of bits. */
static int read_depth(const char *text) {
    char *end;
    long bits = *text >= '0' && *text <= '9' ? strtol(text, &end, 10) : 0;
    return bits >= 8 && bits <= 16 && !*end ? (int)bits : 0;
}

static bool is_one_of(const char *word, const char *const words[]) {
    while (*words && strcmp(*words, word)) words++;
    return *words;
}

/* "420jpeg", "422p10", "444alpha", "mono12". What follows a sampling says how many bits there
 * are, so that one that is not known may not be passed over. */
static void read_chroma(wf_y4m *h) {
    static const struct {
        const char *name, *depth;
        int across, down;
        const char *const eight_bits[5];
    } samplings[] = {{"420", "p", 2, 2, {"", "jpeg", "mpeg2", "paldv", NULL}},
                     {"422", "p", 2, 1, {"", NULL}},
                     {"444", "p", 1, 1, {"", "alpha", NULL}},
                     {"411", "p", 4, 1, {"", NULL}},
                     {"mono", "", 0, 0, {"", NULL}}};
    for (size_t i = 0; i < sizeof samplings / sizeof *samplings; i++) {
        size_t length = strlen(samplings[i].name), mark = strlen(samplings[i].depth);
        if (strncmp(h->chroma, samplings[i].name, length)) continue;
        const char *rest = h->chroma + length;
        bool deep = !strncmp(rest, samplings[i].depth, mark);
        h->bits = is_one_of(rest, samplings[i].eight_bits) ? 8
                  : deep                                   ? read_depth(rest + mark)
                                                           : 0;
        h->across = samplings[i].across;
        h->down = samplings[i].down;
        h->alpha = !strcmp(rest, "alpha");
        h->known = h->bits > 0;
        return;
    }
}

bool wf_y4m_parse(char *line, wf_y4m *out) {
    *out = (wf_y4m){.chroma = "420jpeg"}; /* what the format presumes */
    char *rest = line + strlen(WF_Y4M_MAGIC);
    for (const char *word; (word = strsep(&rest, " "));) {
        if (*word == 'W') out->width_px = read_size(word + 1);
        if (*word == 'H') out->lines = read_size(word + 1);
        if (*word == 'F') wf_ratio_parse(word + 1, &out->rate);
        if (*word == 'A') wf_ratio_parse(word + 1, &out->aspect);
        if (*word == 'I') out->order = word[1];
        if (*word == 'C') snprintf(out->chroma, sizeof out->chroma, "%s", word + 1);
        if (!strcmp(word, "XCOLORRANGE=FULL")) out->full_range = true;
        if (!strncmp(word, "XCOLORRANGE=", 12)) out->range_said = true;
    }
    read_chroma(out);
    return out->width_px && out->lines && wf_ratio_given(out->rate) && out->rate.num > 0;
}

int64_t wf_y4m_frame_bytes(const wf_y4m *y4m) {
    if (!y4m->known) return 0;
    int64_t across = y4m->across, down = y4m->down;
    int64_t samples = (int64_t)y4m->width_px * y4m->lines * (y4m->alpha ? 2 : 1);
    if (across)
        samples +=
            2 * ((y4m->width_px + across - 1) / across) * ((y4m->lines + down - 1) / down);
    return samples * (y4m->bits > 8 ? 2 : 1);
}

int64_t wf_y4m_count(const wf_y4m *y4m, FILE *file, int64_t header_bytes) {
    struct stat about;
    int64_t each = wf_y4m_frame_bytes(y4m) + (int64_t)strlen("FRAME\n");
    if (!y4m->known || header_bytes < 0 || fstat(fileno(file), &about) ||
        !S_ISREG(about.st_mode))
        return -1;
    int64_t rest = about.st_size - header_bytes;
    return rest % each ? -1 : rest / each;
}

const char *wf_y4m_order(const wf_y4m *y4m) {
    static const struct {
        char letter;
        const char *name;
    } orders[] = {
        {'p', "progressive"}, {'t', "top first"}, {'b', "bottom first"}, {'m', "mixed"}};
    for (size_t i = 0; i < sizeof orders / sizeof *orders; i++)
        if (orders[i].letter == y4m->order) return orders[i].name;
    return "unknown";
}

/* Y4M headers for 'weft info'. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "convert/cmd_info.h"
#include "convert/fail.h"

static const char magic[] = "YUV4MPEG2";

typedef struct header {
    int width_px, lines;
    wf_rational rate, aspect; /* {0, 0}: unknown, which aspects may be */
    const char *order, *chroma;
    size_t bytes; /* of the line, its end included */
} header;

static const char *order_name(char letter) {
    static const struct {
        char letter;
        const char *name;
    } orders[] = {
        {'p', "progressive"}, {'t', "top first"}, {'b', "bottom first"}, {'m', "mixed"}};
    for (size_t i = 0; i < sizeof orders / sizeof *orders; i++)
        if (orders[i].letter == letter) return orders[i].name;
    return "unknown";
}

static int read_size(const char *text) {
    char *end;
    long value = strtol(text, &end, 10);
    return *end || value < 1 || value > 1 << 20 ? 0 : (int)value;
}

/* Reads the blank separated words of the header, in place. */
static bool parse_header(char *line, header *out) {
    *out = (header){.order = "unknown", .chroma = "420jpeg"}; /* what the format presumes */
    char *rest = line + strlen(magic);
    for (const char *word; (word = strsep(&rest, " "));) {
        if (*word == 'W') out->width_px = read_size(word + 1);
        if (*word == 'H') out->lines = read_size(word + 1);
        if (*word == 'F') wf_ratio_parse(word + 1, &out->rate);
        if (*word == 'A') wf_ratio_parse(word + 1, &out->aspect);
        if (*word == 'I') out->order = order_name(word[1]);
        if (*word == 'C') out->chroma = word + 1;
    }
    return out->width_px && out->lines && wf_ratio_given(out->rate);
}

/* Bytes of a frame; 0 for a chroma name that is not known here. */
static int64_t frame_bytes(const header *h) {
    static const struct {
        const char *name;
        int across, down; /* luma samples to a chroma sample; 0: no chroma */
    } samplings[] = {
        {"420", 2, 2}, {"422", 2, 1}, {"444", 1, 1}, {"411", 4, 1}, {"mono", 0, 0}};
    for (size_t i = 0; i < sizeof samplings / sizeof *samplings; i++) {
        size_t length = strlen(samplings[i].name);
        if (strncmp(h->chroma, samplings[i].name, length)) continue;
        int64_t across = samplings[i].across, down = samplings[i].down;
        int64_t samples = (int64_t)h->width_px * h->lines;
        if (across)
            samples +=
                2 * ((h->width_px + across - 1) / across) * ((h->lines + down - 1) / down);
        const char *depth = h->chroma + length + (h->chroma[length] == 'p');
        return samples * (atoi(depth) > 8 ? 2 : 1);
    }
    return 0;
}

/* Whole frames after the header, if they carry no parameters of their own; -1: unknown. */
static int64_t count_frames(FILE *file, const header *h) {
    struct stat about;
    int64_t each = frame_bytes(h) + (int64_t)strlen("FRAME\n");
    if (fstat(fileno(file), &about) || !S_ISREG(about.st_mode) || !frame_bytes(h)) return -1;
    int64_t rest = about.st_size - (int64_t)h->bytes;
    return rest % each ? -1 : rest / each;
}

static void tell_header(FILE *file, const header *h, wf_facts *facts) {
    int64_t frames = count_frames(file, h);
    wf_fact_text(facts, "kind", "video");
    wf_fact_text(facts, "format", "YUV4MPEG2");
    wf_fact_int(facts, "width", h->width_px);
    wf_fact_int(facts, "height", h->lines);
    wf_fact_ratio(facts, "frame_rate", h->rate, '/');
    wf_fact_text(facts, "order", h->order);
    if (wf_ratio_given(h->aspect) && h->aspect.num)
        wf_fact_ratio(facts, "pixel_aspect", h->aspect, ':');
    wf_fact_text(facts, "chroma", h->chroma);
    if (frames >= 0) wf_fact_int(facts, "frames", frames);
}

weft_status wf_info_y4m(const char *path, wf_facts *facts, bool *is_y4m, weft_error *err) {
    char line[1024];
    header h;
    FILE *file = fopen(path, "rb");
    if (!file) return wf_fail(err, WEFT_FAILED, "%s: %s", path, strerror(errno));
    size_t got = fread(line, 1, sizeof line - 1, file);
    line[got] = '\0';
    char *end = memchr(line, '\n', got);
    *is_y4m = got > strlen(magic) && !memcmp(line, magic, strlen(magic));
    if (end) *end = '\0';
    weft_status status = WEFT_OK;
    if (*is_y4m && end && parse_header(line, &h)) {
        h.bytes = (size_t)(end - line) + 1;
        tell_header(file, &h, facts);
    } else if (*is_y4m) {
        status = wf_fail(
            err, WEFT_FAILED,
            "%s: the Y4M header is not whole; it has W, H and F within its first line", path);
    } else if (ferror(file)) {
        status = wf_fail(err, WEFT_FAILED, "%s: %s", path, strerror(errno));
    }
    fclose(file);
    return status;
}

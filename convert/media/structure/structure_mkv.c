/* Matroska's structure (RFC 9559, EBML RFC 8794): elements to the last byte, stated lengths,
 * the SegmentUID, and which tracks of sound are heard. */
#include <inttypes.h>
#include <string.h>

#include "convert/base/big_endian.h"
#include "convert/media/structure/extent.h"

#define UNKNOWN UINT64_MAX
#define DEEPEST 6

enum {
    SEGMENT = 0x18538067,
    SEEK_HEAD = 0x114d9b74,
    SEEK = 0x4dbb,
    SEEK_ID = 0x53ab,
    SEEK_POSITION = 0x53ac,
    INFO = 0x1549a966,
    SEGMENT_UID = 0x73a4,
    TICK_NS = 0x2ad7b1,
    DURATION = 0x4489,
    TRACKS = 0x1654ae6b,
    TRACK = 0xae,
    TRACK_UID = 0x73c5,
    TRACK_KIND = 0x83,
    ENABLED = 0xb9,
    TAGS = 0x1254c367,
    TAG = 0x7373,
    TARGETS = 0x63c0,
    TAG_TRACK_UID = 0x63c5,
    SIMPLE_TAG = 0x67c8,
    TAG_NAME = 0x45a3,
    TAG_STRING = 0x4487
};
enum { VIDEO = 1, SOUND = 2 };

typedef struct element {
    uint32_t id;
    int64_t at, body, next; /* next: of one of unknown size, where its parent ends */
    bool unknown;
} element;

typedef struct segment {
    const wf_extent *x;
    wf_structure *s;
    int64_t body; /* that positions are counted from */
    uint64_t tick_ns;
    double duration;    /* in ticks */
    uint64_t video_uid; /* of the first track of pictures */
    /* Of the track, the entry of the seek head or the tag that is read. */
    uint64_t uid, seek_id, seek_position;
    int kind;
    bool enabled;
    char name[24], text[48];
    bool unknown; /* its size, or a cluster's */
} segment;

/* ---- Numbers ---- */

/* A number that states its own length by its leading zeros; `marked` keeps that mark. Returns
 * its bytes; 0: it is none. */
static int read_vint(const wf_extent *x, int64_t at, bool marked, uint64_t *value) {
    uint8_t b[8];
    if (!wf_extent_read(x, at, b, 1) || !b[0]) return 0;
    int bytes = __builtin_clz(b[0]) - 23;
    if (!wf_extent_read(x, at, b, (size_t)bytes)) return 0;
    uint64_t all = wf_big_endian(b, (size_t)bytes), mark = (uint64_t)1 << 7 * bytes;
    *value = marked ? all : all & (mark - 1);
    if (!marked && *value == mark - 1) *value = UNKNOWN;
    return bytes;
}

static uint64_t number(const wf_extent *x, const element *e) {
    uint8_t b[8];
    int64_t bytes = e->next - e->body;
    return bytes > 0 && bytes <= 8 && wf_extent_read(x, e->body, b, (size_t)bytes)
               ? wf_big_endian(b, (size_t)bytes)
               : 0;
}

static double real(const wf_extent *x, const element *e) {
    uint64_t bits = number(x, e);
    uint32_t half = (uint32_t)bits;
    double wide;
    float narrow;
    memcpy(&wide, &bits, sizeof wide);
    memcpy(&narrow, &half, sizeof narrow);
    return e->next - e->body == 4 ? (double)narrow : e->next - e->body == 8 ? wide : 0;
}

static void text_of(const wf_extent *x, const element *e, char *to, size_t size) {
    int64_t bytes = e->next - e->body;
    size_t count = bytes < (int64_t)size - 1 ? (size_t)bytes : size - 1;
    memset(to, 0, size);
    if (!wf_extent_read(x, e->body, to, count)) *to = '\0';
}

/* False at the end of the parent, and where no element stands there that fits into it. */
static bool next_element(const wf_extent *x, int64_t at, int64_t end, element *out) {
    uint64_t id, size;
    int head = at < end ? read_vint(x, at, true, &id) : 0;
    int more = head && head <= 4 ? read_vint(x, at + head, false, &size) : 0;
    if (!more) return false;
    *out = (element){.id = (uint32_t)id, .at = at, .body = at + head + more};
    out->unknown = size == UNKNOWN;
    if (out->body > end || (!out->unknown && size > (uint64_t)(end - out->body))) return false;
    out->next = out->unknown ? end : out->body + (int64_t)size;
    return true;
}

/* ---- What elements say ---- */

/* "00:00:00.400000000" */
static double seconds_of(const char *text) {
    int hours, minutes;
    double seconds;
    if (sscanf(text, "%d:%d:%lf", &hours, &minutes, &seconds) != 3) return 0;
    return 3600.0 * hours + 60.0 * minutes + seconds;
}

static void finish_tag(segment *g) {
    bool of_video = !g->uid || g->uid == g->video_uid;
    if (!strcmp(g->name, "DURATION") && of_video)
        wf_state(g->s, "DURATION", seconds_of(g->text), 1e-9 * (double)g->tick_ns, false);
}

static void finish_track(segment *g) {
    if (g->kind == VIDEO && !g->video_uid) g->video_uid = g->uid;
    g->s->sound_tracks += g->kind == SOUND;
    g->s->sound_disabled += g->kind == SOUND && !g->enabled;
}

/* The head says where the parts of the segment are. */
static void finish_seek(segment *g) {
    uint64_t id;
    int64_t at = g->body + (int64_t)g->seek_position;
    if (g->seek_position > (uint64_t)g->x->bytes || !read_vint(g->x, at, true, &id) ||
        id != g->seek_id)
        wf_missing(g->s, "what its seek head has at byte %" PRId64 " is not there", at);
}

static void read_uid(segment *g, const element *e) {
    if (e->next - e->body == 16)
        g->s->has_id[0] = wf_extent_read(g->x, e->body, g->s->id[0], 16);
}

static void read_value(segment *g, const element *e) {
    switch (e->id) {
    case SEEK_ID:
        g->seek_id = number(g->x, e);
        break;
    case SEEK_POSITION:
        g->seek_position = number(g->x, e);
        break;
    case TICK_NS:
        g->tick_ns = number(g->x, e);
        break;
    case DURATION:
        g->duration = real(g->x, e);
        break;
    case TRACK_UID:
    case TAG_TRACK_UID:
        g->uid = number(g->x, e);
        break;
    case TRACK_KIND:
        g->kind = (int)number(g->x, e);
        break;
    case ENABLED:
        g->enabled = number(g->x, e) != 0;
        break;
    case TAG_NAME:
        text_of(g->x, e, g->name, sizeof g->name);
        break;
    case TAG_STRING:
        text_of(g->x, e, g->text, sizeof g->text);
        break;
    case SEGMENT_UID:
        read_uid(g, e);
        break;
    default:
        break;
    }
}

static bool holds_others(uint32_t id) {
    static const uint32_t ids[] = {SEEK_HEAD, SEEK, INFO,    TRACKS,    TRACK,
                                   TAGS,      TAG,  TARGETS, SIMPLE_TAG};
    for (size_t i = 0; i < sizeof ids / sizeof *ids; i++)
        if (ids[i] == id) return true;
    return false;
}

static void begin_part(segment *g, uint32_t id) {
    if (id == TRACK || id == TAG) g->uid = 0;
    if (id == TRACK) g->kind = 0, g->enabled = true;
    if (id == SIMPLE_TAG) *g->name = *g->text = '\0';
}

static void end_part(segment *g, uint32_t id) {
    if (id == TRACK) finish_track(g);
    if (id == SIMPLE_TAG) finish_tag(g);
    if (id == SEEK) finish_seek(g);
}

/* Returns where reading stopped, which is `end` if what is read is whole. */
static int64_t descend(segment *g, int64_t at, int64_t end, int depth) {
    for (element e; depth < DEEPEST && next_element(g->x, at, end, &e); at = e.next) {
        g->unknown |= e.unknown;
        if (e.unknown) { /* what it holds is read as if it stood beside it */
            e.next = e.body;
        } else if (holds_others(e.id)) {
            begin_part(g, e.id);
            descend(g, e.body, e.next, depth + 1);
            end_part(g, e.id);
        } else {
            read_value(g, &e);
        }
    }
    return at;
}

static void read_segment(const wf_extent *x, const element *e, wf_structure *s) {
    segment g = {.x = x, .s = s, .body = e->body, .tick_ns = 1000000};
    g.unknown = e->unknown;
    int64_t end = descend(&g, e->body, e->next, 0);
    if (end < e->next) wf_missing(s, "it ends within what begins at byte %" PRId64, end);
    wf_state(s, "Duration", g.duration * 1e-9 * (double)g.tick_ns, 1e-9 * (double)g.tick_ns,
             true);
    s->ends = !g.unknown;
}

void wf_structure_mkv(const wf_extent *x, wf_structure *s) {
    int64_t at = 0;
    bool found = false;
    for (element e; next_element(x, at, x->bytes, &e); at = e.next) {
        if (e.id != SEGMENT || found) continue;
        found = true;
        read_segment(x, &e, s);
    }
    if (at < x->bytes) wf_missing(s, "it ends within what begins at byte %" PRId64, at);
    if (!found) wf_missing(s, "its segment is not there");
}

/* MXF's structure (SMPTE ST 377-1): triplets to the last byte, partitions, random index pack.
 */
#include <inttypes.h>
#include <string.h>

#include "convert/base/big_endian.h"
#include "convert/media/klv.h"
#include "convert/media/structure/extent.h"

#define RUN_IN_MOST    65536
#define PARTITION_MOST 65536 /* that are compared with the random index pack */
#define PACK_BYTES     88    /* of a partition pack without its essence containers */
#define STATUS_AT      14    /* in its key */
#define SET_MOST       65535
#define TRACKS_MOST    64 /* whose edit rates are remembered */

enum { HEADER = 2, BODY = 3, FOOTER = 4 };

/* A track's edit rate, for the sequence that it plays. */
typedef struct edit_rate {
    uint8_t sequence[WF_KLV_KEY_BYTES];
    uint32_t num, den;
} edit_rate;

typedef struct partitions {
    wf_structure *s;
    int64_t run_in;        /* bytes before the header partition */
    int64_t last, footer;  /* where the latest partition is, and the footer; -1: none yet */
    int64_t stated_footer; /* 0: no closed partition states it */
    int64_t index_at;      /* of the random index pack; -1: none */
    uint64_t count;
    int kind; /* of the partition that is read */
    edit_rate rates[TRACKS_MOST];
    int tracks;
} partitions;

static bool begins(const uint8_t *key, const uint8_t *with, size_t bytes) {
    return !memcmp(key, with, bytes);
}

static bool is_partition(const uint8_t *key) {
    static const uint8_t pack[] = {0x06, 0x0e, 0x2b, 0x34, 0x02, 0x05, 0x01,
                                   0x01, 0x0d, 0x01, 0x02, 0x01, 0x01};
    return begins(key, pack, sizeof pack) && key[13] >= HEADER && key[13] <= FOOTER;
}

static bool is_random_index(const uint8_t *key) {
    static const uint8_t pack[] = {0x06, 0x0e, 0x2b, 0x34, 0x02, 0x05, 0x01, 0x01,
                                   0x0d, 0x01, 0x02, 0x01, 0x01, 0x11, 0x01};
    return begins(key, pack, sizeof pack);
}

/* ---- Partitions ---- */

static wf_mxf_status status_of(const uint8_t *key) {
    return key[STATUS_AT] >= WF_MXF_OPEN_INCOMPLETE && key[STATUS_AT] <= WF_MXF_CLOSED_COMPLETE
               ? key[STATUS_AT]
               : WF_MXF_NO_PARTITION;
}

static void note_partition(partitions *p, const wf_klv *k, int64_t at, const uint8_t *pack) {
    int64_t here = (int64_t)wf_big_endian(pack + 8, 8) + p->run_in;
    int64_t before = (int64_t)wf_big_endian(pack + 16, 8) + p->run_in;
    int64_t footer = (int64_t)wf_big_endian(pack + 24, 8);
    wf_mxf_status status = status_of(k->key);
    p->kind = k->key[13];
    if (here != at)
        wf_missing(p->s, "the partition at %" PRId64 " says it is at %" PRId64, at, here);
    if (p->last >= 0 && before != p->last)
        wf_missing(p->s, "the partition before that at %" PRId64 " is not where it says", at);
    if (footer && (status == WF_MXF_CLOSED_COMPLETE || status == WF_MXF_CLOSED_INCOMPLETE))
        p->stated_footer = footer + p->run_in;
    if (p->kind == HEADER) p->s->header = status;
    if (p->kind == FOOTER) p->footer = at;
    if (p->kind == FOOTER && wf_big_endian(pack + 32, 8)) p->s->footer = status;
    p->last = at;
    p->count++;
}

/* Entries are a stream's number and where the partition is; the pack's own length follows. */
static void check_random_index(const wf_extent *x, partitions *p) {
    uint8_t head[WF_KLV_HEAD_BYTES], entry[12], length[4];
    wf_klv k;
    if (!wf_extent_read(x, p->index_at, head, sizeof head) ||
        !wf_klv_parse(head, sizeof head, p->index_at, &k) ||
        !wf_extent_read(x, k.next - 4, length, sizeof length))
        return wf_missing(p->s, "its random index pack is not whole");
    uint64_t entries = (uint64_t)(k.next - k.value) / sizeof entry;
    if ((int64_t)wf_big_endian(length, 4) != k.next - p->index_at || k.next != x->bytes)
        wf_missing(p->s, "its random index pack does not end the file");
    if (entries != p->count)
        wf_missing(p->s, "of %" PRIu64 " partitions %" PRIu64 " are there", entries, p->count);
    for (uint64_t i = 0; i < entries && i < PARTITION_MOST; i++) {
        uint8_t key[WF_KLV_KEY_BYTES] = {0};
        int64_t at = k.value + (int64_t)(i * sizeof entry);
        if (!wf_extent_read(x, at, entry, sizeof entry) ||
            !wf_extent_read(x, (int64_t)wf_big_endian(entry + 4, 8) + p->run_in, key,
                            sizeof key) ||
            !is_partition(key))
            wf_missing(p->s, "there is no partition where its random index pack has one");
    }
}

static void check_partitions(const wf_extent *x, partitions *p) {
    if (p->footer < 0)
        wf_missing(p->s, "its footer partition is not there");
    else if (p->stated_footer && p->stated_footer != p->footer)
        wf_missing(p->s, "its footer partition is not where it says");
    if (p->index_at < 0)
        wf_missing(p->s, "its random index pack is not there");
    else
        check_random_index(x, p);
}

/* ---- Sets of the header ---- */

static void read_package(const uint8_t *set, size_t bytes, int which, wf_structure *s) {
    size_t length, at = wf_klv_item(set, bytes, WF_MXF_PACKAGE_ID, &length);
    if (length != WF_ID_BYTES || s->has_id[which]) return;
    memcpy(s->id[which], set + at, WF_ID_BYTES);
    s->has_id[which] = true;
}

static void read_descriptor(const uint8_t *set, size_t bytes, wf_structure *s) {
    size_t length, rate_length;
    size_t at = wf_klv_item(set, bytes, 0x3002, &length);
    size_t rate = wf_klv_item(set, bytes, 0x3001, &rate_length);
    if (length != 8 || rate_length != 8) return;
    double units = (double)(int64_t)wf_big_endian(set + at, 8);
    double num = (double)wf_big_endian(set + rate, 4);
    double den = (double)wf_big_endian(set + rate + 4, 4);
    if (num > 0) wf_state(s, "ContainerDuration", units * den / num, 0, false);
}

static void read_track(const uint8_t *set, size_t bytes, partitions *p) {
    size_t length, rate_length, at = wf_klv_item(set, bytes, 0x4803, &length);
    size_t rate = wf_klv_item(set, bytes, 0x4b01, &rate_length);
    if (length != WF_KLV_KEY_BYTES || rate_length != 8 || p->tracks == TRACKS_MOST) return;
    edit_rate *r = &p->rates[p->tracks++];
    memcpy(r->sequence, set + at, sizeof r->sequence);
    r->num = (uint32_t)wf_big_endian(set + rate, 4);
    r->den = (uint32_t)wf_big_endian(set + rate + 4, 4);
}

/* Of pictures: the last eight bytes of the label of its data. */
static bool is_of_pictures(const uint8_t *set, size_t bytes) {
    static const uint8_t label[] = {0x01, 0x03, 0x02, 0x02, 0x01};
    size_t length, at = wf_klv_item(set, bytes, 0x0201, &length);
    return length == WF_KLV_KEY_BYTES && !memcmp(set + at + 8, label, sizeof label);
}

static void read_sequence(const uint8_t *set, size_t bytes, partitions *p) {
    size_t length, id_length, at = wf_klv_item(set, bytes, 0x0202, &length);
    size_t id = wf_klv_item(set, bytes, 0x3c0a, &id_length);
    if (length != 8 || id_length != WF_KLV_KEY_BYTES || !is_of_pictures(set, bytes)) return;
    double units = (double)(int64_t)wf_big_endian(set + at, 8);
    for (int i = 0; i < p->tracks; i++) {
        const edit_rate *r = &p->rates[i];
        if (r->num && !memcmp(r->sequence, set + id, sizeof r->sequence))
            wf_state(p->s, "Duration", units * r->den / r->num, 0, false);
    }
}

enum { SEQUENCE = 0x0f, MATERIAL = 0x36, SOURCE = 0x37, TRACK = 0x3b };

static void read_set(const wf_extent *x, const wf_klv *k, partitions *p) {
    uint8_t set[SET_MOST];
    int kind = wf_klv_set_kind(k->key);
    bool picture = wf_klv_is_picture(kind);
    bool wanted =
        picture || kind == SEQUENCE || kind == MATERIAL || kind == SOURCE || kind == TRACK;
    size_t bytes = (size_t)(k->next - k->value);
    if (!wanted || bytes > sizeof set || !wf_extent_read(x, k->value, set, bytes)) return;
    if (picture) read_descriptor(set, bytes, p->s);
    if (kind == TRACK) read_track(set, bytes, p);
    if (kind == SEQUENCE) read_sequence(set, bytes, p);
    if (kind == MATERIAL || kind == SOURCE) read_package(set, bytes, kind == SOURCE, p->s);
}

/* ---- The file ---- */

static int64_t find_header(const wf_extent *x) {
    uint8_t key[WF_KLV_KEY_BYTES];
    for (int64_t at = 0; at < RUN_IN_MOST; at++)
        if (!wf_extent_read(x, at, key, sizeof key))
            return -1;
        else if (is_partition(key) && key[13] == HEADER)
            return at;
    return -1;
}

static void take_triplet(const wf_extent *x, const wf_klv *k, int64_t at, partitions *p) {
    uint8_t pack[PACK_BYTES];
    if (is_random_index(k->key)) p->index_at = at;
    if (is_partition(k->key) && wf_extent_read(x, k->value, pack, sizeof pack))
        note_partition(p, k, at, pack);
    if (p->kind != BODY) read_set(x, k, p);
}

void wf_structure_mxf(const wf_extent *x, wf_structure *s) {
    partitions p = {.s = s, .run_in = find_header(x), .last = -1, .footer = -1, .index_at = -1};
    s->ends = true;
    if (p.run_in < 0) return wf_missing(s, "its header partition is not there");
    for (int64_t at = p.run_in; at < x->bytes;) {
        uint8_t head[WF_KLV_HEAD_BYTES];
        wf_klv k;
        int64_t left = x->bytes - at;
        size_t count = left < (int64_t)sizeof head ? (size_t)left : sizeof head;
        if (!wf_extent_read(x, at, head, count) || !wf_klv_parse(head, count, at, &k) ||
            k.next > x->bytes)
            return wf_missing(s, "it ends within what begins at byte %" PRId64, at);
        take_triplet(x, &k, at, &p);
        at = k.next;
    }
    check_partitions(x, &p);
}

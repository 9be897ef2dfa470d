/* The structure of MPEG's streams (ISO/IEC 13818-1), which do not say where they end: packets
 * to the last byte. */
#include <inttypes.h>
#include <stdlib.h>

#include "convert/base/big_endian.h"
#include "convert/media/structure/extent.h"

#define SYNC 0x47

/* ---- Transport streams ---- */

/* Packets have 188 bytes, with a time before them 192, with error correction 204. */
static int packet_bytes(const wf_extent *x, int64_t *first) {
    static const int sizes[] = {188, 192, 204};
    uint8_t b[3];
    for (int64_t at = 0; at < 204; at++)
        for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
            bool synced = true;
            for (int k = 0; k < 3; k++)
                synced &= wf_extent_read(x, at + k * sizes[i], b, 1) && b[0] == SYNC;
            *first = sizes[i] == 192 ? at - 4 : at;
            if (synced) return sizes[i];
        }
    return 0;
}

#define PIDS        8192
#define TS_BYTES    188
#define NOT_STARTED (-2)
#define UNBOUNDED   (-1)

/* What is known of the latest packet of a stream (PES) by the packets that carry it. */
typedef struct pes {
    int64_t left; /* bytes that are still to come; or UNBOUNDED, NOT_STARTED */
    bool stuffed; /* its last carrier is not full, as the last of a packet rarely is */
} pes;

/* How many bytes of payload a carrier has, and where they begin. */
static int payload_of(const uint8_t packet[TS_BYTES], int *from) {
    bool has_payload = packet[3] & 0x10, adapted = packet[3] & 0x20;
    *from = adapted ? 5 + packet[4] : 4;
    return has_payload && *from < TS_BYTES ? TS_BYTES - *from : 0;
}

static void carry(pes *p, const uint8_t packet[TS_BYTES]) {
    int from, bytes = payload_of(packet, &from);
    const uint8_t *b = packet + from;
    bool starts = packet[1] & 0x40;
    if (starts && bytes >= 6 && wf_big_endian(b, 3) == 1) {
        int64_t length = (int64_t)wf_big_endian(b + 4, 2);
        p->left = length ? length + 6 : UNBOUNDED;
    }
    if (!bytes || p->left == NOT_STARTED) return;
    p->stuffed = bytes < TS_BYTES - 4;
    if (p->left > 0) p->left = p->left > bytes ? p->left - bytes : 0;
}

static void check_streams(const wf_extent *x, int64_t at, int step, wf_structure *s) {
    pes *of = malloc(PIDS * sizeof *of);
    uint8_t packet[TS_BYTES];
    if (!of) return;
    for (int i = 0; i < PIDS; i++) of[i] = (pes){NOT_STARTED, true};
    for (; wf_extent_read(x, at, packet, sizeof packet); at += step)
        carry(&of[wf_big_endian(packet + 1, 2) & 0x1fff], packet);
    for (int i = 0; i < PIDS; i++) {
        if (of[i].left > 0) wf_missing(s, "the last packet of stream %d is not whole", i);
        if (of[i].left == UNBOUNDED && !of[i].stuffed)
            s->doubt = "it does not say where it ends, and its last picture may go on";
    }
    free(of);
}

void wf_structure_ts(const wf_extent *x, wf_structure *s) {
    int64_t first;
    int bytes = packet_bytes(x, &first);
    if (!bytes) return wf_missing(s, "its packets cannot be found");
    int64_t beyond = (x->bytes - first) % bytes;
    if (beyond)
        wf_missing(s, "of its last packet %" PRId64 " bytes of %d are there", beyond, bytes);
    check_streams(x, first + (bytes == 192 ? 4 : 0), bytes, s);
}

/* ---- Program streams ---- */

/* Bytes of the pack header, system header or packet at `at`; 0: none is there. */
static int64_t part_bytes(const wf_extent *x, int64_t at) {
    uint8_t b[14];
    if (!wf_extent_read(x, at, b, 4) || wf_big_endian(b, 3) != 1) return 0;
    if (b[3] == 0xb9) return 4; /* the end */
    if (b[3] == 0xba && wf_extent_read(x, at, b, 12) && (b[4] & 0xf0) == 0x20)
        return 12; /* MPEG-1 */
    if (b[3] == 0xba) return wf_extent_read(x, at, b, 14) ? 14 + (b[13] & 7) : 0;
    if (b[3] < 0xba || !wf_extent_read(x, at, b, 6)) return 0;
    return 6 + (int64_t)wf_big_endian(b + 4, 2);
}

void wf_structure_ps(const wf_extent *x, wf_structure *s) {
    for (int64_t at = 0, bytes; at < x->bytes; at += bytes) {
        bytes = part_bytes(x, at);
        if (!bytes || bytes > x->bytes - at)
            return wf_missing(s, "it ends within what begins at byte %" PRId64, at);
    }
}

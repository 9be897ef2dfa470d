/* The header metadata of MXF OP1a: a material package, whose tracks play those of the file
 * package, which describes the essence in this file. */
#include <stdio.h>
#include <string.h>
#include <xxhash.h>

#include "convert/write/mxf_parts.h"

const wf_ul wf_mxf_op1a = WF_UL_LABEL(1, 0x0d01020101010900); /* several tracks, all in here */

/* ---- Identifiers ---- */

uint32_t wf_mxf_picture_number(void) {
    return 0x15010201;
}

uint32_t wf_mxf_sound_number(int tracks, int track) {
    return 0x16000100 | (uint32_t)tracks << 16 | (uint32_t)(track + 1);
}

/* Numbers that identifiers are made of: sets that a file has one of, then where those of the
 * others begin. */
enum {
    PREFACE,
    IDENTIFICATION,
    STORAGE,
    CONTAINER_DATA,
    MATERIAL,
    FILE_PACKAGE,
    DESCRIPTOR,
    GENERATION,
    INDEX = WF_MXF_INDEX_UID,
    PACKAGE_IDS = 16,
    DESCRIPTORS = 100,
    TRACKS = 1000, /* each package has A_PACKAGE of these, and in it each track A_TRACK */
    A_PACKAGE = 1000,
    A_TRACK = 3
};
enum { TRACK, SEQUENCE, COMPONENT };

wf_uid wf_mxf_uid(wf_uid seed, uint64_t n) {
    wf_uid uid;
    uint8_t text[24];
    memcpy(text, seed.byte, 16);
    for (int i = 0; i < 8; i++) text[16 + i] = (uint8_t)(n >> 8 * i);
    XXH128_canonicalFromHash((XXH128_canonical_t *)(void *)&uid,
                             XXH3_128bits(text, sizeof text));
    uid.byte[6] = (uint8_t)((uid.byte[6] & 0x0f) | 0x50); /* RFC 4122: by name */
    uid.byte[8] = (uint8_t)((uid.byte[8] & 0x3f) | 0x80);
    return uid;
}

typedef struct writer {
    wf_bytes *b;
    const wf_mxf_options *o;
    wf_uid seed;
} writer;

static wf_uid uid(const writer *w, int n) {
    return wf_mxf_uid(w->seed, (uint64_t)n);
}

static int track_uid(int package, int track, int part) {
    return TRACKS + (package - MATERIAL) * A_PACKAGE + track * A_TRACK + part;
}

static int track_count(const writer *w) {
    return WF_MXF_SOUND_TRACK - 1 + w->o->sound.tracks; /* their IDs are 1 .. count */
}

/* ST 330, a basic UMID: material of several kinds in one container, its number a UUID. */
static void item_umid(const writer *w, uint16_t tag, int package) {
    static const uint8_t label[16] = {6, 10, 0x2b, 0x34, 1, 1, 1, 5, 1, 1, 15, 0x20, 19};
    uint8_t umid[32];
    wf_uid number = uid(w, PACKAGE_IDS + package);
    memcpy(umid, label, 16);
    memcpy(umid + 16, number.byte, 16);
    wf_item_bytes(w->b, tag, umid, sizeof umid);
}

/* "weft" and the number of its UMID. */
static void item_name(const writer *w, int package) {
    char name[40] = "weft ";
    wf_uid number = uid(w, PACKAGE_IDS + package);
    for (int i = 0; i < 16; i++) snprintf(name + 5 + 2 * i, 3, "%02x", number.byte[i]);
    wf_item_text(w->b, 0x4402, name);
}

static size_t begin_set(const writer *w, uint8_t kind, int n) {
    size_t begun =
        wf_klv_begin(w->b, (wf_ul)WF_UL_SET(0x0d01010101010000 | (uint64_t)kind << 8));
    wf_item_uid(w->b, 0x3c0a, uid(w, n));
    return begun;
}

/* Year, month, day, hours, minutes, seconds and 1/250 s; zeros are "unknown". With the time of
 * day no two runs would write the same bytes. */
static void item_date(const writer *w, uint16_t tag) {
    const wf_date *d = &w->o->date;
    const uint8_t stamp[8] = {(uint8_t)(d->year >> 8), (uint8_t)(d->year & 0xff),
                              (uint8_t)d->month,       (uint8_t)d->day,
                              (uint8_t)d->hours,       (uint8_t)d->minutes,
                              (uint8_t)d->seconds,     0};
    wf_item_bytes(w->b, tag, stamp, sizeof stamp);
}

static void item_reference(const writer *w, uint16_t tag, int n) {
    wf_item_uid(w->b, tag, uid(w, n));
}

static void item_references(const writer *w, uint16_t tag, int first, int count, int step) {
    wf_item_array(w->b, tag, (uint32_t)count, 16);
    for (int i = 0; i < count; i++)
        wf_bytes_put(w->b, uid(w, first + i * step).byte, sizeof(wf_uid));
}

/* ---- The file as a whole ---- */

static void put_preface(const writer *w) {
    wf_ul containers[WF_MXF_CONTAINERS];
    int count = wf_mxf_containers(w->o, containers);
    size_t begun = begin_set(w, 0x2f, PREFACE);
    item_date(w, 0x3b02);
    wf_item_number(w->b, 0x3b05, 2, 0x0103);
    item_references(w, 0x3b06, IDENTIFICATION, 1, 0);
    item_reference(w, 0x3b03, STORAGE);
    wf_item_ul(w->b, 0x3b09, wf_mxf_op1a);
    wf_item_array(w->b, 0x3b0a, (uint32_t)count, 16);
    for (int i = 0; i < count; i++) wf_bytes_ul(w->b, containers[i]);
    wf_item_array(w->b, 0x3b0b, 0, 16);
    wf_klv_end(w->b, begun);
}

static void put_identification(const writer *w) {
    static const wf_uid product = {"weft MXF writer"};
    const uint8_t version[10] = {0, WEFT_VERSION_MAJOR, 0, WEFT_VERSION_MINOR,
                                 0, WEFT_VERSION_PATCH};
    size_t begun = begin_set(w, 0x30, IDENTIFICATION);
    item_reference(w, 0x3c09, GENERATION);
    wf_item_text(w->b, 0x3c01, "weft");
    wf_item_text(w->b, 0x3c02, "weft");
    wf_item_bytes(w->b, 0x3c03, version, sizeof version);
    wf_item_text(w->b, 0x3c04, WEFT_VERSION);
    wf_item_uid(w->b, 0x3c05, wf_mxf_uid(product, 0));
    item_date(w, 0x3c06);
    wf_klv_end(w->b, begun);
}

static void put_storage(const writer *w) {
    size_t begun = begin_set(w, 0x18, STORAGE);
    item_references(w, 0x1901, MATERIAL, 2, FILE_PACKAGE - MATERIAL);
    item_references(w, 0x1902, CONTAINER_DATA, 1, 0);
    wf_klv_end(w->b, begun);
    begun = begin_set(w, 0x23, CONTAINER_DATA);
    item_umid(w, 0x2701, FILE_PACKAGE);
    wf_item_number(w->b, 0x3f06, 4, WF_MXF_INDEX_SID);
    wf_item_number(w->b, 0x3f07, 4, WF_MXF_BODY_SID);
    wf_klv_end(w->b, begun);
}

/* ---- Packages and their tracks ---- */

static void item_kind(const writer *w, int track) {
    static const wf_ul kinds[] = {WF_UL_LABEL(1, 0x0103020101000000),  /* time code */
                                  WF_UL_LABEL(1, 0x0103020201000000),  /* picture */
                                  WF_UL_LABEL(1, 0x0103020202000000)}; /* sound */
    int kind = track < WF_MXF_SOUND_TRACK ? track : WF_MXF_SOUND_TRACK;
    wf_item_ul(w->b, 0x0201, kinds[kind - WF_MXF_TIMECODE_TRACK]);
    wf_item_number(w->b, 0x0202, 8, (uint64_t)w->o->frame_count);
}

static void put_timecode(const writer *w, int package) {
    const wf_rational rate = w->o->raster->frame_rate;
    size_t begun = begin_set(w, 0x14, track_uid(package, WF_MXF_TIMECODE_TRACK, COMPONENT));
    item_kind(w, WF_MXF_TIMECODE_TRACK);
    wf_item_number(w->b, 0x1502, 2, (uint64_t)wf_timecode_base(rate));
    wf_item_number(w->b, 0x1501, 8, (uint64_t)wf_timecode_frame(&w->o->start, rate));
    wf_item_number(w->b, 0x1503, 1, w->o->start.drop_frame);
    wf_klv_end(w->b, begun);
}

/* The clips of the material package play the tracks of the file package, whose own clips
 * have no source. */
static void put_clip(const writer *w, int package, int track) {
    static const uint8_t nowhere[32];
    size_t begun = begin_set(w, 0x11, track_uid(package, track, COMPONENT));
    item_kind(w, track);
    wf_item_number(w->b, 0x1201, 8, 0);
    if (package == MATERIAL)
        item_umid(w, 0x1101, FILE_PACKAGE);
    else
        wf_item_bytes(w->b, 0x1101, nowhere, sizeof nowhere);
    wf_item_number(w->b, 0x1102, 4, package == MATERIAL ? (uint64_t)track : 0);
    wf_klv_end(w->b, begun);
}

static uint32_t track_number(const writer *w, int package, int track) {
    if (package == MATERIAL || track == WF_MXF_TIMECODE_TRACK) return 0;
    if (track == WF_MXF_PICTURE_TRACK) return wf_mxf_picture_number();
    return wf_mxf_sound_number(w->o->sound.tracks, track - WF_MXF_SOUND_TRACK);
}

static void put_track(const writer *w, int package, int track) {
    char name[16];
    static const char *const names[] = {"", "TC", "V1"};
    snprintf(name, sizeof name, "A%d", track - WF_MXF_SOUND_TRACK + 1);
    size_t begun = begin_set(w, 0x3b, track_uid(package, track, TRACK));
    wf_item_number(w->b, 0x4801, 4, (uint64_t)track);
    wf_item_number(w->b, 0x4804, 4, track_number(w, package, track));
    wf_item_text(w->b, 0x4802, track < WF_MXF_SOUND_TRACK ? names[track] : name);
    wf_item_rational(w->b, 0x4b01, w->o->raster->frame_rate);
    wf_item_number(w->b, 0x4b02, 8, 0);
    item_reference(w, 0x4803, track_uid(package, track, SEQUENCE));
    wf_klv_end(w->b, begun);
    begun = begin_set(w, 0x0f, track_uid(package, track, SEQUENCE));
    item_kind(w, track);
    item_references(w, 0x1001, track_uid(package, track, COMPONENT), 1, 0);
    wf_klv_end(w->b, begun);
    if (track == WF_MXF_TIMECODE_TRACK)
        put_timecode(w, package);
    else
        put_clip(w, package, track);
}

static void put_package(const writer *w, int package) {
    size_t begun = begin_set(w, package == MATERIAL ? 0x36 : 0x37, package);
    item_umid(w, 0x4401, package);
    item_name(w, package);
    item_date(w, 0x4405);
    item_date(w, 0x4404);
    item_references(w, 0x4403, track_uid(package, 1, TRACK), track_count(w), A_TRACK);
    if (package == FILE_PACKAGE) item_reference(w, 0x4701, DESCRIPTOR);
    wf_klv_end(w->b, begun);
    for (int track = 1; track <= track_count(w); track++) put_track(w, package, track);
}

/* ---- Descriptors ---- */

static void items_of_file(const writer *w, int track, wf_ul container) {
    if (track) wf_item_number(w->b, 0x3006, 4, (uint64_t)track);
    wf_item_rational(w->b, 0x3001, w->o->raster->frame_rate);
    wf_item_number(w->b, 0x3002, 8, (uint64_t)w->o->frame_count);
    wf_item_ul(w->b, 0x3004, container);
}

static void put_sound(const writer *w, int track, wf_ul container) {
    uint64_t bytes = (uint64_t)w->o->sound.bits / 8;
    size_t begun = begin_set(w, 0x48, DESCRIPTORS + track);
    items_of_file(w, track, container);
    wf_item_rational(w->b, 0x3d03, wf_ratio(WF_SOUND_RATE, 1));
    wf_item_number(w->b, 0x3d02, 1, 1);
    wf_item_number(w->b, 0x3d07, 4, 1);
    wf_item_number(w->b, 0x3d01, 4, 8 * bytes);
    wf_item_number(w->b, 0x3d0a, 2, bytes);
    wf_item_number(w->b, 0x3d09, 4, bytes * WF_SOUND_RATE);
    wf_klv_end(w->b, begun);
}

static void put_descriptors(const writer *w) {
    wf_ul containers[WF_MXF_CONTAINERS];
    bool several = wf_mxf_containers(w->o, containers) > 1;
    int count = track_count(w) - 1;
    if (several) {
        size_t begun = begin_set(w, 0x44, DESCRIPTOR);
        items_of_file(w, 0, containers[2]);
        item_references(w, 0x3f01, DESCRIPTORS + WF_MXF_PICTURE_TRACK, count, 1);
        wf_klv_end(w->b, begun);
    }
    size_t begun =
        begin_set(w, 0x28, several ? DESCRIPTORS + WF_MXF_PICTURE_TRACK : DESCRIPTOR);
    items_of_file(w, WF_MXF_PICTURE_TRACK, containers[0]);
    wf_mxf_describe_picture(w->b, w->o);
    wf_klv_end(w->b, begun);
    for (int track = WF_MXF_SOUND_TRACK; track <= track_count(w); track++)
        put_sound(w, track, containers[1]);
}

void wf_mxf_metadata(wf_bytes *b, const wf_mxf_options *o, wf_uid seed) {
    const writer w = {b, o, seed};
    wf_klv_primer(b);
    put_preface(&w);
    put_identification(&w);
    put_storage(&w);
    put_package(&w, MATERIAL);
    put_package(&w, FILE_PACKAGE);
    put_descriptors(&w);
}

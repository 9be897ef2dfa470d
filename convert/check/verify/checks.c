/* The table of checks, and which of them a file is put to. */
#include "convert/check/verify/checks.h"

#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "convert/check/verify/check_container.h"
#include "convert/check/verify/check_pixels.h"
#include "convert/check/verify/check_profile.h"
#include "convert/check/verify/check_raster.h"
#include "convert/check/verify/check_time.h"
#include "convert/check/verify/check_whole.h"

/* What a file has to have for a check to apply to it, as bits. */
enum {
    ALWAYS = 0,
    PIXELS = 1, /* they could be read */
    RASTER = 2, /* it is known */
    CONTAINER = 4,
    MOV = 8, /* QuickTime, and not MP4 */
    MXF = 16,
    SOUND = 32,
    FIELDS = 64,     /* the raster is interlaced */
    FILES = 128,     /* it is an image sequence */
    STRUCTURE = 256, /* its container is one whose structure is read */
    CODEC = 512,     /* it is the profile's */
    IDENTITY = 1024, /* its container names its material */
    TRACKS = 2048,   /* it says which of its tracks of sound are heard */
    RAW = 4096,      /* its pictures are uncompressed */
    VIDEO = 8192,    /* it is a file of video, and no pictures */
};

/* Whether every file is put to a check, or only where the profile has a text, a number or a
 * flag at this offset. */
typedef struct demand {
    enum { OF_ALL, OF_TEXT, OF_NUMBER, OF_FLAG } kind;
    size_t offset; /* in wf_delivery_profile */
} demand;

/* clang-format off */
#define TEXT(member)   {OF_TEXT, offsetof(wf_delivery_profile, member)}
#define NUMBER(member) {OF_NUMBER, offsetof(wf_delivery_profile, member)}
#define FLAG(member)   {OF_FLAG, offsetof(wf_delivery_profile, member)}
#define ALL            {OF_ALL, 0}

/* by: what demands it, for people; %s becomes the raster, and the profile that it is of. What a
 * profile asks for is demanded by the profile. */
static const struct check {
    const char *name;
    wf_check_fn *run;
    unsigned applies;
    demand asked;
    const char *by;
} checks[] = {
    {"reading",    wf_check_reading,    ALWAYS, ALL, "its own header"},
    {"whole",      wf_check_whole,      VIDEO, ALL, "its own structure"},
    {"header",     wf_check_header,     STRUCTURE | MXF, ALL, "SMPTE ST 377-1"},
    {"identity",   wf_check_identity,   STRUCTURE | IDENTITY, ALL, "SMPTE ST 330, RFC 9559"},
    {"container",  wf_check_container,  ALWAYS, TEXT(container), "%s"},
    {"codec",      wf_check_codec,      ALWAYS, TEXT(codec), "%s"},
    {"codec profile", wf_check_codec_profile, CONTAINER | CODEC, TEXT(codec_profile), "%s"},
    {"level",      wf_check_level,      CONTAINER | CODEC, NUMBER(level), "%s"},
    {"chroma",     wf_check_chroma,     CONTAINER | CODEC, TEXT(chroma), "%s"},
    {"alpha",      wf_check_alpha,      CONTAINER | CODEC, FLAG(alpha), "%s"},
    {"groups",     wf_check_groups,     CONTAINER | CODEC, NUMBER(group), "%s"},
    {"bit rate",   wf_check_bit_rate,   CONTAINER | CODEC | PIXELS, NUMBER(bit_rate), "%s"},
    {"frame size", wf_check_frame_bytes, CONTAINER | CODEC, TEXT(frame_bytes), "%s"},
    {"partitions", wf_check_partitions, STRUCTURE | MXF, FLAG(closed), "%s"},
    {"bits",       wf_check_bits,       PIXELS, NUMBER(bits), "%s"},
    {"raster",     wf_check_raster,     PIXELS, ALL, "weft rasters"},
    {"size",       wf_check_size,       PIXELS | RASTER, ALL, "%s"},
    {"rate",       wf_check_rate,       PIXELS | RASTER, ALL, "%s"},
    {"flags",      wf_check_flags,      PIXELS | RASTER, ALL, "%s"},
    {"coded",      wf_check_coded,      CONTAINER | PIXELS | FIELDS, ALL, "its container"},
    {"order",      wf_check_order,      PIXELS | RASTER, ALL, "%s"},
    {"aspect",     wf_check_aspect,     PIXELS | RASTER, ALL, "%s"},
    {"colors",     wf_check_colors,     CONTAINER | RASTER, ALL, "%s"},
    {"fiel",       wf_check_fiel,       MOV | RASTER, ALL, "QuickTime File Format, for %s"},
    {"atoms",      wf_check_atoms,      MOV | RASTER, ALL, "QuickTime File Format, for %s"},
    {"clap",       wf_check_clap,       MOV | RASTER, ALL, "Apple TN2162, for %s"},
    {"pattern",    wf_check_pattern,    MXF, ALL, "SMPTE ST 378"},
    {"layout",     wf_check_layout,     MXF | RASTER, ALL, "SMPTE ST 377-1, for %s"},
    {"line map",   wf_check_line_map,   MXF | RASTER, ALL, "SMPTE ST 377-1, for %s"},
    {"bmx",        wf_check_bmx,        MXF | FIELDS | RAW, ALL, "bmx's source, which was not run"},
    {"dominance",  wf_check_dominance,  MXF | FIELDS, ALL, "SMPTE ST 377-1, for %s"},
    {"siting",     wf_check_siting,     MXF, ALL, "Rec. ITU-R BT.601 and BT.709"},
    {"timecode",   wf_check_timecode,   CONTAINER | RASTER, ALL, "SMPTE ST 12-1, for %s"},
    {"labels",     wf_check_labels,     FILES | RASTER, ALL, "SMPTE ST 12-1, for %s"},
    {"interlace",  wf_check_interlace,  FILES | RASTER, ALL, "SMPTE ST 268-1, for %s"},
    {"base",       wf_check_base,       CONTAINER | RASTER, ALL, "SMPTE ST 12-1, for %s"},
    {"start",      wf_check_start,      ALWAYS, TEXT(start), "%s"},
    {"frames",     wf_check_frames,     CONTAINER | PIXELS, ALL, "the container"},
    {"durations",  wf_check_durations,  STRUCTURE | PIXELS, ALL, "what is in the file"},
    {"sound",      wf_check_sound,      SOUND | PIXELS | RASTER, ALL, "the video's length"},
    {"channels",   wf_check_channels,   ALWAYS, NUMBER(sound_channels), "%s"},
    {"tracks",     wf_check_tracks,     ALWAYS, TEXT(channels), "%s"},
    {"sound bits", wf_check_sound_bits, ALWAYS, NUMBER(sound_bits), "%s"},
    {"sound codec", wf_check_sound_codec, SOUND, TEXT(sound_codec), "%s"},
    {"mono",       wf_check_mono,       SOUND, FLAG(mono), "%s"},
    {"one stream", wf_check_one_sound,  SOUND, FLAG(one_sound), "%s"},
    {"heard",      wf_check_heard,      TRACKS, ALL, "QuickTime File Format, RFC 9559"},
    {"levels",     wf_check_levels,     PIXELS, ALL, "EBU R 103"},
    {"reserved",   wf_check_reserved,   PIXELS, ALL, "Rec. ITU-R BT.601 and BT.709"},
    {"not checked", wf_check_not,       ALWAYS, TEXT(not_checked), "%s"},
};
/* clang-format on */

_Static_assert(sizeof checks / sizeof *checks <= WF_FINDINGS_MOST,
               "each check has a finding: raise WF_FINDINGS_MOST (checks.h)");

/* What the file has, in the bits of a check's `applies`. */
static unsigned nature_of(const wf_subject *s) {
    const char *codec = s->profile ? s->profile->codec : NULL;
    bool of_profile = s->contained && codec && !strcmp(s->metadata.codec, codec);
    bool mov = s->structure.quicktime;
    bool mxf = s->contained && !strcmp(s->metadata.container, "mxf");
    return (s->trouble ? 0 : PIXELS) | (s->raster_known ? RASTER : 0) |
           (s->raster_known && s->raster.scan == WF_INTERLACED ? FIELDS : 0) |
           (s->contained ? CONTAINER : 0) | (mov ? MOV : 0) | (mxf ? MXF : 0) |
           (s->contained && s->metadata.sound_streams ? SOUND : 0) |
           (s->labels.files ? FILES : 0) | (s->structure.known ? STRUCTURE : 0) |
           (of_profile ? CODEC : 0) | (s->structure.sound_tracks ? TRACKS : 0) |
           (wf_in_words("v210 rawvideo", s->metadata.codec) ? RAW : 0) |
           (s->contained || s->streamed ? VIDEO : 0) |
           (mxf || !strcmp(s->metadata.container, "matroska") ? IDENTITY : 0);
}

static bool is_asked(demand asked, const wf_delivery_profile *profile) {
    if (asked.kind == OF_ALL) return true;
    if (!profile) return false;
    const void *member = (const char *)profile + asked.offset;
    if (asked.kind == OF_NUMBER) return *(const int *)member != 0;
    if (asked.kind == OF_FLAG) return *(const bool *)member;
    return *(const char *const *)member != NULL;
}

static bool applies(const struct check *check, const wf_subject *s, unsigned nature) {
    return (check->applies & nature) == check->applies && is_asked(check->asked, s->profile);
}

/* Fills finding->by. */
static void tell_demand(const wf_subject *s, const struct check *check, wf_finding *f) {
    const char *rest = strstr(check->by, "%s"), *raster = s->raster.name;
    int before = (int)(rest ? rest - check->by : (ptrdiff_t)strlen(check->by));
    bool of_profile = s->profile && !s->raster_asked;
    if (check->asked.kind != OF_ALL)
        snprintf(f->by, sizeof f->by, "profile %.60s", s->profile->name);
    else if (rest)
        snprintf(f->by, sizeof f->by, "%.*sraster %.40s%s%.30s", before, check->by, raster,
                 of_profile ? " of profile " : "", of_profile ? s->profile->name : "");
    else
        snprintf(f->by, sizeof f->by, "%s", check->by);
}

size_t wf_run_checks(const wf_subject *s, wf_finding finding[WF_FINDINGS_MOST]) {
    unsigned nature = nature_of(s);
    size_t count = 0;
    for (size_t i = 0; i < sizeof checks / sizeof *checks; i++) {
        if (!applies(&checks[i], s, nature)) continue;
        wf_finding *f = &finding[count++];
        f->check = checks[i].name;
        tell_demand(s, &checks[i], f);
        f->verdict = checks[i].run(s, f);
    }
    return count;
}

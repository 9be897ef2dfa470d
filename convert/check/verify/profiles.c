/* The table of delivery profiles. */
#include "convert/check/verify/profiles.h"

#include <stdio.h>
#include <string.h>

#include "convert/base/fail.h"
#include "filters/base/spelling.h"
#include "filters/raster/raster.h"

#define MXF(codec_) .container = "mxf", .codec = codec_, .timecode = true
#define MOV(codec_) .container = "mov", .codec = codec_, .timecode = true
#define MKV(codec_) .container = "matroska", .codec = codec_
#define BOTH_1080I  "1080i50 1080i59.94"
#define PCM         .sound_codec = "pcm_s16le pcm_s24le"

/* MPEG-2's 4:2:2 Profile at High Level (Rec. ITU-T H.262), of 50 Mb/s, in groups of half a
 * second. */
#define XDCAM(raster, pictures)                                                                \
    MXF("mpeg2video"), .rasters = raster, .bits = 8, .codec_profile = "4:2:2", .level = 2,     \
                       .chroma = "yuv422p", .group = pictures, .between = true,                \
                       .bit_rate = 50000000, PCM, .mono = true,                                \
                       .not_checked = "closed groups and their order, quantizer tables, "      \
                                      "system item, ancillary data, partitions of the body"

/* AVC-Intra 100: frames of one size, of which the parameter sets are 512 bytes; the sizes are
 * those that FFmpeg's mxfenc.c has for RP 2027's labels. */
#define AVCI(raster, bytes)                                                                    \
    MXF("h264"), .rasters = raster, .bits = 10, .codec_profile = "High 4:2:2 Intra",           \
                 .level = 41, .chroma = "yuv422p", .group = 1, .frame_bytes = bytes, PCM,      \
                 .mono = true,                                                                 \
                 .not_checked = "parameter sets as RP 2027 has them, slices, entropy coding, " \
                                "partitions of the body"
#define AT_50    "568832 568320"
#define AT_59_94 "472576 472064"
#define AT_720   "284672 284160"

/* D-10: MPEG-2's 4:2:2 Profile at Main Level, every picture whole and of one size. */
#define IMX(raster, lines_, bytes)                                                             \
    MXF("mpeg2video"), .rasters = raster, .bits = 8, .coded_lines = lines_,                    \
                       .codec_profile = "4:2:2", .level = 5, .chroma = "yuv422p", .group = 1,  \
                       .frame_bytes = bytes, PCM, .channels = "0 2 4 8", .one_sound = true,    \
                       .not_checked = "quantizer tables and VBV delay of ST 356, AES3 "        \
                                      "elements and system item of ST 386"

#define DV50(raster, bytes)                                                                    \
    .codec = "dvvideo", .rasters = raster, .bits = 8, .chroma = "yuv422p", .group = 1,         \
    .frame_bytes = bytes, .not_checked = "sound within the frames, subcode"
/* 120, 185 and 220 Mb/s (SMPTE ST 2019-1); the sizes are those that libavcodec writes. */
#define DNXHD(raster)                                                                          \
    .codec = "dnxhd", .rasters = raster, .codec_profile = "DNXHD", .group = 1,                 \
    .chroma = "yuv422p", .frame_bytes = "606208 917504",                                       \
    .not_checked = "compression ID, macroblocks"
#define PRORES(raster)                                                                         \
    MOV("prores"), .rasters = raster, .bits = 10, .chroma = "yuv422p", .group = 1,             \
                   .not_checked = "which of the 422 kinds it is, bit rate"
#define INTERLACED                                                                             \
    "525i 525i-wide 525i-imx 525i-imx-wide 525i-dv 525i-dv-wide 525i-rp202 525i-rp202-wide "   \
    "625i 625i-wide 625i-dv 625i-dv-wide 1080i50 1080i59.94 1080i60"
#define ANY_RASTER                                                                             \
    INTERLACED " 1080p23.976 1080p24 1080p25 1080p29.97 1080p30 1080p50 1080p59.94 1080p60 "   \
               "720p23.976 720p24 720p25 720p29.97 720p30 720p50 720p59.94 720p60 "            \
               "2160p23.976 2160p24 2160p25 2160p29.97 2160p30 2160p50 2160p59.94 2160p60"
#define H264(depth, profile, pixels)                                                           \
    .container = "mov", .codec = "h264", .rasters = ANY_RASTER, .bits = depth,                 \
    .codec_profile = profile, .chroma = pixels,                                                \
    .sound_codec = "aac pcm_s16le pcm_s24le pcm_s32le",                                        \
    .not_checked = "level, groups, bit rate, buffer"
#define RAW(raster, bytes)                                                                     \
    MOV("v210"), .rasters = raster, .bits = 10, .group = 1, .frame_bytes = bytes,              \
                 .not_checked = "the padding of lines"
#define HDF(tracks) .closed = true, .sound_channels = tracks, .sound_bits = 24
#define DPP         .closed = true, .start = "10:00:00:00", .channels = "4 16", .sound_bits = 24

static const wf_delivery_profile profiles[] = {
    {"xdcamhd422-1080i50", "XDCAM HD422 in MXF OP1a (SMPTE RDD 9)", XDCAM("1080i50", 12)},
    {"xdcamhd422-1080i59.94", "the same at 29.97 frames a second", XDCAM("1080i59.94", 15)},
    {"xdcamhd422-720p50", "the same, progressive", XDCAM("720p50", 15)},
    {"xdcamhd422-720p59.94", "the same, progressive", XDCAM("720p59.94", 15)},
    {"as-hdf01a", "after ARD_ZDF_HDF01a: XDCAM HD422 1080i50, 8 mono tracks of sound",
     XDCAM("1080i50", 12), HDF(8)},
    {"as-hdf01b", "after ARD_ZDF_HDF01b: the same with 16 tracks", XDCAM("1080i50", 12),
     HDF(16)},
    {"as-hdf02a", "after ARD_ZDF_HDF02a: AVC-Intra 100 1080i50, 8 mono tracks of sound",
     AVCI("1080i50", AT_50), HDF(8)},
    {"as-hdf02b", "after ARD_ZDF_HDF02b: the same with 16 tracks", AVCI("1080i50", AT_50),
     HDF(16)},
    {"as-hdf03a", "after ARD_ZDF_HDF03a: AVC-Intra 100 720p50, 8 mono tracks of sound",
     AVCI("720p50", AT_720), HDF(8)},
    {"as-hdf03b", "after ARD_ZDF_HDF03b: the same with 16 tracks", AVCI("720p50", AT_720),
     HDF(16)},
    {"as11-uk-dpp-hd",
     "the file of AMWA AS-11 UK DPP HD: AVC-Intra 100 1080i50, 4 or 16 tracks, from "
     "10:00:00:00",
     AVCI("1080i50", AT_50), DPP},
    {"avci100-1080i50", "AVC-Intra 100 (SMPTE RP 2027)", AVCI("1080i50", AT_50)},
    {"avci100-1080i59.94", "AVC-Intra 100 (SMPTE RP 2027)", AVCI("1080i59.94", AT_59_94)},
    {"imx50-625", "D-10 of 50 Mb/s (SMPTE ST 356 and 386)",
     IMX("625i 625i-wide", 608, "250000")},
    {"imx50-525", "D-10 of 50 Mb/s (SMPTE ST 356 and 386)",
     IMX("525i-imx 525i-imx-wide", 512, "208540 208541")},
    {"dvcpro50-525", "DV of 50 Mb/s (SMPTE ST 314)", DV50("525i-dv 525i-dv-wide", "240000")},
    {"dvcpro50-625", "DV of 50 Mb/s (SMPTE ST 314)", DV50("625i-dv 625i-dv-wide", "288000")},
    {"dnxhd-1080i50", "DNxHD (SMPTE ST 2019-1)", DNXHD("1080i50")},
    {"dnxhd-1080i59.94", "DNxHD (SMPTE ST 2019-1)", DNXHD("1080i59.94")},
    {"prores-1080i50", "ProRes in QuickTime (SMPTE RDD 36)", PRORES("1080i50")},
    {"prores-1080i59.94", "ProRes in QuickTime (SMPTE RDD 36)", PRORES("1080i59.94")},
    {"prores-4444", "ProRes 4444 with alpha, fill and key in one, in QuickTime (SMPTE RDD 36)",
     MOV("prores"), .rasters = ANY_RASTER, .bits = 12, .codec_profile = "4444", .alpha = true,
     .group = 1, .not_checked = "bit rate"},
    {"h264", "H.264 of 8 bits in MP4 or QuickTime (ISO/IEC 14496-10 and -15)",
     H264(8, "High", "yuv420p")},
    {"h264-422", "the same of 10 bits, 4:2:2", H264(10, "High 4:2:2", "yuv422p")},
    {"v210-525", "uncompressed, 486 lines (Apple's TN2162)", RAW("525i 525i-wide", "933120")},
    {"v210-625", "uncompressed (Apple's TN2162)", RAW("625i 625i-wide", "1105920")},
    {"v210-1080i", "uncompressed (Apple's TN2162)", RAW(BOTH_1080I, "5529600")},
    {"ffv1-archive", "FFV1 in Matroska (RFC 9043), of any interlaced raster", MKV("ffv1"),
     .rasters = "525i 525i-wide 525i-imx 625i 625i-wide " BOTH_1080I, .group = 1,
     .not_checked = "version 3 and checksums of slices"},
};

#define PROFILES (sizeof profiles / sizeof *profiles)

const wf_delivery_profile *wf_profile_at(size_t index) {
    return index < PROFILES ? &profiles[index] : NULL;
}

/* The profiles whose names begin so, with commas: "" where there are none. */
static void tell_family(const char *name, char *text, size_t size) {
    size_t used = 0;
    *text = '\0';
    for (size_t i = 0; i < PROFILES && *name; i++)
        if (!strncmp(profiles[i].name, name, strlen(name)) && used < size)
            used += (size_t)snprintf(text + used, size - used, "%s%s", used ? ", " : "",
                                     profiles[i].name);
}

/* A raster's name is taken for what --raster holds a file to. */
static void refuse_profile(const char *name, const char *near, weft_error *err) {
    wf_raster raster;
    char why[256], family[512];
    tell_family(name, family, sizeof family);
    if (wf_raster_parse(name, &raster, why, sizeof why))
        wf_fail(err, WEFT_USAGE, "--profile: '%.200s' is a raster; give --raster %.200s", name,
                name);
    else if (*family)
        wf_fail(err, WEFT_USAGE, "--profile: '%.200s' is unknown; there are %s", name, family);
    else if (near)
        wf_fail(err, WEFT_USAGE, "--profile: '%.200s' is unknown; did you mean %s?", name,
                near);
    else
        wf_fail(err, WEFT_USAGE, "--profile: '%.200s' is unknown; --profiles lists them", name);
}

const wf_delivery_profile *wf_profile_find(const char *name, weft_error *err) {
    wf_spelling spelling = {.text = name};
    for (size_t i = 0; i < PROFILES; i++) {
        if (!strcmp(profiles[i].name, name)) return &profiles[i];
        wf_spelling_offer(&spelling, profiles[i].name);
    }
    refuse_profile(name, spelling.best, err);
    return NULL;
}

/* The table of delivery profiles. */
#include "convert/check/verify/profiles.h"

#include <string.h>

#include "convert/base/fail.h"
#include "filters/base/spelling.h"

#define MXF(codec_) .container = "mxf", .codec = codec_, .timecode = true
#define MOV(codec_) .container = "mov", .codec = codec_, .timecode = true
#define MKV(codec_) .container = "matroska", .codec = codec_
#define BOTH_1080I  "1080i50 1080i59.94"

static const wf_profile profiles[] = {
    {"xdcamhd422-1080i50", "XDCAM HD422 in MXF OP1a (SMPTE RDD 9)", MXF("mpeg2video"),
     .rasters = "1080i50", .bits = 8},
    {"xdcamhd422-1080i59.94", "the same at 29.97 frames a second", MXF("mpeg2video"),
     .rasters = "1080i59.94", .bits = 8},
    {"xdcamhd422-720p50", "the same, progressive", MXF("mpeg2video"), .rasters = "720p50",
     .bits = 8},
    {"xdcamhd422-720p59.94", "the same, progressive", MXF("mpeg2video"), .rasters = "720p59.94",
     .bits = 8},
    {"as-hdf01a", "after ARD_ZDF_HDF01a: XDCAM HD422 1080i50, 8 channels of sound",
     MXF("mpeg2video"), .rasters = "1080i50", .bits = 8, .sound_channels = 8, .sound_bits = 24},
    {"as-hdf02a", "after ARD_ZDF_HDF02a: AVC-Intra 100 1080i50, 8 channels of sound",
     MXF("h264"), .rasters = "1080i50", .bits = 10, .sound_channels = 8, .sound_bits = 24},
    {"as11-uk-dpp-hd",
     "the file of AMWA AS-11 UK DPP HD: AVC-Intra 100 1080i50, 4 or 16 tracks, from "
     "10:00:00:00",
     MXF("h264"), .rasters = "1080i50", .start = "10:00:00:00", .bits = 10, .channels = "4 16",
     .sound_bits = 24},
    {"avci100-1080i50", "AVC-Intra 100 (SMPTE RP 2027)", MXF("h264"), .rasters = "1080i50",
     .bits = 10},
    {"avci100-1080i59.94", "AVC-Intra 100 (SMPTE RP 2027)", MXF("h264"),
     .rasters = "1080i59.94", .bits = 10},
    {"imx50-625", "D-10 of 50 Mb/s (SMPTE ST 356 and 386)", MXF("mpeg2video"),
     .rasters = "625i 625i-wide", .bits = 8, .coded_lines = 608},
    {"imx50-525", "D-10 of 50 Mb/s (SMPTE ST 356 and 386)", MXF("mpeg2video"),
     .rasters = "525i-imx 525i-imx-wide", .bits = 8, .coded_lines = 512},
    {"dvcpro50-525", "DV of 50 Mb/s (SMPTE ST 314)", .codec = "dvvideo",
     .rasters = "525i-dv 525i-dv-wide", .bits = 8},
    {"dvcpro50-625", "DV of 50 Mb/s (SMPTE ST 314)", .codec = "dvvideo",
     .rasters = "625i-dv 625i-dv-wide", .bits = 8},
    {"dnxhd-1080i50", "DNxHD (SMPTE ST 2019-1)", .codec = "dnxhd", .rasters = "1080i50"},
    {"dnxhd-1080i59.94", "DNxHD (SMPTE ST 2019-1)", .codec = "dnxhd", .rasters = "1080i59.94"},
    {"prores-1080i50", "ProRes in QuickTime (SMPTE RDD 36)", MOV("prores"),
     .rasters = "1080i50", .bits = 10},
    {"prores-1080i59.94", "ProRes in QuickTime (SMPTE RDD 36)", MOV("prores"),
     .rasters = "1080i59.94", .bits = 10},
    {"v210-525", "uncompressed, 486 lines", MOV("v210"), .rasters = "525i 525i-wide",
     .bits = 10},
    {"v210-625", "uncompressed", MOV("v210"), .rasters = "625i 625i-wide", .bits = 10},
    {"v210-1080i", "uncompressed", MOV("v210"), .rasters = BOTH_1080I, .bits = 10},
    {"ffv1-archive", "FFV1 in Matroska (RFC 9043), of any interlaced raster", MKV("ffv1"),
     .rasters = "525i 525i-wide 525i-imx 625i 625i-wide " BOTH_1080I},
};

#define PROFILES (sizeof profiles / sizeof *profiles)

const wf_profile *wf_profile_at(size_t index) {
    return index < PROFILES ? &profiles[index] : NULL;
}

const wf_profile *wf_profile_find(const char *name, weft_error *err) {
    wf_spelling spelling = {.text = name};
    for (size_t i = 0; i < PROFILES; i++) {
        if (!strcmp(profiles[i].name, name)) return &profiles[i];
        wf_spelling_offer(&spelling, profiles[i].name);
    }
    if (spelling.best)
        wf_fail(err, WEFT_USAGE, "--profile: '%.200s' is unknown; did you mean %s?", name,
                spelling.best);
    else
        wf_fail(err, WEFT_USAGE, "--profile: '%.200s' is unknown; --profiles lists them", name);
    return NULL;
}

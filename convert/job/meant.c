/* Words of other programs, and what is written for them here. */
#include "convert/job/meant.h"

#include <string.h>
#include <strings.h>

/* clang-format off */
static const wf_meant rows[] = {
    {"", "fps", "--subframe-rate"},       {"", "framerate", "--subframe-rate"},
    {"", "frame-rate", "--subframe-rate"}, {"", "rate", "--subframe-rate"},
    {"", "size", "--raster"},             {"", "resolution", "--raster"},
    {"", "standard", "--raster"},         {"", "system", "--raster"},
    {"", "tff", "--raster"},              {"", "bff", "--raster"},
    {"", "top-field-first", "--raster"},  {"", "field-order", "--raster"},
    {"", "interlace", "--raster"},        {"", "interlaced", "--raster"},
    {"", "matrix", "--raster"},           {"", "preset", "--raster"},
    {"", "filter", "--aperture"},         {"", "kernel", "--aperture"},
    {"", "shutter", "--shutter-angle"},   {"", "motion-blur", "--shutter-angle"},
    {"", "gamma", "--from"},              {"", "colorspace", "--from"},
    {"", "color-space", "--from"},
    {"", "input-space", "--from"},        {"", "output-space", "--to"},
    {"", "config", "--ocio"},             {"", "lut", "--ocio"},
    {"", "start", "--frames"},            {"", "end", "--frames"},
    {"", "force", "--overwrite"},         {"", "yes", "--overwrite"},
    {"", "y", "--overwrite"},             {"", "replace", "--overwrite"},
    {"", "scale", "--fit"},               {"", "pad", "--fit"},
    {"", "crop", "--fit"},                {"", "letterbox", "--fit"},
    {"", "sound", "--audio"},             {"", "encoder", "--codec"},
    {"", "vcodec", "--codec"},            {"", "depth", "--bits"},
    {"", "bit-depth", "--bits"},          {"", "ev", "--exposure"},
    {"", "stops", "--exposure"},          {"", "gain", "--exposure"},
    {"", "pulldown", "--cadence"},        {"", "telecine", "--cadence"},
    {"", "memory", "--max-memory"},       {"", "jobs", "--threads"},
    {"", "channel", "--layer"},           {"", "aov", "--layer"},
    {"", "pass", "--layer"},              {"", "premultiplied", "--alpha"},

    {"aperture", "gaussian", "calm or mitchell:1,0, which are soft"},
    {"aperture", "lanczos", "crisp"},
    {"aperture", "sinc", "crisp"},
    {"aperture", "bicubic", "mitchell:B,C, such as mitchell:0,0.5"},
    {"aperture", "cubic", "mitchell:B,C, such as mitchell:0,0.5"},
    {"aperture", "catrom", "mitchell:0,0.5"}, {"aperture", "catmull-rom", "mitchell:0,0.5"},
    {"aperture", "bspline", "mitchell:1,0"},  {"aperture", "nearest", "line"},
    {"aperture", "none", "line"},             {"aperture", "point", "line"},
    {"aperture", "area", "box"},              {"aperture", "average", "box"},
    {"aperture", "triangle", "notch"},        {"aperture", "bilinear", "notch"},
    {"dither", "triangular", "tpdf"},         {"dither", "random", "tpdf"},
    {"dither", "yes", "tpdf"},                {"dither", "on", "tpdf"},
    {"dither", "no", "none"},                 {"dither", "off", "none"},
    {"dither", "noise", "tpdf"},
    {"fit", "letterbox", "pad"},              {"fit", "pillarbox", "pad"},
    {"fit", "contain", "pad"},                {"fit", "cover", "crop"},
    {"fit", "fill", "crop"},                  {"fit", "center-cut", "crop"},
    {"fit", "scale", "stretch"},              {"fit", "anamorphic", "stretch"},
    {"fit", "distort", "stretch"},
    {"legalize", "yes", "clip"},              {"legalize", "broadcast", "r103"},
    {"legalize", "ebu", "r103"},              {"legalize", "off", "none"},
    {"legalize", "no", "none"},
    {"range", "limited", "narrow"},           {"range", "tv", "narrow"},
    {"range", "mpeg", "narrow"},              {"range", "video", "narrow"},
    {"range", "legal", "narrow"},             {"range", "studio", "narrow"},
    {"range", "pc", "full"},                  {"range", "jpeg", "full"},
    {"range", "data", "full"},
    {"chroma", "422", "bt601, the default, is 4:2:2"},
    {"chroma", "4:2:2", "bt601, the default, is 4:2:2"},
    {"chroma", "4:4:4", "444"},
    {"chroma", "420", "bt601: fields are 4:2:2; ffmpeg makes 4:2:0 of it"},
    {"chroma", "4:2:0", "bt601: fields are 4:2:2; ffmpeg makes 4:2:0 of it"},
    {"on-missing", "repeat", "hold"},         {"on-missing", "freeze", "hold"},
    {"on-missing", "stop", "error"},          {"on-missing", "fail", "error"},
    {"alpha", "premult", "premultiplied"},    {"alpha", "associated", "premultiplied"},
    {"alpha", "unassociated", "straight"},    {"alpha", "unpremultiplied", "straight"},
    {"alpha", "none", "ignore"},              {"alpha", "off", "ignore"},
    {"cadence", "3:2", "2:3"},                {"cadence", "23", "2:3"},
    {"cadence", "32", "2:3"},                 {"cadence", "pulldown", "2:3"},
    {"cadence", "telecine", "2:3"},           {"cadence", "2:2", "none"},
    {"fields", "merged", "woven"},            {"fields", "interleaved", "woven"},
    {"fields", "weave", "woven"},             {"fields", "split", "separate"},
    {"fields", "single", "separate"},
    {"codec", "avc", "h264"},
    {"codec", "x264", "h264"},
    {"codec", "avcintra", "avci100"},         {"codec", "avc-intra", "avci100"},
    {"codec", "h265", "Y4M into ffmpeg, which makes HEVC"},
    {"codec", "hevc", "Y4M into ffmpeg, which makes HEVC"},
    {"codec", "prores422", "prores"},         {"codec", "prores422hq", "prores-hq"},
    {"codec", "prores4444", "prores-4444"},
    {"codec", "proreshq", "prores-hq"},       {"codec", "dnx", "dnxhd"},
    {"codec", "xdcam", "xdcamhd422"},         {"codec", "xdcamhd", "xdcamhd422"},
    {"codec", "xdcam-hd422", "xdcamhd422"},   {"codec", "mpeg2", "xdcamhd422, or imx50 for SD"},
    {"codec", "imx", "imx50"},                {"codec", "d10", "imx50"},
    {"codec", "dv", "dvcpro50"},              {"codec", "dvcpro", "dvcpro50"},
    {"codec", "uncompressed", "v210"},        {"codec", "raw", "v210"},
    {"codec", "lossless", "ffv1"},
    {"background", "black", "0"},             {"background", "white", "1"},
    {"background", "gray", "0.18"},
    {"background", "transparent", "0"},
};
/* clang-format on */

const wf_meant *wf_meant_at(size_t index) {
    return index < sizeof rows / sizeof *rows ? &rows[index] : NULL;
}

const char *wf_meant_by(const char *option, const char *said) {
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (!strcmp(rows[i].option, option) && !strcasecmp(rows[i].said, said))
            return rows[i].right;
    return NULL;
}

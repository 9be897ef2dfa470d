/* The table of a job's options, and what is done with the option that a name asks for. */
#include "convert/job/options.h"

#include <string.h>

#include "convert/job/audio.h"
#include "convert/job/option_rows.h"
#include "filters/base/spelling.h"

/* ---- The table ---- */

static const char shape[] = "Raster and aperture", timing[] = "Time", input[] = "Input",
                  color[] = "Color", codes[] = "Codes", files[] = "Files",
                  running[] = "Running", scene[] = "Scene and samples", planning[] = "Plan";

/* Which commands take an option. */
enum {
    CONVERT = WF_TAKEN_BY_CONVERT,
    RENDER = WF_TAKEN_BY_RENDER,
    TRACE = WF_TAKEN_BY_TRACE,
    COMPOSITE = WF_TAKEN_BY_COMPOSITE,
    FILTERS = WF_TAKEN_BY_FILTERS,
    PLAN = WF_TAKEN_BY_PLAN,
    VIDEO = CONVERT | RENDER,
    SCENES = RENDER | TRACE,
    JOBS = CONVERT | RENDER | TRACE
};

#define ROW(group, commands_, name, takes, preset, help, set_, ...)                            \
    { {name, takes, preset, help, group}, .commands = commands_, .set = wf_##set_, __VA_ARGS__ }
#define AT(member)               .offset = offsetof(weft_job, member)
#define TEXT(member)             AT(member), .release = wf_release_text
#define FROM(low_, high_, what_) .low = low_, .high = high_, .what = what_
#define INITIAL                  .initial = true

static const wf_option_row rows[] = {
    ROW(shape, JOBS | FILTERS | PLAN, "raster", "NAME", "525i",
        "What to make: a name that 'weft rasters' lists, or WxH@RATE(i|p|psf).", set_raster,
        AT(raster), INITIAL),
    ROW(shape, JOBS | PLAN, "aperture", "NAME", "shaped; line where flicker is held",
        "How a pixel looks at the picture: one of those that 'weft filters' lists, or "
        "design:KEY=VALUE,.. to have one made ('weft filters --help').",
        set_aperture, AT(aperture)),
    ROW(shape, JOBS, "flicker-weight", "MU", "0",
        "How much interline flicker weighs against sharpness: of f cycles a line 1 / (1 + MU "
        "sin^4(pi f)) is left of what the aperture shows, line unless another is named.",
        set_ratio, AT(flicker_weight), FROM(0, 1e6, ", such as 4"), INITIAL),
    ROW(shape, JOBS, "flicker-limit", "E|visible:N", NULL,
        "How much light may flicker between lines at most, 1 being white, or how much of that "
        "may be seen, in just noticeable differences: the nearest picture that holds it is "
        "made, sharp wherever it does so already.",
        set_flicker_limit, AT(flicker_limit),
        FROM(0.0005, 100, ", such as 0.02 or visible:1,")),
    ROW(shape, JOBS, "view-distance", "N", "6, of more than 608 lines 3",
        "How far the eye is, in heights of the picture, for --flicker-limit visible:N.",
        set_ratio, AT(view_distance), FROM(0.25, 50, " (heights), such as 3")),
    ROW(shape, JOBS, "peak", "CD", "100, of PQ and HLG 203",
        "The luminance of white on the display, in cd/m2, for the same.", set_ratio, AT(peak),
        FROM(1, 10000, " (cd/m2), such as 100")),
    ROW(shape, CONVERT, "fit", "stretch|crop|pad", "stretch",
        "What to do with an input of another shape: stretch it, or scale it evenly and crop or "
        "pad.",
        set_choice, AT(fit), INITIAL),
    ROW(shape, CONVERT, "input-par", "N:D", "from the files",
        "Pixel aspect ratio of the input.", set_ratio, AT(input_par),
        FROM(0.01, 100, ", such as 10:11")),
    ROW(shape, CONVERT, "background", "R,G,B", "0",
        "Scene-linear color behind transparent and padded pictures; one number is a gray.",
        set_background, AT(background), INITIAL),

    ROW(timing, JOBS | FILTERS | PLAN, "temporal-width", "T", "the aperture's",
        "How long a field looks, in field periods: 0 is an instant, 1 a whole field.",
        set_width, AT(temporal_width), FROM(0, 64, " (field periods), such as 0.5 or 1/3")),
    ROW(timing, JOBS | PLAN, "shutter-angle", "D", "the aperture's",
        "The same in degrees: 360 are one field period.", set_angle, AT(temporal_width),
        FROM(0, 64 * 360, " (degrees), such as 180")),
    ROW(timing, JOBS | PLAN, "shutter-position", "start|center|end", "start",
        "Whether a field's window starts, is centered or ends at its instant.", set_choice,
        AT(shutter_position), INITIAL),
    ROW(timing, JOBS | PLAN, "scan-skew", "S", "0",
        "How much later the last line looks, in field periods: 1 is a tube camera.", set_ratio,
        AT(scan_skew), FROM(0, 1, ", such as 1 or 0.5"), INITIAL),
    ROW(timing, VIDEO | PLAN, "cadence", "none|2:3", "none",
        "Shows film, 24 frames a second, in 60 fields: each film frame is seen once, and a "
        "period is a film frame's.",
        set_choice, AT(cadence), INITIAL),
    ROW(timing, CONVERT | PLAN, "subframe-rate", "R", "from the files",
        "Subframes a second, of those that are selected.", set_rate, AT(subframe_rate),
        FROM(0.001, 1e6, " (a second), such as 240 or 480000/1001")),
    ROW(timing, CONVERT | PLAN, "subframe-time", "start|center", "start",
        "Whether subframe k stands for the time after k/R or about it.", set_switch,
        AT(subframe_time_center), INITIAL),
    ROW(timing, VIDEO | COMPOSITE, "timecode", "HH:MM:SS:FF", "the input's, or 00:00:00:00",
        "Timecode of frame 0; a semicolon before FF counts drop frame.", set_timecode,
        TEXT(timecode)),

    ROW(input, JOBS | PLAN, "frames", "A-BxS", "all",
        "Which subframes: 1-96, every second one with 1-96x2, quarters with 1001-1066x0.25; "
        "of a scene and of a plan, which frames of the output.",
        set_frames, TEXT(frames)),
    ROW(input, CONVERT, "output-frames", "A-B", "all",
        "Which of the frames that the input gives to make: 0-24. Subframes keep their times, "
        "counted from the first there is.",
        set_output_frames),
    ROW(input, CONVERT, "layer", "NAME", "the beauty",
        "EXR layer to take: NAME.R, NAME.G, NAME.B, or R, G, B of a part of that name.",
        set_text, TEXT(layer)),
    ROW(input, CONVERT, "part", "NAME", "the beauty's",
        "EXR part to take, by name or number from 0.", set_text, TEXT(part)),
    ROW(input, CONVERT, "alpha", "straight|premultiplied|ignore", "from the files",
        "Whether color is yet to be multiplied by alpha, is multiplied already, or is taken as "
        "if there were no alpha.",
        set_choice, AT(alpha), .base = WF_ALPHA_STRAIGHT),
    ROW(input, CONVERT, "input-scan", "file|progressive", "file",
        "Whether video is scanned as it says, or progressive whatever it says.", set_choice,
        AT(input_scan), INITIAL),
    ROW(input, CONVERT, "on-missing", "error|hold|black", "error",
        "What to do about subframes that are needed and absent, and pictures of video that "
        "cannot "
        "be decoded.",
        set_choice, AT(on_missing), INITIAL),
    ROW(input, CONVERT, "fix-nan", "box3|black|none|error", "box3",
        "What NaN and Inf become: the mean of finite neighbors, black, themselves, an error.",
        set_choice, AT(nan_fix), INITIAL),

    ROW(input, CONVERT, "on-empty", "error|nearest", "error",
        "What to do about pixels that no sample of a sample buffer reached.", set_choice,
        AT(on_empty), INITIAL),

    ROW(scene, SCENES, "samples", "N", "64",
        "Samples a pixel, frame line and field, shared by all apertures that reach them.",
        set_whole, AT(samples), FROM(1, 65536, ", whole, such as 64"), INITIAL),
    ROW(scene, SCENES, "sampler", "jitter|sobol|grid", "sobol",
        "Where they lie: in jittered strata, an Owen-scrambled Sobol set, or a grid.",
        set_choice, AT(sampler), INITIAL),
    ROW(scene, SCENES, "seed", "N", "0", "Another number gives other samples.", set_whole,
        AT(seed), FROM(0, 9007199254740992, ", whole"), INITIAL),
    ROW(scene, RENDER | PLAN, "error", "E", NULL,
        "Instead of a number of samples: the RMS error to reach, in display-encoded units; "
        "with "
        "--refine, what pixels may be off by.",
        set_ratio, AT(error), FROM(0.0001, 1, ", such as 0.005")),
    ROW(scene, TRACE, "oversample", "SxLxT", NULL,
        "Write subframes with S samples a pixel, L a line and T a field, not deep pictures.",
        set_oversample, TEXT(oversample)),
    ROW(scene, SCENES, "set", "NAME=VALUE", NULL, "A value that the scene reads as param.NAME.",
        set_param, .release = wf_release_params, .repeats = true),
    ROW(scene, SCENES, "scene-steps", "N", "200000000",
        "How many steps the scene's script may take.", set_whole, AT(scene_steps),
        FROM(1000, 1e15, ", whole, such as 1000000000"), INITIAL),
    ROW(scene, SCENES, "scene-memory", "SIZE", "2G", "How much memory the scene may take.",
        set_size, AT(scene_memory_bytes), INITIAL),

    ROW(planning, PLAN, "size", "WxH", NULL,
        "Size of the subframes, if it is not the raster's; their height becomes a whole "
        "multiple of half the raster's "
        "lines.",
        set_dimensions, AT(render_width)),
    ROW(planning, PLAN, "samples-a-pixel", "N", NULL,
        "Samples a pixel of a finished frame, whose noise subframes are to reach together.",
        set_whole, AT(samples_a_pixel), FROM(1, 1e9, ", whole, such as 64")),
    ROW(planning, PLAN, "scene-fps", "F", NULL,
        "Frames a second of the scene, in which times are told too.", set_rate, AT(scene_fps),
        FROM(0.001, 1e6, ", such as 24 or 30000/1001")),
    ROW(planning, PLAN, "refine", "DIR", NULL,
        "Tell what subframes in this folder still want, by --error: further times, and the "
        "rectangle of each.",
        set_text, TEXT(refine)),

    ROW(color, VIDEO, "ocio", "FILE", "$OCIO, else weft's own", "OpenColorIO configuration.",
        set_text, TEXT(ocio)),
    ROW(color, VIDEO, "from", "SPACE", "as the files say",
        "Color space of the input, encoded ones too.", set_text, TEXT(from)),
    ROW(color, VIDEO, "to", "SPACE", "the raster's", "Color space of the output.", set_text,
        TEXT(to)),
    ROW(color, VIDEO, "exposure", "STOPS", "0",
        "Light is multiplied by 2 to this, before any look, view or encoding.", set_stops,
        AT(exposure), FROM(-32, 32, ", such as -1 or 0.5"), INITIAL),
    ROW(color, VIDEO, "display", "NAME", NULL, "Display of the configuration, instead of --to.",
        set_text, TEXT(display)),
    ROW(color, VIDEO, "view", "NAME", NULL, "View of that display.", set_text, TEXT(view)),
    ROW(color, VIDEO, "look", "NAME", NULL, "Look to apply on the way.", set_text, TEXT(look)),

    ROW(codes, VIDEO | COMPOSITE, "bits", "8|10|12|16", "the output's", "Bits a sample.",
        set_bits, AT(bits)),
    ROW(codes, VIDEO | COMPOSITE, "range", "narrow|full", "the output's",
        "Code range: narrow for video, full for R'G'B' pictures.", set_choice, AT(range),
        .base = WF_RANGE_NARROW),
    ROW(codes, VIDEO | COMPOSITE, "chroma", "bt601|121|box|444|luma-adjust", "bt601",
        "How chroma is brought to 4:2:2; 444 leaves it whole; luma-adjust is bt601 with luma "
        "that "
        "keeps the light of colored edges.",
        set_choice, AT(chroma), INITIAL),
    ROW(codes, VIDEO, "dither", "none|tpdf", "none",
        "Whether to round with noise, so that gradients have no steps; it does not flicker.",
        set_choice, AT(dither), INITIAL),
    ROW(codes, VIDEO | COMPOSITE, "legalize", "none|clip|r103", "none",
        "Whether to hold codes within the legal range, or colors within EBU R 103, at their "
        "hue "
        "and luma.",
        set_choice, AT(legalize), INITIAL),

    ROW(codes, VIDEO, "alpha-out", NULL, NULL,
        "Write alpha beside the picture, where the output holds it; nothing lies behind it "
        "then.",
        set_flag, AT(alpha_out)),
    ROW(codes, VIDEO, "key", "OUTPUT", NULL,
        "Write alpha as a picture of its own, gray, of the same raster, order and timecode: "
        "the "
        "key of the fill that the output is.",
        set_text, TEXT(key)),
    ROW(codes, VIDEO, "fill", "premultiplied|straight", "the output's",
        "Whether color that is written beside alpha is multiplied by it.", set_choice, AT(fill),
        .base = WF_FILL_PREMULTIPLIED),
    ROW(codes, VIDEO, "key-law", "light|encoded", "the output's",
        "What alpha is for: to be laid over light, or over encoded video, as mixers do it; "
        "encoded is as near to light as they can come.",
        set_choice, AT(key_law), .base = WF_KEY_CHOICE_LIGHT),

    ROW(files, VIDEO | COMPOSITE, "codec", "NAME", "the container's",
        "What .mov, .mp4, .mxf and .mkv hold: v210, prores, dnxhd, xdcamhd422, h264 and "
        "others; a "
        "wrong name lists them.",
        set_codec, TEXT(codec)),
    ROW(files, VIDEO, "audio", "none|copy|FILE[:OFFSET]|silent:N|tone:N", "none",
        "Sound in .mov, .mxf, .mkv and, as AAC, .mp4, at 48 kHz: the input video's, that of a "
        "file (from so many seconds on), N tracks of silence or of 1 kHz at -18 dBFS.",
        set_audio, TEXT(audio), INITIAL),
    ROW(files, VIDEO | COMPOSITE, "date", "YYYY-MM-DD[THH:MM:SSZ]", "not said",
        "When containers say they were made (UTC); no clock is looked at, so that equal jobs "
        "make "
        "equal files.",
        set_date, TEXT(date)),
    ROW(files, VIDEO | COMPOSITE, "audio-tracks", "N", "one a channel",
        "How many tracks of sound are written: channels beyond them are left out, tracks "
        "beyond "
        "the channels are silent.",
        set_whole, AT(audio_tracks), FROM(1, WF_SOUND_TRACKS, ", whole")),
    ROW(files, VIDEO | COMPOSITE, "audio-bits", "16|24|32", "24",
        "Bits of a sample of sound; 32 in .mov and .mkv; AAC has none.", set_bits,
        AT(audio_bits), INITIAL),
    ROW(files, VIDEO, "fields", "woven|separate", "woven",
        "Image sequences: both fields in one file, or each in a file of half the height, two "
        "numbers a frame in order of time.",
        set_switch, AT(separate_fields), INITIAL),

    ROW(running, JOBS, "chunk", "I/N", "1/1",
        "Make only the I-th of N runs of frames; all of them joined are the whole.", set_chunk,
        AT(chunk), INITIAL),
    ROW(running, JOBS, "threads", "N", "all",
        "How many processors to use; the result is the same for any number.", set_threads,
        AT(threads), FROM(1, 1024, ", whole, or 'all'"), INITIAL),
    ROW(running, JOBS, "skip", "off|on", "on",
        "Whether to leave out work that equal data make needless.", set_switch, AT(skip),
        INITIAL),
    ROW(running, JOBS | COMPOSITE, "max-memory", "SIZE", "2G",
        "How much memory to use at most, such as 512M.", set_size, AT(max_memory_bytes),
        INITIAL),
    ROW(running, JOBS, "dry-run", NULL, NULL, "Tell what would be done, and write nothing.",
        set_flag, AT(dry_run)),
    ROW(running, JOBS | COMPOSITE, "overwrite", NULL, NULL, "Replace an output that exists.",
        set_flag, AT(overwrite)),
    ROW(running, JOBS, "resume", NULL, NULL, "Make only what is not there yet.", set_flag,
        AT(resume)),
};

#define ROWS (sizeof rows / sizeof *rows)

/* Choices are stored through unsigned, which is what GCC and Clang make of these enums. */
_Static_assert(sizeof(wf_fit) == sizeof(unsigned) && sizeof(wf_alpha) == sizeof(unsigned) &&
                   sizeof(wf_chroma) == sizeof(unsigned),
               "enums are stored as unsigned");

bool weft_option_at(size_t index, weft_option *out) {
    if (index >= ROWS) return false;
    *out = rows[index].shown;
    return true;
}

bool wf_option_repeats(size_t index) {
    return index < ROWS && rows[index].repeats;
}

unsigned wf_option_commands(size_t index) {
    return index < ROWS ? rows[index].commands : 0;
}

void wf_job_clear_flag(weft_job *job, const char *name) {
    for (size_t i = 0; i < ROWS; i++)
        if (!rows[i].shown.takes && !strcmp(rows[i].shown.name, name))
            *(bool *)((char *)job + rows[i].offset) = false;
}

static weft_status unknown_option(const char *name, weft_error *err) {
    wf_spelling spelling = {.text = name};
    for (size_t i = 0; i < ROWS; i++) wf_spelling_offer(&spelling, rows[i].shown.name);
    if (spelling.best)
        return wf_fail(err, WEFT_USAGE, "--%.200s: unknown option; did you mean --%s?", name,
                       spelling.best);
    return wf_fail(err, WEFT_USAGE,
                   "--%.200s: unknown option; 'weft convert --help' lists them all", name);
}

weft_status weft_job_set(weft_job *job, const char *name, const char *value, weft_error *err) {
    const wf_option_row *row = rows, *end = rows + ROWS;
    while (row < end && strcmp(row->shown.name, name)) row++;
    if (row == end) return unknown_option(name, err);
    if (!value) value = "";
    if (!*value && row->shown.takes)
        return wf_fail(err, WEFT_USAGE, "--%s needs a value: %s", name, row->shown.takes);
    return row->set(job, row, value, err);
}

weft_status wf_job_preset(weft_job *job, weft_error *err) {
    weft_status status = WEFT_OK;
    for (size_t i = 0; i < ROWS && !status; i++)
        if (rows[i].initial) status = rows[i].set(job, &rows[i], rows[i].shown.preset, err);
    return status;
}

void wf_job_release_options(weft_job *job) {
    for (size_t i = 0; i < ROWS; i++)
        if (rows[i].release) rows[i].release(job, &rows[i]);
}

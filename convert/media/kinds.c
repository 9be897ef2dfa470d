/* Files that are no pictures or video that weft reads: how they begin, what they are called,
 * and what to do with them. */
#include "convert/media/kinds.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "convert/base/infile.h"
#include "convert/base/names.h"

/* Codes stay codes in TIFF, which is taken as sRGB; EXR is for light. */
#define TO_TIFF "'oiiotool IN --scanline -d uint16 -o OUT.tif' makes a TIFF of it"
#define TO_EXR  "'oiiotool IN -o OUT.exr' makes an EXR of it"
#define TO_PNG  "'ffmpeg -i IN OUT.png' makes a PNG of it"
#define EXPORT  "export EXR or PNG from the program that made it"
#define RENDER  "render subframes of it as EXR, and give those"
#define UNPACK  "unpack it, and give the pictures or the video in it"
#define SOUND   "--audio FILE.wav takes sound, beside pictures or video"

#define AT(offset, magic, name, advice)                                                        \
    { offset, magic, sizeof magic - 1, name, advice }

static const wf_kind kinds[] = {
    AT(0, "8BPS", "a Photoshop document (PSD)", TO_TIFF),
    AT(0, "BM", "a BMP picture", TO_TIFF),
    AT(0, "\x80\x2a\x5f\xd7", "a Cineon picture, whose codes are printing densities",
       "'oiiotool IN -o OUT.dpx' makes a DPX of it, whose space --from names"),
    AT(0, "\xd7\x5f\x2a\x80", "a Cineon picture, whose codes are printing densities",
       "'oiiotool IN -o OUT.dpx' makes a DPX of it, whose space --from names"),
    AT(0, "\0\0\0\x0cjP  ", "a JPEG 2000 picture", TO_TIFF),
    AT(0, "\xff\x4f\xff\x51", "a JPEG 2000 picture", TO_TIFF),
    AT(4, "ftypheic", "a HEIC picture", TO_TIFF),
    AT(4, "ftypheix", "a HEIC picture", TO_TIFF),
    AT(4, "ftypmif1", "a HEIF picture", TO_TIFF),
    AT(4, "ftypavif", "an AVIF picture", TO_TIFF),
    AT(0, "\xff\x0a", "a JPEG XL picture", TO_PNG),
    AT(0, "\0\0\0\x0cJXL ", "a JPEG XL picture", TO_PNG),
    AT(0, "P1\n", "a PBM picture", TO_TIFF),
    AT(0, "P2\n", "a PGM picture", TO_TIFF),
    AT(0, "P3\n", "a PPM picture", TO_TIFF),
    AT(0, "P4\n", "a PBM picture", TO_TIFF),
    AT(0, "P5\n", "a PGM picture", TO_TIFF),
    AT(0, "P6\n", "a PPM picture", TO_TIFF),
    AT(0, "PF\n", "a PFM picture", TO_EXR),
    AT(0, "Pf\n", "a PFM picture", TO_EXR),
    AT(0, "\x01\xda", "an SGI picture", TO_TIFF),
    AT(8, "CIMG", "a Maya IFF picture", TO_TIFF),
    AT(0, "DDS ", "a DDS texture", TO_TIFF),
    AT(0, "\xabKTX ", "a KTX texture of a graphics card", EXPORT),
    AT(0, "\0\0\1\0", "an ICO icon", TO_TIFF),
    AT(0, "gimp xcf", "a GIMP document (XCF)", EXPORT),
    AT(0, "FUJIFILM", "a raw picture of a camera", TO_TIFF),
    AT(4, "ftypcrx", "a raw picture of a camera", TO_TIFF),
    AT(0, "%PDF-", "a PDF document",
       "'pdftoppm -r 300 -png IN OUT' makes PNG pictures of its pages"),
    AT(0, "%!PS", "a PostScript document", EXPORT),
    AT(0, "BLENDER", "a Blender scene", RENDER),
    AT(0, "//Maya ASCII", "a Maya scene", RENDER),
    AT(8, "Maya", "a Maya scene", RENDER),
    AT(0, "#! /", "a script", RENDER),
    AT(0, "PXR-USDC", "a USD scene", RENDER),
    AT(0, "#usda", "a USD scene", RENDER),
    AT(0, "Ogawa", "an Alembic scene", RENDER),
    AT(0, "Kaydara FBX", "an FBX scene", RENDER),
    AT(0, "glTF", "a glTF scene", RENDER),
    AT(1, "BDV", "an OpenVDB volume", RENDER),
    AT(8, "Egg!", "an After Effects project", RENDER),
    AT(0, "PK\3\4", "a ZIP archive, or a document that is one", UNPACK),
    AT(0, "\x1f\x8b", "packed by gzip", UNPACK),
    AT(0, "\x28\xb5\x2f\xfd", "packed by zstd, as scenes of Blender are", UNPACK),
    AT(0, "BZh", "packed by bzip2", UNPACK),
    AT(0,
       "\xfd"
       "7zXZ",
       "packed by xz", UNPACK),
    AT(0, "7z\xbc\xaf", "a 7-Zip archive", UNPACK),
    AT(0, "Rar!", "a RAR archive", UNPACK),
    AT(257, "ustar", "a tar archive", UNPACK),
    AT(8, "WAVE", "sound (WAV)", SOUND),
    AT(0, "ID3", "sound (MP3)", "'ffmpeg -i IN OUT.wav' makes WAV of it; " SOUND),
    AT(0, "fLaC", "sound (FLAC)", "'ffmpeg -i IN OUT.wav' makes WAV of it; " SOUND),
    AT(0,
       "\x7f"
       "ELF",
       "a program", "give pictures or video"),
};

const wf_kind *wf_kind_at(size_t index) {
    return index < sizeof kinds / sizeof *kinds ? &kinds[index] : NULL;
}

/* ---- What begins as others do ---- */

#define HEAD_BYTES 512

static bool ends_in_raw(const char *path) {
    static const char *const endings[] = {".dng", ".cr2", ".cr3", ".nef", ".arw", ".orf",
                                          ".rw2", ".pef", ".srw", ".raf", ".3fr", ".iiq"};
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++)
        if (wf_name_ends_in(path, endings[i])) return true;
    return false;
}

/* Letters, blanks and bytes of UTF-8, of which there are some. Headers of pictures and video
 * have others, or are known by their first words. */
static bool is_text(const unsigned char *head, size_t bytes) {
    static const char *const known[] = {"#?RADIAN", "#?RGBE", "YUV4MPEG2", "ffconcat",
                                        "#EXTM3U"};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (!strncmp((const char *)head, known[i], strlen(known[i]))) return false;
    for (size_t i = 0; i < bytes; i++)
        if (head[i] == 0x7f || (head[i] < ' ' && !(head[i] && strchr("\t\n\r\f", head[i]))))
            return false;
    return bytes > 0;
}

static bool is_zero(const unsigned char *head, size_t bytes) {
    size_t at = 0;
    while (at < bytes && !head[at]) at++;
    return at == bytes && bytes >= 64;
}

static bool begins_as(const wf_kind *k, const unsigned char *head, size_t bytes) {
    return bytes >= k->offset + k->magic_bytes &&
           !memcmp(head + k->offset, k->magic, k->magic_bytes);
}

/* ---- One file ---- */

static weft_status refuse(const char *path, const char *name, const char *advice,
                          weft_error *err) {
    bool sound = !strncmp(name, "sound", strlen("sound")); /* which --audio takes */
    return wf_fail(err, WEFT_FAILED, "%.700s: it is %s, which %s; %s", path, name,
                   sound ? "holds no video" : "weft does not read", advice);
}

static weft_status refuse_head(const char *path, const unsigned char *head, size_t bytes,
                               weft_error *err) {
    if (ends_in_raw(path)) return refuse(path, "a raw picture of a camera", TO_TIFF, err);
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        if (begins_as(&kinds[i], head, bytes))
            return refuse(path, kinds[i].name, kinds[i].advice, err);
    if (is_zero(head, bytes))
        return wf_fail(
            err, WEFT_FAILED,
            "%.700s: it begins with nothing but zeros: it may still be being copied, "
            "or its disk was full; wait for it or write it again",
            path);
    if (!is_text(head, bytes)) return WEFT_OK;
    return refuse(path, "text",
                  wf_name_ends_in(path, ".lua") ? "'weft render IN' makes video of a scene"
                                                : "give pictures or video",
                  err);
}

weft_status wf_refuse_kind(const char *path, weft_error *err) {
    struct stat about;
    unsigned char head[HEAD_BYTES];
    bool raw_video = wf_name_ends_in(path, ".v210") || wf_name_ends_in(path, ".uyvy");
    if (raw_video || stat(path, &about) || !S_ISREG(about.st_mode)) return WEFT_OK;
    size_t got;
    weft_status status = wf_infile_head(path, head, sizeof head, &got, err);
    return status ? status : refuse_head(path, head, got, err);
}

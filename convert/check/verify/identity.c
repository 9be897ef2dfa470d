/* Finds files that say they are the same material and are not. */
#include "convert/check/verify/identity.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "convert/base/fail.h"
#include "convert/base/infile.h"

typedef struct identity {
    const char *path;
    wf_structure structure;
} identity;

struct wf_identities {
    size_t count;
    identity of[];
};

/* MXF begins with a key of SMPTE's, Matroska with that of EBML. */
static const char *container_of(FILE *file) {
    static const uint8_t ebml[] = {0x1a, 0x45, 0xdf, 0xa3}, mxf[] = {0x06, 0x0e, 0x2b, 0x34};
    uint8_t head[4];
    if (fread(head, 1, sizeof head, file) != sizeof head) return NULL;
    return !memcmp(head, ebml, sizeof ebml) ? "matroska"
           : !memcmp(head, mxf, sizeof mxf) ? "mxf"
                                            : NULL;
}

static bool is_file(const char *path) {
    struct stat about;
    return !stat(path, &about) && S_ISREG(about.st_mode);
}

static weft_status read_one(identity *one, weft_error *err) {
    FILE *file;
    weft_status status = wf_infile_open(one->path, &file, err);
    if (status) return status;
    const char *container = container_of(file);
    if (container) wf_structure_of(file, container, &one->structure);
    return wf_infile_close(file, one->path, WEFT_OK, err);
}

weft_status wf_identities_read(const char *const *paths, size_t count, wf_identities **out,
                               weft_error *err) {
    wf_identities *all = *out = calloc(1, sizeof *all + count * sizeof(identity));
    weft_status status = WEFT_OK;
    if (!all) return wf_fail(err, WEFT_NO_MEMORY, "out of memory");
    all->count = count;
    for (size_t i = 0; i < count; i++) {
        all->of[i].path = paths[i];
        if (!status && is_file(paths[i])) status = read_one(&all->of[i], err);
    }
    if (!status) return WEFT_OK;
    free(all);
    *out = NULL;
    return status;
}

void wf_identities_free(wf_identities *identities) {
    free(identities);
}

static bool have_same_bytes(FILE *a, FILE *b) {
    uint8_t block[2][1 << 14];
    for (size_t got = sizeof *block; got == sizeof *block;) {
        got = fread(block[0], 1, sizeof *block, a);
        if (fread(block[1], 1, sizeof *block, b) != got || memcmp(block[0], block[1], got))
            return false;
    }
    return true;
}

/* A copy is the same material. */
static weft_status compare(const char *path, const char *other, bool *alike, weft_error *err) {
    FILE *a, *b;
    weft_status status = wf_infile_open(path, &a, err);
    if (status) return status;
    status = wf_infile_open(other, &b, err);
    if (status) return wf_infile_close(a, path, status, err);
    *alike = have_same_bytes(a, b);
    status = wf_infile_close(a, path, WEFT_OK, err);
    return wf_infile_close(b, other, status, err);
}

/* Files of OP-Atom share the material package that plays them together, and have file packages
 * of their own. */
static bool share(const wf_structure *a, const wf_structure *b) {
    for (int which = 0; which < 2; which++) {
        bool plays = which == 0 && (a->has_id[1] || b->has_id[1]);
        if (!plays && a->has_id[which] && b->has_id[which] &&
            !memcmp(a->id[which], b->id[which], WF_ID_BYTES))
            return true;
    }
    return false;
}

weft_status wf_identities_shared(const wf_identities *all, const char *path,
                                 const wf_structure *structure, const char **shared,
                                 weft_error *err) {
    weft_status status = WEFT_OK;
    *shared = NULL;
    for (size_t i = 0; all && i < all->count && !status && !*shared; i++) {
        const identity *other = &all->of[i];
        bool alike = false;
        if (!strcmp(other->path, path) || !share(&other->structure, structure)) continue;
        status = compare(other->path, path, &alike, err);
        if (!alike) *shared = other->path;
    }
    return status;
}

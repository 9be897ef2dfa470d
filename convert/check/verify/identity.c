/* Finds files that say they are the same material and are not. */
#include "convert/check/verify/identity.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

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

wf_identities *wf_identities_read(const char *const *paths, size_t count) {
    wf_identities *all = calloc(1, sizeof *all + count * sizeof(identity));
    if (!all) return NULL;
    all->count = count;
    for (size_t i = 0; i < count; i++) {
        all->of[i].path = paths[i];
        FILE *file = is_file(paths[i]) ? fopen(paths[i], "rbe") : NULL;
        const char *container = file ? container_of(file) : NULL;
        if (container) wf_structure_of(file, container, &all->of[i].structure);
        if (file) fclose(file);
    }
    return all;
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
static bool are_alike(const char *path, const char *other) {
    FILE *a = fopen(path, "rbe"), *b = fopen(other, "rbe");
    bool alike = a && b && have_same_bytes(a, b);
    if (a) fclose(a);
    if (b) fclose(b);
    return alike;
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

const char *wf_identities_shared(const wf_identities *all, const char *path,
                                 const wf_structure *structure) {
    for (size_t i = 0; all && i < all->count; i++)
        if (strcmp(all->of[i].path, path) && share(&all->of[i].structure, structure) &&
            !are_alike(all->of[i].path, path))
            return all->of[i].path;
    return NULL;
}

/* Files that are read, and what the system has against them. */
#include "convert/base/infile.h"

#include <errno.h>
#include <string.h>

#include "convert/base/fail.h"

static weft_status fail(const char *path, int code, weft_error *err) {
    return wf_fail(err, code == ENOMEM ? WEFT_NO_MEMORY : WEFT_FAILED, "%.700s: %s", path,
                   strerror(code));
}

weft_status wf_infile_open(const char *path, FILE **out, weft_error *err) {
    *out = fopen(path, "rbe");
    return *out ? WEFT_OK : fail(path, errno, err);
}

weft_status wf_infile_close(FILE *file, const char *path, weft_status status, weft_error *err) {
    bool unread = ferror(file);
    fclose(file);
    return unread ? fail(path, EIO, err) : status;
}

weft_status wf_infile_head(const char *path, void *to, size_t bytes, size_t *got,
                           weft_error *err) {
    FILE *file;
    *got = 0;
    weft_status status = wf_infile_open(path, &file, err);
    if (status) return status;
    *got = fread(to, 1, bytes, file);
    return wf_infile_close(file, path, status, err);
}

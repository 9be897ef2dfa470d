/* EXR files through OpenEXRCore, by reads of our own. */
#include "convert/read/exr_stream.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "convert/base/fail.h"

/* Keeps what OpenEXRCore says of a header. What it says of chunks is dropped, since many
 * threads read them and their status is enough. */
static void listen(exr_const_context_t exr, exr_result_t code, const char *message) {
    void *user = NULL;
    (void)code;
    if (!exr || exr_get_user_data(exr, &user) || !user) return;
    wf_exr_stream *s = user;
    if (s->opened) return;
    sscanf(message, "Attribute 'compression' (type 'compression'): Invalid value %u",
           &s->unknown_compression);
    snprintf(s->said, sizeof s->said, "%s", message);
}

static int64_t read_at(exr_const_context_t exr, void *user, void *to, uint64_t bytes,
                       uint64_t offset, exr_stream_error_func_ptr_t say) {
    wf_exr_stream *s = user;
    uint64_t got = 0;
    while (got < bytes) {
        ssize_t n =
            pread(s->fd, (char *)to + got, (size_t)(bytes - got), (off_t)(offset + got));
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) {
            __atomic_store_n(&s->code, errno, __ATOMIC_RELAXED);
            return -1;
        }
        if (!n) break;
        got += (uint64_t)n;
    }
    if (got < bytes)
        say(exr, EXR_ERR_READ_IO, "it ends %llu bytes too early",
            (unsigned long long)(bytes - got));
    return (int64_t)got;
}

static int64_t size_of(exr_const_context_t exr, void *user) {
    const wf_exr_stream *s = user;
    struct stat about;
    (void)exr;
    return fstat(s->fd, &about) ? -1 : (int64_t)about.st_size;
}

exr_result_t wf_exr_stream_start(wf_exr_stream *s, const char *path) {
    exr_context_initializer_t how = EXR_DEFAULT_CONTEXT_INITIALIZER;
    how.error_handler_fn = listen;
    how.user_data = s;
    how.read_fn = read_at;
    how.size_fn = size_of;
    how.max_image_width = how.max_image_height = WF_EXR_MOST_PIXELS_A_SIDE;
    how.flags = EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION;
    s->fd = open(path, O_RDONLY | O_CLOEXEC);
    if (s->fd < 0) {
        s->code = errno;
        return EXR_ERR_FILE_ACCESS;
    }
    exr_result_t result = exr_start_read(&s->exr, path, &how);
    s->opened = true;
    return result;
}

void wf_exr_stream_end(wf_exr_stream *s) {
    if (s->exr) exr_finish(&s->exr);
    if (s->opened) close(s->fd);
    *s = (wf_exr_stream){.exr = NULL};
}

weft_status wf_exr_stream_trouble(const wf_exr_stream *s, exr_result_t result, const char *path,
                                  weft_error *err) {
    int code = __atomic_load_n(&s->code, __ATOMIC_RELAXED);
    if (code) return wf_fail(err, WEFT_FAILED, "%.700s: %s", path, strerror(code));
    if (result == EXR_ERR_OUT_OF_MEMORY)
        return wf_fail(err, WEFT_NO_MEMORY, "%.700s: no memory to read it", path);
    return WEFT_OK;
}

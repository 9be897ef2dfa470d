/* Files that appear whole or not at all: buffered writing, and the errors that stick. */
#include "convert/base/outfile.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

#include "convert/base/outplace.h"

#define BUFFER_BYTES ((size_t)1 << 20)
/* Files take their memory in pieces of what they are written in, and large ones cost the kernel
 * several times as much. */
#define WRITTEN_BYTES ((size_t)256 << 10)

struct wf_outfile {
    wf_outplace place;
    bool named;    /* false: "-", pipes and devices, which are written as they come */
    bool borrowed; /* standard output stays open */
    int fd;
    unsigned char *buffer;
    size_t used;
    weft_status status; /* of the first failure, which sticks */
    weft_error failure;
};

/* ---- Failing ---- */

static const char *name_of(const wf_outfile *file) {
    return file->borrowed ? "standard output" : file->place.path;
}

/* Keeps the failure, which every later call returns again, and hands it out. */
static weft_status stick(wf_outfile *file, int code, const char *doing, weft_error *err) {
    const char *hint = code == ENOSPC || code == EDQUOT ? "; make room, or write elsewhere"
                       : code == EPIPE                  ? "; whoever was reading it has stopped"
                       : code == EFBIG ? "; the file system or a limit allows no larger file"
                                       : "";
    file->status = wf_fail(&file->failure, WEFT_FAILED, "%.700s: %s: %s%s", name_of(file),
                           doing, strerror(code), hint);
    return wf_fail(err, file->status, "%s", file->failure.text);
}

/* ---- Writing ---- */

/* writev, without the signals of a closed pipe (SIGPIPE) and of a limit on the size of files
 * (SIGXFSZ), which a program that uses the library may not expect. Signals that were pending
 * before stay so. */
static ssize_t write_quietly(int fd, const struct iovec *pieces, int count) {
    sigset_t quiet, pending, before;
    sigemptyset(&quiet);
    sigaddset(&quiet, SIGPIPE);
    sigaddset(&quiet, SIGXFSZ);
    pthread_sigmask(SIG_BLOCK, &quiet, &before);
    sigpending(&pending);
    ssize_t written = writev(fd, pieces, count);
    int code = errno, number = code == EPIPE ? SIGPIPE : SIGXFSZ;
    if (written < 0 && (code == EPIPE || code == EFBIG) && !sigismember(&pending, number)) {
        sigdelset(&quiet, number == SIGPIPE ? SIGXFSZ : SIGPIPE);
        sigtimedwait(&quiet, NULL, &(struct timespec){0});
    }
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    errno = code;
    return written;
}

/* Writes all of the pieces; returns 0 or an errno. It waits where standard output is a pipe
 * that does not block, since that mode belongs to whoever shares the pipe. */
static int write_pieces(int fd, struct iovec *pieces, int count) {
    while (count) {
        if (!pieces->iov_len) {
            pieces++, count--;
            continue;
        }
        struct iovec first = {pieces->iov_base, pieces->iov_len};
        if (first.iov_len > WRITTEN_BYTES) first.iov_len = WRITTEN_BYTES;
        ssize_t written = write_quietly(fd, &first, 1);
        if (written < 0 && errno == EAGAIN)
            poll(&(struct pollfd){.fd = fd, .events = POLLOUT}, 1, 1000);
        else if (written < 0 && errno != EINTR)
            return errno;
        for (size_t rest = written > 0 ? (size_t)written : 0; rest;) {
            size_t step = rest < pieces->iov_len ? rest : pieces->iov_len;
            pieces->iov_base = (char *)pieces->iov_base + step;
            pieces->iov_len -= step;
            rest -= step;
            if (!pieces->iov_len) pieces++, count--;
        }
    }
    return 0;
}

weft_status wf_outfile_write(wf_outfile *file, const void *data, size_t bytes,
                             weft_error *err) {
    if (file->status) return wf_fail(err, file->status, "%s", file->failure.text);
    if (bytes <= BUFFER_BYTES - file->used) {
        if (bytes) memcpy(file->buffer + file->used, data, bytes);
        file->used += bytes;
        return WEFT_OK;
    }
    /* What is larger than what is left of the buffer goes out with what waits before it. */
    struct iovec pieces[2] = {{file->buffer, file->used}, {(void *)(uintptr_t)data, bytes}};
    file->used = 0;
    int code = write_pieces(file->fd, pieces, 2);
    /* Has the disk begin at once, so that the sync at the end has little left to wait for. */
    if (file->named) sync_file_range(file->fd, 0, 0, SYNC_FILE_RANGE_WRITE);
    return code ? stick(file, code, "cannot be written", err) : WEFT_OK;
}

/* Returns 0 or an errno. */
static int write_waiting(wf_outfile *file) {
    struct iovec piece = {file->buffer, file->used};
    file->used = 0;
    return write_pieces(file->fd, &piece, 1);
}

weft_status wf_outfile_seek(wf_outfile *file, int64_t offset, weft_error *err) {
    if (file->status) return wf_fail(err, file->status, "%s", file->failure.text);
    int code = write_waiting(file);
    if (code) return stick(file, code, "cannot be written", err);
    if (lseek(file->fd, offset, SEEK_SET) < 0)
        return stick(file, errno, "cannot be written from another place on", err);
    return WEFT_OK;
}

weft_status wf_outfile_read(wf_outfile *file, int64_t offset, void *data, size_t bytes,
                            size_t *got, weft_error *err) {
    *got = 0;
    if (file->status) return wf_fail(err, file->status, "%s", file->failure.text);
    int code = write_waiting(file);
    if (code) return stick(file, code, "cannot be written", err);
    while (*got < bytes) {
        ssize_t n = pread(file->fd, (char *)data + *got, bytes - *got, offset + (off_t)*got);
        if (n < 0 && errno != EINTR) return stick(file, errno, "cannot be read back", err);
        if (!n) break;
        if (n > 0) *got += (size_t)n;
    }
    return WEFT_OK;
}

/* ---- Opening and closing ---- */

static void release(wf_outfile *file) {
    if (file->fd >= 0 && !file->borrowed) close(file->fd);
    wf_outplace_forget(&file->place);
    free(file->buffer);
    free(file);
}

/* FIFOs and devices (/dev/null) are not replaced but written to. */
static bool is_stream(const char *path) {
    struct stat about;
    return !stat(path, &about) && !S_ISREG(about.st_mode) && !S_ISDIR(about.st_mode);
}

static weft_status open_stream(wf_outfile *file, const char *path, weft_error *err) {
    file->place.path = strdup(path);
    if (!file->place.path) return wf_fail(err, WEFT_NO_MEMORY, "%.700s: out of memory", path);
    file->fd = open(path, O_WRONLY | O_CLOEXEC | O_NOCTTY);
    return file->fd < 0 ? stick(file, errno, "cannot be opened", err) : WEFT_OK;
}

weft_status wf_outfile_open(const char *path, bool overwrite, wf_outfile **out,
                            weft_error *err) {
    wf_outfile *file = calloc(1, sizeof *file);
    *out = NULL;
    if (file) file->buffer = malloc(BUFFER_BYTES);
    if (!file || !file->buffer) {
        free(file);
        return wf_fail(err, WEFT_NO_MEMORY, "%.700s: out of memory", path);
    }
    weft_status status = WEFT_OK;
    file->fd = -1;
    if (!strcmp(path, "-")) {
        file->borrowed = true;
        file->fd = STDOUT_FILENO;
    } else if (is_stream(path)) {
        status = open_stream(file, path, err);
    } else {
        file->named = true;
        status = wf_outplace_open(path, overwrite, &file->place, &file->fd, err);
    }
    if (status)
        release(file);
    else
        *out = file;
    return status;
}

weft_status wf_outfile_check(const char *path, bool overwrite, weft_error *err) {
    wf_outplace place = {.path = NULL};
    int fd = -1;
    if (!strcmp(path, "-") || is_stream(path)) return WEFT_OK;
    weft_status status = wf_outplace_open(path, overwrite, &place, &fd, err);
    if (fd >= 0) close(fd);
    wf_outplace_forget(&place);
    return status;
}

/* Returns 0 or an errno. A file system that has nothing to sync is no failure. */
static int sync_data(int fd) {
    while (fdatasync(fd)) {
        if (errno == EINVAL || errno == ENOSYS) return 0;
        if (errno != EINTR) return errno;
    }
    return 0;
}

static weft_status flush(wf_outfile *file, weft_error *err) {
    if (file->status) return wf_fail(err, file->status, "%s", file->failure.text);
    int code = write_waiting(file);
    if (code) return stick(file, code, "cannot be written", err);
    /* Before the name is given: the data are whole on the disk, or the name does not appear. */
    if (file->named) code = sync_data(file->fd);
    return code ? stick(file, code, "cannot be written", err) : WEFT_OK;
}

weft_status wf_outfile_commit(wf_outfile *file, weft_error *err) {
    weft_status status = flush(file, err);
    if (!status && file->named) {
        status = wf_outplace_publish(&file->place, file->fd, err);
        file->fd = -1;
    } else if (!status && !file->borrowed) {
        int code = close(file->fd) ? errno : 0;
        file->fd = -1;
        if (code && code != EINTR) status = stick(file, code, "cannot be closed", err);
    }
    release(file);
    return status;
}

void wf_outfile_abandon(wf_outfile *file) {
    if (file) release(file);
}

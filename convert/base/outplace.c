/* Where a new file is until it has its name, and how it gets it. */
#include "convert/base/outplace.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define MOST_LINKS       40 /* as the kernel allows */
#define MOST_TEMPORARIES 1000
#define NAME_SHOWN       200 /* of NAME in .NAME.PID.N.tmp, which must not be longer than 255 */

static weft_status no_memory(const char *path, weft_error *err) {
    return wf_fail(err, WEFT_NO_MEMORY, "%.700s: out of memory", path);
}

static weft_status fail_at(const wf_outplace *place, const char *doing, int code,
                           weft_error *err) {
    return wf_fail(err, WEFT_FAILED, "%.700s: %s: %s", place->path, doing, strerror(code));
}

/* ---- Paths ---- */

static size_t directory_length(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash ? (size_t)(slash - path) + 1 : 0;
}

/* The directory of the target: "" is ".". NULL when memory is out. */
static char *directory_of(const wf_outplace *place) {
    size_t length = directory_length(place->target);
    return length ? strndup(place->target, length) : strdup(".");
}

/* What the link at path says, seen from where path is; NULL if path is no link or memory is
 * out. */
static char *link_target(const char *path) {
    char text[4096], *joined;
    ssize_t length = readlink(path, text, sizeof text - 1);
    if (length <= 0) return NULL;
    text[length] = '\0';
    int directory = *text == '/' ? 0 : (int)directory_length(path);
    return asprintf(&joined, "%.*s%s", directory, path, text) < 0 ? NULL : joined;
}

/* Follows links as a shell's '>' does, including one that leads nowhere. */
static weft_status follow_links(wf_outplace *place, weft_error *err) {
    place->target = strdup(place->path);
    if (!place->target) return no_memory(place->path, err);
    char *next;
    for (int links = 0; (next = link_target(place->target)); links++) {
        free(place->target);
        place->target = next;
        if (links == MOST_LINKS) return fail_at(place, "cannot be opened", ELOOP, err);
    }
    return WEFT_OK;
}

/* ---- Opening ---- */

static weft_status check_target(const wf_outplace *place, weft_error *err) {
    struct stat about;
    const char *path = place->path;
    if (!place->target[directory_length(place->target)] && stat(place->target, &about))
        return wf_fail(err, WEFT_FAILED, "%.700s: this names a directory; name a file in it",
                       path);
    if (stat(place->target, &about)) return WEFT_OK;
    if (S_ISDIR(about.st_mode))
        return wf_fail(err, WEFT_FAILED, "%.700s: this is a directory; name a file in it",
                       path);
    if (!place->overwrite)
        return wf_fail(err, WEFT_FAILED,
                       "%.700s exists; give --overwrite to replace it, or --resume", path);
    if (faccessat(AT_FDCWD, place->target, W_OK, AT_EACCESS) && errno == EACCES)
        return wf_fail(err, WEFT_FAILED,
                       "%.700s exists and is protected from writing; change its mode or write "
                       "elsewhere",
                       path);
    return WEFT_OK;
}

static weft_status refuse_directory(const wf_outplace *place, const char *directory, int code,
                                    weft_error *err) {
    const char *hint = code == ENOENT    ? "; make it first, or write elsewhere"
                       : code == ENOTDIR ? "; write into a directory"
                                         : "; write elsewhere";
    return wf_fail(err, WEFT_FAILED,
                   "%.400s: nothing can be written in the directory %.400s: %s%s", place->path,
                   directory, strerror(code), hint);
}

/* A file without a name can be given one only through /proc. */
static int open_nameless(const char *directory) {
    char self[64];
    int fd = open(directory, O_TMPFILE | O_RDWR | O_CLOEXEC, 0666);
    if (fd < 0) return -1;
    snprintf(self, sizeof self, "/proc/self/fd/%d", fd);
    if (!access(self, F_OK)) return fd;
    close(fd);
    errno = EOPNOTSUPP;
    return -1;
}

/* Makes a temporary name beside the target that no file has, and calls `make` with it; *fd
 * receives what that returns, or -1 with errno set. The name is NULL when memory is out. */
typedef int make_fn(const char *name, int fd);
static char *beside(const wf_outplace *place, make_fn *make, int *fd) {
    const char *target = place->target;
    size_t length = directory_length(target);
    int given = *fd;
    for (int n = 0; n < MOST_TEMPORARIES; n++) {
        char *name;
        if (asprintf(&name, "%.*s.%.*s.%ld.%d.tmp", (int)length, target, NAME_SHOWN,
                     target + length, (long)getpid(), n) < 0)
            return NULL;
        *fd = make(name, given);
        if (*fd >= 0 || errno != EEXIST || n == MOST_TEMPORARIES - 1) return name;
        free(name);
    }
    return NULL;
}

static int make_new(const char *name, int fd) {
    (void)fd;
    return open(name, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
}

static weft_status open_named(wf_outplace *place, const char *directory, int *fd,
                              weft_error *err) {
    place->temporary = beside(place, make_new, fd);
    if (!place->temporary) return no_memory(place->path, err);
    if (*fd >= 0) return WEFT_OK;
    int code = errno;
    free(place->temporary);
    place->temporary = NULL;
    return code == ENAMETOOLONG ? fail_at(place, "cannot be opened", code, err)
                                : refuse_directory(place, directory, code, err);
}

static bool has_no_nameless(int code) {
    return code == EOPNOTSUPP || code == EISDIR || code == EINVAL || code == ENOSYS;
}

static weft_status open_in(wf_outplace *place, const char *directory, int *fd,
                           weft_error *err) {
    const char *name = place->target + directory_length(place->target);
    if (strlen(name) > 255) return fail_at(place, "cannot be opened", ENAMETOOLONG, err);
    *fd = open_nameless(directory);
    if (*fd >= 0) return WEFT_OK;
    return has_no_nameless(errno) ? open_named(place, directory, fd, err)
                                  : refuse_directory(place, directory, errno, err);
}

weft_status wf_outplace_open(const char *path, bool overwrite, wf_outplace *out, int *fd,
                             weft_error *err) {
    *out = (wf_outplace){.path = strdup(path), .overwrite = overwrite};
    *fd = -1;
    if (!out->path) return no_memory(path, err);
    weft_status status = follow_links(out, err);
    if (!status) status = check_target(out, err);
    if (status) return status;
    char *directory = directory_of(out);
    if (!directory) return no_memory(path, err);
    status = open_in(out, directory, fd, err);
    free(directory);
    return status;
}

/* ---- Publishing ---- */

static int link_as(const char *name, int fd) {
    char self[64];
    snprintf(self, sizeof self, "/proc/self/fd/%d", fd);
    return linkat(AT_FDCWD, self, AT_FDCWD, name, AT_SYMLINK_FOLLOW);
}

/* Renames without replacing anything, also where the file system cannot promise that. */
static int rename_new(const char *from, const char *to) {
    if (!renameat2(AT_FDCWD, from, AT_FDCWD, to, RENAME_NOREPLACE)) return 0;
    if (errno != EINVAL && errno != ENOSYS) return -1;
    if (access(to, F_OK)) return rename(from, to);
    errno = EEXIST;
    return -1;
}

static int give_name(wf_outplace *place, int fd) {
    if (!place->temporary) {
        if (!link_as(place->target, fd)) return 0;
        if (errno != EEXIST || !place->overwrite) return errno;
        int made = fd;
        place->temporary = beside(place, link_as, &made);
        if (!place->temporary) return ENOMEM;
        if (made < 0) {
            int code = errno;
            free(place->temporary);
            place->temporary = NULL;
            return code;
        }
    }
    if ((place->overwrite ? rename : rename_new)(place->temporary, place->target)) return errno;
    free(place->temporary);
    place->temporary = NULL;
    return 0;
}

/* A new name is data of its directory, which is therefore synced too. Directories that
 * cannot be synced are passed over, since no other way would save more. */
static int sync_directory(const wf_outplace *place) {
    char *directory = directory_of(place);
    if (!directory) return ENOMEM;
    int fd = open(directory, O_RDONLY | O_DIRECTORY | O_CLOEXEC), code = 0;
    free(directory);
    if (fd < 0) return 0;
    if (fsync(fd) && errno != EINVAL && errno != EROFS && errno != ENOTSUP) code = errno;
    close(fd);
    return code;
}

weft_status wf_outplace_publish(wf_outplace *place, int fd, weft_error *err) {
    /* Network file systems report a full disk when a file is closed. It is closed before it
     * has its name, unless its descriptor is needed to give it one. */
    bool early = place->temporary;
    int code = early && close(fd) && errno != EINTR ? errno : 0;
    if (code) return fail_at(place, "cannot be written", code, err);
    code = give_name(place, fd);
    if (!early && close(fd) && errno != EINTR && !code) {
        code = errno;
        unlink(place->target);
    }
    if (code == EEXIST)
        return wf_fail(
            err, WEFT_FAILED,
            "%.700s: a file of this name appeared while it was being written, and was "
            "left alone; give --overwrite to replace it",
            place->path);
    if (code) return fail_at(place, "the finished file cannot be given its name", code, err);
    code = sync_directory(place);
    if (!code) return WEFT_OK;
    unlink(place->target);
    return fail_at(place, "its directory cannot be synced", code, err);
}

void wf_outplace_forget(wf_outplace *place) {
    if (place->temporary) unlink(place->temporary);
    free(place->temporary);
    free(place->target);
    free(place->path);
    *place = (wf_outplace){0};
}

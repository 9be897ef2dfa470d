/* Preloaded into a program, lets one call of a kind fail, or ends the program at it:
 *
 *     WEFT_FAULT=KIND:N[:more]   the Nth call of that kind fails (":more": all after it too)
 *     WEFT_FAULT=disk:BYTES      so many bytes can be written, then the disk is full
 *     WEFT_FAULT=kill:N          SIGKILL before the Nth call that writes, syncs, names or
 * closes WEFT_FAULT_WHO=weft|far    whose calls for memory count: weft's with those of the
 * small C libraries that it calls (default), or those of all other libraries
 *     WEFT_FAULT_LOG=FILE        where it says, at its end, how many calls there were, and who
 * met the fault
 *
 * Kinds are alloc, thread, open, read, write, sync, name, close. Of files only those below the
 * working directory count. */
#include <dlfcn.h>
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <link.h>
#include <pthread.h>
#include <signal.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>
#include <unwind.h>

void *__libc_malloc(size_t);
void *__libc_calloc(size_t, size_t);
void *__libc_realloc(void *, size_t);
void *__libc_memalign(size_t, size_t);

typedef enum kind {
    ALLOC,
    THREAD,
    OPEN,
    READ,
    WRITE,
    SYNC,
    NAME,
    CLOSE,
    DISK,
    KILL,
    NONE
} kind;

static const char *const names[] = {"alloc", "thread", "open",  "read", "write",
                                    "sync",  "name",   "close", "disk", "kill"};

static kind wanted = NONE;
static bool more, far_ones;
static unsigned long long at, calls, written_bytes;
static char under[PATH_MAX], log_path[PATH_MAX], who_met[256];
static _Thread_local bool inside;
static bool ready;

/* ---- Whose call it is ---- */

typedef struct seeking {
    const char *object;
    int frames;
} seeking;

static const char *object_of(const void *address) {
    struct dl_find_object found;
    if (_dl_find_object((void *)address, &found)) return "?";
    const char *name = found.dlfo_link_map->l_name;
    return *name ? name : program_invocation_name;
}

static bool begins(const char *text, const char *with) {
    return !strncmp(text, with, strlen(with));
}

static bool is_named(const char *path, const char *with) {
    const char *slash = strrchr(path, '/');
    return begins(slash ? slash + 1 : path, with);
}

/* The C and C++ run time, on whose behalf nobody asks for memory but their callers. */
static bool passes_on(const char *path) {
    static const char *const rows[] = {"libc.",     "libstdc++", "libgcc_s",
                                       "libfaults", "libm.",     "libc++"};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (is_named(path, rows[i])) return true;
    return false;
}

/* The loader is not one of these: where it has no memory it may end the process, and no caller
 * can help it. */
static _Unwind_Reason_Code step(struct _Unwind_Context *context, void *user) {
    seeking *s = user;
    s->object = object_of((void *)_Unwind_GetIP(context));
    return s->frames++ < 64 && passes_on(s->object) ? _URC_NO_REASON : _URC_END_OF_STACK;
}

/* What weft itself calls, and answers for. */
static bool is_near(const char *path) {
    static const char *const rows[] = {"weft",  "libweft",    "liblua",    "libjansson",
                                       "test-", "libdeflate", "libxxhash", "push"};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (is_named(path, rows[i])) return true;
    return false;
}

static const char *caller(const void *address) {
    const char *object = object_of(address);
    if (!passes_on(object)) return object;
    seeking s = {"?", 0};
    _Unwind_Backtrace(step, &s);
    return s.object;
}

/* ---- Counting ---- */

/* Says how many calls there were, without anything that allocates. */
static void tell(void) {
    char text[512];
    int fd = *log_path ? (int)syscall(SYS_openat, AT_FDCWD, log_path,
                                      O_WRONLY | O_CREAT | O_TRUNC, 0644)
                       : -1;
    if (fd < 0) return;
    int length = snprintf(text, sizeof text, "%llu %llu %s\n", calls, written_bytes, who_met);
    syscall(SYS_write, fd, text, (size_t)length);
    syscall(SYS_close, fd);
}

static void set_up(void) {
    const char *text = getenv("WEFT_FAULT"), *log = getenv("WEFT_FAULT_LOG"),
               *who = getenv("WEFT_FAULT_WHO");
    seeking warm = {"?", 0};
    inside = true;
    _Unwind_Backtrace(step, &warm);
    inside = false;
    ready = true;
    if (!text) return;
    far_ones = who && !strcmp(who, "far");
    if (log) snprintf(log_path, sizeof log_path, "%s", log);
    if (!getcwd(under, sizeof under)) *under = '\0';
    size_t length = strcspn(text, ":");
    for (kind k = ALLOC; k < NONE; k++)
        if (strlen(names[k]) == length && !strncmp(text, names[k], length)) wanted = k;
    if (text[length]) {
        char *end;
        at = strtoull(text + length + 1, &end, 10);
        more = !strcmp(end, ":more");
    }
}

__attribute__((constructor)) static void begin(void) {
    if (!ready) set_up();
}

__attribute__((destructor)) static void end(void) {
    if (ready && wanted != NONE) tell();
}

/* Whether this call of the kind is the one that is to fail. */
static bool counts(const char *who) {
    unsigned long long n = __atomic_add_fetch(&calls, 1, __ATOMIC_SEQ_CST);
    if (!at || n < at || (n > at && !more)) return false;
    if (n == at) {
        const char *slash = strrchr(who, '/');
        snprintf(who_met, sizeof who_met, "%s", slash ? slash + 1 : who);
        tell();
    }
    return true;
}

/* Whether a call of an object of that name is counted. */
static bool is_counted(const char *who) {
    return is_near(who) != far_ones;
}

static bool fails(kind k, const char *who, int code) {
    if (!ready || inside || (wanted != k && wanted != KILL)) return false;
    bool hit = counts(who);
    if (hit && wanted == KILL) raise(SIGKILL);
    if (hit) errno = code;
    return hit;
}

static bool memory_fails(const void *address) {
    if (!ready || inside || wanted != ALLOC) return false;
    inside = true;
    const char *who = caller(address);
    bool hit = is_counted(who) && counts(who);
    inside = false;
    if (hit) errno = ENOMEM;
    return hit;
}

/* ---- Which files ---- */

static bool is_ours_fd(int fd) {
    char self[64], path[PATH_MAX];
    if (!ready || wanted == NONE || wanted == ALLOC) return false;
    int saved = errno;
    snprintf(self, sizeof self, "/proc/self/fd/%d", fd);
    ssize_t length = readlink(self, path, sizeof path - 1);
    errno = saved;
    if (length < 0) return false;
    path[length] = '\0';
    return *under && begins(path, under);
}

static bool is_ours(const char *path) {
    return ready && *under && (*path != '/' || begins(path, under));
}

/* ---- Memory ---- */

#define HERE __builtin_return_address(0)

void *malloc(size_t bytes) {
    return memory_fails(HERE) ? NULL : __libc_malloc(bytes);
}
void *calloc(size_t count, size_t bytes) {
    return memory_fails(HERE) ? NULL : __libc_calloc(count, bytes);
}
void *realloc(void *old, size_t bytes) {
    return bytes && memory_fails(HERE) ? NULL : __libc_realloc(old, bytes);
}
void *aligned_alloc(size_t alignment, size_t bytes) {
    return memory_fails(HERE) ? NULL : __libc_memalign(alignment, bytes);
}
void *memalign(size_t alignment, size_t bytes) {
    return memory_fails(HERE) ? NULL : __libc_memalign(alignment, bytes);
}
int posix_memalign(void **out, size_t alignment, size_t bytes) {
    if (memory_fails(HERE)) return ENOMEM;
    void *made = __libc_memalign(alignment, bytes);
    if (made) *out = made;
    return made ? 0 : ENOMEM;
}

/* ---- The calls behind ---- */

#define NEXT(result, name, ...)                                                                \
    static result (*name##_next(void))(__VA_ARGS__) {                                          \
        static result (*found)(__VA_ARGS__);                                                   \
        if (!found) found = (result(*)(__VA_ARGS__))dlsym(RTLD_NEXT, #name);                   \
        return found;                                                                          \
    }

NEXT(int, pthread_create, pthread_t *, const pthread_attr_t *, void *(*)(void *), void *)
int pthread_create(pthread_t *thread, const pthread_attr_t *how, void *(*work)(void *),
                   void *user) {
    const char *who = wanted == THREAD ? caller(__builtin_return_address(0)) : "";
    if (wanted == THREAD && is_counted(who) && fails(THREAD, who, EAGAIN)) return EAGAIN;
    return pthread_create_next()(thread, how, work, user);
}

/* ---- Opening ---- */

static int open_at(int directory, const char *path, int flags, mode_t mode) {
    if (wanted == OPEN && is_ours(path) && fails(OPEN, "a file", EMFILE)) return -1;
    return (int)syscall(SYS_openat, directory, path, flags, mode);
}

#define OPENS(name)                                                                            \
    int name(const char *path, int flags, ...) {                                               \
        va_list rest;                                                                          \
        va_start(rest, flags);                                                                 \
        mode_t mode = flags & (O_CREAT | O_TMPFILE) ? va_arg(rest, mode_t) : 0;                \
        va_end(rest);                                                                          \
        return open_at(AT_FDCWD, path, flags, mode);                                           \
    }
OPENS(open)
OPENS(open64)

int openat(int directory, const char *path, int flags, ...) {
    va_list rest;
    va_start(rest, flags);
    mode_t mode = flags & (O_CREAT | O_TMPFILE) ? va_arg(rest, mode_t) : 0;
    va_end(rest);
    return open_at(directory, path, flags, mode);
}

NEXT(FILE *, fopen, const char *, const char *)
FILE *fopen(const char *path, const char *mode) {
    if (wanted == OPEN && is_ours(path) && fails(OPEN, "a file", EMFILE)) return NULL;
    return fopen_next()(path, mode);
}
FILE *fopen64(const char *path, const char *mode) {
    return fopen(path, mode);
}
NEXT(DIR *, opendir, const char *)
DIR *opendir(const char *path) {
    if (wanted == OPEN && is_ours(path) && fails(OPEN, "a file", EMFILE)) return NULL;
    return opendir_next()(path);
}

/* ---- Reading ---- */

static bool read_fails(int fd) {
    return wanted == READ && is_ours_fd(fd) && fails(READ, "a file", EIO);
}

ssize_t read(int fd, void *to, size_t bytes) {
    return read_fails(fd) ? -1 : syscall(SYS_read, fd, to, bytes);
}
ssize_t pread(int fd, void *to, size_t bytes, off_t offset) {
    return read_fails(fd) ? -1 : syscall(SYS_pread64, fd, to, bytes, offset);
}
ssize_t pread64(int fd, void *to, size_t bytes, off_t offset) {
    return read_fails(fd) ? -1 : syscall(SYS_pread64, fd, to, bytes, offset);
}
NEXT(size_t, fread, void *, size_t, size_t, FILE *)
size_t fread(void *to, size_t bytes, size_t count, FILE *file) {
    if (!read_fails(fileno(file))) return fread_next()(to, bytes, count, file);
    file->_flags |= 0x20; /* what ferror() asks */
    return 0;
}
NEXT(int, getc, FILE *)
int getc(FILE *file) {
    if (!read_fails(fileno(file))) return getc_next()(file);
    file->_flags |= 0x20;
    return EOF;
}
int fgetc(FILE *file) {
    return getc(file);
}
NEXT(char *, fgets, char *, int, FILE *)
char *fgets(char *to, int bytes, FILE *file) {
    if (!read_fails(fileno(file))) return fgets_next()(to, bytes, file);
    file->_flags |= 0x20;
    return NULL;
}
NEXT(ssize_t, getline, char **, size_t *, FILE *)
ssize_t getline(char **to, size_t *bytes, FILE *file) {
    if (!read_fails(fileno(file))) return getline_next()(to, bytes, file);
    file->_flags |= 0x20;
    return -1;
}

/* ---- Writing: *bytes is cut to what there is room for ---- */

static bool write_fails(int fd, size_t *bytes) {
    if ((wanted != WRITE && wanted != DISK && wanted != KILL) || !is_ours_fd(fd)) return false;
    if (wanted != DISK) return fails(WRITE, "a file", wanted == WRITE ? ENOSPC : 0);
    unsigned long long used = __atomic_fetch_add(&written_bytes, *bytes, __ATOMIC_SEQ_CST);
    if (!at || used + *bytes <= at) return false;
    __atomic_store_n(&written_bytes, used < at ? at : used, __ATOMIC_SEQ_CST);
    *bytes = used < at ? (size_t)(at - used) : 0;
    errno = ENOSPC;
    return !*bytes;
}

ssize_t write(int fd, const void *from, size_t bytes) {
    return write_fails(fd, &bytes) ? -1 : syscall(SYS_write, fd, from, bytes);
}
ssize_t pwrite(int fd, const void *from, size_t bytes, off_t offset) {
    return write_fails(fd, &bytes) ? -1 : syscall(SYS_pwrite64, fd, from, bytes, offset);
}
ssize_t pwrite64(int fd, const void *from, size_t bytes, off_t offset) {
    return pwrite(fd, from, bytes, offset);
}
ssize_t writev(int fd, const struct iovec *pieces, int count) {
    size_t bytes = 0;
    for (int i = 0; i < count; i++) bytes += pieces[i].iov_len;
    size_t given = bytes;
    if (write_fails(fd, &bytes)) return -1;
    if (bytes == given) return syscall(SYS_writev, fd, pieces, count);
    size_t first = pieces[0].iov_len < bytes ? pieces[0].iov_len : bytes;
    return syscall(SYS_write, fd, pieces[0].iov_base, first);
}
NEXT(size_t, fwrite, const void *, size_t, size_t, FILE *)
size_t fwrite(const void *from, size_t bytes, size_t count, FILE *file) {
    size_t wish = bytes * count;
    if (!write_fails(fileno(file), &wish)) return fwrite_next()(from, bytes, count, file);
    file->_flags |= 0x20;
    return 0;
}
int ftruncate(int fd, off_t bytes) {
    size_t none = 0;
    if (wanted != DISK && write_fails(fd, &none)) return -1;
    return (int)syscall(SYS_ftruncate, fd, bytes);
}
int posix_fallocate(int fd, off_t offset, off_t bytes) {
    size_t none = 0;
    if (wanted != DISK && write_fails(fd, &none)) return ENOSPC;
    return syscall(SYS_fallocate, fd, 0, offset, bytes) ? errno : 0;
}

/* ---- Syncing, naming, closing ---- */

#define SYNCS(name, number)                                                                    \
    int name(int fd) {                                                                         \
        return is_ours_fd(fd) && fails(SYNC, "a file", EIO) ? -1 : (int)syscall(number, fd);   \
    }
SYNCS(fsync, SYS_fsync)
SYNCS(fdatasync, SYS_fdatasync)

int rename(const char *from, const char *to) {
    return is_ours(to) && fails(NAME, "a file", EIO) ? -1 : (int)syscall(SYS_rename, from, to);
}
int renameat2(int from_directory, const char *from, int to_directory, const char *to,
              unsigned flags) {
    if (is_ours(to) && fails(NAME, "a file", EIO)) return -1;
    return (int)syscall(SYS_renameat2, from_directory, from, to_directory, to, flags);
}
int linkat(int from_directory, const char *from, int to_directory, const char *to, int flags) {
    if (is_ours(to) && fails(NAME, "a file", EIO)) return -1;
    return (int)syscall(SYS_linkat, from_directory, from, to_directory, to, flags);
}

/* As the kernel does, closes all the same. */
int close(int fd) {
    bool hit =
        (wanted == CLOSE || wanted == KILL) && is_ours_fd(fd) && fails(CLOSE, "a file", EIO);
    int result = (int)syscall(SYS_close, fd);
    if (hit) errno = EIO;
    return hit ? -1 : result;
}
NEXT(int, fclose, FILE *)
int fclose(FILE *file) {
    bool hit = (wanted == CLOSE || wanted == KILL) && is_ours_fd(fileno(file)) &&
               fails(CLOSE, "a file", EIO);
    int result = fclose_next()(file);
    if (hit) errno = EIO;
    return hit ? EOF : result;
}

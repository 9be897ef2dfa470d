/* Files that are whole or absent, and what is said when they cannot be. */
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <sched.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include <cmocka.h>

#include "convert/base/outfile.h"
#include "convert/base/outplace.h"

/* ---- A place to work ---- */

static char root[PATH_MAX];

static int enter(void **state) {
    (void)state;
    const char *tmp = getenv("TMPDIR");
    snprintf(root, sizeof root, "%s/outfile.XXXXXX", tmp ? tmp : "/tmp");
    umask(022);
    return !mkdtemp(root) || chdir(root) || chmod(root, 0755);
}

static int leave(void **state) {
    (void)state;
    char command[PATH_MAX + 32];
    snprintf(command, sizeof command, "rm -rf '%s'", root);
    return chdir("/") || system(command);
}

static int entries(const char *directory) {
    DIR *dir = opendir(directory);
    int count = -2;
    assert_non_null(dir);
    while (readdir(dir)) count++;
    closedir(dir);
    return count;
}

static unsigned char pattern_at(size_t i) {
    return (unsigned char)(i * 2654435761u >> 13);
}

static void put(const char *path, const char *text) {
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

static void holds(const char *path, const char *text) {
    char read_back[256];
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    size_t got = fread(read_back, 1, sizeof read_back - 1, file);
    read_back[got] = '\0';
    fclose(file);
    assert_string_equal(read_back, text);
}

static weft_status write_text(const char *path, bool overwrite, const char *text,
                              weft_error *err) {
    wf_outfile *file;
    weft_status status = wf_outfile_open(path, overwrite, &file, err);
    if (status) return status;
    status = wf_outfile_write(file, text, strlen(text), err);
    if (!status) return wf_outfile_commit(file, err);
    wf_outfile_abandon(file);
    return status;
}

static void refused(const char *path, bool overwrite, const char *words) {
    weft_error err = {""};
    weft_status status = write_text(path, overwrite, "new", &err);
    if (status != WEFT_FAILED || !strstr(err.text, words) || !strstr(err.text, path))
        fail_msg("%s: status %d: %s", path, status, err.text);
}

static void written(const char *path, bool overwrite, const char *text) {
    weft_error err = {""};
    weft_status status = write_text(path, overwrite, text, &err);
    if (status) fail_msg("%s: %s", path, err.text);
}

/* Runs check in a process of its own and, where that is possible, as nobody; its result is 0,
 * or says where it failed, or 77. */
static int apart(int (*check)(void), bool as_nobody) {
    fflush(NULL);
    pid_t child = fork();
    assert_true(child >= 0);
    if (!child) {
        if (as_nobody && !geteuid() && (setgid(65534) || setuid(65534))) _exit(77);
        _exit(check());
    }
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    if (!WIFEXITED(status)) fail_msg("ended by signal %d", WTERMSIG(status));
    return WEXITSTATUS(status);
}

static void must_pass(int result) {
    if (result == 77) skip();
    assert_int_equal(result, 0);
}

/* ---- Whole or absent ---- */

static void nothing_stands_there_before_commit(void **state) {
    (void)state;
    wf_outfile *file;
    weft_error err;
    assert_int_equal(wf_outfile_open("a", false, &file, &err), WEFT_OK);
    assert_int_equal(wf_outfile_write(file, "hello", 5, &err), WEFT_OK);
    assert_int_equal(access("a", F_OK), -1);
    assert_int_equal(wf_outfile_commit(file, &err), WEFT_OK);
    holds("a", "hello");
    assert_int_equal(entries("."), 1);
    struct stat about;
    assert_int_equal(stat("a", &about), 0);
    assert_int_equal(about.st_mode & 0777, 0644);
}

static void nothing_is_left_of_what_is_abandoned(void **state) {
    (void)state;
    wf_outfile *file;
    weft_error err;
    put("old", "old");
    for (int overwrite = 0; overwrite < 2; overwrite++) {
        assert_int_equal(wf_outfile_open(overwrite ? "old" : "new", overwrite, &file, &err),
                         WEFT_OK);
        assert_int_equal(wf_outfile_write(file, "hello", 5, &err), WEFT_OK);
        wf_outfile_abandon(file);
    }
    wf_outfile_abandon(NULL);
    assert_int_equal(entries("."), 1);
    holds("old", "old");
}

static void an_existing_file(void **state) {
    (void)state;
    put("a", "old");
    refused("a", false, "exists; give --overwrite to replace it, or --resume");
    holds("a", "old");
    written("a", true, "new");
    holds("a", "new");
    written("b", true, "b");
    holds("b", "b");
    assert_int_equal(entries("."), 2);
}

static void a_file_that_appears_meanwhile(void **state) {
    (void)state;
    wf_outfile *file;
    weft_error err;
    assert_int_equal(wf_outfile_open("a", false, &file, &err), WEFT_OK);
    put("a", "theirs");
    assert_int_equal(wf_outfile_commit(file, &err), WEFT_FAILED);
    assert_non_null(strstr(err.text, "appeared"));
    holds("a", "theirs");
    assert_int_equal(wf_outfile_open("b", true, &file, &err), WEFT_OK);
    put("b", "theirs");
    assert_int_equal(wf_outfile_commit(file, &err), WEFT_OK);
    holds("b", "");
    assert_int_equal(entries("."), 2);
}

/* All sizes about the buffer's, in pieces small and large. */
static void every_byte_arrives(void **state) {
    (void)state;
    const size_t buffer = 1 << 20;
    const size_t pieces[] = {1, 4095, buffer - 1, buffer, buffer + 1, 3 * buffer + 7, 0, 1};
    unsigned char *data = malloc(8 * buffer), *read_back = malloc(8 * buffer);
    size_t total = 0;
    wf_outfile *file;
    weft_error err;
    assert_true(data && read_back);
    for (size_t i = 0; i < 8 * buffer; i++) data[i] = pattern_at(i);
    assert_int_equal(wf_outfile_open("a", false, &file, &err), WEFT_OK);
    for (size_t i = 0; i < sizeof pieces / sizeof *pieces; total += pieces[i++])
        assert_int_equal(wf_outfile_write(file, data + total, pieces[i], &err), WEFT_OK);
    assert_int_equal(wf_outfile_commit(file, &err), WEFT_OK);
    FILE *back = fopen("a", "rb");
    assert_non_null(back);
    assert_int_equal(fread(read_back, 1, 8 * buffer, back), total);
    fclose(back);
    assert_memory_equal(read_back, data, total);
    free(data);
    free(read_back);
}

/* Without /proc a file without a name could never be given one: it is made with one. */
static int without_proc(void) {
    wf_outfile *file;
    weft_error err = {""};
    if (unshare(CLONE_NEWNS) || mount(NULL, "/", NULL, MS_REC | MS_PRIVATE, NULL) ||
        mount("weft-test", "/proc", "tmpfs", 0, NULL))
        return 77;
    for (int round = 0; round < 3; round++) { /* new, abandoned, replaced */
        if (wf_outfile_open("a", round > 0, &file, &err)) return 2;
        if (wf_outfile_write(file, "text", 4, &err)) return 3;
        if (entries(".") != (round ? 2 : 1)) return 4;
        if (round == 1)
            wf_outfile_abandon(file);
        else if (wf_outfile_commit(file, &err))
            return 5;
        if (entries(".") != 1) return 6;
    }
    return 0;
}

static void without_files_without_names(void **state) {
    (void)state;
    int result = apart(without_proc, false);
    if (result == 77) print_message("skipped: /proc cannot be hidden here\n");
    must_pass(result);
    holds("a", "text");
}

/* As on file systems that have no files without names. */
static void the_way_with_a_name(void **state) {
    (void)state;
    for (int overwrite = 0; overwrite < 2; overwrite++) {
        wf_outplace place = {
            .path = strdup("a"), .target = strdup("a"), .overwrite = overwrite};
        weft_error err = {""};
        place.temporary = strdup(".a.1.0.tmp");
        int fd = open(place.temporary, O_WRONLY | O_CREAT | O_EXCL, 0666);
        assert_true(fd >= 0);
        assert_int_equal(write(fd, overwrite ? "two" : "one", 3), 3);
        assert_int_equal(wf_outplace_publish(&place, fd, &err), WEFT_OK);
        wf_outplace_forget(&place);
        holds("a", overwrite ? "two" : "one");
        assert_int_equal(entries("."), 1);
    }
    wf_outplace place = {.path = strdup("a"), .target = strdup("a"), .temporary = strdup("t")};
    weft_error err = {""};
    put("t", "three");
    assert_int_equal(wf_outplace_publish(&place, open("t", O_WRONLY), &err), WEFT_FAILED);
    assert_non_null(strstr(err.text, "appeared"));
    wf_outplace_forget(&place);
    holds("a", "two");
    assert_int_equal(entries("."), 1);
}

/* ---- Links, streams ---- */

static void links_are_followed(void **state) {
    (void)state;
    assert_int_equal(mkdir("d", 0777), 0);
    put("d/real", "old");
    assert_int_equal(symlink("d/real", "one"), 0);
    assert_int_equal(symlink("one", "two"), 0);
    assert_int_equal(symlink("d/absent", "dangling"), 0);
    assert_int_equal(symlink("loop", "loop"), 0);
    refused("two", false, "exists");
    written("two", true, "new");
    holds("d/real", "new");
    written("dangling", false, "there");
    holds("d/absent", "there");
    struct stat about;
    assert_int_equal(lstat("two", &about), 0);
    assert_true(S_ISLNK(about.st_mode));
    refused("loop", true, "symbolic links");
    assert_int_equal(entries("d"), 2);
}

static void streams_are_written_as_they_come(void **state) {
    (void)state;
    struct stat about;
    written("/dev/null", false, "anything");
    assert_int_equal(stat("/dev/null", &about), 0);
    assert_true(S_ISCHR(about.st_mode));
    assert_int_equal(mkfifo("fifo", 0666), 0);
    int reader = open("fifo", O_RDONLY | O_NONBLOCK);
    char text[16] = "";
    written("fifo", false, "through");
    assert_int_equal(read(reader, text, sizeof text), 7);
    assert_string_equal(text, "through");
    close(reader);
    assert_int_equal(lstat("fifo", &about), 0);
    assert_true(S_ISFIFO(about.st_mode));
}

static int to_standard_output(void) {
    wf_outfile *file;
    weft_error err = {""};
    int ends[2];
    char text[16] = "";
    if (pipe(ends) || dup2(ends[1], STDOUT_FILENO) < 0) return 2;
    if (wf_outfile_open("-", false, &file, &err)) return 3;
    if (wf_outfile_write(file, "stream", 6, &err) || wf_outfile_commit(file, &err)) return 4;
    if (read(ends[0], text, sizeof text) != 6 || strcmp(text, "stream")) return 5;
    return fcntl(STDOUT_FILENO, F_GETFD) < 0 ? 6 : access("-", F_OK) == 0 ? 7 : 0;
}

/* The reader leaves. Nobody has ignored SIGPIPE here, and the process lives; one that was
 * waiting is still there. */
static int into_a_closed_pipe(void) {
    wf_outfile *file;
    weft_error err = {""};
    int ends[2];
    sigset_t pipe_signal, pending;
    signal(SIGPIPE, SIG_DFL);
    if (pipe(ends) || dup2(ends[1], STDOUT_FILENO) < 0 || close(ends[0])) return 2;
    if (wf_outfile_open("-", false, &file, &err)) return 3;
    if (wf_outfile_write(file, "text", 4, &err)) return 4;
    if (wf_outfile_commit(file, &err) != WEFT_FAILED) return 5;
    if (!strstr(err.text, "standard output") || !strstr(err.text, "Broken pipe")) return 6;
    sigemptyset(&pipe_signal);
    sigaddset(&pipe_signal, SIGPIPE);
    sigprocmask(SIG_BLOCK, &pipe_signal, NULL);
    raise(SIGPIPE);
    if (wf_outfile_open("-", false, &file, &err)) return 7;
    if (wf_outfile_write(file, "text", 4, &err) || !wf_outfile_commit(file, &err)) return 8;
    sigpending(&pending);
    return sigismember(&pending, SIGPIPE) ? 0 : 9;
}

/* A pipe that does not block, and a reader slower than the writer. */
static int into_a_pipe_that_does_not_block(void) {
    enum { BYTES = 3 << 20 };
    int ends[2];
    if (pipe(ends) || fcntl(ends[1], F_SETFL, O_NONBLOCK)) return 2;
    pid_t reader = fork();
    if (!reader) {
        static unsigned char text[1 << 16];
        size_t total = 0;
        close(ends[1]);
        for (ssize_t got; (got = read(ends[0], text, sizeof text)) > 0; total += (size_t)got) {
            for (ssize_t i = 0; i < got; i++)
                if (text[i] != pattern_at(total + (size_t)i)) _exit(1);
            usleep(1000);
        }
        _exit(total == BYTES ? 0 : 2);
    }
    close(ends[0]);
    if (dup2(ends[1], STDOUT_FILENO) < 0 || close(ends[1])) return 3;
    unsigned char *data = malloc(BYTES);
    wf_outfile *file;
    weft_error err;
    for (size_t i = 0; data && i < BYTES; i++) data[i] = pattern_at(i);
    if (!data || wf_outfile_open("-", false, &file, &err)) return 4;
    if (wf_outfile_write(file, data, BYTES, &err) || wf_outfile_commit(file, &err)) return 5;
    free(data);
    int status;
    close(STDOUT_FILENO);
    return waitpid(reader, &status, 0) == reader && !status ? 0 : 6;
}

static void standard_output(void **state) {
    (void)state;
    must_pass(apart(to_standard_output, false));
    must_pass(apart(into_a_closed_pipe, false));
    must_pass(apart(into_a_pipe_that_does_not_block, false));
}

/* ---- What goes wrong ---- */

static void places_that_are_none(void **state) {
    (void)state;
    assert_int_equal(mkdir("d", 0777), 0);
    put("file", "old");
    refused("d", true, "is a directory; name a file in it");
    refused("d/", true, "is a directory; name a file in it");
    refused("new/", true, "names a directory");
    refused("none/a", false, "No such file or directory; make it first");
    refused("file/a", false, "Not a directory");
    char name[300];
    memset(name, 'x', 256);
    name[256] = '\0';
    refused(name, false, "File name too long");
    name[255] = '\0';
    written(name, false, "longest");
    written(name, true, "longest");
    assert_int_equal(entries("."), 3);
}

static void a_failure_sticks(void **state) {
    (void)state;
    wf_outfile *file;
    weft_error first, again;
    char *block = calloc(1, 2 << 20);
    assert_non_null(block);
    assert_int_equal(wf_outfile_open("/dev/full", false, &file, &first), WEFT_OK);
    assert_int_equal(wf_outfile_write(file, "small", 5, &first), WEFT_OK);
    assert_int_equal(wf_outfile_write(file, block, 2 << 20, &first), WEFT_FAILED);
    assert_non_null(strstr(first.text, "/dev/full"));
    assert_non_null(strstr(first.text, "No space left"));
    assert_int_equal(wf_outfile_write(file, "small", 5, &again), WEFT_FAILED);
    assert_string_equal(first.text, again.text);
    memset(&again, 0, sizeof again);
    assert_int_equal(wf_outfile_commit(file, &again), WEFT_FAILED);
    assert_string_equal(first.text, again.text);
    /* What was still in the buffer fails when it is committed. */
    assert_int_equal(wf_outfile_open("/dev/full", false, &file, &first), WEFT_OK);
    assert_int_equal(wf_outfile_write(file, "small", 5, NULL), WEFT_OK);
    assert_int_equal(wf_outfile_commit(file, NULL), WEFT_FAILED);
    free(block);
}

/* The disk has room for one megabyte, as a limit on the process has it and as a file system
 * has. */
static int fill(const char *path, const char *words) {
    wf_outfile *file;
    weft_error err = {""};
    weft_status status = wf_outfile_open(path, true, &file, &err);
    static char block[300000];
    if (status) return 2;
    for (int i = 0; i < 20 && !status; i++)
        status = wf_outfile_write(file, block, sizeof block, &err);
    if (status != WEFT_FAILED || !strstr(err.text, words)) return 3;
    if (wf_outfile_commit(file, &err) != WEFT_FAILED) return 4;
    return entries(".") == 1 ? 0 : 5;
}

static int beyond_a_limit(void) {
    const struct rlimit limit = {1 << 20, 1 << 20};
    signal(SIGXFSZ, SIG_DFL);
    if (setrlimit(RLIMIT_FSIZE, &limit)) return 77;
    return fill("old", "File too large");
}

static void a_limit_on_sizes(void **state) {
    (void)state;
    put("old", "old");
    must_pass(apart(beyond_a_limit, false));
    holds("old", "old");
}

static void a_full_disk(void **state) {
    (void)state;
    assert_int_equal(mkdir("disk", 0777), 0);
    if (mount("weft-test", "disk", "tmpfs", 0, "size=1m")) {
        print_message("skipped: no file system may be mounted here: %s\n", strerror(errno));
        skip();
    }
    int result = chdir("disk");
    put("old", "old");
    if (!result) result = fill("old", "No space left on device; make room");
    if (!result) holds("old", "old");
    assert_int_equal(chdir(root), 0);
    assert_int_equal(umount("disk"), 0);
    assert_int_equal(result, 0);
}

static int in_a_directory_of_others(void) {
    weft_error err = {""};
    if (write_text("d/a", false, "new", &err) != WEFT_FAILED) return 2;
    if (!strstr(err.text, "d/a") || !strstr(err.text, "Permission denied; write elsewhere"))
        return 3;
    if (write_text("d/old", true, "new", &err) != WEFT_FAILED) return 4;
    if (!strstr(err.text, "protected from writing")) return 5;
    return 0;
}

static void a_directory_of_others(void **state) {
    (void)state;
    assert_int_equal(mkdir("d", 0777), 0);
    put("d/old", "old");
    assert_int_equal(chmod("d/old", 0444), 0);
    assert_int_equal(chmod("d", 0555), 0);
    int result = apart(in_a_directory_of_others, true);
    assert_int_equal(chmod("d", 0755), 0);
    if (result == 77)
        print_message("skipped: root writes everywhere, and cannot be anybody else\n");
    must_pass(result);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(nothing_stands_there_before_commit, enter, leave),
        cmocka_unit_test_setup_teardown(nothing_is_left_of_what_is_abandoned, enter, leave),
        cmocka_unit_test_setup_teardown(an_existing_file, enter, leave),
        cmocka_unit_test_setup_teardown(a_file_that_appears_meanwhile, enter, leave),
        cmocka_unit_test_setup_teardown(every_byte_arrives, enter, leave),
        cmocka_unit_test_setup_teardown(without_files_without_names, enter, leave),
        cmocka_unit_test_setup_teardown(the_way_with_a_name, enter, leave),
        cmocka_unit_test_setup_teardown(links_are_followed, enter, leave),
        cmocka_unit_test_setup_teardown(streams_are_written_as_they_come, enter, leave),
        cmocka_unit_test_setup_teardown(standard_output, enter, leave),
        cmocka_unit_test_setup_teardown(places_that_are_none, enter, leave),
        cmocka_unit_test_setup_teardown(a_failure_sticks, enter, leave),
        cmocka_unit_test_setup_teardown(a_limit_on_sizes, enter, leave),
        cmocka_unit_test_setup_teardown(a_full_disk, enter, leave),
        cmocka_unit_test_setup_teardown(a_directory_of_others, enter, leave),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

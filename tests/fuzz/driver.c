/* Runs a fuzz target without libFuzzer: on nothing, on every file named or found in a directory
 * named, and on simple mutations of each, the same ones every time. */
#include <dirent.h>
#include <errno.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { MUTATIONS = 200 };

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static uint64_t random_next(uint64_t *state) {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    return *state;
}

/* Runs a copy of exactly size bytes, so that a sanitizer sees the first byte read beyond. */
static void run_copy(const uint8_t *data, size_t size) {
    uint8_t *copy = calloc(1, size ? size : 1);
    if (!copy) abort();
    memcpy(copy, data, size);
    LLVMFuzzerTestOneInput(copy, size);
    free(copy);
}

/* Some bytes replaced, and every other time the end cut off. */
static void run_mutations(uint8_t *data, size_t size, uint64_t seed) {
    for (int i = 0; i < MUTATIONS; ++i) {
        size_t at[4];
        uint8_t was[4];
        for (int k = 0; k < 4; ++k) {
            at[k] = random_next(&seed) % size;
            was[k] = data[at[k]];
            data[at[k]] = (uint8_t)random_next(&seed);
        }
        run_copy(data, i % 2 ? random_next(&seed) % size : size);
        for (int k = 3; k >= 0; --k) data[at[k]] = was[k];
    }
}

static int run_file(const char *path) {
    FILE *file = fopen(path, "rb");
    struct stat info;
    if (!file || fstat(fileno(file), &info) != 0) {
        fprintf(stderr, "%s: %s\n", path, strerror(errno));
        if (file) fclose(file);
        return 1;
    }
    size_t size = (size_t)info.st_size;
    uint8_t *data = malloc(size ? size : 1);
    int failed = !data || fread(data, 1, size, file) != size;
    fclose(file);
    if (failed) {
        fprintf(stderr, "%s: cannot be read\n", path);
    } else {
        run_copy(data, size);
        if (size) run_mutations(data, size, 0x9E3779B97F4A7C15u + size);
    }
    free(data);
    return failed;
}

static int run_directory(const char *path) {
    struct dirent **entries;
    int count = scandir(path, &entries, NULL, alphasort);
    if (count < 0) {
        fprintf(stderr, "%s: %s\n", path, strerror(errno));
        return 1;
    }
    int failed = 0;
    for (int i = 0; i < count; ++i) {
        char name[4096];
        snprintf(name, sizeof name, "%s/%s", path, entries[i]->d_name);
        if (entries[i]->d_name[0] != '.') failed |= run_file(name);
        free(entries[i]);
    }
    free(entries);
    return failed;
}

int main(int argc, char **argv) {
    int failed = 0;
    run_copy((const uint8_t *)"", 0);
    for (int i = 1; i < argc; ++i) {
        struct stat info;
        bool directory = stat(argv[i], &info) == 0 && S_ISDIR(info.st_mode);
        failed |= directory ? run_directory(argv[i]) : run_file(argv[i]);
    }
    return failed;
}

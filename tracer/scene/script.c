/* Reads the files of a script. */
#include "tracer/scene/script.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* Marks of the encoding that texts may begin with; those of two bytes to a letter also show in
 * the first letter, which is never 0 in what Lua reads. */
static const char *wide_encoding(const char *text, size_t size) {
    static const struct {
        const char bytes[5], *name;
        size_t size;
    } marks[] = {{"\xff\xfe\0\0", "UTF-32", 4},
                 {"\0\0\xfe\xff", "UTF-32", 4},
                 {"\xff\xfe", "UTF-16", 2},
                 {"\xfe\xff", "UTF-16", 2}};
    for (size_t n = 0; n < sizeof marks / sizeof *marks; n++)
        if (size >= marks[n].size && !memcmp(text, marks[n].bytes, marks[n].size))
            return marks[n].name;
    return size >= 2 && !text[0] != !text[1] ? "UTF-16" : NULL;
}

/* UTF-8 may begin with a byte order mark, which says nothing. */
static void skip_mark(char *text, size_t *size) {
    if (*size < 3 || memcmp(text, "\xef\xbb\xbf", 3)) return;
    *size -= 3;
    memmove(text, text + 3, *size);
}

char *wf_script_read(const char *path, size_t most, size_t *size, char *why, size_t why_size) {
    struct stat info;
    char *text = NULL;
    if (stat(path, &info)) {
        snprintf(why, why_size, "%s: %s", path, strerror(errno));
        return NULL;
    }
    if (!S_ISREG(info.st_mode) || (size_t)info.st_size > most) {
        snprintf(why, why_size, "%s: %s", path,
                 S_ISREG(info.st_mode) ? "it is larger than --scene-memory allows"
                                       : "it is not a file");
        return NULL;
    }
    FILE *file = fopen(path, "rb");
    if (file) text = malloc((size_t)info.st_size + 1);
    if (text) *size = fread(text, 1, (size_t)info.st_size, file);
    if (!text || ferror(file)) {
        snprintf(why, why_size, "%s: %s", path, strerror(errno));
        free(text);
        text = NULL;
    }
    if (file) fclose(file);
    const char *wide = text ? wide_encoding(text, *size) : NULL;
    if (wide) {
        snprintf(why, why_size, "%s: it is in %s; save it as UTF-8", path, wide);
        free(text);
        return NULL;
    }
    if (text) skip_mark(text, size);
    return text;
}

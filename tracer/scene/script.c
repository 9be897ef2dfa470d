/* Reads the files of a script. */
#include "tracer/scene/script.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

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
        snprintf(why, why_size, "%s: %s", path, file ? "it cannot be read" : strerror(errno));
        free(text);
        text = NULL;
    }
    if (file) fclose(file);
    return text;
}
